#include "pipeline/study/members/member_cases.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/key_change.h"
#include "pipeline/study/design/block_variables.h"
#include "pipeline/study/design/study_design.h"

namespace blocklift::pipeline {
namespace {

std::vector<KeyChange> changes_of(const StudyFile& study, const Eigen::VectorXd& values,
                                  const std::vector<int>* only, Diagnostics& diagnostics) {
  std::vector<KeyChange> changes;
  for (std::size_t v = 0; v < study.variables.size(); ++v) {
    if (only && std::find(only->begin(), only->end(), static_cast<int>(v)) == only->end()) continue;
    const StudyVariable& variable = study.variables[v];
    const std::string value = value_text(variable, values[v]);
    for (const Located<std::string>& key : variable.keys)
      if (auto change = parse_key_change(key.value + "=" + value, key.mark, diagnostics))
        changes.push_back(std::move(*change));
  }
  return changes;
}

/// "weight = 870 t".
std::string describe(const StudyVariable& variable, double value) {
  return fmt::format("{} = {}", variable.name.value, shown_value(variable, value, 6));
}

/// "weight = 870 t, R1 = 9.98 m".
std::string describe(const StudyFile& study, const Eigen::VectorXd& values) {
  std::string text;
  for (std::size_t v = 0; v < study.variables.size(); ++v)
    text += (v > 0 ? ", " : "") + describe(study.variables[v], values[v]);
  return text;
}

/// Where the study says that a variable takes a value.
const Mark& place_of_value(const StudyVariable& variable, double value) {
  if (variable.law) return variable.law->place;
  const std::vector<Located<Measure>>& told =
      variable.values.empty() ? variable.between : variable.values;
  const auto found = std::ranges::find_if(
      told, [&](const Located<Measure>& one) { return one.value.value == value; });
  return (found == told.end() ? told.front() : *found).mark;
}

/// What is printed of complaints, a line each, without their number.
std::vector<std::string> lines_of(const Diagnostics& complaints) {
  std::vector<std::string> lines;
  const std::string text = complaints.to_text();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  if (!lines.empty()) lines.pop_back();
  return lines;
}

bool have_common_place(const Diagnostics& some, const Diagnostics& others) {
  const auto place_of = [](const Mark& mark) {
    return std::tuple(mark.file ? *mark.file : std::string(), mark.line, mark.column);
  };
  return std::ranges::any_of(some.errors(), [&](const Diagnostic& one) {
    return std::ranges::any_of(others.errors(), [&](const Diagnostic& other) {
      return place_of(one.mark) == place_of(other.mark);
    });
  });
}

constexpr const char* impossible_member = "a member of the study is impossible: ";

}  // namespace

LiftCase MemberCases::of(const Eigen::VectorXd& values, const std::vector<int>* only) {
  Diagnostics diagnostics;
  std::optional<LiftCase> lift_case = read(values, only, diagnostics);
  if (!diagnostics.has_errors()) {
    lift_case->laws = study_.laws;
    return std::move(*lift_case);
  }
  // A key that is not there is named by the study's own line already: no value of it is to blame.
  const auto is_own = [&](const Diagnostic& one) {
    return one.mark.file && study_.place.file && *one.mark.file == *study_.place.file;
  };
  check_unchanged_case();
  if (std::any_of(diagnostics.errors().begin(), diagnostics.errors().end(), is_own))
    throw InputError(diagnostics);
  // One cause is one complaint: what a value does to the case and its models stands below it.
  Diagnostics blame;
  blame_values(values, diagnostics, blame);
  if (!blame.has_errors())
    blame.error(study_.place, impossible_member + describe(study_, values), lines_of(diagnostics));
  throw InputError(blame);
}

std::optional<LiftCase> MemberCases::read(const Eigen::VectorXd& values,
                                          const std::vector<int>* only, Diagnostics& diagnostics) {
  library_.set_changes(changes_of(study_, values, only, diagnostics));
  if (diagnostics.has_errors()) return std::nullopt;
  std::optional<LiftCase> lift_case = read_lift_case(study_.case_path(), library_, diagnostics);
  if (!diagnostics.has_errors() && block_masses_)
    block_masses_->check(
        *lift_case,
        block_key(study_, find_block_variables(study_, lift_case->load.model_name.value), values,
                  only),
        diagnostics);
  return lift_case;
}

void MemberCases::check_unchanged_case() {
  Diagnostics diagnostics;
  std::error_code ignored;
  if (!std::filesystem::exists(study_.case_path(), ignored)) {
    diagnostics.error(study_.case_name.mark,
                      fmt::format("there is no case \"{}\"", study_.case_name.value),
                      {"it is looked for from the study's folder, then from the working folder"});
    throw InputError(diagnostics);
  }
  const std::vector<int> none;
  read(Eigen::VectorXd(), &none, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
}

void MemberCases::blame_values(const Eigen::VectorXd& values, const Diagnostics& of_all,
                               Diagnostics& blame) {
  for (std::size_t v = 0; v < study_.variables.size(); ++v) {
    Diagnostics diagnostics;
    const std::vector<int> alone{static_cast<int>(v)};
    read(values, &alone, diagnostics);
    if (!have_common_place(diagnostics, of_all)) continue;
    const StudyVariable& variable = study_.variables[v];
    blame.error(place_of_value(variable, values[v]),
                impossible_member + describe(variable, values[v]), lines_of(diagnostics));
  }
}

}  // namespace blocklift::pipeline
