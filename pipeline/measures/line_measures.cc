#include "pipeline/measures/line_measures.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/rope/mooring_line.h"
#include "pipeline/measures/place_at.h"

namespace blocklift::pipeline {

namespace {

using dynamics::History;
using dynamics::LiftSystem;
using dynamics::MooringLine;
using dynamics::MotionState;
using dynamics::TuggerLine;

double tension_of(const TuggerLine& line, const MotionState& state) {
  return line.calc_tension(state);
}
double tension_of(const MooringLine& line, const MotionState& state) {
  return line.calc_shape(state).tension;
}

/// Tensions of the lines of one kind over a history, a column a line. By the law of the line
/// itself, at the bodies' places and velocities.
template <class Line>
Eigen::MatrixXd tensions(const LiftSystem& system, const History& history) {
  const auto& lines = std::get<std::vector<Line>>(system.elements());
  Eigen::MatrixXd values(history.sample_count(), static_cast<Eigen::Index>(lines.size()));
  dynamics::Kinematics kinematics(system.mechanism());
  for (Eigen::Index sample = 0; sample < history.sample_count(); ++sample) {
    for (std::size_t body = 1; body <= history.bodies.size(); ++body) {
      kinematics.X_WB[body] = history.bodies[body - 1].X_WB(sample);
      kinematics.V_WB[body] = history.bodies[body - 1].V_WB(sample);
    }
    const MotionState state{history.time[sample], system.q_start(), system.v_start(), kinematics};
    for (std::size_t i = 0; i < lines.size(); ++i)
      values(sample, static_cast<Eigen::Index>(i)) = tension_of(lines[i], state);
  }
  return values;
}

template <class Line>
void add_lines(const LiftRun& lift, const char* kind, const char* meaning,
               std::vector<LiftMeasure>& measures) {
  const auto& lines = std::get<std::vector<Line>>(lift.model.system.elements());
  if (lines.empty()) return;
  const Eigen::MatrixXd at_rest = tensions<Line>(lift.model.at_rest(), lift.static_history);
  const Eigen::MatrixXd in_motion = tensions<Line>(lift.model.system, lift.dynamic_history());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    measures.push_back({.subject = lines[i].name(),
                        .kind = kind,
                        .unit = "N",
                        .meaning = meaning,
                        .at_rest = at_rest.col(i),
                        .in_motion = in_motion.col(i)});
  }
}

/// Places of a rope's points at a sample, in W.
std::vector<Vector3> places_of(const dynamics::Rope& rope, const History& history,
                               Eigen::Index sample) {
  std::vector<Vector3> places;
  for (const dynamics::BodyPoint& point : rope.points())
    places.push_back(place_at(history, point, sample));
  return places;
}

/// The larger share of the tensions of a rope's two ends that friction at its sheaves allows: by
/// Euler and Eytelwein they are at most as 1 to r = exp(mu x sum of the angles of wrap), and the
/// larger of them is r / (1 + r) of both.
Eigen::VectorXd allowed_shares(const dynamics::Rope& rope, const History& history) {
  Eigen::VectorXd shares(history.sample_count());
  for (Eigen::Index i = 0; i < shares.size(); ++i) {
    const std::vector<Vector3> places = places_of(rope, history, i);
    double wrap = 0;
    for (std::size_t k = 1; k + 1 < places.size(); ++k) {
      const Vector3 come = places[k] - places[k - 1], leave = places[k + 1] - places[k];
      wrap += std::atan2(come.cross(leave).norm(), come.dot(leave));
    }
    shares[i] = 1 / (1 + std::exp(-rope.definition().sheave_friction * wrap));
  }
  return shares;
}

}  // namespace

void add_line_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures) {
  add_lines<TuggerLine>(lift, "tugger tension", "of the line", measures);
  add_lines<MooringLine>(lift, "mooring tension", "at the fairlead", measures);
}

void add_sheave_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures) {
  for (const LiftRope& rope : lift.model.ropes) {
    const auto index = static_cast<std::size_t>(rope.rope);
    const dynamics::Rope& built = lift.model.system.ropes()[index];
    if (!(built.definition().sheave_friction > 0)) continue;
    LiftMeasure share{.subject = rope.name,
                      .kind = "larger share",
                      .unit = "1",
                      .meaning =
                          "of the tensions of its two ends, which friction at its sheaves "
                          "makes unequal; at rest without friction"};
    const auto shares = [&](const History& history) {
      const dynamics::RopeHistory& one = history.ropes[index];
      const Eigen::ArrayXd first = one.first_force.rowwise().norm();
      const Eigen::ArrayXd last = one.last_force.rowwise().norm();
      return Eigen::VectorXd(
          (first + last > 0)
              .select(first.max(last) / (first + last), std::numeric_limits<double>::quiet_NaN()));
    };
    share.at_rest = shares(lift.static_history);
    share.in_motion = shares(lift.dynamic_history());
    measures.push_back(std::move(share));
    // Edges on the way bend it, too, and friction of theirs is told where it touches them.
    if (!built.edges().empty()) continue;
    measures.push_back({.subject = rope.name,
                        .kind = "share that friction allows",
                        .unit = "1",
                        .meaning =
                            "the most that the larger share may be before the rope slips at its "
                            "sheaves, at rest as well, where any share up to it may have been left",
                        .at_rest = allowed_shares(built, lift.static_history),
                        .in_motion = allowed_shares(built, lift.dynamic_history())});
  }
}

}  // namespace blocklift::pipeline
