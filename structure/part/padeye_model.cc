#include "structure/part/padeye_model.h"

#include <utility>

#include <Eigen/Dense>

#include "structure/mesh/files/part_reader.h"

namespace blocklift::structure {

PadeyeModel::PadeyeModel(const PadeyeGeometry& padeye, const Material& material, int divisions)
    : geometry_(padeye) {
  PadeyeMesh mesh = make_padeye_mesh(padeye, divisions);
  columns_ = std::move(mesh.columns);
  part_.mesh = make_part_mesh(mesh.mesh);
  // Two materials of one kind, so that stresses are not averaged from plate to plate.
  part_.materials = {material, material};
  part_.materials[0].name = "main";
  part_.materials[1].name = "cheeks";
  solids_of_column_ = solids_of_columns(part_.mesh, columns_);
  part_.material_of_solid.resize(part_.mesh.solids.size());
  for (std::size_t c = 0; c < columns_.size(); ++c)
    for (const int solid : solids_of_column_[c])
      part_.material_of_solid[solid] = columns_[c].plate == PadeyePlate::main ? 0 : 1;
  part_.supports = {{"base", "base", {true, true, true}, Vector3::Zero()}};
  std::vector<int> support_of;
  const std::vector<FixedUnknown> fixed = part_supports(part_, support_of);
  for (std::size_t i = 0; i < fixed.size(); i += 3) base_nodes_.push_back(fixed[i].unknown / 3);
  unknowns_ = std::make_unique<PartUnknowns>(part_.mesh);
  system_ = std::make_unique<ConstrainedSystem>(assemble_part_stiffness(part_, *unknowns_),
                                                unknowns_->to_unknowns(fixed));
  system_->factorise();
}

Eigen::VectorXd PadeyeModel::load_vector(const PadeyeLoad& load) const {
  PartModel loaded;
  loaded.mesh = part_.mesh;
  loaded.materials = part_.materials;
  loaded.material_of_solid = part_.material_of_solid;
  SurfaceLoad bearing;
  bearing.name = "pin";
  bearing.group = "hole";
  bearing.kind = SurfaceLoad::Kind::bearing;
  bearing.vector = load.force;
  loaded.surface_loads = {bearing};
  loaded.body_loads = {
      {"weight", load.gravity_less_acceleration, Vector3::Zero(), Vector3::Zero()}};
  return part_load(loaded);
}

PadeyeResult PadeyeModel::solve(const PadeyeLoad& load) const {
  PadeyeResult result;
  const Eigen::VectorXd loads = load_vector(load), forces = unknowns_->forces_on_unknowns(loads);
  const Eigen::VectorXd given =
      load.base_displacement.size() > 0
          ? load.base_displacement
          : Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(base_nodes_.size()));
  const Eigen::VectorXd found = system_->solve(forces, given);
  result.displacement = unknowns_->to_freedoms(found);
  find_balance(loads, system_->reactions(found, forces), result);
  static_cast<PadeyeStress&>(result) =
      find_padeye_stress(geometry_, columns_, solids_of_column_, part_, result.displacement);
  return result;
}

void PadeyeModel::find_balance(const Eigen::VectorXd& load, const Eigen::VectorXd& reactions,
                               PadeyeResult& result) const {
  const Wrench applied = resultant(part_.mesh.nodes, load);
  double magnitude = 0;
  for (Eigen::Index n = 0; n < part_.mesh.nodes.cols(); ++n)
    magnitude += load.segment<3>(3 * n).norm();
  for (std::size_t i = 0; i < base_nodes_.size(); ++i) {
    const Vector3 force = reactions.segment<3>(3 * static_cast<Eigen::Index>(i));
    result.reaction.force += force;
    result.reaction.moment += part_.mesh.nodes.col(base_nodes_[i]).cross(force);
  }
  if (!(magnitude > 0)) return;
  result.force_residual = (applied.force + result.reaction.force).norm() / magnitude;
  result.moment_residual =
      (applied.moment + result.reaction.moment).norm() / (magnitude * geometry_.height);
}

PartSolution PadeyeModel::as_part(const PadeyeResult& result) const {
  PartSolution solution;
  solution.displacement = result.displacement;
  solution.stress = recover_part_stress(part_, result.displacement);
  return solution;
}

}  // namespace blocklift::structure
