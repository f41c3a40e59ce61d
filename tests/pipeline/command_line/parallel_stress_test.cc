// `blocklift stress` on several processes, and by iteration, against the same part in one process.
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using test::TemporaryFolder;
using test::text_of_file;
using ::testing::HasSubstr;

Outcome stress_on_processes(int count, const std::string& arguments) {
  return test::run_command("mpirun --allow-run-as-root --oversubscribe -n " +
                           std::to_string(count) + " '" BLOCKLIFT_EXECUTABLE "' " + arguments);
}

json summary_of(const Outcome& outcome, const std::string& folder) {
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json::parse(text_of_file(fs::path(folder) / "summary.json"));
}

// A part with a neighbouring file; the iteration or the direct way by a line more.
class ParallelStress : public ::testing::Test {
 protected:
  ParallelStress() {
    fs::copy(fs::path(BLOCKLIFT_PARTS) / "lame", "ring");
    alone_ = summary_of(test::run_blocklift("stress ring -o alone"), "alone");
  }
  void solve_by(const std::string& method) const {
    folder_.write("ring/part.yaml",
                  text_of_file("ring/part.yaml") + "\nsolver: {method: " + method + "}\n");
  }
  // Both discretisations are the same: what differs is rounding, and the tolerance of an iteration.
  void expect_same(const json& other) const {
    constexpr double tolerance = 1e-8;
    const auto expect = [&](const json& one, const json& two) {
      EXPECT_NEAR(one.get<double>(), two.get<double>(), tolerance * std::abs(one.get<double>()));
    };
    expect(alone_["strain_energy_J"], other["strain_energy_J"]);
    expect(alone_["estimated_error"], other["estimated_error"]);
    for (const char* figure : {"von_mises_Pa", "raw_von_mises_Pa", "max_displacement_m"})
      expect(alone_["all"][figure], other["all"][figure]);
    ASSERT_GT(alone_["probes"].size(), 0u);
    for (const auto& [name, probe] : alone_["probes"].items())
      if (probe.contains("von_mises_Pa"))
        expect(probe["von_mises_Pa"], other["probes"][name]["von_mises_Pa"]);
    EXPECT_LT(other["force_residual"], 1e-8);
  }

  const TemporaryFolder folder_;
  json alone_;
};

TEST_F(ParallelStress, TwoProcessesFindTheSameDirectly) {
  const Outcome outcome = stress_on_processes(2, "stress ring -o two");
  const json two = summary_of(outcome, "two");
  EXPECT_THAT(outcome.out, HasSubstr("Cholesky factorisation, 2 processes"));
  expect_same(two);
}

TEST_F(ParallelStress, ThreeProcessesFindTheSameByIteration) {
  solve_by("iterative");
  const json three = summary_of(stress_on_processes(3, "stress ring -o three"), "three");
  EXPECT_EQ(three["solver"]["processes"], 3);
  EXPECT_GT(three["solver"]["iterations"], 3);
  expect_same(three);
}

TEST_F(ParallelStress, OneProcessFindsTheSameByIteration) {
  solve_by("iterative");
  const json one = summary_of(test::run_blocklift("stress ring -o one"), "one");
  EXPECT_EQ(one["solver"]["name"], "conjugate gradients with algebraic multigrid");
  expect_same(one);
}

TEST_F(ParallelStress, ModesAreThoseOfOneProcess) {
  std::string part = text_of_file("ring/part.yaml");
  const std::string law = "poisson_ratio: 0.3,";
  part.replace(part.find(law), law.size(), law + " density: 7850 kg/m^3,");
  folder_.write("ring/part.yaml", part + "\nmodes: 4\n");
  const json one = summary_of(test::run_blocklift("stress ring -o one"), "one");
  const json two = summary_of(stress_on_processes(2, "stress ring -o two"), "two");
  ASSERT_EQ(one["natural_frequencies_Hz"].size(), 4U);
  for (std::size_t m = 0; m < 4; ++m) {
    const double frequency = one["natural_frequencies_Hz"][m];
    EXPECT_NEAR(two["natural_frequencies_Hz"][m], frequency, 1e-6 * frequency);
  }
}

TEST_F(ParallelStress, ErrorsEndAllProcesses) {
  const Outcome outcome = stress_on_processes(2, "stress nowhere.yaml -o two");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("nowhere.yaml"));
  EXPECT_FALSE(fs::exists("two"));
}

TEST_F(ParallelStress, OtherCommandsAreRefused) {
  const Outcome outcome = stress_on_processes(2, "validate ring");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("only \"blocklift stress\" and \"blocklift sweep\" run on several"));
}

