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

// Wind at the load leans all that hangs on one tackle by 2 mrad: tensions share as without it, but
// for that angle. What holds the load about its tackle is then 1e-8 of the ropes' stiffness, and the
// moment would turn it by radians.
TEST(RiggingBalance, SharesAsInCalmAirWhereWindLeansTheTackle) {
  const Eigen::Matrix3d lean = Eigen::AngleAxisd(2e-3, Vector3d(0.6, 0.8, 0)).toRotationMatrix();
  FourSlings calm, windy;
  calm.ropes.erase(calm.ropes.begin());  // three slings: by statics
  windy.ropes.erase(windy.ropes.begin());
  calm.ropes[1].tension *= 0.01;
  windy.ropes[1].tension *= 0.01;
  for (RiggingRope& rope : windy.ropes) {
    rope.direction_W = lean * rope.direction_W;
    rope.lower.r_W = lean * rope.lower.r_W;
  }
  const Vector3d moment(3e3, -5e3, 0);
  const VectorXd in_calm = RiggingBalance(calm.ropes, 1).with_moment(moment);
  const VectorXd in_wind = RiggingBalance(windy.ropes, 1).with_moment(moment);
  for (int i = 0; i < 3; ++i) {
    const double change = in_calm[i] - calm.ropes[i].tension;
    EXPECT_NEAR(in_wind[i] - windy.ropes[i].tension, change, 0.02 * std::abs(change) + 1) << i;
  }
}

// A beam on two plumb ropes: dT = M / L by statics; a moment about +y presses the end at +x down.
TEST(RiggingBalance, BearsAMomentByStatics) {
  std::vector<RiggingRope> ropes(2);
  for (const int i : {0, 1}) {
    ropes[i].lower = {RiggingEnd::Kind::load, -1, {i == 0 ? -5.0 : 5.0, 0, 0}};
    ropes[i].tension = weight / 2;
    ropes[i].length = 20;
    ropes[i].compliance = 1e-7;
  }
  const VectorXd tension = RiggingBalance(ropes, 0).with_moment({0, 1e5, 0});
  EXPECT_NEAR(tension[0], weight / 2 - 1e4, 1e-6);
  EXPECT_NEAR(tension[1], weight / 2 + 1e4, 1e-6);
}

/// A plumb rope from an upper end to a lower one, of a compliance that no result may depend on.
RiggingRope plumb(const RiggingEnd& lower, const RiggingEnd& upper, double tension) {
  RiggingRope rope;
  rope.lower = lower;
  rope.upper = upper;
  rope.tension = tension;
  rope.length = 10;
  rope.compliance = 1e-9;
  return rope;
}

// A beam on two plumb ropes 8 m apart below a bar on two that are 5 m apart: by statics each pair
// bears the moment over its own distance, and the upper one the bar's weight, too.
TEST(RiggingBalance, BearsAMomentThroughABar) {
  const double bar = 2e5, moment = 1e5;
  std::vector<RiggingRope> ropes;
  for (const double side : {-1.0, 1.0}) {
    ropes.push_back(plumb({RiggingEnd::Kind::load, -1, {4 * side, 0, 0.7}},
                          {RiggingEnd::Kind::bar, 0, {4 * side, 0, 0}}, weight / 2));
    ropes.push_back(plumb({RiggingEnd::Kind::bar, 0, {2.5 * side, 0, 0}},
                          {RiggingEnd::Kind::fixed, -1, Vector3d::Zero()}, (weight + bar) / 2));
  }
  // The load's centre hangs 0.7 m below its lugs and takes W 0.7 m of the moment for each radian
  // that it turns: 1e-4 of what the ropes' stiffness does over their distances, 9e9 N m.
  const VectorXd tension = RiggingBalance(ropes, 0, {}, 1).with_moment({0, moment, 0});
  const double tolerance = 2e-4 * moment / 8;
  EXPECT_NEAR(tension[0], weight / 2 - moment / 8, tolerance);
  EXPECT_NEAR(tension[2], weight / 2 + moment / 8, tolerance);
  EXPECT_NEAR(tension[1], (weight + bar) / 2 - moment / 5, 2 * tolerance);
  EXPECT_NEAR(tension[3], (weight + bar) / 2 + moment / 5, 2 * tolerance);
}

