#pragma once

#include <memory>
#include <variant>
#include <vector>

namespace blocklift::dynamics {

/// A coordinate and its first two time derivatives (m, m/s, m/s2 or rad, rad/s, rad/s2).
struct ProfileValue {
  double position;
  double velocity;
  double acceleration;
};

/// What a drive can do: largest speed, acceleration (and deceleration) and jerk, all positive.
struct MotionLimits {
  double speed;
  double acceleration;
  double jerk;
};

/// Extremes of a profile over all time.
struct ProfileRange {
  double lowest;
  double highest;
  double peak_speed;
  double peak_acceleration;
};

/// Displacement from rest to rest in least time with limited speed, acceleration and jerk.
///
/// Seven segments: jerk, constant acceleration, jerk, cruise, and the same mirrored. Segments
/// vanish when the distance is too short to reach a limit. With t_j, t_a, t_v the durations of
/// jerk, constant acceleration and cruise:  distance = jerk t_j (t_j + t_a) (2 t_j + t_a + t_v),
/// from which the jerk is set, so that the move ends exactly at its distance. Source: Biagiotti and
/// Melchiorri (2008), 3.4.
class RestToRestMove {
 public:
  /// Starts at `start` (s) and covers `distance` (m or rad, of either sign, zero allowed).
  /// @throws ModelError if the distance is not finite or a limit not positive.
  RestToRestMove(double start, double distance, const MotionLimits& limits);
  /// The same stretched in time to last `duration` (s): slower throughout, in the same proportions.
  /// @throws ModelError if the limits do not allow it within that duration; the message says how
  /// long it takes at least.
  RestToRestMove(double start, double distance, const MotionLimits& limits, double duration);

  double start() const { return start_; }
  double end() const { return start_ + duration(); }
  double duration() const { return 4 * jerk_time_ + 2 * acceleration_time_ + cruise_time_; }
  double distance() const { return distance_; }

  /// Displacement since the start: 0 before it, exactly the distance from the end on.
  ProfileValue evaluate(double t) const;
  /// Times at which the jerk jumps, start and end included.
  std::vector<double> breakpoints() const;

 private:
  ProfileValue first_half(double time_since_start) const;

  double start_;
  double distance_;
  double jerk_time_ = 0;
  double acceleration_time_ = 0;
  double cruise_time_ = 0;
  double jerk_ = 0;  // with the sign of the distance
};

/// Natural cubic spline through points (x_i, y_i): twice continuously differentiable, straight
/// beyond the first and last point.
class NaturalSpline {
 public:
  /// @throws ModelError if there are fewer than two points, x does not increase, or a value is not
  /// finite.
  NaturalSpline(std::vector<double> x, std::vector<double> y);
  /// y, dy/dx, d2y/dx2 at x.
  ProfileValue evaluate(double x) const;
  double first_x() const { return x_.front(); }
  double last_x() const { return x_.back(); }
  const std::vector<double>& knots() const { return x_; }

 private:
  std::vector<double> x_, y_, curvature_;
};

/// How a drive goes that is steered on its way: its acceleration at even instants, straight between
/// them, from rest. Behind the last of them it keeps its speed.
struct Course {
  double start = 0.0;                       ///< s
  double interval = 1.0;                    ///< s
  std::vector<double> accelerations = {0};  ///< m/s2 or rad/s2; the first is 0
};

/// How a drive's coordinate or a winch's rope length goes over time: immutable, cheap to copy.
class MotionProfile {
 public:
  /// Stays at `value`.
  static MotionProfile constant(double value);
  /// Starts at `initial` and makes the moves one after another.
  /// @throws ModelError if a move starts before the one before it has ended, or `initial` is not
  /// finite.
  static MotionProfile sequence(double initial, std::vector<RestToRestMove> moves);
  /// Goes along a spline over the time: position y(t), straight beyond its ends.
  static MotionProfile along(NaturalSpline spline);
  /// Travel along a course, from 0; its acceleration is continuous.
  /// @throws ModelError if the interval is not positive, there is no acceleration, or one is not
  /// finite.
  static MotionProfile along(Course course);
  /// Follows another profile like a cam: position y(x(t)), x being the leader's position.
  /// @throws ModelError if the leader leaves the spline's range.
  static MotionProfile cam(MotionProfile leader, NaturalSpline spline);
  /// Sum of profiles, for instance of a cam during one stage and moves in others.
  static MotionProfile sum(std::vector<MotionProfile> parts);

  /// Another profile until `start` (s); then its clock slows evenly to a stand within `duration`
  /// (s): position x(s(t)), ds/dt falling from 1 to 0. From a constant speed v that is the constant
  /// deceleration v / duration.
  /// @throws ModelError if the duration is not positive.
  static MotionProfile stopped(MotionProfile profile, double start, double duration);

  /// Position, velocity, acceleration at time t (s); never allocates.
  ProfileValue evaluate(double t) const;
  /// Sorted times at which the jerk jumps (not those at which a cam's leader passes a knot); an
  /// integrator may restart there, and nothing moves before the first or after the last.
  const std::vector<double>& breakpoints() const { return breakpoints_; }
  /// Extremes; exact for moves from rest to rest, found at 64 instants between breakpoints for
  /// cams.
  ProfileRange range() const;

 private:
  struct Sequence {
    double initial;
    std::vector<RestToRestMove> moves;
  };
  struct Cam;
  struct Sum;
  struct Stopped;
  struct Steered;
  using Content = std::variant<Sequence, std::shared_ptr<const Cam>, std::shared_ptr<const Sum>,
                               std::shared_ptr<const NaturalSpline>, std::shared_ptr<const Stopped>,
                               std::shared_ptr<const Steered>>;

  MotionProfile(Content content, std::vector<double> breakpoints);

  Content content_;
  std::vector<double> breakpoints_;
};

}  // namespace blocklift::dynamics
