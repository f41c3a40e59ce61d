#include "pipeline/comparison/lasting_modes.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

/// "C1.upper_1": what hangs from a crane has the crane's name before its own.
bool is_of_a_crane(const std::string& body) { return body.find('.') != std::string::npos; }

bool is_mode(const Json& row) {
  return row.is_object() && row.contains("period_s") && row.contains("name") &&
         row.at("name").is_string();
}

struct Lead {
  std::string body;
  double share_without_cranes = 0;
};

/// The body with most of the energy; none if it is one of a crane.
std::optional<Lead> lead_of(const Json& row) {
  // Alike bodies share alike; a tenth is for what a plan that is compared changes in that.
  constexpr double equally = 0.9;
  const auto shares = row.find("energy_share_by_body");
  if (shares == row.end() || !shares->is_object()) return std::nullopt;
  double most = 0;
  Lead lead;
  for (const auto& [body, share] : shares->items()) {
    if (!share.is_number()) continue;
    most = std::max(most, share.get<double>());
    if (!is_of_a_crane(body)) lead.share_without_cranes += share.get<double>();
  }
  bool crane_has_most = false;
  for (const auto& [body, share] : shares->items()) {
    if (!share.is_number() || share.get<double>() < equally * most) continue;
    if (is_of_a_crane(body))
      crane_has_most |= share.get<double>() == most;
    else if (lead.body.empty() || body < lead.body)
      lead.body = body;
  }
  if (lead.body.empty() || crane_has_most) return std::nullopt;
  return lead;
}

/// "roll about x" of "load and C1.left: roll about x against C1.right, no. 2".
std::string motion_of(const std::string& name) {
  static const std::regex aslant("(along|about) \\d+ deg from x towards -?y");
  const std::size_t colon = name.find(": ");
  std::string motion = colon == std::string::npos ? name : name.substr(colon + 2);
  motion = motion.substr(0, motion.find(", no. "));
  motion = motion.substr(0, motion.find(" against "));
  return std::regex_replace(motion, aslant, "aslant");
}

double period_of(const Json& row) {
  const Json& period = row.at("period_s");
  return period.is_number() ? period.get<double>() : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<LastingMode> lasting_modes(const Json& list) {
  if (!list.is_array() || !std::ranges::all_of(list, is_mode)) return {};
  std::vector<LastingMode> modes;
  for (const Json& row : list) {
    if (!row.contains("energy_share_by_body")) {
      // Nothing tells who leads: the mode keeps its name.
      modes.push_back({row.at("name").get<std::string>(), &row, true});
      continue;
    }
    const std::optional<Lead> lead = lead_of(row);
    if (!lead) continue;
    modes.push_back({lead->body + ": " + motion_of(row.at("name").get<std::string>()), &row,
                     lead->share_without_cranes > 0.5});
  }
  std::ranges::stable_sort(modes, [](const LastingMode& a, const LastingMode& b) {
    return period_of(*a.row) > period_of(*b.row);
  });
  std::map<std::string, int> known;
  for (LastingMode& mode : modes)
    if (const int number = ++known[mode.name]; number > 1)
      mode.name += fmt::format(", no. {}", number);
  return modes;
}

}  // namespace blocklift::pipeline
