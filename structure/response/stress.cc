#include "structure/response/stress.h"

#include <algorithm>
#include <string>
#include <vector>

#include "structure/index.h"
#include "structure/response/cell_stress.h"

namespace blocklift::structure {

namespace {

// Extreme whose part is named at the end, once.
struct RunningExtreme {
  double value = 0;
  Vector3 point = Vector3::Zero();
  int sheet = -1;

  void take(double candidate, const Vector3& place, int of_sheet) {
    if (candidate <= value) return;
    value = candidate;
    point = place;
    sheet = of_sheet;
  }
  Extreme named(const BlockMesh& mesh) const {
    return {value, point, sheet < 0 ? std::string() : mesh.sheet_names[at(sheet)]};
  }
};

// One quantity over the whole block, each group and each lug's neighbourhood.
struct Maxima {
  Maxima(std::size_t groups, std::size_t lugs) : group(groups), lug(lugs) {}

  RunningExtreme all;
  std::vector<RunningExtreme> group;
  std::vector<RunningExtreme> lug;
};

}  // namespace

StressRecovery::StressRecovery(const UnitResponses& responses, const Options& options)
    : responses_(responses),
      options_(options),
      membrane_(responses.model(), responses.displacements(), options.patch_size) {}

LoadCaseResult StressRecovery::evaluate(const LoadCase& load_case) const {
  const ElasticModel& model = responses_.model();
  const BlockMesh& mesh = model.mesh();
  const Discretisation& space = model.space();
  const auto radius = [&](const LugRegion& lug) { return lug_radius(lug); };
  const auto take = [&](Maxima& maxima, double value, const Vector3& place, int sheet, int group) {
    maxima.all.take(value, place, sheet);
    maxima.group[at(group)].take(value, place, sheet);
    for (std::size_t lug = 0; lug < mesh.lugs.size(); ++lug)
      if (value > maxima.lug[lug].value &&
          (place - mesh.lugs[lug].p_BPin).norm() <= radius(mesh.lugs[lug]))
        maxima.lug[lug].take(value, place, sheet);
  };
  Maxima checked(mesh.groups.size(), mesh.lugs.size());
  Maxima peak(mesh.groups.size(), mesh.lugs.size());
  Maxima moved(mesh.groups.size(), mesh.lugs.size());

  const Eigen::VectorXd membrane = membrane_.von_mises(responses_.coefficients(load_case));
  for (std::size_t p = 0; p < membrane_.patches().size(); ++p) {
    const Patch& patch = membrane_.patches()[p];
    take(checked, membrane[static_cast<Eigen::Index>(p)], patch.centre_B, patch.sheet, patch.group);
  }
  const Eigen::VectorXd relative =
      responses_.without_rigid_motion(responses_.displacement(load_case));
  const CellStress stress(mesh, space, space.element.nodes());
  for (int cell = 0; cell < space.cell_count(); ++cell) {
    const Eigen::VectorXd values = stress.von_mises(cell, relative);
    for (int i = 0; i < space.nodes_per_cell; ++i) {
      const int node = space.node(cell, i);
      const int sheet = mesh.cell_sheet[at(cell)], group = mesh.cell_group[at(cell)];
      take(peak, values[i], space.nodes.col(node), sheet, group);
      take(moved, relative.segment<3>(3 * node).norm(), space.nodes.col(node), sheet, group);
    }
  }

  LoadCaseResult result;
  result.name = load_case.name;
  result.checked_von_mises = checked.all.named(mesh);
  result.peak_von_mises = peak.all.named(mesh);
  result.displacement = moved.all.named(mesh);
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    const Material& material = mesh.materials[at(mesh.groups[g].material)];
    result.groups.push_back({mesh.groups[g].name, material.name, material.yield_stress,
                             checked.group[g].named(mesh), peak.group[g].named(mesh)});
  }
  for (std::size_t lug = 0; lug < mesh.lugs.size(); ++lug)
    result.lugs.push_back({mesh.lugs[lug].name, radius(mesh.lugs[lug]),
                           checked.lug[lug].named(mesh), peak.lug[lug].named(mesh),
                           moved.lug[lug].named(mesh)});
  result.balance = responses_.balance(load_case);
  return result;
}

}  // namespace blocklift::structure
