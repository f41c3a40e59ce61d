#include "pipeline/checks/lost_load.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "dynamics/marine/hull/hydrostatics.h"

namespace blocklift::pipeline {

namespace {

using dynamics::BodyIndex;

/// Which bodies ropes tie together.
class TiedBodies {
 public:
  explicit TiedBodies(int count) : root_(static_cast<std::size_t>(count)) {
    std::iota(root_.begin(), root_.end(), 0);
  }
  void tie(BodyIndex one, BodyIndex other) { root_[find(one)] = find(other); }
  bool are_tied(BodyIndex one, BodyIndex other) const { return find(one) == find(other); }

 private:
  BodyIndex find(BodyIndex body) const {
    while (root_[body] != body) body = root_[body];
    return body;
  }
  std::vector<BodyIndex> root_;
};

/// Bodies that nothing but ropes holds: the load, hook blocks, spreaders.
std::vector<char> find_hung(const BuiltLift& model) {
  const dynamics::Mechanism& mechanism = model.system.mechanism();
  std::vector<char> hung(static_cast<std::size_t>(mechanism.body_count()), 0);
  hung[model.load] = 1;
  for (const LiftSpreader& bar : model.spreaders) hung[bar.body] = 1;
  for (const LiftHoist& hoist : model.hoists)
    for (BodyIndex body = hoist.hook; body > dynamics::world_index;
         body = mechanism.body(body).parent)
      hung[body] = 1;
  return hung;
}

/// Do ropes hold the load that have not parted?
bool is_held(const BuiltLift& model, const std::vector<char>& parted) {
  const dynamics::Mechanism& mechanism = model.system.mechanism();
  const std::vector<char> hung = find_hung(model);
  TiedBodies bodies(mechanism.body_count());
  for (BodyIndex body = 1; body < mechanism.body_count(); ++body)
    if (hung[body] == 0) bodies.tie(body, dynamics::world_index);
  // A hook that turns stands on bodies of its own.
  for (const LiftHoist& hoist : model.hoists)
    for (BodyIndex body = hoist.hook; mechanism.body(body).parent > dynamics::world_index;
         body = mechanism.body(body).parent)
      bodies.tie(body, mechanism.body(body).parent);
  const auto& ropes = model.system.ropes();
  for (std::size_t i = 0; i < ropes.size(); ++i) {
    if (parted[i] != 0) continue;
    const BodyIndex first = ropes[i].points().front().body;
    for (const dynamics::BodyPoint& point : ropes[i].points()) bodies.tie(point.body, first);
    for (const dynamics::RopeEdge& edge : ropes[i].edges()) bodies.tie(edge.body, first);
  }
  return bodies.are_tied(model.load, dynamics::world_index);
}

/// The first of the ropes that parted after which none holds the load, counted from 1; 0: one does.
std::size_t find_last_to_hold(const LiftRun& lift) {
  const std::vector<dynamics::PartedRope>& partings = lift.dynamic_result.parted;
  std::vector<char> parted(lift.model.system.ropes().size(), 0);
  for (std::size_t count = 1; count <= partings.size(); ++count) {
    parted[partings[count - 1].rope] = 1;
    if (!is_held(lift.model, parted)) return count;
  }
  return 0;
}

/// What becomes of a load that falls from a sample on.
std::string describe_fall(const LiftRun& lift, Eigen::Index begin) {
  const dynamics::History& history = lift.dynamic_history();
  const dynamics::BodyHistory& load = history.bodies[lift.model.load - 1];
  const auto height = [&](Eigen::Index sample) { return load.pose(sample, 2); };
  for (Eigen::Index k = begin + 1; k < history.sample_count(); ++k) {
    const bool meets = std::any_of(history.supports.begin(), history.supports.end(),
                                   [&](const dynamics::SupportHistory& pad) {
                                     return pad.normal_force[k] > 0 && pad.normal_force[k - 1] == 0;
                                   });
    if (meets)
      return fmt::format("the load falls {:.2f} m and meets the ground at {:.2f} s with {:.1f} m/s",
                         height(begin) - height(k), history.time[k],
                         std::max(0.0, -load.velocity(k - 1, 5)));
  }
  const Eigen::Index after = history.sample_count() - begin;
  return fmt::format("the load falls {:.4g} m",
                     height(begin) - load.pose.col(2).tail(after).minCoeff());
}

std::string names_of_parted(const LiftRun& lift, std::size_t count) {
  std::string names;
  for (std::size_t i = 0; i < count; ++i)
    names +=
        (i == 0 ? "" : ", ") + lift.model.system.ropes()[lift.dynamic_result.parted[i].rope].name();
  return names;
}

/// Share of the load's weight that pads, the ground and still water at its place bear at a sample.
double borne_share(const LiftCase& lift_case, const LiftRun& lift, const dynamics::History& history,
                   Eigen::Index sample) {
  double borne = 0;
  for (const dynamics::SupportHistory& pad : history.supports) borne += pad.normal_force[sample];
  if (lift_case.load.vessel && lift_case.sea)
    borne += lift_case.sea->density * lift_case.gravity *
             calc_displaced_volume(dynamics::HullClusters(lift_case.load.vessel->hull),
                                   history.bodies[lift.model.load - 1].X_WB(sample));
  const double mass = lift.model.system.mechanism().body(lift.model.load).inertia.mass;
  return borne / (mass * lift_case.gravity);
}

}  // namespace

std::optional<Check> check_held(const LiftCase& lift_case, const LiftRun& lift) {
  constexpr double enough = 0.9, beside = 1e-9;  // of the weight, s
  const std::size_t count = find_last_to_hold(lift);
  if (count == 0) return std::nullopt;
  const dynamics::History& history = lift.dynamic_history();
  const double when = lift.dynamic_result.parted[count - 1].time;
  Eigen::Index sample = 0;
  while (sample + 1 < history.sample_count() && history.time[sample] < when - beside) ++sample;
  Check check = check_at_least(
      "all ropes of the load have parted: share of its weight that pads, ground or water bear",
      borne_share(lift_case, lift, history, sample), enough, "1");
  check.time = when;
  check.note = fmt::format("{} parted: {}", names_of_parted(lift, count),
                           check.pass ? "the load stands or floats" : describe_fall(lift, sample));
  return check;
}

}  // namespace blocklift::pipeline
