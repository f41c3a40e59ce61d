// What a frame bears when one diagonal of its four slings bears more.
#include "pipeline/checks/frame_skew.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "pipeline/checks/frame_compliance.h"
#include "pipeline/standards/standard_assessment.h"
#include "tests/pipeline/spreader_lift.h"

namespace blocklift::pipeline {
namespace {

/// The sample's frame of 4 x 2 m without eyes and next to no weight, a load of 10 t below it.
struct LiftOfFrame {
  LiftCase lift_case;
  LiftRun run;

  const LiftSpreader& frame() const { return run.model.spreaders.front(); }
  const given::Spreader& in_case() const { return *lift_case.find_spreader("B1"); }
};

const LiftOfFrame& lift_of_frame() {
  static const LiftOfFrame lift = [] {
    test::SampleLift parts = test::frame_lift();
    for (const auto& [from, to] : {std::pair("    upper_eye: 0.2 m\n", "    mass: 1 kg\n"),
                                   {"    lower_eye: 0.1 m\n", ""},
                                   {"by: -1 m", "by: -1 mm"},
                                   {"pause: 2 s", "pause: 0.1 s"},
                                   {"settle: 2 s", "settle: 0 s"},
                                   {"1e-8", "1e-4"}})
      parts.lift_case = test::with(parts.lift_case, from, to);
    const test::TemporaryFolder folder;
    parts.write(folder);
    LiftCase lift_case = read_lift_case("case.yaml");
    LoadMass load;
    load.mass = 10e3;
    load.p_BoBcm_B = {2, 0, 0.5};
    load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
    LiftRun run = run_lift(lift_case, build_lift(lift_case, load), [](auto&&...) {});
    return LiftOfFrame{std::move(lift_case), std::move(run)};
  }();
  return lift;
}

/// The factor on forces at which the first of two columns fails.
double growth(const std::array<structure::Column, 2>& columns,
              const std::array<structure::ColumnForces, 2>& forces) {
  double least = 0, most = 1e3;
  for (int i = 0; i < 60; ++i) {
    const double middle = (least + most) / 2;
    const bool holds = structure::column_utilisation(columns[0], forces[0], middle) < 1 &&
                       structure::column_utilisation(columns[1], forces[1], middle) < 1;
    (holds ? least : most) = middle;
  }
  return least;
}

// By statics, V a quarter of the load: slings that lean by 2 and 1 m in 2 m press the sides with V
// along x and V / 2 along y, where those below it, which lean by 1 m in sqrt(3) m, press with
// V / sqrt(3) besides. A quarter more on one diagonal and less on the other leaves the
// compression as it is; cut across, two sides bear the shear V / 4 of the sides between them as a
// frame of Vierendeel's, which bends all corners by V / 4 x 2 m / 2.
TEST(FrameSkew, BendsTheCornersInTheirPlane) {
  const LiftOfFrame& lift = lift_of_frame();
  const double V = 10e3 * 9.81 / 4, across = V * (0.5 + 1 / std::sqrt(3.0));
  const std::array<structure::Column, 2> sides{lift.in_case().column(),
                                               lift.in_case().cross_member().column};
  const double even = growth(sides, {{{V, {}}, {across, {}}}});
  const double uneven = growth(sides, {{{V, {0, 0.25 * V}}, {across, {0, 0.25 * V}}}});
  const auto found =
      frame_skew(lift.in_case(), lift.frame(), lift.run.static_history, [](int) { return 1.25; });
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, even / uneven, 5e-3 * even / uneven);
  EXPECT_GT(*found, 2);  // far beyond the factor itself
  const auto none =
      frame_skew(lift.in_case(), lift.frame(), lift.run.static_history, [](int) { return 1.0; });
  ASSERT_TRUE(none);
  EXPECT_NEAR(*none, 1, 1e-9);
}

// The chain has it in place of the slings' factor, by the clause of the rules; a bar has that one.
TEST(FrameSkew, StandsInTheChainOfTheFrame) {
  given::Standard standard;
  standard.rules.name = "Rules";
  NamedFactor matched;
  matched.name = {"matched", {}};
  matched.value = 1.25;
  matched.clause = "1";
  standard.rules.skew = {matched};
  standard.skew = Located<std::string>{"matched", {}};
  LiftFacts facts;
  SpreaderFacts spreader;
  spreader.name = "B1";
  spreader.load = {100e3, 100e3, 0, 0, 1, 1};
  spreader.borne_at_rest = spreader.borne_in_motion = 400e3;
  spreader.is_frame = true;
  spreader.skew_by_rules = 3;
  facts.spreaders = {spreader, spreader};
  facts.spreaders[1].is_frame = false;
  facts.spreaders[1].skew_by_rules.reset();
  facts.spreader_factor = 1;
  const StandardAssessment result = assess_standard(standard, facts);
  ASSERT_EQ(result.chains.size(), 3U);
  EXPECT_NEAR(result.chains[1].standard_utilisation(), 0.75, 1e-12);
  EXPECT_NEAR(result.chains[1].simulated_utilisation(), 0.75, 1e-12);
  EXPECT_NEAR(result.chains[2].standard_utilisation(), 0.3125, 1e-12);
}

/// The row of skew in the chain of a frame with slings' lengths to a tolerance.
ChainStep skew_step(std::optional<double> by_rules, std::optional<double> computed) {
  given::Standard standard;
  standard.rules.name = "Rules";
  NamedFactor matched;
  matched.name = {"matched", {}};
  matched.value = 1.25;
  matched.clause = "1";
  standard.rules.skew = {matched};
  standard.skew = Located<std::string>{"matched", {}};
  LiftFacts facts;
  SpreaderFacts frame;
  frame.name = "F1";
  frame.load = {100e3, 100e3, 0, 0, 1, 1};
  frame.borne_at_rest = frame.borne_in_motion = 400e3;
  frame.is_frame = true;
  frame.skew_by_rules = by_rules;
  frame.skew_computed = computed;
  facts.spreaders = {frame};
  facts.spreader_factor = 1;
  const StandardAssessment result = assess_standard(standard, facts);
  for (const ChainStep& step : result.chains[1].steps)
    if (step.name.find("skew") != std::string::npos) return step;
  return {};
}

// It takes the less of both, not below the slings' own factor, and says so; where no four slings
// meet it is that factor.
TEST(FrameSkew, TakesTheLessOfRigidCornersAndOfTolerances) {
  EXPECT_EQ(skew_step(3, 1.4).standard, 1.4);
  EXPECT_EQ(skew_step(3, 1.4).simulated, 1.4);
  EXPECT_NE(skew_step(3, 1.4).formula.find("3 with the slings of a diagonal"), std::string::npos);
  EXPECT_NE(skew_step(3, 1.4).formula.find("this program's reading"), std::string::npos);
  EXPECT_EQ(skew_step(3, 4).formula.find("this program's reading"), std::string::npos);
  EXPECT_EQ(skew_step(3, 1.1).standard, 1.25);  // no less than the slings' own
  EXPECT_EQ(skew_step(3, 1.1).simulated, 1.1);
  EXPECT_EQ(skew_step(1.2, 1.1).standard, 1.2);  // the frame as a rigid one does not grow so far
  EXPECT_EQ(skew_step(3, 4).standard, 3);
  EXPECT_EQ(skew_step(3, 4).simulated, 4);
  EXPECT_EQ(skew_step({}, 1.4).standard, 1.25);
  EXPECT_EQ(skew_step({}, 1.4).simulated, 1.4);
  EXPECT_EQ(skew_step(3, {}).simulated, 3);
  EXPECT_NE(skew_step(3, {}).formula.find("no tolerance of lengths"), std::string::npos);
  EXPECT_EQ(skew_step({}, {}).standard, 1.25);
  EXPECT_NE(skew_step({}, {}).formula.find("no four of them meet"), std::string::npos);
}

// The frame hangs on four slings of d longer and shorter by turns; what is below it is plumb, on a
// rigid load. By least work (Castigliano) the change T of each sling is d over what gives way along
// it: its own length over E A, the corner's way up against the frame's warping and the ropes below,
// c = h^2 / (k_w + k_below), and the shear in the frame's plane, a^2 W^2 (1 / k_1 + 1 / k_2) / 24,
// with the sling's direction (a, b, h) and k = E I / l of the sides.
TEST(FrameSkew, IsStiffnessTimesMismatch) {
  const given::Spreader& frame = lift_of_frame().in_case();
  const double L = frame.length.value, W = *frame.width, height = 2, weight = 100e3;
  const structure::FrameMember side = frame.member(), across = frame.cross_member();
  const double E = bar_modulus, G = E / 2.6;
  TolerancedRigging rigging;
  rigging.hooks = 1;
  rigging.bars.resize(1);
  const double sling = std::hypot(L / 2, W / 2, height), below = 3;
  const double of_sling = 6e-8, of_below = 2e-7;  // m/N
  for (const Vector3& corner : structure::RectangularFrame::corners(L, W)) {
    RiggingRope up, down;
    up.lower = down.upper = {RiggingEnd::Kind::bar, 0, corner};
    up.upper = {RiggingEnd::Kind::hook, 0, Vector3::Zero()};
    up.direction_W = (Vector3(0, 0, height) - corner) / sling;
    up.tension = weight / 4 / up.direction_W.z();
    up.length = sling;
    up.compliance = of_sling;
    down.lower = {RiggingEnd::Kind::load, -1, corner - Vector3(0, 0, 0.001)};
    down.tension = weight / 4;
    down.length = below;
    down.compliance = of_below;
    rigging.ropes.push_back(up);
    rigging.ropes.push_back(down);
  }
  RiggingRope tackle;
  tackle.lower = {RiggingEnd::Kind::hook, 0, Vector3::Zero()};
  tackle.tension = weight;
  tackle.length = 30;
  tackle.compliance = 1e-8;
  rigging.ropes.push_back(tackle);

  const double h = height / sling, a = L / 2 / sling, error = 1e-3;
  const auto part = [&](const structure::FrameMember& bent, const structure::FrameMember& twisted) {
    const double l = bent.column.length;
    return 4 / (l * l) /
           (l / (6 * E * bent.column.second_moments[0]) +
            twisted.column.length / (2 * G * twisted.torsion_constant));
  };
  const double warping = part(side, across) + part(across, side);
  const double k_1 = E * side.column.second_moments[1] / L;
  const double k_2 = E * across.column.second_moments[1] / W;
  const double gives_way =
      of_sling + h * h / (warping + 1 / of_below) + a * a * W * W * (1 / k_1 + 1 / k_2) / 24;
  const double change = error / gives_way;
  EXPECT_LT(change, 0.25 * error / of_sling);      // the frame gives way more than the slings
  EXPECT_NEAR(change, 3401.70727, 1e-6 * change);  // of beams and ropes assembled in Python (numpy)

  Eigen::VectorXd errors = Eigen::VectorXd::Zero(9);
  for (int i = 0; i < 4; ++i) errors[2 * i] = i % 2 == 0 ? error : -error;
  const Eigen::VectorXd tension = balance_of(rigging, {&frame}).with_length_errors(errors);
  const double change_below = change * h / (1 + warping * of_below);
  for (int i = 0; i < 4; ++i) {
    const double sign = i % 2 == 0 ? -1 : 1;
    EXPECT_NEAR(tension[2 * i] - rigging.ropes[2 * i].tension, sign * change, 1e-6 * change);
    EXPECT_NEAR(tension[2 * i + 1] - weight / 4, sign * change_below, 1e-6 * change);
  }
}

}  // namespace
}  // namespace blocklift::pipeline
