#include "pipeline/measures/hook_block_measures.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/measures/place_at.h"

namespace blocklift::pipeline {

namespace {

using dynamics::BodyPoint;
using dynamics::History;
using Eigen::Index;

/// From one level direction to another, seen from above, rad.
double level_angle(const Vector3& from, const Vector3& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.head<2>().dot(to.head<2>()));
}

/// Angles at each sample, the turn nearest to the sample before.
template <class AngleAt>
Eigen::VectorXd unwrapped(const History& history, const AngleAt& angle_at) {
  constexpr double turn = 2 * std::numbers::pi;
  Eigen::VectorXd angles(history.sample_count());
  for (Index i = 0; i < angles.size(); ++i) {
    angles[i] = angle_at(i);
    if (i > 0) angles[i] += turn * std::round((angles[i - 1] - angles[i]) / turn);
  }
  return angles;
}

const std::vector<BodyPoint>& falls_of(const LiftRun& lift, const LiftHoist& hoist) {
  return lift.model.system.ropes()[hoist.rope].points();
}

/// Moment of the falls on the block about the vertical at each sample, N m.
Eigen::VectorXd falls_moment(const LiftRun& lift, const LiftHoist& hoist, const History& history) {
  const std::vector<BodyPoint>& falls = falls_of(lift, hoist);
  Eigen::VectorXd moments(history.sample_count());
  for (Index i = 0; i < moments.size(); ++i) {
    const Vector3 axis = pose_at(history, falls[1].body, i).p;
    moments[i] = 0;
    for (const std::size_t fall : {std::size_t{0}, std::size_t{2}}) {
      const Vector3 above = place_at(history, falls[fall], i);
      const Vector3 below = place_at(history, falls[fall + 1], i);
      const Vector3 pull =
          0.5 * history.ropes[hoist.rope].tension[i] * (above - below).normalized();
      moments[i] += (below - axis).cross(pull).z();
    }
  }
  return moments;
}

Eigen::VectorXd turn_on_bearing(const LiftRun& lift, const LiftHoist& hoist,
                                const History& history) {
  const dynamics::BodyIndex block = falls_of(lift, hoist)[1].body;
  return unwrapped(history, [&](Index i) {
    return level_angle(pose_at(history, block, i).R.col(0),
                       pose_at(history, hoist.hook, i).R.col(0));
  });
}

}  // namespace

bool block_turns(const LiftRun& lift, const LiftHoist& hoist) {
  return lift.model.system.ropes()[hoist.rope].definition().twin_falls;
}

Eigen::VectorXd falls_twist(const LiftRun& lift, const LiftHoist& hoist, const History& history) {
  const std::vector<BodyPoint>& falls = falls_of(lift, hoist);
  const auto across = [&](std::size_t point, Index i) -> Vector3 {
    return pose_at(history, falls[point].body, i).R *
           (falls[point].p_BoQ_B - falls[point + 2].p_BoQ_B);
  };
  return unwrapped(history, [&](Index i) { return level_angle(across(0, i), across(1, i)); });
}

void add_hook_block_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures) {
  for (const LiftHoist& hoist : lift.model.hoists) {
    if (!block_turns(lift, hoist)) continue;
    const auto add = [&](const char* kind, const char* unit, const char* meaning,
                         const auto& series) {
      LiftMeasure measure{.subject = hoist.name,
                          .kind = kind,
                          .unit = unit,
                          .extreme = Extreme::largest_magnitude,
                          .meaning = meaning};
      measure.at_rest = series(lift, hoist, lift.static_history);
      measure.in_motion = series(lift, hoist, lift.dynamic_history());
      measures.push_back(std::move(measure));
    };
    add("twist of falls", "rad",
        "of the hook block against what its tackle hangs from, positive anticlockwise seen from "
        "above; the falls turn it back most at a quarter of a turn, and cross at half a turn",
        falls_twist);
    add("moment of falls", "N m",
        "of the tackle's falls on the hook block about the vertical, positive anticlockwise seen "
        "from above",
        falls_moment);
    if (hoist.hook == falls_of(lift, hoist)[1].body) continue;
    add("turn on the bearing", "rad",
        "of the hook on its block, positive anticlockwise seen from above", turn_on_bearing);
  }
}

}  // namespace blocklift::pipeline
