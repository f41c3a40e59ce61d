#include "pipeline/measures/tackle_measures.h"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {

namespace {

using dynamics::TackleMotion;
using dynamics::TackleShares;

void add_tackle(const HoistModel& model, const LiftHoist& hoist, const LiftRun& lift,
                std::vector<LiftMeasure>& measures) {
  const ReevingModel& reeving = *model.reeving;
  const dynamics::Tackle tackle = reeving.tackle();
  LiftMeasure pull{.subject = hoist.name,
                   .kind = "line pull",
                   .unit = "N",
                   .meaning = "of the winch on a lead line, by " + describe_reeving(reeving)};
  LiftMeasure load{.subject = hoist.name,
                   .kind = "line load",
                   .unit = "N",
                   .meaning =
                       "largest tension of the tackle's single rope, in the lead line or the "
                       "fall at the dead end"};
  const TackleShares up = calc_shares(tackle, TackleMotion::hoisting);
  const TackleShares down = calc_shares(tackle, TackleMotion::lowering);
  const auto fill = [&](const dynamics::History& history, Eigen::VectorXd LiftMeasure::*series) {
    const dynamics::RopeHistory& rope = history.ropes[hoist.rope];
    const std::vector<TackleMotion> motion = find_tackle_motion(rope.unstretched_length);
    (pull.*series).resize(history.sample_count());
    (load.*series).resize(history.sample_count());
    for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
      const TackleShares& shares = motion[i] == TackleMotion::hoisting ? up : down;
      const double of_one_rope = rope.tension[i] / reeving.lead_lines;
      (pull.*series)[i] = shares.lead_line * of_one_rope;
      (load.*series)[i] = shares.largest * of_one_rope;
    }
  };
  fill(lift.static_history, &LiftMeasure::at_rest);
  fill(lift.dynamic_history(), &LiftMeasure::in_motion);
  measures.push_back(std::move(pull));
  measures.push_back(std::move(load));
}

}  // namespace

std::vector<TackleMotion> find_tackle_motion(const Eigen::VectorXd& unstretched_length) {
  constexpr double least = 1e-9;  // m: rounding of a winch that stands
  std::vector<TackleMotion> motion(static_cast<std::size_t>(unstretched_length.size()),
                                   TackleMotion::hoisting);
  for (std::size_t i = 1; i < motion.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double paid_out = unstretched_length[k] - unstretched_length[k - 1];
    motion[i] = std::abs(paid_out) < least ? motion[i - 1]
                : paid_out > 0             ? TackleMotion::lowering
                                           : TackleMotion::hoisting;
  }
  return motion;
}

void add_tackle_measures(const LiftCase& lift_case, const LiftRun& lift,
                         std::vector<LiftMeasure>& measures) {
  for (const LiftHoist& hoist : lift.model.hoists) {
    const given::Crane& crane = lift_case.cranes[hoist.crane];
    const HoistModel& model =
        *crane.model->find_hoist(hoist.name.substr(crane.name.value.size() + 1));
    if (model.reeving) add_tackle(model, hoist, lift, measures);
  }
}

std::string describe_reeving(const ReevingModel& reeving) {
  const auto count = [](int number, const char* noun) {
    return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
  };
  return fmt::format(
      "{}{}, {}, {:.3g} % a sheave: {:.1f} % efficient", count(reeving.falls, "fall"),
      reeving.lead_lines == 1 ? "" : fmt::format(" on {} lead lines", reeving.lead_lines),
      count(reeving.lead_sheaves, "lead sheave"), 100 * reeving.sheave_efficiency,
      100 * calc_efficiency(reeving.tackle()));
}

}  // namespace blocklift::pipeline
