#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/checks/checks.h"
#include "pipeline/checks/lift_checks.h"
#include "pipeline/checks/measure_checks.h"
#include "pipeline/lift/sling_ends.h"
#include "pipeline/lift/stage_loads.h"
#include "pipeline/measures/chart_derating.h"
#include "pipeline/measures/clearance.h"
#include "pipeline/measures/load_measures.h"
#include "pipeline/measures/measure.h"
#include "pipeline/measures/tackle_measures.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

constexpr double g = 9.81;

/// The sample lift, whose crane stands on four wheels and has a load chart, run once.
struct WatchedLift {
  LiftCase lift_case;
  LiftRun run;
  std::vector<LiftMeasure> measures;

  const LiftMeasure& measure(const std::string& name) const {
    for (const LiftMeasure& one : measures)
      if (one.name() == name) return one;
    throw std::out_of_range(name);
  }
};

/// @param crane_lines, case_lines, rope_lines more of the crane, of the case, and of the model of
///   both slings and the left tackle. @param left_sling in place of how it runs.
WatchedLift watch(const std::string& checks = "{}", const std::string& crane_lines = "",
                  const std::string& case_lines = "", const std::string& rope_lines = "",
                  const std::string& left_sling = "from: C1.left, to: L1, length: 2 m") {
  test::SampleLift parts;
  parts.lift_case =
      test::with(parts.lift_case, "from: C1.left, to: L1, model: ropes/tackle, length: 2 m",
                 left_sling + ", model: ropes/tackle");
  parts.rope += rope_lines;
  parts.crane = test::with(parts.crane, "capacity: 20 t\n",
                           "capacity: 20 t\n"
                           "radius_from: {body: gantry, position: [0 m, 0 m, 0 m]}\n"
                           "stands_on:\n"
                           "  body: gantry\n"
                           "  supports:\n"
                           "    A: {position: [-3 m, 0 m, 0 m], capacity: 20 t}\n"
                           "    B: {position: [3 m, 0 m, 0 m]}\n"
                           "    C: {position: [-3 m, 10 m, 0 m]}\n"
                           "    D: {position: [3 m, 10 m, 0 m]}\n");
  parts.crane = test::with(
      parts.crane, "    rope: ropes/tackle\n    crane_stiffness: 10 MN/m\n    capacity: 10 t\n",
      "    rope: ropes/tackle\n    crane_stiffness: 10 MN/m\n    capacity: 10 t\n"
      "    load_chart: [{radius: 6 m, capacity: 8 t}, {radius: 7 m, capacity: 5 t}]\n"
      "    reeving: {falls: 8, lead_lines: 2, lead_sheaves: 2, sheave_efficiency: 96 %,\n"
      "              breaking_load: 125 kN, line_pull: 10 kN}\n");
  parts.crane += crane_lines;
  parts.lift_case += "checks: " + checks + "\n" + case_lines;
  const test::TemporaryFolder folder;
  parts.write(folder);
  LiftCase lift_case = read_lift_case("case.yaml");
  LoadMass load;
  load.mass = 10e3;
  load.p_BoBcm_B = {2, 0, 0.5};
  load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
  LiftRun run = run_lift(lift_case, build_lift(lift_case, load), [](auto&&...) {});
  std::vector<LiftMeasure> measures = find_measures(lift_case, run);
  return {std::move(lift_case), std::move(run), std::move(measures)};
}

const WatchedLift& watched() {
  static const WatchedLift lift = watch();
  return lift;
}

std::vector<Triangle> unit_box() {
  return surface_of(BoxShape{{1, 1, 1}, Vector3::Zero(), Vector3::Zero()});
}

TEST(Peak, OfEachKindPassesOverWhatIsNoNumber) {
  const Eigen::Vector4d time(0, 1, 2, 3), values(1, NAN, -5, 4);
  EXPECT_EQ(find_peak(time, values, Extreme::largest).value, 4);
  EXPECT_EQ(find_peak(time, values, Extreme::smallest).value, -5);
  EXPECT_EQ(find_peak(time, values, Extreme::largest_magnitude).time, 2);
  EXPECT_TRUE(std::isnan(find_peak(time, Eigen::Vector4d::Constant(NAN), Extreme::largest).value));
}

