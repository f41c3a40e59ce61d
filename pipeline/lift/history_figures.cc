#include "pipeline/lift/history_figures.h"

#include <cmath>

namespace blocklift::pipeline {

Eigen::VectorXd swing_angles(const dynamics::RopeHistory& rope) {
  // The force on the body at the first point runs along the first segment, downwards.
  Eigen::VectorXd angles(rope.first_force.rows());
  for (Eigen::Index i = 0; i < angles.size(); ++i) {
    const Eigen::Vector3d f = rope.first_force.row(i);
    angles(i) = std::atan2(f.head<2>().norm(), -f.z());
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
