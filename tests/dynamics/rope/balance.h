#pragma once

#include <Eigen/Core>

#include "dynamics/simulation/history.h"

namespace blocklift::dynamics::test {

inline constexpr double standard_gravity = 9.80665;  // m/s^2

/// Largest of what the energies lack of the works from a sample on, J.
inline double imbalance_of(const EnergyHistory& e, Eigen::Index from = 0) {
  const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
  const Eigen::ArrayXd work = e.drive_work + e.winch_work + e.outside_work - e.dissipated;
  const Eigen::ArrayXd lacking = energy - work;
  return (lacking - lacking[from]).tail(lacking.size() - from).abs().maxCoeff();
}

}  // namespace blocklift::dynamics::test
