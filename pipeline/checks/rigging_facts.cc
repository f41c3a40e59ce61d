#include "pipeline/checks/rigging_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "pipeline/checks/frame_compliance.h"
#include "pipeline/lift/history_figures.h"
#include "pipeline/lift/sling_ends.h"

namespace blocklift::pipeline {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Index index(std::size_t i) { return static_cast<Index>(i); }

const dynamics::RopeHistory& history_of(const dynamics::History& history, int rope) {
  return history.ropes[rope];
}

}  // namespace

/// The rigging at one sample: slings at lugs first, those to bars, then tackles in the order of the
/// hoists.
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
    if (!rope.lug.empty())
      slings_.push_back(rope);
    else if (lift_case.find_rope(rope.name)->is_basket())
      baskets_.push_back(rope);
    else if (lift_case.find_rope(rope.name)->is_sling())
      to_bars_.push_back(rope);
}

VectorXd RiggingFacts::hook_load(const dynamics::History& history) const {
  return load_on_slings(lift_.model, history);
}

std::optional<double> RiggingFacts::weight_of(const LiftRope& sling) const {
  const given::Rope& rope = *case_.find_rope(sling.name);
  if (!rope.rope.mass_per_length) return {};
  return *rope.rope.mass_per_length * rope.length.value * case_.gravity;
}

dynamics::Pose RiggingFacts::pose_of(dynamics::BodyIndex body, Index sample) const {
  return lift_.static_history.bodies[body - 1].X_WB(sample);
}

RiggingEnd RiggingFacts::end_at(const ResolvedPoint& point, Index sample) const {
  const auto place_of = [](const auto& all, const std::string& name) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
    return static_cast<int>(found - all.begin());
  };
  switch (point.kind) {
    case ResolvedPoint::Kind::hook:
      return {RiggingEnd::Kind::hook, place_of(lift_.model.hoists, point.body_name(case_.cranes)),
              Vector3d::Zero()};
    case ResolvedPoint::Kind::spreader: {
      const int bar = place_of(lift_.model.spreaders, point.part);
      const auto body = lift_.model.spreaders[bar].body;
      const Vector3d centre = case_.find_spreader(point.part)->centre();
      return {RiggingEnd::Kind::bar, bar, pose_of(body, sample).R * (point.point - centre)};
    }
    case ResolvedPoint::Kind::load:
      return {RiggingEnd::Kind::load, -1,
              pose_of(lift_.model.load, sample).R * (point.point - p_BoBcm_)};
    case ResolvedPoint::Kind::world:
    case ResolvedPoint::Kind::crane_body:
    case ResolvedPoint::Kind::vessel:
      break;
  }
  return {};
}

/// A rope as it hangs at a sample, without its ends.
RiggingRope RiggingFacts::rigging_rope(int rope, const Vector3d& pull_up, Index sample) const {
  const dynamics::RopeHistory& r = history_of(lift_.static_history, rope);
  RiggingRope result;
  result.tension = r.tension[sample];
  result.direction_W = pull_up.norm() > 0 ? Vector3d(pull_up.normalized()) : Vector3d::UnitZ();
  result.length = r.unstretched_length[sample] + r.elongation[sample];
  result.compliance =
      1 / lift_.model.system.ropes()[rope].stiffness(r.unstretched_length[sample], result.tension);
  return result;
}

/// Compliance of the block at the lugs along the ropes, ropes x ropes; empty: it is rigid.
MatrixXd RiggingFacts::compliance_of(const std::vector<RiggingRope>& ropes, Index sample) const {
  if (compliance_.size() == 0) return {};
  const Eigen::Matrix3d R_BW = pose_of(lift_.model.load, sample).R.transpose();
  MatrixXd pull = MatrixXd::Zero(compliance_.rows(), index(ropes.size()));  // on the lugs, in B
  for (std::size_t i = 0; i < slings_.size(); ++i) {
    const auto lug = std::find(lugs_.begin(), lugs_.end(), slings_[i].lug);
    if (lug != lugs_.end())
      pull.block<3, 1>(3 * (lug - lugs_.begin()), index(i)) = R_BW * ropes[i].direction_W;
  }
  return pull.transpose() * compliance_ * pull;
}

