// `blocklift hydro` as a user meets it: run as a process.
#include <complex>
#include <filesystem>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"
#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/hydrodynamics/own_cache.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string pontoon =
    "kind: vessel\n"
    "hull: {barge: {length: 12 m, breadth: 8 m, depth: 4 m}}\n"
    "panel_size: 1 m\n"
    "mass: 150 t\n"
    "centre_of_mass: [0 m, 0 m, 2 m]\n"
    "radii_of_gyration: [3 m, 4 m, 4 m]\n"
    "hydrodynamics:\n"
    "  frequencies: {lowest: 1.5 rad/s, highest: 3 rad/s, count: 4}\n"
    "  headings: [0 deg, 90 deg]\n";

class HydroCommand : public ::testing::Test {
 protected:
  HydroCommand() { folder_.write("pontoon/vessel.yaml", pontoon); }

  static Outcome run(const std::string& arguments) {
    return test::run_blocklift("hydro " + arguments);
  }
  /// What is said of the pontoon's file with a passage changed.
  std::string complaint(const std::string& from, const std::string& to) const {
    std::string text = pontoon;
    text.replace(text.find(from), from.size(), to);
    folder_.write("changed/vessel.yaml", text);
    const Outcome outcome = run("changed/vessel.yaml -o changed.h5");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_FALSE(fs::exists("changed.h5"));
    return outcome.err;
  }

  test::OwnCache cache_;
  test::TemporaryFolder folder_;  // the working directory
};

TEST_F(HydroCommand, ComputesOnceAndConverts) {
  const Outcome first = run("pontoon/vessel.yaml -o db.h5");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, AllOf(HasSubstr("panels on the bodies"), HasSubstr("a quarter of"),
                               HasSubstr("GB of memory"), HasSubstr("added mass"),
                               HasSubstr("natural period, s"), HasSubstr("response, m/m"),
                               HasSubstr("database: db.h5")));
  EXPECT_THAT(test::text_of_file("db.html"), AllOf(HasSubstr("<svg"), HasSubstr("retardation")));
  EXPECT_THAT(first.err, ::testing::MatchesRegex(test::only_progress));
  const Outcome second = run("pontoon -o db.h5");
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_THAT(second.out, AllOf(HasSubstr("already computed: db.h5"), Not(HasSubstr("of memory"))));
  folder_.write("pontoon/vessel.yaml", pontoon + "  water_depth: 20 m\n");
  EXPECT_THAT(run("pontoon -o db.h5").out, HasSubstr("database: db.h5"));
  EXPECT_EQ(run("--import db.h5 --export bemio -o wec.h5").exit_code, 0);
  EXPECT_THAT(run("--import db.h5 --export wamit -o wec.1").out,
              AllOf(HasSubstr("wec.1, wec.3"), HasSubstr("about the origin")));
  EXPECT_THAT(run("--import db.h5 --export wamit --wamit-length 20 -o long.1").out,
              AllOf(HasSubstr("(ULEN 20 m)"), HasSubstr("--wamit-length=20")));
  EXPECT_THAT(run("--import wec.h5 -o back.h5").out, HasSubstr("imported from wec.h5 (BEMIO)"));
  EXPECT_THAT(run("--import wec.1 --water-depth 20 -o back.h5").out,
              HasSubstr("imported from wec.1 (WAMIT)"));
  const Outcome unknown = run("--import wec.1 --water-depth 20 --export bemio -o no.h5");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("disp_vol"), HasSubstr("export to wamit")));
}

// What the panels give is kept, and its file written again from there, to the last bit.
TEST_F(HydroCommand, TakesFromTheCacheWhatItComputedBefore) {
  folder_.write("pontoon/vessel.yaml", pontoon + "  draughts: [1 m, 1.5 m]\n");
  const Outcome first = run("pontoon -o first.h5");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, Not(HasSubstr("from the cache")));
  EXPECT_EQ(cache_.entries().size(), 2U);
  const Outcome second = run("pontoon -o second.h5");
  EXPECT_THAT(second.out, AllOf(HasSubstr("pontoon at a draught of 1.000 m: from the cache,"),
                                HasSubstr("pontoon at a draught of 1.500 m: from the cache,"),
                                HasSubstr("database: second.h5")));
  EXPECT_TRUE(test::text_of_file("first.h5") == test::text_of_file("second.h5"));
  // One more draught is all that is computed.
  folder_.write("pontoon/vessel.yaml", pontoon + "  draughts: [1 m, 1.2 m, 1.5 m]\n");
  EXPECT_THAT(run("pontoon -o more.h5").out,
              AllOf(HasSubstr("1.500 m: from the cache"), Not(HasSubstr("1.200 m: from"))));
  const Outcome anew = run("pontoon -o more.h5 --no-cache");
  EXPECT_THAT(anew.out, AllOf(HasSubstr("database: more.h5"), Not(HasSubstr("from the cache"))));
  EXPECT_EQ(cache_.entries().size(), 3U);
}

