#include "pipeline/measures/load_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "pipeline/lift/sling_ends.h"

namespace blocklift::pipeline {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A series of both histories.
template <class Series>
LiftMeasure make_measure(const LiftRun& lift, LiftMeasure measure, const Series& value_at) {
  const auto series = [&](const dynamics::History& history) {
    Eigen::VectorXd values(history.sample_count());
    for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = value_at(history, i);
    return values;
  };
  measure.at_rest = series(lift.static_history);
  measure.in_motion = series(lift.dynamic_history());
  return measure;
}

void add_attitude(const LiftRun& lift, std::vector<LiftMeasure>& measures) {
  const auto attitude = [&](const dynamics::History& history, Eigen::Index sample) {
    return history.bodies[lift.model.load - 1].X_WB(sample).R;
  };
  measures.push_back(make_measure(lift,
                                  {.subject = "load",
                                   .kind = "tilt",
                                   .unit = "rad",
                                   .meaning = "angle of the load's z axis against the plumb"},
                                  [&](const dynamics::History& history, Eigen::Index sample) {
                                    const Eigen::Matrix3d R = attitude(history, sample);
                                    return std::atan2(R.col(2).head<2>().norm(), R(2, 2));
                                  }));
  const auto add_rise = [&](const char* kind, Eigen::Index axis, const char* meaning) {
    measures.push_back(make_measure(lift,
                                    {.subject = "load",
                                     .kind = kind,
                                     .unit = "rad",
                                     .extreme = Extreme::largest_magnitude,
                                     .meaning = meaning},
                                    [&](const dynamics::History& history, Eigen::Index sample) {
                                      const double rise = attitude(history, sample)(2, axis);
                                      return std::asin(std::clamp(rise, -1.0, 1.0));
                                    }));
  };
  add_rise("trim", 0, "angle of the load's x axis above the level");
  add_rise("list", 1, "angle of the load's y axis above the level");
  measures.push_back(turn_of_load(lift));
}

/// Against the level, of a pull upwards, rad; no number where there is none.
double angle_of(const Eigen::Vector3d& pull) {
  return pull.norm() > 0 ? std::atan2(pull.z(), pull.head<2>().norm()) : nothing;
}

/// Does a spreader hang on the rope's last end?
bool holds_spreader(const LiftRun& lift, int rope) {
  for (const LiftSpreader& bar : lift.model.spreaders)
    for (const LiftSpreader::End& end : bar.ends)
      if (end.rope == rope && end.from_above) return true;
  return false;
}

void add_sling_angles(const LiftRun& lift, std::vector<LiftMeasure>& measures) {
  const std::vector<SlingEnd> ends = find_sling_ends(lift.model);
  for (std::size_t i = 0; i < lift.model.ropes.size(); ++i) {
    const LiftRope& sling = lift.model.ropes[i];
    const bool to_spreader = holds_spreader(lift, sling.rope);
    if (!sling.holds_load() && !to_spreader) continue;
    measures.push_back(make_measure(
        lift,
        {.subject = lift.model.ropes[i].name,
         .kind = "sling angle",
         .unit = "rad",
         .extreme = Extreme::smallest,
         .meaning = "angle of the sling at its lug, or at the spreader that hangs on it, against "
                    "the level, while it pulls; of a sling from lug to lug, or of both ends of a "
                    "basket at their hooks, the lesser one"},
        [&](const dynamics::History& history, Eigen::Index sample) {
          double least = nothing;
          const dynamics::RopeHistory& rope = history.ropes[sling.rope];
          if (to_spreader) return angle_of(rope.last_force.row(sample));
          if (sling.lug.empty()) {
            for (const auto* pull : {&rope.first_force, &rope.last_force})
              least = std::fmin(least, angle_of(-pull->row(sample)));
          }
          for (const SlingEnd& end : ends)
            if (end.sling == i) least = std::fmin(least, angle_of(end.pull(history).row(sample)));
          return least;
        }));
  }
}

void add_margin(const LiftCase& lift_case, const LiftRun& lift,
                std::vector<LiftMeasure>& measures) {
  const std::vector<SlingEnd> ends = find_sling_ends(lift.model);
  const auto& inertia = lift.model.system.mechanism().body(lift.model.load).inertia;
  const Vector3 centre_B = inertia.p_BoBcm;
  const double weight = inertia.mass * lift_case.gravity;
  LiftMeasure margin = make_measure(
      lift,
      {.subject = "load",
       .kind = "margin of the centre of mass",
       .unit = "m",
       .extreme = Extreme::smallest,
       .meaning = "level distance of the centre of mass from the edge of the polygon of the lugs "
                  "that carry and of the places where slings press on edges upwards, positive "
                  "inside; while slings bear nine tenths of the weight"},
      [&](const dynamics::History& history, Eigen::Index sample) {
        const dynamics::Pose X_WB = history.bodies[lift.model.load - 1].X_WB(sample);
        double borne = lift_at_edges(lift.model, history, sample);
        for (const SlingEnd& end : ends) borne += end.pull(history)(sample, 2);
        if (borne < 0.9 * weight) return nothing;
        std::vector<Eigen::Vector2d> carrying;
        for (const Vector3& place_B : bearing_places(lift.model, history, sample))
          carrying.push_back((X_WB.R * place_B).head<2>());
        return distance_within(carrying, (X_WB.R * centre_B).head<2>());
      });
  // Two lugs, or lugs in a line, span no area.
  if (!margin.at_rest.array().isNaN().all()) measures.push_back(std::move(margin));
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Corners of the convex hull, anticlockwise (Andrew, 1979: monotone chain).
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Eigen::Vector2d> hull;
  const auto extend = [&](const Eigen::Vector2d& point, std::size_t kept) {
    while (hull.size() >= kept + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Eigen::Vector2d& point : points) extend(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = std::next(points.rbegin()); point != points.rend(); ++point)
    extend(*point, lower);
  hull.pop_back();
  return hull;
}

/// Angles of which each is known but for whole turns, m samples: each within half a turn of the
/// last one before it that counts, of none to begin with. Those of a load that is turned over do
/// not count: about a half turn over, the turn about the plumb leaps.
template <class Counts>
void unwind(Eigen::VectorXd& angles, const Counts& counts) {
  constexpr double whole = 2 * std::numbers::pi;
  double before = 0;
  for (Eigen::Index sample = 0; sample < angles.size(); ++sample) {
    angles[sample] = before + std::remainder(angles[sample] - before, whole);
    if (counts(sample)) before = angles[sample];
  }
}

}  // namespace

LiftMeasure turn_of_load(const LiftRun& lift) {
  const auto turned = [&](const dynamics::History& history,
                          Eigen::Index sample) -> Eigen::Matrix3d {
    const dynamics::BodyHistory& now = history.bodies[lift.model.load - 1];
    const dynamics::BodyHistory& start = lift.static_history.bodies[lift.model.load - 1];
    return now.X_WB(sample).R * start.X_WB(0).R.transpose();
  };
  LiftMeasure measure = make_measure(
      lift,
      {.subject = "load",
       .kind = "turn",
       .unit = "rad",
       .extreme = Extreme::largest_magnitude,
       .meaning = "turn of the load about the plumb away from where it hangs at the start"},
      [&](const dynamics::History& history, Eigen::Index sample) {
        const Eigen::Quaterniond turn(turned(history, sample));
        return 2 * std::atan2(turn.z(), turn.w());
      });
  const auto unwind_of = [&](const dynamics::History& history, Eigen::VectorXd& angles) {
    unwind(angles, [&](Eigen::Index sample) { return turned(history, sample)(2, 2) > 0; });
  };
  unwind_of(lift.static_history, measure.at_rest);
  unwind_of(lift.dynamic_history(), measure.in_motion);
  return measure;
}

double distance_within(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& point) {
  // Lugs in a line are so to within what their places are known to.
  constexpr double thin = 1e-6;  // m
  if (points.size() < 3) return nothing;
  const std::vector<Eigen::Vector2d> hull = convex_hull(points);
  if (hull.size() < 3) return nothing;
  double widest = 0, inside = std::numeric_limits<double>::infinity();
  double outside = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d &a = hull[i], &b = hull[(i + 1) % hull.size()];
    const Eigen::Vector2d along = b - a;
    for (const Eigen::Vector2d& corner : hull)
      widest = std::max(widest, turn(a, b, corner) / along.norm());
    inside = std::min(inside, turn(a, b, point) / along.norm());
    const double share = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    outside = std::min(outside, (point - a - share * along).norm());
  }
  if (widest < thin) return nothing;
  return inside >= 0 ? inside : -outside;
}

