#include "dynamics/marine/radiation/response_amplitude.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algebra/factors.h"
#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The matrix [a] with [a] b = a x b.
Matrix3 cross_matrix(const Vector3& a) {
  Matrix3 matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

/// A_ii at a frequency, linear between the database's frequencies and constant beyond.
double added_mass_at(const HydrodynamicDatabase& database, Eigen::Index mode, double frequency) {
  const auto& w = database.frequencies;
  const auto value = [&](std::size_t k) { return database.added_mass[k](mode, mode); };
  if (frequency <= w.front()) return value(0);
  if (frequency >= w.back()) return value(w.size() - 1);
  const auto above = std::upper_bound(w.begin(), w.end(), frequency);
  const auto k = static_cast<std::size_t>(above - w.begin());
  const double s = (frequency - w[k - 1]) / (w[k] - w[k - 1]);
  return (1.0 - s) * value(k - 1) + s * value(k);
}

}  // namespace

std::vector<MatrixXcd> calc_response_amplitudes(const HydrodynamicDatabase& database,
                                                const MatrixXd& mass, const MatrixXd& damping) {
  const Eigen::Index modes = database.mode_count();
  if (mass.rows() != modes || mass.cols() != modes) {
    throw ModelError("the mass matrix is " + std::to_string(mass.rows()) + " x " +
                     std::to_string(mass.cols()) + " where the database has " +
                     std::to_string(modes) + " modes");
  }
  if (damping.size() > 0 && (damping.rows() != modes || damping.cols() != modes)) {
    throw ModelError("the damping is not that of the database's " + std::to_string(modes) +
                     " modes");
  }
  if (database.hydrostatic_stiffness.rows() != modes) {
    throw ModelError(
        "the database does not hold the hydrostatic stiffness that the response needs");
  }
  std::vector<MatrixXcd> response;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const double w = database.frequencies[k];
    MatrixXcd matrix(modes, modes);
    matrix.real() = database.hydrostatic_stiffness - w * w * (mass + database.added_mass[k]);
    matrix.imag() = w * database.damping[k];
    if (damping.size() > 0) matrix.imag() += w * damping;
    response.emplace_back(
        algebra::LuFactors<std::complex<double>>(matrix).solve_columns(database.excitation(k)));
  }
  return response;
}

double calc_natural_period(const HydrodynamicDatabase& database, const MatrixXd& mass,
                           Eigen::Index mode) {
  const double stiffness = database.hydrostatic_stiffness(mode, mode);
  const double heaviest = mass(mode, mode) + std::abs(added_mass_at(database, mode, 0.0));
  // What is left of a stiffness that should be zero: a period of more than 1000 s is none.
  if (!(stiffness > 4e-5 * heaviest)) return not_a_number;
  // The mass varies slowly with the frequency: bisection between bounds that always hold the root.
  const auto excess = [&](double w) {
    return w * w * (mass(mode, mode) + added_mass_at(database, mode, w)) - stiffness;
  };
  double low = 0.0, high = 2.0 * std::sqrt(stiffness / mass(mode, mode));
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0.0 ? low : high) = middle;
  }
  return 2.0 * std::numbers::pi / high;
}

Matrix6 make_mass_matrix(double mass, const Vector3& radii, const Matrix3& R_WB) {
  Matrix6 matrix = Matrix6::Zero();
  matrix.diagonal().head<3>().setConstant(mass);
  matrix.bottomRightCorner<3, 3>() =
      R_WB * (mass * radii.array().square()).matrix().asDiagonal() * R_WB.transpose();
  return matrix;
}

Matrix6 calc_floating_stiffness_over_rho_g(const Hydrostatics& hydrostatics,
                                           const Vector3& p_BoBcm_W) {
  const Matrix3 arm = cross_matrix(-p_BoBcm_W);  // from the centre of mass to Bo
  // Motion of Bo by that of the centre of mass: displacement + rotation x arm.
  Matrix6 motion = Matrix6::Identity();
  motion.bottomLeftCorner<3, 3>() = -arm;
  Matrix6 stiffness = calc_stiffness_over_rho_g(hydrostatics) * motion;
  stiffness.topRows<3>() += arm * stiffness.bottomRows<3>();
  // The arm turns with the body: (rotation x arm) x buoyancy.
  stiffness.topLeftCorner<3, 3>() -= cross_matrix({0.0, 0.0, hydrostatics.volume}) * arm;
  Matrix6 exchanged;
  exchanged << stiffness.bottomRightCorner<3, 3>(), stiffness.bottomLeftCorner<3, 3>(),
      stiffness.topRightCorner<3, 3>(), stiffness.topLeftCorner<3, 3>();
  return exchanged;
}

}  // namespace blocklift::dynamics
