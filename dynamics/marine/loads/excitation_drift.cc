#include "dynamics/marine/loads/excitation_drift.h"

#include <cmath>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/whole_turn.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

void require_motions(const HydrodynamicDatabase& database, const std::vector<MatrixXcd>& motions) {
  bool fits = motions.size() == database.frequencies.size();
  for (const MatrixXcd& motion : motions) {
    fits = fits && motion.rows() == database.mode_count() &&
           motion.cols() == static_cast<Eigen::Index>(database.headings.size());
  }
  if (!fits) {
    throw ModelError("the motions for the drift of the excitation are not those of the database");
  }
}

/// Phase of R against the database's origin in waves of a number (rad/m), for each heading.
Eigen::RowVectorXcd phases_at_reference(const HydrodynamicDatabase& database, int body,
                                        double wave_number) {
  const Vector3& p = database.reference_points[body];
  Eigen::RowVectorXcd phases(static_cast<Eigen::Index>(database.headings.size()));
  for (Eigen::Index j = 0; j < phases.size(); ++j) {
    const double heading = database.headings[j];
    phases[j] =
        std::polar(1.0, wave_number * (std::cos(heading) * p.x() + std::sin(heading) * p.y()));
  }
  return phases;
}

/// dX/dheading of the j-th of headings that go round (headings_of_whole_turn).
Eigen::Vector2cd slope_at(const std::vector<double>& headings, const MatrixXcd& X, Eigen::Index j) {
  const auto count = static_cast<Eigen::Index>(headings.size()) - 1;
  const Eigen::Index before = j > 0 ? j - 1 : count - 1, after = (j + 1) % count;
  const double gap_before = headings[before + 1] - headings[before];
  const double gap_after = headings[j + 1] - headings[j];
  return 0.5 * ((X.col(after) - X.col(j)) / gap_after + (X.col(j) - X.col(before)) / gap_before);
}

/// Of one body in one frequency (index): surge and sway, for each of headings that go round.
Eigen::Matrix2Xd drift_of_body(const HydrodynamicDatabase& database, int body,
                               const std::vector<MatrixXcd>& motions, std::size_t k,
                               const std::vector<double>& headings) {
  const Eigen::Index first = modes_per_body * Eigen::Index{body};
  const double wave_number = calc_wave_number(database.frequencies[k], database.water);
  const Eigen::RowVectorXcd phases = phases_at_reference(database, body, wave_number);
  const MatrixXcd X = database.excitation(k).middleRows<2>(first) * phases.asDiagonal();
  const MatrixXcd xi = motions[k].middleRows<modes_per_body>(first) * phases.asDiagonal();
  Eigen::Matrix2Xd drift(2, static_cast<Eigen::Index>(headings.size()) - 1);
  for (Eigen::Index j = 0; j < drift.cols(); ++j) {
    const std::complex<double> way =
        wave_number * (std::cos(headings[j]) * xi(surge, j) + std::sin(headings[j]) * xi(sway, j));
    const Eigen::Vector2cd turned =
        Eigen::Vector2cd(-X(sway, j), X(surge, j)) - slope_at(headings, X, j);
    drift.col(j) =
        0.5 * (X.col(j) * std::conj(way)).imag() + 0.5 * (turned * std::conj(xi(yaw, j))).real();
  }
  return drift;
}

}  // namespace

std::vector<MatrixXd> calc_excitation_drift(const HydrodynamicDatabase& database,
                                            const std::vector<MatrixXcd>& motions) {
  require_motions(database, motions);
  const std::vector<double> headings =
      headings_of_whole_turn("the drift of the excitation", database.headings);
  const auto count = static_cast<Eigen::Index>(headings.size()) - 1;
  const auto columns = static_cast<Eigen::Index>(database.headings.size());
  std::vector<MatrixXd> drift;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    MatrixXd& D = drift.emplace_back(MatrixXd::Zero(database.mode_count(), columns));
    for (int body = 0; body < database.body_count(); ++body) {
      D.block(modes_per_body * Eigen::Index{body}, 0, 2, count) =
          drift_of_body(database, body, motions, k, headings);
    }
    // 0 and 360 degrees may both be there.
    D.rightCols(columns - count) = D.leftCols(columns - count).eval();
  }
  return drift;
}

}  // namespace blocklift::dynamics
