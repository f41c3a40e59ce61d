#include "structure/response/block_envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "structure/index.h"
#include "structure/response/cell_stress.h"

namespace blocklift::structure {

namespace {

// The place and instant of an extreme; everything else about it is looked up once it is known.
struct Running {
  double value = -std::numeric_limits<double>::infinity();
  int point = -1;

  void take(double candidate, int of_point) {
    if (candidate > value) *this = {candidate, of_point};
  }
};

// Largest membrane stresses: of all patches, of each group and each lug's neighbourhood.
struct PatchMaxima {
  Running all;
  std::vector<Running> groups, lugs;
};

PatchMaxima patch_maxima(const BlockMesh& mesh, const StressRecovery& recovery,
                         const PointExtremes& von_mises) {
  PatchMaxima maxima{
      {}, std::vector<Running>(mesh.groups.size()), std::vector<Running>(mesh.lugs.size())};
  const std::vector<Patch>& patches = recovery.membrane().patches();
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const double value = von_mises.value[static_cast<Eigen::Index>(p)];
    const int point = static_cast<int>(p);
    maxima.all.take(value, point);
    maxima.groups[at(patches[p].group)].take(value, point);
    for (std::size_t lug = 0; lug < mesh.lugs.size(); ++lug)
      if (value > maxima.lugs[lug].value && (patches[p].centre_B - mesh.lugs[lug].p_BPin).norm() <=
                                                recovery.lug_radius(mesh.lugs[lug]))
        maxima.lugs[lug].take(value, point);
  }
  return maxima;
}

TimedExtreme of_patch(const BlockMesh& mesh, const MembraneStress& membrane,
                      const PointExtremes& von_mises, const Running& found) {
  TimedExtreme extreme;
  if (found.point < 0) return extreme;  // nothing of it lies between crossings
  const Patch& patch = membrane.patches()[at(found.point)];
  extreme.value = found.value;
  extreme.point_B = patch.centre_B;
  extreme.part = mesh.sheet_names[at(patch.sheet)];
  extreme.instant = von_mises.instant[found.point];
  extreme.unit_stress = unit_stress_of_patch(membrane, found.point);
  return extreme;
}

// Stresses at the nodes of each cell, as the cell sees them: point = nodes_per_cell * cell + node.
class NodalStress {
 public:
  explicit NodalStress(const UnitResponses& responses)
      : responses_(responses),
        model_(responses.model()),
        nodes_(model_.space().nodes_per_cell),
        stress_(model_.mesh(), model_.space(), model_.space().element.nodes()) {}

  int points() const { return nodes_ * model_.space().cell_count(); }

  Eigen::MatrixXd at_points(int first, int count) const {
    Eigen::MatrixXd result(6 * count, responses_.count());
    for (int point = first; point < first + count;) {
      const int cell = point / nodes_, node = point % nodes_;
      const int taken = std::min(nodes_ - node, first + count - point);
      result.middleRows(6 * (point - first), 6 * taken) =
          stress_.of_all(cell, responses_.displacements()).middleRows(6 * node, 6 * taken);
      point += taken;
    }
    return result;
  }

  TimedExtreme extreme(const LargestStress& largest) const {
    TimedExtreme result;
    const int point = largest.point;
    if (point < 0) return result;
    const int cell = point / nodes_;
    const BlockMesh& mesh = model_.mesh();
    result.value = largest.value;
    result.instant = largest.instant;
    result.point_B = model_.space().nodes.col(model_.space().node(cell, point % nodes_));
    if (mesh.cell_sheet[at(cell)] >= 0)
      result.part = mesh.sheet_names[at(mesh.cell_sheet[at(cell)])];
    result.unit_stress = at_points(point, 1);
    return result;
  }

  int group(int point) const { return model_.mesh().cell_group[at(point / nodes_)]; }

