#include "structure/response/padeye_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Dense>

#include "structure/index.h"
#include "structure/mesh/part_reader.h"
#include "structure/response/cell_stress.h"

namespace blocklift::structure {

namespace {

constexpr double patch_side = 0.05;  // m, of the checked stress

Eigen::Vector2d centre_of(const PadeyeMesh::Column& column) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : column.corners) sum += corner;
  return sum / 4;
}

/// In-plane stress (xx, yy, xy) integrated over some material, and its volume.
struct Mean {
  Eigen::Vector3d integral = Eigen::Vector3d::Zero();  ///< Pa m^3
  double volume = 0;                                   ///< m^3

  double von_mises() const {
    const Eigen::Vector3d s = integral / volume;
    return std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]);
  }
};

Mean mean_of(const PartModel& part, const std::vector<int>& solids,
             const Eigen::VectorXd& displacement) {
  Mean mean;
  for (const int solid : solids) {
    const int element = part.mesh.solids[at(solid)];
    const ElementKind& kind = part.mesh.kind(element);
    const auto stress = part_stresses(part, solid, kind.gradients, displacement);
    const Eigen::Matrix3Xd places = part.mesh.places(element);
    for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
      const double volume =
          kind.weights[q] *
          (places * kind.gradients.middleRows<3>(3 * q).transpose()).determinant();
      mean.volume += volume;
      mean.integral += volume * Eigen::Vector3d(stress(0, q), stress(1, q), stress(3, q));
    }
  }
  return mean;
}

void take(Extreme& extreme, double value, const Vector3& point, const char* part) {
  if (value <= extreme.value) return;
  extreme = {value, point, part};
}

}  // namespace

PadeyeModel::PadeyeModel(const PadeyeGeometry& padeye, const Material& material, int divisions)
    : geometry_(padeye) {
  PadeyeMesh mesh = make_padeye_mesh(padeye, divisions);
  columns_ = std::move(mesh.columns);
  part_.mesh = make_part_mesh(mesh.mesh);
  // Two materials of one kind, so that stresses are not averaged from plate to plate.
  part_.materials = {material, material};
  part_.materials[0].name = "main";
  part_.materials[1].name = "cheeks";
  std::map<std::size_t, int> solid_of_tag;
  for (std::size_t s = 0; s < part_.mesh.solids.size(); ++s)
    solid_of_tag[part_.mesh.elements[at(part_.mesh.solids[s])].tag] = static_cast<int>(s);
  part_.material_of_solid.resize(part_.mesh.solids.size());
  for (const PadeyeMesh::Column& column : columns_) {
    solids_of_column_.emplace_back();
    for (const std::size_t tag : column.elements) {
      const int solid = solid_of_tag.at(tag);
      solids_of_column_.back().push_back(solid);
      part_.material_of_solid[at(solid)] = column.plate == PadeyePlate::main ? 0 : 1;
    }
  }
  part_.supports = {{"base", "base", {true, true, true}, Vector3::Zero()}};
  std::vector<int> support_of;
  std::vector<FixedUnknown> fixed = part_supports(part_, support_of);
  for (std::size_t i = 0; i < fixed.size(); i += 3) base_nodes_.push_back(fixed[i].unknown / 3);
  system_ = std::make_unique<ConstrainedSystem>(assemble_part_stiffness(part_), std::move(fixed),
                                                EliminationOrder::found);
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
  const Eigen::VectorXd forces = load_vector(load);
  const Eigen::VectorXd given =
      load.base_displacement.size() > 0
          ? load.base_displacement
          : Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(base_nodes_.size()));
  result.displacement = system_->solve(forces, given);
  find_balance(forces, system_->reactions(result.displacement, forces), result);
  find_stress(result);
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

bool PadeyeModel::is_checked(int column) const {
  return centre_of(columns_[at(column)]).y() > -geometry_.height + geometry_.thickness;
}

void PadeyeModel::find_stress(PadeyeResult& result) const {
  const int count = static_cast<int>(columns_.size());
  std::vector<Mean> means;
  result.column_von_mises.resize(count);
  for (int c = 0; c < count; ++c) {
    means.push_back(mean_of(part_, solids_of_column_[at(c)], result.displacement));
    result.column_von_mises[c] = means.back().von_mises();
  }
  const double reach =
      std::min(patch_side / std::sqrt(std::numbers::pi), geometry_.hole_diameter / 4);
  for (int c = 0; c < count; ++c) {
    if (!is_checked(c)) continue;
    const bool is_main = columns_[at(c)].plate == PadeyePlate::main;
    PadeyePlateStress& plate = is_main ? result.main_plate : result.cheeks;
    const char* name = is_main ? "main plate" : "cheek plate";
    const Eigen::Vector2d centre = centre_of(columns_[at(c)]);
    Mean patch;
    for (int other = 0; other < count; ++other) {
      if (columns_[at(other)].plate != columns_[at(c)].plate ||
          (centre_of(columns_[at(other)]) - centre).norm() > reach)
        continue;
      patch.integral += means[at(other)].integral;
      patch.volume += means[at(other)].volume;
    }
    const auto side = static_cast<double>(columns_[at(c)].plate == PadeyePlate::cheek_front) -
                      static_cast<double>(columns_[at(c)].plate == PadeyePlate::cheek_back);
    const double level = side * (geometry_.thickness + geometry_.cheek_thickness) / 2;
    take(plate.checked_von_mises, patch.von_mises(), {centre.x(), centre.y(), level}, name);
    for (const int solid : solids_of_column_[at(c)]) {
      const int element = part_.mesh.solids[at(solid)];
      const auto stress = part_stresses(part_, solid, part_.mesh.kind(element).gradients_at_nodes,
                                        result.displacement);
      for (int i = 0; i < part_.mesh.kind(element).nodes; ++i)
        take(plate.peak_von_mises, von_mises(stress.col(i)),
             part_.mesh.nodes.col(part_.mesh.node(element, i)), name);
    }
  }
}

PartSolution PadeyeModel::as_part(const PadeyeResult& result) const {
  PartSolution solution;
  solution.displacement = result.displacement;
  solution.stress = recover_part_stress(part_, result.displacement);
  return solution;
}

}  // namespace blocklift::structure
