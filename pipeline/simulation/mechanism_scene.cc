#include "pipeline/simulation/mechanism_scene.h"

#include <algorithm>
#include <map>

#include "pipeline/results/files/lift_scene.h"

namespace blocklift::pipeline {
namespace {

using dynamics::BodyIndex;

/// Points of interest of each body, in its own frame, m.
using BodyPoints = std::map<BodyIndex, std::vector<Vector3>>;

// All bars are this part of the longest one thick.
constexpr double slenderness = 1.0 / 25.0;

BodyPoints find_points(const dynamics::LiftSystem& system) {
  BodyPoints points;
  const dynamics::Mechanism& mechanism = system.mechanism();
  for (BodyIndex i = 1; i < mechanism.body_count(); ++i) {
    const dynamics::Body& body = mechanism.body(i);
    points[i].push_back(body.inertia.p_BoBcm);
    points[body.parent].push_back(body.X_PJ.p);
  }
  for (const dynamics::Loop& loop : mechanism.loops()) {
    if (loop.follower >= 0) {
      points[loop.base].push_back(loop.X_BaseK.p);
      points[loop.follower].push_back(loop.X_FollowerK.p);
    }
    for (const auto& path : loop.paths) {
      for (const auto& point : path) points[point.body].push_back(point.p_BoQ_B);
    }
  }
  for (const dynamics::Rope& rope : system.ropes()) {
    for (const dynamics::BodyPoint& point : rope.points())
      points[point.body].push_back(point.p_BoQ_B);
  }
  for (const auto& spring : std::get<std::vector<dynamics::PointSpring>>(system.elements())) {
    for (const dynamics::BodyPoint& point : {spring.definition().from, spring.definition().to})
      points[point.body].push_back(point.p_BoQ_B);
  }
  return points;
}

// Lengths below it are no bars, m.
constexpr double no_length = 1e-9;

/// A bar from the body's origin to a point.
DrawnBox bar(const Vector3& end, double thickness) {
  const double length = end.norm();
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitX(), end);
  return {{length, thickness, thickness}, 0.5 * end, {turn.w(), turn.x(), turn.y(), turn.z()}};
}

}  // namespace

Scene make_scene(const MechanismFile& file, const BuiltMechanism& built) {
  const dynamics::Mechanism& mechanism = built.system.mechanism();
  const BodyPoints points = find_points(built.system);
  double longest = 0;
  for (const auto& [body, ends] : points) {
    if (body == dynamics::world_index) continue;
    for (const Vector3& end : ends) longest = std::max(longest, end.norm());
  }
  const double smallest = slenderness * (longest > no_length ? longest : 1.0);
  Scene scene;
  for (BodyIndex i = 1; i < mechanism.body_count(); ++i) {
    DrawnBody drawn{mechanism.body(i).name, "body", {}};
    if (const BodyModel* body = file.find_body(drawn.name)) {
      for (const BoxShape& box : body->shapes) drawn.boxes.push_back(drawn_box(box));
    }
    const auto ends = points.find(i);
    if (drawn.boxes.empty() && ends != points.end()) {
      for (const Vector3& end : ends->second) {
        if (end.norm() > no_length) drawn.boxes.push_back(bar(end, smallest));
      }
    }
    if (drawn.boxes.empty()) {
      drawn.boxes.push_back({Vector3::Constant(2 * smallest), Vector3::Zero()});
    }
    scene.bodies.push_back(drawn);
  }
  return scene;
}

}  // namespace blocklift::pipeline
