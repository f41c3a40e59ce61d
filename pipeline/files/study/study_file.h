#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/declaration/parameters_format.h"
#include "pipeline/files/lift_case/own_laws.h"

namespace blocklift::pipeline {

/// How a value is spread. Moments and bounds are values with the dimension of the key.
struct SpreadLaw {
  /// A file that was read names one that is known, here and in the enumerations below.
  enum class Kind { unknown, normal, lognormal, uniform, triangular, gumbel, weibull };
  /// The kinds by the words that name them in a file.
  static const std::vector<std::pair<std::string, Kind>>& kinds();
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
  std::vector<Located<Measure>> between;  ///< lowest and highest of a search; else empty
  Mark place;
};

/// How values are put together to members.
enum class StudyDesign {
  unknown,
  random,
  latin_hypercube,
  low_discrepancy,
  grid,
  sensitivity,
  search
};

/// Of fewer base members Sobol' indices say nothing: the interval of a correlation of 8 independent
/// pairs is 1.4 wide.
inline constexpr int fewest_for_sobol_indices = 8;

/// What is computed of each member.
enum class StudyRun { simulate, stress, assess };

/// A figure that a limiting sea may bring to a value, and no farther.
struct QuantityLimit {
  Located<std::string> figure;  ///< path of summary.json
  Located<Measure> at;          ///< in the summary's unit
};

/// Which sea states a lift bears: names of variables of the study, and what is limited.
struct SeaLimits {
  std::optional<Located<std::string>> height, period, heading;  ///< heading: none varies
  std::vector<QuantityLimit> quantities;
  /// Share of the limit that a forecast height may reach: 1 if there is neither this nor a table.
  std::optional<Located<double>> alpha;
  std::optional<Located<std::string>> alpha_table;  ///< file beside the study
  std::optional<Located<double>> planned_period;    ///< s, by which the table is entered
  /// s, added to it: a window has to last both. None is counted if it is left out.
  std::optional<Located<double>> contingency;
  std::optional<Located<std::string>> scatter, forecast;  ///< files beside the study
  Mark place;
};

/// A value that a figure may not pass in a search.
struct FigureBound {
  Located<std::string> figure;                        ///< path of summary.json
  std::optional<Located<Measure>> at_most, at_least;  ///< one of them, in the summary's unit
};

/// How two values are joined.
enum class CopulaKind { unknown, normal, student, clayton, gumbel, frank };

/// Two values that are not drawn independently of each other.
struct StudyCorrelation {
  std::vector<Located<std::string>> of;  ///< names of two variables with laws
  CopulaKind copula = CopulaKind::normal;
  std::optional<double> is;       ///< of the standard normal, or Student's, values behind them
  std::optional<double> kendall;  ///< or their rank correlation of Kendall
  std::optional<double> degrees;  ///< of freedom, of Student's copula
  Mark place;

  /// What `is` says, or what follows from Kendall's: of an elliptical copula.
  double coefficient() const;
};

/// A study: many lifts of one case whose keys vary.
struct StudyFile {
  std::string name;
  std::string title;
  Located<std::string> case_name;
  StudyRun run = StudyRun::simulate;
  StudyDesign design = StudyDesign::latin_hypercube;
  std::optional<int> members;        ///< none of a grid: as many as its values give
  std::optional<Located<int>> seed;  ///< of what is drawn at random; 1 if there is none
  std::vector<StudyVariable> variables;
  std::vector<StudyCorrelation> correlations;
  std::vector<Located<std::string>> figures;  ///< paths of summary.json; empty: the usual ones
  std::optional<SeaLimits> limits;
  std::optional<Located<std::string>> minimise, maximise;  ///< figure of a search: one of them
  std::vector<FigureBound> subject_to;                     ///< of a search
  std::string yaml;
  std::filesystem::path file;
  Mark place;
  OwnLaws laws = {};  ///< that steer drives of its case; not from the file

  /// The case's file or folder: beside the study, or in the working folder.
  std::filesystem::path case_path() const;
  /// Correlations of all variables with one another that a normal copula joins: its matrix.
  Eigen::MatrixXd correlation_matrix() const;
  /// A file that the study names, beside it.
  std::filesystem::path beside(const std::string& name) const { return file.parent_path() / name; }
};

Format<StudyFile> study_file_format();

/// Reads a study, or the study.yaml of a folder. None after a complaint.
std::optional<StudyFile> read_study_file(const std::filesystem::path& path,
                                         Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
