#include "pipeline/checks/gather_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/checks/frame_skew.h"
#include "pipeline/checks/lift_checks.h"
#include "pipeline/checks/rigging_facts.h"
#include "pipeline/checks/structure_skew.h"
#include "pipeline/lift/sling_ends.h"
#include "pipeline/measures/chart_derating.h"
#include "pipeline/measures/crane_measures.h"
#include "pipeline/measures/spreader_measures.h"
#include "structure/response/flexibility.h"

namespace blocklift::pipeline {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Largest load of one thing, and how the whole load and its own share of it grew.
/// @param total_at_rest, total_in_motion the whole load on the hooks at each sample.
LoadFacts load_facts(const VectorXd& at_rest, const VectorXd& in_motion,
                     const VectorXd& total_at_rest, const VectorXd& total_in_motion,
                     const LiftRun& lift, Index& sample_at_rest) {
  LoadFacts facts;
  Index moving = 0;
  facts.at_rest = at_rest.maxCoeff(&sample_at_rest);
  facts.in_motion = in_motion.maxCoeff(&moving);
  facts.time_at_rest = lift.static_history.time[sample_at_rest];
  facts.time_in_motion = lift.dynamic_history().time[moving];
  const double still = total_at_rest[sample_at_rest], now = total_in_motion[moving];
  if (facts.at_rest > 0 && facts.in_motion > 0) {
    // Where the load stands or floats no load hangs whose growth could be told.
    facts.amplification = still > 0 && now > 0 ? now / still : 1;
    facts.resharing = facts.in_motion / facts.at_rest / facts.amplification;
  }
  return facts;
}

/// Each factor that is larger than what is known so far.
void take_worse(const ComputedFactors& found, ComputedFactors& worst) {
  const auto larger = [](const std::optional<double>& one, std::optional<double>& known) {
    if (one && (!known || *one > *known)) known = one;
  };
  larger(found.skew, worst.skew);
  larger(found.centre_box, worst.centre_box);
  if (!worst.two_hooks) worst.two_hooks = found.two_hooks;
}

/// Facts of a lift that was simulated.
class LiftedFacts {
 public:
  LiftedFacts(const Assessment& assessment, LiftFacts& facts)
      : case_(assessment.lift_case),
        lift_(*assessment.lift),
        facts_(facts),
        rigging_(case_, lift_, compliance(assessment.block), lug_names(assessment.block)),
        total_at_rest_(rigging_.hook_load(lift_.static_history)),
        total_in_motion_(rigging_.hook_load(lift_.dynamic_history())) {}

  void add() {
    facts_.net_weight =
        lift_.model.system.mechanism().body(lift_.model.load).inertia.mass * case_.gravity;
    facts_.at_rest = total_at_rest_.maxCoeff();
    facts_.in_motion = total_in_motion_.maxCoeff();
    facts_.has_environment = lift_.model.calm.has_value();
    add_crane_measures(case_, lift_, crane_measures_);
    add_slings();
    for (const LugEnds& lug : find_lug_ends(lift_.model)) add_pull(lug);
    for (const LiftSpreader& bar : lift_.model.spreaders) add_spreader(bar);
    for (std::size_t h = 0; h < lift_.model.hoists.size(); ++h) add_hook(h);
    for (std::size_t c = 0; c < case_.cranes.size(); ++c) add_crane(c);
  }

 private:
  // What a rigid block would hide: its own compliance shares skew loads out.
  static Eigen::MatrixXd compliance(const BlockRun& block) {
    if (!block.responses) return {};
    return structure::find_lug_flexibility(*block.responses, 0).compliance;
  }
  static std::vector<std::string> lug_names(const BlockRun& block) {
    std::vector<std::string> names;
    if (block.model)
      for (const structure::LiftingPoint& lug : block.model->mesh().lifting_points)
        names.push_back(lug.name);
    return names;
  }

  LoadFacts load_of(const VectorXd& at_rest, const VectorXd& in_motion, Index& sample) const {
    return load_facts(at_rest, in_motion, total_at_rest_, total_in_motion_, lift_, sample);
  }
  LoadFacts load_of(int rope, Index& sample) const {
    const auto i = static_cast<std::size_t>(rope);
    return load_of(lift_.static_history.ropes[i].tension, lift_.dynamic_history().ropes[i].tension,
                   sample);
  }

