#pragma once

#include <optional>

#include "pipeline/measurement/time_series.h"

namespace blocklift::pipeline {

/// A free oscillation c + e^(-s t) (a cos w t + b sin w t) that was fitted to a series.
struct Decay {
  double period = 0;             ///< 2 pi / w, s
  double period_deviation = 0;   ///< its standard deviation, s
  double damping_ratio = 0;      ///< s / sqrt(s^2 + w^2)
  double damping_deviation = 0;  ///< its standard deviation
  double amplitude = 0;          ///< at the beginning of the series, in its unit
  double explained = 0;          ///< share of the variance, 1 at most
};

/// Fits one decaying oscillation about a mean by least squares: frequency and decay from a scan,
/// with mean and both amplitudes as a linear problem for each (variable projection: Golub and
/// Pereyra 1973), then all five by Levenberg and Marquardt. Deviations are those of uncorrelated
/// errors of one size in all samples.
/// @returns none for less than 12 samples or one and a half periods, for a constant, and where the
///   fit explains less than half of the variance: no one oscillation rules then.
std::optional<Decay> fit_decay(const TimeSeries& series);

}  // namespace blocklift::pipeline