// Both methods agree but for their panels' errors, and one's database is not taken for the other's.
TEST_F(HydroCommand, ComputesByTheMethodThatIsAskedFor) {
  ASSERT_EQ(run("pontoon/vessel.yaml -o marched.h5").exit_code, 0);
  fs::copy("marched.h5", "hulls.h5");
  folder_.write("pontoon/vessel.yaml", pontoon + "  method: green function\n");
  const Outcome outcome = run("pontoon -o hulls.h5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("0 on the surface"), HasSubstr("wave Green function"),
                    HasSubstr("error of retardation functions"), HasSubstr("database: hulls.h5")));
  EXPECT_THAT(run("pontoon -o hulls.h5").out, HasSubstr("already computed"));
  const auto marched = read_hydrodynamic_file("marched.h5").series.databases[0];
  const auto hulls = read_hydrodynamic_file("hulls.h5").series.databases[0];
  for (std::size_t k = 0; k < marched.frequencies.size(); ++k) {
    for (const int mode : {0, 2, 4}) {
      const double w = marched.frequencies[k];
      const std::complex<double> one(marched.damping[k](mode, mode),
                                     w * marched.added_mass[k](mode, mode));
      const std::complex<double> other(hulls.damping[k](mode, mode),
                                       w * hulls.added_mass[k](mode, mode));
      EXPECT_LT(std::abs(one - other), 0.1 * std::abs(other)) << w << " rad/s, mode " << mode;
    }
  }
  EXPECT_THAT(complaint("  headings:", "  method: green functions\n  headings:"),
              HasSubstr("green function"));
}

TEST_F(HydroCommand, ComputesSeveralVesselsTogether) {
  folder_.write("pair.yaml",
                "kind: vessels\n"
                "vessels:\n"
                "  left: {vessel: pontoon, position: [0 m, -6 m]}\n"
                "  right: {vessel: pontoon, position: [0 m, 6 m], draughts: [1 m, 1.5 m]}\n"
                "hydrodynamics:\n"
                "  frequencies: {lowest: 1.5 rad/s, highest: 3 rad/s, count: 4}\n");
  const Outcome outcome = run("pair.yaml -o pair.h5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("draught 1.000 m"), HasSubstr("draught 1.500 m"),
                                 HasSubstr("left, right at a draught of 1.000 m, "),
                                 HasSubstr("right, draught 1.500 m, ")));
  folder_.write("crash.yaml",
                "kind: vessels\n"
                "vessels:\n"
                "  left: {vessel: pontoon, position: [0 m, -3 m]}\n"
                "  right: {vessel: pontoon, position: [0 m, 3 m]}\n"
                "  third: {vessel: pontoom, position: [40 m, 3 m]}\n");
  const Outcome unknown = run("crash.yaml -o crash.h5");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("crash.yaml:5"), HasSubstr("pontoom")));
  std::string text = test::text_of_file("crash.yaml");
  folder_.write("crash.yaml", text.substr(0, text.find("  third")));
  const Outcome crash = run("crash.yaml -o crash.h5");
  EXPECT_EQ(crash.exit_code, 2);
  EXPECT_THAT(crash.err, AllOf(HasSubstr("crash.yaml:4:3: error: vessel left and vessel right "
                                         "intersect, at ("),
                               HasSubstr("move one of them")));
}

