#include "structure/practice/plate_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <queue>
#include <utility>

#include <Eigen/Dense>

namespace blocklift::structure {

namespace {

using Eigen::Vector2d;

double cross_2(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Closed outline, the plate on its left: turns right at re-entrant corners.
using PlateOutline = std::vector<Vector2d>;

double enclosed_by(const PlateOutline& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross_2(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return twice / 2;
}

struct PlateRectangle {
  double area = 1e300, longer = 0;
};

/// The smallest rectangle about points, of those that lie as the axes do or turned by steps of 5
/// degrees.
PlateRectangle rectangle_about(const std::vector<Vector2d>& points) {
  constexpr int steps = 18;
  PlateRectangle best;
  for (int step = 0; step < steps; ++step) {
    const double angle = std::numbers::pi / 2 * step / steps;
    const Vector2d e_1(std::cos(angle), std::sin(angle)), e_2(-e_1.y(), e_1.x());
    Vector2d lower = Vector2d::Constant(1e300), upper = -lower;
    for (const Vector2d& point : points) {
      const Vector2d place(e_1.dot(point), e_2.dot(point));
      lower = lower.cwiseMin(place);
      upper = upper.cwiseMax(place);
    }
    const Vector2d sides = upper - lower;
    if (sides.prod() < best.area * (1 - 1e-9)) best = {sides.prod(), sides.maxCoeff()};
  }
  return best;
}

/// Straight cut from a corner of an outline into the plate, as far as the outline.
struct CutRay {
  Vector2d from = Vector2d::Zero(), along = Vector2d::Zero();
  double length = 0;

  double reach(const Vector2d& place) const { return along.dot(place - from); }
  double left(const Vector2d& place) const { return cross_2(along, place - from); }
};

/// Up to two rays that part a plate together.
using CutRays = std::vector<CutRay>;

/// The outlines that count: the outer one, and a hole larger than half of what it encloses.
std::vector<PlateOutline> outlines_that_count(const Mesh& mesh, const PlateField& field,
                                              const FieldAxes& axes, const BucklingFields& known) {
  std::vector<PlateOutline> all;
  for (const auto& outline : field.outlines) {
    PlateOutline& polygon = all.emplace_back();
    for (const FieldEdge& edge : outline)
      for (const FieldEdge::Piece& piece : edge.pieces) {
        const Vector2d place = axes.in_plane(known.place(mesh, piece.from));
        if (polygon.empty() || (place - polygon.back()).norm() > 1e-9) polygon.push_back(place);
      }
  }
  double largest = 0;
  for (const PlateOutline& polygon : all) largest = std::max(largest, enclosed_by(polygon));
  std::erase_if(all, [&](const PlateOutline& polygon) {
    const double area = enclosed_by(polygon);
    return polygon.size() < 3 || (area < largest && area > -largest / 2);
  });
  return all;
}

/// Where rays may begin and how they run.
class CutFinder {
 public:
  explicit CutFinder(std::vector<PlateOutline> outlines) : outlines_(std::move(outlines)) {
    for (const PlateOutline& outline : outlines_) collect(outline);
  }
  const std::vector<CutRays>& candidates() const { return candidates_; }

 private:
  static constexpr double sharp = 0.35;   // rad, 20 degrees: lines go on from a corner's edges
  static constexpr double smooth = 0.01;  // less is rounding
  static constexpr std::size_t most_smooth = 24;  // cuts into the inside of a bend

  void collect(const PlateOutline& outline) {
    const std::size_t count = outline.size();
    const auto run = [&](std::size_t i) -> Vector2d {  // after corner i
      return (outline[(i + 1) % count] - outline[i]).normalized();
    };
    std::vector<std::size_t> corners, bends;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d before = run((i + count - 1) % count), after = run(i);
      const double turn = std::atan2(-cross_2(before, after), before.dot(after));
      if (turn > smooth) bends.push_back(i);
      if (turn > sharp) corners.push_back(i);
    }
    for (const std::size_t i : corners) {
      add({ray(outline[i], run((i + count - 1) % count))});
      add({ray(outline[i], -run(i))});
    }
    // The strip beside all that lies between two corners that follow one another.
    for (std::size_t k = 0; corners.size() > 1 && k < corners.size(); ++k) {
      const std::size_t i = corners[k], j = corners[(k + 1) % corners.size()];
      add({ray(outline[i], -run(i)), ray(outline[j], run((j + count - 1) % count))});
    }
    const std::size_t step = bends.size() / most_smooth + 1;
    for (std::size_t k = 0; k < bends.size(); k += step) {
      const std::size_t i = bends[k];
      add({ray(outline[i], (run((i + count - 1) % count) - run(i)).normalized())});
    }
  }

  void add(CutRays candidate) {
    if (std::all_of(candidate.begin(), candidate.end(),
                    [](const CutRay& one) { return one.length > 0; }))
      candidates_.push_back(std::move(candidate));
  }

  CutRay ray(const Vector2d& from, const Vector2d& along) const {
    CutRay result{from, along, 1e300};
    for (const PlateOutline& outline : outlines_)
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector2d& a = outline[i];
        const Vector2d run = outline[(i + 1) % outline.size()] - a;
        const double sine = cross_2(along, run);
        if (std::abs(sine) < 1e-9 * run.norm()) continue;
        const double reach = cross_2(a - from, run) / sine;
        const double share = cross_2(a - from, along) / sine;
        if (share > -1e-9 && share < 1 + 1e-9 && reach > 1e-6 * run.norm())
          result.length = std::min(result.length, reach);
      }
    if (result.length == 1e300) result.length = 0;
    return result;
  }

  std::vector<PlateOutline> outlines_;
  std::vector<CutRays> candidates_;
};

/// Edge within a field between two of its shells, by their places in it.
struct InnerEdge {
  EdgeKey key;
  std::array<std::size_t, 2> shells{};
};

/// Areas of the rectangles about pieces, m^2.
struct AreasAbout {
  double sum = 0, largest = 0;
};

AreasAbout areas_of(const std::vector<PlateRectangle>& rectangles) {
  AreasAbout areas;
  for (const PlateRectangle& rectangle : rectangles) {
    areas.sum += rectangle.area;
    areas.largest = std::max(areas.largest, rectangle.area);
  }
  return areas;
}

/// A cut that is worth its while.
struct WorthyCut {
  PlateCut cut;
  AreasAbout areas;
  double length = 0;  ///< of its rays together, m
};

/// The cut whose rectangles are smallest together, of several that with the largest piece, then
/// that of the shortest rays. Cuts follow shells, so that their figures carry the mesh's grain:
/// those that differ by less than that count as alike, and mirror images of a plate are cut alike
/// whatever their meshes and the turn of their corners.
PlateCut best_of(std::vector<WorthyCut> cuts) {
  constexpr double grain = 5e-3;
  const auto keep = [&](const auto& figure_of) {  // the smaller, the better
    double least = figure_of(cuts.front());
    for (const WorthyCut& one : cuts) least = std::min(least, figure_of(one));
    std::erase_if(cuts, [&](const WorthyCut& one) {
      return figure_of(one) > least + grain * std::abs(least);
    });
  };
  keep([](const WorthyCut& one) { return one.areas.sum; });
  keep([](const WorthyCut& one) { return -one.areas.largest; });
  keep([](const WorthyCut& one) { return one.length; });
  return std::move(cuts.front().cut);
}

/// The shells of a field in its plane.
class FlatField {
 public:
  FlatField(const Mesh& mesh, const PlateField& field, const FieldAxes& axes,
            const BucklingFields& known)
      : mesh_(mesh), field_(field), axes_(axes), known_(known), edges_at_(field.shells.size()) {
    std::set<EdgeKey> outer;
    for (const auto& outline : field.outlines)
      for (const FieldEdge& edge : outline)
        for (const FieldEdge::Piece& piece : edge.pieces)
          outer.insert(std::minmax(piece.from, piece.to));
    std::map<EdgeKey, std::size_t> first;
    for (std::size_t i = 0; i < field.shells.size(); ++i) {
      const ShellShare share = share_of_shell(mesh, field.shells[i], field.is_flipped[i]);
      middles_.push_back(axes.in_plane(share.middle));
      for (int e = 0; e < 4; ++e) {
        const EdgeKey key = key_of(mesh, {field.shells[i], e});
        if (key.first == key.second || outer.count(key) != 0) continue;
        const auto [found, is_new] = first.try_emplace(key, i);
        if (is_new) continue;
        edges_at_[i].push_back(edges_.size());
        edges_at_[found->second].push_back(edges_.size());
        edges_.push_back({key, {found->second, i}});
      }
    }
  }

