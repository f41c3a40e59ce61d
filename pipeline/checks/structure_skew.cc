#include "pipeline/checks/structure_skew.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Dense>

#include "structure/stress/stress.h"

namespace blocklift::pipeline {

namespace {

using structure::LoadCase;
using structure::LoadCaseResult;
using structure::Vector3;

/// Slings of a hook by their lugs.
struct HookOfFour {
  std::array<std::size_t, 4> lugs{};  ///< places in LoadCase::lug_forces_B
  std::array<const SlingFacts*, 4> slings{};
};

std::vector<HookOfFour> find_hooks_of_four(const structure::Mesh& mesh, const LiftFacts& facts) {
  std::map<std::string, std::vector<const SlingFacts*>> by_hook;
  for (const SlingFacts& sling : facts.slings) by_hook[sling.hook].push_back(&sling);
  std::vector<HookOfFour> hooks;
  for (const auto& [name, slings] : by_hook) {
    if (name.empty() || slings.size() != 4) continue;
    HookOfFour hook;
    bool is_complete = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::string& name_of_lug = slings[i]->lug;
      const auto lug = std::find_if(
          mesh.lifting_points.begin(), mesh.lifting_points.end(),
          [&](const structure::LiftingPoint& point) { return point.name == name_of_lug; });
      is_complete = is_complete && lug != mesh.lifting_points.end() && !slings[i]->runs_over_edges;
      hook.lugs[i] = static_cast<std::size_t>(lug - mesh.lifting_points.begin());
      hook.slings[i] = slings[i];
      for (std::size_t j = 0; j < i; ++j) is_complete = is_complete && hook.lugs[j] != hook.lugs[i];
    }
    if (is_complete) hooks.push_back(hook);
  }
  return hooks;
}

/// Load cases with either diagonal of a hook skewed; none where its slings do not meet.
/// @param skew_of the factor of a sling.
template <class SkewOf>
void add_skewed_cases(const LoadCase& base, const structure::Mesh& mesh, const HookOfFour& hook,
                      const SkewOf& skew_of, std::vector<LoadCase>& cases) {
  std::array<DiagonalSling, 4> slings;
  for (std::size_t i = 0; i < 4; ++i)
    slings[i] = {mesh.lifting_points[hook.lugs[i]].p_BPin, base.lug_forces_B[hook.lugs[i]],
                 skew_of(*hook.slings[i])};
  const auto changes = diagonal_changes(slings);
  if (!changes) return;
  for (const DiagonalChange& change : *changes) {
    LoadCase& skewed = cases.emplace_back(base);
    skewed.name += ", skewed";
    for (std::size_t i = 0; i < 4; ++i) skewed.lug_forces_B[hook.lugs[i]] += change[i];
  }
}

/// Tensions along four directions whose forces sum to nothing, by Cramer's rule; nil where the
/// directions span less than space.
Eigen::Vector4d null_vector(const Eigen::Matrix<double, 3, 4>& directions) {
  Eigen::Vector4d tensions;
  for (Eigen::Index left_out = 0; left_out < 4; ++left_out) {
    Eigen::Matrix3d others;
    for (Eigen::Index i = 0, column = 0; i < 4; ++i)
      if (i != left_out) others.col(column++) = directions.col(i);
    tensions[left_out] = (left_out % 2 == 0 ? 1 : -1) * others.determinant();
  }
  return tensions;
}

/// Largest checked stress of a material's groups, or about any lug, over load cases, of one site
/// where the facts are of one.
double largest_stress(const std::vector<LoadCaseResult>& results, const StressFacts& of) {
  double largest = 0;
  const auto take = [&](const auto& place) {
    const structure::Extreme& there = of.site ? place.at_site[*of.site] : place.checked_von_mises;
    largest = std::max(largest, there.value);
  };
  for (const LoadCaseResult& result : results) {
    if (of.is_at_lug)
      for (const structure::LugNeighbourhood& lug : result.lugs) take(lug);
    else
      for (const structure::GroupStress& group : result.groups)
        if (group.material == of.material) take(group);
  }
  return largest;
}

}  // namespace

std::optional<std::array<DiagonalChange, 2>> diagonal_changes(
    const std::array<DiagonalSling, 4>& slings) {
  constexpr double meets = 1e-3;  // moment over force times the lugs' distances
  Eigen::Matrix<double, 3, 4> directions;
  double reach = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(slings[i].force.norm() > 0)) return {};
    directions.col(i) = slings[i].force.normalized();
    reach = std::max(reach, (slings[i].p_B - slings[0].p_B).norm());
  }
  Eigen::Vector4d tensions = null_vector(directions);
  if (tensions.norm() < 1e-3) return {};
  tensions.normalize();
  Vector3 moment = Vector3::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    moment += (slings[i].p_B - slings[0].p_B).cross(tensions[i] * directions.col(i));
  if (moment.norm() > meets * reach) return {};

  std::array<DiagonalChange, 2> changes;
  for (std::size_t diagonal = 0; diagonal < 2; ++diagonal) {
    const double sign = diagonal == 0 ? 1 : -1;
    double scale = 0, until_slack = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
      const double share = sign * tensions[i];
      const double at_rest = slings[i].force.norm();
      if (share > 0) scale = std::max(scale, (slings[i].skew - 1) * at_rest / share);
      if (share < 0) until_slack = std::min(until_slack, at_rest / -share);
    }
    for (std::size_t i = 0; i < 4; ++i)
      changes[diagonal][i] = sign * std::min(scale, until_slack) * tensions[i] * directions.col(i);
  }
  return changes;
}

void add_structure_skew(const Assessment& assessment, LiftFacts& facts) {
  const given::Standard& standard = *assessment.lift_case.standard;
  const BlockRun& block = assessment.block;
  const structure::Mesh& mesh = block.model->mesh();
  const NamedFactor* factor =
      standard.skew ? find_by_name(standard.rules.skew, standard.skew->value) : nullptr;
  const LoadCase& base = block.assessment.simultaneous.static_state.load;
  std::vector<LoadCase> by_rules, computed;
  for (const HookOfFour& hook : find_hooks_of_four(mesh, facts)) {
    if (factor && factor->value > 1)
      add_skewed_cases(
          base, mesh, hook, [&](const SlingFacts&) { return factor->value; }, by_rules);
    if (std::all_of(hook.slings.begin(), hook.slings.end(),
                    [](const SlingFacts* sling) { return sling->computed.skew.has_value(); }))
      add_skewed_cases(
          base, mesh, hook, [](const SlingFacts& sling) { return *sling.computed.skew; }, computed);
  }
  if (by_rules.empty() && computed.empty()) return;
  const structure::StressRecovery recovery(*block.responses);
  const auto without = recovery.evaluate(std::vector<LoadCase>{base});
  const auto with_rules = recovery.evaluate(by_rules), with_computed = recovery.evaluate(computed);
  for (StressFacts& stress : facts.stresses) {
    const double still = largest_stress(without, stress);
    if (!(still > 0)) continue;
    if (!by_rules.empty())
      stress.skew_by_rules = std::max(1.0, largest_stress(with_rules, stress) / still);
    if (!computed.empty())
      stress.skew_computed = std::max(1.0, largest_stress(with_computed, stress) / still);
  }
}

}  // namespace blocklift::pipeline