// Waves from ahead press the pontoon back; a pair has no drift of each.
TEST_F(HydroCommand, ComputesMeanDriftOfASingleVessel) {
  folder_.write("pontoon/vessel.yaml", pontoon + "  mean_drift: true\n");
  const Outcome outcome = run("pontoon -o db.h5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("mean drift, kN/m2, kN m/m2"));
  ASSERT_EQ(run("--import db.h5 --export wamit -o wec.1").exit_code, 0);
  std::istringstream lines(test::text_of_file("wec.8"));
  double period = 0, heading = 0, other = 0, modulus = 0, phase = 0, real = 0, imaginary = 0;
  int mode = 0, from_astern = 0;
  while (lines >> period >> heading >> other >> mode >> modulus >> phase >> real >> imaginary) {
    if (mode != 1 || heading != 0.0) continue;
    EXPECT_GT(real, 0.0) << period;
    ++from_astern;
  }
  EXPECT_EQ(from_astern, 4);
  EXPECT_THAT(run("pontoon -o db.h5").out, HasSubstr("already computed"));
  folder_.write("pair.yaml",
                "kind: vessels\n"
                "vessels:\n"
                "  left: {vessel: pontoon, position: [0 m, -6 m]}\n"
                "  right: {vessel: pontoon, position: [0 m, 6 m]}\n"
                "hydrodynamics: {mean_drift: true}\n");
  const Outcome pair = run("pair.yaml -o pair.h5");
  EXPECT_EQ(pair.exit_code, 2);
  EXPECT_THAT(pair.err, HasSubstr("that of all together only"));
}

// Apart at the water line, and in each other's way below it.
TEST_F(HydroCommand, RefusesBodiesThatIntersectBelowTheWater) {
  // A box from 1 m below the water's surface to 1 m above it, and one that is 8 m wide below 1.2 m.
  folder_.write("bulb/hull.gdf",
                "bulb\n1 9.80665\n0 0\n9\n"
                "-2 -4 -3  -2 4 -3  2 4 -3  2 -4 -3\n"
                "-2 -4 -3  2 -4 -3  2 -1 -1.2  -2 -1 -1.2\n"
                "2 4 -3  -2 4 -3  -2 1 -1.2  2 1 -1.2\n"
                "2 -4 -3  2 4 -3  2 1 -1.2  2 -1 -1.2\n"
                "-2 4 -3  -2 -4 -3  -2 -1 -1.2  -2 1 -1.2\n"
                "-2 -1 -1.2  2 -1 -1.2  2 -1 1  -2 -1 1\n"
                "2 1 -1.2  -2 1 -1.2  -2 1 1  2 1 1\n"
                "2 -1 -1.2  2 1 -1.2  2 1 1  2 -1 1\n"
                "-2 1 -1.2  -2 -1 -1.2  -2 -1 1  -2 1 1\n");
  folder_.write("bulb/vessel.yaml",
                "kind: vessel\nhull: {mesh: {file: hull.gdf, close_openings: true}}\n"
                "panel_size: 4 m\nmass: 50 t\n"
                "centre_of_mass: [0 m, 0 m, -2 m]\nradii_of_gyration: [2 m, 1 m, 2 m]\n");
  const auto pair = [&](const std::string& distance) {
    folder_.write("pair.yaml",
                  "kind: vessels\nvessels:\n"
                  "  a: {vessel: bulb, position: [0 m, 0 m]}\n"
                  "  b: {vessel: bulb, position: [0 m, " +
                      distance +
                      "]}\n"
                      "hydrodynamics:\n"
                      "  frequencies: {lowest: 0.8 rad/s, highest: 1 rad/s, count: 2}\n");
    return run("pair.yaml -o pair.h5");
  };
  const Outcome outcome = pair("5 m");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_THAT(outcome.err,
              HasSubstr("pair.yaml:4:3: error: vessel a and vessel b intersect, at ("));
  EXPECT_EQ(pair("9 m").exit_code, 0);
}

// What other programs' databases lack, or have in other units, is told.
TEST_F(HydroCommand, DoubtsWhatItTakesOver) {
  const std::string settings = pontoon.substr(0, pontoon.find("  frequencies"));
  folder_.write("pontoon/vessel.yaml",
                settings +
                    "  frequencies: {lowest: 0.5 rad/s, highest: 2.5 rad/s, count: 6}\n"
                    "  headings: [0 deg, 30 deg, 60 deg, 90 deg]\n");
  ASSERT_EQ(run("pontoon/vessel.yaml -o db.h5").exit_code, 0);
  ASSERT_EQ(run("--import db.h5 --export wamit -o wec.1").exit_code, 0);
  const Outcome right = run("--import wec.1 -o back.h5");
  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_THAT(right.out, Not(HasSubstr("contradict")));
  EXPECT_THAT(right.out, Not(HasSubstr("long waves")));
  const Outcome scaled = run("--import wec.1 --wamit-length 4 -o back.h5");
  EXPECT_THAT(scaled.out, HasSubstr("warning: damping and excitation contradict each other"));
  fs::remove("wec.3");
  const Outcome calm = run("--import wec.1 -o back.h5");
  EXPECT_EQ(calm.exit_code, 0);
  EXPECT_THAT(calm.out, HasSubstr("warning: wec.1: holds no force of waves"));
}

// Databases of other programs, spoilt.
TEST_F(HydroCommand, RefusesImportsWithoutNumbersOrFrequencies) {
  ASSERT_EQ(run("pontoon/vessel.yaml -o db.h5").exit_code, 0);
  ASSERT_EQ(run("--import db.h5 --export wamit -o wec.1").exit_code, 0);
  const std::string masses = test::text_of_file("wec.1");
  const std::string forces = test::text_of_file("wec.3");
  const auto import_with = [&](const std::string& changed_masses,
                               const std::string& changed_forces) {
    folder_.write("bad.1", changed_masses);
    folder_.write("bad.3", changed_forces);
    const Outcome outcome = run("--import bad.1 -o bad.h5");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_FALSE(fs::exists("bad.h5"));
    return outcome.err;
  };
  // The fourth number of the third line.
  std::string with_nan = masses;
  const std::size_t third = with_nan.find('\n', with_nan.find('\n') + 1) + 1;
  const std::size_t end = with_nan.find('\n', third);
  with_nan.replace(with_nan.rfind(' ', end) + 1, end - with_nan.rfind(' ', end) - 1, "NaN");
  EXPECT_THAT(import_with(with_nan, forces), HasSubstr("bad.1:3: \"NaN\" is not finite"));
  // The excitation at one heading lacks its first frequency: six lines, one a mode.
  std::size_t seventh = 0;
  for (int line = 0; line < 6; ++line) seventh = forces.find('\n', seventh) + 1;
  EXPECT_THAT(import_with(masses, forces.substr(seventh)), HasSubstr("frequencies are missing"));
}

// Water between a ring and its spar swings from side to side hardly damped: with a lid the same
// file is another problem, and its spar's damping in surge no longer passes below zero.
TEST_F(HydroCommand, LidsDampTheWaterInAGap) {
  const std::string pair =
      "kind: vessels\n"
      "vessels:\n"
      "  float: {vessel: vessels/absorber-float, position: [0 m, 0 m]}\n"
      "  spar: {vessel: vessels/absorber-spar, position: [0 m, 0 m]}\n"
      "hydrodynamics:\n"
      "  frequencies: {lowest: 0.5 rad/s, highest: 2.0 rad/s, count: 16}\n";
  const auto lowest_damping = [&] {
    double lowest = 0.0;
    for (const Eigen::MatrixXd& damping : read_hydrodynamic_database("pair.h5").damping) {
      lowest = std::min(lowest, damping(6, 6));
    }
    return lowest;
  };
  folder_.write("pair.yaml", pair);
  ASSERT_EQ(run("pair.yaml -o pair.h5").exit_code, 0);
  EXPECT_LT(lowest_damping(), -1e5);
  folder_.write("pair.yaml",
                pair + "  lids: [{from: [-4.5 m, -4.5 m], to: [4.5 m, 4.5 m], rate: 0.1 rad/s}]\n");
  const Outcome outcome = run("pair.yaml -o pair.h5");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, Not(HasSubstr("already computed")));
  // The first body's draught alone is told.
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("float, draught 3.000 m, "), HasSubstr("\nspar, 907.9")));
  EXPECT_EQ(lowest_damping(), 0.0);
}

