#pragma once

#include <complex>
#include <string>
#include <vector>

#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/jacobian.h"

namespace blocklift::dynamics {

/// How a mode goes on by itself once it has been started.
enum class ModeKind {
  oscillating,  ///< swings and dies down
  overdamped,   ///< creeps back without swinging
  neutral,      ///< stays where it is put: nothing brings it back (yaw of a load on one rope)
  unstable      ///< grows: the equilibrium would not last
};
/// "oscillating", ...
std::string_view mode_kind_name(ModeKind kind);

/// A body's part in a mode: complex amplitudes, whose moduli are sizes and whose arguments are
/// phases.
struct BodyModeMotion {
  BodyIndex body = -1;
  Eigen::Vector3cd rotation;             ///< rotation vector in W, rad
  Eigen::Vector3cd displacement;         ///< of the body's origin Bo in W, m
  Eigen::Vector3cd displacement_centre;  ///< of its centre of mass in W, m
  /// Of the mode's kinetic energy, that of the body's elastic modes included, 0 to 1.
  double energy_share = 0.0;
};

/// The part that the vibration of a body in one of its own elastic modes has in a mode.
struct ElasticModeMotion {
  int mode = -1;                   ///< index in the mechanism
  std::complex<double> amplitude;  ///< of the coordinate eta, m
  double energy_share = 0.0;       ///< of the mode's kinetic energy, 0 to 1
};

/// One natural mode of small vibration about an equilibrium:  e(t) = Re(shape exp(lambda t)).
struct Mode {
  ModeKind kind = ModeKind::neutral;
  std::complex<double> eigenvalue;  ///< lambda, 1/s; of a pair the one with positive imaginary part
  /// Tangent increments, nv; driven entries zero. Scaled so that the largest displacement of a
  /// centre of mass, or turn by the mechanism's radius of gyration of that body, or coordinate of
  /// an elastic mode, is 1 m, and is real there.
  Eigen::VectorXcd shape;
  std::vector<BodyModeMotion> bodies;            ///< one a moving body that has mass
  std::vector<ElasticModeMotion> elastic_modes;  ///< in the order of the mechanism
  /// Part of the restoring energy that is stored in ropes, springs, pads and bodies that give way,
  /// 0 to 1; the rest is
  /// weight and tension that have turned: a pendulum has 0, a bounce 1.
  double elastic_share = 0.0;
  /// Bodies and their motion, from `bodies`: "load: pendulum along x", "hook: bounce against load".
  std::string name;

  double natural_frequency() const { return std::abs(eigenvalue); }  ///< |lambda|, rad/s
  double period() const;         ///< 2 pi / |lambda|, s; infinite where neutral
  double damping_ratio() const;  ///< -Re(lambda) / |lambda|; below zero: grows. 0 where neutral
};

/// The motions about an equilibrium, linear:  M z'' + C z' + K z = 0,  e = basis z being the
/// increments of the free velocities' coordinates (all of them where no loop binds them).
struct Linearisation {
  double time = not_a_number;  ///< s
  Eigen::MatrixXd mass, damping, stiffness;
  Eigen::MatrixXd basis;    ///< nv_free x n
  std::vector<Mode> modes;  ///< slowest first; neutral and unstable ones before all others
};

/// Floating bodies swing with their infinite-frequency added mass; the memory of the water they
/// radiate, which lengthens slow periods and damps, is not in the modes.
///
/// Linearises at the rest that an EquilibriumSolver has left in its workspace at time t: drives and
/// winches held, one-sided elements acting as they do there. Loops leave the motions along them, an
/// orthonormal basis of the null space of their Jacobian; what their forces do by turning is in K.
///
/// Eigenvalues are those of the quadratic problem (lambda^2 M + lambda C + K) z = 0, as 2n x 2n
/// ordinary one in coordinates in which M = 1 and the largest frequency is about 1 (Tisseur and
/// Meerbergen 2001, SIAM Review 43, section 3.4). A mode counts as neutral below 1e-6 of the
/// largest |lambda|: a double eigenvalue zero comes out as the square root of the rounding. Within
/// a group of equal eigenvalues (a pendulum that swings alike to all sides) shapes are chosen along
/// the axes of W.
/// @throws SimulationError if the mass matrix is singular.
Linearisation linearise(const LiftSystem& system, double t, LiftWorkspace& w);

/// How far a hanging body is from tipping, m: the least moment about a level axis that a small tilt
/// meets, all other freedoms giving way, over its weight times the tilt. A body that hangs from one
/// pin has the height of the pin above its centre of mass; below zero the equilibrium tips over.
/// At the rest that an EquilibriumSolver has left in its workspace at time t.
///
///   G dz = tilt,  S = (G K^-1 G^T)^-1,  2 x 2; the lesser eigenvalue of S over m g
/// (static condensation: Guyan 1965). Directions that nothing holds get a stiffness of 1e-10 of the
/// largest.
/// @param tangent a workspace; overwritten.
/// @param body a child of the world on a free joint that no drive moves.
/// @param heading_is_held its turn about the plumb is no way to give way (HeldHeading): wind that
///   would turn it round is not what tips it over.
/// @throws ModelError if it is none, or has no weight.
double calc_righting_height(const LiftSystem& system, double t, LiftWorkspace& w, BodyIndex body,
                            TangentMatrices& tangent, bool heading_is_held = false);

/// Linearises where the lift hangs at rest at each of the ascending times (s), following the
/// equilibrium from a guess q_start (nq) at t = 0 in steps of at most `interval` (s).
/// @throws SimulationError where there is no equilibrium.
std::vector<Linearisation> linearise_sweep(const LiftSystem& system,
                                           const std::vector<double>& times,
                                           const Eigen::VectorXd& q_start, double interval,
                                           const EquilibriumSettings& settings = {});

}  // namespace blocklift::dynamics
