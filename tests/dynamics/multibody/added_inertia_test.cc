// Inertia that ties bodies together, on the left-hand side: against the same inertia as a body's
// own, against a dense solution, and by the energy that it keeps.
#include "dynamics/multibody/added_inertia.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/constrained_dynamics.h"
#include "dynamics/multibody/energy.h"
#include "dynamics/multibody/forward_dynamics.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/allocation_counter.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// 6 x 6 inertia about R in the axes of H of a rigid body (mass, centre of mass from R, inertia
/// about it).
Eigen::MatrixXd rigid(double mass, const Vector3& c, const Matrix3& I) {
  Eigen::MatrixXd A(6, 6);
  A << I - mass * skew(c) * skew(c), mass * skew(c), -mass * skew(c), mass * Matrix3::Identity();
  return A;
}

/// Positive 6N x 6N with couplings between all bodies.
Eigen::MatrixXd coupled(Random& random, Eigen::Index bodies, double size) {
  const Eigen::Index n = 6 * bodies;
  Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random.uniform(-1, 1); });
  return size *
         (B * B.transpose() / static_cast<double>(n) + 0.2 * Eigen::MatrixXd::Identity(n, n));
}

struct State {
  State(Random& random, const Mechanism& m)
      : q(examples::random_configuration(random, m)),
        v(random.values(m.nv(), 1)),
        tau(random.values(m.nv(), 5)),
        vdot(random.values(m.nv(), 1)),
        forces(examples::random_forces(random, m)),
        kinematics(m) {
    compute_kinematics(m, q, v, kinematics);
  }
  Eigen::VectorXd q, v, tau, vdot;
  std::vector<ForceVector> forces;
  Kinematics kinematics;
};

// A rigid body's inertia added to a weightless frame of a body is that body made heavier:
// Kirchhoff's equations hold all terms of the velocity.
TEST(AddedInertia, OfARigidBodyIsItsOwn) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Pose X_BH = random.pose(1);
    const Matrix3 Q = random.rotation();
    const Vector3 c = random.vector(0.4), J(0.6, 0.8, 1.1);
    const Matrix3 I = Q * J.asDiagonal() * Q.transpose();
    constexpr double mass = 4;
    MechanismBuilder light, heavy;
    for (auto* builder : {&light, &heavy}) {
      Random same(seed + 100);
      builder->set_gravity(Vector3::Zero());
      builder->add_body(examples::random_body(same, JointKind::free, "barge", "world"));
      BodyDefinition boom = examples::random_body(same, JointKind::revolute, "boom", "barge");
      boom.driven = {seed % 2 == 0};
      builder->add_body(boom);
      builder->add_body(examples::random_body(same, JointKind::spherical, "jib", "boom"));
    }
    BodyDefinition water;
    water.name = "water";
    water.parent = "jib";
    water.joint.kind = JointKind::fixed;
    water.X_PJ = X_BH;
    water.mass = mass;
    water.p_BoBcm_B = c;
    water.I_BBcm_B = I;
    heavy.add_body(water);
    const Mechanism a = light.build(), b = heavy.build();
    State at(random, a);
    const AddedInertia added({{3, X_BH}}, rigid(mass, c, I));
    ConstrainedDynamicsWorkspace w(a, &added);
    Eigen::VectorXd tau = at.tau, vdot = at.vdot;
    compute_constrained_dynamics(a, at.kinematics, at.q, at.v, at.forces, nullptr, w, tau, vdot,
                                 &added);
    Kinematics kinematics(b);
    compute_kinematics(b, at.q, at.v, kinematics);
    ForwardDynamicsWorkspace reference(b);
    at.forces.push_back(ForceVector::zero());
    compute_forward_dynamics(b, kinematics, at.v, at.forces, reference, at.tau, at.vdot);
    EXPECT_LT((vdot - at.vdot).norm(), 1e-10 * (1 + at.vdot.norm()));
    EXPECT_LT((tau - at.tau).norm(), 1e-10 * (1 + at.tau.norm()));
  }
}

