// `blocklift stress` on several processes, and by iteration, against the same part in one process.
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
using nlohmann::json;
using test::Outcome;
using test::TemporaryFolder;
using test::text_of_file;
using ::testing::AllOf;
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
  EXPECT_THAT(outcome.out, HasSubstr("Cholesky factorisation by MUMPS, 2 processes"));
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

TEST_F(ParallelStress, EachProcessWritesItsPiece) {
  ASSERT_EQ(stress_on_processes(2, "stress ring -o two").exit_code, 0);
  EXPECT_THAT(text_of_file("two/part.pvtu"),
              AllOf(HasSubstr("Source=\"part_0.vtu\""), HasSubstr("Source=\"part_1.vtu\"")));
  int cells = 0, elements = 0;
  for (const char* piece : {"two/part_0.vtu", "two/part_1.vtu"}) {
    const std::string text = text_of_file(piece);
    std::smatch found;
    ASSERT_TRUE(std::regex_search(text, found, std::regex("NumberOfCells=\"([0-9]+)\""))) << piece;
    EXPECT_GT(std::stoi(found[1]), 0);
    cells += std::stoi(found[1]);
  }
  for (const auto& [kind, count] : alone_["elements"].items()) elements += count.get<int>();
  EXPECT_EQ(cells, elements);
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

}  // namespace
}  // namespace blocklift::pipeline
