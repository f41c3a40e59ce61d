// `blocklift assess` and `blocklift report` as a user meets them: run as a process.

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

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
using test::run_blocklift;
using test::TemporaryFolder;
using test::text_of_file;
using test::with;
using ::testing::HasSubstr;
using ::testing::Not;

/// The small lift's files in a folder of their own, to be changed at will.
class AssessCommand : public ::testing::Test {
 protected:
  AssessCommand() { fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive); }

  void change(const std::string& file, const std::string& old_passage,
              const std::string& new_passage) const {
    const fs::path path = fs::path("lift") / file;
    folder_.write(path, with(text_of_file(path), old_passage, new_passage));
  }
  /// Everything below the working folder but the lift itself.
  static std::map<std::string, std::string> written() {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(".")) {
      const std::string name = entry.path().lexically_normal().string();
      if (name == "lift" || name.starts_with("lift/")) continue;
      files[name] = entry.is_directory() ? "folder" : text_of_file(entry.path());
    }
    return files;
  }

  const TemporaryFolder folder_;
};

TEST_F(AssessCommand, WritesResultsAndSaysWhereTheReportIs) {
  const Outcome outcome = run_blocklift("assess lift");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, ::testing::MatchesRegex(test::only_progress));
  EXPECT_THAT(outcome.out, HasSubstr("verdict: pass\n"));
  EXPECT_THAT(outcome.out, HasSubstr("natural periods at the start: load: pendulum along "));
  EXPECT_THAT(outcome.out, HasSubstr(" Jacobians\n"));
  EXPECT_TRUE(outcome.out.ends_with("\nreport: results/small-lift/report.html\n")) << outcome.out;
  for (const char* file : {"results.h5", "summary.json", "report.html", "block-static.vtu",
                           "block-dynamic.vtu", "lug-L1.vtu"})
    EXPECT_TRUE(fs::is_regular_file(fs::path("results/small-lift") / file)) << file;
  EXPECT_EQ(written().size(), 8u);  // two folders and the six files
}

// Sums come in another order with another number of threads: squares of equal stress must not
// change places by that, since cells are divided about them. Steps of the integration do change.
TEST_F(AssessCommand, DividesTheSameCellsWithAnyNumberOfThreads) {
  nlohmann::json summaries[2];
  for (const int i : {0, 1}) {
    const std::string threads = std::to_string(i + 1);
    ASSERT_EQ(run_blocklift("assess lift --threads " + threads + " -o " + threads).exit_code, 0);
    summaries[i] = nlohmann::json::parse(text_of_file(threads + "/summary.json"));
  }
  const auto& one = summaries[0]["structure"]["accuracy"]["steps"];
  const auto& other = summaries[1]["structure"]["accuracy"]["steps"];
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i]["elements"], other[i]["elements"]);
    EXPECT_EQ(one[i]["unknowns"], other[i]["unknowns"]);
    const double stress = one[i]["static_checked_von_mises_Pa"].get<double>();
    EXPECT_NEAR(other[i]["static_checked_von_mises_Pa"].get<double>(), stress, 1e-9 * stress);
  }
}

TEST_F(AssessCommand, KeepsWithinItsLimits) {
  const Outcome late = run_blocklift("assess lift --time 0.3 -o out");
  EXPECT_EQ(late.exit_code, 1);
  EXPECT_THAT(late.err, HasSubstr("blocklift: error: stopped after 0.3 s, the limit of --time; "));
  const Outcome large = run_blocklift("assess lift --memory 0.001 -o out");
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_THAT(large.err, HasSubstr("whose stiffness needs more than "));
  EXPECT_TRUE(written().empty());
  EXPECT_EQ(run_blocklift("assess lift --threads 0").exit_code, 2);
  EXPECT_EQ(run_blocklift("assess lift --memory 8 --time 600 -o out").exit_code, 0);
}

TEST_F(AssessCommand, PutsResultsWhereItIsTold) {
  const Outcome outcome = run_blocklift("assess lift/case.yaml --output 'my lifts/first'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("report: my lifts/first/report.html\n"));
  EXPECT_TRUE(fs::exists("my lifts/first/results.h5"));
  EXPECT_FALSE(fs::exists("results"));
}

TEST_F(AssessCommand, SaysLittleOrMoreOrKeepsALog) {
  const Outcome quiet = run_blocklift("assess lift -q --log run.log");
  EXPECT_EQ(quiet.exit_code, 0) << quiet.err;
  EXPECT_TRUE(quiet.out.ends_with("\nverdict: pass\n")) << quiet.out;
  EXPECT_THAT(quiet.out, Not(HasSubstr("R1")));
  EXPECT_TRUE(quiet.err.empty()) << quiet.err;
  const std::string log = text_of_file("run.log");
  for (const char* entry :
       {"crane model \"gantry\" is lift/gantry/crane.yaml\n", "time integration begins\n",
        "verdict: pass\n", "info: exit code 0 after "})
    EXPECT_THAT(log, HasSubstr(entry));

  change("case.yaml", "rope_safety_factor: 5", "rope_safety_facto: 5");
  const Outcome wrong = run_blocklift("validate lift -v --log run.log");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("crane model \"gantry\" is lift/gantry/crane.yaml\n"));
  EXPECT_TRUE(text_of_file("run.log").starts_with(log));
  EXPECT_THAT(text_of_file("run.log"), HasSubstr("has no key \"rope_safety_facto\""));

  EXPECT_EQ(run_blocklift("assess lift -q -v").exit_code, 2);
  const Outcome nowhere = run_blocklift("assess lift --log /proc/nowhere/log");
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("the log \"/proc/nowhere/log\" cannot be written"));
}

