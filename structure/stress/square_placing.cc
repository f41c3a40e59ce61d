// Where the squares of the checked stress lie.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Dense>

#include "parallel/threads.h"
#include "structure/formulation/shell.h"
#include "structure/mesh/fields/shell_edges.h"
#include "structure/mesh/place_grid.h"
#include "structure/stress/square_about.h"
#include "structure/stress/square_outline.h"
#include "structure/stress/squares.h"

namespace blocklift::structure {

namespace {

using square_outline::contour;
using square_outline::ContourPoint;
using square_outline::normal_of;
using square_outline::start_of;

constexpr double largest_spacing = 0.5;  // m, between squares
constexpr double corner_reach = 3;       // squares from a singular vertex
constexpr double beside_weld = 0.75;     // squares from a centre: those that touch it
constexpr int contiguous = 4;            // squares one behind the other from a corner

ShellPlace place_of(const FieldEdge& edge, double s) {
  for (const FieldEdge::Piece& piece : edge.pieces) {
    if (s <= piece.length || &piece == &edge.pieces.back())
      return {piece.shell,
              piece.begin + std::clamp(s / piece.length, 0.0, 1.0) * (piece.end - piece.begin)};
    s -= piece.length;
  }
  return {};
}

/// Distances from both ends of an edge at which squares begin: one behind the other at the ends,
/// ever farther apart towards the middle.
std::vector<double> starts_along(double length, double size) {
  std::vector<double> starts;
  const double room = length - size;
  if (room < -1e-9 * size) return starts;
  double s = 0, gap = size;
  for (int i = 0; s <= room / 2 + 1e-9; ++i) {
    starts.push_back(s);
    starts.push_back(room - s);
    if (i >= contiguous) gap = std::min(1.5 * gap, largest_spacing);
    s += gap;
  }
  std::sort(starts.begin(), starts.end());
  const auto last = std::unique(starts.begin(), starts.end(),
                                [&](double a, double b) { return b - a < 0.1 * size; });
  starts.erase(last, starts.end());
  return starts;
}

/// The squares of one field.
class SquarePlacer {
 public:
  SquarePlacer(const Mesh& mesh, const FieldWalker& walker, double size)
      : mesh_(mesh), walker_(walker), size_(size) {}

  /// The square with its centre nearest to a place, from a shell of its field on; see square_about.
  std::optional<Square> about(const PlateField& field, int start_shell,
                              const Vector3& place) const {
    const Vector3 along = first_direction(field, start_shell);
    std::optional<Square> nearest;
    double smallest = 2 * size_ * (1 + 1e-9);
    ShellPlace start{start_shell, {0.5, 0.5}};
    const Vector3 normal = normal_of(mesh_, start);
    const Vector3 e_1 = (along - normal * normal.dot(along)).normalized(), e_2 = normal.cross(e_1);
    if (!e_1.allFinite()) return nearest;
    for (int i = -steps_about; i <= steps_about; ++i)
      for (int j = -steps_about; j <= steps_about; ++j) {
        const auto found = walker_.find(place + size_ / 4 * (i * e_1 + j * e_2), start);
        if (!found) continue;
        const Square square = laid(*found, e_1);
        const double distance = (square.centre_B - place).norm();
        if (distance >= smallest || !lies_inside(square)) continue;
        smallest = distance;
        nearest = square;
      }
    return nearest;
  }

  std::vector<Square> place(const PlateField& field) {
    squares_.clear();
    for (const auto& outline : field.outlines)
      for (const FieldEdge& edge : outline) along(field, edge);
    between(field);
    if (squares_.empty()) smaller(field);
    return std::move(squares_);
  }

 private:
  static constexpr int steps_about = 4;  // quarters of a side that a square is moved by at most

  Vector3 position_of(const ShellPlace& place) const {
    return position(mesh_, mesh_.shells[place.shell], place.xi);
  }

  Vector3 way_along(const FieldEdge& edge) const {
    return position_of(place_of(edge, edge.length)) - position_of(place_of(edge, 0));
  }

  /// The first edge of an outline that has two corners; null without such. A closed tank has no
  /// outline, and a pipe's or a round hole's ends where it begins.
  const FieldEdge* edge_between_corners(const PlateField& field) const {
    for (const auto& outline : field.outlines) {
      const FieldEdge& first = outline.front();
      if (way_along(first).norm() > 1e-6 * first.length) return &first;
    }
    return nullptr;
  }

