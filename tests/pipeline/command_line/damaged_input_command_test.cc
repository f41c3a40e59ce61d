// The program with damaged files, full disks and places that cannot be written: run as a process.

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::run_blocklift;
using test::TemporaryFolder;
using test::text_of_file;
using ::testing::AllOf;
using ::testing::HasSubstr;

// A weight on a spring.
constexpr auto mechanism = R"(mechanism: spring
bodies:
  a: {mass: 1 t, radii_of_gyration: [1 m, 1 m, 1 m]}
joints:
  a: {kind: prismatic, child: a, axis: [0, 0, 1]}
springs:
  s: {kind: joint, joint: a, stiffness: 100 kN/m}
simulate: {duration: 20 s, relative_tolerance: 1e-6, sample_interval: 0.01 s}
outputs:
  a: {joint: a}
)";

// A cube of one element, in the format of Gmsh that is told.
std::string cube(const std::string& version, const std::string& solid, const std::string& corner) {
  return "$MeshFormat\n" + version +
         " 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"bottom\"\n2 2 \"top\"\n3 3 \"cube\"\n"
         "$EndPhysicalNames\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n"
         "7 1 1 1\n8 " +
         corner + "\n$EndNodes\n$Elements\n3\n1 3 2 1 1 1 2 3 4\n2 3 2 2 2 5 6 7 8\n" + solid +
         "\n$EndElements\n";
}

constexpr auto sound_solid = "3 5 2 3 1 1 2 3 4 5 6 7 8";

constexpr auto part = R"(part: cube
mesh: {file: cube.msh, length_unit: m}
materials:
  steel: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, yield_stress: 355 MPa, density: 7850 kg/m^3}
supports:
  bottom: {groups: [bottom], fixed: [x, y, z]}
loads:
  top: {groups: [top], pressure: 1 MPa}
)";

// A disk that is full is told by a limit of files' sizes, in blocks of 1 kB: writing fails so.
TEST(FullDisk, EndsWithAMessageAndEarlierResultsStay) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", mechanism);
  ASSERT_EQ(run_blocklift("simulate mechanism.yaml -o results").exit_code, 0);
  const std::string before = text_of_file("results/summary.json");
  for (const char* blocks : {"1", "8", "40", "100"}) {
    const Outcome outcome =
        test::run_command(std::string("trap '' XFSZ; ulimit -f ") + blocks + "; '" +
                          BLOCKLIFT_EXECUTABLE + "' simulate mechanism.yaml -o results");
    EXPECT_EQ(outcome.exit_code, 1) << blocks;
    EXPECT_THAT(outcome.err, HasSubstr("results.h5")) << blocks;
    EXPECT_EQ(text_of_file("results/summary.json"), before);
    EXPECT_FALSE(fs::exists("results/.in-preparation"));
  }
}

TEST(StandardOutput, ThatCannotBeWrittenIsAFailure) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", mechanism);
  for (const char* arguments : {"validate mechanism.yaml", "schema", "verify --list"}) {
    const Outcome outcome = test::run_command(std::string("'") + BLOCKLIFT_EXECUTABLE + "' " +
                                              arguments + " > /dev/full");
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr("blocklift: error: ")) << arguments;
  }
}

TEST(Output, ThatCannotBeWrittenIsRefusedBeforeTheWork) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", mechanism);
  folder.write("file", "");
  for (const std::string& place :
       {std::string("/proc/blocklift"), std::string("file/below"), std::string(300, 'x')}) {
    const Outcome outcome = run_blocklift("simulate mechanism.yaml -o " + place);
    EXPECT_EQ(outcome.exit_code, 2) << place;
    EXPECT_THAT(outcome.err, HasSubstr("results cannot be written here")) << place;
  }
  EXPECT_FALSE(fs::exists("results"));
}

