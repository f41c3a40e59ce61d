// Analytical derivatives of the dynamics against central differences on random trees with every
// kind of joint. Differences are of second order: halving the step divides the difference by four
// until rounding takes over, which the step study shows, so that the agreement is not one of
// chance.
#include "dynamics/multibody/derivatives.h"

#include <gtest/gtest.h>

#include "dynamics/multibody/forward_dynamics.h"
#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/multibody/mass_matrix.h"
#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;

struct RandomState {
  explicit RandomState(unsigned seed, bool with_drives = false)
      : random(seed),
        mechanism(examples::random_tree(random, 12, with_drives)),
        q(examples::random_configuration(random, mechanism)),
        v(random.values(mechanism.nv(), 2)),
        vdot(random.values(mechanism.nv(), 3)),
        tau(random.values(mechanism.nv(), 5)),
        forces(examples::random_forces(random, mechanism)),
        kinematics(mechanism) {
    compute_kinematics(mechanism, q, v, kinematics);
  }

  Eigen::VectorXd inverse(const Eigen::VectorXd& at_q, const Eigen::VectorXd& at_v) const {
    Kinematics moved(mechanism);
    compute_kinematics(mechanism, at_q, at_v, moved);
    InverseDynamicsWorkspace workspace(mechanism);
    Eigen::VectorXd result(mechanism.nv());
    compute_inverse_dynamics(mechanism, moved, at_v, vdot, forces, workspace, result);
    return result;
  }

  // What forward dynamics finds: vdot where free, tau where driven.
  Eigen::VectorXd forward(const Eigen::VectorXd& at_q, const Eigen::VectorXd& at_v) const {
    Kinematics moved(mechanism);
    compute_kinematics(mechanism, at_q, at_v, moved);
    ForwardDynamicsWorkspace workspace(mechanism);
    Eigen::VectorXd acceleration = vdot;
    Eigen::VectorXd force = tau;
    compute_forward_dynamics(mechanism, moved, at_v, forces, workspace, force, acceleration);
    for (const int k : mechanism.driven_velocities()) acceleration[k] = force[k];
    return acceleration;
  }

  // Central differences of `function` by tangent increments of q (or by v).
  template <class Function>
  Eigen::MatrixXd difference(const Function& function, bool by_q, double h) const {
    const Eigen::Index n = mechanism.nv();
    Eigen::MatrixXd result(n, n);
    Eigen::VectorXd q_shifted(mechanism.nq());
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::VectorXd e = Eigen::VectorXd::Unit(n, k);
      const auto at = [&](double s) {
        if (!by_q) return function(q, (v + s * e).eval());
        mechanism.integrate(q, e, s, q_shifted);
        return function(q_shifted, v);
      };
      result.col(k) = (at(h) - at(-h)) / (2 * h);
    }
    return result;
  }

  Random random;
  Mechanism mechanism;
  Eigen::VectorXd q, v, vdot, tau;
  std::vector<ForceVector> forces;
  Kinematics kinematics;
};

// Largest error relative to the largest entry.
double error(const Eigen::MatrixXd& a, const Eigen::MatrixXd& reference) {
  return (a - reference).lpNorm<Eigen::Infinity>() /
         std::max(1.0, reference.lpNorm<Eigen::Infinity>());
}

class Derivatives : public ::testing::TestWithParam<unsigned> {};

TEST_P(Derivatives, OfInverseDynamicsAreThoseOfDifferences) {
  RandomState s(GetParam());
  InverseDynamicsDerivatives d(s.mechanism);
  compute_inverse_dynamics_derivatives(s.mechanism, s.kinematics, s.v, s.vdot, s.forces, {}, d);
  const auto inverse = [&](const auto& q, const auto& v) { return s.inverse(q, v); };
  // Truncation h^2 = 1e-10 and rounding 1e-16 / h = 1e-11 relative to the terms that cancel.
  EXPECT_LT(error(d.dtau_dq, s.difference(inverse, true, 1e-5)), 2e-8);
  EXPECT_LT(error(d.dtau_dv, s.difference(inverse, false, 1e-5)), 2e-8);
}

TEST_P(Derivatives, DifferencesApproachThemInSecondOrder) {
  RandomState s(GetParam());
  InverseDynamicsDerivatives d(s.mechanism);
  compute_inverse_dynamics_derivatives(s.mechanism, s.kinematics, s.v, s.vdot, s.forces, {}, d);
  const auto inverse = [&](const auto& q, const auto& v) { return s.inverse(q, v); };
  const double coarse = error(d.dtau_dq, s.difference(inverse, true, 4e-2));
  const double middle = error(d.dtau_dq, s.difference(inverse, true, 2e-2));
  const double fine = error(d.dtau_dq, s.difference(inverse, true, 1e-2));
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.1);
  EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.05);
  // Inverse dynamics is quadratic in v: central differences are exact for any step.
  EXPECT_LT(error(d.dtau_dv, s.difference(inverse, false, 0.5)), 1e-12);
}

TEST_P(Derivatives, MassMatrixOfTheSamePass) {
  RandomState s(GetParam());
  InverseDynamicsDerivatives d(s.mechanism);
  compute_inverse_dynamics_derivatives(s.mechanism, s.kinematics, s.v, s.vdot, s.forces, {}, d);
  MassMatrixWorkspace workspace(s.mechanism);
  Eigen::MatrixXd M(s.mechanism.nv(), s.mechanism.nv());
  compute_mass_matrix(s.mechanism, s.kinematics, workspace, M);
  EXPECT_LT(error(d.mass, M), 1e-14);
}

