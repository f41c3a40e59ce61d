#pragma once

#include <optional>

#include "algebra/factors.h"
#include "dynamics/simulation/jacobian.h"
#include "dynamics/simulation/loop_tangent.h"

namespace blocklift::dynamics {

/// Solves Newton's equations of an implicit integration,  (1 - gamma J) x = b,  J = d(dy/dt)/dy, in
/// the structure that mechanics gives them: with x = (x_q, x_v) and the tangent matrices M, C, K,
///   (1 - gamma A) x_q - gamma N x_v = b_q,      A = d(N v)/dq,
///   M x_v + gamma C x_v + gamma K E x_q = M b_v,
/// so that, with Y = E (1 - gamma A)^-1 joint by joint and Z = Y N (1 where v is dq/dt),
///   (M + gamma C + gamma^2 K Z) x_v = M b_v - gamma K Y b_q
/// is all that has to be factorised: nv_free unknowns instead of nq_free + nv_free, and M itself is
/// not inverted. Loops add their multipliers, mu = gamma dlambda, and what they demand of the
/// accelerations (see LoopTangent):
///   [ M + gamma C + gamma^2 K Z             -G^T ] [ x_v ]   [ M b_v - gamma K Y b_q    ]
///   [ G + gamma by_v + gamma^2 by_q Z        0   ] [ mu  ] = [ G b_v - gamma by_q Y b_q ].
/// The memory x of radiated water (RadiatedWater) is eliminated, too: with R = (1 - gamma A)^-1 and
/// the frames' Jacobian J,
///   x_x = R (b_x + gamma B J x_v),
/// so that gamma^2 J^T C R B J joins the matrix and -gamma J^T C R b_x the right-hand side.
/// Workspaces are made once.
class NewtonMatrix {
 public:
  explicit NewtonMatrix(const LiftSystem& system);

  /// Tangent matrices at the instant that calc_right_hand_side has just left in `w`.
  void set_point(const LiftSystem& system, double t, LiftWorkspace& w);
  /// Factorises for a gamma (s) at the point set last. False: singular or not finite.
  bool factorise(const LiftSystem& system, double gamma);
  /// x = (1 - gamma J)^-1 b; sizes state_size. `x` may be `b`.
  void solve(const LiftSystem& system, ConstVectorRef b, VectorRef x);

  const TangentMatrices& tangent() const { return tangent_; }

 private:
  // A free joint with a quaternion: where it lies among the free coordinates and velocities, and
  // its kinematics at the point set.
  struct Joint {
    int link = -1;
    Eigen::Index q = -1, v = -1;
    int nq = 0, nv = 0;
    Eigen::Matrix<double, 7, 7> rates_by_q, inverse;  // A, (1 - gamma A)^-1
    Eigen::Matrix<double, 7, 6> rates_by_v;           // N
    Eigen::Matrix<double, 6, 7> increments;           // E
    Eigen::Matrix<double, 6, 6> Z;
  };

  void eliminate_memory(const RadiatedWater& water, double gamma,
                        Eigen::Ref<Eigen::MatrixXd> motion);
  void multiply_by_Z(double factor, const Eigen::Ref<const Eigen::MatrixXd>& by_increments,
                     Eigen::Ref<Eigen::MatrixXd> result) const;

  TangentMatrices tangent_;
  std::optional<LoopTangent> loops_;
  std::vector<Joint> joints_;
  // Free coordinates whose rate is a velocity: their places among both.
  std::vector<Eigen::Index> plain_q_, plain_v_;
  Eigen::MatrixXd matrix_;
  algebra::LuFactors<double> factor_;
  Eigen::VectorXd right_, solution_, moved_, x_q_;
  // Of radiated water: R; C; R B; C R B and that times J; R b_x; forces and velocities of the
  // frames. Sections of the memory that have no share now have neither C nor B.
  RadiatedWater::Resolvent resolvent_;
  Eigen::MatrixXd output_, response_, impedance_, by_velocity_, memory_;
  Eigen::VectorXd frames_;
  double gamma_ = not_a_number;
};

}  // namespace blocklift::dynamics
