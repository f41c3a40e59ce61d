#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// Which end of a measure's values counts.
enum class Extreme { largest, smallest, largest_magnitude };

/// A figure of the lift that follows from where its parts are and what pulls at them: a hook's
/// radius, a sling's angle, the load on a crane's wheel. One value for each sample of a history;
/// not a number where it has none, a slack rope's angle.
struct LiftMeasure {
  std::string subject;  ///< what it is of: "C1.main", "load", "R3"
  std::string kind;     ///< "radius", "tilt": of one kind and unit for all subjects
  std::string unit;     ///< SI: "m", "rad", "N", "N m", "1"
  Extreme extreme = Extreme::largest;
  std::string meaning;  ///< in words
  Eigen::VectorXd at_rest = {};
  Eigen::VectorXd in_motion = {};

  std::string name() const { return subject + ": " + kind; }
};

/// Where a series is furthest out. Values that are not numbers are passed over.
struct MeasurePeak {
  double value = 0;  ///< not a number if the series has none
  double time = 0;   ///< s
};
MeasurePeak find_peak(const Eigen::VectorXd& time, const Eigen::VectorXd& values, Extreme extreme);
/// Of both histories, whichever is further out.
MeasurePeak find_peak(const LiftRun& lift, const LiftMeasure& measure);

/// All measures of a lift: attitude of the load and angles of its slings, forces in spreaders,
/// radius, leads and capacity of hooks, twist of blocks that turn, what cranes press on, single
/// ropes of tackles, tuggers and moorings, shares of ropes with friction, what ropes do at edges of
/// the load, heel of vessels, what is missed of what drives keep, clearances.
std::vector<LiftMeasure> find_measures(const LiftCase& lift_case, const LiftRun& lift);

}  // namespace blocklift::pipeline
