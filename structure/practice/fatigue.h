#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace blocklift::structure {

/// Cycles of one range.
struct Cycles {
  double range = 0;  ///< Pa, or whatever the history is in
  double mean = 0;
  double count = 0;  ///< 0.5 or 1
};

/// Rainflow cycles of a history, in the order in which they are counted.
/// Source: ASTM E1049-85 (2017), section 5.4.4.
std::vector<Cycles> count_rainflow(const Eigen::VectorXd& history);

/// The same for a history that repeats for ever: it is begun at its largest magnitude, so that only
/// whole cycles are counted. Source: ASTM E1049-85 (2017), section 5.4.5.
std::vector<Cycles> count_rainflow_of_repeated(const Eigen::VectorXd& history);

/// S-N curve of two slopes, N(S) = knee_cycles (S_knee / S)^m with m = slope up to the knee (few
/// cycles, large ranges) and m = slope_beyond after it.
struct FatigueCurve {
  std::string name;
  double class_range = 0;    ///< range that is borne 2 million times, Pa (the class, "FAT")
  double slope = 3;          ///< m up to the knee
  double slope_beyond = 5;   ///< m beyond it
  double knee_cycles = 1e7;  ///< N at the knee
  /// k of plates thicker than the reference thickness t_ref (m): they bear ranges as if these were
  /// larger by (t / t_ref)^k.
  double thickness_exponent = 0;
  double reference_thickness = 0.025;
  std::string source;

  /// Range at the knee, Pa.
  double knee_range() const;
  /// By how much ranges in a plate of a thickness (m) count more: max(1, (t / t_ref)^k).
  /// Source: DNV-RP-C203 (2016), 2.4.3.
  double thickness_factor(double thickness) const;
  /// Number of cycles of a range (Pa) until failure; infinity for none.
  double cycles_to_failure(double range) const;
};

/// Miner's sum of cycles: sum of count / N(range).
double damage(const std::vector<Cycles>& cycles, const FatigueCurve& curve);

/// Detail categories of DNV-RP-C203 (in air) B1 to W3, by their name, with their thickness
/// exponents for t_ref = 25 mm.
/// @throws ModelError if there is none of that name; the message lists those that exist.
FatigueCurve fatigue_curve(const std::string& name);

/// Names of the curves that fatigue_curve knows.
std::vector<std::string> fatigue_curve_names();

}  // namespace blocklift::structure
