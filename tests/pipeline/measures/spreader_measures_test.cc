#include "pipeline/measures/spreader_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/checks/measure_checks.h"
#include "pipeline/measures/clearance.h"
#include "tests/pipeline/spreader_lift.h"

namespace blocklift::pipeline {
namespace {

constexpr double gravity = 9.81;

/// A lift of the sample's plate of 10 t on a bar.
struct BarLift {
  LiftCase lift_case;
  LiftRun run;
  std::vector<LiftMeasure> measures;

  const LiftMeasure& measure(const std::string& name) const {
    for (const LiftMeasure& one : measures)
      if (one.name() == name) return one;
    throw std::out_of_range(name);
  }
};

BarLift lift_on_bar(const test::SampleLift& parts) {
  const test::TemporaryFolder folder;
  parts.write(folder);
  LiftCase lift_case = read_lift_case("case.yaml");
  LoadMass load;
  load.mass = 10e3;
  load.p_BoBcm_B = {2, 0, 0.5};
  load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
  LiftRun run = run_lift(lift_case, build_lift(lift_case, load), [](auto&&...) {});
  std::vector<LiftMeasure> measures;
  add_spreader_measures(lift_case, run, measures);
  return {std::move(lift_case), std::move(run), std::move(measures)};
}

const BarLift& plain_lift() {
  static const BarLift lift = lift_on_bar(test::spreader_lift());
  return lift;
}

// A bar between two slings that lean by a, under a load of W at each end: N = W tan a, and the
// eyes e above it bend it by N e, as its own weight w does by w L^2 / 8.
TEST(LargestForces, OfABarUnderTwoSlings) {
  const double W = 50e3, w = 600, L = 8, e = 0.3, tangent = 0.75;
  const double V = W + w * L / 2, H = V * tangent;
  const auto forces = largest_forces({{{-L / 2, 0, e}, {H, 0, V}},
                                      {{L / 2, 0, e}, {-H, 0, V}},
                                      {{-L / 2, 0, -0.1}, {0, 0, -W}},
                                      {{L / 2, 0, -0.1}, {0, 0, -W}}},
                                     L);
  EXPECT_NEAR(forces.compression, H, 1e-9 * H);
  EXPECT_NEAR(forces.moments[0], H * e + w * L * L / 8, 1e-9 * H);
  EXPECT_NEAR(forces.moments[1], 0, 1e-9 * H);
}

// Eyes on the axis: the weight alone bends, upwards sagging in the middle.
TEST(LargestForces, OfABarsOwnWeight) {
  const double w = 500, L = 10;
  const auto forces =
      largest_forces({{{-L / 2, 0, 0}, {0, 0, w * L / 2}}, {{L / 2, 0, 0}, {0, 0, w * L / 2}}}, L);
  EXPECT_NEAR(forces.compression, 0, 1e-9);
  EXPECT_NEAR(forces.moments[0], w * L * L / 8, 1e-9 * w * L * L);
}

// A weight W whose centre lies x_0 beside the middle, plumb ends: the load along the bar is
// W / L (1 + 12 x_0 x / L^2), the reactions W (1/2 -+ x_0 / L), M(x) what they leave.
TEST(LargestForces, OfAWeightBesideTheMiddle) {
  const double W = 12e3, L = 8, h = L / 2, x_0 = 0.5;
  const auto found = largest_forces(
      {{{-h, 0, 0}, {0, 0, W * (0.5 - x_0 / L)}}, {{h, 0, 0}, {0, 0, W * (0.5 + x_0 / L)}}}, L);
  double largest = 0;
  for (int i = 0; i <= 20; ++i) {
    const double x = L * (i / 20.0 - 0.5), u = x + h;
    const double lever = x * (x * x - h * h) / 2 - (x * x * x + h * h * h) / 3;
    largest = std::max(
        largest, W * (0.5 - x_0 / L) * u - W / L * u * u / 2 - 12 * W * x_0 / (L * L * L) * lever);
  }
  EXPECT_NEAR(found.moments[0], largest, 1e-9 * W);
  EXPECT_GT(largest, W * L / 8);
}

// A free rod pushed sideways at its end: the largest moment, 4/27 F L, lies a third of the way from
// the other end (Timoshenko and Young, Advanced dynamics).
TEST(LargestForces, OfARodThatIsAccelerated) {
  const double F = 1e3, L = 6;
  const auto forces = largest_forces({{{L / 2, 0, 0}, {0, F, 0}}}, L);
  EXPECT_NEAR(forces.moments[1], 4.0 / 27 * F * L, 0.003 * F * L);
  EXPECT_LE(forces.moments[1], 4.0 / 27 * F * L * (1 + 1e-12));
}

TEST(LargestForces, OfABarThatIsPulledAreNegative) {
  const auto forces = largest_forces({{{-1, 0, 0}, {-7, 0, 0}}, {{1, 0, 0}, {7, 0, 0}}}, 2);
  EXPECT_NEAR(forces.compression, -7, 1e-12);
}

// Slings of 2.5 m from one hook to the ends of a bar of 4 m rise by 1.5 m: N = V tan = V 2 / 1.5 of
// half the load and half the bar.
TEST(SpreaderMeasures, CompressionAtRestIsThatOfTheTriangle) {
  const BarLift& lift = plain_lift();
  const double bar = lift.lift_case.find_spreader("B1")->mass();
  const double pi = std::acos(-1.0), outer = 0.08415, inner = 0.07615;
  EXPECT_NEAR(bar, 7850 * 4 * pi * (outer * outer - inner * inner), 1e-9 * bar);
  const double V = (10e3 + bar) * gravity / 2;
  const double stretched = 2.5 * (1 + V * 2.5 / 1.5 / 200e6);
  const double H = V * 2 / std::sqrt(stretched * stretched - 4);
  EXPECT_NEAR(lift.measure("B1: compression").at_rest[0], H, 1e-6 * H);
  const double M = H * 0.2 + bar * gravity * 4 / 8;
  EXPECT_NEAR(lift.measure("B1: bending moment").at_rest[0], M, 1e-5 * M);
  const given::Spreader& own = *lift.lift_case.find_spreader("B1");
  const structure::Column column = own.column();
  EXPECT_NEAR(lift.measure("B1: share of the resistance").at_rest[0],
              structure::column_utilisation(
                  column, {lift.measure("B1: compression").at_rest[0], {M, 0}}, 1.5),
              1e-5);
}

// In motion the bar is pressed as the sum of the slings below asks, within its own small inertia.
TEST(SpreaderMeasures, CompressionFollowsTheMotion) {
  const BarLift& lift = plain_lift();
  const Eigen::VectorXd& N = lift.measure("B1: compression").in_motion;
  const dynamics::History& history = lift.run.dynamic_history();
  const Eigen::VectorXd pull = history.rope("R1").tension + history.rope("R2").tension;
  EXPECT_GT(N.maxCoeff() / N[0], 1.01);
  for (Eigen::Index i = 0; i < N.size(); ++i) EXPECT_NEAR(N[i] / N[0], pull[i] / pull[0], 1e-3);
}

// The bar's centre of mass 0.6 m beside its middle: its end b hangs lower, and about any point the
// pulls from above balance the weights where they are.
TEST(SpreaderMeasures, WeightOfABarMayLieBesideItsMiddle) {
  test::SampleLift parts = test::spreader_lift();
  parts.lift_case = test::with(parts.lift_case, "    upper_eye: 0.2 m\n",
                               "    upper_eye: 0.2 m\n    mass: 2000 kg\n"
                               "    centre_of_mass: [0.6 m, 0 m, 0 m]\n");
  const BarLift lift = lift_on_bar(parts);
  const LiftSpreader& bar = lift.run.model.spreaders.front();
  const dynamics::History& history = lift.run.static_history;
  const dynamics::Pose X = history.bodies[bar.body - 1].X_WB(0),
                       X_load = history.bodies[lift.run.model.load - 1].X_WB(0);
  EXPECT_LT(X.R(2, 0), -0.01);
  const Vector3 weight(0, 0, -2000 * gravity), load(0, 0, -10e3 * gravity);
  Vector3 moment = X.apply(Vector3(0.6, 0, 0)).cross(weight);
  moment += X_load.apply(Vector3(2, 0, 0.5)).cross(load);
  Vector3 force = weight + load;
  for (const LiftSpreader::End& end : bar.ends) {
    if (!end.from_above) continue;
    const dynamics::RopeHistory& rope = history.ropes[end.rope];
    const Vector3 pull = (end.last ? rope.last_force : rope.first_force).row(0);
    force += pull;
    moment += X.apply(end.p_BoQ_B).cross(pull);
  }
  EXPECT_LT(force.norm(), 1e-5 * load.norm());
  EXPECT_LT(moment.norm(), 1e-4 * load.norm());
}

// The bar's lower face is 0.1 + 1.5 m over the lugs' pins less half of the pipe, these 0.2 m over
// the plate's top, and the slings stretch.
TEST(SpreaderMeasures, BarKeepsItsDistanceFromTheLoad) {
  const BarLift& lift = plain_lift();
  std::vector<LiftMeasure> measures;
  add_clearances(lift.lift_case, lift.run, measures);
  const auto clearance = std::find_if(measures.begin(), measures.end(), [](const LiftMeasure& one) {
    return one.subject == "load to B1";
  });
  ASSERT_NE(clearance, measures.end());
  EXPECT_NEAR(clearance->at_rest[0], 0.1 + 1.5 + 0.2 - 0.1683 / 2, 2e-3);
}

TEST(SpreaderMeasures, AreCheckedAgainstBuckling) {
  const BarLift& lift = plain_lift();
  const std::vector<Check> checks = check_measures(lift.lift_case, lift.run, lift.measures);
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_EQ(checks[0].name, "spreader B1: compression against buckling load / 1.5");
  const given::Spreader& own = *lift.lift_case.find_spreader("B1");
  const structure::Column column = own.column();
  EXPECT_NEAR(checks[0].limit, structure::buckling_resistance(column) / 1.5, 1e-6);
  EXPECT_TRUE(checks[0].pass);
  EXPECT_EQ(checks[1].name, "spreader B1: compression with bending, times 1.5");
  EXPECT_GT(checks[1].demand, checks[0].utilisation);
}

// All forces grow together until the column bears no more: half the load below the bar that it
// bears asks half of its resistance where moments do not grow, and less where they do.
TEST(SpreaderMeasures, BorneLoadIsWhereTheColumnFails) {
  const BarLift& lift = plain_lift();
  const LiftSpreader& bar = lift.run.model.spreaders.front();
  const given::Spreader& own = *lift.lift_case.find_spreader("B1");
  const structure::Column column = own.column();
  const double hung = hung_load(bar, lift.run.static_history)[0];
  EXPECT_NEAR(hung, 10e3 * gravity, 1e-6 * hung);
  const double borne = borne_load(own, bar, lift.run.static_history);
  const structure::ColumnForces forces{lift.measure("B1: compression").at_rest[0],
                                       {lift.measure("B1: bending moment").at_rest[0], 0}};
  EXPECT_NEAR(structure::column_utilisation(column, forces, borne / hung), 1, 1e-3);
  EXPECT_LT(structure::column_utilisation(column, forces, borne / hung / 2), 0.5);
  EXPECT_LT(borne_load(own, bar, lift.run.dynamic_history()), borne * 1.01);
}

// Two tiers: the hook bears a short bar, from whose ends a long one hangs; all plumb but the top.
TEST(SpreaderMeasures, TwoTiersFindTheirPlaces) {
  test::SampleLift parts = test::spreader_lift();
  parts.lift_case = test::with(
      parts.lift_case,
      "ropes:\n  U1: {from: C1.left, to: B1.upper_a, model: ropes/tackle, length: 2.5 m}\n"
      "  U2: {from: C1.left, to: B1.upper_b, model: ropes/tackle, length: 2.5 m}\n",
      "  B2: {length: 2 m, section: {box: [150 mm, 100 mm, 8 mm]}, yield_stress: 355 MPa}\n"
      "ropes:\n"
      "  T1: {from: C1.left, to: B2.upper_a, model: ropes/tackle, length: 1.25 m}\n"
      "  T2: {from: C1.left, to: B2.upper_b, model: ropes/tackle, length: 1.25 m}\n"
      "  U1: {from: B2.lower_a, to: B1.upper_a, model: ropes/tackle, length: 1.25 m}\n"
      "  U2: {from: B2.lower_b, to: B1.upper_b, model: ropes/tackle, length: 1.25 m}\n");
  const BarLift lift = lift_on_bar(parts);
  const double lower = lift.lift_case.find_spreader("B1")->mass();
  const double upper = lift.lift_case.find_spreader("B2")->mass();
  // Both tiers lean by 0.75 m in 1 m.
  const double H1 = (10e3 + lower) * gravity / 2 / 0.75;
  const double H2 = (10e3 + lower + upper) * gravity / 2 / 0.75;
  EXPECT_NEAR(lift.measure("B1: compression").at_rest[0], H1, 2e-3 * H1);
  EXPECT_NEAR(lift.measure("B2: compression").at_rest[0], H2 - H1, 1e-3 * H1);
  EXPECT_EQ(lift.run.model.ropes[4].hoist, "C1.left");
}

// Slings to a bar count as those to the load: 2.5 m that go 2 m aside.
TEST(SpreaderMeasures, SlingsAboveABarHaveAngles) {
  const BarLift& lift = plain_lift();
  double found = 0;
  for (const LiftMeasure& measure : find_measures(lift.lift_case, lift.run))
    if (measure.name() == "U1: sling angle") found = measure.at_rest[0];
  // They stretch by 4e-4 of their length.
  EXPECT_NEAR(found, std::atan2(1.5, 2), 1e-3);
}

// Slings of 3 m from the hook to the corners of a frame of 4 x 2 m rise by 2 m; those of 2 m below
// it lean in by 1 m and fall by sqrt(3) m. Along x only those above press, along y those above and,
// towards the plate, those below; the eyes bend: each level pull times its height.
TEST(SpreaderMeasures, FrameIsPressedByStatics) {
  const BarLift lift = lift_on_bar(test::frame_lift());
  const given::Spreader& frame = *lift.lift_case.find_spreader("B1");
  const double W = 10e3 * gravity, own = frame.mass() * gravity;
  EXPECT_NEAR(frame.mass(), 7850 * 2 * (4 + 2) * frame.column().area, 1e-9 * frame.mass());
  const double along = (W + own) / 4 * 2 / 2, across_above = (W + own) / 4 * 1 / 2;
  const double across_below = W / 4 / std::sqrt(3.0);
  // The slings stretch by 2e-4 of their length.
  EXPECT_NEAR(lift.measure("B1: compression").at_rest[0],
              std::max(along, across_above + across_below), 2e-3 * along);
  const double sag = own / 3 * 4 / 8;  // of a long side, a third of the weight
  const double bend_along = along * 0.2 + sag;
  const double bend_across = across_above * 0.2 - across_below * 0.1 + own / 6 * 2 / 8;
  EXPECT_NEAR(lift.measure("B1: bending moment").at_rest[0], std::max(bend_along, bend_across),
              3e-3 * bend_along);
  EXPECT_NEAR(lift.measure("B1: torsion moment").at_rest[0], 0, 1e-3 * bend_along);
  const std::vector<Check> checks = check_measures(lift.lift_case, lift.run, lift.measures);
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_EQ(checks[0].name, "spreader B1: compression with bending and torsion, times 1.5");
  EXPECT_TRUE(checks[0].pass);
}

// A frame of four equal sides has about its middle what two pairs of rods have.
TEST(SpreaderMeasures, FrameHasTheInertiaOfItsSides) {
  given::Spreader frame;
  frame.length.value = 4;
  frame.width = 2;
  frame.section.value.pipe = std::array<double, 2>{0.1, 0.01};
  frame.given_mass = 600;
  const Eigen::Vector3d I = frame.inertia().diagonal();
  const double L = 200, W = 100;  // kg, of each side
  const double own = frame.column().second_moments[0] / frame.column().area;
  EXPECT_NEAR(I.x(), 2 * L * (1 + 2 * own) + 2 * W * (4.0 / 12 + own), 1e-6);
  EXPECT_NEAR(I.y(), 2 * L * (16.0 / 12 + own) + 2 * W * (4 + 2 * own), 1e-6);
  EXPECT_NEAR(I.z(), 2 * L * (1 + 16.0 / 12 + own) + 2 * W * (4 + 4.0 / 12 + own), 1e-6);
}

// Two tiers of plumb slings: a frame below a bar, whose slings run to both corners of each end.
// Along x nothing presses the frame, which hangs plumb; along y those slings do, which lean by 1 m
// in 1 m.
TEST(SpreaderMeasures, FrameHangsBelowABar) {
  test::SampleLift parts = test::frame_lift();
  const std::size_t begin = parts.lift_case.find("  U1:"), end = parts.lift_case.find("  R1:");
  parts.lift_case.replace(
      begin, end - begin,
      "  T1: {from: C1.left, to: B2.upper_a, model: ropes/tackle, length: 2.5 m}\n"
      "  T2: {from: C1.left, to: B2.upper_b, model: ropes/tackle, length: 2.5 m}\n"
      "  U1: {from: B2.lower_a, to: B1.upper_1, model: ropes/tackle, length: 1.4142 m}\n"
      "  U2: {from: B2.lower_b, to: B1.upper_2, model: ropes/tackle, length: 1.4142 m}\n"
      "  U3: {from: B2.lower_b, to: B1.upper_3, model: ropes/tackle, length: 1.4142 m}\n"
      "  U4: {from: B2.lower_a, to: B1.upper_4, model: ropes/tackle, length: 1.4142 m}\n");
  parts.lift_case = test::with(parts.lift_case, "spreaders:\n",
                               "spreaders:\n  B2: {length: 4 m, section: {box: [150 mm, 100 mm, 8 "
                               "mm]}, yield_stress: 355 MPa}\n");
  const BarLift lift = lift_on_bar(parts);
  const double W = 10e3 * gravity, own = lift.lift_case.find_spreader("B1")->mass() * gravity;
  const double upper = lift.lift_case.find_spreader("B2")->mass() * gravity;
  const double across = (W + own) / 4 + W / 4 / std::sqrt(3.0);
  EXPECT_NEAR(lift.measure("B1: compression").at_rest[0], across, 2e-3 * across);
  const double above = (W + own + upper) / 2 * 2 / 1.5;
  EXPECT_NEAR(lift.measure("B2: compression").at_rest[0], above, 2e-3 * above);
}

}  // namespace
}  // namespace blocklift::pipeline