  void add_slings() {
    std::map<std::string, int> on_hook;
    for (const auto* slings : {&rigging_.slings(), &rigging_.baskets()})
      for (const LiftRope& sling : *slings) ++on_hook[sling.hoist];
    for (const auto* slings : {&rigging_.slings(), &rigging_.slings_to_bars(), &rigging_.baskets()})
      for (const LiftRope& rope : *slings) {
        Index sample = 0;
        SlingFacts sling = sling_facts(rope, on_hook, sample);
        sling.is_at_load = slings != &rigging_.slings_to_bars();
        if (slings != &rigging_.baskets()) sling.computed = rigging_.of_sling(rope, sample);
        facts_.slings.push_back(std::move(sling));
      }
    // The motion has their weight in the loads of hooks, and not in those of the lugs.
    for (const given::Spreader& bar : case_.spreaders) facts_.rigging += bar.mass() * case_.gravity;
    if (!case_.standard) return;
    for (const given::MasterLink& link : case_.standard->master_links) {
      facts_.rigging += link.mass * case_.gravity;
      rigging_at_[link.name.value] += link.mass * case_.gravity;
    }
  }

  // Each sling has its own factors, at the instant at which the lug bears most.
  void add_pull(const LugEnds& lug) {
    Index sample = 0;
    LugPull pull;
    pull.lug = lug.lug;
    pull.load = load_of(lug.load(lift_.static_history), lug.load(lift_.dynamic_history()), sample);
    for (const SlingEnd& end : lug.ends) {
      const LiftRope& rope = lift_.model.ropes[end.sling];
      const auto sling = std::find_if(facts_.slings.begin(), facts_.slings.end(),
                                      [&](const SlingFacts& one) { return one.name == rope.name; });
      SlingPull one;
      one.sling = rope.name;
      one.force = end.pull(lift_.static_history).row(sample);
      if (sling != facts_.slings.end()) {  // a rope that begins at a lug and ends at none is none
        one.computed = rigging_.of_sling(rope, sample);
        one.slings_on_hook = sling->slings_on_hook;
      }
      pull.slings.push_back(std::move(one));
    }
    facts_.pulls.push_back(std::move(pull));
  }

  SlingFacts sling_facts(const LiftRope& rope, const std::map<std::string, int>& on_hook,
                         Index& sample) {
    const given::Rope& in_case = *case_.find_rope(rope.name);
    const RopeModel& model = in_case.rope;
    SlingFacts sling;
    sling.name = rope.name;
    sling.lug = rope.lug;
    sling.hook = rope.hoist;
    sling.load = load_of(rope.rope, sample);
    sling.breaking_load = rope.breaking_load;
    if (model.material) sling.material = model.material->value;
    if (model.termination) sling.termination = model.termination->value;
    sling.diameter = model.diameter;
    sling.is_at_hook = in_case.path.front().kind == ResolvedPoint::Kind::hook;
    const Eigen::Vector3d pull = lift_.static_history.ropes[rope.rope].first_force.row(sample);
    if (pull.norm() > 0) sling.angle = std::acos(std::min(1.0, std::abs(pull.z()) / pull.norm()));
    sling.bend_diameter = bend_of(in_case);
    sling.runs_over_edges = !in_case.edges.empty();
    const auto count = on_hook.find(rope.hoist);
    sling.slings_on_hook = count == on_hook.end() ? 1 : count->second;
    const auto weight = rigging_.weight_of(rope);
    facts_.has_rigging_weight = facts_.has_rigging_weight && weight;
    // That of ropes that hang by it is in the loads of the hooks already.
    if (case_.hangs(in_case)) return sling;
    facts_.rigging += weight.value_or(0);
    rigging_at_[rope.hoist] += weight.value_or(0);
    return sling;
  }

  // What a sling is bent round, if it is told of the sling itself or an edge; none: the standard's.
  std::optional<double> bend_of(const given::Rope& rope) const {
    const std::optional<RopeBend> bend = find_bend(rope, lift_);
    if (!bend) return std::nullopt;
    double least = bend->diameter;
    if (!rope.bend_diameter && case_.standard)
      least = std::min(least, case_.standard->bend_of(rope.name.value).value_or(least));
    return least;
  }

