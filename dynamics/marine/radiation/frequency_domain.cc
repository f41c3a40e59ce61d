#include "dynamics/marine/radiation/frequency_domain.h"

namespace blocklift::dynamics {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

FrequencyDomain::FrequencyDomain(const PanelModel& model, const RankinePart& part,
                                 const Eigen::VectorXd& damping)
    : model_(model), part_(part), damping_(damping) {}

MatrixXcd FrequencyDomain::solve(double frequency, const MatrixXcd& supply) const {
  const double g = model_.water().gravity;
  MatrixXcd matrix = (g * part_.surface_operator()).cast<Complex>();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Complex rate(damping_[i], frequency);
    matrix(i, i) += rate * rate;
  }
  return matrix.partialPivLu().solve(-g * supply);
}

void FrequencyDomain::calc_radiation(double frequency, MatrixXd& added_mass,
                                     MatrixXd& damping) const {
  const MatrixXd& q = part_.surface_columns();
  const MatrixXcd potential = solve(frequency, q.cast<Complex>());
  // -F = (i w A + B) v: the share of the surface is -i w rho c . phi.
  const double scale = model_.water().density * part_.image_count();
  const MatrixXcd share = scale * (q.transpose() * potential);
  const MatrixXd infinite = model_.water().density * part_.infinite_frequency_volume();
  added_mass = infinite - share.real();
  damping = frequency * share.imag();
}

Eigen::VectorXcd FrequencyDomain::calc_force(double frequency,
                                             const Eigen::VectorXcd& normal_velocity) const {
  MatrixXd velocities(normal_velocity.size(), 2), bodies, supply;
  velocities << normal_velocity.real(), normal_velocity.imag();
  part_.solve(velocities, bodies, supply);
  const Complex i(0.0, 1.0);
  const MatrixXcd surface =
      solve(frequency, supply.col(0).cast<Complex>() + i * supply.col(1).cast<Complex>());
  const Eigen::VectorXcd potential = bodies.col(0).cast<Complex>() +
                                     i * bodies.col(1).cast<Complex>() +
                                     part_.body_from_surface().cast<Complex>() * surface;
  const MatrixXd weighted = model_.body_areas().asDiagonal() * part_.normal_velocities();
  return i * (frequency * model_.water().density * part_.image_count()) *
         (weighted.transpose() * potential);
}

}  // namespace blocklift::dynamics
