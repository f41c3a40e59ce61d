#include "dynamics/marine/radiation/reference_points.h"

#include <algorithm>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

/// Is nothing known of heave, roll and pitch?
bool is_of_surge_sway_yaw(const std::vector<Eigen::MatrixXd>& drift, Eigen::Index first) {
  return std::all_of(drift.begin(), drift.end(), [&](const Eigen::MatrixXd& D) {
    return D.middleRows(first + 2, 3).isZero(0.0);
  });
}

void shift_drift(std::vector<Eigen::MatrixXd>& drift, Eigen::Index first, const Vector3& arm) {
  const bool level = is_of_surge_sway_yaw(drift, first);
  const Matrix3 cross = skew(arm);
  for (Eigen::MatrixXd& D : drift) {
    const Eigen::MatrixXd moment = cross * D.middleRows<3>(first);
    if (level) {
      D.row(first + 5) += moment.row(2);
    } else {
      D.middleRows<3>(first + 3) += moment;
    }
  }
}

}  // namespace

HydrodynamicDatabase about_points(HydrodynamicDatabase database,
                                  const std::vector<Vector3>& points) {
  if (points.size() != database.reference_points.size())
    throw ModelError("a database needs a reference point for each of its bodies");
  if (points == database.reference_points) return database;
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(database.mode_count(), database.mode_count());
  for (std::size_t b = 0; b < points.size(); ++b) {
    const Eigen::Index first = modes_per_body * static_cast<Eigen::Index>(b);
    const Vector3 arm = database.reference_points[b] - points[b];
    T.block<3, 3>(first, first + 3) = -skew(arm);
    shift_drift(database.mean_drift, first, arm);
  }
  const auto shift = [&](Eigen::MatrixXd& M) {
    if (M.size() > 0) M = Eigen::MatrixXd(T.transpose() * M * T);
  };
  for (auto* matrices : {&database.added_mass, &database.damping, &database.retardation})
    std::for_each(matrices->begin(), matrices->end(), shift);
  shift(database.infinite_added_mass);
  shift(database.hydrostatic_stiffness);
  for (auto* forces : {&database.froude_krylov, &database.diffraction}) {
    for (Eigen::MatrixXcd& X : *forces) X = Eigen::MatrixXcd(T.transpose() * X);
  }
  database.reference_points = points;
  database.change_from_coarser = {};
  database.excitation_change_from_coarser = {};
  database.cut_off_by_end = {};
  database.far_field = {};
  return database;
}

}  // namespace blocklift::dynamics
