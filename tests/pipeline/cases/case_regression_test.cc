// Runs the program on a case once and holds the figures in the case's expected/figures.json.
//
//   case_regression_test PROGRAM CASE RESULTS
//
// Each figure names a place in summary.json, with dots between keys and the rows of a list by their
// names, lugs or plates ("ropes.R1.max_static_tension_N"), and one of
//   value with tolerance (relative) or absolute_tolerance;  at_least;  at_most;  magnitude_at_most;
//   equals.
// With BLOCKLIFT_ACCEPT=1 in the environment the values that are out of tolerance are written anew.

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/run_program.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string program;
fs::path case_folder;
fs::path results_folder;

bool accepting() {
  const char* accept = std::getenv("BLOCKLIFT_ACCEPT");
  return accept && std::string(accept) == "1";
}

/// The row of a list with a name, the member of an object with a key; null if there is none.
const Json* member(const Json& parent, const std::string& key) {
  if (parent.is_object()) return parent.contains(key) ? &parent.at(key) : nullptr;
  for (const Json& row : parent) {
    for (const char* name : {"name", "lug", "plate", "rope"}) {
      if (row.is_object() && row.contains(name) && row.at(name) == key) return &row;
    }
  }
  return nullptr;
}

const Json* find(const Json& summary, const std::string& path) {
  const Json* place = &summary;
  std::istringstream keys(path);
  for (std::string key; place && std::getline(keys, key, '.');) place = member(*place, key);
  return place;
}

/// What is wrong with a figure, in words; nothing if it is held.
std::optional<std::string> complaint(const Json& figure, const Json& found) {
  const auto differs = [&](const std::string& wanted) {
    return found.dump() + " instead of " + wanted;
  };
  if (figure.contains("equals")) {
    if (found == figure["equals"]) return {};
    return differs(figure["equals"].dump());
  }
  if (!found.is_number()) return differs("a number");
  const double number = found;
  const auto require = [&](bool held, const std::string& wanted) -> std::optional<std::string> {
    if (held) return {};
    return differs(wanted);
  };
  if (figure.contains("at_least"))
    return require(number >= figure["at_least"].get<double>(),
                   "at least " + figure["at_least"].dump());
  if (figure.contains("at_most"))
    return require(number <= figure["at_most"].get<double>(),
                   "at most " + figure["at_most"].dump());
  if (figure.contains("magnitude_at_most"))
    return require(std::abs(number) <= figure["magnitude_at_most"].get<double>(),
                   "at most " + figure["magnitude_at_most"].dump() + " either way");
  const double value = figure.at("value");
  const double allowed = figure.contains("tolerance")
                             ? figure["tolerance"].get<double>() * std::abs(value)
                             : figure.at("absolute_tolerance").get<double>();
  return require(std::abs(number - value) <= allowed,
                 figure["value"].dump() + " to " + std::to_string(allowed));
}

/// To six digits: more would feign a precision that nobody needs.
double rounded(double value) {
  std::ostringstream text;
  text.precision(6);
  text << value;
  return std::stod(text.str());
}

/// One figure a line, so that a change reads well.
void write_figures(const fs::path& path, const Json& figures) {
  std::ofstream stream(path);
  stream << "[\n";
  for (std::size_t i = 0; i < figures.size(); ++i)
    stream << "  " << figures[i].dump() << (i + 1 < figures.size() ? ",\n" : "\n");
  stream << "]\n";
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
  Json figures = Json::parse(test::text_of_file(figures_path));
  fs::remove_all(results_folder);
  const test::Outcome outcome = test::run_program(
      program, "assess '" + case_folder.string() + "' --output '" + results_folder.string() + "'");
  std::cout << outcome.out;
  // 3: it ran, and the lift fails a check; then the figures below say which.
  ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
  EXPECT_THAT(outcome.err, testing::MatchesRegex(test::only_progress));
  for (const char* file : {"results.h5", "report.html", "block-static.vtu", "block-dynamic.vtu"})
    EXPECT_TRUE(fs::exists(results_folder / file)) << file;
  const Json summary = Json::parse(test::text_of_file(results_folder / "summary.json"));

  bool out_of_tolerance = false;
  ASSERT_GT(figures.size(), 0u);
  for (Json& figure : figures) {
    const std::string name = figure.at("figure");
    EXPECT_FALSE(figure.value("reason", "").empty()) << name << " has no reason";
    const Json* found = find(summary, name);
    if (!found) {
      ADD_FAILURE() << name << " is not in summary.json";
      continue;
    }
    const auto wrong = complaint(figure, *found);
    if (!wrong) continue;
    if (accepting() && figure.contains("value") && found->is_number()) {
      figure["value"] = rounded(*found);
      std::cout << "accepted " << name << ": " << *wrong << '\n';
      continue;
    }
    out_of_tolerance = out_of_tolerance || figure.contains("value");
    ADD_FAILURE() << name << " is " << *wrong << "\n    (" << figure.value("reason", "") << ")";
  }
  if (accepting()) write_figures(figures_path, figures);
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
