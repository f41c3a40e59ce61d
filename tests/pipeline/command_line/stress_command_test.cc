// `blocklift stress` as a user meets it: run as a process.
#include <cmath>
#include <filesystem>
#include <regex>
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

const char* const bar_geometry = R"(
Point(1) = {0, 0, 0}; Point(2) = {2000, 0, 0}; Point(3) = {2000, 300, 0}; Point(4) = {0, 300, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Mesh.MeshSizeMax = 400;
out[] = Extrude{0, 0, 200}{ Surface{1}; };
Physical Volume("bar") = {out[1]};
Physical Surface("root") = {out[5]};
Physical Surface("end") = {out[3]};
Physical Surface("nothing") = {};
)";

const char* const bar_part = R"(
part: bar
mesh: {file: bar.geo, length_unit: mm}
materials:
  steel: {youngs_modulus: 206 GPa, poisson_ratio: 0, density: 7850 kg/m^3, yield_stress: 235 MPa}
supports:
  root: {groups: [root]}
loads:
  pull: {groups: [end], force: [600 kN, 0 kN, 0 kN]}
probes:
  middle: {at: [1 m, 0.1 m, 0.1 m]}
  axis: {from: [0 m, 0.15 m, 0.1 m], to: [2 m, 0.15 m, 0.1 m], points: 5}
)";

class StressCommand : public ::testing::Test {
 protected:
  StressCommand() {
    folder_.write("bar.geo", bar_geometry);
    folder_.write("bar.yaml", bar_part);
  }
  void change(const std::string& old_passage, const std::string& new_passage) const {
    std::string text = bar_part;
    const std::size_t at = text.find(old_passage);
    ASSERT_NE(at, std::string::npos);
    folder_.write("bar.yaml", text.replace(at, old_passage.size(), new_passage));
  }
  void expect_refused(const ::testing::Matcher<std::string>& message) const {
    const Outcome outcome = run_blocklift("stress bar.yaml");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, message);
    EXPECT_FALSE(fs::exists("results"));
  }

  const TemporaryFolder folder_;
};

// F/A = 10 MPa and F L / (E A) = 97.1 micrometres, with Poisson's ratio 0 exact for any mesh.
TEST_F(StressCommand, SolvesAndWritesResults) {
  const Outcome outcome = run_blocklift("stress bar.yaml --calculix");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("von Mises MPa"), HasSubstr("middle"),
                                 HasSubstr("results: results/bar")));
  for (const char* file : {"summary.json", "results.h5", "part.vtu", "part.inp"})
    EXPECT_TRUE(fs::is_regular_file(fs::path("results/bar") / file)) << file;
  const auto summary = nlohmann::json::parse(text_of_file("results/bar/summary.json"));
  const double stress = 10e6;
  EXPECT_NEAR(summary["probes"]["middle"]["stress_Pa"]["xx"], stress, 1e-7 * stress);
  EXPECT_EQ(summary["probes"]["axis"].size(), 5u);
  EXPECT_NEAR(summary["probes"]["axis"][4]["displacement_m"][0], stress * 2 / 206e9, 1e-12);
  EXPECT_NEAR(summary["reactions"]["root"]["force_N"][0], -600e3, 1e-3);
  EXPECT_NEAR(summary["mass_kg"], 7850 * 0.12, 1e-6);
  EXPECT_LT(summary["force_residual"], 1e-8);
}