TEST_F(AssessCommand, KeepsToEightyColumns) {
  for (const char* const arguments : {"assess lift", "simulate lift"}) {
    std::istringstream lines(run_blocklift(arguments).out);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(line.size(), 80U) << arguments << ": " << line;
    fs::remove_all("results");
  }
}

TEST_F(AssessCommand, GivesNilNoSign) {
  EXPECT_THAT(run_blocklift("assess lift").out, Not(HasSubstr("-0.0")));
}

TEST_F(AssessCommand, TellsALiftThatFailsByItsExitCode) {
  change("case.yaml", "rope_safety_factor: 5", "rope_safety_factor: 1000");
  const Outcome outcome = run_blocklift("assess lift -o out");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("verdict: FAIL\n"));
  EXPECT_THAT(outcome.out,
              HasSubstr("rope R1: tension against breaking load / 1000: utilisation "));
  EXPECT_TRUE(fs::exists("out/report.html"));
  const auto summary = nlohmann::json::parse(text_of_file("out/summary.json"));
  EXPECT_EQ(summary["verdict"], "fail");
}

TEST_F(AssessCommand, WritesNothingOnBadInput) {
  change("case.yaml", "to: L3", "to: L9");
  change("gantry/crane.yaml", "mass: 6 t", "mass: -6 t");
  const Outcome outcome = run_blocklift("assess lift");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("lift/case.yaml:12:27: error: rope R3 ends at lug \"L9\""));
  EXPECT_THAT(outcome.err, HasSubstr("its lugs are L1, L2, L3, L4"));
  EXPECT_THAT(outcome.err, HasSubstr("mass \"-6 t\" must be at least 0"));
  EXPECT_THAT(outcome.err, HasSubstr("2 errors\n"));
  EXPECT_TRUE(written().empty());
  EXPECT_EQ(run_blocklift("assess nowhere").exit_code, 2);
  EXPECT_TRUE(written().empty());
}

// Slings from lug to a point of the block itself: each name exists, and nothing holds the block.
TEST_F(AssessCommand, NamesTheKindOfAFileThatIsNoCase) {
  folder_.write("many.yaml", "study: many\ncase: lift\n");
  const Outcome outcome = run_blocklift("assess many.yaml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("this file describes a study of many lifts, not a lift case"));
  EXPECT_THAT(outcome.err, HasSubstr("blocklift sweep runs it"));
  EXPECT_THAT(outcome.err, HasSubstr("1 error"));
  EXPECT_FALSE(fs::exists("results"));
}

TEST_F(AssessCommand, SaysWhatDoesNotHang) {
  change("case.yaml", "from: C1.left, to: L1",
         "from: {body: load, point: [0 m, 0 m, 5 m]}, to: L1");
  change("case.yaml", "from: C1.right, to: L2",
         "from: {body: load, point: [4 m, 0 m, 5 m]}, to: L2");
  change("case.yaml", "from: C1.left, to: L3",
         "from: {body: load, point: [0 m, 3 m, 5 m]}, to: L3");
  change("case.yaml", "from: C1.right, to: L4",
         "from: {body: load, point: [4 m, 3 m, 5 m]}, to: L4");
  const Outcome outcome = run_blocklift("assess lift");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err,
              HasSubstr("blocklift: error: no static equilibrium was found at t = 0 s"));
  EXPECT_THAT(outcome.err, HasSubstr("slack ropes: "));
  EXPECT_THAT(outcome.err, HasSubstr("\"load\""));
  EXPECT_THAT(outcome.err, HasSubstr("try "));
  EXPECT_TRUE(written().empty());
}

