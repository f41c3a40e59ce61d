#include "pipeline/study/pages/study_files.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/preparation.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/study/design/study_design.h"
#include "pipeline/study/pages/study_json.h"
#include "pipeline/study/pages/study_page.h"

namespace blocklift::pipeline {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string inside;
  for (const char c : text) inside += c == '"' ? "\"\"" : std::string(1, c);
  return '"' + inside + '"';
}

/// A failure of several lines as one, for a row is a line.
std::string on_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (c == ' ' && line.ends_with("; ")) continue;
    line += c == '\n' ? std::string("; ") : std::string(1, c);
  }
  while (line.ends_with("; ")) line.resize(line.size() - 2);
  return line;
}

std::string csv_text(const StudyResults& results) {
  std::string text = "member";
  for (const StudyVariable& variable : results.study.variables) {
    const std::string unit = unit_text(variable);
    text += "," + quoted(unit.empty() ? variable.name.value
                                      : fmt::format("{} ({})", variable.name.value, unit));
  }
  const std::vector<std::string> columns = results.columns();
  for (const std::string& path : columns) text += "," + quoted(path);
  text += ",failure\n";
  for (const Member& member : results.members) {
    text += fmt::format("{}", member.number);
    for (const double value : results.design.row(member.number)) text += fmt::format(",{}", value);
    for (const std::string& path : columns) {
      const auto found = std::find_if(member.figures.begin(), member.figures.end(),
                                      [&](const auto& one) { return one.first == path; });
      text += found == member.figures.end() ? std::string(",") : fmt::format(",{}", found->second);
    }
    text += "," + quoted(on_one_line(member.failure)) + "\n";
  }
  return text;
}

void write_arrays(const StudyResults& results, const std::filesystem::path& path) {
  ResultsWriter file(path);
  std::vector<std::string> variables, units;
  const std::vector<std::string> paths = results.columns();
  for (const StudyVariable& variable : results.study.variables) {
    variables.push_back(variable.name.value);
    units.push_back(unit_text(variable));
  }
  RowMajorMatrix figures(static_cast<Eigen::Index>(results.members.size()),
                         static_cast<Eigen::Index>(paths.size()));
  figures.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t f = 0; f < paths.size(); ++f)
    for (std::size_t m = 0; m < results.members.size(); ++m)
      for (const auto& [name, value] : results.members[m].figures)
        if (name == paths[f])
          figures(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(f)) = value;
  file.write_text("/study/yaml", results.study.yaml, "the study's file");
  file.write_texts("/variables/names", variables, "what varies, a column each");
  file.write_texts("/variables/units", units, "of the columns, SI");
  file.write_matrix("/variables/values", results.design, {"1", "a member a row; SI units"});
  file.write_texts("/figures/names", paths, "places in summary.json, a column each");
  if (figures.size() > 0)
    file.write_matrix(
        "/figures/values", figures,
        {"1",
         "a member a row, units as the names say; nan: the member failed, or has no such figure"});
  file.finish();
}

}  // namespace

void write_study(const StudyResults& results, const std::filesystem::path& folder) {
  Preparation preparation(folder);
  const std::filesystem::path& aside = preparation.folder();
  write_file(aside / "study.csv", csv_text(results));
  write_arrays(results, aside / "study.h5");
  write_file(aside / "study.html", study_page(results));
  write_file(aside / "study.json", study_json(results).dump(2));
  preparation.move_into_place();
}

}  // namespace blocklift::pipeline
