#include "pipeline/report/check_groups.h"

#include <algorithm>
#include <limits>
#include <map>

#include <nlohmann/json.hpp>

namespace blocklift::pipeline {
namespace {

using Check = nlohmann::ordered_json;

/// "rope" of "rope R1: tension ..."; "0027/ND: sling" of "0027/ND: sling R1 by ...".
std::string kind_of(const std::string& name) {
  const auto first_word = [](const std::string& text) {
    return text.substr(0, text.find_first_of(" :"));
  };
  const std::size_t colon = name.find(": ");
  if (colon == std::string::npos) return first_word(name);
  // A standard's name is told from a rope's by what follows: the checks of a standard say "by".
  const std::string behind = name.substr(colon + 2);
  return behind.find(" by ") == std::string::npos ? first_word(name)
                                                  : name.substr(0, colon + 2) + first_word(behind);
}

bool passes(const Check& check) { return check.value("pass", false); }

double utilisation_of(const Check& check) {
  const auto found = check.find("utilisation");
  return found != check.end() && found->is_number() ? found->get<double>()
                                                    : -std::numeric_limits<double>::infinity();
}

bool leads(const Check* a, const Check* b) {
  if (passes(*a) != passes(*b)) return !passes(*a);
  return utilisation_of(*a) > utilisation_of(*b);
}

}  // namespace

std::vector<CheckGroup> group_checks(const Check& checks) {
  std::vector<CheckGroup> groups;
  std::map<std::string, std::size_t> place;
  for (const Check& check : checks) {
    const std::string kind = kind_of(check.value("name", ""));
    const auto found = place.emplace(kind, groups.size()).first;
    if (found->second == groups.size()) groups.push_back({kind, {}});
    groups[found->second].checks.push_back(&check);
  }
  for (CheckGroup& group : groups)
    std::stable_sort(group.checks.begin(), group.checks.end(), leads);
  std::stable_sort(groups.begin(), groups.end(), [](const CheckGroup& a, const CheckGroup& b) {
    return leads(a.checks.front(), b.checks.front());
  });
  return groups;
}

const Check* governing_check(const Check& checks) {
  if (!checks.is_array() || checks.empty()) return nullptr;
  const Check* governing = &checks.front();
  for (const Check& check : checks)
    if (leads(&check, governing)) governing = &check;
  return governing;
}

}  // namespace blocklift::pipeline