// Trees with three bodies tied together, inertia up to a thousand times the masses: the sparse
// factorisation of the chain against a dense one.
TEST(AddedInertia, TiesBodiesAsADenseSolutionDoes) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Mechanism m = examples::random_tree(random, 9, seed % 2 == 0);
    State at(random, m);
    const AddedInertia added({{7, random.pose(1)}, {4, random.pose(1)}, {9, random.pose(1)}},
                             coupled(random, 3, std::pow(10.0, seed % 4)));
    ConstrainedDynamicsWorkspace w(m, &added);
    Eigen::VectorXd tau = at.tau, vdot = at.vdot;
    compute_constrained_dynamics(m, at.kinematics, at.q, at.v, at.forces, nullptr, w, tau, vdot,
                                 &added);
    // M vdot + h = tau, with h at zero acceleration of the free velocities.
    Eigen::VectorXd zero = at.vdot, h(m.nv());
    for (const int k : m.free_velocities()) zero[k] = 0;
    InverseDynamicsWorkspace inverse(m);
    compute_inverse_dynamics(m, at.kinematics, at.v, zero, at.forces, inverse, h);
    Eigen::MatrixXd M(m.nv(), m.nv());
    MassMatrixWorkspace composite(m);
    compute_mass_matrix(m, at.kinematics, composite, M);
    AddedInertiaWorkspace water(m, added);
    water.add_mass(m, at.kinematics, added, M);
    water.add_force(at.kinematics, added, inverse.A_WB, h);
    const std::vector<int>& free = m.free_velocities();
    const Eigen::MatrixXd M_free = M(free, free);
    const Eigen::VectorXd right = (at.tau - h)(free);
    const Eigen::VectorXd dense = M_free.ldlt().solve(right);
    const Eigen::VectorXd sparse = vdot(free);
    EXPECT_LT((dense - sparse).norm(), 1e-9 * (1 + dense.norm())) << "seed " << seed;
    // The Jacobian belongs to the velocities.
    Eigen::VectorXd u(added.size());
    added.calc_velocity(at.kinematics, u);
    EXPECT_LT((u - water.jacobian * at.v).norm(), 1e-12 * (1 + u.norm()));
  }
}

// Two bodies afloat far from anything, tumbling: energy of bodies and water is kept. Fourth order
// of the step, so that a step twice as long tells the error.
TEST(AddedInertia, KeepsEnergy) {
  Random random(5);
  MechanismBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body(examples::random_body(random, JointKind::free, "a", "world"));
  builder.add_body(examples::random_body(random, JointKind::free, "b", "world"));
  const Mechanism m = builder.build();
  const AddedInertia added({{1, random.pose(1)}, {2, random.pose(1)}}, coupled(random, 2, 8));
  ConstrainedDynamicsWorkspace w(m, &added);
  Kinematics kinematics(m);
  const std::vector<ForceVector> none = examples::no_forces(m);
  const Eigen::VectorXd q_start = examples::random_configuration(random, m);
  const Eigen::VectorXd v_start = random.values(m.nv(), 1);
  Eigen::VectorXd u(added.size());
  const auto energy = [&](const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    compute_kinematics(m, q, v, kinematics);
    added.calc_velocity(kinematics, u);
    return calc_kinetic_energy(m, kinematics) + added.calc_energy(u);
  };
  const auto acceleration = [&](const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    compute_kinematics(m, q, v, kinematics);
    Eigen::VectorXd tau = Eigen::VectorXd::Zero(m.nv()), vdot(m.nv());
    compute_constrained_dynamics(m, kinematics, q, v, none, nullptr, w, tau, vdot, &added);
    return vdot;
  };
  const auto drift = [&](double step) {
    Eigen::VectorXd q = q_start, v = v_start, next(q.size());
    const double start = energy(q, v);
    for (int i = 0; i * step < 1.0; ++i) {  // explicit midpoint on the manifold: order 2
      Eigen::VectorXd middle(q.size());
      m.integrate(q, v, 0.5 * step, middle);
      const Eigen::VectorXd v_middle = v + 0.5 * step * acceleration(q, v);
      m.integrate(q, v_middle, step, next);
      v += step * acceleration(middle, v_middle);
      q = next;
    }
    return std::abs(energy(q, v) - start) / start;
  };
  const double coarse = drift(0.01), fine = drift(0.0025);
  EXPECT_LT(fine, 1e-4);
  EXPECT_LT(fine, coarse / 10);  // 16 for order 2
}

TEST(AddedInertia, AllocatesNothing) {
  if (!blocklift::test::counts_allocations()) GTEST_SKIP() << "not counted in this build";
  Random random(3);
  const Mechanism m = examples::random_tree(random, 9, false);
  State at(random, m);
  const AddedInertia added({{4, random.pose(1)}, {9, random.pose(1)}}, coupled(random, 2, 1));
  ConstrainedDynamicsWorkspace w(m, &added);
  const long before = blocklift::test::allocations();
  compute_constrained_dynamics(m, at.kinematics, at.q, at.v, at.forces, nullptr, w, at.tau, at.vdot,
                               &added);
  EXPECT_EQ(blocklift::test::allocations(), before);
}

TEST(AddedInertia, RefusesWhatIsNoInertia) {
  const std::vector<BodyFrame> frame = {{1, Pose::identity()}};
  const auto made = [&](const Eigen::MatrixXd& A) { return [=] { AddedInertia(frame, A); }; };
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(6, 6);
  EXPECT_THAT(made(Eigen::MatrixXd::Identity(5, 5)),
              ThrowsMessage<ModelError>(HasSubstr("6 rows")));
  A(0, 1) = 0.1;
  EXPECT_THAT(made(A), ThrowsMessage<ModelError>(HasSubstr("symmetric")));
  A(0, 1) = A(1, 0) = 2;
  EXPECT_THAT(made(A), ThrowsMessage<ModelError>(HasSubstr("not positive")));
  A(2, 2) = not_a_number;
  EXPECT_THAT(made(A), ThrowsMessage<ModelError>(HasSubstr("finite")));
}

}  // namespace
}  // namespace blocklift::dynamics
