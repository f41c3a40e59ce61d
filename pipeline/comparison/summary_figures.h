#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace blocklift::pipeline {

/// How far a figure of a lift may move before one would say that the lift has changed.
struct UsualTolerance {
  double relative = 0;  ///< of the value; 0: `absolute` counts
  double absolute = 0;  ///< in the figure's own unit
  std::string reason;
};

/// A figure of summary.json that two lifts can be compared by.
struct SummaryFigure {
  std::string path;   ///< as find_figure takes it
  std::string group;  ///< "rope loads", "checks": what it is shown with
  std::string label;  ///< within its group
  std::string unit;   ///< in which it is shown: "kN"; empty for a pure number or a text
  double scale = 1;   ///< from the summary's unit to the shown one
  UsualTolerance tolerance;
};

/// A place in a summary: keys and names of rows with dots between
/// ("ropes.R1.max_static_tension_N"). A row of a list goes by its name, lug, plate, rope or
/// instant, which may hold dots itself.
/// @returns null if there is no such place.
const nlohmann::ordered_json* find_figure(const nlohmann::ordered_json& summary,
                                          std::string_view path);

/// The figures of a summary in the order of a comparison: verdict, loads of ropes, hoists and
/// cranes, ratios of motion to rest, stress and deformation, checks, chains of a standard, natural
/// periods. Figures that are null are left out.
std::vector<SummaryFigure> list_figures(const nlohmann::ordered_json& summary);

/// Whether a figure is the worse the smaller it is: a clearance, a margin, a righting height, or
/// any other measure whose smallest value counts, and what a check asks to be at least its limit.
bool is_worse_when_smaller(const nlohmann::ordered_json& summary, std::string_view path);

/// Unit that a figure has in the summary, from the end of its last key: "N", "Pa", "m", "percent",
/// "s", ...; empty for a pure number.
std::string_view unit_of_path(std::string_view path);

/// The same of a figure whose row of the summary tells its unit, as those of measures do: "rad",
/// "N m"; empty if neither tells one.
std::string unit_of_figure(const nlohmann::ordered_json& summary, std::string_view path);

}  // namespace blocklift::pipeline
