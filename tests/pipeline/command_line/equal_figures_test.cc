// Figures of a lift do not depend on how often it runs, nor on the number of threads, nor on the
// instructions of the processor.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using test::TemporaryFolder;
using test::text_of_file;

/// What a figure that is a difference, or the rounding itself, is measured by; 0: by itself.
double scale_of(const std::string& key) {
  const auto has = [&](const char* part) { return key.find(part) != std::string::npos; };
  if (has("percent")) return 100;
  if (has("residual") || has("reaction") || has("change") || has("band") || has("utilisation"))
    return 1;
  if (key.ends_with("_Pa")) return 1e6;
  return 0;
}

void compare(const json& a, const json& b, const std::string& path, const std::string& key,
             std::vector<std::string>& differences) {
  if (a.is_object() && b.is_object()) {
    for (const auto& [name, value] : a.items())
      compare(value, b.value(name, json()), path + "/" + name, name, differences);
    if (a.size() != b.size()) differences.push_back(path + ": keys");
  } else if (a.is_array() && b.is_array() && a.size() == b.size()) {
    for (std::size_t i = 0; i < a.size(); ++i)
      compare(a[i], b[i], path + "[" + std::to_string(i) + "]", key, differences);
  } else if (a.is_number() && b.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    const double size = std::max({std::abs(x), std::abs(y), scale_of(key)});
    if (std::abs(x - y) > 1e-9 * size)
      differences.push_back(path + ": " + a.dump() + ", " + b.dump());
  } else if (a != b) {
    differences.push_back(path + ": " + a.dump() + ", " + b.dump());
  }
}

/// Everything in the summary of a run but its name, its date, and how long it took.
json figures_of(const std::string& folder, const std::string& options,
                const std::string& variables = "") {
  const Outcome outcome =
      test::run_command("( " + variables + " '" BLOCKLIFT_EXECUTABLE "' assess lift -o " + folder +
                        " " + options + " )");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  json summary = json::parse(text_of_file(fs::path(folder) / "summary.json"));
  for (const char* name : {"run", "created", "timing"}) EXPECT_EQ(summary.erase(name), 1) << name;
  EXPECT_EQ(summary.at("solver").erase("times_faster_than_real_time"), 1);
  return summary;
}

std::vector<std::string> differences_of(const json& a, const json& b) {
  std::vector<std::string> differences;
  compare(a, b, "", "", differences);
  return differences;
}

class EqualFigures : public ::testing::TestWithParam<std::string> {
 protected:
  EqualFigures() {
    fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive);
    std::string text = text_of_file("lift/case.yaml");
    const std::string before = "static_interval: 1 s";
    text.replace(text.find(before), before.size(), before + ", flexibility: " + GetParam());
    folder_.write("lift/case.yaml", text);
  }
  const TemporaryFolder folder_;
};

TEST_P(EqualFigures, AreTheSameToTheLastBitOnRepeatedRuns) {
  const json first = figures_of("a", "--threads 2"), second = figures_of("b", "--threads 2");
  EXPECT_EQ(json::diff(first, second).dump().substr(0, 1000), "[]");
}

TEST_P(EqualFigures, AreTheSameToABillionthForAnyNumberOfThreads) {
  const json of_one = figures_of("1", "--threads 1");
  EXPECT_EQ(differences_of(of_one, figures_of("2", "--threads 2")), std::vector<std::string>{});
  EXPECT_EQ(differences_of(of_one, figures_of("5", "--threads 5")), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Blocks, EqualFigures, ::testing::Values("rigid", "modal"));

// OpenBLAS' kernels for processors of 2008 and of 2013. A block that gives way moves by its own
// stiffness, which they factorise: its motion is equal within the tolerance of the integration.
class OtherInstructions : public EqualFigures {};

TEST_P(OtherInstructions, GiveTheSameFiguresToABillionth) {
  const json of_old = figures_of("old", "--threads 2", "OPENBLAS_CORETYPE=Nehalem");
  const json of_usual = figures_of("usual", "--threads 2", "OPENBLAS_CORETYPE=Haswell");
  EXPECT_EQ(differences_of(of_old, of_usual), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Blocks, OtherInstructions, ::testing::Values("rigid"));

}  // namespace
}  // namespace blocklift::pipeline
