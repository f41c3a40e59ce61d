#include "pipeline/comparison/comparison.h"

#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/declaration/diagnostics.h"
#include "tests/pipeline/comparison/sample_folder.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Folders "before" and "after": R1 pulls 10 % more in motion, the stress increases by a point
/// more, one key of the case and one of its block differ.
class ComparedFolders : public ::testing::Test {
 protected:
  ComparedFolders() {
    test::write_sample_folder("before", test::sample_summary(),
                              "case: two-ropes\nsettle: 3 s\ngravity: 9.81 m/s^2\n",
                              "kind: block\nmass: 8 t\n");
    ordered_json after = test::sample_summary();
    after["ropes"][0]["max_dynamic_tension_N"] = 121e3;
    after["structure"]["simultaneous"]["stress_increase_percent"] = 13.0;
    test::write_sample_folder("after", after,
                              "case: two-ropes # a remark is no difference\nsettle: 4 s\n"
                              "wind: {speed: 8 m/s}\ngravity: 9.81 m/s^2\n",
                              "kind: block\nmass: 9 t\n");
  }

  static ResultComparison compare(const std::string& tolerance = {}) {
    return compare_results(
        read_compared_results({"before", "after"}),
        tolerance.empty() ? std::vector<Tolerance>{} : read_tolerances(tolerance));
  }
  static std::string refusal_of(const std::vector<std::filesystem::path>& paths,
                                const std::string& tolerance = {}) {
    try {
      compare_results(read_compared_results(paths),
                      tolerance.empty() ? std::vector<Tolerance>{} : read_tolerances(tolerance));
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was refused";
  }

  const test::TemporaryFolder folder_;
};

TEST_F(ComparedFolders, SayWhichKeysOfTheInputDiffer) {
  const ResultComparison comparison = compare();
  ASSERT_EQ(comparison.input.size(), 3u);
  EXPECT_EQ(comparison.input[0].file, "");
  EXPECT_EQ(comparison.input[0].key, "settle");
  EXPECT_EQ(comparison.input[0].values[0], "3 s");
  EXPECT_EQ(comparison.input[0].values[1], "4 s");
  EXPECT_EQ(comparison.input[1].key, "wind.speed");
  EXPECT_EQ(comparison.input[1].values[0], std::nullopt);
  EXPECT_EQ(comparison.input[2].file, "block");
  EXPECT_EQ(comparison.input[2].key, "mass");
}

TEST(ComparedInput, SaysTheSameInOtherUnits) {
  EXPECT_TRUE(is_same_value("4 m", "400 cm"));
  EXPECT_TRUE(is_same_value("4 m", "4.0 m"));
  EXPECT_TRUE(is_same_value("[1 m, 0 m, [2 t, x]]", "[100 cm,0 mm, [2000 kg, x]]"));
  EXPECT_FALSE(is_same_value("4 m", "401 cm"));
  EXPECT_FALSE(is_same_value("4 m", "4 s"));
  EXPECT_FALSE(is_same_value("4 m", "4"));
  EXPECT_FALSE(is_same_value("C1.hook", "C2.hook"));
  EXPECT_FALSE(is_same_value("[1 m, 2 m]", "[1 m, 2 m, 3 m]"));
  EXPECT_FALSE(is_same_value("[1 m, 2 m]", "1 m"));
}

TEST_F(ComparedFolders, KeysInOtherUnitsDoNotDiffer) {
  test::write_sample_folder("before", test::sample_summary(),
                            "case: two-ropes\nsettle: 3 s\nload: {position: [1 m, 0 m]}\n", "");
  test::write_sample_folder("after", test::sample_summary(),
                            "case: two-ropes\nsettle: 3000 ms\nload: {position: [100 cm, 0 mm]}\n",
                            "");
  EXPECT_THAT(compare().input, ::testing::IsEmpty());
}

TEST_F(ComparedFolders, CountChangesFromTheFirst) {
  for (const ComparedFigure& figure : compare().figures) {
    const double expected = figure.figure.path == "ropes.R1.max_dynamic_tension_N" ? 10
                            : figure.figure.path == "structure.simultaneous.stress_increase_percent"
                                ? 1
                                : 0;
    if (figure.figure.path == "verdict")
      EXPECT_EQ(figure.change(1), std::nullopt);
    else
      EXPECT_NEAR(figure.change(1).value(), expected, 1e-9) << figure.figure.path;
  }
}

TEST_F(ComparedFolders, AreHeldToTolerancesOfWhichTheLastCounts) {
  EXPECT_THAT(compare("ropes=10.1%,stress_increase=1%").moved, IsEmpty());
  const ResultComparison beyond = compare("ropes=9.9%,stress_increase=0.9%");
  ASSERT_EQ(beyond.moved.size(), 2u);
  EXPECT_EQ(shown_move(beyond, beyond.moved[0]),
            "ropes.R1.max_dynamic_tension_N of after: 121.00 instead of 110.00 kN (+10.00 %), "
            "beyond 9.9%");
  EXPECT_THAT(compare("ropes=1%,ropes.R1=12 kN").moved, IsEmpty());
  EXPECT_EQ(compare("ropes.R1=12 kN,ropes=1%").moved.size(), 1u);
  EXPECT_EQ(compare("ropes.*.max_dynamic_tension=10.9 kN").moved.size(), 1u);
  EXPECT_THAT(compare("verdict=0%").moved, IsEmpty());
}

// Of zero there is no share: what came in its place is shown as it is, and a tolerance in per cent
// allows rounding alone, one with a unit what it says.
TEST_F(ComparedFolders, MayCountFromZero) {
  const auto rope_from = [](double before, double after) {
    ordered_json summary = test::sample_summary();
    summary["ropes"][0]["max_dynamic_tension_N"] = before;
    test::write_sample_folder("before", summary, "case: two-ropes\n", "kind: block\n");
    summary["ropes"][0]["max_dynamic_tension_N"] = after;
    test::write_sample_folder("after", summary, "case: two-ropes\n", "kind: block\n");
  };
  rope_from(0, 250);
  const ResultComparison shares = compare("ropes.R1.max_dynamic_tension=50%");
  ASSERT_EQ(shares.moved.size(), 1u);
  EXPECT_EQ(shown_move(shares, shares.moved[0]),
            "ropes.R1.max_dynamic_tension_N of after: 0.25000 instead of 0.00000 kN (from 0), "
            "beyond 50% of 0");
  const ordered_json json = comparison_json(shares);
  EXPECT_EQ(json["figures"][2]["difference"], ordered_json({0.0, 250.0}));
  EXPECT_EQ(json["figures"][2]["change_percent"][1], nullptr);
  EXPECT_EQ(compare("ropes.R1.max_dynamic_tension=0.2 kN").moved.size(), 1u);
  EXPECT_THAT(compare("ropes.R1.max_dynamic_tension=0.3 kN").moved, IsEmpty());
  // The other rope pulls 230 kN: what is below 0.2 mN is rounding, on both sides.
  for (const auto& [before, after] :
       {std::pair(0.0, 0.0), std::pair(0.0, 4e-6), std::pair(-4e-6, 4e-6), std::pair(4e-6, 0.0)}) {
    rope_from(before, after);
    const ResultComparison rounded = compare("ropes.R1.max_dynamic_tension=0%");
    EXPECT_THAT(rounded.moved, IsEmpty()) << before << ' ' << after;
    EXPECT_EQ(shown_change(rounded.figures[2], 1), "") << before << ' ' << after;
  }
  rope_from(4e-6, 250);
  EXPECT_EQ(compare("ropes.R1.max_dynamic_tension=50%").moved.size(), 1u);
  // To zero is all of it.
  rope_from(250, 0);
  EXPECT_EQ(compare("ropes.R1.max_dynamic_tension=99%").moved.size(), 1u);
  EXPECT_THAT(compare("ropes.R1.max_dynamic_tension=100%").moved, IsEmpty());
}

// Ten characters would touch the figure beside them.
TEST(ShownChange, KeepsToItsColumnHoweverLarge) {
  ComparedFigure figure;
  figure.values = {5.37, 248.41};
  EXPECT_EQ(shown_change(figure, 1), "+4526 %");
  figure.values = {-1.0, -10.99};
  EXPECT_EQ(shown_change(figure, 1), "-999.00 %");
}

TEST_F(ComparedFolders, RefuseTolerancesThatFitNoFigure) {
  EXPECT_THAT(refusal_of({"before", "after"}, "stres_increase=1%"),
              HasSubstr("did you mean \"stress_increase\"?"));
  EXPECT_THAT(refusal_of({"before", "after"}, "ropes.R1.max_static_tension=1 MPa"),
              HasSubstr("ropes.R1.max_static_tension_N is in N"));
  EXPECT_THAT(refusal_of({"before", "after"}, " "), HasSubstr("--tolerance: error: it is empty"));
}

TEST_F(ComparedFolders, AFigureThatOnlyOneHasHasMoved) {
  ordered_json lost = test::sample_summary();
  lost["ropes"].erase(1);
  test::write_sample_folder("after", lost, "case: two-ropes\n", "kind: block\n");
  EXPECT_EQ(compare("ropes=1%").moved.size(), 3u);
}

TEST_F(ComparedFolders, GiveATableOfEightyColumns) {
  std::filesystem::copy("after", "a third one with a name that is far too long for a column");
  const ResultComparison comparison = compare_results(
      read_compared_results(
          {"before", "after", "a third one with a name that is far too long for a column"}),
      {});
  for (const ResultComparison& one : {comparison, compare("ropes=20%")}) {
    const std::string text = comparison_text(one);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
    EXPECT_THAT(text, HasSubstr("wind.speed"));
    EXPECT_THAT(text, HasSubstr("+10.00 %"));
    EXPECT_THAT(text, HasSubstr("+1.00 pt"));
  }
  EXPECT_THAT(comparison_text(compare("ropes=20%")),
              HasSubstr("no figure moved beyond its tolerance; figures that have one: 6\n"));
  // What tells figures apart stands at the end of their labels.
  EXPECT_THAT(comparison_text(comparison), HasSubstr(" largest rope load: stress\n   increase, %"));
}

TEST_F(ComparedFolders, OfSeveralVersionsAreToldApart) {
  EXPECT_THAT(comparison_text(compare()), Not(HasSubstr("versions of the program")));
  ordered_json newer = test::sample_summary();
  newer["program_version"] = "9.8.7";
  test::write_sample_folder("after", newer, "case: two-ropes\n", "kind: block\n");
  const ResultComparison comparison = compare();
  EXPECT_THAT(comparison_text(comparison), HasSubstr("versions of the program differ\n"));
  EXPECT_THAT(comparison_text(comparison), HasSubstr("    after                 9.8.7\n"));
  EXPECT_EQ(comparison_json(comparison)["results"][1]["program_version"], "9.8.7");
}

TEST_F(ComparedFolders, GiveJsonInTheSummarysUnits) {
  const ordered_json json = comparison_json(compare("ropes=5%"));
  EXPECT_EQ(json["results"][1]["name"], "after");
  EXPECT_EQ(json["input"][0]["values"], ordered_json({"3 s", "4 s"}));
  EXPECT_EQ(json["input"][1]["values"][0], nullptr);
  EXPECT_EQ(json["figures"][2]["figure"], "ropes.R1.max_dynamic_tension_N");
  EXPECT_EQ(json["figures"][2]["values"], ordered_json({110e3, 121e3}));
  EXPECT_EQ(json["figures"][2]["unit"], "N");
  EXPECT_EQ(json["figures"][0]["unit"], "");  // the verdict
  EXPECT_EQ(json["beyond_tolerance"][0]["tolerance"], "5%");
}

TEST_F(ComparedFolders, GiveAPageWithTheCurvesOfBoth) {
  const std::string page = comparison_page(compare());
  EXPECT_THAT(page, HasSubstr("<title>before, after"));
  EXPECT_THAT(page, HasSubstr("wind.speed"));
  EXPECT_THAT(page, HasSubstr("\"name\":\"after\""));
  EXPECT_THAT(page, Not(HasSubstr("%DATA%")));
}

TEST_F(ComparedFolders, ModelsAreLeftOutWhereOneResultHoldsNone) {
  test::write_sample_folder("before", test::sample_summary(), "case: two-ropes\n", "");
  const ResultComparison comparison = compare();
  for (const InputDifference& difference : comparison.input) EXPECT_EQ(difference.file, "");
  EXPECT_THAT(comparison_text(comparison), HasSubstr("models are not compared"));
}

TEST_F(ComparedFolders, ACaseStandsForItsResults) {
  folder_.write("lift/case.yaml", "case: two-ropes\nsettle: 3 s\ngravity: 9.81 m/s^2\n");
  EXPECT_THAT(refusal_of({"lift", "after"}),
              HasSubstr("lift/case.yaml: error: the case has no results"));
  std::filesystem::create_directory("results");
  std::filesystem::copy("before", "results/two-ropes");
  EXPECT_EQ(read_compared_result("lift").name, "lift");
  EXPECT_EQ(read_compared_result("lift/case.yaml").folder, "results/two-ropes");
  folder_.write("lift/case.yaml", "case: two-ropes\nsettle: 5 s\ngravity: 9.81 m/s^2\n");
  EXPECT_THAT(refusal_of({"lift", "after"}),
              HasSubstr("the case was changed after its results in results/two-ropes"));
}

// A model of a folder of models is held against as well; one beside the case comes first.
/// The folder "library" is the only one of models, as long as this lives.
class LibraryInFolder {
 public:
  LibraryInFolder() {
    if (const char* before = std::getenv(variable)) before_ = before;
    setenv(variable, "library", 1);
  }
  ~LibraryInFolder() {
    if (before_) {
      setenv(variable, before_->c_str(), 1);
    } else {
      unsetenv(variable);
    }
  }
  LibraryInFolder(const LibraryInFolder&) = delete;
  LibraryInFolder& operator=(const LibraryInFolder&) = delete;