TEST(DistanceWithin, IsPositiveInsideAndNegativeOutside) {
  const std::vector<Eigen::Vector2d> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}};
  EXPECT_NEAR(distance_within(square, {1, 1}), 1, 1e-15);
  EXPECT_NEAR(distance_within(square, {0.25, 1}), 0.25, 1e-15);
  EXPECT_NEAR(distance_within(square, {3, 3}), -std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(distance_within(square, {1, -0.5}), -0.5, 1e-15);
  EXPECT_TRUE(std::isnan(distance_within({{0, 0}, {1, 1}, {2, 2}}, {1, 0})));
  EXPECT_TRUE(std::isnan(distance_within({{0, 0}, {1, 1}}, {1, 0})));
}

TEST(SolidDistance, OfTwoBoxes) {
  const Solid a(unit_box()), b(unit_box());
  const auto at = [](double x, double y) { return dynamics::Pose::translation({x, y, 0}); };
  EXPECT_NEAR(Solid::distance(a, at(0, 0), b, at(2.5, 0), 20), 1.5, 1e-12);
  EXPECT_NEAR(Solid::distance(a, at(0, 0), b, at(2, 3), 20), std::hypot(1, 2), 1e-12);
  EXPECT_NEAR(Solid::distance(a, at(0, 0), b, at(1.2, 0.3), 20), 0.2, 1e-12);
  EXPECT_EQ(Solid::distance(a, at(0, 0), b, at(0.7, 0.3), 20), 0);
  EXPECT_EQ(Solid::distance(a, at(0, 0), b, at(100, 0), 20), 20);
  // A corner towards a face: half a diagonal nearer.
  const dynamics::Pose turned{rotation_of({0, 0, std::acos(-1.0) / 4}), {3, 0, 0}};
  EXPECT_NEAR(Solid::distance(a, at(0, 0), b, turned, 20), 2.5 - std::sqrt(0.5), 1e-12);
}

