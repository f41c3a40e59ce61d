#include "pipeline/checks/lift_checks.h"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "dynamics/marine/hull/hydrostatics.h"
#include "pipeline/checks/loop_loads.h"
#include "pipeline/checks/lost_load.h"
#include "pipeline/lift/history_figures.h"
#include "pipeline/standards/sling_factor.h"

namespace blocklift::pipeline {

namespace {

/// A largest or smallest value with its time.
struct Peak {
  double value = 0;
  double time = 0;
};

enum class Wanted { largest, smallest };

/// Peak of a series of the static and of the dynamic history, whichever is further out. Where a
/// sample is not a number, neither is the peak: it fails its check.
template <class Series>
Peak peak_of(const LiftRun& lift, Wanted wanted, const Series& series) {
  Peak peak{wanted == Wanted::largest ? -std::numeric_limits<double>::infinity()
                                      : std::numeric_limits<double>::infinity(),
            0};
  for (const dynamics::History* history : {&lift.static_history, &lift.dynamic_history()}) {
    const Eigen::VectorXd values = series(*history);
    Eigen::Index at = 0;
    const double value = wanted == Wanted::largest ? values.maxCoeff<Eigen::PropagateNaN>(&at)
                                                   : values.minCoeff<Eigen::PropagateNaN>(&at);
    if (std::isnan(value)) return {value, history->time(at)};
    if (wanted == Wanted::largest ? value > peak.value : value < peak.value)
      peak = {value, history->time(at)};
  }
  return peak;
}

auto tension_of(int rope) {
  return [rope](const dynamics::History& history) { return history.ropes[rope].tension; };
}

Check at_time(Check check, double time, std::string note = {}) {
  check.time = time;
  check.note = std::move(note);
  return check;
}

Check check_breaking_load(const LiftRun& lift, const std::string& what, int rope,
                          double breaking_load, double factor) {
  const Peak peak = peak_of(lift, Wanted::largest, tension_of(rope));
  return at_time(
      check_at_most(fmt::format("{}: tension against breaking load / {:g}", what, factor),
                    peak.value, breaking_load / factor, "N"),
      peak.time);
}

void add_capacities(const LiftCase& lift_case, const LiftRun& lift, std::vector<Check>& checks) {
  for (const LiftHoist& hoist : lift.model.hoists) {
    const Peak peak = peak_of(lift, Wanted::largest, tension_of(hoist.rope));
    checks.push_back(at_time(check_at_most("hoist " + hoist.name + ": load against capacity",
                                           peak.value, hoist.capacity, "N"),
                             peak.time, "hook block included"));
  }
  for (std::size_t crane = 0; crane < lift_case.cranes.size(); ++crane) {
    const given::Crane& in_case = lift_case.cranes[crane];
    if (!in_case.model->capacity) continue;
    const Peak peak = peak_of(lift, Wanted::largest, [&](const dynamics::History& history) {
      return crane_load(lift.model, history, crane);
    });
    checks.push_back(at_time(
        check_at_most("crane " + in_case.name.value + ": load of all hoists against capacity",
                      peak.value, *in_case.model->capacity, "N"),
        peak.time, "hook blocks included"));
  }
}

/// Where the load hangs: samples at which no pad bears it and, where it is a vessel, still water at
/// its place would not bear nine tenths of its weight.
std::vector<char> find_hanging(const LiftCase& lift_case, const LiftRun& lift,
                               const dynamics::History& history) {
  std::vector<char> hangs(static_cast<std::size_t>(history.sample_count()), 1);
  std::optional<dynamics::HullClusters> hull;
  if (lift_case.load.vessel) hull.emplace(lift_case.load.vessel->hull);
  const dynamics::BodyHistory& load = history.bodies[lift.model.load - 1];
  for (Eigen::Index k = 0; k < history.sample_count(); ++k) {
    char& here = hangs[k];
    for (const dynamics::SupportHistory& pad : history.supports) {
      if (pad.normal_force[k] > 0) here = 0;
    }
    if (!hull || here == 0) continue;
    const double displaced = lift_case.sea->density * calc_displaced_volume(*hull, load.X_WB(k));
    if (displaced >= 0.9 * lift.model.system.mechanism().body(lift.model.load).inertia.mass)
      here = 0;
  }
  return hangs;
}

/// Samples from a rope's parting on, where it cannot but be slack, are no evidence.
void pass_over_parted(const LiftRun& lift, std::size_t rope, const dynamics::History& history,
                      Eigen::VectorXd& tension) {
  if (&history != &lift.dynamic_history()) return;
  for (const dynamics::PartedRope& parted : lift.dynamic_result.parted) {
    if (static_cast<std::size_t>(parted.rope) != rope) continue;
    for (Eigen::Index k = 0; k < tension.size(); ++k)
      if (history.time[k] >= parted.time) tension[k] = std::numeric_limits<double>::infinity();
  }
}

/// What a rope pulls beyond its own weight, which it bears in a bight, too.
Eigen::VectorXd pull_beyond_weight(const LiftRun& lift, std::size_t rope,
                                   const dynamics::RopeHistory& history) {
  const double weight = lift.model.system.ropes()[rope].definition().weight_per_length;
  if (weight == 0) return history.tension;
  return history.tension - weight * history.unstretched_length;
}

/// When a rope must pull.
enum class Duty {
  always,            ///< a mooring line, a warp
  while_load_hangs,  ///< at a lug or round edges: it may lie slack while the load stands or floats
  hook_at_least,     ///< a tackle, which bears its hook block alone while the load does not hang
  hook_alone         ///< a tackle without slings
};

/// By the index of ropes in the system.
std::vector<Duty> find_duties(const LiftCase& lift_case, const LiftRun& lift) {
  std::vector<Duty> duties(lift.static_history.ropes.size(), Duty::always);
  for (const LiftHoist& hoist : lift.model.hoists) {
    Duty& duty = duties[hoist.rope];
    if (duty != Duty::hook_at_least) duty = Duty::hook_alone;  // an equalised one may have slings
    for (const given::Rope& rope : lift_case.ropes)
      for (const ResolvedPoint& point : rope.path)
        if (point.kind == ResolvedPoint::Kind::hook &&
            point.body_name(lift_case.cranes) == hoist.name)
          duty = Duty::hook_at_least;
  }
  for (const LiftRope& rope : lift.model.ropes)
    if (rope.holds_load()) duties[rope.rope] = Duty::while_load_hangs;
  return duties;
}

/// Tensions without those that say nothing of a rope's slackness, which become infinite.
/// @param hangs where the load hangs, see find_hanging.
void pass_over_idle(Duty duty, const std::vector<char>& hangs, Eigen::VectorXd& tension) {
  if (duty == Duty::always) return;
  for (Eigen::Index k = 0; k < tension.size(); ++k) {
    if (!std::isfinite(tension[k])) continue;
    if (hangs[k] != 0 && duty != Duty::hook_alone) continue;
    if (duty == Duty::while_load_hangs || tension[k] > 0)
      tension[k] = std::numeric_limits<double>::infinity();
  }
}

/// Slings may lie slack while the load stands or floats; all other ropes never. A tackle that bears
/// its hook block alone pulls little and is not held against the smallest tension.
void add_slack(const LiftCase& lift_case, const LiftRun& lift, std::vector<Check>& checks) {
  const auto static_hangs = find_hanging(lift_case, lift, lift.static_history);
  const auto dynamic_hangs = find_hanging(lift_case, lift, lift.dynamic_history());
  const std::vector<Duty> duties = find_duties(lift_case, lift);
  Peak smallest{std::numeric_limits<double>::infinity(), 0};
  std::string rope;
  for (std::size_t i = 0; i < lift.static_history.ropes.size(); ++i) {
    const Peak peak = peak_of(lift, Wanted::smallest, [&](const dynamics::History& history) {
      Eigen::VectorXd tension = pull_beyond_weight(lift, i, history.ropes[i]);
      pass_over_parted(lift, i, history, tension);
      pass_over_idle(duties[i], &history == &lift.static_history ? static_hangs : dynamic_hangs,
                     tension);
      return tension;
    });
    if (peak.value >= smallest.value) continue;
    smallest = peak;
    rope = lift.static_history.ropes[i].name;
    if (std::isnan(peak.value)) break;
  }
  if (rope.empty()) return;  // the load never hangs
  checks.push_back(at_time(check_at_least("slack: smallest tension of any rope, " + rope,
                                          smallest.value, lift_case.checks.smallest_tension, "N"),
                           smallest.time,
                           std::string("the demand must stay above the limit; ropes at the load, "
                                       "and its hooks: while it hangs") +
                               (lift_case.rope_weight && lift_case.rope_weight->value
                                    ? "; less the own weight of ropes that have some"
                                    : "")));
}

void add_swing(const LiftRun& lift, double limit, std::vector<Check>& checks) {
  Peak largest{-1, 0};
  std::string name;
  for (const LiftHoist& hoist : lift.model.hoists) {
    const Peak peak = peak_of(lift, Wanted::largest, [&](const dynamics::History& history) {
      return swing_angles(hook_pull(history.ropes[hoist.rope], hoist.hook_is_first));
    });
    if (peak.value <= largest.value) continue;
    largest = peak;
    name = hoist.name;
    if (std::isnan(peak.value)) break;
  }
  checks.push_back(
      at_time(check_at_most("swing: largest angle of a hoist against the plumb, " + name,
                            largest.value, limit, "rad"),
              largest.time));
}

/// Does a rope press on one of its edges at any instant?
bool touches(const dynamics::RopeHistory& rope, std::size_t edge) {
  return (rope.edges[edge].wrap.array() > 0 && rope.tension.array() > 0).any();
}

std::string note_on_bend(const given::Rope& rope, const RopeBend& bend, double left) {
  const std::string edge = bend.edge.empty() ? std::string() : " of edge " + bend.edge;
  if (!rope.rope.diameter)
    return fmt::format(
        "bent round D {:.4g} m{}: its model has no diameter, and no loss by bending "
        "is counted",
        bend.diameter, edge);
  return fmt::format(
      "bent round D/d {:.2f}{}: {:.1f} % of the breaking load is left (0027/ND, 7.8)",
      bend.diameter / *rope.rope.diameter, edge, 100 * left);
}

}  // namespace

std::optional<RopeBend> find_bend(const given::Rope& rope, const LiftRun& lift) {
  std::optional<RopeBend> bend;
  if (rope.bend_diameter) bend = {rope.bend_diameter->value};
  const int index = find_rope(lift.model.ropes, lift.model.hoists, rope.name.value);
  for (std::size_t edge = 0; edge < rope.edges.size(); ++edge) {
    const double diameter = 2 * rope.edges[edge].radius;
    if (bend && bend->diameter <= diameter) continue;
    for (const dynamics::History* history : {&lift.static_history, &lift.dynamic_history()})
      if (touches(history->ropes[index], edge)) bend = {diameter, rope.edges[edge].name.value};
  }
  return bend;
}

double bend_efficiency(const given::Rope& rope, const LiftRun& lift) {
  const std::optional<RopeBend> bend = find_bend(rope, lift);
  if (!bend || !rope.rope.diameter) return 1;
  return bend_efficiency(bend->diameter, *rope.rope.diameter);
}

std::vector<Check> check_lift(const LiftCase& lift_case, const LiftRun& lift) {
  const double factor = lift_case.checks.rope_safety_factor;
  std::vector<Check> checks;
  for (const LiftRope& rope : lift.model.ropes) {
    const given::Rope& in_case = *lift_case.find_rope(rope.name);
    const double left = bend_efficiency(in_case, lift);
    checks.push_back(check_breaking_load(lift, "rope " + rope.name, rope.rope,
                                         left * rope.breaking_load, factor));
    if (const auto bend = find_bend(in_case, lift))
      checks.back().note = note_on_bend(in_case, *bend, left);
  }
  for (const LiftHoist& hoist : lift.model.hoists) {
    checks.push_back(
        check_breaking_load(lift, "tackle " + hoist.name, hoist.rope, hoist.breaking_load, factor));
  }
  if (lift_case.checks.crane_capacity) add_capacities(lift_case, lift, checks);
  add_slack(lift_case, lift, checks);
  for (Check& check : check_equalisers(lift, lift_case.checks.smallest_tension)) {
    checks.push_back(std::move(check));
  }
  if (lift_case.checks.largest_swing) add_swing(lift, *lift_case.checks.largest_swing, checks);
  if (std::optional<Check> held = check_held(lift_case, lift)) checks.push_back(std::move(*held));
  return checks;
}

bool tells_sites_apart(const LiftCase& lift_case) {
  return lift_case.standard && lift_case.standard->rules.fine_mesh;
}

std::vector<Check> check_block(const LiftCase& lift_case, const BlockAssessment& block,
                               const HistoryAssessment* history) {
  using Site = std::optional<structure::SquareSite>;
  std::map<std::pair<std::string, int>, Check> worst;  // by material and site
  const auto consider = [&](const std::string& material, double yield_stress, double stress,
                            std::optional<double> time, const std::string& place,
                            const Site& site) {
    const ClauseFactor* local = site ? lift_case.standard->rules.fine_mesh->of(*site) : nullptr;
    const double factor = local ? local->value : 1;
    Check check = check_at_most(
        fmt::format("stress in {}{}: checked von Mises against {}yield / {:g}", material,
                    site ? fmt::format(" {}", structure::words_of(*site)) : std::string(),
                    local ? fmt::format("{:g} x ", factor) : std::string(),
                    lift_case.checks.yield_factor),
        stress, factor * yield_stress / lift_case.checks.yield_factor, "Pa");
    check.time = time;
    check.note = local ? fmt::format("{}; {}", place, local->clause) : place;
    check.is_by_mesh = true;
    const std::pair key{material, site ? static_cast<int>(*site) : -1};
    const auto found = worst.find(key);
    if (found == worst.end() || !(check.utilisation <= found->second.utilisation))
      worst[key] = check;
  };
  std::vector<Site> sites{Site{}};
  if (tells_sites_apart(lift_case))
    sites.assign(structure::square_sites.begin(), structure::square_sites.end());
  for (const Site& site : sites) {
    if (history) {
      for (const HistoryState* state : {&history->static_state, &history->dynamic_state})
        for (const HistoryGroup& group : state->groups) {
          const HistoryExtreme& found = site ? group.at_site[*site] : group.checked_von_mises;
          if (found.at.instant >= 0)
            consider(group.material, group.yield_stress, found.at.value, found.time, found.at.part,
                     site);
        }
    } else {
      const LoadComparison& way = block.simultaneous;
      for (const BlockState* state : {&way.static_state, &way.dynamic_state})
        for (const structure::GroupStress& group : state->result.groups) {
          const structure::Extreme& found = site ? group.at_site[*site] : group.checked_von_mises;
          if (!found.part.empty())
            consider(group.material, group.yield_stress, found.value, state->time, found.part,
                     site);
        }
    }
  }
  std::vector<Check> checks;
  for (auto& [key, check] : worst) checks.push_back(check);
  return checks;
}

}  // namespace blocklift::pipeline