// Neither held nor loaded: six rigid motions, then f = 22.373 / (2 pi) sqrt(E I / (rho A L^4)) =
// 263 Hz for bending of a slender bar about its weak axis; this one is 10 times as long as high,
// and shear softens it by some per cent. Supports at the root raise no rigid motion.
TEST_F(StressCommand, FindsNaturalModes) {
  std::string text = bar_part;
  text.erase(text.find("supports:"));
  folder_.write("bar.yaml", text + "modes: 8\n");
  const Outcome outcome = run_blocklift("stress bar.yaml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("natural mode"), HasSubstr("rigid motion")));
  EXPECT_TRUE(fs::is_regular_file("results/bar/modes.vtu"));
  EXPECT_FALSE(fs::exists("results/bar/part.vtu"));
  const auto summary = nlohmann::json::parse(text_of_file("results/bar/summary.json"));
  EXPECT_EQ(summary["rigid_motions"], 6);
  EXPECT_EQ(summary["natural_frequencies_Hz"].size(), 8u);
  EXPECT_EQ(summary["natural_frequencies_Hz"][5], 0);
  const double slender = 22.373 / (2 * M_PI) * std::sqrt(206e9 / 7850 / 12) * 0.2 / 4;
  EXPECT_NEAR(summary["natural_frequencies_Hz"][6], 0.95 * slender, 0.07 * slender);
}

// Bending under its own weight: linear tetrahedra are raised, then halved, until 3 % are met.
TEST_F(StressCommand, RefinesUntilTheAccuracyIsMet) {
  change("mesh: {file: bar.geo, length_unit: mm}",
         "accuracy: 3 %\nmesh: {file: bar.geo, length_unit: mm, element_order: 1}");
  std::string text = text_of_file("bar.yaml");
  text.replace(text.find("groups: [end], force: [600 kN, 0 kN, 0 kN]"), 42,
               "gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]");
  folder_.write("bar.yaml", text);
  const Outcome outcome = run_blocklift("stress bar.yaml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(text_of_file("results/bar/summary.json"));
  const auto& steps = summary["refinement"];
  ASSERT_GE(steps.size(), 2u);
  EXPECT_EQ(steps[0]["element_order"], 1);
  EXPECT_EQ(steps[1]["element_order"], 2);
  EXPECT_GT(steps[0]["estimated_error"], 0.2);
  EXPECT_LT(steps.back()["estimated_error"], 0.03);
  EXPECT_EQ(summary["estimated_error"], steps.back()["estimated_error"]);
  EXPECT_THAT(outcome.out, HasSubstr("elements"));
}

// A cantilever's stress falls linearly from its root: 6 F (L - x) / (b h^2) on its upper side, 30
// MPa at the toe that is 1.5 m before the force. Quadratic tetrahedra of half the bar's height bend
// within 5 %.
TEST_F(StressCommand, ExtrapolatesToAWeldToe) {
  std::string text = bar_part;
  text.replace(text.find("[600 kN, 0 kN, 0 kN]"), 20, "[0 kN, -60 kN, 0 kN]");
  text +=
      "hot_spots:\n  toe: {toe: [0.5 m, 0.3 m, 0.1 m], direction: [1, 0, 0], thickness: 200 mm}\n";
  folder_.write("bar.yaml", text);
  const Outcome outcome = run_blocklift("stress bar.yaml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("hot spot"));
  const auto summary = nlohmann::json::parse(text_of_file("results/bar/summary.json"));
  const auto& toe = summary["hot_spots"]["toe"];
  EXPECT_NEAR(toe["normal_Pa"], 30e6, 0.05 * 30e6);
  EXPECT_NEAR(toe["governing_Pa"], toe["principal_Pa"], 1);
  EXPECT_LT(toe["principal_angle_rad"], 0.1);
}

TEST_F(StressCommand, WeldToesOutsideThePartAreRefused) {
  change("probes:\n",
         "hot_spots:\n  toe: {toe: [0.5 m, 0.3 m, 0.1 m], direction: [0, 1, 0], "
         "thickness: 20 mm}\nprobes:\n");
  expect_refused(
      AllOf(HasSubstr("bar.yaml:11:3: error: hot spot toe is read at (0.5, 0.308, 0.1) m"),
            HasSubstr("outside the part")));
}

// The support answers with the pin's force, sideways part included.
TEST_F(StressCommand, PinPressesOnItsHole) {
  folder_.write("eye.geo", R"(
SetFactory("OpenCASCADE");
Box(1) = {-100, -200, -10, 200, 300, 20};
Cylinder(2) = {0, 0, -10, 0, 0, 20, 40};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.MeshSizeMax = 30;
Physical Volume("eye") = {3};
Physical Surface("hole") = Surface In BoundingBox{-41, -41, -11, 41, 41, 11};
Physical Surface("base") = Surface In BoundingBox{-101, -201, -11, 101, -199, 11};
)");
  folder_.write("eye.yaml", R"(
part: eye
mesh: {file: eye.geo, length_unit: mm}
materials: {steel: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, yield_stress: 235 MPa}}
supports: {base: {groups: [base]}}
loads:
  pin: {groups: [hole], bearing: {force: [30 kN, 100 kN, -5 kN], axis: [0, 0, 1], point: [0 m, 0 m, 0 m]}}
)");
  const Outcome outcome = run_blocklift("stress eye.yaml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(text_of_file("results/eye/summary.json"));
  const auto& force = summary["reactions"]["base"]["force_N"];
  EXPECT_NEAR(force[0], -30e3, 1e-3);
  EXPECT_NEAR(force[1], -100e3, 1e-3);
  EXPECT_NEAR(force[2], 5e3, 1e-3);
  const auto& moment = summary["reactions"]["base"]["moment_about_origin_N_m"];
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(moment[axis], 0, 1e-3);
}

TEST_F(StressCommand, APartWithNothingToComputeIsRefused) {
  std::string text = bar_part;
  text.erase(text.find("loads:"), text.find("probes:") - text.find("loads:"));
  folder_.write("bar.yaml", text);
  expect_refused(AllOf(HasSubstr("neither loads nor modes"), HasSubstr("modes: 10")));
}

TEST_F(StressCommand, MeshesThatGmshCannotReadAreRefused) {
  folder_.write("bar.msh", "$MeshFormat\n4.1 0 8\n$Nonsense\n");
  change("bar.geo", "bar.msh");
  expect_refused(AllOf(HasSubstr("bar.yaml:3:14: error: "), HasSubstr("bar.msh")));
}

TEST_F(StressCommand, GroupsThatAreMissingOrEmpty) {
  change("groups: [root]", "groups: [rot]");
  expect_refused(AllOf(HasSubstr("bar.yaml:7:"), HasSubstr("there is no group \"rot\""),
                       HasSubstr("did you mean \"root\"")));
}

TEST_F(StressCommand, MechanismsAreNamed) {
  change("{groups: [root]}", "{groups: [root], fixed: [x]}");
  expect_refused(AllOf(HasSubstr("free to move"), HasSubstr("translation along y"),
                       HasSubstr("translation along z"), HasSubstr("rotation about x")));
}

TEST_F(StressCommand, APartAThousandTimesTooLargeIsDoubted) {
  change(", length_unit: mm", "");
  expect_refused(AllOf(HasSubstr("2000 m long"), HasSubstr("length_unit: mm")));
}

TEST_F(StressCommand, LoadsOfNoOrTwoKindsAreRefused) {
  change("force: [600 kN, 0 kN, 0 kN]", "force: [1 kN, 0 kN, 0 kN], pressure: 1 MPa");
  expect_refused(HasSubstr("2 kinds"));
  change("{groups: [end], force: [600 kN, 0 kN, 0 kN]}", "{gravity: [0 m, 0 m/s^2, 0 m/s^2]}");
  expect_refused(HasSubstr("is a length"));
}

TEST_F(StressCommand, WeightNeedsADensity) {
  change("density: 7850 kg/m^3, ", "");
  EXPECT_EQ(run_blocklift("stress bar.yaml").exit_code, 0);
  std::string text = text_of_file("bar.yaml");
  text += "  weight: {gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]}\n";
  const std::string probes =
      text.substr(text.find("probes:"), text.rfind("  weight") - text.find("probes:"));
  text.erase(text.find("probes:"), probes.size());
  folder_.write("bar.yaml", text + probes);
  const Outcome outcome = run_blocklift("stress bar.yaml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no density"));
}

TEST_F(StressCommand, ProbesOutsideAndMissingMeshes) {
  change("at: [1 m, 0.1 m, 0.1 m]", "at: [1 m, 0.5 m, 0.1 m]");
  expect_refused(HasSubstr("probe middle lies outside the part"));
  change("bar.geo", "beam.geo");
  expect_refused(HasSubstr("there is no file"));
}

// A file without names: the faces of the bar's ends are chosen by boxes.
TEST_F(StressCommand, FacesAreChosenByBoxes) {
  change("length_unit: mm}",
         "length_unit: mm, faces: {left: {from: [0 m, 0 m, 0 m], to: [0 m, 0.3 m, 0.2 m]}}}");
  std::string text = text_of_file("bar.yaml");
  text.replace(text.find("groups: [root]"), 14, "groups: [left]");
  folder_.write("bar.yaml", text);
  const Outcome outcome = run_blocklift("stress bar.yaml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(text_of_file("results/bar/summary.json"));
  EXPECT_NEAR(summary["reactions"]["root"]["force_N"][0], -600e3, 1e-3);
  text.replace(text.find("to: [0 m, 0.3 m"), 15, "to: [0 m, 0.1 m");
  folder_.write("bar.yaml", text);
  const Outcome missed = run_blocklift("stress bar.yaml -o elsewhere");
  EXPECT_EQ(missed.exit_code, 2);
  EXPECT_THAT(missed.err, AllOf(HasSubstr("bar.yaml:3:"),
                                HasSubstr("no outer face of the part lies in the box"),
                                HasSubstr("from (0, 0, 0) m to (2, 0.3, 0.2) m")));
}

// A bent bar's largest stress is at its root's corner, where it is singular: it never gets
// accurate. That in its middle does.
TEST_F(StressCommand, RefinesWhereTheStressIsChecked) {
  change("[600 kN, 0 kN, 0 kN]", "[0 kN, -60 kN, 0 kN]");
  std::string text = text_of_file("bar.yaml");
  text.replace(text.find("at: [1 m, 0.1 m, 0.1 m]"), 23, "at: [1 m, 0.3 m, 0.1 m]");
  folder_.write("bar.yaml", text + "checked_stress: {accuracy: 4 %, probes: [middle]}\n");
  const Outcome outcome = run_blocklift("stress bar.yaml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(text_of_file("results/bar/summary.json"));
  const double exact = 60e3 * 1 * 6 / (0.2 * 0.3 * 0.3);
  EXPECT_NEAR(summary["probes"]["middle"]["stress_Pa"]["xx"], exact, 0.04 * exact);
  EXPECT_LT(summary["refinement"].back()["checked_error"], 0.04);
  folder_.write("bar.yaml", text + "checked_stress: {accuracy: 4 %, probes: [axis]}\n");
  const Outcome line = run_blocklift("stress bar.yaml -o elsewhere");
  EXPECT_EQ(line.exit_code, 2);
  EXPECT_THAT(line.err, HasSubstr("there is no point probe \"axis\""));
}

const char* const padeye_part = R"(
part: eye
mesh:
  padeye: {radius: 100 mm, thickness: 20 mm, hole: 52 mm, pin: 50 mm, cheek_radius: 80 mm, cheek_thickness: 10 mm, cheek_weld: 8 mm, height: 180 mm, base: [150 mm, 150 mm], divisions: 16}
materials: {steel: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, yield_stress: 355 MPa}}
supports: {base: {groups: [base]}}
loads:
  pin: {groups: [hole], bearing: {force: [0 kN, 100 kN, 0 kN], axis: [0, 0, 1], point: [0 m, 0 m, 0 m]}}
)";

// Bearing of the pin is F / (D_p T) = 100 kN / (50 x 40 mm) = 50 MPa; what reacts at the base is
// the force.
TEST_F(StressCommand, APadeyeHasItsHandFormulaeBesideIt) {
  folder_.write("eye.yaml", padeye_part);
  const Outcome outcome = run_blocklift("stress eye.yaml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("hand formula"), HasSubstr("cheek plates")));
  const auto summary = nlohmann::json::parse(text_of_file("results/eye/summary.json"));
  EXPECT_NEAR(summary["reactions"]["base"]["force_N"][1], -100e3, 1e-3);
  const auto& padeye = summary["padeye"];
  EXPECT_NEAR(padeye["formulas"][0]["demand"], 50e6, 1);
  EXPECT_GT(padeye["main_plate"]["peak_von_mises_Pa"],
            padeye["main_plate"]["checked_von_mises_Pa"]);
  EXPECT_GT(padeye["cheeks"]["checked_von_mises_Pa"], 5e6);
}

TEST_F(StressCommand, PadeyesThatDoNotFitAreRefused) {
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = padeye_part;
    text.replace(text.find(from), from.size(), to);
    folder_.write("eye.yaml", text);
    const Outcome outcome = run_blocklift("stress eye.yaml");
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(refused("pin: 50 mm", "pin: 60 mm"),
              AllOf(HasSubstr("eye.yaml:4:"), HasSubstr("larger than its hole")));
  EXPECT_THAT(refused("  padeye:", "  file: eye.geo\n  padeye:"),
              HasSubstr("both a file and a padeye"));
  EXPECT_THAT(refused("  padeye:", "  element_size: 5 mm\n  padeye:"), HasSubstr("are for files"));
  EXPECT_THAT(refused("  padeye:", "  refinements: 5\n  padeye:"), HasSubstr("256 are the most"));
}

TEST_F(StressCommand, IsValidated) {
  const Outcome outcome = run_blocklift("validate bar.yaml");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("valid, part bar with"));
}

/// Two bars end to end, half a millimetre apart.
const char* const two_bars = R"(
Point(1) = {0, 0, 0}; Point(2) = {1000, 0, 0}; Point(3) = {1000, 300, 0}; Point(4) = {0, 300, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Point(11) = {1000.5, 0, 0}; Point(12) = {2000, 0, 0}; Point(13) = {2000, 300, 0};
Point(14) = {1000.5, 300, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(11) = {11, 12, 13, 14}; Plane Surface(11) = {11};
Mesh.MeshSizeMax = 150;
first[] = Extrude{0, 0, 200}{ Surface{1}; };
second[] = Extrude{0, 0, 200}{ Surface{11}; };
Physical Volume("bar") = {first[1]};
Physical Volume("other") = {second[1]};
Physical Surface("root") = {first[5]};
Physical Surface("end") = {second[3]};
)";

/// A text whose lines were broken.
std::string on_one_line(const std::string& text) {
  return std::regex_replace(text, std::regex("\n +"), " ");
}

TEST_F(StressCommand, BodiesThatTouchAndAreNotJoinedAreTold) {
  folder_.write("bar.geo", two_bars);
  change("root: {groups: [root]}\nloads:\n  pull: {groups: [end], force: [600 kN, 0 kN, 0 kN]}",
         "root: {groups: [root]}\n  end: {groups: [end]}\nloads:\n"
         "  weight: {gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]}");
  const Outcome apart = run_blocklift("stress bar.yaml");
  EXPECT_EQ(apart.exit_code, 0) << apart.err;
  EXPECT_THAT(on_one_line(apart.out),
              AllOf(HasSubstr("warning"), HasSubstr("\"bar\""), HasSubstr("\"other\""),
                    HasSubstr("across 0.5 mm"), HasSubstr("not joined")));
}

TEST_F(StressCommand, BodiesAreJoinedWhereAsked) {
  folder_.write("bar.geo", two_bars);
  change("supports:", "join: {within: 1 mm}\nsupports:");
  const Outcome joined = run_blocklift("stress bar.yaml");
  EXPECT_EQ(joined.exit_code, 0) << joined.err;
  EXPECT_THAT(on_one_line(joined.out),
              AllOf(HasSubstr("are joined by"), ::testing::Not(HasSubstr("warning"))));
  const auto summary = nlohmann::json::parse(text_of_file("results/bar/summary.json"));
  EXPECT_GT(summary["joints"][0]["tied_nodes"], 0);
  // F L / (E A) of the whole bar, even with Poisson's ratio 0. Nodes that follow places of other
  // faces do not pass an even pressure evenly where meshes do not match: a percent is for that.
  EXPECT_NEAR(summary["groups"]["other"]["max_displacement_m"].get<double>(),
              600e3 * 2 / (206e9 * 0.06), 1e-2 * 600e3 * 2 / (206e9 * 0.06));
}

TEST_F(StressCommand, AJoinThatJoinsNothingIsRefused) {
  folder_.write("bar.geo", two_bars);
  change("supports:", "join: {within: 0.1 mm}\nsupports:");
  expect_refused(AllOf(HasSubstr("bar.yaml:"), HasSubstr("faces another body within 0.1 mm"),
                       HasSubstr("across 0.5 mm")));
}

}  // namespace
}  // namespace blocklift::pipeline
