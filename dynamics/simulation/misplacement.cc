#include "dynamics/simulation/misplacement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace blocklift::dynamics {
namespace {

/// A frame H seen from above.
struct Level {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< m, in W
  double heading = 0.0;                             ///< rad
  bool in_water = true;
};

Level level_of(const Arrangement& arrangement, std::size_t index, const Pose& X_WB) {
  const Pose X_WH = X_WB * arrangement.bodies[index].frame.X_BH;
  const bool lowered = static_cast<int>(index) == arrangement.lowered_body;
  return {X_WH.p.head<2>(), std::atan2(X_WH.R(1, 0), X_WH.R(0, 0)),
          !lowered || arrangement.mark.calc_draught(X_WB) > 0.0};
}

double length_of(const ArrangedBody& a, const ArrangedBody& b) {
  return std::max(a.length, b.length);
}

void measure(const Arrangement& arrangement, const std::vector<Level>& now, double time,
             PairMisplacement& pair) {
  const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
  if (!now[i].in_water || !now[j].in_water) return;
  const ArrangedBody &a = arrangement.bodies[i], &b = arrangement.bodies[j];
  const double turn = std::remainder(now[j].heading - now[i].heading, 2.0 * std::numbers::pi);
  const Eigen::Rotation2Dd mean(now[i].heading + 0.5 * turn);
  const Eigen::Vector2d change =
      mean.inverse() * (now[j].place - now[i].place) - (b.place - a.place);
  const double distance = change.norm();
  const double at_ends = distance + 0.5 * length_of(a, b) * std::abs(turn);
  ++pair.samples;
  if (at_ends > pair.limit) ++pair.samples_beyond;
  pair.distance.take(distance, time);
  pair.turn.take(std::abs(turn), time);
  pair.at_ends.take(at_ends, time);
}

void measure_group(const std::vector<Level>& now, double time, LargestInTime& turn) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Level& level : now) {
    if (level.in_water) sum += Eigen::Vector2d(std::cos(level.heading), std::sin(level.heading));
  }
  if (!sum.isZero(0.0)) turn.take(std::abs(std::atan2(sum.y(), sum.x())), time);
}

}  // namespace

void LargestInTime::take(double another, double when) {
  if (!std::isnan(time) && another <= value) return;
  value = another;
  time = when;
}

double misplacement_limit(const ArrangedBody& a, const ArrangedBody& b, double wave_length) {
  return std::min(0.2 * std::min(a.breadth, b.breadth), wave_length / 40.0);
}

Misplacement find_misplacement(const Arrangement& arrangement, const History& history) {
  Misplacement misplacement;
  const auto count = static_cast<int>(arrangement.bodies.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      PairMisplacement pair;
      pair.first = i;
      pair.second = j;
      pair.limit =
          misplacement_limit(arrangement.bodies[i], arrangement.bodies[j], arrangement.wave_length);
      misplacement.pairs.push_back(pair);
    }
  }
  std::vector<Level> now(arrangement.bodies.size());
  for (Eigen::Index sample = 0; sample < history.sample_count(); ++sample) {
    for (std::size_t i = 0; i < now.size(); ++i) {
      const auto body = static_cast<std::size_t>(arrangement.bodies[i].frame.body - 1);
      now[i] = level_of(arrangement, i, history.bodies[body].X_WB(sample));
    }
    const double time = history.time[sample];
    for (PairMisplacement& pair : misplacement.pairs) measure(arrangement, now, time, pair);
    measure_group(now, time, misplacement.group_turn);
  }
  return misplacement;
}

}  // namespace blocklift::dynamics