  /// About all shells, where nothing is cut.
  PlateRectangle rectangle() const {
    PlateCut whole;
    whole.pieces = 1;
    whole.piece_of_shell.assign(field_.shells.size(), 0);
    return rectangles_about(whole).front();
  }

  /// What a cut does; its pieces are 1 where it parts nothing.
  PlateCut cut(const CutRays& rays) const {
    PlateCut result;
    std::vector<bool> is_cut(edges_.size(), false);
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (const CutRay& ray : rays)
        if (crosses(ray, edges_[e])) {
          is_cut[e] = true;
          for (const int vertex : {edges_[e].key.first, edges_[e].key.second})
            result.straightened[vertex] = onto(ray, vertex);
        }
    part(is_cut, result);
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (is_cut[e] &&
          result.piece_of_shell[edges_[e].shells[0]] != result.piece_of_shell[edges_[e].shells[1]])
        result.edges.insert(edges_[e].key);
    return result;
  }

  /// About the pieces of a cut, in their order.
  std::vector<PlateRectangle> rectangles_about(const PlateCut& cut) const {
    std::vector<std::vector<Vector2d>> points(static_cast<std::size_t>(cut.pieces));
    for (std::size_t i = 0; i < field_.shells.size(); ++i)
      for (const int vertex : mesh_.shells[field_.shells[i]].vertices) {
        const auto moved = cut.straightened.find(vertex);
        points[cut.piece_of_shell[i]].push_back(axes_.in_plane(
            moved == cut.straightened.end() ? known_.place(mesh_, vertex) : moved->second));
      }
    std::vector<PlateRectangle> rectangles;
    for (const auto& piece : points) rectangles.push_back(rectangle_about(piece));
    return rectangles;
  }

