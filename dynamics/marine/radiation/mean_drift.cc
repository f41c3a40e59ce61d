#include "dynamics/marine/radiation/mean_drift.h"

#include <cmath>
#include <numbers>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

void require_far_field(const HydrodynamicDatabase& database,
                       const std::vector<MatrixXcd>& motions) {
  if (database.far_field.empty()) {
    throw ModelError("mean drift needs the far field of the waves, which the database lacks");
  }
  if (database.body_count() != 1) {
    throw ModelError("the far field tells the mean drift of " +
                     std::to_string(database.body_count()) +
                     " bodies together only, and not that of each");
  }
  const auto columns = static_cast<Eigen::Index>(database.headings.size());
  bool fits = motions.empty() || motions.size() == database.frequencies.size();
  for (const MatrixXcd& motion : motions) {
    fits = fits && motion.rows() == modes_per_body && motion.cols() == columns;
  }
  if (!fits) throw ModelError("the motions for the mean drift are not those of the database");
}

/// Waves of one frequency, and how they go.
struct Going {
  double wave_number, frequency, phase_velocity, group_velocity;
  double pressure;  ///< rho g/2, N/m3

  Going(const Water& water, double w)
      : wave_number(calc_wave_number(w, water)),
        frequency(w),
        phase_velocity(w / wave_number),
        group_velocity(calc_group_velocity(w, water)),
        pressure(0.5 * water.density * water.gravity) {}

  /// How the waves far away along the heading meet the incident ones: the real part does.
  Complex meet(Complex at_heading) const {
    return 2.0 * std::sqrt(2.0 * std::numbers::pi / wave_number) * at_heading *
           std::polar(1.0, -0.25 * std::numbers::pi);
  }
};

/// All that is sent out at a frequency in waves of a heading (indices).
Eigen::VectorXcd sent_out(const HydrodynamicDatabase& database,
                          const std::vector<MatrixXcd>& motions, std::size_t k, Eigen::Index h) {
  Eigen::VectorXcd waves = database.far_field.scattered[k].col(h);
  if (!motions.empty()) waves += database.far_field.radiated[k] * motions[k].col(h);
  return waves;
}

/// P, W/m2.
double power_of_damping(const Going& going, const std::vector<MatrixXcd>& motions,
                        const MatrixXd& damping, std::size_t k, Eigen::Index h) {
  if (motions.empty() || damping.size() == 0) return 0.0;
  const Eigen::VectorXcd velocity = going.frequency * motions[k].col(h);
  return 0.5 * velocity.dot(damping * velocity).real();
}

Complex energy_factor(const Going& going, const Eigen::VectorXcd& sent, double heading,
                      double power) {
  const DirectionalWaves waves(sent);
  return calc_energy_factor(
      waves.integrate().whole + power / (going.pressure * going.group_velocity),
      -going.meet(waves.at(heading)));
}

}  // namespace

Complex calc_energy_factor(double gone, Complex shadow) {
  if (!(gone > 0.0) || shadow == 0.0) return 1.0;
  const Complex middle = std::conj(shadow) / (2.0 * gone);
  const Complex away = 1.0 - middle;
  if (away == 0.0) return 1.0;
  return middle + std::abs(middle) / std::abs(away) * away;
}

std::vector<MatrixXd> calc_mean_drift(const HydrodynamicDatabase& database,
                                      const std::vector<MatrixXcd>& motions,
                                      const MatrixXd& damping, bool has_lids) {
  require_far_field(database, motions);
  const Vector3& p = database.reference_points[0];
  std::vector<MatrixXd> drift;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const Going going(database.water, database.frequencies[k]);
    const double momentum = going.pressure * going.group_velocity / going.phase_velocity;
    drift.emplace_back(MatrixXd::Zero(modes_per_body, database.headings.size()));
    for (Eigen::Index h = 0; h < drift.back().cols(); ++h) {
      const double heading = database.headings[h];
      Eigen::VectorXcd H = sent_out(database, motions, k, h);
      double power = power_of_damping(going, motions, damping, k, h);
      if (!has_lids) {
        const Complex factor = energy_factor(going, H, heading, power);
        H *= factor;
        power *= std::norm(factor);
      }
      const DirectionalWaves waves(H);
      const DirectionalWaves::Moments sent = waves.integrate();
      const double lost = power / going.phase_velocity;
      const double taken = momentum * sent.whole + lost;
      const double along_x = std::cos(heading) * taken - momentum * sent.along_x;
      const double along_y = std::sin(heading) * taken - momentum * sent.along_y;
      const double turning =
          -going.pressure * going.group_velocity / going.frequency *
          (waves.integrate_turning() + going.meet(Complex(0.0, 1.0) * waves.slope(heading)).real());
      drift.back()(surge, h) = along_x;
      drift.back()(sway, h) = along_y;
      drift.back()(yaw, h) = turning - (p.x() * along_y - p.y() * along_x);
    }
  }
  return drift;
}

std::vector<Eigen::VectorXd> calc_absorbed_power(const HydrodynamicDatabase& database,
                                                 const std::vector<MatrixXcd>& motions) {
  require_far_field(database, motions);
  std::vector<Eigen::VectorXd> power;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const Going going(database.water, database.frequencies[k]);
    Eigen::VectorXd& lost = power.emplace_back(database.headings.size());
    for (Eigen::Index h = 0; h < lost.size(); ++h) {
      const DirectionalWaves waves(sent_out(database, motions, k, h));
      lost[h] = -going.pressure * going.group_velocity *
                (waves.integrate().whole + going.meet(waves.at(database.headings[h])).real());
    }
  }
  return power;
}

}  // namespace blocklift::dynamics
