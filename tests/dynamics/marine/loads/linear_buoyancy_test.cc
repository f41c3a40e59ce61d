// Buoyancy by its stiffness at rest: against the exact one of a hull at small motions, with its
// order; energy at motions of any size; what a turn about the vertical leaves as it is.
#include "dynamics/marine/loads/linear_buoyancy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/loads/hull_force.h"
#include "dynamics/marine/radiation/response_amplitude.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;
using test::OneBody;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

const Water sea_water = {.density = 1025, .gravity = 9.81};
constexpr double weight_of_water = 1025 * 9.81;

// A box that lies off its body's origin, and so has all of the stiffness's entries.
std::shared_ptr<const HullClusters> lopsided_box() {
  const Hull box = make_box({12, 6, 3}, {6, 3, 2, 1});
  return std::make_shared<const HullClusters>(
      transform({rotation_about(Vector3::UnitZ(), 0.3), {1.5, -0.8, 0.4}}, box));
}

Pose at_rest() { return {rotation_about(Vector3::UnitZ(), 0.7), {3, 4, -0.6}}; }

/// Of the hull as it lies at rest, about a point of the body.
LinearBuoyancy::Definition buoyancy_of(const HullClusters& hull, const Vector3& p_BoR_B) {
  const Pose X_WB = at_rest();
  const Hydrostatics rest = calc_hydrostatics(hull, X_WB);
  // Moved from Bo to R: as of a body whose centre of mass is there and has no weight's moment.
  const Vector3 p_BoR_W = X_WB.R * p_BoR_B;
  const Matrix6 C = weight_of_water * calc_floating_stiffness_over_rho_g(rest, p_BoR_W);
  LinearBuoyancy::Definition d;
  d.name = "b";
  d.frame = {1, {X_WB.R.transpose(), p_BoR_B}};
  d.rest_height = X_WB.apply(p_BoR_B).z();
  d.buoyancy = weight_of_water * rest.volume;
  d.centre = (rest.p_BoC_W() - p_BoR_W).head<2>();
  d.stiffness = C.block<3, 3>(2, 2);
  return d;
}

Eigen::Matrix<double, 6, 1> force_of(OneBody& body, const auto& element) {
  body.loads.set_zero();
  element.add_forces(body.state(), body.loads);
  Eigen::Matrix<double, 6, 1> F;
  F << body.loads.F_Bo_W[1].moment, body.loads.F_Bo_W[1].force;
  return F;
}

/// The body at rest, moved by (turn; displacement of Bo) in W.
void move(OneBody& body, const Eigen::Matrix<double, 6, 1>& by) {
  const Matrix3 turn = rotation_from_quaternion(quaternion_exponential(by.head<3>()));
  body.q << at_rest().p + by.tail<3>(), quaternion_from_rotation(turn * at_rest().R);
  body.update();
}

TEST(LinearBuoyancy, IsThatOfTheHullAtSmallMotions) {
  const auto hull = lopsided_box();
  const HullForce exact(
      {"hull", 1, hull, std::make_shared<const Sea>(Sea{WaveField(sea_water), {}})});
  OneBody body;
  Random random(21);
  for (const Vector3& point : {Vector3(0, 0, 0), Vector3(2, -1, 0.7)}) {
    const LinearBuoyancy linear(buoyancy_of(*hull, point));
    move(body, Eigen::Matrix<double, 6, 1>::Zero());
    const double size = force_of(body, exact).norm();
    EXPECT_LT((force_of(body, linear) - force_of(body, exact)).norm(), 1e-9 * size);
    const Eigen::Matrix<double, 6, 1> motion = random.values(6, 1);
    std::array<double, 2> error{};
    for (const int half : {0, 1}) {
      // So small that what is left of third order is a twentieth of the second.
      move(body, (half == 0 ? 5e-4 : 2.5e-4) * motion);
      error.at(half) = (force_of(body, linear) - force_of(body, exact)).norm();
    }
    EXPECT_LT(error[0], 1e-5 * size);
    EXPECT_NEAR(error[0] / error[1], 4.0, 0.2);
  }
}

