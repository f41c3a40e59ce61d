#include "pipeline/standards/rigging_balance.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double weight = 1e6;           // N
constexpr double axial_stiffness = 4e8;  // EA, N

/// A load of four equal slings on one hook that hangs on a tackle.
struct FourSlings {
  std::vector<RiggingRope> ropes;
  double length = 0, tension = 0;

  FourSlings() {
    const Vector3d hook(0, 0, 9);
    for (const auto& [x, y] : {std::pair(4.0, 3.0), {-4.0, 3.0}, {-4.0, -3.0}, {4.0, -3.0}}) {
      RiggingRope rope;
      rope.lower = {RiggingEnd::Kind::load, -1, {x, y, 1.5}};
      rope.upper = {RiggingEnd::Kind::hook, 0, Vector3d::Zero()};
      const Vector3d along = hook - rope.lower.r_W;
      rope.length = length = along.norm();
      rope.direction_W = along.normalized();
      rope.tension = tension = weight / 4 / rope.direction_W.z();
      rope.compliance = rope.length / axial_stiffness;
      ropes.push_back(rope);
    }
    RiggingRope tackle;
    tackle.lower = {RiggingEnd::Kind::hook, 0, Vector3d::Zero()};
    tackle.tension = weight;
    tackle.length = 30;
    tackle.compliance = 1e-8;
    ropes.push_back(tackle);
  }
};

VectorXd alternating(double size) {
  VectorXd errors(5);
  errors << size, -size, size, -size, 0;
  return errors;
}

// Closed form: the slings' own elongation takes up the whole error, dT = EA d / L.
TEST(RiggingBalance, SharesAnewOnARigidLoadByTheClosedForm) {
  const FourSlings slings;
  const RiggingBalance balance(slings.ropes, 1);
  const double error = 1e-3, change = axial_stiffness * error / slings.length;
  const VectorXd tension = balance.with_length_errors(alternating(error));
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(tension[i], slings.tension + (i % 2 == 0 ? -change : change), 1e-7 * change) << i;
  EXPECT_NEAR(tension[4], weight, 1e-7 * weight);
  VectorXd tolerance = VectorXd::Constant(5, error);
  tolerance[4] = 0;
  const VectorXd largest = balance.largest_by_tolerance(tolerance);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(largest[i], slings.tension + change, 1e-4 * change);
}

// Closed form: a load that gives way by c along each sling is in series with it.
TEST(RiggingBalance, SharesLessOnAFlexibleLoad) {
  const FourSlings slings;
  const double give = 3 * slings.length / axial_stiffness;  // m/N
  MatrixXd compliance = MatrixXd::Zero(5, 5);
  compliance.diagonal().head<4>().setConstant(give);
  const RiggingBalance balance(slings.ropes, 1, compliance);
  const double error = 1e-3, change = error / (4 * slings.length / axial_stiffness);
  const VectorXd tension = balance.with_length_errors(alternating(error));
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(tension[i], slings.tension + (i % 2 == 0 ? -change : change), 1e-7 * change) << i;
}

// A load turns freely about the plumb line of its one hook; rounding makes that a stiffness of no
// meaning, however the load lies and whichever way its moment turns.
TEST(RiggingBalance, DoesNotTurnAboutThePlumbLine) {
  const FourSlings straight;
  const Vector3d moment(0.03 * weight, -0.02 * weight, 0);
  const VectorXd expected = RiggingBalance(straight.ropes, 1).with_moment(moment);
  for (int step = 1; step < 40; ++step) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.137 * step, Vector3d::UnitZ()).toRotationMatrix();
    FourSlings turned;
    for (RiggingRope& rope : turned.ropes) {
      rope.lower.r_W = turn * rope.lower.r_W * (1 + 1e-10 * step);
      rope.direction_W = turn * rope.direction_W;
    }
    const VectorXd tension = RiggingBalance(turned.ropes, 1).with_moment(turn * moment);
    EXPECT_LT((tension - expected).cwiseAbs().maxCoeff(), 1e-6 * weight) << step;
  }
}

// Errors that leave one diagonal slack (EA d / L is more than the load at rest): the other one
// bears all, twice the load at rest but for the angle, which the error and the stretch of 8 and 14
// mm over 9 m of sling change by at most 2.5e-3.
TEST(RiggingBalance, HangsOnADiagonalWhereTheOtherIsSlack) {
  const FourSlings slings;
  const VectorXd tension = RiggingBalance(slings.ropes, 1).with_length_errors(alternating(8e-3));
  EXPECT_EQ(tension[0], 0);
  EXPECT_EQ(tension[2], 0);
  EXPECT_NEAR(tension[1] / slings.tension, 2, 2.5e-3);
  EXPECT_NEAR(tension[3] / slings.tension, 2, 2.5e-3);
}

// A beam on two plumb ropes: dT = M / L by statics; a moment about +y presses the end at +x down.
TEST(RiggingBalance, BearsAMomentByStatics) {
  std::vector<RiggingRope> ropes(2);
  for (const int i : {0, 1}) {
    ropes[static_cast<std::size_t>(i)].lower = {
        RiggingEnd::Kind::load, -1, {i == 0 ? -5.0 : 5.0, 0, 0}};
    ropes[static_cast<std::size_t>(i)].tension = weight / 2;
    ropes[static_cast<std::size_t>(i)].length = 20;
    ropes[static_cast<std::size_t>(i)].compliance = 1e-7;
  }
  const VectorXd tension = RiggingBalance(ropes, 0).with_moment({0, 1e5, 0});
  EXPECT_NEAR(tension[0], weight / 2 - 1e4, 1e-6);
  EXPECT_NEAR(tension[1], weight / 2 + 1e4, 1e-6);
}

TEST(RiggingBalance, RefusesMoreSetsThanItCanTry) {
  const std::vector<RiggingRope> ropes(13);
  EXPECT_THROW(RiggingBalance(ropes, 0).largest_by_tolerance(VectorXd::Constant(13, 0.01)),
               std::invalid_argument);
}

}  // namespace
}  // namespace blocklift::pipeline
