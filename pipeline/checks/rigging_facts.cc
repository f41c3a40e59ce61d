#include "pipeline/checks/rigging_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "pipeline/lift/history_figures.h"

namespace blocklift::pipeline {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Index index(std::size_t i) { return static_cast<Index>(i); }

const dynamics::RopeHistory& history_of(const dynamics::History& history, int rope) {
  return history.ropes[static_cast<std::size_t>(rope)];
}

}  // namespace

/// The rigging at one sample: slings first, then tackles in the order of the hoists.
struct RiggingFacts::State {
  VectorXd at_rest;                         ///< tensions, N
  VectorXd largest_by_tolerance;            ///< empty: no tolerance of lengths
  std::vector<VectorXd> at_corners_of_box;  ///< of the centre of mass; empty: no box
};

RiggingFacts::RiggingFacts(const LiftCase& lift_case, const LiftRun& lift, MatrixXd compliance,
                           std::vector<std::string> lugs)
    : case_(lift_case), lift_(lift), compliance_(std::move(compliance)), lugs_(std::move(lugs)) {
  const auto& inertia = lift.model.system.mechanism().body(lift.model.load).inertia;
  p_BoBcm_ = inertia.p_BoBcm;
  weight_ = inertia.mass * lift_case.gravity;
  for (const LiftRope& rope : lift.model.ropes)
    if (!rope.lug.empty()) slings_.push_back(rope);
}

VectorXd RiggingFacts::hook_load(const dynamics::History& history) const {
  VectorXd sum = VectorXd::Zero(history.sample_count());
  for (const LiftRope& sling : slings_) sum += history_of(history, sling.rope).last_force.col(2);
  return sum;
}

std::optional<double> RiggingFacts::weight_of(const LiftRope& sling) const {
  const RopeInCase& rope = *case_.find_rope(sling.name);
  if (!rope.rope.mass_per_length) return {};
  return *rope.rope.mass_per_length * rope.length.value * case_.gravity;
}

const RiggingFacts::State& RiggingFacts::at(Index sample) const {
  for (const auto& [known, state] : states_)
    if (known == sample) return *state;
  const dynamics::History& history = lift_.static_history;
  const dynamics::Pose X_WB =
      history.bodies[static_cast<std::size_t>(lift_.model.load - 1)].X_WB(sample);
  const auto& hoists = lift_.model.hoists;
  const std::size_t count = slings_.size() + hoists.size();
  std::vector<RiggingRope> ropes(count);
  MatrixXd at_lugs = MatrixXd::Zero(index(count), index(count));
  MatrixXd pull = MatrixXd::Zero(compliance_.rows(), index(count));  // on the lugs, in B
  VectorXd tolerance = VectorXd::Zero(index(count));
  const StandardInCase& standard = *case_.standard;
  std::optional<double> share = standard.length_tolerance;
  if (!share && standard.rules.length_tolerance) share = standard.rules.length_tolerance->value;

  const auto fill = [&](RiggingRope& rope, int of, const Vector3d& pull_up) {
    const dynamics::RopeHistory& r = history_of(history, of);
    rope.tension = r.tension[sample];
    rope.direction_W = pull_up.norm() > 0 ? Vector3d(pull_up.normalized()) : Vector3d::UnitZ();
    rope.length = r.unstretched_length[sample] + r.elongation[sample];
    rope.compliance = 1 / lift_.model.system.ropes()[static_cast<std::size_t>(of)].stiffness(
                              r.unstretched_length[sample]);
  };
  const auto hook_index = [&](const std::string& name) {
    const auto found = std::find_if(hoists.begin(), hoists.end(),
                                    [&](const LiftHoist& hoist) { return hoist.name == name; });
    return found == hoists.end() ? -1 : static_cast<int>(found - hoists.begin());
  };
  for (std::size_t i = 0; i < slings_.size(); ++i) {
    const LiftRope& sling = slings_[i];
    const RopeInCase& in_case = *case_.find_rope(sling.name);
    fill(ropes[i], sling.rope, history_of(history, sling.rope).last_force.row(sample));
    const Vector3d r_B = in_case.path.back().point - p_BoBcm_;
    ropes[i].lower = {RiggingEnd::Kind::load, -1, X_WB.R * r_B};
    const int hook = hook_index(sling.hoist);
    if (hook >= 0) ropes[i].upper = {RiggingEnd::Kind::hook, hook, Vector3d::Zero()};
    if (share) tolerance[index(i)] = *share * in_case.length.value;
    const auto lug = std::find(lugs_.begin(), lugs_.end(), sling.lug);
    if (compliance_.size() > 0 && lug != lugs_.end())
      pull.block<3, 1>(3 * (lug - lugs_.begin()), index(i)) =
          X_WB.R.transpose() * ropes[i].direction_W;
  }
  for (std::size_t h = 0; h < hoists.size(); ++h) {
    RiggingRope& tackle = ropes[slings_.size() + h];
    fill(tackle, hoists[h].rope,
         hook_pull(history_of(history, hoists[h].rope), hoists[h].hook_is_first).row(sample));
    tackle.lower = {RiggingEnd::Kind::hook, static_cast<int>(h), Vector3d::Zero()};
  }
  if (compliance_.size() > 0) at_lugs = pull.transpose() * compliance_ * pull;
  const RiggingBalance balance(ropes, static_cast<int>(hoists.size()), at_lugs);

  auto state = std::make_shared<State>();
  state->at_rest.resize(index(count));
  for (std::size_t i = 0; i < count; ++i) state->at_rest[index(i)] = ropes[i].tension;
  // Shares of hooks that hang on one rope are given, and a balance of single ropes has no say; nor
  // has one that knows of no bars between ropes.
  const bool is_balanced = lift_.model.spreaders.empty() &&
                           std::none_of(hoists.begin(), hoists.end(),
                                        [](const LiftHoist& hoist) { return hoist.hook_is_first; });
  if (share && is_balanced && slings_.size() <= RiggingBalance::most_toleranced)
    state->largest_by_tolerance = balance.largest_by_tolerance(tolerance);
  if (const auto& box = standard.centre_box; box && is_balanced)
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d shift((corner & 1) != 0 ? box->x() : -box->x(),
                           (corner & 2) != 0 ? box->y() : -box->y(),
                           (corner & 4) != 0 ? box->z() : -box->z());
      state->at_corners_of_box.push_back(
          balance.with_moment((X_WB.R * shift).cross(Vector3d(0, 0, -weight_))));
    }
  states_.emplace_back(sample, std::move(state));
  return *states_.back().second;
}

