// Single gusts and slack slings as a user meets them: what is said, and a run against its closed
// form.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/results_store.h"
#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/sling_over_edge_lift.h"

namespace blocklift::pipeline {
namespace {

using test::Outcome;
using test::run_blocklift;
using test::TemporaryFolder;
using test::text_of_file;
using test::with;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::string> warnings_in(const std::string& folder) {
  return nlohmann::json::parse(text_of_file(folder + "/summary.json"))
      .value("warnings", std::vector<std::string>());
}

TEST(GustCommand, SaysThatAGustComesAfterTheLift) {
  const TemporaryFolder folder;
  test::SampleLift lift;
  lift.lift_case +=
      "wind: {speed: 2 m/s, towards: 60 deg, "
      "gust: {magnitude: 3 m/s, start: 500 s, duration: 10 s}}\n";
  lift.write(folder);
  const Outcome late = run_blocklift("simulate case.yaml -o late");
  ASSERT_EQ(late.exit_code, 0) << late.err;
  EXPECT_THAT(warnings_in("late"),
              ::testing::Contains(StartsWith("The gust begins at 500 s, and the lift ends at ")));
  folder.write("case.yaml", with(lift.lift_case, "start: 500 s", "start: 1 s"));
  const Outcome felt = run_blocklift("simulate case.yaml -o felt");
  ASSERT_EQ(felt.exit_code, 0) << felt.err;
  EXPECT_THAT(warnings_in("felt"),
              ::testing::Not(::testing::Contains(HasSubstr("The gust begins"))));
}

// The force of a 1 - cosine gust of u = A (1 - cos w t)/2 on a body that hardly moves is
//   k u^2 = k A^2/4 (3/2 - 2 cos w t + cos(2 w t)/2),   k = 1.25/2 kg/m^3 x 1.2 x 2 m^2 = 1.5 kg/m,
// and each of its parts F cos n w t moves a mass on a spring from rest by
//   F / (K - m n^2 w^2) (cos n w t - cos p t),   p^2 = K/m.
// Within the gust x(t) has its largest value; after it the mass swings freely. Its own speed of up
// to 1.5e-4 m/s takes 2 v/u, 2e-5, of the force; samples miss the peak by up to (p 0.005 s)^2/2,
// 5e-6 of it.
TEST(GustCommand, MovesAMassOnASpringByItsClosedForm) {
  const TemporaryFolder folder;
  folder.write("gust.yaml", R"(mechanism: gust
bodies:
  sail: {mass: 10000 t, radii_of_gyration: [1 m, 1 m, 1 m], wind_areas: [{area: 2 m^2}]}
joints:
  guide: {kind: prismatic, child: sail, axis: [1, 0, 0]}
springs:
  s: {kind: joint, joint: guide, stiffness: 4 MN/m}
wind: {speed: 0 m/s, towards: 0 deg, gust: {magnitude: 20 m/s, start: 2 s, duration: 12 s}}
outputs:
  place: {joint: guide}
simulate: {duration: 30 s, relative_tolerance: 1e-12, sample_interval: 0.01 s}
)");
  const Outcome outcome = run_blocklift("simulate gust.yaml -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const ResultsReader results("out/results.h5");
  const Array<double> time = results.read("/time");
  const Array<double> place = results.read("/outputs/place");

  constexpr double m = 1e7, K = 4e6, T = 12, kAA_4 = 1.5 * 400 / 4;
  const double w = 2 * std::acos(-1.0) / T, p = std::sqrt(K / m);
  const auto displacement = [&](double t) {
    double x = 0;
    for (const auto& [share, n] : {std::pair(1.5, 0), {-2.0, 1}, {0.5, 2}})
      x += kAA_4 * share / (K - m * n * n * w * w) * (std::cos(n * w * t) - std::cos(p * t));
    return x;
  };
  const auto velocity = [&](double t) {
    return (displacement(t + 1e-5) - displacement(t - 1e-5)) / 2e-5;
  };
  double due = 0, found = 0, lowest = 0;
  for (std::size_t i = 0; i < time.rows(); ++i) {
    const double t = time(i) - 2;
    if (t >= 0 && t <= T) due = std::max(due, displacement(t));
    found = std::max(found, place(i));
    lowest = std::min(lowest, place(i));
  }
  EXPECT_NEAR(found, due, 3e-5 * due);
  const double amplitude = std::hypot(displacement(T), velocity(T) / p);
  EXPECT_NEAR(-lowest, amplitude, 5e-5 * amplitude);
}

// The basket along the box is too long: the other bears it all, and the box could slide through it.
TEST(SlackBasketCommand, SaysThatNothingHoldsTheLoad) {
  const TemporaryFolder folder;
  test::SampleLift lift = test::basket_lift();
  lift.lift_case = with(lift.lift_case, "length: 10.24 m", "length: 10.6 m");
  const std::size_t carry = lift.lift_case.find("  - stage: carry");
  lift.lift_case =
      with(lift.lift_case.substr(0, carry), "by: -0.5 m", "by: -0.05 m") + "settle: 0.5 s\n";
  lift.write(folder);
  const Outcome outcome = run_blocklift("simulate case.yaml -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(warnings_in("out"),
              ::testing::Contains(
                  ::testing::AllOf(StartsWith("Nothing holds the load in the equilibrium of 0 s"),
                                   HasSubstr("Slack there: R2."))));
}

}  // namespace
}  // namespace blocklift::pipeline
