#include "pipeline/report/check_groups.h"

#include <algorithm>
#include <limits>
#include <map>

#include <nlohmann/json.hpp>

namespace blocklift::pipeline {
namespace {

using Check = nlohmann::ordered_json;

/// "rope" of "rope R1: tension ..."; "0027/ND: sling" of "0027/ND: sling R1 by ...", which is a
/// check by the standard 0027/ND.
std::string kind_of(const std::string& name, const std::string& standard) {
  const std::string mark = standard + ": ";
  const std::size_t begin = !standard.empty() && name.starts_with(mark) ? mark.size() : 0;
  return name.substr(0, name.find_first_of(" :", begin));
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

std::vector<CheckGroup> group_checks(const Check& checks, const std::string& standard) {
  std::vector<CheckGroup> groups;
  std::map<std::string, std::size_t> place;
  for (const Check& check : checks) {
    const std::string kind = kind_of(check.value("name", ""), standard);
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
