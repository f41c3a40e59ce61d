#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace blocklift::pipeline {

/// A figure of a summary that a lift is held to.
///
/// Of `value`, `equals`, `at_least`, `at_most` and `magnitude_at_most` there is exactly one; a
/// value has a tolerance, of it or in its unit.
struct ExpectedFigure {
  std::string path;  ///< as find_figure takes it
  std::optional<double> value;
  std::optional<double> tolerance;           ///< share of the value
  std::optional<double> absolute_tolerance;  ///< in the figure's unit
  std::optional<std::string> equals;         ///< a text, a number or true or false, as written
  std::optional<double> at_least;
  std::optional<double> at_most;
  std::optional<double> magnitude_at_most;
  std::string reason;  ///< why it is held, and why to this tolerance
};

/// A figure that is not held.
struct BrokenFigure {
  std::size_t index;      ///< of the expected figure
  std::string complaint;  ///< "is 12.5 instead of 12 to 0.1"
};

/// Reads a list of figures, JSON or YAML. @throws InputError with all that is wrong in the file.
std::vector<ExpectedFigure> read_expected_figures(const std::filesystem::path& file);

/// The figures that a summary does not hold, in their order.
std::vector<BrokenFigure> find_broken_figures(const std::vector<ExpectedFigure>& figures,
                                              const nlohmann::ordered_json& summary);

/// The figures of a summary that two lifts are compared by (list_figures), with usual tolerances.
std::vector<ExpectedFigure> expect_figures(const nlohmann::ordered_json& summary);

/// Takes the summary's values for those that are out of tolerance; requirements, such as `at_most`
/// and `equals`, stay. @returns what was changed, as it was broken before.
std::vector<BrokenFigure> renew_figures(std::vector<ExpectedFigure>& figures,
                                        const nlohmann::ordered_json& summary);

/// How a file of figures is written.
enum class FigureSyntax { json, yaml };

/// The syntax of a file of figures as it stands. @throws InputError if it cannot be read.
FigureSyntax syntax_of_figures(const std::filesystem::path& file);

/// The file of these figures: JSON, one figure a line, so that a change reads well; or YAML, one
/// key a line.
std::string expected_figures_text(const std::vector<ExpectedFigure>& figures,
                                  FigureSyntax syntax = FigureSyntax::json);

}  // namespace blocklift::pipeline
