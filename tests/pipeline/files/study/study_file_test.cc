#include "pipeline/files/study/study_file.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// What is said of a study with these lines behind the first two.
std::string complaints(const std::string& lines) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "study.yaml";
  folder.write(file, "study: s\ncase: lift\n" + lines);
  Diagnostics diagnostics;
  const auto study = read_study_file(file, diagnostics);
  EXPECT_EQ(study.has_value(), !diagnostics.has_errors());
  return diagnostics.to_text();
}

/// What is said of a study whose one variable has this spread.
std::string complaints_about_spread(const std::string& spread) {
  return complaints("members: 10\nvary: {a: {keys: [x], spread: {" + spread + "}}}\n");
}

TEST(StudyFile, ReadsWhatVaries) {
  EXPECT_EQ(complaints("members: 10\n"
                       "vary:\n"
                       "  a: {keys: [load.mass], spread: {law: normal, mean: 3 t, deviation: 5 kg, "
                       "lowest: 2 t}}\n"
                       "  b: {keys: [x, 'm:y'], values: [1, 2]}\n"),
            "");
}

TEST(StudyFile, TellsALiftCaseByWhatItIs) {
  const test::TemporaryFolder folder;
  folder.write("case.yaml", "case: lift\nload: {model: plate}\n");
  Diagnostics diagnostics;
  EXPECT_FALSE(read_study_file("case.yaml", diagnostics));
  EXPECT_EQ(diagnostics.to_text(),
            "case.yaml: error: this file describes a lift case, not a study\n"
            "    blocklift assess runs it; blocklift new study writes a study of a case\n"
            "1 error\n");
}

TEST(StudyFile, RefusesLawsThatMakeNoSense) {
  EXPECT_THAT(complaints_about_spread("law: normal, mean: 3 t"),
              HasSubstr("error: the law lacks its deviation"));
  EXPECT_THAT(complaints_about_spread("law: uniform, lowest: 3 t, highest: 2 t"),
              HasSubstr("highest is not above lowest"));
  EXPECT_THAT(complaints_about_spread("law: uniform, lowest: 3 t, highest: 4 m"),
              HasSubstr("not all of one dimension"));
  EXPECT_THAT(complaints_about_spread("law: uniform, lowest: 3 t, highest: 4 t, mean: 3 t"),
              HasSubstr("mean is no parameter of this law"));
  EXPECT_THAT(complaints_about_spread("law: normal, mean: 3 t, deviation: -1 t"),
              HasSubstr("the deviation is not above zero"));
  EXPECT_THAT(complaints_about_spread("law: gumble"), HasSubstr("did you mean \"gumbel\""));
}

TEST(StudyFile, RefusesDesignsThatMakeNoSense) {
  EXPECT_THAT(complaints("vary: {a: {keys: [x], values: [1]}}\n"),
              HasSubstr("the number of members is missing"));
  const std::string none = complaints("members: 0\nvary: {a: {keys: [x], values: [1]}}\n");
  EXPECT_THAT(none, HasSubstr("members \"0\" must be"));
  EXPECT_THAT(none, Not(HasSubstr("missing")));
  EXPECT_THAT(complaints("design: grid\n"
                         "vary: {a: {keys: [x], spread: {law: uniform, lowest: 3, highest: 4}}}\n"),
              HasSubstr("a grid takes values and no spread"));
  EXPECT_THAT(complaints("design: sensitivity\nmembers: 4\nvary: {a: {keys: [x], values: [1]}}\n"),
              HasSubstr("Sobol' indices need a spread"));
  const std::string uniform =
      "vary: {a: {keys: [x], spread: {law: uniform, lowest: 3, highest: 4}}}\n";
  EXPECT_THAT(complaints("design: sensitivity\nmembers: 7\n" + uniform),
              HasSubstr("Sobol' indices need 8 members at least"));
  EXPECT_EQ(complaints("design: sensitivity\nmembers: 8\nseed: 3\n" + uniform), "");
  EXPECT_THAT(complaints("design: low discrepancy\nmembers: 8\nseed: 3\n" + uniform),
              HasSubstr("study.yaml:5:7: error: this design draws nothing at random"));
  EXPECT_THAT(complaints("members: 4\nvary: {a: {keys: [x]}}\n"),
              HasSubstr("one of values, spread and between is due"));
}

