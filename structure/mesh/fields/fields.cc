#include "structure/mesh/fields/fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <queue>
#include <set>
#include <utility>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "structure/mesh/fields/shell_edges.h"
#include "structure/mesh/lugs/solid_lugs.h"

namespace blocklift::structure {

namespace {

/// Where lugs of solids stand: edges of shells, joints as those with lugs of shells are, and the
/// vertices at the ends, their toes.
struct BelowLugs {
  std::set<EdgeKey> edges;
  std::set<int> toes;
  std::vector<std::array<int, 2>> roots;  ///< from toe to toe
};

BelowLugs find_below_lugs(const Mesh& mesh, const EdgeMap& edges) {
  constexpr double same_place = 1e-6;  // m
  BelowLugs below;
  for (const SolidLugBase& base : find_solid_lug_bases(mesh)) {
    below.toes.insert(base.ends.begin(), base.ends.end());  // within a plate, too
    below.roots.push_back(base.ends);
    const Vector3 way = base.to - base.from;
    const auto lies_on = [&](int vertex) {
      const Vector3 off = mesh.vertices[vertex] - base.from;
      const double share = std::clamp(off.dot(way) / way.squaredNorm(), 0.0, 1.0);
      return (off - share * way).norm() < same_place;
    };
    for (const auto& [key, shells] : edges)
      if (lies_on(key.first) && lies_on(key.second)) below.edges.insert(key);
  }
  return below;
}

/// Of one material and, where they meet, of one thickness.
bool same_section(const Mesh& mesh, const EdgeOfShell& a, const EdgeOfShell& b) {
  const auto thickness = [&](const EdgeOfShell& edge) {
    const auto& ends = round_edges[edge.edge];
    return thickness_at(mesh, mesh.shells[edge.shell],
                        0.5 * (corner_place(ends[0]) + corner_place(ends[1])));
  };
  return mesh.section_of(mesh.shells[a.shell]).material ==
             mesh.section_of(mesh.shells[b.shell]).material &&
         std::abs(thickness(a) - thickness(b)) < 1e-6 * thickness(a);
}

/// Does the second shell run round the edge the same way as the first? Then their normals disagree.
bool disagree(const Mesh& mesh, const EdgeOfShell& a, const EdgeOfShell& b) {
  return vertex_of(mesh, a.shell, round_edges[a.edge][0]) ==
         vertex_of(mesh, b.shell, round_edges[b.edge][0]);
}

double corner_angle(const Mesh& mesh, int shell, int vertex) {
  const Shell& s = mesh.shells[shell];
  for (std::size_t e = 0; e < 4; ++e) {
    const int corner = round_edges[e][1];
    if (s.vertices[corner] != vertex) continue;
    // The edges before and after it; of a triangle the one that is a point is passed over.
    int before = round_edges[e][0], after = round_edges[(e + 1) % 4][1];
    if (s.vertices[before] == vertex) before = round_edges[(e + 3) % 4][0];
    if (s.vertices[after] == vertex) after = round_edges[(e + 2) % 4][1];
    const Vector3 here = mesh.vertices[vertex], a = mesh.vertices[s.vertices[before]] - here,
                  b = mesh.vertices[s.vertices[after]] - here;
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return 0;
}

class FieldFinder {
 public:
  FieldFinder(const Mesh& mesh, double kink, const GoesOn& goes_on)
      : mesh_(mesh), edges_(collect_edges(mesh)), below_lugs_(find_below_lugs(mesh, edges_)) {
    const auto joins = [&](const EdgeKey& key, const EdgeOfShell& a, const EdgeOfShell& b) {
      return goes_on ? goes_on(a.shell, b.shell, key.first, key.second) : same_section(mesh, a, b);
    };
    for (const auto& [key, shells] : edges_) {
      const bool is_inside = shells.size() == 2 && meeting(key) == 2 &&
                             joins(key, shells[0], shells[1]) &&
                             kink_between(mesh, shells[0], shells[1]) < kink;
      if (is_inside) {
        inside_.insert(key);
      } else {
        ++structural_edges_[key.first];
        ++structural_edges_[key.second];
      }
    }
  }

  PlateFields find() {
    result_.field_of_shell.assign(mesh_.shells.size(), -1);
    is_flipped_.assign(mesh_.shells.size(), false);
    for (int shell = 0; shell < static_cast<int>(mesh_.shells.size()); ++shell)
      if (result_.field_of_shell[shell] < 0) grow(shell);
    for (PlateField& field : result_.fields) outline(field);
    result_.lug_roots = below_lugs_.roots;
    for (const auto& [key, shells] : edges_)
      if (is_root(shells)) result_.lug_roots.push_back({key.first, key.second});
    result_.singular_vertices.insert(result_.singular_vertices.end(), below_lugs_.toes.begin(),
                                     below_lugs_.toes.end());
    std::sort(result_.singular_vertices.begin(), result_.singular_vertices.end());
    const auto last =
        std::unique(result_.singular_vertices.begin(), result_.singular_vertices.end());
    result_.singular_vertices.erase(last, result_.singular_vertices.end());
    return std::move(result_);
  }

 private:
  /// How many plates meet at an edge; a lug of solids is one.
  std::size_t meeting(const EdgeKey& key) const {
    return edges_.at(key).size() + below_lugs_.edges.count(key);
  }

  /// Do a lug's plate and another one meet?
  bool is_root(const std::vector<EdgeOfShell>& shells) const {
    const auto is_of_lug = [&](const EdgeOfShell& edge) {
      return mesh_.regions[mesh_.shells[edge.shell].region].is_lug;
    };
    const auto of_lugs = std::count_if(shells.begin(), shells.end(), is_of_lug);
    return of_lugs > 0 && of_lugs < static_cast<std::ptrdiff_t>(shells.size());
  }

  void grow(int first) {
    const int number = static_cast<int>(result_.fields.size());
    PlateField& field = result_.fields.emplace_back();
    std::queue<int> open;
    open.push(first);
    result_.field_of_shell[first] = number;
    std::map<int, int> of_region;
    while (!open.empty()) {
      const int shell = open.front();
      open.pop();
      field.shells.push_back(shell);
      field.is_flipped.push_back(is_flipped_[shell]);
      ++of_region[mesh_.shells[shell].region];
      for (int edge = 0; edge < 4; ++edge) {
        const EdgeKey key = key_of(mesh_, {shell, edge});
        if (inside_.count(key) == 0) continue;
        const auto& both = edges_.at(key);
        const EdgeOfShell& other = both[both[0].shell == shell ? 1 : 0];
        if (result_.field_of_shell[other.shell] >= 0) continue;
        result_.field_of_shell[other.shell] = number;
        is_flipped_[other.shell] = is_flipped_[shell] != disagree(mesh_, {shell, edge}, other);
        open.push(other.shell);
      }
    }
    field.region = std::max_element(of_region.begin(), of_region.end(), [](auto& a, auto& b) {
                     return a.second < b.second;
                   })->first;
  }

  /// The edge that follows on the outline of one shell, in the field's sense of rotation.
  EdgeOfShell next(const EdgeOfShell& edge) const {
    const int step = is_flipped_[edge.shell] ? 3 : 1;
    EdgeOfShell following{edge.shell, (edge.edge + step) % 4};
    const EdgeKey key = key_of(mesh_, following);
    if (key.first == key.second) following.edge = (following.edge + step) % 4;
    return following;
  }
  int end_of(const EdgeOfShell& edge) const {
    return vertex_of(mesh_, edge.shell, round_edges[edge.edge][is_flipped_[edge.shell] ? 0 : 1]);
  }

  void outline(PlateField& field) {
    std::set<std::pair<int, int>> visited;  // shell, edge
    for (const int shell : field.shells)
      for (int edge = 0; edge < 4; ++edge) {
        const EdgeKey key = key_of(mesh_, {shell, edge});
        if (key.first == key.second || inside_.count(key) != 0 || visited.count({shell, edge}) != 0)
          continue;
        walk_round(field, {shell, edge}, visited);
      }
  }

  void walk_round(PlateField& field, const EdgeOfShell& start,
                  std::set<std::pair<int, int>>& visited) {
    std::vector<EdgeOfShell> loop;
    std::vector<double> angles;  // at the end of each
    EdgeOfShell edge = start;
    do {
      visited.insert({edge.shell, edge.edge});
      loop.push_back(edge);
      const int vertex = end_of(edge);
      double angle = corner_angle(mesh_, edge.shell, vertex);
      edge = next(edge);
      // Round the vertex through the field, until its outline is met again.
      while (inside_.count(key_of(mesh_, edge)) != 0) {
        const auto& both = edges_.at(key_of(mesh_, edge));
        const EdgeOfShell& other = both[both[0].shell == edge.shell ? 1 : 0];
        angle += corner_angle(mesh_, other.shell, vertex);
        edge = next(other);
      }
      angles.push_back(angle);
    } while (edge.shell != start.shell || edge.edge != start.edge);
    field.outlines.push_back(divide(loop, angles));
  }

  bool is_corner(const EdgeOfShell& before, const EdgeOfShell& after, double angle) const {
    constexpr double straight = 0.09;  // rad
    const auto found = structural_edges_.find(end_of(before));
    return std::abs(angle - std::numbers::pi) > straight || found->second != 2 ||
           meeting(key_of(mesh_, before)) != meeting(key_of(mesh_, after));
  }

  std::vector<FieldEdge> divide(const std::vector<EdgeOfShell>& loop,
                                const std::vector<double>& angles) {
    const std::size_t count = loop.size();
    std::size_t first = 0;  // begins after a corner
    for (std::size_t i = 0; i < count; ++i)
      if (is_corner(loop[i], loop[(i + 1) % count], angles[i])) {
        first = (i + 1) % count;
        break;
      }
    std::vector<FieldEdge> edges(1);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = (first + k) % count;
      append(edges.back(), loop[i]);
      edges.back().angle_at_end = angles[i];
      note_singular(loop[i], loop[(i + 1) % count], angles[i]);
      if (k + 1 < count && is_corner(loop[i], loop[(i + 1) % count], angles[i]))
        edges.emplace_back();
    }
    return edges;
  }

  void note_singular(const EdgeOfShell& before, const EdgeOfShell& after, double angle) {
    const bool is_straight = std::abs(angle - std::numbers::pi) < 0.3;
    if (angle > std::numbers::pi + 0.3 ||
        (is_straight && meeting(key_of(mesh_, before)) != meeting(key_of(mesh_, after))))
      result_.singular_vertices.push_back(end_of(before));
  }

  void append(FieldEdge& edge, const EdgeOfShell& part) const {
    const auto& corners = round_edges[part.edge];
    const bool is_flipped = is_flipped_[part.shell];
    FieldEdge::Piece piece;
    piece.shell = part.shell;
    piece.begin = corner_place(corners[is_flipped ? 1 : 0]);
    piece.end = corner_place(corners[is_flipped ? 0 : 1]);
    piece.from = vertex_of(mesh_, part.shell, corners[is_flipped ? 1 : 0]);
    piece.to = vertex_of(mesh_, part.shell, corners[is_flipped ? 0 : 1]);
    const Shell& shell = mesh_.shells[part.shell];
    const int steps = shell.curvature < 0 ? 1 : 8;
    for (int i = 0; i < steps; ++i) {
      const auto on = [&](double t) -> Eigen::Vector2d {
        return piece.begin + t * (piece.end - piece.begin);
      };
      piece.length += (position(mesh_, shell, on((i + 1.0) / steps)) -
                       position(mesh_, shell, on(static_cast<double>(i) / steps)))
                          .norm();
    }
    edge.length += piece.length;
    edge.is_free = meeting(key_of(mesh_, part)) == 1;
    edge.pieces.push_back(piece);
  }

  const Mesh& mesh_;
  EdgeMap edges_;
  BelowLugs below_lugs_;
  std::set<EdgeKey> inside_;             ///< edges within fields
  std::map<int, int> structural_edges_;  ///< how many other edges meet in a vertex
  std::vector<bool> is_flipped_;
  PlateFields result_;
};

}  // namespace

PlateFields find_fields(const Mesh& mesh, double kink, const GoesOn& goes_on) {
  return FieldFinder(mesh, kink, goes_on).find();
}

FieldWalker::FieldWalker(const Mesh& mesh, const PlateFields& fields)
    : mesh_(mesh), neighbours_(mesh.shells.size(), {-1, -1, -1, -1}) {
  for (const auto& [key, shells] : collect_edges(mesh)) {
    if (shells.size() != 2 ||
        fields.field_of_shell[shells[0].shell] != fields.field_of_shell[shells[1].shell])
      continue;
    neighbours_[shells[0].shell][shells[0].edge] = shells[1].shell;
    neighbours_[shells[1].shell][shells[1].edge] = shells[0].shell;
  }
}

namespace {

/// Where a place lies over a shell, and how far outside, by its edges in their order: eta < 0, xi >
/// 1, eta > 1, xi < 0. The edge of a triangle that is a point is never passed.
struct OverShell {
  Eigen::Vector2d xi;
  std::array<double, 4> outside{};