TEST_F(HydroCommand, SaysWhatIsWrong) {
  EXPECT_THAT(complaint("highest: 3 rad/s", "highest: 9 rad/s"),
              AllOf(HasSubstr("vessel.yaml:8:16: error: at 9 rad/s waves are"),
                    HasSubstr("at least three must go into a wave")));
  EXPECT_THAT(complaint("count: 4", "count: 0"), HasSubstr("vessel.yaml:8"));
  EXPECT_THAT(complaint("highest: 3 rad/s", "highest: 1 rad/s"),
              HasSubstr("the highest must lie above the lowest"));
  EXPECT_THAT(complaint("150 t", "600 t"), HasSubstr("would have to displace"));
  EXPECT_THAT(complaint("  headings:", "  draughts: [2 m, 1 m]\n  headings:"),
              HasSubstr("draughts must ascend"));
  EXPECT_THAT(
      complaint("  headings:",
                "  lids: [{from: [1 m, 2 m], to: [1 m, 4 m], rate: 0.1 rad/s}]\n  headings:"),
      HasSubstr("a lid without an area"));
  EXPECT_THAT(complaint("  headings:", "  heading:"), HasSubstr("did you mean \"headings\"?"));
  const Outcome memory = run("pontoon --memory-limit 0.001 -o small.h5");
  EXPECT_EQ(memory.exit_code, 2);
  EXPECT_THAT(memory.err, HasSubstr("GB of memory, but 0.00 GB may be used"));
  EXPECT_EQ(run("").exit_code, 2);
  EXPECT_EQ(run("none.yaml").exit_code, 2);
  EXPECT_EQ(run("--import none.h5 -o x.h5").exit_code, 2);
  EXPECT_EQ(run("--import pontoon/vessel.yaml -o x.h5").exit_code, 2);
  EXPECT_THAT(run("--import none.1 --body-at 0,0 --body-at=-3,deep -o x.h5").err,
              AllOf(HasSubstr("\"deep\""), HasSubstr("a length is due"),
                    HasSubstr("x,y[,z[,heading]] is due")));
  EXPECT_THAT(run("--import none.1 --body-at 0,0,0,90rpm -o x.h5").err,
              HasSubstr("an angle is due"));
  EXPECT_THAT(run("--import none.1 --body-at 1,2, -o x.h5").err, HasSubstr("2 numbers"));
  // Read with their units, and by themselves: the file is what is missing.
  EXPECT_THAT(run("--import none.1 --body-at=-30m,1200cm,0,1.5rad -o x.h5").err,
              HasSubstr("none.1: cannot be opened"));
  EXPECT_THAT(run("--import none.1 --body-at 3 -o x.h5").err, HasSubstr("1 numbers"));
  EXPECT_THAT(run("--import none.nc --wamit-length 2 -o x.h5").err,
              HasSubstr("no file of WAMIT is read or written"));
}

