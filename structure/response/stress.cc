#include "structure/response/stress.h"

#include <algorithm>
#include <string>
#include <vector>

#include "structure/index.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

// Extreme whose part is named at the end, once.
struct RunningExtreme {
  double value = 0;
  Vector3 point = Vector3::Zero();
  int region = -1;

  void take(double candidate, const Vector3& place, int of_region) {
    if (candidate <= value) return;
    value = candidate;
    point = place;
    region = of_region;
  }
  Extreme named(const Mesh& mesh) const {
    return {value, point, region < 0 ? std::string() : mesh.regions[at(region)].name};
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
      checked_(responses.model(), responses.displacements(), options.square_size),
      points_(responses.model().space()) {}

LoadCaseResult StressRecovery::evaluate(const LoadCase& load_case) const {
  const ElasticModel& model = responses_.model();
  const Mesh& mesh = model.mesh();
  const std::vector<LiftingPoint>& lugs = mesh.lifting_points;
  const auto take = [&](Maxima& maxima, double value, const Vector3& place, int region) {
    maxima.all.take(value, place, region);
    if (region >= 0) maxima.group[at(mesh.regions[at(region)].group)].take(value, place, region);
    for (std::size_t lug = 0; lug < lugs.size(); ++lug)
      if (value > maxima.lug[lug].value &&
          (place - lugs[lug].p_BPin).norm() <= lug_radius(lugs[lug]))
        maxima.lug[lug].take(value, place, region);
  };
  Maxima checked(mesh.groups.size(), lugs.size());
  Maxima peak(mesh.groups.size(), lugs.size());
  Maxima moved(mesh.groups.size(), lugs.size());
  RunningExtreme field;

  const Eigen::VectorXd membrane = checked_.von_mises(responses_.coefficients(load_case));
  for (std::size_t s = 0; s < checked_.squares().size(); ++s) {
    const Square& square = checked_.squares()[s];
    const double value = membrane[static_cast<Eigen::Index>(s)];
    take(checked, value, square.centre_B, square.region);
    if (!square.at_corner) field.take(value, square.centre_B, square.region);
  }
  const Eigen::MatrixXd relative =
      responses_.without_rigid_motion(responses_.displacement(load_case));
  constexpr int batch = 4096;
  for (int first = 0; first < points_.count(); first += batch) {
    const int count = std::min(batch, points_.count() - first);
    const Eigen::MatrixXd stress = points_.stresses(first, count, relative);
    for (int i = 0; i < count; ++i)
      take(peak, von_mises(stress.block<6, 1>(6 * i, 0)), points_.place(first + i),
           points_.region(first + i));
  }
  for (int cell = 0; cell < static_cast<int>(model.space().shells().size()); ++cell)
    for (int i = 0; i < model.space().nodes_per_shell(); ++i) {
      const int node = model.space().shell_nodes(cell)[i];
      take(moved, relative.block<3, 1>(6 * node, 0).norm(), model.space().nodes().col(node),
           mesh.shells[at(model.space().shells()[at(cell)].shell)].region);
    }

  LoadCaseResult result;
  result.name = load_case.name;
  result.checked_von_mises = checked.all.named(mesh);
  result.field_von_mises = field.named(mesh);
  result.peak_von_mises = peak.all.named(mesh);
  result.displacement = moved.all.named(mesh);
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    const Material& material = mesh.materials[at(mesh.groups[g].material)];
    result.groups.push_back({mesh.groups[g].name, material.name, material.yield_stress,
                             checked.group[g].named(mesh), peak.group[g].named(mesh)});
  }
  for (std::size_t lug = 0; lug < lugs.size(); ++lug)
    result.lugs.push_back({lugs[lug].name, lug_radius(lugs[lug]), checked.lug[lug].named(mesh),
                           peak.lug[lug].named(mesh), moved.lug[lug].named(mesh)});
  result.balance = responses_.balance(load_case);
  return result;
}

}  // namespace blocklift::structure
