// `blocklift simulate` as a user meets it: run as a process, its results read back.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/formats/results_store.h"
#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::run_blocklift;
using test::TemporaryFolder;
using test::text_of_file;
using test::with;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string samples = BLOCKLIFT_MECHANISMS;

// A crank of half the length: the slider goes between rod and crank, and rod less crank.
TEST(SimulateCommand, SetsKeysOfAMechanism) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_blocklift("simulate " + samples + "/slider-crank --set 'parameters.crank=0.1 m' -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const ResultsReader results("out/results.h5");
  const Array<double> slider = results.read("/outputs/slider");
  EXPECT_NEAR(slider(0), 0.6, 1e-8);
  EXPECT_NEAR(slider(100), 0.4, 1e-8);  // half a turn, at 0.5 s
  const Outcome missing =
      run_blocklift("simulate " + samples + "/slider-crank --set 'parameters.cank=0.1 m' -o no");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err,
              StartsWith("--set parameters.cank=0.1 m: error: there is no parameters.cank"));
  EXPECT_FALSE(fs::exists("no"));
}

TEST(SimulateCommand, WritesTheSliderCrankAsItsClosedFormHasIt) {
  const TemporaryFolder folder;
  const Outcome outcome = run_blocklift("simulate " + samples + "/slider-crank --csv -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("loops: loop \"wrist_pin\", displacement along y, repeats"));
  EXPECT_THAT(outcome.out, HasSubstr("results: out/results.h5\ntable: out/results.csv\n"));

  const ResultsReader results("out/results.h5");
  const Array<double> time = results.read("/time");
  const Array<double> slider = results.read("/outputs/slider");
  EXPECT_EQ(results.read_meaning("/outputs/slider").units, "m");
  EXPECT_EQ(results.read_meaning("/outputs/wrist_pin").units, "N m, N m, N m, N, N, N");
  EXPECT_EQ(results.read_text_attribute("/outputs/wrist_pin", "columns"),
            "moment_x, moment_y, moment_z, force_x, force_y, force_z");
  EXPECT_GT(results.read_number_attribute("/statistics", "steps"), 0);
  EXPECT_GT(results.read_number_attribute("/statistics", "right_hand_sides"), 0);
  ASSERT_EQ(time.rows(), 401U);
  const Array<double> force = results.read("/outputs/wrist_pin");
  const Array<double> acceleration = results.read("/outputs/slider_acceleration");
  for (std::size_t i = 0; i < time.rows(); ++i) {
    const double angle = 2 * std::acos(-1.0) * time(i);
    const double x = 0.2 * std::cos(angle) + std::sqrt(0.25 - std::pow(0.2 * std::sin(angle), 2));
    ASSERT_NEAR(slider(i), x, 1e-8) << "at " << time(i) << " s";
    ASSERT_NEAR(force(i, 3), 1.5 * acceleration(i), 1e-8);  // Newton's law for the slider
  }
}

TEST(SimulateCommand, KeepsTheEnergyOfTheDoublePendulumAndWritesItAsCsv) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_blocklift("simulate " + samples + "/double-pendulum/mechanism.yaml --csv");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream csv(text_of_file("results/double-pendulum/results.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line,
            "time [s],shoulder [rad],elbow [rad],elbow_rate [rad/s],tip.x [m],tip.y [m],tip.z "
            "[m],energy [J]");
  double first = NAN;
  int rows = 0;
  while (std::getline(csv, line)) {
    const double energy = std::stod(line.substr(line.rfind(',') + 1));
    if (std::isnan(first)) first = energy;
    ASSERT_NEAR(energy, first, 1e-5) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 501);
}

TEST(SimulateCommand, StartsTheLuffingCraneAtRestAndAccountsForItsEnergy) {
  const TemporaryFolder folder;
  const Outcome outcome = run_blocklift("simulate " + samples + "/luffing-crane");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("rope pendant: at most "));
  EXPECT_FALSE(fs::exists("results/luffing-crane/results.csv"));
  const ResultsReader results("results/luffing-crane/results.h5");
  const Array<double> hoist = results.read("/outputs/hoist");
  EXPECT_NEAR(hoist(0), 12000 * 9.80665, 1e-3);
  // The works of winches and drive turn over some 1e6 J.
  for (const double imbalance : results.read("/outputs/imbalance").values)
    EXPECT_LT(std::abs(imbalance), 10);
  // It starts at rest, so that its natural motions are told; and everything is drawn.
  EXPECT_THAT(outcome.out, HasSubstr("natural periods at the start: "));
  EXPECT_TRUE(results.has("/modes/1/names"));
  EXPECT_TRUE(results.has("/scene/bodies/boom/boxes"));
  EXPECT_TRUE(results.has("/dynamic/bodies/boom/pose"));
  const std::string summary = text_of_file("results/luffing-crane/summary.json");
  EXPECT_THAT(summary, HasSubstr("\"natural_periods\""));
  EXPECT_THAT(summary, HasSubstr("\"jacobians\""));
  EXPECT_THAT(summary, Not(HasSubstr("\"verdict\"")));
  EXPECT_TRUE(fs::exists("results/luffing-crane/report.html"));
}