/// Panels of a box of 4 m, its lowest point at z, in WAMIT's format; some left out, or turned
/// round.
std::string box_panels(double z, bool open, bool inward) {
  const std::string low = std::to_string(z), high = std::to_string(z + 4);
  const std::string corner[] = {"-2 -2 ", "2 -2 ", "2 2 ", "-2 2 "};
  std::string panels;
  const auto add = [&](const std::string& a, const std::string& b, const std::string& c,
                       const std::string& d) {
    panels += inward ? d + "\n" + c + "\n" + b + "\n" + a + "\n"
                     : a + "\n" + b + "\n" + c + "\n" + d + "\n";
  };
  add(corner[3] + low, corner[2] + low, corner[1] + low, corner[0] + low);
  if (!open) add(corner[0] + high, corner[1] + high, corner[2] + high, corner[3] + high);
  for (int k = 0; k < 4; ++k) {
    const std::string &a = corner[k], &b = corner[(k + 1) % 4];
    add(a + low, b + low, b + high, a + high);
  }
  return "box\n1 9.80665\n0 0\n" + std::to_string(open ? 5 : 6) + "\n" + panels;
}

TEST_F(HydroCommand, DiagnosesMeshes) {
  const auto complaint_about = [&](const std::string& mesh) {
    folder_.write("box/hull.gdf", mesh);
    folder_.write("box/vessel.yaml",
                  "kind: vessel\nhull: {mesh: {file: hull.gdf}}\npanel_size: 4 m\nmass: 20 t\n"
                  "centre_of_mass: [0 m, 0 m, 0 m]\nradii_of_gyration: [1 m, 1 m, 1 m]\n"
                  "hydrodynamics: {water_line: as meshed,\n"
                  "  frequencies: {lowest: 0.8 rad/s, highest: 1 rad/s, count: 2}}\n");
    const Outcome outcome = run("box -o box.h5");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    return outcome.err;
  };
  EXPECT_THAT(complaint_about(box_panels(-2, true, false)), HasSubstr("open"));
  EXPECT_THAT(complaint_about(test::text_of_file("box/hull.gdf").replace(14, 3, "1 0")),
              HasSubstr("ISX is 1 in line 3, so that the panels are one side of x = 0, but they "
                        "reach from x = -2 m to 2 m; give 0 if the mesh is whole"));
  EXPECT_THAT(complaint_about(box_panels(-2, false, true)), HasSubstr("normals"));
  EXPECT_THAT(complaint_about(box_panels(1, false, false)),
              AllOf(HasSubstr("box/vessel.yaml:2:21: error: hull \"box\": it reaches from z = 1 m"),
                    HasSubstr("all panels are above the water line; lower the hull")));
}

