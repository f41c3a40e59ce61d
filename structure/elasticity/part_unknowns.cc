#include "structure/elasticity/part_unknowns.h"

#include <functional>

#include "structure/formulation/solid.h"
#include "structure/system/assembly.h"

namespace blocklift::structure {

namespace {

/// The order for three unknowns in place of each one.
Elimination tripled(const Elimination& of_nodes) {
  Elimination result;
  result.count = 3 * of_nodes.count;
  result.groups = of_nodes.groups;
  for (UnknownGroup& group : result.groups) {
    group.first *= 3;
    group.count *= 3;
  }
  result.groups_of_elements = of_nodes.groups_of_elements;
  result.place.reserve(3 * of_nodes.place.size());
  for (const int place : of_nodes.place)
    for (int a = 0; a < 3; ++a) result.place.push_back(place < 0 ? -1 : 3 * place + a);
  return result;
}

SparseLower assemble_solids(const PartModel& model, const PartUnknowns& unknowns, int threads,
                            const std::function<Eigen::MatrixXd(int solid)>& matrix_of) {
  return assemble(
      unknowns.elimination(),
      [&]() -> FindEntries {
        return [&](int solid, ElementEntries& entries) {
          take_entries(unknowns.of_solid(model.mesh, solid), matrix_of(solid), entries);
        };
      },
      threads);
}

}  // namespace

PartUnknowns::PartUnknowns(const PartMesh& mesh) {
  std::vector<std::vector<int>> nodes(mesh.solids.size());
  for (std::size_t s = 0; s < mesh.solids.size(); ++s)
    for (int i = 0; i < mesh.kind(mesh.solids[s]).nodes; ++i)
      nodes[s].push_back(mesh.node(mesh.solids[s], i));
  elimination_ = tripled(find_elimination(static_cast<int>(mesh.nodes.cols()), nodes));
}

std::vector<int> PartUnknowns::of_solid(const PartMesh& mesh, int solid) const {
  const int element = mesh.solids[solid];
  std::vector<int> unknowns;
  for (int i = 0; i < mesh.kind(element).nodes; ++i)
    for (int a = 0; a < 3; ++a) unknowns.push_back(of(3 * mesh.node(element, i) + a));
  return unknowns;
}

Eigen::MatrixXd PartUnknowns::to_unknowns(
    const Eigen::Ref<const Eigen::MatrixXd>& by_freedoms) const {
  Eigen::MatrixXd result(count(), by_freedoms.cols());
  for (int f = 0; f < freedoms(); ++f)
    if (of(f) >= 0) result.row(of(f)) = by_freedoms.row(f);
  return result;
}

Eigen::MatrixXd PartUnknowns::to_freedoms(
    const Eigen::Ref<const Eigen::MatrixXd>& by_unknowns) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(freedoms(), by_unknowns.cols());
  for (int f = 0; f < freedoms(); ++f)
    if (of(f) >= 0) result.row(f) = by_unknowns.row(of(f));
  return result;
}

std::vector<FixedUnknown> PartUnknowns::to_unknowns(
    const std::vector<FixedUnknown>& fixed_freedoms) const {
  std::vector<FixedUnknown> fixed;
  for (const FixedUnknown& freedom : fixed_freedoms)
    if (of(freedom.unknown) >= 0) fixed.push_back({of(freedom.unknown), freedom.value});
  return fixed;
}

SparseLower assemble_part_stiffness(const PartModel& model, const PartUnknowns& unknowns,
                                    int threads) {
  return assemble_solids(model, unknowns, threads,
                         [&](int solid) { return part_element_stiffness(model, solid); });
}

SparseLower assemble_part_mass(const PartModel& model, const PartUnknowns& unknowns, int threads) {
  return assemble_solids(model, unknowns, threads, [&](int solid) {
    const int element = model.mesh.solids[solid];
    return solid_mass(model.mesh.kind(element), model.mesh.places(element),
                      model.materials[model.material_of_solid[solid]].density);
  });
}

}  // namespace blocklift::structure