/// A plate of 4 x 2 m and 12 mm in 16 x 8 shells, clamped along x = 0, with an upright plate along
/// its middle; its free edge follows a node rigidly, which carries 3 kN down. Nodes along y, then
/// x.
std::string cantilever_deck() {
  std::string grids, shells, link = "RBE2,900,999,123456";
  const auto label = [](int i, int j) { return 1 + 20 * i + j; };
  for (int i = 0; i <= 16; ++i) {
    for (int j = 0; j <= 8; ++j)
      grids += fmt::format("GRID,{},,{}.,{}.,0.\n", label(i, j), 250 * i, 250 * j);
    grids += fmt::format("GRID,{},,{}.,1000.,300.\n", label(i, 9), 250 * i);
  }
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 8; ++j)
      shells += fmt::format("CQUAD4,{},1,{},{},{},{}\n", label(i, j), label(i, j), label(i + 1, j),
                            label(i + 1, j + 1), label(i, j + 1));
    shells += fmt::format("CQUAD4,{},1,{},{},{},{}\n", label(i, 9), label(i, 4), label(i + 1, 4),
                          label(i + 1, 9), label(i, 9));
  }
  for (const int j : {0, 4, 8}) link += fmt::format(",{}", label(16, j));
  return "SOL 101\nCEND\nSUBCASE 1\n  SPC = 1\n  LOAD = 2\nSUBCASE 2\n  SPC = 1\n  LOAD = 3\n"
         "BEGIN BULK\n" +
         grids + "GRID,999,,4500.,1000.,0.\n" + shells + link +
         "\nPSHELL,1,1,12.,1,,1\nMAT1,1,206000.,,0.3,7.85-9\nSPC1,1,123456,1,THRU,10\n"
         "FORCE,2,999,,3000.,0.,0.,-1.\nPLOAD4,3,1,-0.001\nENDDATA\n";
}

class ParallelStressOfBlock : public ::testing::Test {
 protected:
  ParallelStressOfBlock() {
    folder_.write("plate.bdf", cantilever_deck());
    folder_.write("plate.yaml",
                  "kind: block\ntitle: Plate\n"
                  "mesh: {file: plate.bdf, units: mm-t-N, yield_stress: 235 MPa}\n");
  }
  const TemporaryFolder folder_;
};

// The same equations, eliminated in another order: what differs is rounding, times the condition of
// a thin plate.
TEST_F(ParallelStressOfBlock, TwoAndThreeProcessesFindTheSame) {
  constexpr double tolerance = 1e-8;
  const json alone =
      summary_of(test::run_blocklift("stress plate.yaml --degree 3 -o alone"), "alone");
  ASSERT_EQ(alone["cases"].size(), 2U);
  for (const int processes : {2, 3}) {
    const Outcome outcome =
        stress_on_processes(processes, "stress plate.yaml --degree 3 -o others");
    const json others = summary_of(outcome, "others");
    EXPECT_THAT(outcome.out, HasSubstr(fmt::format("factorised on {} processes", processes)));
    EXPECT_EQ(others["processes"], processes);
    for (std::size_t c = 0; c < 2; ++c) {
      const auto expect_near = [&](const json& one, const json& two) {
        EXPECT_NEAR(one.get<double>(), two.get<double>(), tolerance * std::abs(one.get<double>()));
      };
      const json &one = alone["cases"][c], &two = others["cases"][c];
      expect_near(one["strain_energy_J"], two["strain_energy_J"]);
      expect_near(one["estimated_error"], two["estimated_error"]);
      expect_near(one["max_displacement"]["value_m"], two["max_displacement"]["value_m"]);
      expect_near(one["checked_von_mises"]["value_Pa"], two["checked_von_mises"]["value_Pa"]);
      expect_near(one["reactions"]["force_N"][2], two["reactions"]["force_N"][2]);
      expect_near(one["reactions"]["moment_about_origin_N_m"][1],
                  two["reactions"]["moment_about_origin_N_m"][1]);
      EXPECT_LT(two["force_residual"], 1e-8);
    }
  }
}

TEST_F(ParallelStressOfBlock, WhatSupportsLeaveFreeEndsAllProcesses) {
  std::string deck = text_of_file("plate.bdf");
  const std::string clamped = "SPC1,1,123456,1,THRU,10";
  folder_.write("plate.bdf",
                deck.replace(deck.find(clamped), clamped.size(), "SPC1,1,13,1,THRU,10"));
  const Outcome outcome = stress_on_processes(2, "stress plate.yaml -o others");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the supports of case 1 leave a part free to move"));
  EXPECT_FALSE(fs::exists("others"));
}

TEST_F(ParallelStressOfBlock, ErrorsOfItsFileAreSaidOnce) {
  folder_.write("plate.yaml", "kind: block\ntitle: Plate\nmesh: {file: none.bdf, units: mm-t-N}\n");
  const Outcome outcome = stress_on_processes(2, "stress plate.yaml -o others");
  EXPECT_EQ(outcome.exit_code, 2);
  const std::size_t first = outcome.err.find("none.bdf");
  ASSERT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("plate.yaml:3", outcome.err.find("plate.yaml:3") + 1),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace blocklift::pipeline