 private:
  /// The shells' middles lie on both sides of the ray, and the edge beside it.
  bool crosses(const CutRay& ray, const InnerEdge& edge) const {
    if ((ray.left(middles_[edge.shells[0]]) >= 0) == (ray.left(middles_[edge.shells[1]]) >= 0))
      return false;
    const Vector2d a = axes_.in_plane(mesh_.vertices[edge.key.first]),
                   b = axes_.in_plane(mesh_.vertices[edge.key.second]);
    const double reach = ray.reach((a + b) / 2), margin = (b - a).norm() / 2;
    return reach > -margin && reach < ray.length + margin;
  }

  Vector3 onto(const CutRay& ray, int vertex) const {
    const Vector3& place = mesh_.vertices[vertex];
    const double off = ray.left(axes_.in_plane(place));
    return place - off * (-ray.along.y() * axes_.e_1 + ray.along.x() * axes_.e_2);
  }

  void part(const std::vector<bool>& is_cut, PlateCut& result) const {
    result.piece_of_shell.assign(field_.shells.size(), -1);
    for (std::size_t start = 0; start < field_.shells.size(); ++start) {
      if (result.piece_of_shell[start] >= 0) continue;
      const int piece = result.pieces++;
      std::queue<std::size_t> open;
      open.push(start);
      result.piece_of_shell[start] = piece;
      while (!open.empty()) {
        const std::size_t shell = open.front();
        open.pop();
        for (const std::size_t e : edges_at_[shell]) {
          if (is_cut[e]) continue;
          const auto& both = edges_[e].shells;
          const std::size_t other = both[both[0] == shell ? 1 : 0];
          if (result.piece_of_shell[other] >= 0) continue;
          result.piece_of_shell[other] = piece;
          open.push(other);
        }
      }
    }
  }

  const Mesh& mesh_;
  const PlateField& field_;
  const FieldAxes& axes_;
  const BucklingFields& known_;
  std::vector<Vector2d> middles_;
  std::vector<InnerEdge> edges_;
  std::vector<std::vector<std::size_t>> edges_at_;  ///< of each shell
};

}  // namespace

std::optional<PlateCut> find_plate_cut(const Mesh& mesh, const PlateField& field,
                                       const FieldAxes& axes, const BucklingFields& known) {
  constexpr double filled = 0.85, worth_it = 0.93;
  std::vector<PlateOutline> outlines = outlines_that_count(mesh, field, axes, known);
  double enclosed = 0;
  for (const PlateOutline& outline : outlines) enclosed += enclosed_by(outline);
  const FlatField flat(mesh, field, axes, known);
  const PlateRectangle whole = flat.rectangle();
  if (enclosed > filled * whole.area) return std::nullopt;
  std::vector<WorthyCut> cuts;
  const CutFinder finder(std::move(outlines));
  for (const CutRays& rays : finder.candidates()) {
    PlateCut cut = flat.cut(rays);
    if (cut.pieces < 2) continue;
    const AreasAbout areas = areas_of(flat.rectangles_about(cut));
    if (!(areas.sum < worth_it * whole.area)) continue;
    double length = 0;
    for (const CutRay& ray : rays) length += ray.length;
    cuts.push_back({std::move(cut), areas, length});
  }
  if (cuts.empty()) return std::nullopt;
  PlateCut best = best_of(std::move(cuts));
  best.whole_length = whole.longer;
  return best;
}

}  // namespace blocklift::structure
