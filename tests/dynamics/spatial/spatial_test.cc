// Spatial algebra against elementary vector mechanics and 6x6 matrices written out.
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "dynamics/spatial/spatial_inertia.h"
#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;

RigidBodyInertia random_inertia(Random& random) {
  const BodyDefinition body = examples::random_body(random, JointKind::free, "b", "world");
  return {body.mass, body.p_BoBcm_B, Symmetric3::of(body.I_BBcm_B)};
}

MotionVector random_motion(Random& random) { return {random.vector(3), random.vector(3)}; }

TEST(Pose, UnsetValuesAreNotNumbers) {
  EXPECT_TRUE(Pose{}.R.array().isNaN().all());
  EXPECT_TRUE(Pose{}.p.array().isNaN().all());
  EXPECT_TRUE(MotionVector{}.angular.array().isNaN().all());
  EXPECT_TRUE(ForceVector{}.force.array().isNaN().all());
  EXPECT_TRUE(std::isnan(RigidBodyInertia{}.mass));
}

TEST(Pose, InverseUndoesAndCompositionChains) {
  Random random(1);
  const Pose X_AB = random.pose(5);
  const Pose X_BC = random.pose(5);
  const Vector3 p = random.vector(5);
  EXPECT_LT((X_AB.inverse().apply(X_AB.apply(p)) - p).norm(), 1e-14);
  EXPECT_LT(((X_AB * X_BC).apply(p) - X_AB.apply(X_BC.apply(p))).norm(), 1e-14);
}

TEST(Rotation, FollowsTheRightHand) {
  EXPECT_LT(
      (rotation_about(Vector3::UnitZ(), M_PI / 2) * Vector3::UnitX() - Vector3::UnitY()).norm(),
      1e-15);
}

// Property: quaternion and matrix describe one rotation, at any length of the quaternion.
TEST(Quaternion, RoundTripsThroughTheMatrix) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Random random(seed);
    const Matrix3 R = random.rotation();
    const Vector4 quaternion = quaternion_from_rotation(R);
    RC_ASSERT(std::abs(quaternion.norm() - 1) < 1e-15);
    RC_ASSERT((rotation_from_quaternion(random.uniform(0.1, 10) * quaternion) - R).norm() < 1e-14);
  }));
}

TEST(Quaternion, ProductIsCompositionOfRotations) {
  Random random(3);
  const Matrix3 A = random.rotation();
  const Matrix3 B = random.rotation();
  const Vector4 product =
      quaternion_product(quaternion_from_rotation(A), quaternion_from_rotation(B));
  EXPECT_LT((rotation_from_quaternion(product) - A * B).norm(), 1e-14);
}

// Property: exponential and rotation vector are inverse for angles below pi, tiny ones included.
TEST(Quaternion, ExponentialAndRotationVectorAreInverse) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Random random(seed);
    const double size = std::pow(10.0, random.uniform(-12, 0.45));
    const Vector3 theta = size * random.direction();
    const Vector4 quaternion = quaternion_exponential(theta);
    RC_ASSERT((rotation_vector(quaternion) - theta).norm() < 1e-13 * size + 1e-25);
    RC_ASSERT((rotation_vector(-quaternion) - theta).norm() < 1e-13 * size + 1e-25);
  }));
}

TEST(Quaternion, RateIsTheDerivativeOfTurning) {
  Random random(4);
  const Vector4 quaternion = quaternion_from_rotation(random.rotation());
  const Vector3 w = random.vector(2);
  const double h = 1e-5;
  const Vector4 difference = (quaternion_product(quaternion, quaternion_exponential(h * w)) -
                              quaternion_product(quaternion, quaternion_exponential(-h * w))) /
                             (2 * h);
  EXPECT_LT((quaternion_rate(quaternion, w) - difference).norm(), 1e-9);
}

TEST(SpatialVector, PowerDoesNotDependOnFrameOrPoint) {
  Random random(5);
  const MotionVector V = random_motion(random);
  const ForceVector F = random.force();
  const Pose X = random.pose(4);
  EXPECT_NEAR(dot(transform(X, F), transform(X, V)), dot(F, V), 1e-12);
  const Vector3 p_PQ = random.vector(4);
  EXPECT_NEAR(dot(F, shift(V, p_PQ)), dot(shift_to(F, p_PQ), V), 1e-12);
}

