// A free body that spins 100 000 times: quaternions stay on the unit sphere, and the phase is off
// by what the tolerance allows. Reference: the torque-free top with an axis of symmetry turns about
// its constant angular momentum L at the rate |L| / A and about its own axis at (1 - C / A) w_z
// (Landau and Lifshitz, Mechanics, section 33).
#include <gtest/gtest.h>

#include "dynamics/simulation/time_integration.h"

namespace blocklift::dynamics {
namespace {

constexpr double A = 2.0, C = 3.0;  // kg m2, across and about the axis of symmetry
const Vector3 w_start(0.6, 0.0,
                      2.0 * M_PI);  // rad/s, in the body: one turn a second about its axis

LiftSystem top(double turns) {
  MechanismBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body({.name = "top",
                    .joint = {.kind = JointKind::free},
                    .mass = 1,
                    .I_BBcm_B = Vector3(A, A, C).asDiagonal()});
  Eigen::VectorXd v = Eigen::VectorXd::Zero(6);
  v.head<3>() = w_start;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(7);
  q[3] = 1;
  return LiftSystem({.mechanism = builder.build(),
                     .operation = OperationBuilder().build(turns),
                     .q_start = q,
                     .v_start = v});
}

Vector4 exact(double t) {
  const Vector3 momentum(A * w_start.x(), 0, C * w_start.z());
  return quaternion_product(quaternion_exponential(momentum / A * t),
                            quaternion_exponential(Vector3(0, 0, (1 - C / A) * w_start.z() * t)));
}

struct Spin {
  double phase_error;   // rad
  double length_error;  // of the quaternion
  double energy_error;  // relative
};

Spin spin(double turns, double tolerance) {
  const LiftSystem lift = top(turns);
  const IntegrationResult run =
      integrate(lift, lift.q_start(), lift.v_start(),
                {.relative_tolerance = tolerance, .sample_interval = turns, .works = false});
  Vector4 back = exact(turns);
  back.tail<3>() *= -1.0;
  const Vector4 quaternion = run.q_end.segment<4>(3);
  const Vector3 inertia(A, A, C);
  const double energy = run.v_end.head<3>().cwiseAbs2().dot(inertia);
  const double start = w_start.cwiseAbs2().dot(inertia);
  return {rotation_vector(quaternion_product(back, quaternion)).norm(),
          std::abs(quaternion.norm() - 1.0), std::abs(energy / start - 1.0)};
}

// Local errors of the tolerance add up from step to step: the phase error is in proportion to the
// tolerance, but for the changes of order and step that the integrator makes, and grows with the
// number of turns; twice as fast where the rate of precession itself drifts.
TEST(SpinningBody, PhaseErrorFollowsTheTolerance) {
  const Spin loose = spin(300, 1e-6);
  const Spin tight = spin(300, 1e-9);
  RecordProperty("phase_error_1e-6", std::to_string(loose.phase_error));
  std::cout << "phase errors after 300 turns: " << loose.phase_error << " rad at 1e-6, "
            << tight.phase_error << " rad at 1e-9\n";
  EXPECT_LT(tight.phase_error, loose.phase_error / 100);
  EXPECT_LT(tight.phase_error, 1e-2);
}

TEST(SpinningBody, AHundredThousandTurns) {
  const double turns = 1e5;
  const Spin result = spin(turns, 1e-9);
  std::cout << "after " << turns << " turns: phase " << result.phase_error << " rad, length "
            << result.length_error << ", energy " << result.energy_error << "\n";
  EXPECT_LT(result.length_error, 1e-12);
  // The rate drifts with the energy, in proportion to the turns, and the phase with their square:
  // after so many it is off by whole turns, and the energy is the figure to hold. A local error of
  // 1e-9 that had one sign in each of some 60 steps a turn would come to 6e-3; most of it averages
  // out.
  EXPECT_LT(result.energy_error, 1e-3);
}

}  // namespace
}  // namespace blocklift::dynamics
