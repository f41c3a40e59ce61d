#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/comparison/compared_result.h"
#include "pipeline/comparison/summary_figures.h"
#include "pipeline/comparison/tolerances.h"

namespace blocklift::pipeline {

/// A key of the input that does not say the same everywhere.
struct InputDifference {
  std::string file;  ///< as the case calls it; empty: the case file
  std::string key;   ///< "cranes.C1.start.gantry"; empty: the file as a whole is missing somewhere
  std::vector<std::optional<std::string>> values;  ///< one a result, as written; none: not there
};

/// A figure of several results.
struct ComparedFigure {
  SummaryFigure figure;
  std::vector<nlohmann::ordered_json> values;  ///< one a result, in SI units; null: not there
  /// What counts as zero, in SI units: a thousandth of a millionth of the largest value of all
  /// figures of its group and unit.
  double rounding = 0;

  /// From the first result to this one, in per cent; of figures in per cent, points. None where one
  /// of the two is no number, or the first counts as zero and is not in per cent: there is no share
  /// of it.
  std::optional<double> change(std::size_t result) const;
  /// From the first result to this one, in SI units; none where one of the two is no number.
  std::optional<double> difference(std::size_t result) const;
  /// Whether the first result's value counts as zero.
  bool is_from_zero() const;
  /// Whether the change is one of points.
  bool is_in_percent() const { return figure.unit == "%"; }
};

/// A figure that moved beyond its tolerance.
struct MovedFigure {
  std::size_t figure;     ///< among the compared ones
  std::size_t result;     ///< which was held against the first
  std::size_t tolerance;  ///< among the tolerances
};

/// Results beside each other; all changes count from the first.
struct ResultComparison {
  std::vector<ComparedResult> results;
  std::vector<InputDifference> input;
  std::vector<ComparedFigure> figures;  ///< by groups
  std::vector<Tolerance> tolerances;
  std::vector<MovedFigure> moved;
  std::size_t held = 0;  ///< figures that have a tolerance
};

/// Holds results against the first of them.
/// @throws InputError if a tolerance concerns no figure, or has a unit that its figures do not.
ResultComparison compare_results(std::vector<ComparedResult> results,
                                 std::vector<Tolerance> tolerances);

/// A value as it is shown: five digits in the figure's own unit, a text as it stands, "-" for null.
std::string shown_value(const ComparedFigure& figure, const nlohmann::ordered_json& value);
/// "+1.25 %", "-0.3 points"; "from 0" where the first is zero and this one is not, of which there
/// is no share; "differs" for texts that do, "" where nothing can be said.
std::string shown_change(const ComparedFigure& figure, std::size_t result);
/// What moved beyond which tolerance, one sentence.
std::string shown_move(const ResultComparison& comparison, const MovedFigure& moved);

/// The comparison for a terminal, within 80 columns.
std::string comparison_text(const ResultComparison& comparison);
nlohmann::ordered_json comparison_json(const ResultComparison& comparison);
/// A page that opens offline: tables, and the curves of tension over each other.
std::string comparison_page(const ResultComparison& comparison);

}  // namespace blocklift::pipeline