TEST(SpatialVector, CrossProductsAreDual) {
  Random random(6);
  const MotionVector V = random_motion(random);
  const MotionVector S = random_motion(random);
  const ForceVector F = random.force();
  EXPECT_NEAR(dot(cross_dual(V, F), S), -dot(F, cross(V, S)), 1e-12);
}

TEST(SpatialInertia, OfARigidBodyGivesItsMomentumAndEnergy) {
  Random random(7);
  const RigidBodyInertia body = random_inertia(random);
  const MotionVector V = random_motion(random);
  const Vector3 v_cm = V.linear + V.angular.cross(body.p_BoBcm);
  const ForceVector momentum = SpatialInertia::of(body) * V;
  EXPECT_LT((momentum.force - body.mass * v_cm).norm(), 1e-13);
  EXPECT_LT((momentum.moment - body.I_BBcm * V.angular - body.p_BoBcm.cross(momentum.force)).norm(),
            1e-13);
  EXPECT_LT(((body * V).moment - momentum.moment).norm(), 1e-13);
  const double energy =
      0.5 * body.mass * v_cm.squaredNorm() + 0.5 * V.angular.dot(body.I_BBcm * V.angular);
  EXPECT_NEAR(body.kinetic_energy(V), energy, 1e-13 * energy);
}

// add_shifted is X^T I X with X = [1 0; -[r]x 1], for any symmetric 6x6 matrix.
TEST(SpatialInertia, ShiftsLikeTheSixBySixMatrix) {
  Random random(8);
  const Eigen::Matrix<double, 6, 6> any =
      Eigen::Matrix<double, 6, 6>::NullaryExpr([&] { return random.uniform(-1, 1); });
  const Eigen::Matrix<double, 6, 6> symmetric = any + any.transpose();
  const SpatialInertia inertia{Symmetric3::of(symmetric.topLeftCorner<3, 3>()),
                               symmetric.topRightCorner<3, 3>(),
                               Symmetric3::of(symmetric.bottomRightCorner<3, 3>())};
  EXPECT_EQ(inertia.matrix(), symmetric);
  const Vector3 r = random.vector(3);
  Eigen::Matrix<double, 6, 6> X = Eigen::Matrix<double, 6, 6>::Identity();
  X.bottomLeftCorner<3, 3>() = -skew(r);
  SpatialInertia sum = inertia;
  add_shifted(inertia, r, sum);
  EXPECT_LT((sum.matrix() - symmetric - X.transpose() * symmetric * X).norm(), 1e-13);
  const Matrix3 R = random.rotation();
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R;
  EXPECT_LT((rotate(R, inertia).matrix() - turn * symmetric * turn.transpose()).norm(), 1e-13);
}

TEST(RigidBodyInertia, OfTwoBodiesIsTheSumOfTheirSpatialInertias) {
  Random random(9);
  const RigidBodyInertia a = random_inertia(random);
  const RigidBodyInertia b = random_inertia(random);
  const Eigen::Matrix<double, 6, 6> sum =
      SpatialInertia::of(a).matrix() + SpatialInertia::of(b).matrix();
  EXPECT_LT((SpatialInertia::of(a + b).matrix() - sum).norm(), 1e-13);
  const RigidBodyInertia none = a + RigidBodyInertia::zero();
  EXPECT_LT((SpatialInertia::of(none).matrix() - SpatialInertia::of(a).matrix()).norm(), 1e-14);
}

TEST(RigidBodyInertia, KeepsItsEnergyInAnotherFrame) {
  Random random(10);
  const RigidBodyInertia body = random_inertia(random);
  const MotionVector V = random_motion(random);
  const Pose X = random.pose(3);
  EXPECT_NEAR(transform(X, body).kinetic_energy(transform(X, V)), body.kinetic_energy(V), 1e-12);
}

}  // namespace
}  // namespace blocklift::dynamics