// Held forces at points fixed in the bodies, whose moment about Bo turns with the arm.
TEST_P(Derivatives, ArmsOfPointForcesTurnWithTheBody) {
  RandomState s(GetParam());
  const std::size_t n = s.mechanism.bodies().size();
  std::vector<Vector3> points, pulls;
  std::vector<Matrix3> arms(n, Matrix3::Zero());
  for (std::size_t b = 0; b < n; ++b) {
    points.push_back(s.random.vector(1));
    pulls.push_back(s.random.vector(20));
  }
  const auto forces_at = [&](const Kinematics& kinematics) {
    std::vector<ForceVector> forces = examples::no_forces(s.mechanism);
    for (std::size_t b = 0; b < n; ++b) {
      add_point_force(kinematics, static_cast<int>(b), points[b], pulls[b], forces);
    }
    return forces;
  };
  const auto inverse = [&](const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    Kinematics moved(s.mechanism);
    compute_kinematics(s.mechanism, q, v, moved);
    InverseDynamicsWorkspace workspace(s.mechanism);
    Eigen::VectorXd result(s.mechanism.nv());
    compute_inverse_dynamics(s.mechanism, moved, v, s.vdot, forces_at(moved), workspace, result);
    return result;
  };
  for (std::size_t b = 0; b < n; ++b) {
    arms[b] = skew(pulls[b]) * skew(s.kinematics.X_WB[b].R * points[b]);
  }
  InverseDynamicsDerivatives d(s.mechanism);
  compute_inverse_dynamics_derivatives(s.mechanism, s.kinematics, s.v, s.vdot,
                                       forces_at(s.kinematics), arms, d);
  EXPECT_LT(error(d.dtau_dq, s.difference(inverse, true, 1e-5)), 2e-8);
}

TEST_P(Derivatives, OfForwardDynamicsAreThoseOfDifferences) {
  for (const bool with_drives : {false, true}) {
    RandomState s(GetParam(), with_drives);
    ForwardDynamicsWorkspace workspace(s.mechanism);
    Eigen::VectorXd vdot = s.vdot;
    Eigen::VectorXd tau = s.tau;
    compute_forward_dynamics(s.mechanism, s.kinematics, s.v, s.forces, workspace, tau, vdot);
    ForwardDynamicsDerivatives d(s.mechanism);
    compute_forward_dynamics_derivatives(s.mechanism, s.kinematics, s.v, vdot, s.forces, d);
    const auto forward = [&](const auto& q, const auto& v) { return s.forward(q, v); };
    EXPECT_LT(error(d.by_q, s.difference(forward, true, 1e-5)), 1e-7) << with_drives;
    EXPECT_LT(error(d.by_v, s.difference(forward, false, 1e-5)), 1e-7) << with_drives;
  }
}

// Unevenly long quaternions: what counts is the turn that a change of the four numbers amounts to.
TEST_P(Derivatives, CoordinateIncrementsAreThoseOfTheDifference) {
  RandomState s(GetParam());
  for (const Link& link : s.mechanism.links()) {
    const auto offset = quaternion_offset(link.kind);
    if (offset) s.q.segment<4>(link.q_offset + *offset) *= s.random.uniform(0.5, 2);
  }
  Eigen::MatrixXd E(s.mechanism.nv(), s.mechanism.nq());
  coordinate_increments(s.mechanism, s.q, E);
  const double h = 1e-6;
  Eigen::VectorXd plus(s.mechanism.nv()), minus(s.mechanism.nv());
  for (Eigen::Index k = 0; k < s.mechanism.nq(); ++k) {
    const Eigen::VectorXd dq = h * Eigen::VectorXd::Unit(s.mechanism.nq(), k);
    s.mechanism.difference(s.q, s.q + dq, plus);
    s.mechanism.difference(s.q, s.q - dq, minus);
    EXPECT_LT(((plus - minus) / (2 * h) - E.col(k)).lpNorm<Eigen::Infinity>(), 1e-8) << k;
  }
  // Rates are coordinates' changes: E N = 1.
  Eigen::VectorXd rates(s.mechanism.nq());
  s.mechanism.calc_rates(s.q, s.v, rates);
  EXPECT_LT((E * rates - s.v).norm(), 1e-12);
}

TEST_P(Derivatives, IncrementJacobianIsThatOfTheDifference) {
  RandomState s(GetParam());
  const Eigen::VectorXd u = s.random.values(s.mechanism.nv(), 1.2);
  Eigen::MatrixXd D(s.mechanism.nv(), s.mechanism.nv());
  increment_jacobian(s.mechanism, u, D);
  const double h = 1e-5;
  Eigen::VectorXd moved(s.mechanism.nq()), further(s.mechanism.nq());
  Eigen::VectorXd plus(s.mechanism.nv()), minus(s.mechanism.nv());
  s.mechanism.integrate(s.q, u, 1, moved);
  for (Eigen::Index k = 0; k < s.mechanism.nv(); ++k) {
    const Eigen::VectorXd du = h * Eigen::VectorXd::Unit(s.mechanism.nv(), k);
    s.mechanism.integrate(s.q, u + du, 1, further);
    s.mechanism.difference(moved, further, plus);
    s.mechanism.integrate(s.q, u - du, 1, further);
    s.mechanism.difference(moved, further, minus);
    EXPECT_LT(((plus - minus) / (2 * h) - D.col(k)).lpNorm<Eigen::Infinity>(), 1e-8) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Derivatives, ::testing::Range(1u, 9u));

}  // namespace
}  // namespace blocklift::dynamics