// A box turned by a quarter about z and one body without shapes, for which bars stand.
TEST(SimulateCommand, DrawsShapesAsTheyAreTurnedAndBarsForTheOthers) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", R"(mechanism: drawn
bodies:
  arm: {mass: 1 kg, inertia: {xx: 1 kg m^2, yy: 1 kg m^2, zz: 1 kg m^2}, shapes: [{box: [3 m, 1 m, 1 m], centre: [1 m, 0 m, 0 m], orientation: [0 deg, 0 deg, 90 deg]}]}
  rod: {mass: 1 kg, centre_of_mass: [0 m, 2 m, 0 m], inertia: {xx: 1 kg m^2, yy: 1 kg m^2, zz: 1 kg m^2}}
joints:
  A: {kind: revolute, child: arm, axis: [0, 1, 0]}
  B: {kind: revolute, parent: arm, child: rod}
simulate: {duration: 0.1 s}
)");
  const Outcome outcome = run_blocklift("simulate mechanism.yaml -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const ResultsReader results("out/results.h5");
  const Array<double> box = results.read("/scene/bodies/arm/boxes");
  ASSERT_EQ(box.rows(), 1U);
  const double half = std::sqrt(0.5);
  const std::vector<double> due = {3, 1, 1, 1, 0, 0, half, 0, 0, half};
  for (std::size_t i = 0; i < due.size(); ++i) EXPECT_NEAR(box(0, i), due[i], 1e-15) << i;
  const Array<double> bar = results.read("/scene/bodies/rod/boxes");
  ASSERT_EQ(bar.rows(), 1U);
  EXPECT_NEAR(bar(0, 0), 2, 1e-15);  // as long as the way to the centre of mass
  EXPECT_NEAR(bar(0, 4), 1, 1e-15);  // and half-way along it
}

// A chain between level ends, L = 2 a sinh(X / 2 a) with a = 200 m: w a cosh(X / 2 a) at either.
// Asked for or not, tensions of moorings and tuggers are among the results.
TEST(SimulateCommand, TellsTheTensionsOfMooringsAndTuggers) {
  const TemporaryFolder folder;
  const std::string lines = R"(mechanism: lines
bodies:
  hung: {mass: 2 t, radii_of_gyration: [1 m, 1 m, 1 m]}
  float: {mass: 1000 t, radii_of_gyration: [1 m, 1 m, 1 m]}
joints:
  rail: {kind: prismatic, child: hung}
  slide: {kind: prismatic, child: float, axis: [1, 0, 0]}
moorings:
  chain: {anchor: {body: world, position: [-100 m, 0 m, 0 m]}, fairlead: {body: float}, length: 101.04492672 m, submerged_mass: 10 kg/m, axial_stiffness: 1000000 MN, on_seabed: false}
tuggers:
  tail: {from: {body: world, position: [0 m, 0 m, 10 m]}, to: {body: hung}, tension: 20 kN}
simulate: {duration: 0.1 s, sample_interval: 0.1 s}
)";
  folder.write("all.yaml", lines);
  folder.write("asked.yaml", lines + "outputs: {chain_tension: {rope: chain}}\n");
  for (const std::string name : {"all", "asked"}) {
    const Outcome outcome = run_blocklift("simulate " + name + ".yaml -o " + name);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const ResultsReader results(name + "/results.h5");
    const double due = 10 * 9.80665 * 200 * std::cosh(0.25);
    EXPECT_NEAR(results.read("/outputs/chain_tension")(0), due, 1e-4 * due);
  }
  EXPECT_NEAR(ResultsReader("all/results.h5").read("/outputs/tail_tension")(0), 20e3, 1e-6);

  folder.write("wrong.yaml", lines + "outputs: {s: {rope: chain, quantity: length}}\n");
  EXPECT_THAT(run_blocklift("simulate wrong.yaml").err,
              HasSubstr("output s asks for the length of chain, a mooring or tugger\n"
                        "    ask for its tension, or leave quantity out"));
}

