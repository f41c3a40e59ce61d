#include "pipeline/results/sling_summary.h"

#include <nlohmann/json.hpp>

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

}  // namespace blocklift::pipeline