TEST(LinearBuoyancy, BalancesAtMotionsOfAnySize) {
  const LinearBuoyancy linear(buoyancy_of(*lopsided_box(), {2, -1, 0.7}));
  OneBody body;
  Random random(22);
  for (int i = 0; i < 20; ++i) {
    body.q = examples::random_configuration(random, body.mechanism);
    body.v = random.values(6, 1);
    body.update();
    test::expect_balanced(body, linear);
  }
}

// A vessel that drifts and turns about the vertical has the same force, turned with it.
TEST(LinearBuoyancy, KnowsNoPlaceAndNoHeading) {
  const LinearBuoyancy linear(buoyancy_of(*lopsided_box(), {2, -1, 0.7}));
  OneBody body;
  Eigen::Matrix<double, 6, 1> tilted;
  tilted << 0.2, -0.1, 0, 0, 0, 0.3;
  move(body, tilted);
  const Eigen::Matrix<double, 6, 1> F = force_of(body, linear);
  const Pose X_WB = body.kinematics.X_WB[1];
  const Matrix3 turn = rotation_about(Vector3::UnitZ(), 2.0);
  body.q << X_WB.p + Vector3(50, -70, 0), quaternion_from_rotation(turn * X_WB.R);
  body.update();
  const Eigen::Matrix<double, 6, 1> turned = force_of(body, linear);
  EXPECT_LT((turned.head<3>() - turn * F.head<3>()).norm(), 1e-9 * F.norm());
  EXPECT_LT((turned.tail<3>() - F.tail<3>()).norm(), 1e-9 * F.norm());
  EXPECT_EQ(F[3], 0.0);
  EXPECT_EQ(F[4], 0.0);
}

// A box 12 x 6 m, 1.5 m deep: GM = KB + BM - KG about any point of its axis.
TEST(LinearBuoyancy, WeightTakesStiffnessAwayAboveThePoint) {
  const double weight = 5e6;
  const Matrix3 K = calc_stiffness_of_weight(weight, {0.3, -0.2, 2.0});
  EXPECT_DOUBLE_EQ(K(1, 1), -1e7);
  EXPECT_DOUBLE_EQ(K(2, 2), -1e7);
  EXPECT_EQ(K(0, 0), 0.0);
  const HullClusters box(make_box({12, 6, 3}, {6, 3, 2, 1}));
  const Hydrostatics rest = calc_hydrostatics(box, Pose::translation({0, 0, 0}));
  const double floating = weight_of_water * rest.volume, KG = 0.4;
  const Matrix6 about_keel = weight_of_water * calc_stiffness_over_rho_g(rest);
  const Matrix6 about_centre =
      weight_of_water * calc_floating_stiffness_over_rho_g(rest, Vector3(0, 0, KG));
  const Matrix3 of_weight = calc_stiffness_of_weight(floating, {0, 0, KG});
  EXPECT_NEAR(about_keel(0, 0) + of_weight(1, 1), about_centre(3, 3), 1e-6 * about_centre(3, 3));
  EXPECT_NEAR(about_keel(1, 1) + of_weight(2, 2), about_centre(4, 4), 1e-6 * about_centre(4, 4));
}

TEST(LinearBuoyancy, RefusesWhatCannotBe) {
  const LinearBuoyancy::Definition sound = buoyancy_of(*lopsided_box(), {0, 0, 0});
  EXPECT_NO_THROW(LinearBuoyancy{sound});
  const auto refused = [&](const auto& change, const char* why) {
    LinearBuoyancy::Definition d = sound;
    change(d);
    EXPECT_THAT([&] { LinearBuoyancy{d}; }, ThrowsMessage<ModelError>(HasSubstr(why)));
  };
  refused([](auto& d) { d.frame.body = world_index; }, "bears no body that moves");
  refused([](auto& d) { d.rest_height = not_a_number; }, "not finite");
  refused([](auto& d) { d.stiffness(1, 2) = not_a_number; }, "not finite");
  refused([](auto& d) { d.buoyancy = -1.0; }, "is negative");
  refused([](auto& d) { d.stiffness(0, 1) += 0.1 * d.stiffness(0, 0); }, "not symmetric");
}

}  // namespace
}  // namespace blocklift::dynamics