  /// From an outline's first corner to the next one; without them along a shell's first side.
  Vector3 first_direction(const PlateField& field, int shell) const {
    if (const FieldEdge* edge = edge_between_corners(field)) return way_along(*edge);
    return tangents(mesh_, shell, {0.5, 0.5}).col(0);
  }

  /// Does plating turn by more than 60 degrees from a normal? A plane lattice would leave it out.
  bool turns_away(const PlateField& field, const Vector3& normal) const {
    return std::any_of(field.shells.begin(), field.shells.end(), [&](int shell) {
      return std::abs(normal_of(mesh_, {shell, {0.5, 0.5}}).dot(normal)) < 0.5;
    });
  }

  /// Where nothing carries a lattice squares lie in the middles of shells, or of parts of large
  /// ones, as far apart as on a lattice. The shells are those of the mesh, whatever divides them.
  void over_shells(const PlateField& field) {
    PlaceGrid placed(largest_spacing);
    for (const int shell : field.shells) {
      const double longest = longest_edge(mesh_, mesh_.shells[shell]);
      const int parts = std::max(1, static_cast<int>(std::ceil(longest / largest_spacing)));
      for (int row = 0; row < parts; ++row)
        for (int i = 0; i < parts; ++i)
          add_apart({shell, Eigen::Vector2d(i + 0.5, row + 0.5) / parts}, placed);
    }
  }

  void add_apart(const ShellPlace& place, PlaceGrid& placed) {
    const Square square = laid(place, tangents(mesh_, place.shell, place.xi).col(0));
    const Vector3 around = Vector3::Constant(largest_spacing);
    bool is_near = false;
    placed.visit(square.centre_B - around, square.centre_B + around, [&](int other) {
      const Vector3& known = squares_[other].centre_B;
      is_near = is_near || (known - square.centre_B).norm() < 0.8 * largest_spacing;
    });
    if (is_near || !lies_inside(square)) return;
    placed.add(square.centre_B, static_cast<int>(squares_.size()));
    squares_.push_back(square);
  }

  /// A square with its centre at a place, its first side as nearly along e_1 as the plate lets it.
  Square laid(const ShellPlace& at, const Vector3& e_1) const {
    Square square;
    square.size = size_;
    square.shell = at.shell;
    square.region = mesh_.shells[at.shell].region;
    square.centre_B = position_of(at);
    square.e_1 = e_1;
    turn_to(normal_of(mesh_, at), square);
    return square;
  }

  static void turn_to(const Vector3& normal, Square& square) {
    square.e_1 = (square.e_1 - normal * normal.dot(square.e_1)).normalized();
    square.e_2 = normal.cross(square.e_1);
  }

  /// Turns a square on an edge into the plane that touches a curved plate at the square's centre:
  /// in that at its edge a rotation of the plate has a strain.
  void turn_to_centre(const PlateField& field, const Vector3& on_edge, Square& square) const {
    square.centre_B = on_edge + 0.5 * square.size * square.e_2;
    if (const auto found = walker_.find(square.centre_B, start_of(square)))
      turn_to(side_of(field, found->shell) * normal_of(mesh_, *found), square);
  }

  /// Of a shell that looks as its field does: 1.
  static double side_of(const PlateField& field, int shell) {
    const auto found = std::find(field.shells.begin(), field.shells.end(), shell);
    return field.is_flipped[found - field.shells.begin()] ? -1 : 1;
  }

  bool lies_inside(const Square& square) const {
    return std::ranges::all_of(contour(square), [&](const ContourPoint& point) {
      const auto found = walker_.find(point.place, start_of(square));
      return found &&
             (position(mesh_, mesh_.shells[found->shell], found->xi) - point.place).norm() <
                 0.2 * square.size;
    });
  }

  /// A square with one side on an edge, from s on. @returns false if it does not fit in.
  bool put_on_edge(const PlateField& field, const FieldEdge& edge, double s, double size) {
    const ShellPlace begin = place_of(edge, s), middle = place_of(edge, s + size / 2),
                     end = place_of(edge, s + size);
    Square square{.size = size, .region = mesh_.shells[middle.shell].region, .shell = middle.shell};
    square.e_1 = (position_of(end) - position_of(begin)).normalized();
    turn_to(side_of(field, middle.shell) * normal_of(mesh_, middle), square);
    turn_to_centre(field, position_of(middle), square);
    // On a curved edge either the chord or the tangent has the square inside.
    const Vector3 chord = 0.5 * (position_of(begin) + position_of(end));
    for (const Vector3& base : {position_of(middle), chord}) {
      square.centre_B = base + 0.5 * size * square.e_2;
      if (!lies_inside(square)) continue;
      squares_.push_back(square);
      return true;
    }
    return false;
  }

