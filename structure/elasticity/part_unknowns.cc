#include "structure/elasticity/part_unknowns.h"

#include <algorithm>
#include <functional>
#include <utility>

#include <Eigen/SparseCore>

#include "structure/formulation/solid.h"
#include "structure/index.h"

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
          unknowns.take_solid(model.mesh, solid, matrix_of(solid), entries);
        };
      },
      threads);
}

}  // namespace

PartUnknowns::PartUnknowns(const PartMesh& mesh, std::vector<PartTie> ties)
    : ties_(std::move(ties)) {
  const int solids = static_cast<int>(mesh.solids.size());
  std::vector<std::vector<int>> members(mesh.solids.size());
  const int nodes = static_cast<int>(mesh.nodes.cols());
  if (ties_.empty()) {
    for (int s = 0; s < solids; ++s)
      for (int i = 0; i < mesh.kind(mesh.solids[s]).nodes; ++i)
        members[s].push_back(mesh.node(mesh.solids[s], i));
    elimination_ = tripled(find_elimination(nodes, members));
    return;
  }
  tie_of_.assign(at(3 * nodes), -1);
  for (std::size_t t = 0; t < ties_.size(); ++t) tie_of_[ties_[t].freedom] = static_cast<int>(t);
  for (int s = 0; s < solids; ++s)
    for (const int freedom : freedoms_of_solid(mesh, s)) {
      const int tie = tie_of_[freedom];
      if (tie < 0)
        members[s].push_back(freedom);
      else
        members[s].insert(members[s].end(), ties_[tie].followed.begin(), ties_[tie].followed.end());
    }
  elimination_ = find_elimination(3 * nodes, members);
}

std::vector<int> PartUnknowns::freedoms_of_solid(const PartMesh& mesh, int solid) const {
  const int element = mesh.solids[solid];
  std::vector<int> freedoms;
  for (int i = 0; i < mesh.kind(element).nodes; ++i)
    for (int a = 0; a < 3; ++a) freedoms.push_back(3 * mesh.node(element, i) + a);
  return freedoms;
}

void PartUnknowns::take_solid(const PartMesh& mesh, int solid, const Eigen::MatrixXd& matrix,
                              ElementEntries& entries) const {
  const std::vector<int> freedoms = freedoms_of_solid(mesh, solid);
  std::vector<int> unknowns;
  if (std::none_of(freedoms.begin(), freedoms.end(),
                   [&](int freedom) { return !ties_.empty() && tie_of_[freedom] >= 0; })) {
    for (const int freedom : freedoms) unknowns.push_back(of(freedom));
    take_entries(unknowns, matrix, entries);
    return;
  }
  std::vector<Eigen::Triplet<double>> shares;  // of T: rows freedoms, columns unknowns
  for (std::size_t i = 0; i < freedoms.size(); ++i) {
    const int row = static_cast<int>(i), tie = tie_of_[freedoms[i]];
    const auto add = [&](int freedom, double share) {
      shares.emplace_back(row, static_cast<int>(unknowns.size()), share);
      unknowns.push_back(of(freedom));
    };
    if (tie < 0) add(freedoms[i], 1);
    for (std::size_t j = 0; tie >= 0 && j < ties_[tie].followed.size(); ++j)
      add(ties_[tie].followed[j], ties_[tie].shares[j]);
  }
  Eigen::SparseMatrix<double> T(static_cast<Eigen::Index>(freedoms.size()),
                                static_cast<Eigen::Index>(unknowns.size()));
  T.setFromTriplets(shares.begin(), shares.end());
  take_entries(unknowns, T.transpose() * Eigen::MatrixXd(matrix * T), entries);
}

Eigen::MatrixXd PartUnknowns::to_unknowns(
    const Eigen::Ref<const Eigen::MatrixXd>& by_freedoms) const {
  Eigen::MatrixXd result(count(), by_freedoms.cols());
  for (int f = 0; f < freedoms(); ++f)
    if (of(f) >= 0) result.row(of(f)) = by_freedoms.row(f);
  return result;
}

Eigen::VectorXd PartUnknowns::forces_on_unknowns(const Eigen::VectorXd& by_freedoms) const {
  Eigen::VectorXd result = to_unknowns(by_freedoms);
  for (const PartTie& tie : ties_)
    for (std::size_t j = 0; j < tie.followed.size(); ++j)
      result[of(tie.followed[j])] += tie.shares[j] * by_freedoms[tie.freedom];
  return result;
}

Eigen::MatrixXd PartUnknowns::to_freedoms(
    const Eigen::Ref<const Eigen::MatrixXd>& by_unknowns) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(freedoms(), by_unknowns.cols());
  for (int f = 0; f < freedoms(); ++f)
    if (of(f) >= 0) result.row(f) = by_unknowns.row(of(f));
  for (const PartTie& tie : ties_)
    for (std::size_t j = 0; j < tie.followed.size(); ++j)
      result.row(tie.freedom) += tie.shares[j] * by_unknowns.row(of(tie.followed[j]));
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