  void add_spreader(const LiftSpreader& bar) {
    SpreaderFacts spreader;
    spreader.name = bar.name;
    Index sample = 0;
    spreader.load = load_of(hung_load(bar, lift_.static_history),
                            hung_load(bar, lift_.dynamic_history()), sample);
    const given::Spreader& in_case = *case_.find_spreader(bar.name);
    spreader.is_frame = in_case.is_frame();
    spreader.borne_at_rest = borne_load(in_case, bar, lift_.static_history);
    spreader.borne_in_motion = borne_load(in_case, bar, lift_.dynamic_history());
    for (const LiftSpreader::End& end : bar.ends) {
      if (!end.from_above) continue;
      const auto carries =
          std::find_if(facts_.slings.begin(), facts_.slings.end(), [&](const SlingFacts& sling) {
            return find_rope(lift_.model.ropes, lift_.model.hoists, sling.name) == end.rope;
          });
      if (carries == facts_.slings.end()) continue;
      take_worse(carries->computed, spreader.computed);
      spreader.slings_on_hook = std::max(spreader.slings_on_hook, carries->slings_on_hook);
    }
    if (const auto worst = worst_instant(in_case, bar, lift_.static_history);
        in_case.is_frame() && case_.standard && worst)
      spreader.rigging = rigging_.with_tolerances(*worst);
    find_frame_skew(in_case, bar, case_, lift_, spreader);
    facts_.spreaders.push_back(std::move(spreader));
  }

  /// The largest shares of a hoist's load chart. Beyond the chart it may carry nothing: a share of
  /// 1,000 stands for that, so that all figures stay finite.
  std::optional<ChartFacts> chart_of(const LiftHoist& hoist) const {
    constexpr double most = 1000;
    const auto find = [&](const char* kind) {
      return std::find_if(
          crane_measures_.begin(), crane_measures_.end(),
          [&](const LiftMeasure& one) { return one.subject == hoist.name && one.kind == kind; });
    };
    const auto share = find("share of the chart"), radius = find("radius");
    if (share == crane_measures_.end() || radius == crane_measures_.end()) return {};
    Index still = 0;
    ChartFacts chart;
    chart.at_rest = std::min(most, share->at_rest.maxCoeff(&still));
    chart.in_motion = std::min(most, share->in_motion.maxCoeff());
    chart.radius = radius->at_rest[still];
    chart.derating = find_chart_factor(*case_.cranes[hoist.crane].model, case_).text;
    return chart;
  }

  void add_hook(std::size_t index) {
    const LiftHoist& hoist = lift_.model.hoists[index];
    const given::Crane& crane = case_.cranes[hoist.crane];
    const HoistModel& model = *crane.model->find_hoist(hoist.name.substr(hoist.name.find('.') + 1));
    HookFacts hook;
    hook.name = hoist.name;
    hook.crane = crane.name.value;
    Index sample = 0;
    hook.load = load_of(hoist.rope, sample);
    hook.computed = rigging_.of_hook(index, sample);
    hook.hook_block = model.hook_block.mass * case_.gravity;
    hook.rigging = rigging_at_[hoist.name];
    hook.hoisting_speed = model.winch.speed.value.value;
    hook.capacity = hoist.capacity;
    hook.chart = chart_of(hoist);
    facts_.hooks.push_back(std::move(hook));
  }

  void add_crane(std::size_t index) {
    CraneFacts crane;
    crane.name = case_.cranes[index].name.value;
    Index sample = 0;
    crane.load = load_of(crane_load(lift_.model, lift_.static_history, index),
                         crane_load(lift_.model, lift_.dynamic_history(), index), sample);
    crane.computed = rigging_.of_crane(index, sample);
    for (const HookFacts& hook : facts_.hooks) {
      if (hook.crane != crane.name) continue;
      crane.hook_blocks += hook.hook_block;
      crane.rigging += hook.rigging;
      crane.hoisting_speed = std::max(crane.hoisting_speed, hook.hoisting_speed);
    }
    crane.capacity = case_.cranes[index].model->capacity;
    const auto is_of_crane = [&](const HookFacts& hook) { return hook.crane == crane.name; };
    if (std::count_if(facts_.hooks.begin(), facts_.hooks.end(), is_of_crane) == 1)
      crane.chart = std::find_if(facts_.hooks.begin(), facts_.hooks.end(), is_of_crane)->chart;
    facts_.cranes.push_back(std::move(crane));
  }