// What is wrong with the size of a mesh is said although the work ends at what follows of it.
TEST_F(HydroCommand, DoubtsAMeshInMillimetresBeforeItIsRefused) {
  std::string panels = box_panels(-2, false, false);
  const std::size_t header = panels.find('\n', panels.find("0 0\n") + 4) + 1;
  std::istringstream numbers(panels.substr(header));
  panels.erase(header);
  for (double x = 0.0, y = 0.0, z = 0.0; numbers >> x >> y >> z;) {
    panels += std::to_string(1e3 * x) + " " + std::to_string(1e3 * y) + " " +
              std::to_string(1e3 * z) + "\n";
  }
  folder_.write("box/hull.gdf", panels);
  folder_.write("box/vessel.yaml",
                "kind: vessel\nhull: {mesh: {file: hull.gdf}}\npanel_size: 1 m\nmass: 20 t\n"
                "centre_of_mass: [0 m, 0 m, 0 m]\nradii_of_gyration: [1 m, 1 m, 1 m]\n"
                "hydrodynamics: {water_line: as meshed,\n"
                "  frequencies: {lowest: 0.8 rad/s, highest: 1 rad/s, count: 2}}\n");
  const Outcome outcome = run("box -o box.h5");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_THAT(outcome.out + outcome.err,
              HasSubstr("the file may have millimetres (then 4 m long)"));
}

// GM = KB + BM - KG, 1 m off the middle: a barge of 20 x 10 m that draws 2 m lies over by
// atan(1/(1 + 100/24 - 2)) = 17.5 degrees, wall-sided: tan (GM + BM/2 tan^2) = 1 gives 17.0.
TEST_F(HydroCommand, SaysHowAVesselLies) {
  const auto outcome_of = [&](const std::string& y, const std::string& draughts) {
    folder_.write("barge/vessel.yaml",
                  "kind: vessel\nhull: {barge: {length: 20 m, breadth: 10 m, depth: 8 m}}\n"
                  "panel_size: 4 m\nmass: 410 t\ncentre_of_mass: [0 m, " +
                      y +
                      ", 2 m]\nradii_of_gyration: [3 m, 5 m, 5 m]\n"
                      "hydrodynamics: {headings: [0 deg]" +
                      draughts +
                      ",\n  frequencies: {lowest: 0.8 rad/s, highest: 1 rad/s, count: 2}}\n");
    return run("barge -o barge.h5");
  };
  const Outcome upright = outcome_of("0 m", "");
  EXPECT_EQ(upright.exit_code, 0) << upright.err;
  EXPECT_THAT(upright.out, Not(HasSubstr("floats with a list")));
  const Outcome listed = outcome_of("1 m", "");
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_THAT(listed.out, HasSubstr("warning: vessel barge floats with a list of"));
  const Outcome sunk = outcome_of("0 m", ", draughts: [9 m]");
  EXPECT_EQ(sunk.exit_code, 2) << sunk.out;
  EXPECT_THAT(sunk.err, HasSubstr("no hull reaches the water's surface"));
}

// A box of 4 x 4 x 4 m, half in the water, displaces 32.8 t.
TEST_F(HydroCommand, DoubtsAMassThatIsNotDisplaced) {
  const auto said_of = [&](const std::string& mass) {
    folder_.write("box/hull.gdf", box_panels(-2, false, false));
    folder_.write("box/vessel.yaml",
                  "kind: vessel\nhull: {mesh: {file: hull.gdf}}\npanel_size: 4 m\nmass: " + mass +
                      "\n"
                      "centre_of_mass: [0 m, 0 m, 0 m]\nradii_of_gyration: [1 m, 1 m, 1 m]\n"
                      "hydrodynamics: {water_line: as meshed, headings: [0 deg],\n"
                      "  frequencies: {lowest: 0.8 rad/s, highest: 1 rad/s, count: 2}}\n");
    const Outcome outcome = run("box -o box.h5");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_THAT(said_of("33 t"), Not(HasSubstr("as it is meshed")));
  EXPECT_THAT(said_of("20 t"), HasSubstr("warning: vessel box displaces 32.8 t as it is meshed"));
}

}  // namespace
}  // namespace blocklift::pipeline
