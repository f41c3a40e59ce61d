#include "pipeline/measures/vessel_measures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

#include "dynamics/marine/hull/hull.h"

namespace blocklift::pipeline {

namespace {

/// Vertices of a hull that are not lower than its highest by more than a hundredth of its depth:
/// its deck.
std::vector<Vector3> deck_of(const dynamics::Hull& hull) {
  const auto [lowest, highest] = hull.bounds();
  const double least = highest.z() - 0.01 * (highest.z() - lowest.z());
  std::vector<Vector3> deck;
  std::copy_if(hull.vertices().begin(), hull.vertices().end(), std::back_inserter(deck),
               [&](const Vector3& p_B) { return p_B.z() >= least; });
  return deck;
}

void add_measure(const LiftRun& lift, dynamics::BodyIndex body, LiftMeasure measure,
                 const std::function<double(const dynamics::Pose&)>& value_of,
                 std::vector<LiftMeasure>& measures) {
  const auto series = [&](const dynamics::History& history) {
    const auto& poses = history.bodies[body - 1];
    Eigen::VectorXd values(history.sample_count());
    for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = value_of(poses.X_WB(i));
    return values;
  };
  measure.at_rest = series(lift.static_history);
  measure.in_motion = series(lift.dynamic_history());
  measures.push_back(std::move(measure));
}

double rise(const dynamics::Pose& X_WB, Eigen::Index axis) {
  return std::asin(std::clamp(X_WB.R(2, axis), -1.0, 1.0));
}

}  // namespace

void add_vessel_measures(const LiftCase& lift_case, const LiftRun& lift,
                         std::vector<LiftMeasure>& measures) {
  for (const given::Vessel& vessel : lift_case.vessels) {
    const std::string& name = vessel.name.value;
    const dynamics::BodyIndex body = lift.model.system.mechanism().body_index(name);
    add_measure(
        lift, body,
        {.subject = name,
         .kind = "heel",
         .unit = "rad",
         .extreme = Extreme::largest_magnitude,
         .meaning = "angle of the vessel's y axis above the level: positive with port up"},
        [](const dynamics::Pose& X_WB) { return rise(X_WB, 1); }, measures);
    add_measure(
        lift, body,
        {.subject = name,
         .kind = "trim of the vessel",
         .unit = "rad",
         .extreme = Extreme::largest_magnitude,
         .meaning = "angle of the vessel's x axis above the level: positive with the bow up"},
        [](const dynamics::Pose& X_WB) { return rise(X_WB, 0); }, measures);
    add_measure(
        lift, body,
        {.subject = name,
         .kind = "freeboard",
         .unit = "m",
         .extreme = Extreme::smallest,
         .meaning = "height of the deck's lowest point over calm water"},
        [deck = deck_of(vessel.model->hull)](const dynamics::Pose& X_WB) {
          double lowest = std::numeric_limits<double>::infinity();
          for (const Vector3& p_B : deck) lowest = std::min(lowest, X_WB.apply(p_B).z());
          return lowest;
        },
        measures);
  }
}

}  // namespace blocklift::pipeline
