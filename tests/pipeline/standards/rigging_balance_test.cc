#include "pipeline/standards/rigging_balance.h"

#include <array>
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

// A load of 32 t on four slings below a bar of 400 kg, on two slings and one tackle, in wind of
// 339 and 587 N: its equilibrium by a solution in Python (scipy), as are the changes of tension
// where its centre lies 50 mm nearer to one end. What holds the load about its tackle is 1e-10 of
// the ropes' stiffness here; left to itself the moment would turn the load by radians, and the
// changes be 2.5 % larger.
TEST(RiggingBalance, SharesAsInCalmAirWhereWindLeansTheTackle) {
  struct Row {
    Vector3d lower, upper, direction;
    double tension, length, compliance;
  };
  const std::vector<Row> rows{
      {{-2.99729877469, -0.000748634329629, 0.174927112838},
       {0, 0, 0},
       {0.514735435959, -0.00151059802923, 0.857347741037},
       177219.719083,
       6.01112937521,
       6.27998694e-08},
      {{3.00169464124, 0.000303311289115, 0.0650322129754},
       {0, 0, 0},
       {-0.483183690345, -0.00168538157622, 0.875517378967},
       189493.753061,
       6.01190018294,
       6.27998694e-08},
      {{-3.10672987554, -1.94347940609, 0.731106885828},
       {-3.00169464124, -0.000303311289115, -0.0650322129754},
       {-0.000853898247529, 0.482919062934, 0.875664575915},
       89891.9245159,
       4.00711530558,
       7.9154002e-08},
      {{-3.10604095595, 2.05582080944, 0.805922067865},
       {-3.00169464124, -0.000303311289115, -0.0650322129754},
       {-0.00102592526808, -0.515182328571, 0.85707999382},
       84812.1483936,
       4.00671322097,
       7.9154002e-08},
      {{2.89225278934, -1.94244602669, 0.620626486673},
       {2.99729877469, 0.000748634329629, -0.174927112838},
       {-0.000851104455988, 0.482860834966, 0.875696688173},
       96482.452521,
       4.00763697224,
       7.9154002e-08},
      {{2.89294170893, 2.05685418884, 0.695441668711},
       {2.99729877469, 0.000748634329629, -0.174927112838},
       {-0.0010231163105, -0.515114408926, 0.857120819342},
       91031.1176954,
       4.00720547727,
       7.9154002e-08},
      {{0, 0, 0},
       {0, 0, 0},
       {-0.00102853266124, -0.00178109010844, 0.999997884917},
       329616.697001,
       20,
       2e-08},
  };
  std::vector<RiggingRope> ropes;
  for (const Row& row : rows) {
    RiggingRope& rope = ropes.emplace_back();
    const bool is_tackle = ropes.size() == 7, is_above = ropes.size() < 3;
    rope.lower = {RiggingEnd::Kind::load, -1, row.lower};
    if (is_above) rope.lower = {RiggingEnd::Kind::bar, 0, row.lower};
    if (is_tackle) rope.lower = {RiggingEnd::Kind::hook, 0, row.lower};
    rope.upper = {RiggingEnd::Kind::bar, 0, row.upper};
    if (is_above) rope.upper = {RiggingEnd::Kind::hook, 0, row.upper};
    if (is_tackle) rope.upper = {RiggingEnd::Kind::fixed, -1, row.upper};
    rope.direction_W = row.direction;
    rope.tension = row.tension;
    rope.length = row.length;
    rope.compliance = row.compliance;
  }
  const std::array<double, 6> change{2584.6, -2528.1, 1373.3, 1295.7, -1373.0, -1295.7};
  const auto expect_change = [&](const RiggingBalance& balance) {
    const VectorXd tension = balance.with_moment({2.703320504, -15693.33865, 0});
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(tension[i] - rows[i].tension, change[i], 5e-4 * std::abs(change[i])) << i;
  };
  expect_change(RiggingBalance(ropes, 1, {}, 1));
  // A second tackle that bears its hook block alone holds no load about the plumb.
  RiggingRope idle = ropes.back();
  idle.lower.index = 1;
  idle.direction_W = Vector3d::UnitZ();
  idle.tension = 5e3;
  ropes.push_back(idle);
  expect_change(RiggingBalance(ropes, 2, {}, 1));
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

// Four plumb ropes at -3, -1, 1 and 3 m on a beam that gives way as F says; the second one is so
// long that it hangs slack. By statics its share goes half to the first and half to the third, and
// what is free is t (1, -3, 2) on the first, the third and the fourth: least work makes it
//   t = -n . (F p + e) / (n . F n),
// p with the slack rope's own -T, by which the beam springs back there.
TEST(RiggingBalance, ALoadSpringsBackWhereARopeIsSlack) {
  std::vector<RiggingRope> ropes;
  const VectorXd at = Eigen::Vector4d(-3, -1, 1, 3);
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
  const VectorXd p = Eigen::Vector4d(share / 2, -share, share / 2, 0);
  const VectorXd n = Eigen::Vector4d(1, 0, -3, 2);
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
