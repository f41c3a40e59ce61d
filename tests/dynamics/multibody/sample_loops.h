#pragma once

#include "pipeline/verification/models/random_mechanism.h"

/// Mechanisms with loops that several tests and benchmarks share.
namespace blocklift::dynamics::test {

/// Andrews' squeezer (Schiehlen 1990; Test Set for IVP Solvers, "andrews"): seven bodies in the
/// plane z = 0 without gravity, three loops through the point at which bodies 2, 3, 4 and 6 meet.
///
/// Bodies K1 .. K7 with their centres of mass as given; coordinates in the order of the tree: beta,
/// Theta, gamma, delta, Phi, epsilon, Omega.
struct AndrewsSqueezer {
  /// Loops of which kind: revolute (spatial, so that nine of fifteen equations repeat others) or
  /// point_on_line (along z: six equations).
  LoopKind kind = LoopKind::revolute;

  static constexpr double moment = 0.033;                ///< on K1, N m
  static constexpr double spring_stiffness = 4530.0;     ///< N/m
  static constexpr double spring_free_length = 0.07785;  ///< m
  static inline const Vector3 p_WC{0.014, 0.072, 0.0};   ///< spring's fixed end
  static inline const Vector3 p_K3D{0.02, -0.018, 0.0};  ///< spring's end on K3

  Mechanism build() const;
  /// The published configuration at t = 0, to be closed by assemble() to rounding.
  static Eigen::VectorXd q_start();
};

/// Bricard's linkage of the IFToMM library (A04): five rods of 1 m, 1 kg and square section 0.1 m,
/// six revolute joints of which the last closes the loop; gravity 9.81 m/s2 along -y. One of the
/// loop's five equations repeats the others; one degree of freedom is left.
Mechanism bricard_linkage();

/// Plane four-bar linkage with bars of `crank`, `coupler`, `rocker` (m, 1 kg each, uniform) over a
/// base of `base` m along x; z is the axis of all joints, gravity along -y. The loop "D" is at
/// (base, 0, 0) on the rocker's end. Zero coordinates: all bars along x. Bars have a square section
/// of the side `side` (m).
Mechanism four_bar(double crank, double coupler, double rocker, double base,
                   bool driven_crank = false, double side = 0.01);

/// Two branches of random bodies with a loop of the kind between them at random places.
Mechanism random_mechanism_with_loop(examples::Random& random, LoopKind kind);

}  // namespace blocklift::dynamics::test
