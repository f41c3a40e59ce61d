#pragma once

#include <memory>

#include "dynamics/force/force_element.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "dynamics/marine/waves/sea.h"
#include "dynamics/multibody/added_inertia.h"

namespace blocklift::dynamics {

/// Slow drift of a floating body in the waves: surge, sway and yaw from its mean drift forces D
/// (HydrodynamicDatabase::mean_drift) by Newman's (1974) approximation, in which two waves drift a
/// body together as the root of the product of what each does alone,
///
///   F = |sum_c+ a_c sqrt(D_c) exp(i phi_c)|^2 - |sum_c- a_c sqrt(-D_c) exp(i phi_c)|^2,
///   phi_c = w_c t - phase_c - k_c.p_WR,   D_c = D(w_c, theta_c - psi),
///
/// for each of the three, the sums over the waves of positive and of negative D. Written with the
/// analytic signal it has no sum frequencies (Standing, Brendling and Wilson 1987). A single wave
/// gives its mean force. The forces act at R along level axes that turn with the yaw psi of the
/// frame H (RadiatedWater); D is linear between the database's frequencies and headings. The square
/// of the waves' ramp acts on it.
class SlowDrift {
 public:
  struct Definition {
    std::string name;
    BodyFrame frame;
    std::shared_ptr<const HydrodynamicDatabase> database;
    int database_body = 0;  ///< which of the database's bodies it is
    std::shared_ptr<const Sea> sea;
  };

  /// @throws ModelError if something is missing, the database has no mean drift, a wave is outside
  ///   its frequencies, or its headings do not go round a whole turn at most 45 degrees apart.
  explicit SlowDrift(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Force on the body about R in W.
  ForceVector calc_force(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  /// How the waves differ where the vessel goes is left out, as in DiffractionForce.
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  /// All power is supplied by the waves.
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  /// One wave: what it does by heading, times the square of its amplitude.
  struct Wave {
    double frequency, phase, heading;  ///< rad/s, rad, rad
    Eigen::Vector2d wave_vector;       ///< rad/m
    Eigen::Matrix3Xd drift;            ///< surge, sway, yaw; the first heading repeated
  };

  Definition definition_;
  std::vector<double> headings_;  ///< ascending, the first repeated after a turn
  std::vector<Wave> waves_;
};

static_assert(ForceElement<SlowDrift>);

}  // namespace blocklift::dynamics
