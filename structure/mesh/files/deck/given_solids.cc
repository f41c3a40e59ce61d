#include "structure/mesh/files/deck/given_solids.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/files/deck/parted_edges.h"
#include "structure/mesh/quarter_points.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Makes a solid whole; was it turned?
bool complete(Mesh& mesh, Solid& solid, SolidEdgeMiddles& middles) {
  const std::vector<int> given = solid.vertices;
  complete_solid(mesh, solid, middles);
  return !std::equal(given.begin(), given.begin() + topology_of(solid.shape).corners,
                     solid.vertices.begin());
}

/// Pairs of opposite faces, corners of one over those of the other.
struct OppositeFaces {
  std::vector<int> lower, upper;
};

const std::vector<OppositeFaces>& opposite_faces(SolidShape shape) {
  static const std::vector<OppositeFaces> none, of_wedge{{{0, 1, 2}, {3, 4, 5}}},
      of_hexahedron{
          {{0, 1, 2, 3}, {4, 5, 6, 7}}, {{0, 1, 5, 4}, {3, 2, 6, 7}}, {{1, 2, 6, 5}, {0, 3, 7, 4}}};
  if (shape == SolidShape::hexahedron) return of_hexahedron;
  return shape == SolidShape::wedge ? of_wedge : none;
}

/// Is a face turned against the opposite one by a quarter or more? The Jacobian may be positive
/// everywhere then. Judged by the mean cosine between edges over one another, which bent solids,
/// whose faces lean to one another, keep by the edges that they lean about.
bool is_twisted(const Mesh& mesh, const Solid& solid) {
  constexpr double least_cosine = 0.2;
  const auto edge = [&](const std::vector<int>& face, std::size_t i) -> Vector3 {
    const int from = solid.vertices[face[i]], to = solid.vertices[face[(i + 1) % face.size()]];
    return (mesh.vertices[to] - mesh.vertices[from]).normalized();
  };
  for (const OppositeFaces& faces : opposite_faces(solid.shape)) {
    double cosines = 0;
    for (std::size_t i = 0; i < faces.lower.size(); ++i)
      cosines += edge(faces.lower, i).dot(edge(faces.upper, i));
    if (cosines < least_cosine * static_cast<double>(faces.lower.size())) return true;
  }
  return false;
}

/// Where a folded solid has the middle of an edge at its quarter or beyond; empty if nowhere.
std::string describe_quarter_middle(const Mesh& mesh, const Solid& solid) {
  constexpr double rounding = 2.5e-4;  // of coordinates: QuarterMiddle
  const auto middle = quarter_middle_of(mesh, solid);
  // One that is only near the quarter folds nothing: there the Jacobian is small, not below zero.
  if (!middle || middle->share > 0.25 + rounding) return {};
  return fmt::format(
      "; the middle of an edge at ({:.4g}, {:.4g}, {:.4g}) m is {:.3g} of the edge "
      "from a corner, where more than a quarter is due",
      middle->place.x(), middle->place.y(), middle->place.z(), middle->share);
}

void refuse_folded_solids(const Mesh& mesh, const std::vector<GivenSolid>& given, DeckLog& log) {
  constexpr int most_named = 10;
  int count = 0;
  for (std::size_t s = 0; s < mesh.solids.size(); ++s) {
    const Solid& solid = mesh.solids[s];
    const bool is_folded_solid = !(least_jacobian_ratio(mesh, solid) > 0);
    if (!is_folded_solid && !is_twisted(mesh, solid)) continue;
    if (++count > most_named)
      log.complain(given[s].line,
                   fmt::format("{}: one more element is folded or twisted", given[s].card));
    else if (is_folded_solid)
      log.complain(given[s].line,
                   fmt::format("{}: element {} is folded or has no volume: its Jacobian is not "
                               "positive everywhere; are its nodes in their order, and the middles "
                               "of its edges where they belong?{}",
                               given[s].card, solid.label, describe_quarter_middle(mesh, solid)));
    else
      log.complain(given[s].line,
                   fmt::format("{}: element {} is twisted: two opposite faces are turned against "
                               "each other; are the nodes of both in the same order?",
                               given[s].card, solid.label));
  }
}

void refuse_parted_edges(const Mesh& mesh, const std::vector<GivenSolid>& given, DeckLog& log) {
  PartedEdges edges(mesh, log);
  for (std::size_t s = 0; s < mesh.solids.size(); ++s) {
    const Solid& solid = mesh.solids[s];
    const SolidTopology& topology = topology_of(solid.shape);
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      edges.take({solid.vertices[topology.edges[e][0]], solid.vertices[topology.edges[e][1]],
                  solid.vertices[at(topology.corners) + e], solid.label, given[s].card,
                  given[s].line});
  }
}

}  // namespace

void complete_solids(Deck& deck, const std::vector<GivenSolid>& given, DeckLog& log) {
  Mesh& mesh = deck.mesh;
  deck.own_vertices = static_cast<int>(mesh.vertices.size());
  SolidEdgeMiddles middles(mesh);
  int turned = 0;
  std::size_t first = mesh.solids.size();
  // First those that tell their edges' middles, which others have in common with them.
  for (const bool is_told : {true, false})
    for (std::size_t s = 0; s < mesh.solids.size(); ++s) {
      if (given[s].tells_middles != is_told || !complete(mesh, mesh.solids[s], middles)) continue;
      ++turned;
      first = std::min(first, s);
    }
  if (turned > 0)
    log.remark(
        given[first].line,
        fmt::format("{} {} numbered inside out, element {} the first: their volume would be "
                    "negative, and they are turned; their faces keep their numbers",
                    turned, turned == 1 ? "solid is" : "solids are", mesh.solids[first].label));
  refuse_folded_solids(mesh, given, log);
  refuse_parted_edges(mesh, given, log);
}

}  // namespace blocklift::structure
