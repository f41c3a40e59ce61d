#include "structure/stress/stress.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "parallel/threads.h"
#include "structure/index.h"
#include "structure/mesh/lugs/solid_lugs.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

// Extreme whose part is named at the end, once.
struct RunningExtreme {
  double value = 0;
  Vector3 point = Vector3::Zero();
  int region = -1;

  // The first counts even if it is zero: a plate that only bends has squares without stress.
  void take(double candidate, const Vector3& place, int of_region) {
    if (candidate < value || (candidate == value && region >= 0)) return;
    value = candidate;
    point = place;
    region = of_region;
  }
  Extreme named(const Mesh& mesh) const {
    return {value, point, region < 0 ? std::string() : mesh.regions[region].name};
  }
};

// One quantity over the whole block, each group and each lug's neighbourhood.
class Maxima {
 public:
  Maxima() = default;
  explicit Maxima(const MotionStress& recovery, const Mesh& mesh)
      : recovery_(&recovery),
        mesh_(&mesh),
        groups_(mesh.groups.size()),
        lugs_(mesh.lifting_points.size()) {}

  void take(double value, const Vector3& place, int region) {
    all_.take(value, place, region);
    if (region >= 0) groups_[mesh_->regions[region].group].take(value, place, region);
    for (std::size_t i = 0; i < lugs_.size(); ++i) {
      const LiftingPoint& lug = mesh_->lifting_points[i];
      if (value > lugs_[i].value && (place - lug.p_BPin).norm() <= recovery_->lug_radius(lug))
        lugs_[i].take(value, place, region);
    }
  }
  /// What later points had: of equal values the earlier stays.
  void take(const Maxima& later) {
    const auto merge = [](RunningExtreme& into, const RunningExtreme& from) {
      into.take(from.value, from.point, from.region);
    };
    merge(all_, later.all_);
    for (std::size_t i = 0; i < groups_.size(); ++i) merge(groups_[i], later.groups_[i]);
    for (std::size_t i = 0; i < lugs_.size(); ++i) merge(lugs_[i], later.lugs_[i]);
  }
  bool is_empty() const { return all_.region < 0; }
  bool is_empty(std::size_t group) const { return groups_[group].region < 0; }
  Extreme all() const { return all_.named(*mesh_); }
  Extreme group(std::size_t group) const { return groups_[group].named(*mesh_); }
  Extreme lug(std::size_t lug) const { return lugs_[lug].named(*mesh_); }

 private:
  const MotionStress* recovery_ = nullptr;
  const Mesh* mesh_ = nullptr;
  RunningExtreme all_;
  std::vector<RunningExtreme> groups_, lugs_;
};

/// The largest nodal stresses of several motions (columns), one pass through all cells.
std::vector<Maxima> find_peaks(const StressPoints& points, const Eigen::MatrixXd& motions,
                               const CellHeat* heat, const Maxima& none) {
  constexpr int batch = 2048;
  const int batches = (points.count() + batch - 1) / batch;
  const auto cases = static_cast<std::size_t>(motions.cols());
  std::vector<std::vector<Maxima>> of_batch(at(batches));
  parallel::in_batches(points.count(), batch, 0, [&](int first, int count) {
    std::vector<Maxima> maxima(cases, none);
    const Eigen::MatrixXd stress = points.stresses(first, count, motions, heat);
    for (int i = 0; i < count; ++i) {
      const Vector3 place = points.place(first + i);
      const int region = points.region(first + i);
      for (std::size_t c = 0; c < cases; ++c)
        maxima[c].take(von_mises(stress.block<6, 1>(6 * i, static_cast<Eigen::Index>(c))), place,
                       region);
    }
    of_batch[first / batch] = std::move(maxima);
  });
  std::vector<Maxima> all(cases, none);
  for (const std::vector<Maxima>& maxima : of_batch)
    for (std::size_t c = 0; c < cases; ++c) all[c].take(maxima[c]);
  return all;
}

Maxima find_displacements(const Space& space, const Eigen::Ref<const Eigen::VectorXd>& motion,
                          Maxima moved) {
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell) {
    const int region = space.mesh().shells[space.shells()[cell].shell].region;
    for (int i = 0; i < space.nodes_per_shell(); ++i) {
      const int node = space.shell_nodes(cell)[i];
      moved.take(motion.segment<3>(6 * static_cast<Eigen::Index>(node)).norm(),
                 space.nodes().col(node), region);
    }
  }
  for (const BeamCell& cell : space.beams())
    for (const int node : cell.nodes)
      moved.take(motion.segment<3>(6 * static_cast<Eigen::Index>(node)).norm(),
                 space.nodes().col(node), space.mesh().beams[cell.beam].region);
  for (std::size_t s = 0; s < space.mesh().solids.size(); ++s) {
    const Solid& solid = space.mesh().solids[s];
    for (std::size_t i = 0; i < solid.vertices.size(); ++i) {
      const int node = space.solid_nodes(static_cast<int>(s))[i];
      moved.take(motion.segment<3>(6 * static_cast<Eigen::Index>(node)).norm(),
                 space.nodes().col(node), solid.region);
    }
  }
  return moved;
}

