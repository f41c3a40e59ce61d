#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "dynamics/force/wind_field.h"
#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {

namespace given {

/// A single gust: by its shape, or by a table over time.
struct Gust {
  std::optional<Located<dynamics::WindGust::Shape>> shape;             ///< none: one_minus_cosine
  std::optional<Located<double>> magnitude;                            ///< m/s
  std::optional<Located<double>> start;                                ///< s
  std::optional<Located<double>> duration;                             ///< s
  std::optional<Located<std::vector<std::array<Quantity, 2>>>> table;  ///< s, m/s
  Mark place;

  /// The gust is sound.
  dynamics::WindGust make_gust() const;
};

/// Wind, steady or with gusts.
struct Wind {
  double speed = 0;    ///< at a height of 10 m, m/s
  double towards = 0;  ///< direction of travel from +x towards +y, rad
  double air_density = std::numeric_limits<double>::quiet_NaN();  ///< kg/m^3
  dynamics::WindProfile profile = dynamics::WindProfile::uniform;
  dynamics::GustSpectrum gusts = dynamics::GustSpectrum::none;
  double gust_height = 10;  ///< at which the spectrum is taken, m
  int seed = 1;
  std::optional<Gust> gust;

  /// Does it change over time?
  bool is_gusty() const { return gusts != dynamics::GustSpectrum::none || gust; }
  /// Times at which an integration looks at its single gust, s; empty: there is none.
  std::vector<double> breakpoints() const;
  /// @param at_rest the mean alone: for static equilibrium.
  std::shared_ptr<const dynamics::WindField> make_field(bool at_rest) const;
};

}  // namespace given

/// Shared by lift cases and mechanism files.
Format<given::Wind> wind_format();

}  // namespace blocklift::pipeline
