#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/parameters_format.h"

namespace blocklift::pipeline {

/// How a value is spread. Moments and bounds are values with the dimension of the key.
struct SpreadLaw {
  enum class Kind { normal, lognormal, uniform, triangular, gumbel, weibull };
  Kind kind = Kind::normal;
  std::optional<Located<Measure>> mean, deviation, lowest, highest, mode;
  Mark place;
};

/// What varies: keys of the case or of its models, which all have the one value.
struct StudyVariable {
  Located<std::string> name;
  std::vector<Located<std::string>> keys;  ///< "ropes.R1.length", "blocks/hull-860t:mass"
  std::vector<Located<Measure>> values;    ///< in turn; empty if a law spreads them
  std::optional<SpreadLaw> law;
  Mark place;
};

/// How values are put together to members.
enum class StudyDesign { random, latin_hypercube, low_discrepancy, grid, sensitivity };

/// What is computed of each member.
enum class StudyRun { simulate, assess };

/// A study: many lifts of one case whose keys vary.
struct StudyFile {
  std::string name;
  std::string title;
  Located<std::string> case_name;
  StudyRun run = StudyRun::simulate;
  StudyDesign design = StudyDesign::latin_hypercube;
  int members = 0;
  int seed = 1;
  std::vector<StudyVariable> variables;
  std::vector<Located<std::string>> figures;  ///< paths of summary.json; empty: the usual ones
  std::string yaml;
  std::filesystem::path file;
  Mark place;

  /// The case's file or folder: beside the study, or in the working folder.
  std::filesystem::path case_path() const;
};

Format<StudyFile> study_file_format();

/// Reads a study, or the study.yaml of a folder. None after a complaint.
std::optional<StudyFile> read_study_file(const std::filesystem::path& path,
                                         Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
