#include "dynamics/marine/radiation/frequency_domain.h"

namespace blocklift::dynamics {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

FrequencyDomain::FrequencyDomain(const PanelModel& model, const RankinePart& part,
                                 const SurfaceDamping& damping)
    : model_(model), part_(part), damping_(damping) {}

MatrixXcd FrequencyDomain::solve(double frequency, const MatrixXcd& supply) const {
  const double g = model_.water().gravity;
  MatrixXcd matrix = g * part_.surface_operator().cast<Complex>();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Complex rate(damping_.rates[i], frequency);
    matrix(i, i) += rate * rate;
  }
  if (damping_.rings.rows() > 0) {
    const RingDifferences losses = damping_.rings.transpose() * damping_.rings;
    for (Eigen::Index i = 0; i < losses.rows(); ++i) {
      for (RingDifferences::InnerIterator loss(losses, i); loss; ++loss) {
        matrix(i, loss.col()) += Complex(0.0, frequency * loss.value());
      }
    }
  }
  MatrixXcd potentials = -g * supply;
  solve_in_place(matrix, potentials, "the matrix of the oscillating surface");
  return potentials;
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

MatrixXcd FrequencyDomain::calc_body_potentials(double frequency,
                                                const MatrixXcd& normal_velocities) const {
  const Eigen::Index count = normal_velocities.cols();
  MatrixXd velocities(normal_velocities.rows(), 2 * count), bodies, supply;
  velocities << normal_velocities.real(), normal_velocities.imag();
  part_.solve(velocities, bodies, supply);
  const Complex i(0.0, 1.0);
  const MatrixXcd surface = solve(frequency, supply.leftCols(count).cast<Complex>() +
                                                 i * supply.rightCols(count).cast<Complex>());
  MatrixXcd potentials(bodies.rows(), count);
  potentials.real() = bodies.leftCols(count) + part_.body_from_surface() * surface.real();
  potentials.imag() = bodies.rightCols(count) + part_.body_from_surface() * surface.imag();
  return potentials;
}

Eigen::VectorXcd FrequencyDomain::calc_force(double frequency,
                                             const Eigen::VectorXcd& normal_velocity) const {
  const Complex i(0.0, 1.0);
  const MatrixXd weighted = model_.body_areas().asDiagonal() * part_.normal_velocities();
  return i * (frequency * model_.water().density * part_.image_count()) *
         (weighted.transpose() * calc_body_potentials(frequency, normal_velocity));
}

}  // namespace blocklift::dynamics
