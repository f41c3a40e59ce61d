#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "pipeline/assessment/part_assessment.h"
#include "pipeline/verification/structure/structure_cases.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

std::vector<VerificationRow> compute(const PartFile& file) {
  const PartAssessment assessment = assess_part(file);
  std::vector<VerificationRow> rows;
  for (const PartReference& figure : file.references->figures) {
    const double reference = figure.value.value.value;
    rows.push_back(compare(fmt::format("{} at {}", name_of(figure.quantity), figure.probe.value),
                           figure.value.value.dimension == Dimension::length ? "m" : "Pa",
                           reference, figure_of(assessment, figure),
                           figure.tolerance * std::abs(reference)));
  }
  rows.push_back(bound("reactions and loads in balance, force", "1",
                       assessment.solution.force_residual, 1e-8, "equilibrium of the whole part"));
  return rows;
}

}  // namespace

std::vector<VerificationCase> part_cases(const ModelLibrary& library) {
  std::vector<VerificationCase> cases;
  for (const fs::path& folder : library.folders()) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / "parts", error))
      if (fs::exists(entry.path() / "part.yaml")) files.push_back(entry.path() / "part.yaml");
    std::sort(files.begin(), files.end());
    for (const fs::path& path : files) {
      Diagnostics diagnostics;
      const std::optional<PartFile> file = read_part_file(path, diagnostics);
      if (!file) throw InputError(diagnostics);
      const bool is_known = std::any_of(
          cases.begin(), cases.end(),
          [&](const VerificationCase& one) { return one.name == "part-" + file->name; });
      if (!file->references || is_known) continue;
      cases.push_back({"part-" + file->name, "structure", file->references->source,
                       [part = *file] { return compute(part); }});
    }
  }
  return cases;
}

}  // namespace blocklift::pipeline