  const LiftCase& case_;
  const LiftRun& lift_;
  LiftFacts& facts_;
  RiggingFacts rigging_;
  VectorXd total_at_rest_, total_in_motion_;
  std::map<std::string, double> rigging_at_;  ///< by hook, N
  std::vector<LiftMeasure> crane_measures_;
};

/// Sums of a load table.
void add_table(const Assessment& assessment, LiftFacts& facts) {
  const auto& block = assessment.block.assessment.simultaneous;
  const auto sum = [](const structure::LoadCase& load) {
    structure::Vector3 total = structure::Vector3::Zero();
    for (const auto& force : load.lug_forces_B) total += force;
    return total.norm();
  };
  facts.rest_is_from = "load_table";
  facts.net_weight = assessment.block.model->mass_properties().mass * assessment.lift_case.gravity;
  facts.at_rest = sum(block.static_state.load);
  facts.in_motion = sum(block.dynamic_state.load);
  const auto& lugs = assessment.block.model->mesh().lifting_points;
  for (std::size_t i = 0; i < lugs.size(); ++i) {
    LugPull pull;
    pull.lug = lugs[i].name;
    pull.load.at_rest = block.static_state.load.lug_forces_B[i].norm();
    pull.load.in_motion = block.dynamic_state.load.lug_forces_B[i].norm();
    if (!(pull.load.at_rest > 0)) continue;
    pull.load.amplification = facts.in_motion / facts.at_rest;
    pull.load.resharing = pull.load.in_motion / pull.load.at_rest / pull.load.amplification;
    facts.pulls.push_back(std::move(pull));
  }
}

LugFacts lug_facts(const PadeyeAssessment& padeye, const LiftFacts& facts) {
  LugFacts lug;
  lug.name = padeye.lug;
  lug.input = padeye.input;
  const PadeyeState& at_rest = padeye.states.front();
  const PadeyeState& in_motion = padeye.states[std::min<std::size_t>(1, padeye.states.size() - 1)];
  lug.at_rest = at_rest.force_P;
  lug.in_motion = in_motion.force_P;
  for (const PadeyeState& state : padeye.states) {
    const double share = std::abs(state.force_P.z()) / state.force_P.norm();
    if (!(share > lug.lateral)) continue;
    lug.lateral = share;
    lug.lateral_time = state.time;
  }
  const auto pull = std::find_if(facts.pulls.begin(), facts.pulls.end(),
                                 [&](const LugPull& one) { return one.lug == padeye.lug; });
  if (pull == facts.pulls.end()) throw std::logic_error("nothing pulls at lug " + padeye.lug);
  lug.pull = *pull;
  return lug;
}

/// A group or the surroundings of a lug, with its stress at rest and in motion.
struct StressOfPlace {
  std::string name, material, part;
  double at_rest = 0, in_motion = 0, yield = 0;
};

/// The most used group of each material, and the most used surroundings of a lug.
void add_stresses(const std::vector<StressOfPlace>& groups, const std::vector<StressOfPlace>& lugs,
                  const std::optional<structure::SquareSite>& site, LiftFacts& facts) {
  const std::string where = site ? fmt::format(", {}", structure::words_of(*site)) : std::string();
  const auto facts_of = [&](const StressOfPlace& place, bool is_at_lug) {
    StressFacts one;
    one.name = (is_at_lug ? "about lug " + place.name : place.material) + where;
    if (!is_at_lug) one.material = place.material;
    one.is_at_lug = is_at_lug;
    if (is_at_lug) one.lug = place.name;
    one.at_rest = place.at_rest;
    one.in_motion = place.in_motion;
    one.yield = place.yield;
    one.site = site;
    return one;
  };
  const auto use = [](const StressFacts& s) { return std::max(s.at_rest, s.in_motion) / s.yield; };
  std::map<std::string, StressFacts> by_material;
  for (const StressOfPlace& place : groups) {
    const StressFacts one = facts_of(place, false);
    const auto [known, is_new] = by_material.emplace(place.material, one);
    if (!is_new && use(one) > use(known->second)) known->second = one;
  }
  for (auto& [material, stress] : by_material) facts.stresses.push_back(stress);
  std::optional<StressFacts> worst;
  for (const StressOfPlace& lug : lugs) {
    StressFacts one = facts_of(lug, true);
    // The part about the lug is one of a group's plates: "web_frames at x = 4 m".
    std::size_t longest = 0;
    for (const StressOfPlace& group : groups) {
      if (one.yield > 0 && (!lug.part.starts_with(group.name) || group.name.size() < longest))
        continue;
      one.yield = group.yield;
      if (lug.part.starts_with(group.name)) longest = group.name.size();
    }
    if (one.yield > 0 && (!worst || use(one) > use(*worst))) worst = one;
  }
  if (worst) facts.stresses.push_back(*worst);
}

const HistoryExtreme& extreme_of(const HistoryGroup& place,
                                 const std::optional<structure::SquareSite>& site) {
  return site ? place.at_site[*site] : place.checked_von_mises;
}

template <class Place>
const structure::Extreme& extreme_of(const Place& place,
                                     const std::optional<structure::SquareSite>& site) {
  return site ? place.at_site[*site] : place.checked_von_mises;
}

/// @param site of the squares that are looked at; none: all.
void add_structure(const BlockRun& block, const std::optional<structure::SquareSite>& site,
                   LiftFacts& facts) {
  std::vector<StressOfPlace> groups, lugs;
  if (block.history) {
    const HistoryState &still = block.history->static_state, &moving = block.history->dynamic_state;
    for (std::size_t i = 0; i < moving.groups.size(); ++i) {
      const HistoryGroup& group = moving.groups[i];
      const HistoryExtreme& found = extreme_of(group, site);
      if (found.at.instant >= 0)
        groups.push_back({group.name,
                          group.material,
                          {},
                          extreme_of(still.groups[i], site).at.value,
                          found.at.value,
                          group.yield_stress});
    }
    for (std::size_t i = 0; i < moving.lugs.size(); ++i) {
      const HistoryExtreme& found = extreme_of(moving.lugs[i], site);
      if (found.at.instant >= 0)
        lugs.push_back({moving.lugs[i].name,
                        {},
                        found.at.part,
                        extreme_of(still.lugs[i], site).at.value,
                        found.at.value,
                        0});
    }
  } else {
    const auto &still = block.assessment.simultaneous.static_state.result,
               &moving = block.assessment.simultaneous.dynamic_state.result;
    for (std::size_t i = 0; i < moving.groups.size(); ++i) {
      const structure::GroupStress& group = moving.groups[i];
      const structure::Extreme& found = extreme_of(group, site);
      if (!found.part.empty())
        groups.push_back({group.group,
                          group.material,
                          {},
                          extreme_of(still.groups[i], site).value,
                          found.value,
                          group.yield_stress});
    }
    for (std::size_t i = 0; i < moving.lugs.size(); ++i) {
      const structure::Extreme& found = extreme_of(moving.lugs[i], site);
      if (!found.part.empty())
        lugs.push_back({moving.lugs[i].lug,
                        {},
                        found.part,
                        extreme_of(still.lugs[i], site).value,
                        found.value,
                        0});
    }
  }
  add_stresses(groups, lugs, site, facts);
}

}  // namespace

LiftFacts gather_facts(const Assessment& assessment) {
  LiftFacts facts;
  facts.yield_factor = assessment.lift_case.checks.yield_factor;
  facts.spreader_factor = spreader_factor(assessment.lift_case.checks);
  facts.lateral = assessment.lift_case.checks.lug_side_load;
  if (assessment.lift)
    LiftedFacts(assessment, facts).add();
  else
    add_table(assessment, facts);
  for (const PadeyeAssessment& padeye : assessment.block.padeyes.padeyes)
    facts.lugs.push_back(lug_facts(padeye, facts));
  if (assessment.block.model) {
    if (tells_sites_apart(assessment.lift_case)) {
      for (const structure::SquareSite site : structure::square_sites)
        add_structure(assessment.block, site, facts);
    } else {
      add_structure(assessment.block, {}, facts);
    }
  }
  if (assessment.lift_case.standard && assessment.block.responses)
    add_structure_skew(assessment, facts);
  return facts;
}

}  // namespace blocklift::pipeline
