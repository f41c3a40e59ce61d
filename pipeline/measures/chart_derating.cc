#include "pipeline/measures/chart_derating.h"

#include <fmt/format.h>

namespace blocklift::pipeline {

namespace {

double significant_height(const LiftCase& lift_case) {
  const given::Sea& sea = *lift_case.sea;
  if (!sea.waves) return 0;
  // As stated: the components of a sea that is cut off at high frequencies have a little less.
  if (sea.waves->spectrum && sea.waves->spectrum->significant_height)
    return sea.waves->spectrum->significant_height->value;
  return make_sea(lift_case, lift_case.gravity).waves.significant_height();
}

}  // namespace

ChartFactor find_chart_factor(const CraneModel& crane, const LiftCase& lift_case) {
  ChartFactor factor;
  if (!crane.derating) return factor;
  std::string reasons;
  const auto apply = [&](double value, const std::string& reason) {
    factor.value *= value;
    reasons += (reasons.empty() ? "" : ", ") + reason;
  };
  const ChartDerating& derating = *crane.derating;
  if (derating.wind) {
    const double speed = lift_case.wind ? lift_case.wind->speed : 0;
    apply(factor_in(derating.wind->value, speed), fmt::format("wind of {:.3g} m/s", speed));
  }
  if (derating.sea && lift_case.sea) {
    const double height = significant_height(lift_case);
    apply(factor_in(derating.sea->value, height),
          fmt::format("waves of {:.3g} m significant height", height));
  }
  if (!reasons.empty())
    factor.text = fmt::format("x {:.4g} for {} ({})", factor.value, reasons, derating.source);
  return factor;
}

}  // namespace blocklift::pipeline
