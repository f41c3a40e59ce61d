#include "pipeline/study/limits/figure_limit.h"

#include <map>

#include <fmt/format.h>

#include "pipeline/comparison/summary_figures.h"
#include "pipeline/declaration/diagnostics.h"

namespace blocklift::pipeline {

double limit_of(const Located<Measure>& limit, const std::string& figure, const std::string& unit) {
  static const std::map<std::string, Exponents> dimensions{
      {"N", {1, 1, -2, 0}},   {"Pa", {-1, 1, -2, 0}}, {"m", {1, 0, 0, 0}},
      {"s", {0, 0, 1, 0}},    {"kg", {0, 1, 0, 0}},   {"Nm", {2, 1, -2, 0}},
      {"N m", {2, 1, -2, 0}}, {"rad", {0, 0, 0, 1}},  {"Hz", {0, 0, -1, 0}},
      {"J", {2, 1, -2, 0}},   {"m/s", {1, 0, -1, 0}}, {"rad/s", {0, 0, -1, 1}}};
  const auto known = dimensions.find(unit);
  if (limit.value.exponents == (known == dimensions.end() ? Exponents{} : known->second))
    return limit.value.value;  // the summary has units of the SI
  Diagnostics diagnostics;
  diagnostics.error(limit.mark, fmt::format("{} is {}: its limit has another dimension", figure,
                                            unit.empty() ? "a plain number" : "in " + unit));
  throw InputError(diagnostics);
}

std::string unit_of(const std::vector<Member>& members, const std::string& figure) {
  for (const Member& member : members)
    if (member.failure.empty()) return member.unit(figure);
  return std::string(unit_of_path(figure));
}

void check_figure_limits(const StudyFile& study, const std::vector<Member>& members) {
  const auto check = [&](const Located<Measure>& limit, const std::string& figure) {
    if (!members.empty() || !unit_of_path(figure).empty())
      limit_of(limit, figure, unit_of(members, figure));
  };
  for (const FigureBound& bound : study.subject_to)
    check(bound.at_most ? *bound.at_most : *bound.at_least, bound.figure.value);
  if (study.limits)
    for (const QuantityLimit& quantity : study.limits->quantities)
      check(quantity.at, quantity.figure.value);
}

}  // namespace blocklift::pipeline
