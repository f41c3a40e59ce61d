#pragma once

#include <vector>

#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// A load over time, a force or a moment: straight between the points of a table, constant before
/// the first and behind the last.
class LoadTable {
 public:
  /// The same at all times.
  explicit LoadTable(const Vector3& constant);
  /// @param times ascending, s.
  /// @param values one for each time.
  /// @throws ModelError if there are no points, the times do not ascend, or a number is not finite.
  LoadTable(std::vector<double> times, std::vector<Vector3> values);

  /// Never allocates.
  Vector3 evaluate(double t) const;
  /// Times at which the slope changes; empty for a constant.
  const std::vector<double>& breakpoints() const { return times_; }

 private:
  std::vector<double> times_;  ///< empty for a constant
  std::vector<Vector3> values_;
};

}  // namespace blocklift::dynamics
