#pragma once

#include <vector>

#include "pipeline/measures/measure.h"
#include "structure/practice/column.h"

namespace blocklift::pipeline {

/// A force on a bar at a point, both in the bar's frame.
struct BarForce {
  Vector3 p_BoQ_B = Vector3::Zero();  ///< m
  Vector3 f_B = Vector3::Zero();      ///< N
};

/// The largest compression along a straight bar about its middle (the largest pull, negative, if it
/// is pressed nowhere), and the largest moments about its axes y and z, each by itself.
///
/// Weight and inertia are those of an even rod: a load along it, linear in x, that balances forces
/// and moments exactly, so that no acceleration is asked for. Moments are those about the bar's axis
/// where it is straight: that of an eye beside it joins at the eye.
structure::ColumnForces largest_forces(const std::vector<BarForce>& forces, double length);

/// The factor on the forces in spreaders.
double spreader_factor(const CheckSettings& checks);

/// The most that the ropes of a bar ask of a column in its place at any instant, at rest and in
/// motion: structure::column_utilisation with that factor.
double largest_share(const structure::Column& column, const LiftSpreader& bar, const LiftRun& lift,
                     double factor);

/// The downward pull of all that hangs below a bar, at each sample, N.
Eigen::VectorXd hung_load(const LiftSpreader& bar, const dynamics::History& history);

/// The load below a bar that a column in its place bears: what hangs there at the instant of the
/// largest share of the resistance, grown with all forces of the ropes until
/// structure::column_utilisation reaches 1, N. Zero where nothing hangs at that instant.
double borne_load(const structure::Column& column, const LiftSpreader& bar,
                  const dynamics::History& history);

/// For each spreader its compression, its bending moment, and what it bears over what it may, by
/// structure::column_utilisation.
void add_spreader_measures(const LiftCase& lift_case, const LiftRun& lift,
                           std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
