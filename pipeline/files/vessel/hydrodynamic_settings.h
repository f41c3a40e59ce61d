#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "dynamics/marine/green/panel_method.h"
#include "dynamics/marine/radiation/free_surface.h"
#include "pipeline/declaration/format.h"

namespace blocklift::pipeline {

/// Angular frequencies at equal distances, rad/s.
struct FrequencyRange {
  double lowest = std::numeric_limits<double>::quiet_NaN();
  double highest = std::numeric_limits<double>::quiet_NaN();
  int count = 0;
  Mark place;

  std::vector<double> list() const;
};

/// Rectangle of the water on which waves fade.
struct LidModel {
  std::array<double, 2> from{}, to{};                      ///< opposite corners in the world, m
  double rate = std::numeric_limits<double>::quiet_NaN();  ///< rad/s
};

/// What `blocklift hydro` computes for a vessel, or for several together. SI units.
struct HydrodynamicSettings {
  FrequencyRange frequencies;
  /// Directions of travel from +x towards +y, rad; none: default_headings().
  std::optional<std::vector<double>> headings;
  std::optional<double> water_depth;                                ///< m; none: deep
  double water_density = std::numeric_limits<double>::quiet_NaN();  ///< kg/m3
  dynamics::PanelMethod method = dynamics::PanelMethod::marched_surface;
  std::optional<double> panel_size;  ///< m; none: the vessel's own
  std::vector<double> draughts;      ///< upright, m, ascending; empty: afloat by its own weight
  bool as_meshed = false;            ///< z = 0 of the hull's own frame is the water
  bool mean_drift = false;           ///< compute mean drift forces of the hull afloat
  /// Where water in gaps and moonpools is damped.
  std::optional<std::vector<LidModel>> lids;
  bool symmetry = true;  ///< use the planes of symmetry that there are
};

/// Every 5 degrees, as a case has them that computes for itself, rad: waves between two headings
/// are interpolated.
std::vector<double> default_headings();

/// Lids (none given: none) whose places count from `origin` (m, level, in the world).
std::vector<dynamics::DampingLid> make_lids(
    const std::optional<std::vector<LidModel>>& models,
    const Eigen::Vector2d& origin = Eigen::Vector2d::Zero());

Format<LidModel> lid_format();
Format<HydrodynamicSettings> hydrodynamic_settings_format();

/// What finds the flow about hulls: the method's names are declared once, for vessels and cases.
Format<dynamics::PanelMethod> panel_method_format();
/// What a key of that format is for.
inline constexpr const char* panel_method_purpose =
    "what finds the flow: panels on the water's surface too, marched in time, or panels on the "
    "hulls alone whose sources make waves, frequency by frequency";

/// Draughts as a list of lengths that ascend.
Format<std::vector<double>> draughts_format();

}  // namespace blocklift::pipeline
