#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/files/study/study_file.h"
#include "pipeline/study/limits/limiting_sea.h"
#include "pipeline/study/members/members.h"
#include "pipeline/study/search/search.h"
#include "pipeline/study/statistics/sobol_indices.h"
#include "pipeline/study/statistics/spread.h"

namespace blocklift::pipeline {

/// How a figure of summary.json is spoken of: "ropes, R1, max dynamic tension", in kN; angles in
/// degrees.
struct ShownFigure {
  std::string name;
  std::string unit;  ///< empty for a pure number
  double scale = 1;  ///< from the summary's unit to the shown one
};
/// @param unit that it has in the summary.
ShownFigure shown_figure(const std::string& path, const std::string& unit);

/// A study with what its members say together.
struct StudyResults {
  StudyFile study;
  Eigen::MatrixXd design;                  ///< a member a row
  std::vector<Member> members;             ///< in order
  std::vector<Spread> spreads;             ///< of each figure that every member has that ran
  std::vector<std::size_t> leading;        ///< of the spreads: those that the page shows first
  std::vector<Sensitivity> sensitivities;  ///< of the leading ones, for a sensitivity

  std::optional<LimitingSeas> limits;  ///< if the study asks for them
  std::optional<Operability> in_scatter, in_forecast;
  std::optional<SearchResults> search;  ///< of a search, with the design and the members of it

  /// Figures that the study asks for and some members that ran do not have, with their number: they
  /// have no spread.
  std::vector<std::pair<std::string, int>> left_out = {};
  AlphaFactor alpha = {};  ///< of the limits

  ShownFigure shown(const std::string& path) const;
  /// The figures of which study.csv and study.h5 have a column.
  std::vector<std::string> columns() const;
  /// Are the members drawn from laws? Those of a grid and of a search are no sample.
  bool is_sample() const;
  int failed() const;
  /// Whether any member says so of a figure.
  bool is_worse_when_smaller(const std::string& path) const;
  /// Values of a figure, of the members that ran.
  std::vector<double> values_of(const std::string& path) const;
  /// The first so many members were drawn independently of each other. For Sobol' indices these are
  /// the two samples; what follows puts columns of the one into the other.
  int independent() const;
  /// Values of a figure, of the independent members that ran.
  std::vector<double> sample_of(const std::string& path) const;
};

/// @throws std::runtime_error if no member ran.
StudyResults evaluate_study(StudyFile study, Eigen::MatrixXd design, std::vector<Member> members);

/// Of a search: its members are all that were tried.
StudyResults evaluate_search(StudyFile study, SearchResults search);

/// Where members of a sample failed: that its statistics are of the others. Empty where none did,
/// and of a grid and a search, which are no samples.
std::string survivors_warning(const StudyResults& results);
/// What is to be said of members and figures that are left out beside that, in sentences.
std::vector<std::string> left_out_warnings(const StudyResults& results);
/// All that is doubtful about a study, in sentences: each member that failed, and what both of
/// these say.
std::vector<std::string> study_warnings(const StudyResults& results);
/// Why the whole run is taken as failed: more than 5 % of a sample's members failed, or one of a
/// grid, each of which was asked for. Empty where it is not: the limits of seas take account of
/// members that failed, and a search passes them by.
std::string failure_of_run(const StudyResults& results);

/// What a study of limiting seas says beside its table, for terminal and page: what is not known,
/// how much of scatter table and forecast is workable.
std::vector<std::string> limiting_sentences(const StudyResults& results);

}  // namespace blocklift::pipeline
