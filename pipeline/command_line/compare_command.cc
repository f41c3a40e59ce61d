#include "pipeline/command_line/compare_command.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/comparison/comparison.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/terminal/run_log.h"

namespace blocklift::pipeline {

namespace {

int compare_and_show(const CompareOptions& options) {
  std::vector<Tolerance> tolerances;
  if (options.tolerance) tolerances = read_tolerances(*options.tolerance);
  const ResultComparison comparison =
      compare_results(read_compared_results({options.results.begin(), options.results.end()}),
                      std::move(tolerances));
  if (options.page) write_file(*options.page, comparison_page(comparison));
  if (options.json)
    fmt::print("{}\n", comparison_json(comparison).dump(2));
  else if (!is_quiet() || !comparison.moved.empty())
    fmt::print("{}", comparison_text(comparison));
  if (options.page && !options.json && !is_quiet()) fmt::print("\npage: {}\n", *options.page);
  return comparison.moved.empty() ? exit_code::done : exit_code::lift_fails;
}

}  // namespace

int compare(const CompareOptions& options) {
  try {
    return compare_and_show(options);
  } catch (const ResultsError& error) {
    // Results are only read here.
    fmt::print(stderr, "blocklift: error: {}\n", error.what());
    return exit_code::wrong_input;
  }
}

}  // namespace blocklift::pipeline