  void along(const PlateField& field, const FieldEdge& edge) {
    for (const double s : starts_along(edge.length, size_)) put_on_edge(field, edge, s, size_);
  }

  /// A field that has no room for a whole square.
  void smaller(const PlateField& field) {
    for (double size = size_ / 2; size > size_ / 20; size /= 2)
      for (const auto& outline : field.outlines)
        for (const FieldEdge& edge : outline) {
          const double s = 0.5 * (edge.length - size);
          if (s >= 0 && put_on_edge(field, edge, s, size)) return;
        }
  }

  void between(const PlateField& field) {
    const FieldEdge* edge = edge_between_corners(field);
    if (edge == nullptr) return over_shells(field);
    // A lattice that hangs on the first corner of the outline.
    const ShellPlace origin = place_of(*edge, 0);
    const Vector3 begin = position_of(origin), normal = normal_of(mesh_, origin);
    if (turns_away(field, normal)) return over_shells(field);
    Vector3 e_1 = first_direction(field, origin.shell);
    e_1 = (e_1 - normal * normal.dot(e_1)).normalized();
    if (!e_1.allFinite()) return;
    const Vector3 e_2 = normal.cross(e_1);
    Eigen::Array2d lower = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array2d upper = -lower;
    for (const int shell : field.shells)
      for (const int vertex : mesh_.shells[shell].vertices) {
        const Vector3 arm = mesh_.vertices[vertex] - begin;
        const Eigen::Array2d in_plane(arm.dot(e_1), arm.dot(e_2));
        lower = lower.min(in_plane);
        upper = upper.max(in_plane);
      }
    std::vector<Square> lattice;
    ShellPlace start = origin;
    const auto first_step = [](double low) { return std::ceil(low / largest_spacing + 0.01); };
    for (double j = first_step(lower[1]); j * largest_spacing < upper[1]; ++j)
      for (double i = first_step(lower[0]); i * largest_spacing < upper[0]; ++i) {
        const Vector3 wanted = begin + largest_spacing * (i * e_1 + j * e_2);
        const auto found = walker_.find(wanted, start);
        if (!found) continue;
        start = *found;
        lattice.push_back(laid(*found, e_1));
      }
    take_those_inside(lattice);
  }

  void take_those_inside(const std::vector<Square>& candidates) {
    constexpr int batch = 1024;  // fields lie side by side: large ones alone need more threads
    std::vector<char> is_inside(candidates.size());
    parallel::in_batches(static_cast<int>(candidates.size()), batch, 0, [&](int first, int count) {
      for (int i = first; i < first + count; ++i) is_inside[i] = lies_inside(candidates[i]);
    });
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (is_inside[i] != 0) squares_.push_back(candidates[i]);
  }

  const Mesh& mesh_;
  const FieldWalker& walker_;
  double size_;
  std::vector<Square> squares_;
};

/// Tells the squares near vertices without a limit of the stress and near roots of lugs, and which
/// of them touch a weld.
class SiteMarker {
 public:
  SiteMarker(const Mesh& mesh, const PlateFields& fields, double size, std::vector<Square>& squares)
      : mesh_(mesh), fields_(fields), size_(size), squares_(squares) {}

  void mark_corners() {
    const double reach = corner_reach * size_;
    PlaceGrid all(reach);
    for (std::size_t s = 0; s < squares_.size(); ++s)
      all.add(squares_[s].centre_B, static_cast<int>(s));
    const auto near = [&](int from, int to, const auto& mark) {
      visit_near(all, mesh_.vertices[from], mesh_.vertices[to], reach, [&](int s, double distance) {
        if (distance <= reach) mark(squares_[s]);
      });
    };
    for (const auto& [from, to] : fields_.lug_roots)
      near(from, to, [](Square& square) { square.site = SquareSite::corner; });
    for (const int vertex : fields_.singular_vertices)
      near(vertex, vertex, [](Square& square) {
        square.site = SquareSite::corner;
        square.is_near_singularity = true;
      });
    mark_welds();
  }