// The second of two may have been meant to be another.
TEST(StudyFile, RefusesAFigureThatIsNamedTwice) {
  const std::string grid =
      "design: grid\nvary:\n  a: {keys: [x], values: [1 m]}\n  b: {keys: [y], values: [4 s]}\n";
  EXPECT_THAT(complaints(grid + "figures:\n  - ropes.R1.slack\n  - other\n  - ropes.R1.slack\n"),
              HasSubstr("study.yaml:10:5: error: ropes.R1.slack is among figures already, in line "
                        "8\n1 error"));
  EXPECT_THAT(complaints(grid + "limits: {height: a, period: b,\n"
                                "  of: [{figure: f, at: 3}, {figure: f, at: 4}]}\n"),
              HasSubstr("study.yaml:8:37: error: f is limited already, in line 8\n1 error"));
  const std::string search =
      "design: search\nmembers: 20\nminimise: f\nvary: {a: {keys: [x], between: [1, 2]}}\n"
      "subject_to:\n  - {figure: g, at_most: 3}\n";
  EXPECT_EQ(complaints(search + "  - {figure: g, at_least: 1}\n"), "");
  EXPECT_THAT(complaints(search + "  - {figure: g, at_most: 1}\n"),
              HasSubstr("study.yaml:9:14: error: g is bounded by at_most already, in line 8"));
}

TEST(StudyFile, WritesCountsInFull) {
  const std::string vary = "vary: {a: {keys: [x], values: [1, 2]}}\n";
  EXPECT_THAT(complaints("members: 2000000\n" + vary),
              HasSubstr("members \"2000000\" must be from 1 to 1000000\n"));
  std::string values = "1";
  for (int value = 2; value <= 2000; ++value) values += ", " + std::to_string(value);
  EXPECT_THAT(complaints("design: grid\nvary:\n  a: {keys: [x], values: [" + values +
                         "]}\n  b: {keys: [y], values: [" + values + "]}\n"),
              HasSubstr("the grid has 4000000 members; 1000000 are allowed"));
}

// What could not be read is complained of once: no rule has anything to say of it.
TEST(StudyFile, SaysOneThingOfOneBadValue) {
  const auto expect_one = [](const std::string& lines, const char* text) {
    const std::string said = complaints(lines);
    EXPECT_THAT(said, HasSubstr(text)) << lines;
    EXPECT_THAT(said, HasSubstr("\n1 error\n")) << lines;
  };
  for (const char* values : {"[2 m, 1 furlng]", "[1 furlng, 2 m]", "[0 m, 1 furlng, 3 m]"})
    expect_one("design: grid\nvary: {a: {keys: [x], values: " + std::string(values) + "}}\n",
               "furlng");
  expect_one(
      "design: grid\nvary:\n  a: {keys: [x], values: [1 furlng]}\n  b: {keys: [y], values: [4 s]}\n"
      "limits: {height: a, period: b, of: [{figure: f, at: 3}]}\n",
      "furlng");
  for (const char* between : {"[1 furlng, 9 t]", "[9 t, 1 furlng]"})
    expect_one("design: search\nmembers: 20\nminimise: f\nvary: {a: {keys: [x], between: " +
                   std::string(between) + "}}\n",
               "furlng");
  for (const char* design : {"gird", "serch", "sensitive"})
    expect_one("design: " + std::string(design) + "\nvary: {a: {keys: [x], values: [1, 2]}}\n",
               design);
  expect_one("design: serch\nmembers: 20\nminimise: f\nvary: {a: {keys: [x], between: [1, 2]}}\n",
             "did you mean \"search\"");
  for (const char* spread :
       {"law: normal, mean: 3 tn, deviation: 5 kg", "law: normal, mean: 3 t, deviation: 5 kgg",
        "law: uniform, lowest: 3 tt, highest: 4 t", "law: lognormal, mean: 3 tn, deviation: 5 kg",
        "law: unifrm, lowest: 3 t, highest: 4 t", "law: normal, mean: , deviation: 5 kg",
        "law: weibull, mean: 3 t, deviation: ", "law: , lowest: 3 t, highest: 4 t"})
    EXPECT_THAT(complaints_about_spread(spread), HasSubstr("\n1 error\n")) << spread;
  const std::string two =
      "members: 9\nvary:\n"
      "  a: {keys: [x], spread: {law: normal, mean: 3, deviation: 1}}\n"
      "  b: {keys: [y], spread: {law: normal, mean: 3, deviation: 1}}\n"
      "correlations:\n";
  for (const char* correlation :
       {"is: 1.5", "kendall: -2", "copula: studnt, kendall: 0.5, degrees: 4",
        "is: ", "kendall: ", "copula: gumbel, kendall: lots", "copula: clayton, kendall: -1.5",
        "copula: , is: 0.5", "copula: student, is: 0.5, degrees: "})
    expect_one(two + "  - {of: [a, b], " + correlation + "}\n", "error");
}