 private:
  const UnitResponses& responses_;
  const ElasticModel& model_;
  int nodes_;
  CellStress stress_;
};

TimedExtreme largest_displacement(const UnitResponses& responses, const LoadHistory& history,
                                  int threads) {
  const ElasticModel& model = responses.model();
  Eigen::MatrixXd relative(responses.displacements().rows(), responses.count());
  for (Eigen::Index k = 0; k < relative.cols(); ++k)
    relative.col(k) = responses.without_rigid_motion(responses.displacements().col(k));
  const PointExtremes moved = find_displacement_envelope(
      history, model.space().node_count(),
      [&](int first, int count) { return relative.middleRows(3 * first, 3 * count); }, threads);
  Eigen::Index node = 0;
  TimedExtreme extreme;
  extreme.value = moved.value.maxCoeff(&node);
  extreme.point_B = model.space().nodes.col(node);
  extreme.instant = moved.instant[node];
  return extreme;
}

}  // namespace

Eigen::VectorXd response_weights(const MembraneStress& membrane) {
  const double rows = std::max<double>(1, static_cast<double>(membrane.components().rows()));
  return membrane.components().colwise().norm().transpose() / std::sqrt(rows);
}

Eigen::MatrixXd unit_stress_of_patch(const MembraneStress& membrane, int patch) {
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6, membrane.components().cols());
  stress.topRows<2>() = membrane.components().middleRows<2>(3 * patch);
  stress.row(3) = membrane.components().row(3 * patch + 2);
  return stress;
}

Eigen::VectorXd stress_shares(const Eigen::MatrixXd& unit_stress, const Eigen::MatrixXd& parts,
                              const Eigen::VectorXd& whole) {
  // Shear stands twice in a product of tensors.
  const auto deviator = [](Eigen::MatrixXd stress) {
    stress.topRows<3>().rowwise() -= stress.topRows<3>().colwise().mean().eval();
    stress.bottomRows<3>() *= std::sqrt(2.0);
    return stress;
  };
  const Eigen::VectorXd s = deviator(unit_stress * whole);
  const double square = s.squaredNorm();
  if (!(square > 0)) return Eigen::VectorXd::Zero(parts.cols());
  return deviator(unit_stress * parts).transpose() * s / square;
}

BlockEnvelope find_block_envelope(const UnitResponses& responses, const StressRecovery& recovery,
                                  const Eigen::MatrixXd& factors, int threads) {
  const BlockMesh& mesh = responses.model().mesh();
  const MembraneStress& membrane = recovery.membrane();
  const LoadHistory history(factors, response_weights(membrane));
  const int patches = static_cast<int>(membrane.patches().size());

  BlockEnvelope envelope;
  envelope.instants = history.instants();
  envelope.patches = find_von_mises_envelope(
      history, patches,
      [&](int first, int count) {
        Eigen::MatrixXd stress(6 * count, responses.count());
        for (int i = 0; i < count; ++i)
          stress.middleRows<6>(6 * i) = unit_stress_of_patch(membrane, first + i);
        return stress;
      },
      threads);
  const PatchMaxima checked = patch_maxima(mesh, recovery, envelope.patches);
  const auto named = [&](const Running& found) {
    return of_patch(mesh, membrane, envelope.patches, found);
  };
  envelope.checked_von_mises = named(checked.all);
  for (std::size_t lug = 0; lug < mesh.lugs.size(); ++lug)
    envelope.lugs.push_back({mesh.lugs[lug].name, named(checked.lugs[lug])});

  const NodalStress nodal(responses);
  const int groups = static_cast<int>(mesh.groups.size());
  const LargestStresses peaks = find_largest_stresses(
      history, nodal.points(), [&](int first, int count) { return nodal.at_points(first, count); },
      groups, [&](int point) { return nodal.group(point); }, threads);
  envelope.places = patches + nodal.points();
  LargestStress peak;
  for (const LargestStress& of_group : peaks.von_mises)
    if (of_group.point >= 0 && (peak.point < 0 || of_group.value > peak.value)) peak = of_group;
  envelope.peak_von_mises = nodal.extreme(peak);
  envelope.largest_principal = nodal.extreme(peaks.largest_principal);
  envelope.smallest_principal = nodal.extreme(peaks.smallest_principal);
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    const Material& material = mesh.materials[at(mesh.groups[g].material)];
    envelope.groups.push_back({mesh.groups[g].name, material.name, material.yield_stress,
                               named(checked.groups[g]), nodal.extreme(peaks.von_mises[g])});
  }
  envelope.displacement = largest_displacement(responses, history, threads);
  return envelope;
}

}  // namespace blocklift::structure