// Four plumb slings below a frame: alternating errors make forces that are in balance on the load
// and on the frame, so that each sling's own elongation takes up its error, dT = EA d / L, and the
// slings above the frame feel nothing. Errors of those above share anew in the same way there.
TEST(RiggingBalance, SkewsFourSlingsBelowAFrameByThemselves) {
  const FourSlings above;
  const double length = 6, compliance = length / axial_stiffness;
  std::vector<RiggingRope> ropes;
  for (const RiggingRope& sling : above.ropes) {
    RiggingRope& rope = ropes.emplace_back(sling);
    if (rope.lower.kind == RiggingEnd::Kind::load) rope.lower.kind = RiggingEnd::Kind::bar;
    if (rope.lower.kind == RiggingEnd::Kind::bar) rope.lower.index = 0;
  }
  for (int i = 0; i < 4; ++i) {
    const Vector3d& r = above.ropes[i].lower.r_W;
    RiggingRope& rope =
        ropes.emplace_back(plumb({RiggingEnd::Kind::load, -1, {r.x(), r.y(), 1}},
                                 {RiggingEnd::Kind::bar, 0, {r.x(), r.y(), 0}}, weight / 4));
    rope.length = length;
    rope.compliance = compliance;
  }
  const RiggingBalance balance(ropes, 1, {}, 1);
  const double error = 1e-3;
  VectorXd below = VectorXd::Zero(9), over = VectorXd::Zero(9);
  below.tail<4>() = alternating(error).head<4>();
  over.head<4>() = alternating(error).head<4>();
  const VectorXd with_below = balance.with_length_errors(below);
  const VectorXd with_over = balance.with_length_errors(over);
  const double change = error / compliance, change_over = axial_stiffness * error / above.length;
  for (int i = 0; i < 4; ++i) {
    const double sign = i % 2 == 0 ? -1 : 1;
    EXPECT_NEAR(with_below[5 + i], weight / 4 + sign * change, 1e-6 * change) << i;
    EXPECT_NEAR(with_below[i], above.tension, 1e-6 * change) << i;
    EXPECT_NEAR(with_over[i], above.tension + sign * change_over, 1e-6 * change) << i;
    EXPECT_NEAR(with_over[5 + i], weight / 4, 1e-6 * change) << i;
  }
}

// Four plumb ropes at -3, -1, 1 and 3 m on a beam that gives way as F says; the second one is so long
// that it hangs slack. By statics its share goes half to the first and half to the third, and what
// is free is t (1, -3, 2) on the first, the third and the fourth: least work makes it
//   t = -n . (F p + e) / (n . F n),
// p with the slack rope's own -T, by which the beam springs back there.
TEST(RiggingBalance, ALoadSpringsBackWhereARopeIsSlack) {
  std::vector<RiggingRope> ropes;
  const VectorXd at = (VectorXd(4) << -3, -1, 1, 3).finished();
  const double share = 1e4, own = 1e-6;
  for (int i = 0; i < 4; ++i) {
    RiggingRope& rope =
        ropes.emplace_back(plumb({RiggingEnd::Kind::load, -1, {at[i], 0, 1e-6}},
                                 {RiggingEnd::Kind::fixed, -1, Vector3d::Zero()}, share));
    rope.compliance = own;
    rope.length = 1e6;  // so long that it turns nothing
  }
  MatrixXd compliance(4, 4);  // of the beam at the ropes, m/N
  compliance << 5, 2, 1, -1, 2, 4, 2, 1, 1, 2, 4, 2, -1, 1, 2, 5;
  compliance *= 1e-6;
  VectorXd errors = VectorXd::Zero(4);
  errors[1] = 1;
  errors[3] = 2e-3;
  const VectorXd tension = RiggingBalance(ropes, 0, compliance).with_length_errors(errors);
  const MatrixXd F = compliance + own * MatrixXd::Identity(4, 4);
  const VectorXd p = (VectorXd(4) << share / 2, -share, share / 2, 0).finished();
  const VectorXd n = (VectorXd(4) << 1, 0, -3, 2).finished();
  const VectorXd expected =
      VectorXd::Constant(4, share) + p - n.dot(F * p + errors) / n.dot(F * n) * n;
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(tension[i], expected[i], 1e-5 * share) << i;
  EXPECT_GT(expected.minCoeff(), -1e-9);
}

TEST(RiggingBalance, RefusesMoreSetsThanItCanTry) {
  const std::vector<RiggingRope> ropes(13);
  EXPECT_THROW(RiggingBalance(ropes, 0).largest_by_tolerance(VectorXd::Constant(13, 0.01)),
               std::invalid_argument);
}

}  // namespace
}  // namespace blocklift::pipeline
