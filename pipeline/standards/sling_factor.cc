#include "pipeline/standards/sling_factor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace blocklift::pipeline {

namespace {

double factor_named(const std::vector<NamedFactor>& factors, const std::string& name) {
  const NamedFactor* found = find_by_name(factors, name);
  if (!found) throw std::out_of_range("the rules of slings have no \"" + name + "\"");
  return found->value;
}

}  // namespace

double bending_factor(double half, double diameter_ratio) {
  return 1 / (1 - half / std::sqrt(diameter_ratio));
}

double bend_efficiency(double bend_diameter, double diameter) {
  return 1 / bending_factor(0.5, bend_diameter / diameter);
}

SlingFactor sling_factor(const SlingRules& rules, const SlingChoice& choice) {
  SlingFactor f;
  const double share = rules.environment ? choice.environment_share : 0;
  f.load = rules.load.value;
  if (share > 0)
    f.load = std::max(f.load - rules.environment->value * share, 1 + (f.load - 1) * share);
  f.consequence = rules.consequence.value;
  f.floor = rules.floor.value;
  f.material = factor_named(rules.material, choice.material);
  f.wear = factor_named(rules.wear, choice.wear);
  f.termination = factor_named(rules.termination, choice.termination);
  if (choice.diameter_ratio)
    f.bending = bending_factor(rules.bending.value, *choice.diameter_ratio);
  f.reduction = std::max(f.bending, f.termination);
  f.by_parts = f.load * f.consequence * f.reduction * f.wear * f.material;
  f.by_floor = f.floor * f.reduction * f.wear;
  f.factor = std::max(f.by_parts, f.by_floor);
  return f;
}

}  // namespace blocklift::pipeline
