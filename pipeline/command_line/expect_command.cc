#include "pipeline/command_line/expect_command.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/comparison/compared_result.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/processes/exit_code.h"

namespace blocklift::pipeline {
namespace {

int renew_file(const ExpectOptions& options) {
  if (!options.file) {
    fmt::print(stderr, "blocklift: error: --renew needs the file of figures: --output FILE\n");
    return exit_code::wrong_input;
  }
  std::vector<ExpectedFigure> figures = read_expected_figures(*options.file);
  const ComparedResult result = read_compared_result(options.result);
  const std::vector<BrokenFigure> renewed = renew_figures(figures, result.summary);
  write_file(*options.file, expected_figures_text(figures, syntax_of_figures(*options.file)));
  for (const BrokenFigure& broken : renewed)
    fmt::print("renewed: {} {}\n", figures[broken.index].path, broken.complaint);
  // What is required cannot be renewed.
  for (const BrokenFigure& broken : find_broken_figures(figures, result.summary))
    fmt::print("still off: {} {}\n", figures[broken.index].path, broken.complaint);
  fmt::print("figures: {}\n", *options.file);
  return exit_code::done;
}

}  // namespace

int expect(const ExpectOptions& options) {
  if (options.renew) return renew_file(options);
  if (options.file && std::filesystem::exists(*options.file)) {
    fmt::print(stderr,
               "blocklift: error: \"{}\" is there already; --renew keeps its figures and takes new "
               "values\n",
               *options.file);
    return exit_code::wrong_input;
  }
  const std::vector<ExpectedFigure> figures =
      expect_figures(read_compared_result(options.result).summary);
  if (figures.empty()) {
    fmt::print(
        stderr,
        "{}: error: these results have no figures of a lift\n    those of a part alone cannot "
        "be expected\n",
        options.result);
    return exit_code::wrong_input;
  }
  const std::string text = expected_figures_text(figures);
  if (!options.file) {
    fmt::print("{}", text);
    return exit_code::done;
  }
  write_file(*options.file, text);
  fmt::print("figures: {}\n", *options.file);
  return exit_code::done;
}

bool figures_are_held(const std::vector<ExpectedFigure>& figures,
                      const nlohmann::ordered_json& summary) {
  const std::vector<BrokenFigure> broken = find_broken_figures(figures, summary);
  for (const BrokenFigure& one : broken) {
    const ExpectedFigure& figure = figures[one.index];
    fmt::print("not as expected: {} {}\n    ({})\n", figure.path, one.complaint, figure.reason);
  }
  if (broken.empty()) {
    fmt::print("expected figures: all {} held\n", figures.size());
  } else {
    fmt::print("expected figures: {} of {} held\n", figures.size() - broken.size(), figures.size());
  }
  return broken.empty();
}

}  // namespace blocklift::pipeline
