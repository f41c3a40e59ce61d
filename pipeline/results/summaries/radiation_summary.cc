#include "pipeline/results/summaries/radiation_summary.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;
using dynamics::LargestInTime;
using dynamics::PairMisplacement;

constexpr double one_degree = std::numbers::pi / 180.0;

std::string names_of(const RadiationRecord& record, const PairMisplacement& pair) {
  const auto& bodies = record.arrangement.bodies;
  return fmt::format("{} and {}", bodies[pair.first].name, bodies[pair.second].name);
}

double share_beyond(const PairMisplacement& pair) {
  return pair.samples > 0
             ? static_cast<double>(pair.samples_beyond) / static_cast<double>(pair.samples)
             : 0.0;
}

Json largest_json(const LargestInTime& largest, const char* unit) {
  return {{unit, largest.value},
          {"time_s", std::isnan(largest.time) ? Json(nullptr) : Json(largest.time)}};
}

Json pair_json(const RadiationRecord& record, const PairMisplacement& pair) {
  const auto& bodies = record.arrangement.bodies;
  Json json{{"vessels", {bodies[pair.first].name, bodies[pair.second].name}},
            {"both_in_water", pair.samples > 0}};
  if (pair.samples == 0) return json;
  json["distance"] = largest_json(pair.distance, "size_m");
  json["turn"] = largest_json(pair.turn, "angle_rad");
  json["at_hull_ends"] = largest_json(pair.at_ends, "size_m");
  json["limit_m"] = pair.limit;
  json["share_of_time_beyond"] = share_beyond(pair);
  return json;
}

std::string pair_words(const RadiationRecord& record, const PairMisplacement& pair) {
  if (pair.samples == 0) {
    return fmt::format("{} were never both in the water", names_of(record, pair));
  }
  return fmt::format("{} {:.2g} m (at {:.0f} s) and {:.2g} degrees (at {:.0f} s)",
                     names_of(record, pair), pair.distance.value, pair.distance.time,
                     pair.turn.value / one_degree, pair.turn.time);
}

}  // namespace

Json radiation_json(const RadiationRecord& record) {
  if (record.arrangement.bodies.empty()) return nullptr;
  Json vessels = Json::array(), pairs = Json::array();
  for (const auto& body : record.arrangement.bodies) vessels.push_back(body.name);
  for (const PairMisplacement& pair : record.misplacement.pairs)
    pairs.push_back(pair_json(record, pair));
  Json json{{"method", record.direct ? "direct" : "database"}, {"vessels", vessels}};
  if (!record.direct) {
    json["memory_states"] = record.memory_states;
    json["memory_error"] = record.memory_error;
  }
  json["turn_of_all"] = largest_json(record.misplacement.group_turn, "angle_rad");
  json["misplacement"] = pairs;
  return json;
}

void add_radiation(const RadiationRecord& record, Json& summary) {
  if (record.arrangement.bodies.empty()) return;
  summary["radiation"] = radiation_json(record);
  for (const std::string& warning : misplacement_warnings(record)) {
    summary["warnings"].push_back(warning);
  }
}

std::string misplacement_sentence(const RadiationRecord& record) {
  const auto& pairs = record.misplacement.pairs;
  if (pairs.empty()) return {};
  std::string words;
  for (const PairMisplacement& pair : pairs) {
    words += (words.empty() ? "" : "; ") + pair_words(record, pair);
  }
  return fmt::format(
      "At most, in the water, vessels were this far from the places against each other that their "
      "water was computed for: {}. All of them together turned by up to {:.2g} degrees, which "
      "their "
      "excitation follows.",
      words, record.misplacement.group_turn.value / one_degree);
}

std::vector<std::string> misplacement_warnings(const RadiationRecord& record) {
  std::vector<std::string> warnings;
  for (const PairMisplacement& pair : record.misplacement.pairs) {
    if (!pair.is_beyond()) continue;
    const bool of_wave = pair.limit == record.arrangement.wave_length / 40.0;
    const double share = 100.0 * share_beyond(pair);
    warnings.push_back(fmt::format(
        "{} came up to {:.2g} m and {:.2g} degrees, {:.2g} m at the ends of a hull (at {:.0f} s), "
        "from the places against each other that their water was computed for, and were more than "
        "{:.2g} m off ({}) during {} % of their time in the water: what one does to the other's "
        "waves and added mass is not right there. Compute it for where they are: positions of "
        "vessels, or afloat of the load.",
        names_of(record, pair), pair.distance.value, pair.turn.value / one_degree,
        pair.at_ends.value, pair.at_ends.time, pair.limit,
        of_wave ? "a fortieth of the waves' length" : "a fifth of the narrower hull's breadth",
        share < 1.0 ? "less than 1" : fmt::format("{:.0f}", share)));
  }
  return warnings;
}

std::string misplacement_notice(const RadiationRecord& record) {
  std::string text;
  for (const std::string& warning : misplacement_warnings(record))
    text += "warning: " + warning + "\n";
  return text;
}

}  // namespace blocklift::pipeline
