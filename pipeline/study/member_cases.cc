#include "pipeline/study/member_cases.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/key_change.h"
#include "pipeline/study/study_design.h"

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
  return fmt::format("{} = {}", variable.name.value, value_text(variable, value, 6));
}

/// "weight = 870 t, R1 = 9.98 m".
std::string describe(const StudyFile& study, const Eigen::VectorXd& values) {
  std::string text;
  for (std::size_t v = 0; v < study.variables.size(); ++v)
    text += (v > 0 ? ", " : "") + describe(study.variables[v], values[v]);
  return text;
}

/// Where the study says what values a variable takes.
const Mark& place_of_values(const StudyVariable& variable) {
  if (variable.law) return variable.law->place;
  if (!variable.values.empty()) return variable.values.front().mark;
  return variable.between.front().mark;
}

/// @throws InputError with what is wrong with the study's case as it stands, before any change.
void check_unchanged_case(const StudyFile& study) {
  Diagnostics diagnostics;
  std::error_code ignored;
  if (!std::filesystem::exists(study.case_path(), ignored)) {
    diagnostics.error(study.case_name.mark,
                      fmt::format("there is no case \"{}\"", study.case_name.value),
                      {"it is looked for from the study's folder, then from the working folder"});
    throw InputError(diagnostics);
  }
  ModelLibrary library = ModelLibrary::of_installation();
  read_lift_case(study.case_path(), library, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
}

}  // namespace

LiftCase MemberCases::of(const Eigen::VectorXd& values, const std::vector<int>* only) {
  Diagnostics diagnostics;
  std::vector<KeyChange> changes = changes_of(study_, values, only, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  library_.set_changes(std::move(changes));
  std::optional<LiftCase> lift_case = read_lift_case(study_.case_path(), library_, diagnostics);
  if (!diagnostics.has_errors()) {
    lift_case->laws = study_.laws;
    return std::move(*lift_case);
  }
  check_unchanged_case(study_);
  // A key that is not there is named by the study's own line already: no value of it is to blame.
  const auto is_own = [&](const Diagnostic& one) {
    return one.mark.file && study_.place.file && *one.mark.file == *study_.place.file;
  };
  if (std::any_of(diagnostics.errors().begin(), diagnostics.errors().end(), is_own))
    throw InputError(diagnostics);
  // Complaints name the study's own lines beside those of the case and its models as they were
  // changed.
  const std::vector<std::size_t> impossible = find_impossible(values);
  for (const std::size_t v : impossible)
    diagnostics.error(place_of_values(study_.variables[v]),
                      fmt::format("a member of the study is impossible: {}",
                                  describe(study_.variables[v], values[v])));
  if (impossible.empty())
    diagnostics.error(study_.place, fmt::format("a member of the study is impossible: {}",
                                                describe(study_, values)));
  throw InputError(diagnostics);
}

std::vector<std::size_t> MemberCases::find_impossible(const Eigen::VectorXd& values) {
  std::vector<std::size_t> impossible;
  for (std::size_t v = 0; v < study_.variables.size(); ++v) {
    Diagnostics diagnostics;
    const std::vector<int> alone{static_cast<int>(v)};
    library_.set_changes(changes_of(study_, values, &alone, diagnostics));
    read_lift_case(study_.case_path(), library_, diagnostics);
    if (diagnostics.has_errors()) impossible.push_back(v);
  }
  return impossible;
}

}  // namespace blocklift::pipeline
