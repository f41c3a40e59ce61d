#include "pipeline/checks/checks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {

namespace {

/// What the utilisation of a check is where nothing finite describes it.
constexpr double beyond_any_limit = 999;

double ratio(double numerator, double denominator) {
  if (!std::isfinite(numerator) || !std::isfinite(denominator)) return beyond_any_limit;
  if (numerator <= 0) return 0;
  if (denominator <= 0) return beyond_any_limit;
  return std::min(numerator / denominator, beyond_any_limit);
}

Check make_check(std::string name, double demand, double limit, std::string unit) {
  Check check;
  check.name = std::move(name);
  check.demand = demand;
  check.limit = limit;
  check.unit = std::move(unit);
  return check;
}

std::string text_of_utilisation(const Check& check) {
  if (check.utilisation >= beyond_any_limit)
    return std::isfinite(check.demand) || check.note.empty()
               ? fmt::format("{}: beyond any limit", check.name)
               : fmt::format("{}: {}", check.name, check.note);
  return fmt::format("{}: utilisation {:.2f}", check.name, check.utilisation);
}

}  // namespace

std::pair<double, double> Check::utilisation_band() const {
  return {utilisation * std::max(0.0, 1 - *band),
          std::min(utilisation * (1 + *band), beyond_any_limit)};
}

Check check_at_most(std::string name, double demand, double limit, std::string unit) {
  Check check = make_check(std::move(name), demand, limit, std::move(unit));
  check.utilisation = ratio(demand, limit);
  check.pass = demand <= limit;
  return check;
}

Check check_at_least(std::string name, double demand, double limit, std::string unit) {
  Check check = make_check(std::move(name), demand, limit, std::move(unit));
  check.pass = demand >= limit && demand > 0;
  check.utilisation = demand > 0 ? ratio(limit, demand) : beyond_any_limit;
  return check;
}

bool all_pass(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.pass; });
}

const Check* governing_check(const std::vector<Check>& checks) {
  const auto largest = std::max_element(
      checks.begin(), checks.end(),
      [](const Check& a, const Check& b) { return a.utilisation < b.utilisation; });
  return largest == checks.end() ? nullptr : &*largest;
}

std::vector<std::string> verdict_reasons(const std::vector<Check>& checks) {
  std::vector<std::string> reasons;
  for (const Check& check : checks) {
    if (!check.pass) reasons.push_back(text_of_utilisation(check));
  }
  if (const Check* governing = governing_check(checks); reasons.empty() && governing) {
    reasons.push_back("governed by " + text_of_utilisation(*governing));
  }
  return reasons;
}

}  // namespace blocklift::pipeline
