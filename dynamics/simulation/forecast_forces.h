#pragma once

#include <vector>

#include "dynamics/marine/loads/hull_force.h"
#include "dynamics/spatial/spatial_vector.h"

namespace blocklift::dynamics {

/// What waves do to hulls, known at instants of equal distance, numbered from the time 0 on.
///
/// Of each HullForce eleven numbers: the plane that the waves make of the water's surface about the
/// hull (WaterPlane, five numbers), and what is left of the force beside that of the plane. Of each
/// other force its six numbers. Between two instants every number is the polynomial of the fifth
/// degree through the later one and the five before it. Of cos(w t) it leaves `remainder`
/// (w interval)^6 at most (the remainder of Lagrange's interpolation). The last `kept` instants are
/// held.
///
/// Forces are numbered hulls first. Of each the first instant is set from which on it counts.
class ForecastForces {
 public:
  static constexpr long through = 6;
  static constexpr long kept = 32;
  /// Largest s (s + 1) (s + 2) (s + 3) (s + 4) (1 - s) / 6! for 0 <= s <= 1.
  static constexpr double remainder = 0.0235;

  /// Nothing is known, at any time.
  ForecastForces() = default;
  /// @param interval s.
  ForecastForces(double interval, std::size_t hulls, std::size_t others);

  double interval() const { return interval_; }
  std::size_t count() const { return first_.size(); }
  /// Number of the next instant; the first one is chosen by begin().
  long next() const { return next_; }
  double time_of(long instant) const { return interval_ * static_cast<double>(instant); }
  /// The last instant before a time, or at it (s).
  long before(double time) const;
  /// Forgets all instants. The next one to be added is the first after this time (s), or the one
  /// that was next, whichever is later.
  void begin(double time);
  /// The force counts from this instant on.
  void set_first(std::size_t force, long instant) { first_[force] = instant; }

  /// What is set next belongs to the next instant. Zeros until then.
  void add();
  void set(std::size_t hull, const WaterPlane& plane, const ForceVector& beside);
  void set(std::size_t force, const ForceVector& F);

  /// Are there all six instants about a time (s), none of them before `first`?
  bool has(long first, double time) const;
  /// Are all six instants about a time (s) known of this force, none of them before its first?
  bool covers(std::size_t force, double time) const;
  /// Numbers at a time, as far as they are known (s). Does not allocate.
  void interpolate(double time);
  /// Of the hull's body about Bo, in W, at a state of that time: that of the plane and what is
  /// beside.
  ForceVector calc_force(const HullForce& hull, std::size_t number, const MotionState& state) const;
  /// Of a force that is no hull's.
  ForceVector force(std::size_t number) const;
  /// By how much the interpolation of a force errs in the interval before the last instant, by the
  /// sixth difference of the seven last instants; of a hull of what is beside the plane. Zero where
  /// there are fewer from `first` on.
  ForceVector calc_error(std::size_t number, long first) const;

 private:
  Eigen::Index row(std::size_t number) const;
  Eigen::Index column(long instant) const { return ((instant % kept) + kept) % kept; }

  double interval_ = 0.0;
  std::size_t hulls_ = 0;
  long begun_ = 0, next_ = 0;
  std::vector<long> first_;  ///< instant from which a force counts
  Eigen::MatrixXd values_;   ///< a column each, in turn
  Eigen::VectorXd at_;       ///< at the time interpolated last
};

}  // namespace blocklift::dynamics
