#include "pipeline/verification/models/resonance.h"

#include <Eigen/QR>

namespace blocklift::dynamics::examples {

std::complex<double> find_resonance(std::span<const double> frequencies,
                                    std::span<const std::complex<double>> masses) {
  const auto count = static_cast<Eigen::Index>(frequencies.size());
  Eigen::MatrixXcd columns(count, 5);
  Eigen::VectorXcd values(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const double w = frequencies[index], x = w / frequencies.back() - 1.0;
    columns.row(k) << masses[index], 1.0, x, x * x, x * x * x;
    values[k] = w * masses[index];
  }
  return columns.colPivHouseholderQr().solve(values)[0];
}

}  // namespace blocklift::dynamics::examples
