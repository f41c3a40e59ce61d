#include "dynamics/marine/radiation/retardation_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;

/// Value at a time (s) of samples at equal steps, by the cubic polynomial through the four nearest.
MatrixXd interpolate(const std::vector<MatrixXd>& samples, double step, double time) {
  const double place = time / step;
  const auto count = static_cast<std::ptrdiff_t>(samples.size());
  if (place > static_cast<double>(count - 1) + 1e-9) {
    return MatrixXd::Zero(samples[0].rows(), samples[0].cols());
  }
  const std::ptrdiff_t width = std::min<std::ptrdiff_t>(4, count);
  const std::ptrdiff_t first =
      std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(place) - 1, 0, count - width);
  MatrixXd sum = MatrixXd::Zero(samples[0].rows(), samples[0].cols());
  for (std::ptrdiff_t i = 0; i < width; ++i) {
    double weight = 1.0;
    for (std::ptrdiff_t j = 0; j < width; ++j) {
      if (j == i) continue;
      weight *= (place - static_cast<double>(first + j)) / static_cast<double>(i - j);
    }
    sum += weight * samples[first + i];
  }
  return sum;
}

}  // namespace

void bring_to_one_step(std::vector<HydrodynamicDatabase>& databases, double least_duration) {
  double step = databases[0].time_step, duration = least_duration;
  for (const HydrodynamicDatabase& database : databases) {
    step = std::min(step, database.time_step);
    duration = std::max(duration,
                        database.time_step * static_cast<double>(database.retardation.size() - 1));
  }
  const auto count = static_cast<std::size_t>(std::llround(duration / step)) + 1;
  for (HydrodynamicDatabase& database : databases) {
    if (database.time_step == step && database.retardation.size() == count) continue;
    std::vector<MatrixXd> samples(count);
    for (std::size_t n = 0; n < count; ++n) {
      samples[n] =
          interpolate(database.retardation, database.time_step, step * static_cast<double>(n));
    }
    database.retardation = std::move(samples);
    database.time_step = step;
  }
}

}  // namespace blocklift::dynamics
