// What is to be computed, as files of vessels ask for it.
#include "pipeline/hydrodynamics/hydrodynamic_problem.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

class HydrodynamicProblemOfFile : public ::testing::Test {
 protected:
  HydrodynamicProblemOfFile() {
    folder_.write("barge.yaml", R"(kind: vessel
hull: {barge: {length: 40 m, breadth: 16 m, depth: 8 m}}
panel_size: 4 m
mass: 2300 t
centre_of_mass: [-1.5 m, 0.4 m, 5 m]
radii_of_gyration: [6 m, 12 m, 12 m]
)");
  }

  /// Of the barge alone, placed and asked for so.
  std::optional<HydrodynamicProblem> problem(const std::string& place, const std::string& wanted) {
    folder_.write("vessels.yaml", "kind: vessels\nvessels:\n  b: {vessel: barge, " + place +
                                      "}\nhydrodynamics:\n  " + wanted + "\n");
    diagnostics_ = {};
    return read_hydrodynamic_problem("vessels.yaml", ModelLibrary({}), diagnostics_);
  }

  test::TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

// A case turns the database with the vessel: that of a turned vessel is the unturned one's, to the
// waves that meet its hull alike.
TEST_F(HydrodynamicProblemOfFile, ASingleVesselLiesInItsOwnFrame) {
  const auto turned = problem("position: [100 m, -50 m], heading: 30 deg",
                              "headings: [30 deg, 120 deg, 210 deg, 300 deg, 0 deg]");
  ASSERT_TRUE(turned) << diagnostics_.to_text();
  const auto upright = problem("position: [0 m, 0 m]", "headings: [0 deg, 90 deg, 180 deg]");
  ASSERT_TRUE(upright) << diagnostics_.to_text();
  constexpr double degree = std::numbers::pi / 180.0;
  const std::vector<double> expected = {0, 90 * degree, 180 * degree, 270 * degree, 330 * degree};
  ASSERT_EQ(turned->settings.headings.size(), expected.size());
  for (std::size_t h = 0; h < expected.size(); ++h) {
    EXPECT_NEAR(turned->settings.headings[h], expected[h], 1e-12);
  }
  HydrodynamicProblem same = *turned;
  same.settings.headings = upright->settings.headings;
  EXPECT_EQ(identity_of(same, {prepare_state(same, 0)}),
            identity_of(*upright, {prepare_state(*upright, 0)}));
  // The mass matrix of the printed periods is along the hull's own axes.
  EXPECT_EQ(prepare_state(*turned, 0).mass, prepare_state(*upright, 0).mass);
  EXPECT_NEAR(prepare_state(*turned, 0).panels.bodies[0].X_DB.p.x(), 0.0, 1e-12);
}

// As a case that computes for itself: what lies between two headings is interpolated.
TEST_F(HydrodynamicProblemOfFile, WavesComeFromEveryFiveDegrees) {
  const auto common = problem("position: [0 m, 0 m]", "panel_size: 4 m");
  ASSERT_TRUE(common) << diagnostics_.to_text();
  ASSERT_EQ(common->settings.headings.size(), 72U);
  EXPECT_NEAR(common->settings.headings[1] - common->settings.headings[0], std::numbers::pi / 36,
              1e-12);
  const auto none = problem("position: [0 m, 0 m]", "headings: []");
  ASSERT_TRUE(none) << diagnostics_.to_text();
  EXPECT_TRUE(none->settings.headings.empty());
}

TEST_F(HydrodynamicProblemOfFile, LidsMoveAlongAndDoNotTurn) {
  const std::string lids = "lids: [{from: [99 m, -1 m], to: [101 m, 1 m], rate: 0.1 rad/s}]";
  const auto moved = problem("position: [100 m, 0 m]", lids);
  ASSERT_TRUE(moved) << diagnostics_.to_text();
  EXPECT_EQ(moved->settings.lids.at(0).low, Eigen::Vector2d(-1, -1));
  EXPECT_FALSE(problem("position: [100 m, 0 m], heading: 30 deg", lids));
  EXPECT_THAT(diagnostics_.to_text(), HasSubstr("lies turned to them"));
}

}  // namespace
}  // namespace blocklift::pipeline