// The unit of the first serves all.
TEST(StudyFile, RefusesValuesOfSeveralDimensions) {
  EXPECT_THAT(complaints("members: 4\nvary: {a: {keys: [x], values: [8 t, 3 m, 9 t]}}\n"),
              HasSubstr("study.yaml:4:37: error: the values of a variable are not all of one "
                        "dimension\n1 error\n"));
}

TEST(StudyFile, RefusesSeaLimitsThatMakeNoSense) {
  const std::string seas =
      "  Hs: {keys: [x], values: [1 m, 2 m]}\n  Tp: {keys: [y], values: [6 s, 8 s]}\n";
  const auto of = [&](const std::string& limits, const std::string& design = "grid") {
    return complaints("design: " + design + "\nvary:\n" + seas + "limits: {" + limits + "}\n");
  };
  const std::string load = "of: [{figure: f_N, at: 3 kN}]";
  EXPECT_EQ(of("height: Hs, period: Tp, alpha: 0.8, " + load), "");
  EXPECT_THAT(of("height: Hs, period: Tp, " + load, "random\nmembers: 9"),
              HasSubstr("limits need design: grid"));
  EXPECT_THAT(of("height: Hz, period: Tp, " + load), HasSubstr("no variable is called Hz"));
  EXPECT_THAT(of("height: Tp, period: Tp, " + load),
              HasSubstr("study.yaml:6:28: error: a length is due, for Tp of the limits"));
  EXPECT_THAT(of("height: Hs, period: Tp, heading: Hs, " + load),
              HasSubstr("is due, for Hs of the limits"));
  EXPECT_THAT(of("height: Hs, " + load), HasSubstr("lacks the key \"period\""));
  EXPECT_THAT(of("height: Hs, period: Tp, of: []"), HasSubstr("1 error"));
  EXPECT_THAT(of("height: Hs, period: Tp, alpha: 1.2, " + load), HasSubstr("alpha"));
  const std::string table = "height: Hs, period: Tp, alpha_table: a.csv, ";
  EXPECT_EQ(of(table + "planned_period: 20 h, forecast: f.csv, " + load), "");
  EXPECT_THAT(of(table + "planned_period: 20 h, alpha: 0.8, forecast: f.csv, " + load),
              HasSubstr("either alpha or alpha_table is due"));
  EXPECT_THAT(of(table + "forecast: f.csv, " + load), HasSubstr("needs the planned_period"));
  EXPECT_THAT(of(table + "planned_period: 20 h, " + load), HasSubstr("there is neither"));
  EXPECT_THAT(of(table + "planned_period: 20 m, forecast: f.csv, " + load), HasSubstr("error"));
  EXPECT_THAT(of("height: Hs, period: Tp, planned_period: 20 h, forecast: f.csv, " + load),
              HasSubstr("planned_period goes with alpha_table"));
  EXPECT_EQ(of(table + "planned_period: 20 h, contingency: 6 h, forecast: f.csv, " + load), "");
  EXPECT_THAT(of(table + "planned_period: 20 h, contingency: 6 h, scatter: f.csv, " + load),
              HasSubstr("contingency goes with planned_period and a forecast"));
  EXPECT_THAT(of(table + "planned_period: 20 h, contingency: -6 h, forecast: f.csv, " + load),
              HasSubstr("error"));
  EXPECT_THAT(complaints("design: grid\nfigures: [g_N]\nvary:\n" + seas +
                         "limits: {height: Hs, period: Tp, " + load + "}\n"),
              HasSubstr("the figure is limited, but not among figures"));
}

