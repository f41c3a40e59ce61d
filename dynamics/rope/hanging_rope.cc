// The law of ropes with weight, see rope.h.
#include <algorithm>
#include <cmath>

#include "dynamics/rope/rope.h"

namespace blocklift::dynamics {

namespace {

// With one end above the other no level direction is due, but for the shape a span is.
constexpr double least_share_of_span = 1e-9;

// Level direction from the first point to the last, unit; any where they stand above one another.
Vector3 level_direction(const Vector3& u) {
  const double level = std::hypot(u.x(), u.y());
  return level > least_share_of_span ? Vector3(u.x() / level, u.y() / level, 0.0)
                                     : Vector3(Vector3::UnitX());
}

double span_of(const RopePath& path, double unstretched_length) {
  const Vector3& u = path.direction_W.front();
  return std::max(path.length * std::hypot(u.x(), u.y()), least_share_of_span * unstretched_length);
}

// Along the chord, of a line's stiffness in its plane.
double chord_stiffness(const Catenary& line, const Vector3& u) {
  const Eigen::Vector2d along(std::hypot(u.x(), u.y()), u.z());
  return along.dot(line.stiffness * along);
}

}  // namespace

Catenary Rope::calc_catenary_of(const RopePath& path, double unstretched_length) const {
  const CatenaryLine line{.unstretched_length = unstretched_length,
                          .weight_per_length = definition_.weight_per_length,
                          .axial_stiffness = stiffness(unstretched_length) * unstretched_length};
  return calc_catenary(line, span_of(path, unstretched_length),
                       path.length * path.direction_W.front().z());
}

void Rope::hang(const RopePath& path, const RopeFeed& feed, RopeLoad& load) const {
  const double L0 = feed.unstretched_length;
  const double w = definition_.weight_per_length;
  const Vector3& u = path.direction_W.front();
  const Catenary line = calc_catenary_of(path, L0);
  HangingForces& h = load.hanging;
  h.level = line.horizontal;
  h.first_lift = line.lower_vertical;
  h.last_lift = -line.vertical;
  const double pull = line.horizontal * std::hypot(u.x(), u.y()) +
                      0.5 * (line.vertical + line.lower_vertical) * u.z();
  load.elastic_force = pull - w * L0;

  const double stretched = std::min(1.0, chord_stiffness(line, u) / load.stiffness);
  h.damping = damping(load.stiffness) * stretched * stretched;
  load.damping_force =
      std::max(-std::max(0.0, pull), h.damping * (load.length_rate - load.unstretched_rate));
  load.tension = std::max(line.tension, line.lower_tension) + load.damping_force;

  h.stored_energy = line.energy + w * L0 * path.first_height;
  const double T = line.lower_tension;
  const double a = line.vertical, b = line.lower_vertical;
  const double int_T2 = L0 * (line.horizontal * line.horizontal + (a * a + a * b + b * b) / 3.0);
  h.strain_energy = 0.5 * int_T2 / (load.stiffness * L0);
  h.feed_force = w * path.first_height - T - 0.5 * T * T / (load.stiffness * L0) +
                 0.5 * crane_compliance_ / (L0 * L0) * int_T2;
}

Vector3 Rope::first_force(const RopePath& path, const RopeLoad& load) const {
  if (load.split.acts) return first_force(path, load.split.first_tension);
  if (!hangs()) return first_force(path, load.tension);
  const Vector3& u = path.direction_W.front();
  return load.hanging.level * level_direction(u) + load.hanging.first_lift * Vector3::UnitZ() +
         load.damping_force * u;
}

Vector3 Rope::last_force(const RopePath& path, const RopeLoad& load) const {
  if (load.split.acts) return last_force(path, load.split.last_tension);
  if (!hangs()) return last_force(path, load.tension);
  const Vector3& u = path.direction_W.front();
  return -load.hanging.level * level_direction(u) + load.hanging.last_lift * Vector3::UnitZ() -
         load.damping_force * u;
}

void Rope::add_forces(const RopePath& path, const RopeLoad& load,
                      std::vector<ForceVector>& F_Bo_W) const {
  if (!hangs()) {
    add_forces(path, load.tension, F_Bo_W);
    return;
  }
  const auto add = [&](std::size_t point, const Vector3& f_W) {
    ForceVector& F = F_Bo_W[definition_.points[point].body];
    F.moment += path.r_W[point].cross(f_W);
    F.force += f_W;
  };
  add(0, first_force(path, load));
  add(1, last_force(path, load));
}

void Rope::add_hanging_derivatives(const Kinematics& kinematics, const RopePath& path,
                                   const RopeLoad& load, ForceDerivatives& derivatives) const {
  const std::vector<BodyPoint>& points = definition_.points;
  for (std::size_t i = 0; i < 2; ++i) derivatives.locate(i, points[i].body, path.r_W[i]);
  const Catenary line = calc_catenary_of(path, load.unstretched_length);
  const Vector3& u = path.direction_W.front();
  if (derivatives.stretch_only()) {
    derivatives.add_line(0, 1, chord_stiffness(line, u) * u * u.transpose(), Matrix3::Zero());
    return;
  }
  const Vector3 e = level_direction(u);
  const Vector3 up = Vector3::UnitZ();
  const Vector3 side = up.cross(e);
  const Matrix3 K =
      line.stiffness(0, 0) * e * e.transpose() +
      line.stiffness(0, 1) * (e * up.transpose() + up * e.transpose()) +
      line.stiffness(1, 1) * up * up.transpose() +
      line.horizontal / span_of(path, load.unstretched_length) * side * side.transpose();
  derivatives.add_held_force(0, load.hanging.level * e + load.hanging.first_lift * up);
  derivatives.add_held_force(1, -load.hanging.level * e + load.hanging.last_lift * up);
  derivatives.add_line(0, 1, K, Matrix3::Zero());
  const auto velocity = [&](std::size_t i) {
    return shift(kinematics.V_WB[points[i].body], path.r_W[i]).linear;
  };
  derivatives.add_tension(0, 1, {u, path.length, velocity(1) - velocity(0)}, load.damping_force,
                          0.0, load.hanging.damping);
}

}  // namespace blocklift::dynamics