/// All ropes at a sample: slings at lugs, those to bars, tackles.
TolerancedRigging RiggingFacts::rigging_at(Index sample) const {
  const dynamics::History& history = lift_.static_history;
  const auto& hoists = lift_.model.hoists;
  const given::Standard& standard = *case_.standard;
  std::optional<double> share = standard.length_tolerance;
  if (!share && standard.rules.length_tolerance) share = standard.rules.length_tolerance->value;

  TolerancedRigging rigging;
  rigging.hooks = static_cast<int>(hoists.size());
  rigging.tolerance = VectorXd::Zero(index(first_tackle() + hoists.size()));
  for (const auto* slings : {&slings_, &to_bars_})
    for (const LiftRope& sling : *slings) {
      const given::Rope& in_case = *case_.find_rope(sling.name);
      if (share) rigging.tolerance[index(rigging.ropes.size())] = *share * in_case.length.value;
      RiggingRope& rope = rigging.ropes.emplace_back(
          rigging_rope(sling.rope, history_of(history, sling.rope).last_force.row(sample), sample));
      rope.lower = end_at(in_case.path.back(), sample);
      rope.upper = end_at(in_case.path.front(), sample);
      rigging.in_system.push_back(sling.rope);
    }
  for (std::size_t h = 0; h < hoists.size(); ++h) {
    const Vector3d pull =
        hook_pull(history_of(history, hoists[h].rope), hoists[h].hook_is_first).row(sample);
    RiggingRope& tackle = rigging.ropes.emplace_back(rigging_rope(hoists[h].rope, pull, sample));
    tackle.lower = {RiggingEnd::Kind::hook, static_cast<int>(h), Vector3d::Zero()};
    rigging.in_system.push_back(hoists[h].rope);
  }
  for (const LiftSpreader& bar : lift_.model.spreaders)
    rigging.bars.push_back({pose_of(bar.body, sample).R, case_.find_spreader(bar.name)->centre()});
  rigging.load_compliance = compliance_of(rigging.ropes, sample);
  return rigging;
}

/// Shares of hooks that hang on one rope are given, and a balance of single ropes has no say; nor
/// has it where baskets go round the load.
bool RiggingFacts::is_balanced() const {
  return baskets_.empty() &&
         std::none_of(lift_.model.hoists.begin(), lift_.model.hoists.end(),
                      [](const LiftHoist& hoist) { return hoist.hook_is_first; });
}

std::shared_ptr<const TolerancedRigging> RiggingFacts::with_tolerances(Index sample) const {
  if (!is_balanced()) return {};
  auto rigging = std::make_shared<TolerancedRigging>(rigging_at(sample));
  const Index toleranced = (rigging->tolerance.array() > 0).count();
  if (toleranced == 0 || toleranced > RiggingBalance::most_toleranced) return {};
  return rigging;
}

const RiggingFacts::State& RiggingFacts::at(Index sample) const {
  for (const auto& [known, state] : states_)
    if (known == sample) return *state;
  const TolerancedRigging rigging = rigging_at(sample);
  auto state = std::make_shared<State>();
  state->at_rest.resize(index(rigging.ropes.size()));
  for (std::size_t i = 0; i < rigging.ropes.size(); ++i)
    state->at_rest[index(i)] = rigging.ropes[i].tension;
  if (is_balanced()) {
    std::vector<const given::Spreader*> spreaders;
    for (const LiftSpreader& bar : lift_.model.spreaders)
      spreaders.push_back(case_.find_spreader(bar.name));
    const RiggingBalance balance = balance_of(rigging, spreaders);
    const Index toleranced = (rigging.tolerance.array() > 0).count();
    if (toleranced > 0 && toleranced <= RiggingBalance::most_toleranced)
      state->largest_by_tolerance = balance.largest_by_tolerance(rigging.tolerance);
    for (const Vector3d& shift : corners_of_box()) {
      const Vector3d shift_W = pose_of(lift_.model.load, sample).R * shift;
      state->at_corners_of_box.push_back(
          balance.with_moment(shift_W.cross(Vector3d(0, 0, -weight_))));
    }
  }
  states_.emplace_back(sample, std::move(state));
  return *states_.back().second;
}