// Of two values for one key the second would be the key's, and the first would do nothing.
TEST(StudyFile, RefusesAKeyThatTwoVariablesChange) {
  EXPECT_THAT(complaints("members: 4\n"
                         "vary:\n"
                         "  a: {keys: [x, y], values: [1]}\n"
                         "  b: {keys: [z, x], values: [2]}\n"),
              HasSubstr("study.yaml:6:17: error: x varies already, with a\n"));
}

TEST(StudyFile, RefusesCorrelationsThatMakeNoSense) {
  const std::string laws =
      "members: 9\nvary:\n"
      "  a: {keys: [x], spread: {law: normal, mean: 3, deviation: 1}}\n"
      "  b: {keys: [y], spread: {law: normal, mean: 3, deviation: 1}}\n"
      "  c: {keys: [z], spread: {law: uniform, lowest: 3, highest: 4}}\n"
      "  d: {keys: [w], values: [1, 2]}\n"
      "correlations:\n";
  EXPECT_EQ(complaints(laws + "  - {of: [a, b], is: 0.5}\n  - {of: [c, b], is: -0.5}\n"), "");
  EXPECT_THAT(complaints(laws + "  - {of: [a, e], is: 0.5}\n"),
              HasSubstr("no variable with a spread is called e"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, d], is: 0.5}\n"),
              HasSubstr("no variable with a spread is called d"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, a], is: 0.5}\n"),
              HasSubstr("not correlated with itself"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], is: 0.5}\n  - {of: [b, a], is: 0.5}\n"),
              HasSubstr("these two have a correlation already"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], is: 1.5}\n"), HasSubstr("error"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b, c], is: 0.5}\n"), HasSubstr("error"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], is: 0.9}\n  - {of: [b, c], is: 0.9}\n"
                                "  - {of: [a, c], is: -0.9}\n"),
              HasSubstr("contradict each other"));
  EXPECT_THAT(complaints("design: sensitivity\n" + laws + "  - {of: [a, b], is: 0.5}\n"),
              HasSubstr("correlations go with design: random"));
}

TEST(StudyFile, RefusesAValueThatIsOnTheGridTwice) {
  const std::string twice = "vary: {a: {keys: [x], values: [1.6 m, 2 m, 1.6 m]}}\n";
  EXPECT_THAT(complaints("design: grid\n" + twice),
              HasSubstr("error: this value is on the grid already"));
  EXPECT_EQ(complaints("members: 9\n" + twice), "");
}

TEST(StudyFile, RefusesCopulasThatMakeNoSense) {
  const std::string laws =
      "members: 9\nvary:\n"
      "  a: {keys: [x], spread: {law: normal, mean: 3, deviation: 1}}\n"
      "  b: {keys: [y], spread: {law: normal, mean: 3, deviation: 1}}\n"
      "  c: {keys: [z], spread: {law: normal, mean: 3, deviation: 1}}\n"
      "correlations:\n";
  EXPECT_EQ(complaints(laws + "  - {of: [a, b], copula: student, kendall: -0.5, degrees: 4}\n"),
            "");
  EXPECT_EQ(complaints(laws + "  - {of: [a, b], copula: gumbel, kendall: 0.5}\n"), "");
  EXPECT_THAT(complaints(laws + "  - {of: [a, b]}\n"), HasSubstr("either is or kendall is due"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], is: 0.5, kendall: 0.5}\n"),
              HasSubstr("either is or kendall is due"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], copula: clayton, is: 0.5}\n"),
              HasSubstr("this copula takes kendall, and no is"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], copula: gumbel, kendall: -0.5}\n"),
              HasSubstr("kendall is above zero"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], copula: frank, kendall: 0}\n"),
              HasSubstr("need no correlation"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], copula: student, is: 0.5}\n"),
              HasSubstr("Student's copula lacks its degrees"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], is: 0.5, degrees: 4}\n"),
              HasSubstr("degrees go with copula: student"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], copula: joe, kendall: 0.5}\n"),
              HasSubstr("error"));
  EXPECT_THAT(complaints(laws + "  - {of: [a, b], copula: frank, kendall: 0.5}\n"
                                "  - {of: [c, b], is: 0.5}\n"),
              HasSubstr("b has another correlation: only normal copulas join more than two"));
}

}  // namespace
}  // namespace blocklift::pipeline