 private:
  /// Calls visit(square, distance from its centre) for the squares of a grid that lie near a
  /// straight line, and more about it.
  template <typename Visit>
  void visit_near(const PlaceGrid& grid, const Vector3& begin, const Vector3& end, double reach,
                  const Visit& visit) const {
    const Vector3 way = end - begin, around = Vector3::Constant(reach);
    const double length_squared = way.squaredNorm();
    grid.visit(begin.cwiseMin(end) - around, begin.cwiseMax(end) + around, [&](int s) {
      const Vector3 off = squares_[s].centre_B - begin;
      const double share =
          length_squared > 0 ? std::clamp(off.dot(way) / length_squared, 0.0, 1.0) : 0;
      visit(s, (off - share * way).norm());
    });
  }

  /// Squares near corners that touch a joint between plates or a stiffener.
  void mark_welds() {
    PlaceGrid at_corners(corner_reach * size_);
    for (std::size_t s = 0; s < squares_.size(); ++s)
      if (squares_[s].at_corner()) at_corners.add(squares_[s].centre_B, static_cast<int>(s));
    const auto mark = [&](const Vector3& begin, const Vector3& end) {
      visit_near(at_corners, begin, end, beside_weld * size_, [&](int s, double distance) {
        if (distance < beside_weld * squares_[s].size) squares_[s].site = SquareSite::welded_corner;
      });
    };
    for (const PlateField& field : fields_.fields)
      for (const auto& outline : field.outlines)
        for (const FieldEdge& edge : outline)
          if (!edge.is_free) for_each_stretch(edge, mark);
    for (const Beam& beam : mesh_.beams)
      mark(mesh_.vertices[beam.vertices[0]], mesh_.vertices[beam.vertices[1]]);
  }

  /// Calls visit(begin, end) for straight stretches of an edge.
  template <typename Visit>
  void for_each_stretch(const FieldEdge& edge, const Visit& visit) const {
    constexpr int of_curved = 4;
    for (const FieldEdge::Piece& piece : edge.pieces) {
      const Shell& shell = mesh_.shells[piece.shell];
      const int parts = shell.curvature < 0 ? 1 : of_curved;
      const auto place_at = [&](int i) {
        const double share = static_cast<double>(i) / parts;
        return position(mesh_, shell, piece.begin + share * (piece.end - piece.begin));
      };
      for (int i = 0; i < parts; ++i) visit(place_at(i), place_at(i + 1));
    }
  }

  const Mesh& mesh_;
  const PlateFields& fields_;
  double size_;
  std::vector<Square>& squares_;
};

}  // namespace

std::vector<Square> place_squares(const Mesh& mesh, const PlateFields& fields,
                                  const FieldWalker& walker, double size) {
  std::vector<std::vector<Square>> of_fields(fields.fields.size());
  parallel::in_batches(static_cast<int>(of_fields.size()), 1, 0, [&](int field, int) {
    of_fields[field] = SquarePlacer(mesh, walker, size).place(fields.fields[field]);
  });
  std::vector<Square> squares;
  for (const std::vector<Square>& of_field : of_fields)
    squares.insert(squares.end(), of_field.begin(), of_field.end());
  SiteMarker(mesh, fields, size, squares).mark_corners();
  return squares;
}

std::optional<Square> square_about(const Mesh& mesh, const PlateFields& fields,
                                   const FieldWalker& walker, const Vector3& place, double size) {
  const SquarePlacer placer(mesh, walker, size);
  std::optional<Square> nearest;
  for (const PlateField& field : fields.fields) {
    int start = -1;  // the shell of the field that is the nearest by its middle
    double from_middle = std::numeric_limits<double>::infinity(), reach = from_middle;
    for (const int shell : field.shells) {
      const Vector3 middle = position(mesh, mesh.shells[shell], {0.5, 0.5});
      double radius = 0;
      for (const int vertex : mesh.shells[shell].vertices)
        radius = std::max(radius, (mesh.vertices[vertex] - middle).norm());
      const double distance = (place - middle).norm();
      reach = std::min(reach, distance - radius);
      if (distance >= from_middle) continue;
      from_middle = distance;
      start = shell;
    }
    if (start < 0 || reach > 2 * size) continue;
    const std::optional<Square> square = placer.about(field, start, place);
    if (square && (!nearest || (square->centre_B - place).norm() <
                                   (nearest->centre_B - place).norm() - 1e-6 * size))
      nearest = square;
  }
  return nearest;
}

}  // namespace blocklift::structure