LiftMeasure righting_height(const LiftCase& lift_case, const LiftRun& lift) {
  const double weight =
      lift.model.system.mechanism().body(lift.model.load).inertia.mass * lift_case.gravity;
  const Eigen::VectorXd& times = lift.static_history.time;
  const Eigen::VectorXd borne = load_on_slings(lift.model, lift.static_history);
  // A load that a pad pushes at stands as much as it hangs.
  const auto pads_bear = [&lift, weight](Eigen::Index at) {
    return std::ranges::any_of(lift.static_history.supports, [&](const auto& pad) {
      return pad.normal_force[at] > 1e-3 * weight;
    });
  };
  return make_measure(
      lift,
      {.subject = "load",
       .kind = "righting height",
       .unit = "m",
       .extreme = Extreme::smallest,
       .meaning =
           "least moment against tilting over weight and tilt, of the equilibrium: height of "
           "an equal pendulum's pin above its centre of mass; below zero the load tips over, at "
           "-1000 m it slides with nothing that holds it; while slings bear nine tenths of the "
           "weight and no pad bears any"},
      [&](const dynamics::History& history, Eigen::Index sample) {
        const double* after =
            std::upper_bound(times.data(), times.data() + times.size(), history.time[sample]);
        const Eigen::Index at = std::max<Eigen::Index>(after - times.data() - 1, 0);
        if (borne[at] < 0.9 * weight || pads_bear(at)) return nothing;
        return std::max(lift.righting_height[at], least_righting_height);
      });
}

void add_load_measures(const LiftCase& lift_case, const LiftRun& lift,
                       std::vector<LiftMeasure>& measures) {
  add_attitude(lift, measures);
  add_sling_angles(lift, measures);
  add_margin(lift_case, lift, measures);
  measures.push_back(righting_height(lift_case, lift));
}

}  // namespace blocklift::pipeline