/// From the centre of mass to the corners of its box; none without one.
std::vector<Vector3d> RiggingFacts::corners_of_box() const {
  std::vector<Vector3d> corners;
  if (const auto& box = case_.standard->centre_box)
    for (int corner = 0; corner < 8; ++corner)
      corners.emplace_back((corner & 1) != 0 ? box->x() : -box->x(),
                           (corner & 2) != 0 ? box->y() : -box->y(),
                           (corner & 4) != 0 ? box->z() : -box->z());
  return corners;
}

ComputedFactors RiggingFacts::of_sling(const LiftRope& sling, Index sample) const {
  const State& state = at(sample);
  const auto find_in = [&](const std::vector<LiftRope>& slings) {
    return std::find_if(slings.begin(), slings.end(),
                        [&](const LiftRope& one) { return one.rope == sling.rope; });
  };
  const auto at_lug = find_in(slings_);
  const Index row = at_lug != slings_.end()
                        ? at_lug - slings_.begin()
                        : index(slings_.size()) + (find_in(to_bars_) - to_bars_.begin());
  const double at_rest = state.at_rest[row];
  ComputedFactors computed;
  if (!(at_rest > 0)) return computed;
  if (state.largest_by_tolerance.size() > 0)
    computed.skew = state.largest_by_tolerance[row] / at_rest;
  for (const VectorXd& tension : state.at_corners_of_box)
    computed.centre_box = std::max(computed.centre_box.value_or(1), tension[row] / at_rest);
  computed.two_hooks = two_hooks(sling.hoist, sample);
  return computed;
}

double RiggingFacts::hook_block_weight(std::size_t hoist) const {
  const LiftHoist& of = lift_.model.hoists[hoist];
  const std::string name = of.name.substr(of.name.find('.') + 1);
  return case_.cranes[of.crane].model->find_hoist(name)->hook_block.mass * case_.gravity;
}

ComputedFactors RiggingFacts::of_hook(std::size_t hoist, Index sample) const {
  const State& state = at(sample);
  const Index tackle = index(first_tackle() + hoist);
  const double block = hook_block_weight(hoist);
  const double at_rest = state.at_rest[tackle] - block;
  ComputedFactors computed;
  if (!(at_rest > 0)) return computed;
  for (const VectorXd& tension : state.at_corners_of_box)
    computed.centre_box =
        std::max(computed.centre_box.value_or(1), (tension[tackle] - block) / at_rest);
  computed.two_hooks = two_hooks(lift_.model.hoists[hoist].name, sample);
  computed.bears_all = bears_all(lift_.model.hoists[hoist].name, sample);
  return computed;
}

ComputedFactors RiggingFacts::of_crane(std::size_t crane, Index sample) const {
  const State& state = at(sample);
  const auto& hoists = lift_.model.hoists;
  const auto sum = [&](const VectorXd& tension) {
    double total = 0;
    for (std::size_t h = 0; h < hoists.size(); ++h)
      if (hoists[h].crane == crane)
        total += tension[index(first_tackle() + h)] - hook_block_weight(h);
    return total;
  };
  ComputedFactors computed;
  const double at_rest = sum(state.at_rest);
  if (!(at_rest > 0)) return computed;
  for (const VectorXd& tension : state.at_corners_of_box)
    computed.centre_box = std::max(computed.centre_box.value_or(1), sum(tension) / at_rest);
  // A crane that bears the load alone bears all of it, however the load tilts between its hooks.
  if (shares_the_load(crane))
    for (const LiftHoist& hoist : hoists)
      if (hoist.crane == crane && !computed.two_hooks)
        computed.two_hooks = two_hooks(hoist.name, sample);
  computed.bears_all = bears_all(case_.cranes[crane].name.value, sample);
  return computed;
}