TEST(Output, AVerdictIsNotLostToASimulation) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", mechanism);
  folder.write("lift/summary.json", R"({"case": "lift", "verdict": "pass"})");
  const Outcome outcome = run_blocklift("simulate mechanism.yaml -o lift");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("lift: error: the folder holds the assessment of a lift"));
  EXPECT_EQ(nlohmann::json::parse(text_of_file("lift/summary.json"))["verdict"], "pass");
}

TEST(Report, IsNotMadeOfTwoRuns) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", mechanism);
  ASSERT_EQ(run_blocklift("simulate mechanism.yaml -o one").exit_code, 0);
  ASSERT_EQ(run_blocklift("simulate mechanism.yaml -o other").exit_code, 0);
  EXPECT_EQ(run_blocklift("report one").exit_code, 0);
  fs::copy_file("other/summary.json", "one/summary.json", fs::copy_options::overwrite_existing);
  const Outcome outcome = run_blocklift("report one");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("results.h5 and summary.json are of different runs"));
}

TEST(Simulation, FarTooFastEndsWithAWord) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", R"(mechanism: spin
bodies:
  a: {mass: 1 t, radii_of_gyration: [1 m, 2 m, 2 m]}
joints:
  a: {kind: free, child: a}
initial:
  velocities: {a: [0 m/s, 0 m/s, 0 m/s, 0 rad/s, 1.5e8 rad/s, 1 rad/s]}
simulate: {duration: 10 s, relative_tolerance: 1e-6}
)");
  const Outcome outcome = run_blocklift("simulate mechanism.yaml -o results");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("failed at t = "), HasSubstr("something moves far too fast")));
}

TEST(Validate, OneFileDoesNotHushUpAnother) {
  const TemporaryFolder folder;
  const std::string shared = R"(
gravity: 9.81 m/s^2
load: {model: plate}
load_table: {direction: [0, 0, 1], static: {L1: 1 t}, dynamic: {L1: 1 t}}
)";
  folder.write("plate.yaml", "kind: block\nmass: much\n");
  folder.write("one.yaml", "case: one" + shared);
  folder.write("other.yaml", "case: other" + shared);
  const Outcome outcome = run_blocklift("validate one.yaml other.yaml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
}

TEST(Validate, RefusesAHullOfTooManyPanelsAtOnce) {
  const TemporaryFolder folder;
  folder.write("vessel.yaml", R"(kind: vessel
hull: {barge: {length: 40 m, breadth: 20 m, depth: 100 km}}
panel_size: 1 m
mass: 1640 t
centre_of_mass: [0 m, 0 m, 3 m]
radii_of_gyration: [6 m, 11 m, 11 m]
)");
  const Outcome outcome = run_blocklift("validate vessel.yaml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("vessel.yaml:1:1: error: a hull of 40 x 20 x 100000 m"),
                                 HasSubstr("1.2e+07 panels")));
}

TEST(DamagedMesh, IsRefusedByItsName) {
  const TemporaryFolder folder;
  folder.write("part.yaml", part);
  const auto outcome_of = [&](const std::string& mesh) {
    folder.write("cube.msh", mesh);
    return run_blocklift("stress part.yaml -o results");
  };
  EXPECT_EQ(outcome_of(cube("2.2", sound_solid, "0 1 1")).exit_code, 0);
  const std::string bad_meshes[] = {
      cube("2.2", sound_solid, "0 nan 1"),
      cube("2.2", sound_solid, "0 -inf 1"),
      cube("2.2", sound_solid, "0 1e400 1"),
      cube("2.2", "3 5 2 3 1 1 2 3 4 5 6 7 2147483648", "0 1 1"),
      cube("2.2", "3 5 -2 3 1 1 2 3 4 5 6 7 8", "0 1 1"),
      cube("4.1", sound_solid, "0 1 1"),  // a crash of Gmsh
  };
  for (const std::string& mesh : bad_meshes) {
    const Outcome outcome = outcome_of(mesh);
    EXPECT_EQ(outcome.exit_code, 2) << mesh;
    EXPECT_THAT(outcome.err, HasSubstr("part.yaml:2:14: error: "));
  }
}

}  // namespace
}  // namespace blocklift::pipeline
