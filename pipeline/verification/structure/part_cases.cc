#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/part/part_assessment.h"
#include "pipeline/verification/structure/structure_cases.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

const char* unit_of(const PartReference& figure) {
  switch (figure.value.value.dimension) {
    case Dimension::length:
      return "m";
    case Dimension::frequency:
      return "Hz";
    default:
      return "Pa";
  }
}

// What holds without a reference: forces in balance, no reaction to loads in balance, rigid modes
// at frequency zero (but for the root of a rounding of the largest eigenvalue, some 1e10 times the
// first elastic one for a thin plate).
void add_properties(const PartAssessment& assessment, std::vector<VerificationRow>& rows) {
  const structure::PartSolution& solution = assessment.solution;
  if (!assessment.file.loads.empty())
    rows.push_back(bound("reactions and loads in balance, force", "1", solution.force_residual,
                         1e-8, "equilibrium of the whole part"));
  if (solution.load_magnitude > 0 &&
      solution.applied.force.norm() < 1e-9 * solution.load_magnitude) {
    double largest = 0;
    for (const structure::Wrench& reaction : solution.reactions)
      largest = std::max(largest, reaction.force.norm());
    rows.push_back(bound("largest reaction to loads in balance, of the loads", "1",
                         largest / solution.load_magnitude, 1e-8, "equilibrium of a free body"));
  }
  if (assessment.modes && assessment.modes->rigid_motions > 0 &&
      assessment.modes->rigid_motions < assessment.modes->squared_frequencies.size()) {
    const Eigen::VectorXd& squares = assessment.modes->squared_frequencies;
    const int rigid = assessment.modes->rigid_motions;
    rows.push_back(bound("largest frequency of a rigid motion over the first elastic one", "1",
                         std::sqrt(squares.head(rigid).cwiseAbs().maxCoeff() / squares[rigid]),
                         5e-3, "rigid motions have none"));
  }
}

std::vector<VerificationRow> compute(const PartFile& file) {
  std::vector<VerificationRow> rows;
  for (int level = 0; level <= file.references->refinements; ++level) {
    PartFile refined = file;
    refined.mesh.refinements += level;
    const PartAssessment assessment = assess_part(std::move(refined));
    const double allowance = std::pow(4.0, file.references->refinements - level);
    const std::string mesh =
        file.references->refinements == 0
            ? std::string()
            : fmt::format(", {} elements", assessment.model.mesh.solids.size());
    for (const PartReference& figure : file.references->figures) {
      const double reference = figure.value.value.value;
      rows.push_back(compare(name_of(figure) + mesh, unit_of(figure), reference,
                             figure_of(assessment, figure),
                             allowance * figure.tolerance * std::abs(reference)));
    }
    if (level == file.references->refinements) add_properties(assessment, rows);
  }
  return rows;
}

}  // namespace

std::vector<VerificationCase> part_cases(const ModelLibrary& library) {
  std::vector<VerificationCase> cases;
  for (const fs::path& folder : library.folders()) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const char* kind : {"parts", "lugs"})
      for (const auto& entry : fs::directory_iterator(folder / kind, error))
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