bool RiggingFacts::bears_all(const std::string& hook_or_crane, Index sample) const {
  using Kind = ResolvedPoint::Kind;
  // Pads, ground or water that bear a part bear more or less of it as the centre lies.
  constexpr double nearly_all = 0.99;
  if (hook_load(lift_.static_history)[sample] < nearly_all * weight_) return false;
  const auto hangs = [](const ResolvedPoint& point) {
    return point.kind == Kind::load || point.kind == Kind::spreader;
  };
  const auto is_of_it = [&](const ResolvedPoint& point) {
    if (point.kind != Kind::hook) return false;
    const std::string hook = point.body_name(case_.cranes);
    return hook == hook_or_crane || crane_of(hook) == hook_or_crane;
  };
  bool holds = false;
  for (const given::Rope& rope : case_.ropes) {
    const auto& path = rope.path;
    if (rope.edges.empty() && std::none_of(path.begin(), path.end(), hangs)) continue;
    if (!std::all_of(path.begin(), path.end(),
                     [&](const auto& point) { return hangs(point) || is_of_it(point); }))
      return false;
    holds = holds || std::any_of(path.begin(), path.end(), is_of_it);
  }
  return holds;
}

bool RiggingFacts::shares_the_load(std::size_t crane) const {
  const std::string& name = case_.cranes[crane].name.value;
  for (const auto* slings : {&slings_, &to_bars_})
    for (const LiftRope& sling : *slings)
      if (!sling.hoist.empty() && crane_of(sling.hoist) != name) return true;
  return false;
}

/// Does a sling lead from its hook to a lug, and over nothing between them?
bool RiggingFacts::leads_straight_to_hook(const LiftRope& sling) const {
  const given::Rope& rope = *case_.find_rope(sling.name);
  return rope.path.size() == 2 && rope.edges.empty() &&
         rope.path.front().kind == ResolvedPoint::Kind::hook;
}

std::optional<TwoHooks> RiggingFacts::two_hooks(const std::string& hook, Index sample) const {
  if (hook.empty() || !baskets_.empty()) return {};
  const dynamics::History& history = lift_.static_history;
  const dynamics::Pose X_WB = history.bodies[lift_.model.load - 1].X_WB(sample);
  // Lift points of hooks and of cranes: where the vertical forces of their slings have their
  // middle.
  struct Group {
    double load = 0;
    Vector3d moment = Vector3d::Zero();
    std::vector<Vector3d> lugs, hooks;  // of slings that pull, and where their other ends are
    std::string hook = {};
    bool holds_to_one_hook = true;  // by slings that lead from lugs straight to it
  };
  std::map<std::string, Group> hooks, cranes;
  for (const SlingEnd& end : find_sling_ends(lift_.model)) {
    const LiftRope& sling = lift_.model.ropes[end.sling];
    if (sling.hoist.empty()) return {};
    const double load = end.pull(history)(sample, 2);
    const Vector3d lug = X_WB.p + X_WB.R * end.p_BoQ_B;
    for (Group* group : {&hooks[sling.hoist], &cranes[crane_of(sling.hoist)]}) {
      group->load += load;
      group->moment += load * lug;
      group->holds_to_one_hook = group->holds_to_one_hook && leads_straight_to_hook(sling) &&
                                 (group->hook.empty() || group->hook == sling.hoist);
      group->hook = sling.hoist;
      if (!(load > 0)) continue;
      group->lugs.push_back(lug);
      group->hooks.push_back(lug + rigging_rope(end.rope, Vector3d::UnitZ(), sample).length *
                                       end.pull(history).row(sample).transpose().normalized());
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
  const auto spread_of = [&](const Group& group, const Vector3d& middle, double side) {
    SpreadOfHook spread;
    if (!group.holds_to_one_hook) return spread;
    for (std::size_t i = 0; i < group.lugs.size(); ++i) {
      const double reach = side * along.dot((group.lugs[i] - middle).head<2>());
      spread.towards = std::max(spread.towards, reach);
      spread.away = std::max(spread.away, -reach);
      spread.height += (group.hooks[i].z() - middle.z()) / static_cast<double>(group.lugs.size());
    }
    return spread;
  };
  result.spread = spread_of(mine, from, 1);
  result.other_spread = spread_of(other, to, -1);
  return result;
}

}  // namespace blocklift::pipeline
