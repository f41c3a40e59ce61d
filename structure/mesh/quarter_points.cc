#include "structure/mesh/quarter_points.h"

#include <array>
#include <cstddef>
#include <utility>

#include "structure/index.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

using Found = std::optional<QuarterMiddle>;

/// Keeps the one that is nearer to its end.
bool keep_nearer(Found& kept, const Found& other) {
  if (!other || (kept && kept->share <= other->share)) return false;
  kept = other;
  return true;
}

/// Corners at the ends of the edges whose middles a kind of solid has, in their order.
std::vector<std::array<int, 2>> ends_of_edges(const ElementKind& kind) {
  std::vector<std::array<int, 2>> ends;
  for (const int middle : kind.edge_order) {
    std::array<int, 2> nearest{0, 1};
    double least = 1e300;
    for (int a = 0; a < kind.corners; ++a)
      for (int b = a + 1; b < kind.corners; ++b) {
        const double off =
            (kind.local.col(a) + kind.local.col(b) - 2 * kind.local.col(middle)).norm();
        if (off < least) {
          least = off;
          nearest = {a, b};
        }
      }
    ends.push_back(nearest);
  }
  return ends;
}

}  // namespace

std::optional<QuarterMiddle> quarter_middle(const Vector3& from, const Vector3& to,
                                            const Vector3& middle) {
  constexpr double least_slope = 0.1;
  const Vector3 line = to - from;
  const double square = line.squaredNorm();
  if (!(square > 0)) return std::nullopt;
  const double along = (middle - from).dot(line) / square;
  QuarterMiddle found;
  found.place = middle;
  found.is_at_second_end = along > 0.5;
  found.share = found.is_at_second_end ? 1 - along : along;
  const Vector3& near = found.is_at_second_end ? to : from;
  const Vector3& far = found.is_at_second_end ? from : to;
  const Vector3 slope = 4 * middle - 3 * near - far;
  if (!found.is_beyond() && slope.squaredNorm() > least_slope * least_slope * square)
    return std::nullopt;
  return found;
}

std::optional<QuarterMiddle> quarter_middle_of(const Mesh& mesh, const Shell& shell) {
  if (shell.curvature < 0) return std::nullopt;
  const Eigen::Matrix3Xd& points = mesh.curved_shells[shell.curvature];
  if (points.cols() != 9) return std::nullopt;
  static constexpr std::array<std::array<int, 3>, 4> edges{
      {{0, 1, 2}, {6, 7, 8}, {0, 3, 6}, {2, 5, 8}}};
  Found nearest;
  for (const auto& [from, middle, to] : edges)
    keep_nearer(nearest, quarter_middle(points.col(from), points.col(to), points.col(middle)));
  return nearest;
}

std::optional<QuarterMiddle> quarter_middle_of(const Mesh& mesh, const Solid& solid) {
  const SolidTopology& topology = topology_of(solid.shape);
  const auto place = [&](std::size_t node) -> const Vector3& {
    return mesh.vertices[solid.vertices[node]];
  };
  Found nearest;
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    keep_nearer(nearest,
                quarter_middle(place(at(topology.edges[e][0])), place(at(topology.edges[e][1])),
                               place(at(topology.corners) + e)));
  return nearest;
}

std::vector<QuarterMiddleOfElement> find_quarter_middles(const PartMesh& mesh) {
  std::vector<std::vector<std::array<int, 2>>> ends;
  for (const ElementKind& kind : mesh.kinds)
    ends.push_back(kind.dimension == 3 && kind.order == 2 ? ends_of_edges(kind)
                                                          : std::vector<std::array<int, 2>>());
  std::vector<QuarterMiddleOfElement> all;
  for (const int element : mesh.solids) {
    const auto& edges = ends[at(mesh.elements[element].kind)];
    Found nearest;
    int corner = 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto node = [&](int local) -> Vector3 {
        return mesh.nodes.col(mesh.node(element, local));
      };
      const auto [from, to] = edges[e];
      const Found found =
          quarter_middle(node(from), node(to), node(mesh.kind(element).edge_order[e]));
      if (keep_nearer(nearest, found)) corner = found->is_at_second_end ? to : from;
    }
    if (nearest) all.push_back({*nearest, element, corner});
  }
  return all;
}

}  // namespace blocklift::structure
