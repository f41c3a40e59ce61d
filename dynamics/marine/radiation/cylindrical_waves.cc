#include "dynamics/marine/radiation/cylindrical_waves.h"

#include <cmath>
#include <numbers>

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

// Beyond k radius the harmonics of a body fall off faster than any power, and what is left of them
// in figures is noise that the Hankel functions of high order would multiply.
constexpr int harmonics_that_matter = 3;

/// i^m.
Complex power_of_i(int m) {
  constexpr std::array<double, 4> real = {1.0, 0.0, -1.0, 0.0};
  const auto quarter = static_cast<std::size_t>(((m % 4) + 4) % 4);
  return {real[quarter], real[(quarter + 3) % 4]};
}

/// (1/N) exp(-i m theta_j): harmonics x directions.
MatrixXcd fourier_matrix(const std::vector<double>& directions, int order) {
  MatrixXcd matrix(2 * order + 1, static_cast<Eigen::Index>(directions.size()));
  const double share = 1.0 / static_cast<double>(directions.size());
  for (int m = -order; m <= order; ++m) {
    for (std::size_t j = 0; j < directions.size(); ++j) {
      matrix(m + order, static_cast<Eigen::Index>(j)) = std::polar(share, -m * directions[j]);
    }
  }
  return matrix;
}

/// J_m - i Y_m of any whole order.
Complex hankel(int m, double x) {
  const auto order = static_cast<double>(std::abs(m));
  const Complex value(std::cyl_bessel_j(order, x), -std::cyl_neumann(order, x));
  return m < 0 && m % 2 != 0 ? -value : value;
}

}  // namespace

int harmonic_order(double radius, double wave_number) {
  return static_cast<int>(std::ceil(radius * wave_number)) + harmonics_that_matter;
}

CylindricalWaves find_cylindrical_waves(const HydrodynamicDatabase& database, std::size_t frequency,
                                        int order) {
  const FarField& far = database.far_field;
  const MatrixXcd fourier = fourier_matrix(far.directions, order);
  const double k = calc_wave_number(database.frequencies[frequency], database.water);
  const Complex scale = std::polar(std::sqrt(0.5 * std::numbers::pi * k), -0.25 * std::numbers::pi);
  VectorXcd powers(2 * order + 1);
  for (int m = -order; m <= order; ++m) powers[m + order] = power_of_i(m);
  const MatrixXcd send = scale * (powers.conjugate().asDiagonal() * fourier);
  const MatrixXcd receive = fourier.adjoint() * powers.asDiagonal();
  return {order, send * far.radiated[frequency], send * far.scattered[frequency] * receive,
          database.excitation(frequency) * receive, database.froude_krylov[frequency] * receive};
}

VectorXcd plane_wave(int order, double direction) {
  VectorXcd waves(2 * order + 1);
  for (int n = -order; n <= order; ++n) {
    waves[n + order] = power_of_i(-n) * std::polar(1.0, -n * direction);
  }
  return waves;
}

MatrixXcd carry_waves(const Eigen::Vector2d& offset, double wave_number, int rows_order,
                      int columns_order) {
  const double x = wave_number * offset.norm(), alpha = std::atan2(offset.y(), offset.x());
  const int widest = rows_order + columns_order;
  VectorXcd waves(2 * widest + 1);
  for (int m = -widest; m <= widest; ++m)
    waves[m + widest] = hankel(m, x) * std::polar(1.0, m * alpha);
  MatrixXcd matrix(2 * rows_order + 1, 2 * columns_order + 1);
  for (int n = -rows_order; n <= rows_order; ++n) {
    for (int m = -columns_order; m <= columns_order; ++m) {
      matrix(n + rows_order, m + columns_order) = waves[m - n + widest];
    }
  }
  return matrix;
}

}  // namespace blocklift::dynamics
