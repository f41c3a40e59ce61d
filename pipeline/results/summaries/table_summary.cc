#include "pipeline/results/summaries/table_summary.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/declaration/quantity.h"
#include "pipeline/formats/json_values.h"

namespace blocklift::pipeline {

namespace {

double in_tonnes(double newtons) { return newtons / newton_per_tonne; }

std::string describe_balance(const char* when, const TableBalance& balance) {
  return fmt::format(
      "{} they sum to {:.4g} t ({:+.1f} %) and pull {:.3g} m beside the centre of mass, which "
      "leaves {:.3f} g and {:.3g} rad/s2",
      when, in_tonnes(balance.force_B.norm()), 100 * balance.acceleration(), balance.lever(),
      balance.acceleration(), balance.angular_acceleration_B.norm());
}

nlohmann::ordered_json balance_json(const TableBalance& balance) {
  return {{"sum_N", json_point(balance.force_B)},
          {"over_weight", json_number(balance.over_weight())},
          {"acceleration_g", json_number(balance.acceleration())},
          {"moment_about_centre_of_mass_Nm", json_point(balance.moment_B)},
          {"lever_m", json_number(balance.lever())},
          {"angular_acceleration_rad_s2", json_point(balance.angular_acceleration_B)}};
}

}  // namespace

std::optional<TableBalances> find_table_balances(const Assessment& assessment) {
  const BlockRun& block = assessment.block;
  if (!assessment.lift_case.load_table || !block.model) return {};
  const auto of = [&](const BlockState& state) {
    return find_table_balance(state.load.lug_forces_B, block.model->mesh().lifting_points,
                              block.model->mass_properties(), assessment.lift_case.gravity);
  };
  const LoadComparison& loads = block.assessment.simultaneous;
  return TableBalances{of(loads.static_state), of(loads.dynamic_state)};
}

std::vector<std::string> list_doubts(const TableBalances& balances) {
  const TableBalance& at_rest = balances.at_rest;
  std::vector<std::string> doubts;
  if (at_rest.is_off_weight()) {
    const bool is_short = at_rest.acceleration() < 0;
    doubts.push_back(fmt::format(
        "The loads of the table at rest sum to {:.4g} t, {:.1f} % {} than the weight of the block, "
        "{:.4g} t; usually they are within {:.0f} % of it. The block is taken to {} with {:.3f} g, "
        "and its stress is not that of rest. {}",
        in_tonnes(at_rest.force_B.norm()), 100 * std::abs(at_rest.acceleration()),
        is_short ? "less" : "more", in_tonnes(at_rest.weight), 100 * TableBalance::largest_share,
        is_short ? "fall" : "rise", std::abs(at_rest.acceleration()),
        is_short ? "Is a lug missing?" : "Are they loads of different instants?"));
  }
  if (at_rest.turns())
    doubts.push_back(fmt::format(
        "The loads of the table at rest pull {:.3g} m beside the centre of mass, {:.0f} % of the "
        "radius of gyration; usually it is less than {:.0f} %. The block is taken to turn with an "
        "angular acceleration of {:.3g} rad/s2, and its stress is not that of rest. Do the loads "
        "belong to these lugs?",
        at_rest.lever(), 100 * at_rest.lever() / at_rest.radius_of_gyration,
        100 * TableBalance::largest_lever, at_rest.angular_acceleration_B.norm()));
  return doubts;
}

std::string describe_balances(const TableBalances& balances) {
  return fmt::format("Loads of the table, for a weight of {:.4g} t: {}; {}.",
                     in_tonnes(balances.at_rest.weight),
                     describe_balance("at rest", balances.at_rest),
                     describe_balance("in motion", balances.in_motion));
}

nlohmann::ordered_json table_balances_json(const TableBalances& balances) {
  return {{"weight_N", balances.at_rest.weight},
          {"static", balance_json(balances.at_rest)},
          {"dynamic", balance_json(balances.in_motion)}};
}

}  // namespace blocklift::pipeline
