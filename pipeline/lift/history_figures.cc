#include "pipeline/lift/history_figures.h"

#include <cmath>

namespace blocklift::pipeline {

const dynamics::RopeHistory::Rows3& hook_pull(const dynamics::RopeHistory& tackle,
                                              bool hook_is_first) {
  return hook_is_first ? tackle.first_force : tackle.last_force;
}

Eigen::VectorXd swing_angles(const dynamics::RopeHistory::Rows3& hook_pull) {
  Eigen::VectorXd angles(hook_pull.rows());
  for (Eigen::Index i = 0; i < angles.size(); ++i) {
    const Eigen::Vector3d f = hook_pull.row(i);
    angles(i) = std::atan2(f.head<2>().norm(), f.z());
    // A slack rope has no direction of pull.
    if (f.squaredNorm() == 0) angles(i) = 0;
  }
  return angles;
}

Eigen::VectorXd energy_imbalance(const dynamics::EnergyHistory& energy) {
  if (energy.drive_work.size() == 0) return {};
  const Eigen::VectorXd stored = energy.kinetic + energy.gravity + energy.elastic;
  return stored.array() - stored(0) -
         (energy.drive_work + energy.winch_work + energy.outside_work - energy.dissipated).array();
}

}  // namespace blocklift::pipeline
