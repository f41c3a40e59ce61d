#include "structure/mesh/files/deck/given_solids.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

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

void refuse_folded_solids(const Mesh& mesh, const std::vector<GivenSolid>& given, DeckLog& log) {
  constexpr int most_named = 10;
  int count = 0;
  for (std::size_t s = 0; s < mesh.solids.size(); ++s) {
    if (least_jacobian_ratio(mesh, mesh.solids[s]) > 0) continue;
    if (++count <= most_named)
      log.complain(given[s].line,
                   fmt::format("{}: element {} is folded or has no volume: its Jacobian is not "
                               "positive everywhere; are its nodes in their order, and the middles "
                               "of its edges where they belong?",
                               given[s].card, mesh.solids[s].label));
    else
      log.complain(given[s].line, fmt::format("{}: one more element is folded", given[s].card));
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
}

}  // namespace blocklift::structure
