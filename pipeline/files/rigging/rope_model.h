#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/format.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {

/// Wire rope, sling, or all falls of a tackle taken together. SI units.
struct RopeModel {
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  std::string kind;
  std::string title;
  double axial_stiffness = nan;  ///< EA of all falls together, N; none with a curve
  /// In its place: points of strain and tension, this as a load or a share of the breaking load.
  std::optional<Located<std::vector<std::array<Quantity, 2>>>> tension_curve;
  double damping_time = nan;   ///< Kelvin-Voigt: damping over stiffness, s
  double breaking_load = nan;  ///< of all falls together, N
  // What standards ask of a sling.
  std::optional<double> diameter;                   ///< of a part, m
  std::optional<double> mass_per_length;            ///< of all falls together, kg/m
  std::optional<Located<std::string>> material;     ///< by which a standard has its factor
  std::optional<Located<std::string>> termination;  ///< by which it has another
  Mark place;

  /// A point of the curve.
  struct CurvePoint {
    double strain = nan;
    double tension = nan;  ///< of all falls together, N
    bool operator==(const CurvePoint&) const = default;
  };
  /// The curve of tension over strain; empty with one stiffness.
  std::vector<CurvePoint> curve() const;
  /// Could its stretching be read? A model that could not be has been complained of.
  bool stretches() const { return tension_curve || std::isfinite(axial_stiffness); }
  /// Does it stretch and damp as the other?
  bool stretches_like(const RopeModel& other) const;
};

/// How a file says which rope it means: the name of a model file, or the rope's own keys.
struct RopeChoice {
  std::optional<Located<std::string>> model_name;
  std::optional<RopeModel> keys;
};

/// The format of a rope's model file.
Format<RopeModel> rope_model_format();

/// `ropes/sling-250t`, or `{axial_stiffness: ..., ...}` in its place.
/// @param breaking_load_required false where nothing is held against it.
Format<RopeChoice> rope_choice_format(bool breaking_load_required = true);

}  // namespace blocklift::pipeline