ComputedFactors RiggingFacts::of_sling(std::size_t sling, Index sample) const {
  const State& state = at(sample);
  const double at_rest = state.at_rest[index(sling)];
  ComputedFactors computed;
  if (!(at_rest > 0)) return computed;
  if (state.largest_by_tolerance.size() > 0)
    computed.skew = state.largest_by_tolerance[index(sling)] / at_rest;
  for (const VectorXd& tension : state.at_corners_of_box)
    computed.centre_box =
        std::max(computed.centre_box.value_or(1), tension[index(sling)] / at_rest);
  computed.two_hooks = two_hooks(slings_[sling].hoist, sample);
  return computed;
}

ComputedFactors RiggingFacts::of_hook(std::size_t hoist, Index sample) const {
  const State& state = at(sample);
  const Index tackle = index(slings_.size() + hoist);
  const double at_rest = state.at_rest[tackle];
  ComputedFactors computed;
  if (!(at_rest > 0)) return computed;
  for (const VectorXd& tension : state.at_corners_of_box)
    computed.centre_box = std::max(computed.centre_box.value_or(1), tension[tackle] / at_rest);
  computed.two_hooks = two_hooks(lift_.model.hoists[hoist].name, sample);
  return computed;
}

ComputedFactors RiggingFacts::of_crane(std::size_t crane, Index sample) const {
  const State& state = at(sample);
  const auto& hoists = lift_.model.hoists;
  const auto sum = [&](const VectorXd& tension) {
    double total = 0;
    for (std::size_t h = 0; h < hoists.size(); ++h)
      if (hoists[h].crane == crane) total += tension[index(slings_.size() + h)];
    return total;
  };
  ComputedFactors computed;
  const double at_rest = sum(state.at_rest);
  if (!(at_rest > 0)) return computed;
  for (const VectorXd& tension : state.at_corners_of_box)
    computed.centre_box = std::max(computed.centre_box.value_or(1), sum(tension) / at_rest);
  for (const LiftHoist& hoist : hoists)
    if (hoist.crane == crane && !computed.two_hooks)
      computed.two_hooks = two_hooks(hoist.name, sample);
  return computed;
}

std::optional<TwoHooks> RiggingFacts::two_hooks(const std::string& hook, Index sample) const {
  if (hook.empty()) return {};
  const dynamics::History& history = lift_.static_history;
  const dynamics::Pose X_WB =
      history.bodies[static_cast<std::size_t>(lift_.model.load - 1)].X_WB(sample);
  // Lift points of hooks and of cranes: where the vertical forces of their slings have their
  // middle.
  struct Group {
    double load = 0;
    Vector3d moment = Vector3d::Zero();
  };
  std::map<std::string, Group> hooks, cranes;
  for (const LiftRope& sling : slings_) {
    if (sling.hoist.empty()) return {};
    const double load = history_of(history, sling.rope).last_force(sample, 2);
    const Vector3d lug = X_WB.p + X_WB.R * case_.find_rope(sling.name)->path.back().point;
    for (Group* group : {&hooks[sling.hoist], &cranes[crane_of(sling.hoist)]}) {
      group->load += load;
      group->moment += load * lug;
    }
  }
  const bool by_hook = hooks.size() == 2;
  const auto& groups = by_hook ? hooks : cranes;
  if (groups.size() != 2) return {};
  const std::string own = by_hook ? hook : crane_of(hook);
  if (!groups.contains(own)) return {};
  const auto& [first, second] = std::pair(groups.begin(), std::next(groups.begin()));
  const Group& mine = first->first == own ? first->second : second->second;
  const Group& other = first->first == own ? second->second : first->second;
  if (!(mine.load > 0) || !(other.load > 0)) return {};
  const Vector3d centre = X_WB.p + X_WB.R * p_BoBcm_;
  const Vector3d from = mine.moment / mine.load, to = other.moment / other.load;
  const Eigen::Vector2d level = (to - from).head<2>();
  if (level.norm() < 0.01) return {};
  const Eigen::Vector2d along = level.normalized();
  TwoHooks result;
  result.along = along.dot((centre - from).head<2>());
  result.height = from.z() - centre.z();
  result.other_along = along.dot((to - centre).head<2>());
  result.other_height = to.z() - centre.z();
  if (!(result.along > 0) || !(result.other_along > 0)) return {};
  return result;
}

}  // namespace blocklift::pipeline