  double farthest() const { return *std::max_element(outside.begin(), outside.end()); }
};

constexpr double far_outside = 3;  // of unit coordinates: where a search goes no farther
constexpr int most_iterations = 12;

/// Steps of Newton's method until one is nothing.
template <typename Step>
void iterate(const Step& step) {
  for (int newton = 0; newton < most_iterations; ++newton)
    if (step().cwiseAbs().maxCoeff() < 1e-10) return;
}

Eigen::Vector2d least_squares(const Eigen::Matrix<double, 3, 2>& g, const Vector3& missed) {
  return algebra::solve_symmetric<2>(g.transpose() * g, g.transpose() * missed);
}

OverShell over_square(const Mesh& mesh, int shell, const Vector3& place,
                      const Eigen::Vector2d& start) {
  OverShell over{start, {}};
  iterate([&]() -> Eigen::Vector2d {
    Eigen::Vector2d change = least_squares(tangents(mesh, shell, over.xi),
                                           place - position(mesh, mesh.shells[shell], over.xi));
    over.xi = (over.xi + change).cwiseMax(1 - far_outside).cwiseMin(far_outside);
    return change;
  });
  over.outside = {-over.xi.y(), over.xi.x() - 1, over.xi.y() - 1, -over.xi.x()};
  return over;
}

/// By area coordinates: xi has no meaning at the point that an edge has become, and eta leads
/// nowhere beyond it. There a curved triangle goes on straight.
OverShell over_triangle(const Mesh& mesh, int shell, const Vector3& place) {
  constexpr double last_eta = 0.999;  // of a curved one; tangents end at 1
  const Shell& triangle = mesh.shells[shell];
  const Vector3& origin = mesh.vertices[triangle.vertices[0]];
  Eigen::Matrix<double, 3, 2> sides;
  sides << mesh.vertices[triangle.vertices[1]] - origin,
      mesh.vertices[triangle.vertices[2]] - origin;
  // Shares of the second and the third vertex.
  Eigen::Vector2d shares = least_squares(sides, place - origin);
  const auto unit_place = [&](double most_eta) {
    if (shares[1] > most_eta) return Eigen::Vector2d(0.5, most_eta);
    return Eigen::Vector2d(shares[1] < 1 ? shares[0] / (1 - shares[1]) : 0.5, shares[1]);
  };
  if (triangle.curvature >= 0) {
    const auto within_reach = [](const Eigen::Vector2d& any) -> Eigen::Vector2d {
      return any.cwiseMax(1 - far_outside).cwiseMin(far_outside);
    };
    shares = within_reach(shares);
    iterate([&]() -> Eigen::Vector2d {
      const Eigen::Vector2d xi = unit_place(last_eta);
      const Eigen::Matrix<double, 3, 2> g = tangents(mesh, shell, xi);
      Eigen::Matrix<double, 3, 2> by_shares;
      by_shares.col(0) = g.col(0) / (1 - xi.y());
      by_shares.col(1) = g.col(1) + xi.x() * by_shares.col(0);
      const Eigen::Vector2d beyond = shares - Eigen::Vector2d(xi.x() * (1 - xi.y()), xi.y());
      Eigen::Vector2d change =
          least_squares(by_shares, place - position(mesh, triangle, xi) - by_shares * beyond);
      shares = within_reach(shares + change);
      return change;
    });
  }
  return {unit_place(1), {-shares[1], shares.sum() - 1, -far_outside, -shares[0]}};
}

OverShell over_shell(const Mesh& mesh, int shell, const Vector3& place,
                     const Eigen::Vector2d& start) {
  return mesh.shells[shell].is_triangle() ? over_triangle(mesh, shell, place)
                                          : over_square(mesh, shell, place, start);
}

constexpr double on_edge = 1e-6;  // of a shell's size

/// Height of a shell over its longest edge, m: what a step may have that passes into the next one.
double height_of(const Mesh& mesh, int shell) {
  const Shell& s = mesh.shells[shell];
  const auto side = [&](int from, int to) -> Vector3 {
    return mesh.vertices[s.vertices[to]] - mesh.vertices[s.vertices[from]];
  };
  // Of a triangle the last two are one, so that both diagonals span all of it.
  const double area = 0.5 * side(0, 3).cross(side(1, 2)).norm();
  const double height = area / longest_edge(mesh, s);
  return s.is_triangle() ? 2 * height : height;
}

}  // namespace

std::optional<ShellPlace> FieldWalker::find(const Vector3& place, const ShellPlace& start) const {
  const auto found = walk(place, start);
  return found ? found : march(place, start);
}

std::optional<ShellPlace> FieldWalker::march(const Vector3& place, const ShellPlace& start) const {
  constexpr int most_steps = 10000;
  const Vector3 begin = position(mesh_, mesh_.shells[start.shell], start.xi);
  const double length = (place - begin).norm();
  ShellPlace here = start;
  double gone = 0;
  for (int step = 0; step < most_steps; ++step) {
    gone += height_of(mesh_, here.shell);
    const bool is_last = !(gone < length);
    if (is_last && step == 0) return std::nullopt;  // the way that was gone already
    auto found = walk(is_last ? place : begin + gone / length * (place - begin), here);
    if (!found || is_last) return found;
    here = *found;
  }
  return std::nullopt;
}

std::optional<ShellPlace> FieldWalker::walk(const Vector3& place, const ShellPlace& start) const {
  constexpr int most_steps = 400;
  ShellPlace here = start;
  int came_from = -1;
  for (int step = 0; step < most_steps; ++step) {
    const OverShell over = over_shell(mesh_, here.shell, place, here.xi);
    if (over.farthest() <= on_edge)
      return ShellPlace{here.shell, over.xi.cwiseMax(0.0).cwiseMin(1.0)};
    int next = -1;
    double most = on_edge;
    for (std::size_t e = 0; e < 4; ++e) {
      const int neighbour = neighbours_[here.shell][e];
      if (neighbour < 0 || over.outside[e] <= most || neighbour == came_from) continue;
      next = neighbour;
      most = over.outside[e];
    }
    if (next < 0) return std::nullopt;
    came_from = here.shell;
    here = {next, {0.5, 0.5}};
  }
  return std::nullopt;
}

}  // namespace blocklift::structure
