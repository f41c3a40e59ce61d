// Nothing is allocated once the workspaces stand.
#include <gtest/gtest.h>

#include "dynamics/multibody/assembly.h"
#include "dynamics/multibody/constrained_dynamics.h"
#include "dynamics/multibody/derivatives.h"
#include "dynamics/multibody/energy.h"
#include "dynamics/multibody/forward_dynamics.h"
#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/multibody/loop_projection.h"
#include "dynamics/multibody/mass_matrix.h"
#include "dynamics/multibody/motion_profile.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/allocation_counter.h"
#include "tests/dynamics/multibody/sample_loops.h"

namespace blocklift::dynamics {
namespace {

using blocklift::test::allocations;
using blocklift::test::counts_allocations;

TEST(Allocation, NoneInTheRecursiveAlgorithms) {
  if (!counts_allocations()) GTEST_SKIP() << "allocations cannot be counted in this build";
  examples::Random random(31);
  const Mechanism mechanism = examples::random_tree(random, 18, true);
  const Eigen::VectorXd q = examples::random_configuration(random, mechanism);
  const Eigen::VectorXd v = random.values(mechanism.nv(), 1);
  const std::vector<ForceVector> forces = examples::random_forces(random, mechanism);
  Eigen::VectorXd tau = random.values(mechanism.nv(), 1);
  Eigen::VectorXd vdot = random.values(mechanism.nv(), 1);
  Eigen::VectorXd rates(mechanism.nq());
  Eigen::VectorXd moved(mechanism.nq());
  Eigen::VectorXd difference(mechanism.nv());
  Eigen::MatrixXd M(mechanism.nv(), mechanism.nv());
  Eigen::Matrix3Xd J(3, mechanism.nv());
  Kinematics kinematics(mechanism);
  ForwardDynamicsWorkspace forward(mechanism);
  InverseDynamicsWorkspace inverse(mechanism);
  MassMatrixWorkspace composite(mechanism);
  ForwardDynamicsDerivatives derivatives(mechanism);
  const MotionProfile profile = MotionProfile::cam(MotionProfile::sequence(0, {{0, 1, {1, 1, 1}}}),
                                                   NaturalSpline({0, 0.5, 1}, {0, 2, 1}));
  double sum = 0;

  // The counter counts.
  const long start = allocations();
  std::vector<double> probe(100, 1.0);
  ASSERT_GT(allocations(), start);

  const long before = allocations();
  compute_kinematics(mechanism, q, v, kinematics);
  compute_forward_dynamics(mechanism, kinematics, v, forces, forward, tau, vdot);
  compute_inverse_dynamics(mechanism, kinematics, v, vdot, forces, inverse, tau);
  compute_mass_matrix(mechanism, kinematics, composite, M);
  compute_forward_dynamics_derivatives(mechanism, kinematics, v, vdot, forces, derivatives);
  mechanism.calc_rates(q, v, rates);
  mechanism.integrate(q, v, 0.1, moved);
  mechanism.difference(q, moved, difference);
  mechanism.normalise(moved);
  point_jacobian(mechanism, kinematics, mechanism.body_count() - 1, Vector3::Ones(), J);
  // As an integrator calls it: states are parts of its own arrays.
  const Eigen::Map<const Eigen::VectorXd> q_map(q.data(), q.size());
  const Eigen::Map<const Eigen::VectorXd> v_map(v.data(), v.size());
  compute_kinematics(mechanism, q_map, v_map, kinematics);
  sum += calc_kinetic_energy(mechanism, kinematics) + calc_gravity_potential(mechanism, kinematics);
  sum += calc_momentum(mechanism, kinematics).force.x() + profile.evaluate(0.7).position;
  sum += calc_mass_properties(mechanism, kinematics).mass;
  EXPECT_EQ(allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(Allocation, NoneInTheDynamicsOfLoops) {
  if (!counts_allocations()) GTEST_SKIP() << "allocations cannot be counted in this build";
  const Mechanism andrews = test::AndrewsSqueezer{}.build();
  const Mechanism bricard = test::bricard_linkage();
  for (const Mechanism* m : {&andrews, &bricard}) {
    Eigen::VectorXd q = m == &andrews ? test::AndrewsSqueezer::q_start() : m->zero_configuration();
    Eigen::VectorXd v = Eigen::VectorXd::Ones(m->nv());
    Eigen::VectorXd tau = v;
    Eigen::VectorXd vdot = v;
    assemble(*m, q, v);
    Kinematics kinematics(*m);
    ConstrainedDynamicsWorkspace w(*m);
    LoopProjector projector(*m);
    std::vector<ForceVector> forces = examples::no_forces(*m);
    LoopRows rows = LoopRows::none(*m);
    const long before = allocations();
    for (int i = 0; i < 3; ++i) {
      compute_kinematics(*m, q, v, kinematics);
      compute_constrained_dynamics(*m, kinematics, q, v, forces, nullptr, w, tau, vdot);
      q += 1e-3 * v;
      ASSERT_TRUE(projector.project_positions(q));
      ASSERT_TRUE(projector.project_velocities(v));
      projector.remove_normal_part(vdot);
      rows = projector.independent_rows();
      compute_constrained_dynamics(*m, kinematics, q, v, forces, &rows, w, tau, vdot);
      add_loop_forces(*m, kinematics, w.loops, w.lambda, forces, tau);
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_TRUE(vdot.allFinite());
  }
}

}  // namespace
}  // namespace blocklift::dynamics
