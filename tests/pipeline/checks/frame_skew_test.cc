// What a frame bears when one diagonal of its four slings bears more.
#include "pipeline/checks/frame_skew.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "pipeline/standards/standard_assessment.h"
#include "tests/pipeline/spreader_lift.h"

namespace blocklift::pipeline {
namespace {

/// The sample's frame of 4 x 2 m without eyes and next to no weight, a load of 10 t below it.
struct LiftOfFrame {
  LiftCase lift_case;
  LiftRun run;

  const LiftSpreader& frame() const { return run.model.spreaders.front(); }
  const SpreaderInCase& in_case() const { return *lift_case.find_spreader("B1"); }
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

// The chain has it in place of the slings' factor, by the clause of the rules; a bar has the latter.
TEST(FrameSkew, StandsInTheChainOfTheFrame) {
  StandardInCase standard;
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

}  // namespace
}  // namespace blocklift::pipeline
