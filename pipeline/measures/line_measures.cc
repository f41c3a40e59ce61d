#include "pipeline/measures/line_measures.h"

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/rope/mooring_line.h"

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

/// Tensions of the lines of one kind over a history, a column a line. By the law of the line itself,
/// at the bodies' places and velocities.
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

}  // namespace

void add_line_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures) {
  add_lines<TuggerLine>(lift, "tugger tension", "of the line", measures);
  add_lines<MooringLine>(lift, "mooring tension", "at the fairlead", measures);
}

void add_sheave_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures) {
  for (const LiftRope& rope : lift.model.ropes) {
    const auto index = static_cast<std::size_t>(rope.rope);
    if (!(lift.model.system.ropes()[index].definition().sheave_friction > 0)) continue;
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
  }
}

}  // namespace blocklift::pipeline
