#include "dynamics/force/load_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

LoadTable::LoadTable(const Vector3& constant) : values_{constant} {
  if (!constant.allFinite()) throw ModelError("a constant load is not finite");
}

LoadTable::LoadTable(std::vector<double> times, std::vector<Vector3> values)
    : times_(std::move(times)), values_(std::move(values)) {
  if (times_.empty() || times_.size() != values_.size()) {
    throw ModelError("a table of loads has " + std::to_string(times_.size()) + " times and " +
                     std::to_string(values_.size()) + " values; one of each for each point is due");
  }
  for (std::size_t i = 0; i < times_.size(); ++i) {
    if (!std::isfinite(times_[i]) || !values_[i].allFinite()) {
      throw ModelError("point " + std::to_string(i + 1) + " of a table of loads is not finite");
    }
    if (i > 0 && !(times_[i] > times_[i - 1])) {
      throw ModelError("the times of a table of loads must ascend, but " +
                       std::to_string(times_[i]) + " s follows " + std::to_string(times_[i - 1]) +
                       " s");
    }
  }
}

Vector3 LoadTable::evaluate(double t) const {
  if (times_.empty() || t <= times_.front()) return values_.front();
  if (t >= times_.back()) return values_.back();
  const auto upper = std::upper_bound(times_.begin(), times_.end(), t);
  const auto i = static_cast<std::size_t>(upper - times_.begin());
  const double share = (t - times_[i - 1]) / (times_[i] - times_[i - 1]);
  return (1.0 - share) * values_[i - 1] + share * values_[i];
}

}  // namespace blocklift::dynamics