 private:
  static constexpr const char* variable = "BLOCKLIFT_MODELS";
  std::optional<std::string> before_;
};

TEST_F(ComparedFolders, AModelOfTheLibraryThatWasChangedIsNamed) {
  folder_.write("lift/case.yaml", "case: two-ropes\nsettle: 3 s\ngravity: 9.81 m/s^2\n");
  std::filesystem::create_directory("results");
  std::filesystem::copy("before", "results/two-ropes");
  folder_.write("library/block/block.yaml", "kind: block\nmass: 9 t\n");
  const LibraryInFolder library;
  EXPECT_THAT(refusal_of({"lift", "after"}),
              HasSubstr("the case's model block was changed after its results"));
  folder_.write("lift/block.yaml", "kind: block\nmass: 8 t\n");
  EXPECT_EQ(read_compared_result("lift").name, "lift");
}

TEST_F(ComparedFolders, AModelBesideTheCaseThatWasChangedIsNamed) {
  folder_.write("lift/case.yaml", "case: two-ropes\nsettle: 3 s\ngravity: 9.81 m/s^2\n");
  std::filesystem::create_directory("results");
  std::filesystem::copy("before", "results/two-ropes");
  folder_.write("lift/block.yaml", "kind: block\nmass: 8000 kg  # as before\n");
  EXPECT_EQ(read_compared_result("lift").name, "lift");
  folder_.write("lift/block.yaml", "kind: block\nmass: 9 t\n");
  EXPECT_THAT(refusal_of({"lift", "after"}),
              HasSubstr("lift/case.yaml: error: the case's model block was changed after its "
                        "results in results/two-ropes were computed"));
  // A model may be a folder, of a vessel as of all others.
  std::filesystem::remove("lift/block.yaml");
  folder_.write("lift/block/vessel.yaml", "kind: vessel\nmass: 9 t\n");
  EXPECT_THAT(refusal_of({"lift", "after"}), HasSubstr("the case's model block was changed"));
}

// Two cases of one name were assessed into one folder: it holds the lift of the later.
TEST_F(ComparedFolders, TwoCasesDoNotStandForOneResult) {
  const std::string yaml = "case: two-ropes\nsettle: 3 s\ngravity: 9.81 m/s^2\n";
  folder_.write("lift/case.yaml", yaml);
  folder_.write("heavy/case.yaml", yaml);
  std::filesystem::create_directory("results");
  std::filesystem::copy("before", "results/two-ropes");
  EXPECT_THAT(refusal_of({"lift", "heavy"}),
              HasSubstr("heavy: error: results/two-ropes stands for this and for lift\n"
                        "    give the cases names of their own"));
  EXPECT_EQ(read_compared_results({"lift", "results/two-ropes"}).size(), 2U);
  EXPECT_EQ(read_compared_results({"lift", "lift/../lift"}).size(), 2U);
}

TEST_F(ComparedFolders, OthersAreRefusedAllAtOnce) {
  folder_.write("empty/notes.txt", "");
  folder_.write("damaged/summary.json", "{");
  const std::string refusal = refusal_of({"before", "empty", "damaged", "nowhere"});
  EXPECT_THAT(refusal, HasSubstr("empty: error: this folder has neither results nor a case"));
  EXPECT_THAT(refusal, HasSubstr("damaged"));
  EXPECT_THAT(refusal, HasSubstr("nowhere"));
}

TEST_F(ComparedFolders, OfOneNameAreToldApartByTheirPaths) {
  std::filesystem::create_directories("later/x");
  std::filesystem::copy("after", "later/before");
  const auto results = read_compared_results({"before", "later/before"});
  EXPECT_EQ(results[0].name, "before");
  EXPECT_EQ(results[1].name, "later/before");
}

}  // namespace
}  // namespace blocklift::pipeline
