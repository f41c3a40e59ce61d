#include "pipeline/lift/block_assessment.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "pipeline/lift/stopwatch.h"
#include "structure/response/flexibility.h"

namespace blocklift::pipeline {

namespace {

void require_balance(const BlockState& state) {
  const structure::LoadBalance& balance = state.result.balance;
  if (balance.force_residual < largest_balance_residual &&
      balance.moment_residual < largest_balance_residual &&
      balance.reaction_over_weight < largest_reaction)
    return;
  throw std::runtime_error(fmt::format(
      "the loads of \"{}\" on the block are not in balance: force residual {:.1e}, moment residual "
      "{:.1e} (allowed {:.0e}), support reaction over weight {:.1e} (allowed {:.0e})",
      state.load.name, balance.force_residual, balance.moment_residual, largest_balance_residual,
      balance.reaction_over_weight, largest_reaction));
}

/// A state that is yet to be evaluated.
BlockState make_state(structure::LoadCase load, std::string name, std::string rope = {},
                      std::optional<double> time = {}) {
  BlockState state;
  load.name = std::move(name);
  state.load = std::move(load);
  state.rope = std::move(rope);
  state.time = time;
  return state;
}

/// Evaluates states by the responses of one block, all in one pass.
void evaluate(const structure::StressRecovery& recovery, std::vector<BlockState>& states) {
  std::vector<structure::LoadCase> loads;
  for (const BlockState& state : states) loads.push_back(state.load);
  std::vector<structure::LoadCaseResult> results = recovery.evaluate(loads);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].result = std::move(results[i]);
    require_balance(states[i]);
  }
}

LoadComparison compare(BlockState static_state, BlockState dynamic_state) {
  LoadComparison comparison;
  comparison.static_displacement = static_state.result.displacement.value;
  comparison.dynamic_displacement = dynamic_state.result.displacement.value;
  comparison.static_state = std::move(static_state);
  comparison.dynamic_state = std::move(dynamic_state);
  return comparison;
}

/// The instants of the ropes' maxima as one: the state of the largest checked stress among them,
/// so is the largest displacement.
LoadComparison largest_of(const std::vector<LoadComparison>& by_rope) {
  const auto largest = [&](const BlockState LoadComparison::*state) {
    return *std::max_element(by_rope.begin(), by_rope.end(), [&](const auto& a, const auto& b) {
      return (a.*state).result.checked_von_mises.value < (b.*state).result.checked_von_mises.value;
    });
  };
  LoadComparison result;
  result.static_state = largest(&LoadComparison::static_state).static_state;
  result.dynamic_state = largest(&LoadComparison::dynamic_state).dynamic_state;
  for (const LoadComparison& comparison : by_rope) {
    result.static_displacement =
        std::max(result.static_displacement, comparison.static_displacement);
    result.dynamic_displacement =
        std::max(result.dynamic_displacement, comparison.dynamic_displacement);
  }
  return result;
}

}  // namespace

double LoadComparison::stress_increase_percent() const {
  return percent_above(dynamic_state.result.checked_von_mises.value,
                       static_state.result.checked_von_mises.value);
}

double LoadComparison::deformation_increase_percent() const {
  return percent_above(dynamic_displacement, static_displacement);
}

double find_first_elastic_period(const structure::UnitResponses& responses) {
  constexpr double residual = 0.1;  // its square is the error
  return 2 * std::numbers::pi /
         structure::find_free_modes(responses, 1, residual).angular_frequencies[0];
}

BlockAssessment assess_block(const structure::UnitResponses& responses,
                             const structure::StressRecovery& recovery,
                             const BlockAttachment& attachment, const BlockHistory& static_history,
                             const BlockHistory& dynamic_history) {
  Stopwatch watch;
  const structure::MassProperties& mass = responses.model().mass_properties();
  const auto static_maxima = dynamics::find_largest_tensions(static_history.motion);
  const auto dynamic_maxima = dynamics::find_largest_tensions(dynamic_history.motion);

  // Pairs of a static and a dynamic state: the ropes' maxima at once, then rope after rope.
  std::vector<BlockState> states;
  states.push_back(make_state(map_rope_maxima(static_history, static_maxima, attachment, mass),
                              "every rope at its own largest static load"));
  states.push_back(make_state(map_rope_maxima(dynamic_history, dynamic_maxima, attachment, mass),
                              "every rope at its own largest dynamic load"));
  const auto at_maximum = [&](const BlockHistory& history, const dynamics::LinkedMaximum& maximum,
                              const char* state) {
    const std::string& rope = history.motion.ropes[maximum.rope].name;
    return make_state(map_instant(history, maximum.sample, attachment, mass),
                      fmt::format("largest {} load of rope {}", state, rope), rope, maximum.time);
  };
  std::vector<int> ropes;
  for (const LugRope& end : attachment.ropes) ropes.push_back(end.rope);
  ropes.insert(ropes.end(), attachment.baskets.begin(), attachment.baskets.end());
  for (const int pulling : ropes) {
    const auto rope = static_cast<std::size_t>(pulling);
    states.push_back(at_maximum(static_history, static_maxima[rope], "static"));
    states.push_back(at_maximum(dynamic_history, dynamic_maxima[rope], "dynamic"));
  }
  evaluate(recovery, states);

  BlockAssessment assessment;
  assessment.per_rope_maxima = compare(std::move(states[0]), std::move(states[1]));
  for (std::size_t i = 2; i < states.size(); i += 2)
    assessment.simultaneous_by_rope.push_back(
        compare(std::move(states[i]), std::move(states[i + 1])));
  assessment.simultaneous = largest_of(assessment.simultaneous_by_rope);
  assessment.evaluation_s = watch.lap();
  return assessment;
}

BlockAssessment assess_load_table(const structure::UnitResponses& responses,
                                  const structure::StressRecovery& recovery,
                                  const std::vector<structure::Vector3>& static_forces_B,
                                  const std::vector<structure::Vector3>& dynamic_forces_B) {
  Stopwatch watch;
  const structure::ElasticModel& model = responses.model();
  const auto state_of = [&](const std::vector<structure::Vector3>& forces_B, const char* name) {
    return make_state(
        map_load_table(forces_B, model.mesh().lifting_points, model.mass_properties()), name);
  };
  std::vector<BlockState> states{state_of(static_forces_B, "static loads of the table"),
                                 state_of(dynamic_forces_B, "dynamic loads of the table")};
  evaluate(recovery, states);
  BlockAssessment assessment;
  assessment.per_rope_maxima = compare(std::move(states[0]), std::move(states[1]));
  assessment.simultaneous = assessment.per_rope_maxima;
  assessment.evaluation_s = watch.lap();
  return assessment;
}

}  // namespace blocklift::pipeline