// A quarter of a circle of radius 1 between the x and the y axis, ruled over 2 m.
TEST(Surface, OfAPlateBetweenArcsLiesOnTheCylinder) {
  BlockModel block;
  PlateModel plate;
  const double s = std::sqrt(0.5);
  plate.edges = Located<std::vector<EdgeModel>>{
      {{{{1, 0, 0}, {s, s, 0}, {0, 1, 0}}, true}, {{{1, 0, 2}, {s, s, 2}, {0, 1, 2}}, true}}, {}};
  block.plates.push_back(plate);
  double area = 0;
  for (const Triangle& triangle : surface_of(block)) {
    area += 0.5 * (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm();
    for (const Vector3& corner : triangle) {
      EXPECT_LE(corner.head<2>().norm(), 1 + 1e-12);
      // The sagitta of a sixteenth of the arc.
      EXPECT_GE(corner.head<2>().norm(), std::cos(std::acos(-1.0) / 64) - 1e-12);
    }
  }
  // Sixteen chords, 2 m wide.
  EXPECT_NEAR(area, 2 * 32 * std::sin(std::acos(-1.0) / 64), 1e-12);
}

// Crane 108 t, hook blocks 1 t, load 10 t. Over the span of 10 m the gantry's weight lies at 5 m,
// the rest where the trolley is: at 5 m first, at 7 m in the end.
TEST(SupportLoads, AtRestFollowStatics) {
  const WatchedLift& lift = watched();
  const Eigen::Index last = lift.run.static_history.sample_count() - 1;
  const auto load = [&](const char* wheel, Eigen::Index sample) {
    return lift.measure("C1." + std::string(wheel) + ": support load").at_rest[sample];
  };
  const double weight = 119e3 * g;
  const auto sum = [&](Eigen::Index i) {
    return load("A", i) + load("B", i) + load("C", i) + load("D", i);
  };
  for (const Eigen::Index i : {Eigen::Index(0), last}) {
    EXPECT_NEAR(sum(i), weight, 1e-6 * weight);
    EXPECT_NEAR(lift.measure("C1: weight on the base").at_rest[i], weight, 1e-6 * weight);
  }
  EXPECT_NEAR(load("A", 0) + load("B", 0), weight / 2, 1e-5 * weight);
  EXPECT_NEAR(load("C", last) + load("D", last), (100e3 * 5 + 19e3 * 7) / 10 * g, 1e-4 * weight);
}

// What the crane presses on the rails is what all masses ask for, those of load and hooks, which
// the measure knows by the ropes' pull alone, included.
TEST(SupportLoads, InMotionObeyNewton) {
  const WatchedLift& lift = watched();
  const dynamics::History& history = lift.run.dynamic_history();
  const dynamics::Mechanism& mechanism = lift.run.model.system.mechanism();
  const LiftMeasure& pressed = lift.measure("C1: weight on the base");
  double largest = 0;
  for (Eigen::Index sample = 0; sample < history.sample_count(); ++sample) {
    double due = 0;
    for (dynamics::BodyIndex body = 1; body < mechanism.body_count(); ++body) {
      const dynamics::BodyHistory& motion = history.bodies[body - 1];
      const dynamics::RigidBodyInertia& inertia = mechanism.body(body).inertia;
      const Vector3 c = motion.X_WB(sample).R * inertia.p_BoBcm;
      const dynamics::MotionVector A = motion.A_WB(sample), V = motion.V_WB(sample);
      const Vector3 a = A.linear + A.angular.cross(c) + V.angular.cross(V.angular.cross(c));
      due += inertia.mass * (a.z() + g);
    }
    largest = std::max(largest, std::abs(due - pressed.in_motion[sample]));
  }
  // Rounding, of ropes of 200 MN whose stretch is known to 1e-16 of some metres.
  EXPECT_LT(largest, 1e-7 * 119e3 * g);
  EXPECT_GT(pressed.in_motion.maxCoeff() - pressed.in_motion.minCoeff(), 1e-3 * 119e3 * g);
}

TEST(HookMeasures, RadiusLeadsAndChart) {
  const WatchedLift& lift = watched();
  const Eigen::Index last = lift.run.static_history.sample_count() - 1;
  const LiftMeasure& radius = lift.measure("C1.left: radius");
  // Tackles and slings are plumb but for a tilt of a milliradian.
  EXPECT_NEAR(radius.at_rest[0], std::hypot(2, 5), 2e-3);
  EXPECT_NEAR(radius.at_rest[last], std::hypot(2, 7), 2e-3);
  const LiftMeasure& share = lift.measure("C1.left: share of the chart");
  const LiftRun& run = lift.run;
  const Eigen::VectorXd& tension = run.static_history.ropes[run.model.hoists[0].rope].tension;
  EXPECT_NEAR(share.at_rest[0], tension[0] / (8e3 * 9.80665), 1e-12);
  // The hook ends at 7.28 m, beyond the chart.
  EXPECT_TRUE(std::isinf(share.at_rest[last]));
  EXPECT_LT(lift.measure("C1.left: offlead").at_rest.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_GT(lift.measure("C1.left: sidelead").in_motion.cwiseAbs().maxCoeff(), 1e-3);
}

// Half of the tackle's load on four falls 1, e, e2, e3 from the drum, and the lead line over two
// sheaves more, e = 0.96 up. The sample lift only hoists.
TEST(TackleMeasures, FollowTheShareOfTheFalls) {
  const WatchedLift& lift = watched();
  const double e = 0.96, falls = 1 + e + e * e + e * e * e;
  const LiftMeasure& pull = lift.measure("C1.left: line pull");
  const LiftMeasure& load = lift.measure("C1.left: line load");
  const auto rope = static_cast<std::size_t>(lift.run.model.hoists[0].rope);
  const Eigen::VectorXd due = lift.run.dynamic_history().ropes[rope].tension / 2 / falls / (e * e);
  EXPECT_LT((pull.in_motion - due).norm(), 1e-12 * due.norm());
  EXPECT_LT((load.in_motion - due).norm(), 1e-12 * due.norm());
  EXPECT_NEAR(pull.at_rest[0], lift.run.static_history.ropes[rope].tension[0] / 2 / falls / (e * e),
              1e-9);
  EXPECT_THAT(pull.meaning, HasSubstr("8 falls on 2 lead lines, 2 lead sheaves, 96 % a sheave"));
  EXPECT_THROW(lift.measure("C1.right: line pull"), std::out_of_range);

  int found = 0;
  for (const Check& check : check_measures(lift.lift_case, lift.run, lift.measures)) {
    if (check.name.starts_with("hoist rope C1.left: largest tension in its tackle")) {
      EXPECT_NEAR(check.limit, 25e3, 1e-9);
      ++found;
    } else if (check.name.starts_with("winch C1.left: pull on its line")) {
      EXPECT_NEAR(check.limit, 10e3, 1e-9);
      ++found;
    } else {
      continue;
    }
    EXPECT_NEAR(check.demand, due.maxCoeff(), 1e-9 * check.demand);
    EXPECT_TRUE(check.pass);
  }
  EXPECT_EQ(found, 2);
}

// Both slings of 2 m and the left tackle of 5 m weigh 50 kg/m: hooks and crane bear them, the
// load's lugs do not.
TEST(RopeWeight, IsInWhatHooksAndCraneBear) {
  const WatchedLift lift =
      watch("{smallest_tension: 1 kN}", "", "rope_weight: true\n", "mass: 50 kg/m\n");
  const auto& ropes = lift.run.static_history.ropes;
  const auto& hoists = lift.run.model.hoists;
  const auto tension = [&](int rope) { return ropes[rope].tension[0]; };
  const double left = (5500 + 50 * (2 + 5)) * g, right = (5500 + 50 * 2) * g;
  // The load is tilted by a milliradian, which moves its centre by half a millimetre of 4 m.
  EXPECT_NEAR(tension(hoists[0].rope), left, 5e-4 * left);
  EXPECT_NEAR(tension(hoists[1].rope), right, 5e-4 * right);
  EXPECT_NEAR(tension(hoists[0].rope) + tension(hoists[1].rope), left + right,
              1e-5 * (left + right));
  double on_lugs = 0, on_hooks = 0;
  for (const LiftRope& sling : lift.run.model.ropes) {
    on_lugs += ropes[sling.rope].last_force(0, 2);
    on_hooks -= ropes[sling.rope].first_force(0, 2);
  }
  EXPECT_NEAR(on_lugs, 10e3 * g, 1e-6 * 10e3 * g);
  EXPECT_NEAR(on_hooks, (10e3 + 2 * 2 * 50) * g, 1e-6 * 10e3 * g);
  EXPECT_NEAR(lift.measure("C1: weight on the base").at_rest[0], (119e3 + 50 * (2 + 2 + 5)) * g,
              1e-6 * 119e3 * g);

  // A rope that hangs in a bight bears its own weight, and pulls at nothing.
  double least = std::numeric_limits<double>::infinity();
  for (const dynamics::History* history : {&lift.run.static_history, &lift.run.dynamic_history()})
    for (const dynamics::RopeHistory& rope : history->ropes) {
      const bool weighs = rope.name != "C1.right";
      const Eigen::VectorXd beyond = rope.tension - (weighs ? 50 * g : 0) * rope.unstretched_length;
      least = std::min(least, beyond.minCoeff());
    }
  for (const Check& check : check_lift(lift.lift_case, lift.run)) {
    if (!check.name.starts_with("slack")) continue;
    EXPECT_NEAR(check.demand, least, 1e-9 * least);
    EXPECT_THAT(check.note, HasSubstr("less the own weight"));
  }
}

// Friction keeps the way it had: hoisting before any motion, lowering while rope is paid out and
// until it is taken in again. A sling with both its parts over the left hook: at rest they share
// alike, in motion within the cone.
TEST(SheaveMeasures, SharesOfAnEndlessSlingStayWithinTheFriction) {
  const WatchedLift lift = watch("{}", "", "", "",
                                 "from: {body: load, point: [0 m, -0.5 m, 1.2 m]}, through: "
                                 "[C1.left], to: {body: load, point: [0 m, 0.5 m, 1.2 m]}, "
                                 "length: 4.2 m, sheave_friction: 0.1");
  const LiftMeasure& share = lift.measure("R1: larger share");
  EXPECT_EQ(share.unit, "1");
  EXPECT_LT((share.at_rest.array() - 0.5).abs().maxCoeff(), 1e-12);
  // The parts are 1 m apart at 2 m below: wrapped by 152 degrees, a little more or less in motion.
  const double capstan = std::exp(0.1 * 2.75);
  EXPECT_LT(share.in_motion.maxCoeff(), capstan / (1 + capstan));
  EXPECT_GT(share.in_motion.maxCoeff(), 0.5 + 1e-6);
  EXPECT_GT(lift.run.dynamic_history().energy.dissipated.tail(1)[0], 0);
  // At rest it may have kept any share up to that of the wrap between its parts, 1 m apart below.
  const LiftMeasure& allowed = lift.measure("R1: share that friction allows");
  const double length = lift.run.static_history.rope("R1").unstretched_length[0] +
                        lift.run.static_history.rope("R1").elongation[0];
  const double wrap = std::acos(-1.0) - 2 * std::asin(0.5 / (length / 2));
  EXPECT_NEAR(allowed.at_rest[0], 1 / (1 + std::exp(-0.1 * wrap)), 1e-4);
  EXPECT_GT((allowed.in_motion - share.in_motion).minCoeff(), -1e-6);
}

// A sling from lug to lug over the left hook, the other lug held by the right hook too: by statics
// both ends and R2 bear the weight, L1 half of it.
TEST(SlingEnds, OfASlingFromLugToLugBothCount) {
  const WatchedLift lift =
      watch("{}", "", "", "", "from: L1, through: [C1.left], to: L2, length: 6.4 m");
  const dynamics::History& history = lift.run.static_history;
  const std::vector<SlingEnd> ends = find_sling_ends(lift.run.model);
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_TRUE(ends[0].first);
  EXPECT_LT((ends[0].p_BoQ_B - Vector3(0, 0, 1.2)).norm(), 1e-12);
  EXPECT_LT((ends[1].p_BoQ_B - Vector3(4, 0, 1.2)).norm(), 1e-12);
  const double weight = 10e3 * g;
  EXPECT_LT((load_on_slings(lift.run.model, history).array() / weight - 1).abs().maxCoeff(), 1e-6);
  EXPECT_NEAR(find_stage_loads(lift.run)[0].load.at_rest, weight, 1e-6 * weight);
  // The load tilts, so that its halves are not quite the levers of the pins.
  EXPECT_NEAR(ends[0].pull(history)(0, 2), weight / 2, 0.15 * weight);
  EXPECT_TRUE(std::isfinite(lift.measure("load: righting height").at_rest[0]));

  const auto place = [&](dynamics::BodyIndex body, const Vector3& p_B) {
    return history.bodies[body - 1].X_WB(0).apply(p_B);
  };
  const auto hook = lift.run.model.system.mechanism().body_index("C1.left");
  double least = 4;
  for (const std::size_t end : {0U, 1U}) {
    const Vector3 leg =
        place(hook, Vector3::Zero()) - place(lift.run.model.load, ends[end].p_BoQ_B);
    least = std::min(least, std::atan2(leg.z(), leg.head<2>().norm()));
  }
  EXPECT_NEAR(lift.measure("R1: sling angle").at_rest[0], least, 1e-9);
}

TEST(TackleMeasures, RememberTheWayOfTheRope) {
  using enum dynamics::TackleMotion;
  Eigen::VectorXd length(7);
  length << 5, 5, 5.1, 5.1, 5.1 + 1e-12, 5.05, 5.05;
  EXPECT_THAT(
      find_tackle_motion(length),
      ::testing::ElementsAre(hoisting, hoisting, lowering, lowering, lowering, hoisting, hoisting));
}

TEST(LoadMeasures, AttitudeSlingsAndGround) {
  const WatchedLift& lift = watched();
  // The crane gives way under the left tackle alone: (T + hook) / k over 4 m.
  const double tilt = 5500 * g / 10e6 / 4;
  EXPECT_NEAR(lift.measure("load: tilt").at_rest[0], tilt, 0.02 * tilt);
  EXPECT_NEAR(std::abs(lift.measure("load: trim").at_rest[0]), tilt, 0.02 * tilt);
  EXPECT_NEAR(lift.measure("load: list").at_rest[0], 0, 1e-6);
  EXPECT_NEAR(lift.measure("R1: sling angle").at_rest[0], std::acos(-1.0) / 2, 1e-3);
  // Sheave at 10 m, 5 m of tackle, 2 m of sling, pins 1.2 m above the bottom; ropes stretch by some
  // millimetres.
  EXPECT_NEAR(lift.measure("load to ground: clearance").at_rest[0], 10 - 5 - 2 - 1.2, 0.02);
}

TEST(StageLoads, HoldTheWholeLiftsMaxima) {
  const LiftRun& run = watched().run;
  const std::vector<StageLoads> stages = find_stage_loads(run);
  ASSERT_EQ(stages.size(), 2U);
  EXPECT_EQ(stages[0].stage, "hoist up");
  EXPECT_EQ(stages[0].start, 0);
  EXPECT_EQ(stages[1].start, stages[0].end);
  EXPECT_EQ(stages[1].end, run.simulated_s());
  const dynamics::History& history = run.dynamic_history();
  for (std::size_t i = 0; i < run.model.ropes.size(); ++i) {
    const double most = history.ropes[run.model.ropes[i].rope].tension.maxCoeff();
    EXPECT_EQ(std::max(stages[0].ropes[i].in_motion, stages[1].ropes[i].in_motion), most);
    for (const StageLoads& stage : stages) {
      EXPECT_GE(stage.ropes[i].time_in_motion, stage.start - 1e-6);
      EXPECT_LE(stage.ropes[i].time_in_motion, stage.end + 1e-6);
    }
  }
  EXPECT_NEAR(stages[0].load.at_rest, 10e3 * g, 1e-6 * 10e3 * g);
}

TEST(MeasureChecks, NameTheWorstOfEachKind) {
  const WatchedLift lift = watch(
      "{tilt: 1 deg, turn: 0.001 deg, sling_angle: 60 deg, offlead: 0.1 deg, sidelead: 10 deg, "
      "clearance: 2.5 m}");
  const std::vector<Check> checks = check_measures(lift.lift_case, lift.run, lift.measures);
  const auto check = [&](const std::string& beginning) -> const Check& {
    for (const Check& one : checks)
      if (one.name.starts_with(beginning)) return one;
    throw std::out_of_range(beginning);
  };
  EXPECT_TRUE(check("tilt").pass);
  // In motion, as at rest: whichever is further.
  const double turn = std::abs(find_peak(lift.run, lift.measure("load: turn")).value);
  EXPECT_DOUBLE_EQ(check("turn").demand, turn);
  EXPECT_EQ(check("turn").pass, turn <= 0.001 * std::acos(-1.0) / 180);
  EXPECT_TRUE(check("angle of slings").pass);
  EXPECT_FALSE(check("offlead").pass);
  EXPECT_TRUE(check("sidelead").pass);
  EXPECT_FALSE(check("clearance").pass);
  // A hook block of 500 kg and 3.5 t/m^3 reaches cbrt(0.5 / 7) m below its sling's upper end, the
  // pin stands 0.2 m above the webs.
  EXPECT_THAT(check("clearance").note, HasSubstr("load to C1."));
  EXPECT_NEAR(check("clearance").demand, 2 - std::cbrt(0.5 / 7) + 0.2, 0.05);
  EXPECT_FALSE(check("hoist C1.left: load over the load chart").pass);
  // Each wheel bears 30 t at least, the first 20 t at most.
  EXPECT_FALSE(check("support C1.A").pass);
  EXPECT_TRUE(check("crane C1: smallest load of a support").pass);
}

TEST(MeasureChecks, ASupportThatLiftsOffFails) {
  const WatchedLift& lift = watched();
  std::vector<LiftMeasure> measures = lift.measures;
  for (LiftMeasure& one : measures)
    if (one.name() == "C1.B: support load") one.in_motion[3] = -1;
  for (const Check& check : check_measures(lift.lift_case, lift.run, measures)) {
    if (!check.name.starts_with("crane C1: smallest load")) continue;
    EXPECT_FALSE(check.pass);
    EXPECT_EQ(check.note, "C1.B");
    return;
  }
  FAIL() << "there is no such check";
}

// Drives that stop stay where they are, and the load is left to one sling where the other parts.
TEST(Faults, StopDrivesAndPartRopes) {
  test::SampleLift parts;
  parts.lift_case +=
      "faults:\n"
      "  - {at: 6 s, stops: [all], within: 1 s}\n"
      "  - {at: 20 s, parts: [R1]}\n";
  const test::TemporaryFolder folder;
  parts.write(folder);
  const LiftCase lift_case = read_lift_case("case.yaml");
  LoadMass load;
  load.mass = 10e3;
  load.p_BoBcm_B = {2, 0, 0.5};
  load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
  const LiftRun run = run_lift(lift_case, build_lift(lift_case, load), [](auto&&...) {});
  const dynamics::History& history = run.dynamic_history();
  const dynamics::RopeHistory& tackle = history.ropes[0];
  const Eigen::Index last = history.sample_count() - 1;
  EXPECT_EQ(tackle.unstretched_rate[last], 0);
  // It hoists from 5 s on and is stopped early in its acceleration.
  EXPECT_LT(tackle.unstretched_length[last], 5);
  EXPECT_GT(tackle.unstretched_length[last], 4.8);
  const dynamics::RopeHistory& parted = history.rope("R1");
  for (Eigen::Index i = 0; i <= last; ++i) {
    if (history.time[i] > 20 + 1e-3) {
      EXPECT_EQ(parted.tension[i], 0);
    } else if (history.time[i] < 20 - 1e-3) {
      EXPECT_GT(parted.tension[i], 0);
    }
  }
  ASSERT_EQ(run.dynamic_result.parted.size(), 1U);
  EXPECT_NEAR(run.dynamic_result.parted[0].tension, 5e3 * g, 0.02 * 5e3 * g);
  // The load swings below the other lug: more than its weight at the lowest point.
  EXPECT_GT(history.rope("R2").tension.maxCoeff(), 10e3 * g);
}

// The winch lets out 0.2 m/s for two seconds and stands: its end of the load, 4 m long, hangs lower
// by that.
TEST(Faults, AWinchRunsAway) {
  test::SampleLift parts;
  parts.lift_case +=
      "faults: [{at: 30 s, runs_away: [C1.left], speed: 12 m/min, caught_after: 2 s}]\n";
  const test::TemporaryFolder folder;
  parts.write(folder);
  const LiftCase lift_case = read_lift_case("case.yaml");
  LoadMass load;
  load.mass = 10e3;
  load.p_BoBcm_B = {2, 0, 0.5};
  load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
  const LiftRun run = run_lift(lift_case, build_lift(lift_case, load), [](auto&&...) {});
  const dynamics::History& history = run.dynamic_history();
  const Eigen::Index last = history.sample_count() - 1;
  EXPECT_NEAR(history.ropes[0].unstretched_length[last], 5 - 2 + 2 * 0.2, 1e-9);
  EXPECT_NEAR(history.ropes[1].unstretched_length[last], 5 - 2, 1e-9);
  const Eigen::Matrix3d R =
      run.static_history.body("load").X_WB(run.static_history.sample_count() - 1).R;
  EXPECT_NEAR(R(2, 0), 0.4 / 4, 0.01);
}

TEST(Faults, ARunawayNeedsAWinchWithSpeedAndEnd) {
  const auto read = [](const std::string& fault) {
    test::SampleLift parts;
    parts.lift_case += "faults: [" + fault + "]\n";
    const test::TemporaryFolder folder;
    parts.write(folder);
    read_lift_case("case.yaml");
  };
  EXPECT_THAT([&] { read("{at: 30 s, runs_away: [C1.left], speed: 1 m/s}"); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("lacks its speed or caught_after")));
  EXPECT_THAT([&] { read("{at: 30 s, runs_away: [C1.travel], speed: 1 m/s, caught_after: 1 s}"); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("its winches are")));
}

// Plumb tackles and slings hold the load by its pins, 0.7 m above its centre of mass.
TEST(Measures, RightingHeightIsThatOfThePinsAboveTheCentreOfMass) {
  const LiftMeasure& measure = watched().measure("load: righting height");
  EXPECT_NEAR(measure.at_rest[0], 0.7, 2e-3);
  EXPECT_NEAR(measure.in_motion[0], 0.7, 2e-3);
}

TEST(LoadChart, TakesTheCapacityOfTheNextLargerRadius) {
  const LoadChart chart{{{6, 80e3}, {7, 50e3}}};
  EXPECT_EQ(chart.capacity(1), 80e3);
  EXPECT_EQ(chart.capacity(6), 80e3);
  EXPECT_EQ(chart.capacity(6.01), 50e3);
  EXPECT_EQ(chart.capacity(7.01), 0);
}

TEST(Derating, TakesTheFactorOfTheNextLargerValue) {
  const std::vector<DeratingLine> lines{{10, 1}, {14, 0.8}};
  EXPECT_EQ(factor_in(lines, 0), 1);
  EXPECT_EQ(factor_in(lines, 10), 1);
  EXPECT_EQ(factor_in(lines, 10.1), 0.8);
  EXPECT_EQ(factor_in(lines, 14.1), 0);
}

// The case has no sea, so that the sea's table does not count.
TEST(Derating, DividesTheShareOfTheChartAndIsNamedByTheCheck) {
  const std::string table =
      "derating: {source: maker's table 4, wind: [{up_to: 5 m/s, factor: 1}, {up_to: 9 m/s, "
      "factor: 0.8}, {up_to: 14 m/s, factor: 0.5}], sea: [{up_to: 1 m, factor: 0.1}]}\n";
  const WatchedLift lift =
      watch("{crane_capacity: true}", table, "wind: {speed: 8 m/s, towards: 60 deg}\n");
  const LiftMeasure& share = lift.measure("C1.left: share of the chart");
  const LiftRun& run = lift.run;
  const Eigen::VectorXd& tension = run.static_history.ropes[run.model.hoists[0].rope].tension;
  EXPECT_NEAR(share.at_rest[0], tension[0] / (0.8 * 8e3 * 9.80665), 1e-12);
  EXPECT_THAT(share.meaning, HasSubstr("maker's table 4"));
  bool named = false;
  for (const Check& check : check_measures(lift.lift_case, lift.run, lift.measures))
    named = named || (check.name == "hoist C1.left: load over the load chart at its radius" &&
                      check.note.find("maker's table 4") != std::string::npos);
  EXPECT_TRUE(named);
}

/// Why the verdict says that hook C1.left fails by its chart.
std::string reason_of_chart(const WatchedLift& lift) {
  for (const std::string& reason :
       verdict_reasons(check_measures(lift.lift_case, lift.run, lift.measures)))
    if (reason.starts_with("hoist C1.left: load over the load chart")) return reason;
  return "";
}

// Beyond a chart's end, or beyond the tables that derate it, no figure says how far.
TEST(Derating, SaysWhatAHookIsBeyond) {
  const std::string short_of_wind =
      "derating: {source: maker, wind: [{up_to: 5 m/s, factor: 1}]}\n";
  EXPECT_THAT(reason_of_chart(watch("{crane_capacity: true}", short_of_wind,
                                    "wind: {speed: 8 m/s, towards: 60 deg}\n")),
              HasSubstr("radius: wind or sea are beyond the tables by which the chart is derated"));
  WatchedLift lift = watch("{crane_capacity: true}", "");
  CraneModel crane = *lift.lift_case.cranes[0].model;
  for (HoistModel& hoist : crane.hoists)
    if (hoist.name.value == "left") hoist.load_chart->value = {{0.5, 80e3}};
  lift.lift_case.cranes[0].model = std::make_shared<CraneModel>(crane);
  for (LiftMeasure& measure : lift.measures)
    if (measure.name() == "C1.left: share of the chart")
      measure.in_motion.setConstant(std::numeric_limits<double>::infinity());
  EXPECT_THAT(reason_of_chart(lift), HasSubstr("m, the chart ends at 0.5 m; hook block included"));
}

/// The factor for a crane with a table of the sea, in a case with these waves.
ChartFactor at_sea(std::optional<given::Waves> waves) {
  CraneModel crane;
  crane.derating.emplace();
  crane.derating->source = "maker";
  crane.derating->sea.emplace();
  crane.derating->sea->value = {{0.5, 1}, {1, 0.9}, {1.5, 0.7}};
  LiftCase lift_case;
  lift_case.gravity = g;
  lift_case.sea.emplace();
  lift_case.sea->density = 1025;
  lift_case.sea->waves = std::move(waves);
  return find_chart_factor(crane, lift_case);
}

TEST(Derating, CountsTheSignificantHeightOfTheSea) {
  EXPECT_EQ(at_sea({}).value, 1);
  given::Waves irregular;
  irregular.spectrum.emplace();
  irregular.spectrum->significant_height.emplace();
  irregular.spectrum->significant_height->value = 1.5;
  EXPECT_EQ(at_sea(irregular).value, 0.7);
  irregular.spectrum->significant_height->value = 1.6;
  EXPECT_EQ(at_sea(irregular).value, 0);
  // 4 sqrt(a^2 / 2) of 0.3 m is 0.85 m.
  given::Waves regular;
  given::RegularWave wave;
  wave.amplitude = 0.3;
  wave.frequency.emplace();
  wave.frequency->value = 0.8;
  regular.regular = {wave};
  EXPECT_EQ(at_sea(regular).value, 0.9);
  EXPECT_THAT(at_sea(regular).text, HasSubstr("waves of 0.849 m significant height (maker)"));
}

}  // namespace
}  // namespace blocklift::pipeline
