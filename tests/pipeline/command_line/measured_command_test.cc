// `blocklift measured` as a user meets it.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of_file;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// The small lift, computed with the mass that it was thought to have.
class MeasuredCommand : public ::testing::Test {
 protected:
  MeasuredCommand() {
    fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive);
    // The balance of the ropes knows of no wind.
    const std::string text = text_of_file("lift/case.yaml");
    folder_.write("lift/case.yaml",
                  test::with(text, "wind: {speed: 8 m/s, towards: 60 deg}\n", ""));
  }

  static Outcome run(const std::string& arguments) { return test::run_blocklift(arguments); }

  const test::TemporaryFolder folder_;
};

TEST_F(MeasuredCommand, FindsClockAndWeightOfALiftThatIsHeavierThanThought) {
  ASSERT_EQ(run("simulate lift -o thought").exit_code, 0);
  folder_.write("lift/block.yaml",
                test::with(text_of_file("lift/block.yaml"), "mass: 8 t", "mass: 8.4 t"));
  ASSERT_EQ(run("simulate lift -o made --csv").exit_code, 0);
  // What was made is the record; its clock is that of a day, and hoists were not measured.
  std::ifstream table("made/results.csv");
  std::string record, line;
  std::getline(table, line);
  const auto cells_of = [](const std::string& row) {
    std::vector<std::string> cells{""};
    for (const char letter : row) {
      if (letter == ',')
        cells.emplace_back();
      else
        cells.back() += letter;
    }
    return cells;
  };
  const std::vector<std::string> names = cells_of(line);
  const auto add_row = [&](const std::vector<std::string>& cells, const std::string& time) {
    record += time;
    for (std::size_t i = 1; i < cells.size(); ++i)
      if (names[i].front() == 'R') record += ',' + cells[i];
    record += '\n';
  };
  add_row(names, names.front());
  while (std::getline(table, line)) {
    const std::vector<std::string> cells = cells_of(line);
    add_row(cells, std::to_string(std::stod(cells.front()) + 36000));
  }
  folder_.write("cells.csv", record);

  const Outcome shown = run("measured thought cells.csv --rest 0:18 -o page.html");
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_THAT(shown.out,
              AllOf(HasSubstr("cells.csv"), HasSubstr("mass t"), HasSubstr("page.html")));
  EXPECT_THAT(text_of_file("page.html"), HasSubstr("Measured and computed"));
  const Outcome json = run("measured thought cells.csv --rest 0:18 --json --cell-accuracy 0.5%");
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const auto figures = nlohmann::json::parse(json.out);
  EXPECT_NEAR(figures["records"][0]["shift_s"].get<double>(), -36000, 0.03);
  const auto& weight = figures["weight"];
  const double deviation = weight["mass_deviation_kg"].get<double>();
  EXPECT_NEAR(weight["mass_kg"].get<double>(), 8400, 2 * deviation);
  EXPECT_LT(deviation, 30);
  const std::vector<double> centre{2.05, 1.48, 0.75};
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(weight["centre_of_mass_m"][k].get<double>(), centre[k], 0.03);
}

TEST_F(MeasuredCommand, RefusesWhatItCannotUse) {
  ASSERT_EQ(run("simulate lift -o thought").exit_code, 0);
  folder_.write("cells.csv", "time [s],ropes.R7 [kN]\n0,1\n1,1\n2,1\n3,1\n4,1\n5,1\n6,1\n7,1\n");
  const Outcome unknown = run("measured thought cells.csv");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("cells.csv:1:1: error: the results hold no \"ropes.R7\""));
  EXPECT_EQ(run("measured thought").exit_code, 2);
  EXPECT_EQ(run("measured thought missing.csv").exit_code, 2);
  EXPECT_EQ(run("measured nowhere cells.csv").exit_code, 2);
  EXPECT_THAT(run("measured thought cells.csv --rest 3").err, HasSubstr("--rest 3: error: two"));
  EXPECT_THAT(run("measured thought cells.csv --cell-accuracy 5").err,
              HasSubstr("a share from 0 up to 100 % is due"));
}

}  // namespace
}  // namespace blocklift::pipeline
