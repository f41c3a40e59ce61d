#include "pipeline/assessment/block_assessment.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "pipeline/assessment/stopwatch.h"

namespace blocklift::pipeline {

namespace {

double percent_above(double value, double reference) {
  return reference > 0 ? 100 * (value / reference - 1) : 0;
}

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

/// Evaluates states by the responses of one block.
class StateEvaluator {
 public:
  StateEvaluator(const structure::StressRecovery& recovery) : recovery_(recovery) {}

  BlockState evaluate(structure::LoadCase load, std::string name, std::string rope = {},
                      std::optional<double> time = {}) const {
    BlockState state;
    load.name = std::move(name);
    state.result = recovery_.evaluate(load);
    state.load = std::move(load);
    state.rope = std::move(rope);
    state.time = time;
    require_balance(state);
    return state;
  }

 private:
  const structure::StressRecovery& recovery_;
};

LoadComparison compare(BlockState static_state, BlockState dynamic_state) {
  LoadComparison comparison;
  comparison.static_displacement = static_state.result.displacement.value;
  comparison.dynamic_displacement = dynamic_state.result.displacement.value;
  comparison.static_state = std::move(static_state);
  comparison.dynamic_state = std::move(dynamic_state);
  return comparison;
}

/// The instants of the ropes' maxima as one: the state of the largest checked stress among them, the
/// largest displacement likewise.
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

BlockAssessment assess_block(const structure::UnitResponses& responses,
                             const structure::StressRecovery& recovery,
                             const BlockAttachment& attachment,
                             const dynamics::History& static_history,
                             const dynamics::History& dynamic_history) {
  Stopwatch watch;
  const structure::MassProperties& mass = responses.model().mass_properties();
  const StateEvaluator evaluator(recovery);
  const auto static_maxima = dynamics::find_largest_tensions(static_history);
  const auto dynamic_maxima = dynamics::find_largest_tensions(dynamic_history);

  BlockAssessment assessment;
  assessment.per_rope_maxima =
      compare(evaluator.evaluate(map_rope_maxima(static_history, static_maxima, attachment, mass),
                                 "every rope at its own largest static load"),
              evaluator.evaluate(map_rope_maxima(dynamic_history, dynamic_maxima, attachment, mass),
                                 "every rope at its own largest dynamic load"));

  const auto at_maximum = [&](const dynamics::History& history,
                              const dynamics::LinkedMaximum& maximum, const char* state) {
    const std::string& rope = history.ropes[static_cast<std::size_t>(maximum.rope)].name;
    return evaluator.evaluate(map_instant(history, maximum.sample, attachment, mass),
                              fmt::format("largest {} load of rope {}", state, rope), rope,
                              maximum.time);
  };
  for (const LugRope& end : attachment.ropes) {
    const auto rope = static_cast<std::size_t>(end.rope);
    assessment.simultaneous_by_rope.push_back(
        compare(at_maximum(static_history, static_maxima[rope], "static"),
                at_maximum(dynamic_history, dynamic_maxima[rope], "dynamic")));
  }
  assessment.simultaneous = largest_of(assessment.simultaneous_by_rope);
  assessment.first_elastic_period = responses.first_elastic_period();
  assessment.evaluation_s = watch.lap();
  return assessment;
}

BlockAssessment assess_load_table(const structure::UnitResponses& responses,
                                  const structure::StressRecovery& recovery,
                                  const std::vector<structure::Vector3>& static_forces_B,
                                  const std::vector<structure::Vector3>& dynamic_forces_B) {
  Stopwatch watch;
  const structure::ElasticModel& model = responses.model();
  const StateEvaluator evaluator(recovery);
  const auto evaluate = [&](const std::vector<structure::Vector3>& forces_B, const char* name) {
    return evaluator.evaluate(map_load_table(forces_B, model.mesh().lugs, model.mass_properties()),
                              name);
  };
  BlockAssessment assessment;
  assessment.per_rope_maxima = compare(evaluate(static_forces_B, "static loads of the table"),
                                       evaluate(dynamic_forces_B, "dynamic loads of the table"));
  assessment.simultaneous = assessment.per_rope_maxima;
  assessment.first_elastic_period = responses.first_elastic_period();
  assessment.evaluation_s = watch.lap();
  return assessment;
}

}  // namespace blocklift::pipeline