TEST(SimulateCommand, RunsARobotDescription) {
  const TemporaryFolder folder;
  folder.write("arm.urdf", R"(<robot name="arm">
  <link name="base"/>
  <link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="1"/>
    <inertia ixx="0" ixy="0" ixz="0" iyy="0.08333333" iyz="0" izz="0.08333333"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
  <transmission name="t"/>
</robot>
)");
  const Outcome outcome = run_blocklift("simulate arm.urdf");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("note: links base have no inertia and count as massless\n"));
  EXPECT_THAT(outcome.out, HasSubstr("note: elements <transmission> play no part\n"));
  EXPECT_THAT(outcome.out, HasSubstr("note: link base stands fixed in the world\n"));
  EXPECT_THAT(outcome.out, HasSubstr("hinge_position"));
}

TEST(SimulateCommand, SimulatesALiftCaseWithoutItsStress) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_blocklift(std::string("simulate ") + BLOCKLIFT_SMALL_LIFT + " --csv -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const ResultsReader results("out/results.h5");
  EXPECT_TRUE(results.has("/static/ropes/R1/tension"));
  EXPECT_TRUE(results.has("/dynamic/bodies/load/pose"));
  EXPECT_FALSE(results.has("/structure"));
  EXPECT_GT(results.read_number_attribute("/statistics", "steps"), 0);
  EXPECT_THAT(text_of_file("out/results.csv"), StartsWith("time [s],"));
  EXPECT_THAT(text_of_file("out/results.csv"), HasSubstr("R1.tension [N]"));
  EXPECT_TRUE(results.has("/modes/1/names"));
  EXPECT_THAT(text_of_file("out/summary.json"), HasSubstr("\"natural_periods\""));
  EXPECT_THAT(text_of_file("out/summary.json"), Not(HasSubstr("\"verdict\"")));
  EXPECT_TRUE(fs::exists("out/report.html"));
}

TEST(SimulateCommand, TellsWrongInputBeforeItRuns) {
  const TemporaryFolder folder;
  const std::string pendulum = text_of_file(samples + "/double-pendulum/mechanism.yaml");
  folder.write("wrong.yaml", with(with(pendulum, "{joint: shoulder}", "{joint: sholder}"),
                                  "duration: 5 s", "duration: 5 m"));
  const Outcome outcome = run_blocklift("simulate wrong.yaml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("error: duration \"5 m\" is a length; a time is due, for example"));
  EXPECT_THAT(
      outcome.err,
      HasSubstr("error: output shoulder names joint \"sholder\", which the mechanism does "
                "not have\n    its joints are shoulder, elbow; did you mean \"shoulder\"?"));
  EXPECT_THAT(outcome.err, HasSubstr("2 errors\n"));
  EXPECT_FALSE(fs::exists("results"));
}

TEST(SimulateCommand, TellsWhatItTakes) {
  const TemporaryFolder folder;
  folder.write("rope.yaml", test::sample_rope);
  const Outcome rope = run_blocklift("simulate rope.yaml");
  EXPECT_EQ(rope.exit_code, 2);
  EXPECT_THAT(rope.err, HasSubstr("this file describes a part, which does nothing by itself"));
  const Outcome nothing = run_blocklift("simulate nothing.yaml");
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("nothing.yaml: error: there is no such file"));
}

TEST(SimulateCommand, LeavesResultsAsTheyAreWhereItCannotWrite) {
  const TemporaryFolder folder;
  folder.write("out", "a file of mine");
  const Outcome outcome = run_blocklift("simulate " + samples + "/double-pendulum -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("results cannot be written here"));
  EXPECT_EQ(text_of_file("out"), "a file of mine");
}

TEST(SimulateCommand, ValidateTakesMechanismsToo) {
  const TemporaryFolder folder;
  const Outcome outcome = run_blocklift("validate " + samples + "/luffing-crane " + samples +
                                        "/slider-crank/mechanism.yaml");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("valid, mechanism luffing-crane with 3 bodies, 3 joints and 0 loops"));
  EXPECT_THAT(outcome.out,
              HasSubstr("valid, mechanism slider-crank with 3 bodies, 3 joints and 1 loop\n"));
}

}  // namespace
}  // namespace blocklift::pipeline
