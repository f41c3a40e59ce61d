// Runs the program on a case once and holds the figures in the case's expected/figures.json.
//
//   case_regression_test PROGRAM CASE RESULTS
//
// They are those of `blocklift assess --expect` (pipeline/comparison/expected_figures.h). With
// BLOCKLIFT_ACCEPT=1 in the environment the values that are out of tolerance are written anew.

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/comparison/expected_figures.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/summary_file.h"
#include "tests/pipeline/run_program.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

std::string program;
fs::path case_folder;
fs::path results_folder;

bool accepting() {
  const char* accept = std::getenv("BLOCKLIFT_ACCEPT");
  return accept && std::string(accept) == "1";
}

std::string how_to_accept() {
  return "\nIf the change is meant, say why in the commit and accept the new figures:\n"
         "    BLOCKLIFT_ACCEPT=1 ctest --preset release -R regression." +
         case_folder.filename().string() + "\nwhich rewrites " +
         (case_folder / "expected" / "figures.json").string() +
         "\n(requirements, such as at_most and equals, are not rewritten).";
}

TEST(CaseRegression, FiguresAreHeld) {
  const fs::path figures_path = case_folder / "expected" / "figures.json";
  std::vector<ExpectedFigure> figures = read_expected_figures(figures_path);
  fs::remove_all(results_folder);
  const test::Outcome outcome = test::run_program(
      program, "assess '" + case_folder.string() + "' --output '" + results_folder.string() + "'");
  std::cout << outcome.out;
  // 3: it ran, and the lift fails a check; then the figures below say which.
  ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
  EXPECT_THAT(outcome.err, ::testing::MatchesRegex(test::only_progress));
  for (const char* file : {"results.h5", "report.html", "block-static.vtu", "block-dynamic.vtu"})
    EXPECT_TRUE(fs::exists(results_folder / file)) << file;
  const nlohmann::ordered_json summary = read_summary(results_folder / "summary.json");

  if (accepting()) {
    for (const BrokenFigure& accepted : renew_figures(figures, summary))
      std::cout << "accepted " << figures[accepted.index].path << ", which " << accepted.complaint
                << '\n';
    write_file(figures_path, expected_figures_text(figures));
  }
  bool out_of_tolerance = false;
  for (const BrokenFigure& broken : find_broken_figures(figures, summary)) {
    const ExpectedFigure& figure = figures[broken.index];
    out_of_tolerance = out_of_tolerance || figure.value;
    ADD_FAILURE() << figure.path << ' ' << broken.complaint << "\n    (" << figure.reason << ")";
  }
  if (out_of_tolerance) ADD_FAILURE() << how_to_accept();
}

}  // namespace
}  // namespace blocklift::pipeline

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (argc != 4) {
    std::cerr << "use: case_regression_test PROGRAM CASE RESULTS\n";
    return 2;
  }
  blocklift::pipeline::program = argv[1];
  blocklift::pipeline::case_folder = argv[2];
  blocklift::pipeline::results_folder = argv[3];
  return RUN_ALL_TESTS();
}
