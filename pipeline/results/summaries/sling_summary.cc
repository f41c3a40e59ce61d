#include "pipeline/results/summaries/sling_summary.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "dynamics/simulation/history.h"
#include "pipeline/checks/lift_checks.h"
#include "pipeline/formats/json_values.h"

namespace blocklift::pipeline {

namespace {

using Json = nlohmann::ordered_json;

Json by_sling(const SlingLengths& lengths, const Eigen::VectorXd& values) {
  Json json = Json::object();
  for (std::size_t i = 0; i < lengths.slings.size(); ++i)
    json[lengths.slings[i]] = json_number(values[i]);
  return json;
}

Json state_json(const SlingLengths& lengths, const SlingState& state) {
  return {{"tensions_N", by_sling(lengths, state.tensions)},
          {"tilt_rad", state.tilt},
          {"trim_rad", state.trim},
          {"list_rad", state.list}};
}

/// What a sling may come to where lengths are off, N.
struct StrainedSling {
  std::string name;
  double at_rest = 0, in_motion = 0, limit = 0;
};

/// The largest of a sling at rest that errors of length are known to make, N.
double worst_tension(const SlingLengths& lengths, std::size_t sling) {
  if (lengths.worst_tensions.size() > 0) return lengths.worst_tensions[sling];
  double worst = lengths.meant.tensions[sling];
  for (const SlingLengthError& error : lengths.errors)
    worst = std::max({worst, error.longer.tensions[sling], error.shorter.tensions[sling]});
  return worst;
}

/// Slings that hold as meant and not with lengths that are off.
std::vector<StrainedSling> strained_slings(const LiftCase& lift_case, const LiftRun& lift,
                                           const SlingLengths& lengths) {
  const auto at_rest = dynamics::find_largest_tensions(lift.static_history);
  const auto in_motion = dynamics::find_largest_tensions(lift.dynamic_history());
  std::vector<StrainedSling> strained;
  for (std::size_t i = 0; i < lengths.slings.size(); ++i) {
    const auto rope =
        std::find_if(lift.model.ropes.begin(), lift.model.ropes.end(),
                     [&](const LiftRope& one) { return one.name == lengths.slings[i]; });
    if (rope == lift.model.ropes.end()) continue;
    const double still = at_rest[rope->rope].tension, moving = in_motion[rope->rope].tension;
    const double limit = bend_efficiency(*lift_case.find_rope(rope->name), lift) *
                         rope->breaking_load / lift_case.checks.rope_safety_factor;
    if (!(still > 0) || std::max(still, moving) > limit) continue;
    const double worst = worst_tension(lengths, i);
    const double worst_in_motion = worst * std::max(1.0, moving / still);
    if (worst_in_motion > limit) strained.push_back({rope->name, worst, worst_in_motion, limit});
  }
  return strained;
}

}  // namespace

Json sling_lengths_json(const SlingLengths& lengths) {
  Json json{{"tolerance", lengths.tolerance},
            {"time_s", lengths.time},
            {"lengths_m", by_sling(lengths, lengths.lengths)}};
  if (!lengths.trouble.empty()) {
    json["trouble"] = lengths.trouble;
    return json;
  }
  json["meant"] = state_json(lengths, lengths.meant);
  json["errors"] = Json::array();
  for (std::size_t i = 0; i < lengths.errors.size(); ++i)
    json["errors"].push_back({{"sling", lengths.slings[i]},
                              {"longer", state_json(lengths, lengths.errors[i].longer)},
                              {"shorter", state_json(lengths, lengths.errors[i].shorter)}});
  if (lengths.worst_tensions.size() > 0)
    json["worst"] = {{"tensions_N", by_sling(lengths, lengths.worst_tensions)},
                     {"tilt_rad", lengths.worst_tilt}};
  if (lengths.level_lengths.size() > 0) {
    json["level"] = state_json(lengths, lengths.level);
    json["level"]["lengths_m"] = by_sling(lengths, lengths.level_lengths);
  }
  return json;
}

std::vector<std::string> list_doubts(const LiftCase& lift_case, const LiftRun& lift,
                                     const SlingLengths& lengths) {
  if (!lengths.trouble.empty()) return {};
  const std::vector<StrainedSling> strained = strained_slings(lift_case, lift, lengths);
  if (strained.empty()) return {};
  std::string loads;
  for (const StrainedSling& sling : strained)
    loads += fmt::format("{}{} {:.0f} kN at rest and {:.0f} in motion, of {:.0f} kN",
                         loads.empty() ? "" : "; ", sling.name, sling.at_rest / 1e3,
                         sling.in_motion / 1e3, sling.limit / 1e3);
  return {fmt::format(
      "Slings whose lengths are off by {:g} % may bear more than breaking load / {:g}, in the "
      "worst "
      "{}: {}. The verdict takes the lengths as meant: measure the slings, or adjust them.",
      100 * lengths.tolerance, lift_case.checks.rope_safety_factor,
      lengths.worst_tensions.size() > 0 ? "set of lengths" : "case of one sling that is off",
      loads)};
}

}  // namespace blocklift::pipeline
