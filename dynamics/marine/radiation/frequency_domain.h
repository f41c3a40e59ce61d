#pragma once

#include <complex>

#include "dynamics/marine/radiation/free_surface.h"

namespace blocklift::dynamics {

/// Flow of one part in steady oscillation, with the very matrices that are marched in time:
///
///   (g M + (i w + nu)^2 + i w R^T R) phi_F = -g q v,
///   phi_B = Phi v + P phi_F,    F_m = i w rho sum n_m W phi_B.
///
/// A dense complex system for each frequency: the instrument that tells the errors of the
/// discretisation, of the damping zone and of the time step from each other, and solves diffraction
/// without Haskind's relation.
class FrequencyDomain {
 public:
  FrequencyDomain(const PanelModel& model, const RankinePart& part, const SurfaceDamping& damping);

  /// Added mass and damping of the part's modes (modes() square; kg, kg/s and with lengths).
  void calc_radiation(double frequency, Eigen::MatrixXd& added_mass,
                      Eigen::MatrixXd& damping) const;

  /// Force on the part's modes (N, N m) while the normal velocity on the bodies is Re(v e^{iwt}):
  /// the diffraction force for v = -n.u of an incident wave. The part must have kept its factors.
  Eigen::VectorXcd calc_force(double frequency, const Eigen::VectorXcd& normal_velocity) const;

  /// Potential on the bodies (m2/s) while their normal velocities are Re(v e^{iwt}), a column each.
  /// The part must have kept its factors.
  Eigen::MatrixXcd calc_body_potentials(double frequency,
                                        const Eigen::MatrixXcd& normal_velocities) const;

 private:
  /// phi_F of a supply W^1/2 q v.
  Eigen::MatrixXcd solve(double frequency, const Eigen::MatrixXcd& supply) const;

  const PanelModel& model_;
  const RankinePart& part_;
  SurfaceDamping damping_;
};

}  // namespace blocklift::dynamics