TEST_F(AssessCommand, ARunThatFailsLeavesEarlierResultsAlone) {
  ASSERT_EQ(run_blocklift("assess lift -o out").exit_code, 0);
  const auto before = written();
  // A centre of mass that no outfitting can make is found only with the mesh.
  change("block.yaml", "centre_of_mass: [2.05 m, 1.48 m, 0.75 m]",
         "centre_of_mass: [2.05 m, 1.48 m, 1.9 m]");
  const Outcome outcome = run_blocklift("assess lift -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("density would be negative"));
  EXPECT_EQ(written(), before);
}

TEST_F(AssessCommand, ASecondRunReplacesTheFirst) {
  ASSERT_EQ(run_blocklift("assess lift -o out").exit_code, 0);
  change("case.yaml", "by: -0.6 m", "by: -0.5 m");
  folder_.write("out/notes.txt", "mine");
  const std::string before = text_of_file("out/summary.json");
  ASSERT_EQ(run_blocklift("assess lift -o out").exit_code, 0);
  const auto first = nlohmann::json::parse(before);
  const auto second = nlohmann::json::parse(text_of_file("out/summary.json"));
  EXPECT_NE(first["ropes"], second["ropes"]);
  EXPECT_EQ(text_of_file("out/notes.txt"), "mine");
  EXPECT_EQ(written().size(), 8u);  // the folder, its six files and the notes
}

TEST_F(AssessCommand, TheSameCaseGivesTheSameFigures) {
  ASSERT_EQ(run_blocklift("assess lift -o first").exit_code, 0);
  ASSERT_EQ(run_blocklift("assess lift -o second").exit_code, 0);
  const auto first = nlohmann::json::parse(text_of_file("first/summary.json"));
  const auto second = nlohmann::json::parse(text_of_file("second/summary.json"));
  EXPECT_EQ(first["ropes"], second["ropes"]);
  EXPECT_EQ(first["structure"]["simultaneous"]["static"]["checked_von_mises_Pa"],
            second["structure"]["simultaneous"]["static"]["checked_von_mises_Pa"]);
}

TEST_F(AssessCommand, AnOutputThatIsAFileIsRefusedBeforeTheRun) {
  folder_.write("taken", "a file");
  const Outcome outcome = run_blocklift("assess lift --output taken");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "blocklift: error: the results cannot go into \"taken\": it is a file; "
            "--output takes a folder\n");
  EXPECT_EQ(written().size(), 1u);
}

TEST_F(AssessCommand, ReportIsMadeFromTheResultsAlone) {
  ASSERT_EQ(run_blocklift("assess lift -o out").exit_code, 0);
  fs::rename("lift", "gone");
  fs::create_directory("elsewhere");
  for (const char* file : {"results.h5", "summary.json"})
    fs::copy(fs::path("out") / file, fs::path("elsewhere") / file);
  const Outcome outcome = run_blocklift("report elsewhere");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "report: elsewhere/report.html\n");
  const std::string page = text_of_file("elsewhere/report.html");
  EXPECT_GT(page.size(), 100'000u);
  EXPECT_THAT(page.substr(0, 2000), HasSubstr("small-lift"));
  ASSERT_EQ(run_blocklift("report elsewhere").exit_code, 0);
  EXPECT_EQ(text_of_file("elsewhere/report.html"), page);
}

TEST_F(AssessCommand, ReportOfNothingSaysWhatIsMissing) {
  const Outcome outcome = run_blocklift("report lift");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("lift/summary.json: error: there is no such file"));
  EXPECT_THAT(outcome.err, HasSubstr("lift/results.h5: error: there is no such file"));
  EXPECT_FALSE(fs::exists("lift/report.html"));
}

// The README's five lines, and then every dataset.
TEST_F(AssessCommand, ResultsAreReadableInPython) {
  ASSERT_EQ(run_blocklift("assess lift -o out").exit_code, 0);
  folder_.write("read.py", R"(import h5py
results = h5py.File("out/results.h5")
tension = results["dynamic/ropes/R1/tension"]
print("%.0f %s, %s" % (tension[:].max(), tension.attrs["units"], tension.attrs["description"]))
print(sorted(results["dynamic/ropes"]))

count = 0
def look(name, item):
    global count
    if isinstance(item, h5py.Dataset):
        count += 1
        item[()]
        assert isinstance(item.attrs["units"], str), name
        assert item.attrs["description"], name
        assert item.attrs["units"] or item.dtype.kind == "O", name + " has no units"
results.visititems(look)
print(count > 60)
)");
  const Outcome outcome = test::run_command("/usr/bin/python3 read.py");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(text_of_file("out/summary.json"));
  const double largest = summary["ropes"][0]["max_dynamic_tension_N"];
  EXPECT_EQ(outcome.out, std::to_string(std::lround(largest)) +
                             " N, tension of the rope, all falls together\n"
                             "['R1', 'R2', 'R3', 'R4']\nTrue\n");
}

TEST_F(AssessCommand, TellsWrongUseByItsExitCode) {
  const Outcome unknown = run_blocklift("asess lift");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_EQ(unknown.err,
            "blocklift: error: there is no command \"asess\"\n"
            "    the commands are assess, compare, expect, new, simulate, validate, stress, hydro, "
            "report, "
            "rig, sweep, measured, ... (14 in all); did you mean \"assess\"?\n");
  const Outcome option = run_blocklift("assess lift --fast");
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.err, HasSubstr("--fast"));
  EXPECT_EQ(run_blocklift("assess").exit_code, 2);
  EXPECT_EQ(run_blocklift("assess lift --output").exit_code, 2);
  EXPECT_EQ(run_blocklift("report").exit_code, 2);
  EXPECT_EQ(run_blocklift("assess --help").exit_code, 0);
  EXPECT_TRUE(written().empty());
}

}  // namespace
}  // namespace blocklift::pipeline