void fill_in(const MotionStress& recovery, const Mesh& mesh, const Maxima& checked,
             const BySite<Maxima>& at_site, const Maxima& peak, const Maxima& moved,
             LoadCaseResult& result) {
  // Beams and solids have no squares: their peak counts as a field's, but not that of lugs.
  const auto by_site = [&](const Extreme& instead, const auto& extreme_of) {
    BySite<Extreme> extremes;
    for (const SquareSite site : square_sites) extremes[site] = extreme_of(at_site[site]);
    if (!instead.part.empty()) extremes[SquareSite::field] = instead;
    return extremes;
  };
  result.checked_von_mises = checked.is_empty() ? peak.all() : checked.all();
  result.peak_von_mises = peak.all();
  result.displacement = moved.all();
  const std::vector<char> is_solid_lug = groups_of_solid_lugs(mesh);
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    const Material& material = mesh.materials[mesh.groups[g].material];
    const Extreme instead = checked.is_empty(g) && is_solid_lug[g] == 0 ? peak.group(g) : Extreme();
    result.groups.push_back({mesh.groups[g].name, material.name, material.yield_stress,
                             checked.is_empty(g) ? instead : checked.group(g),
                             by_site(instead, [&](const Maxima& of) { return of.group(g); }),
                             peak.group(g)});
  }
  for (std::size_t i = 0; i < mesh.lifting_points.size(); ++i) {
    const LiftingPoint& lug = mesh.lifting_points[i];
    result.lugs.push_back({lug.name, recovery.lug_radius(lug),
                           checked.is_empty() ? peak.lug(i) : checked.lug(i),
                           by_site(checked.is_empty() ? peak.lug(i) : Extreme(),
                                   [&](const Maxima& of) { return of.lug(i); }),
                           peak.lug(i), moved.lug(i)});
  }
}

}  // namespace

MotionStress::MotionStress(const ElasticModel& model,
                           const Eigen::Ref<const Eigen::MatrixXd>& motions,
                           const RecoveryOptions& options, const CellHeat* heat)
    : model_(model),
      options_(options),
      checked_(model, motions, options.square_size, 0, heat),
      points_(model.space()),
      heat_(heat) {}

std::vector<LoadCaseResult> MotionStress::evaluate(const Eigen::MatrixXd& factors,
                                                   const Eigen::MatrixXd& moved) const {
  const Maxima none(*this, model_.mesh());
  const std::vector<Maxima> peaks = find_peaks(points_, moved, heat_, none);
  std::vector<LoadCaseResult> results;
  for (Eigen::Index c = 0; c < factors.cols(); ++c) {
    Maxima checked = none;
    BySite<Maxima> at_site;
    for (const SquareSite site : square_sites) at_site[site] = none;
    const Eigen::VectorXd membrane = checked_.von_mises(factors.col(c));
    for (std::size_t s = 0; s < checked_.squares().size(); ++s) {
      const Square& square = checked_.squares()[s];
      const double value = membrane[s];
      checked.take(value, square.centre_B, square.region);
      at_site[square.site].take(value, square.centre_B, square.region);
    }
    const Maxima displaced = find_displacements(model_.space(), moved.col(c), none);
    LoadCaseResult& result = results.emplace_back();
    fill_in(*this, model_.mesh(), checked, at_site, peaks[c], displaced, result);
    result.field_von_mises = at_site[SquareSite::field].all();
  }
  return results;
}

StressRecovery::StressRecovery(const UnitResponses& responses, const Options& options)
    : responses_(responses), of_motions_(responses.model(), responses.displacements(), options) {}

LoadCaseResult StressRecovery::evaluate(const LoadCase& load_case) const {
  return std::move(evaluate(std::vector<LoadCase>{load_case}).front());
}

std::vector<LoadCaseResult> StressRecovery::evaluate(
    const std::vector<LoadCase>& load_cases) const {
  const auto cases = static_cast<Eigen::Index>(load_cases.size());
  Eigen::MatrixXd factors(responses_.count(), cases);
  for (Eigen::Index c = 0; c < cases; ++c) factors.col(c) = responses_.coefficients(load_cases[c]);
  Eigen::MatrixXd relative = responses_.displacements_of(load_cases);
  parallel::in_batches(static_cast<int>(cases), 1, 0, [&](int c, int) {
    relative.col(c) = responses_.without_rigid_motion(relative.col(c));
  });
  std::vector<LoadCaseResult> results = of_motions_.evaluate(factors, relative);
  for (std::size_t c = 0; c < load_cases.size(); ++c) {
    results[c].name = load_cases[c].name;
    results[c].balance = responses_.balance(load_cases[c]);
  }
  return results;
}

}  // namespace blocklift::structure
