// Figures that a lift is held to: what is read, held, written and renewed.
#include "pipeline/comparison/expected_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/comparison/summary_figures.h"
#include "pipeline/declaration/diagnostics.h"
#include "tests/pipeline/comparison/sample_folder.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::vector<ExpectedFigure> read_text(const std::string& text) {
  const test::TemporaryFolder folder;
  folder.write("figures.json", text);
  return read_expected_figures("figures.json");
}

std::string refusal_of(const std::string& text) {
  try {
    read_text(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

/// Complaints about a figure in the sample summary; "held" if there are none.
std::string outcome_of(const std::string& requirements) {
  const auto figures = read_text("[{" + requirements + ", \"reason\": \"a test\"}]");
  const auto broken = find_broken_figures(figures, test::sample_summary());
  return broken.empty() ? "held" : broken.front().complaint;
}

TEST(ExpectedFigures, FindPlacesByKeysAndNamesThatMayHoldDots) {
  const auto summary = test::sample_summary();
  EXPECT_EQ(*find_figure(summary, "verdict"), "pass");
  EXPECT_EQ(*find_figure(summary, "ropes.R2.max_static_tension_N"), 200e3);
  EXPECT_EQ(*find_figure(summary, "checks.hook C1.left.utilisation"), 0.5);
  EXPECT_EQ(*find_figure(summary, "natural_periods.at the start.modes.pendulum.period_s"), 7.5);
  for (const char* nowhere : {"", "ropes.R3.max_static_tension_N", "ropes.R1.", "ropes.R1.length",
                              "rope", "checks.hook C1.utilisation"})
    EXPECT_EQ(find_figure(summary, nowhere), nullptr) << nowhere;
}

TEST(ExpectedFigures, AreHeldUpToTheirToleranceAndNoFurther) {
  const std::string tension = R"("figure": "ropes.R1.max_static_tension_N", )";
  EXPECT_EQ(outcome_of(tension + R"("value": 101e3, "tolerance": 0.01)"), "held");
  EXPECT_EQ(outcome_of(tension + R"("value": 101.1e3, "tolerance": 0.01)"),
            "is 100000 instead of 101100 within 1011");
  EXPECT_EQ(outcome_of(tension + R"("value": 98e3, "absolute_tolerance": 2000)"), "held");
  EXPECT_EQ(outcome_of(tension + R"("value": 98e3, "absolute_tolerance": 1999)"),
            "is 100000 instead of 98000 within 1999");
  EXPECT_EQ(outcome_of(tension + R"("at_least": 100e3)"), "held");
  EXPECT_EQ(outcome_of(tension + R"("at_least": 100001)"), "is 100000 instead of at least 100001");
  EXPECT_EQ(outcome_of(tension + R"("at_most": 99999)"), "is 100000 instead of at most 99999");
  EXPECT_EQ(outcome_of(tension + R"("magnitude_at_most": 99999)"),
            "is 100000 instead of at most 99999 either way");
  EXPECT_EQ(outcome_of(R"("figure": "verdict", "equals": "pass")"), "held");
  EXPECT_EQ(outcome_of(R"("figure": "verdict", "equals": "fail")"), "is \"pass\" instead of fail");
  EXPECT_EQ(outcome_of(R"("figure": "checks.swing.pass", "equals": true)"), "held");
  EXPECT_EQ(outcome_of(R"("figure": "verdict", "at_most": 3)"), "is \"pass\" instead of a number");
  EXPECT_EQ(outcome_of(R"("figure": "checks.swing.utilisation", "value": 0, "tolerance": 1)"),
            "is null instead of a number");
  EXPECT_EQ(outcome_of(R"("figure": "nothing", "at_most": 3)"), "is not in the summary");
}

TEST(ExpectedFigures, AreToldToSixDigitsOrToWhatTheyAreOffBy) {
  const nlohmann::ordered_json summary{{"share", 0.3934303697}};
  const auto complaint = [&](double value, double tolerance) {
    ExpectedFigure figure;
    figure.path = "share";
    figure.value = value;
    figure.tolerance = tolerance;
    return find_broken_figures({figure}, summary).at(0).complaint;
  };
  EXPECT_EQ(complaint(0.375905, 0.02), "is 0.39343 instead of 0.375905 within 0.007518");
  EXPECT_EQ(complaint(0.39343, 1e-7), "is 0.3934303697 instead of 0.39343 within 3.934e-08");
}

TEST(ExpectedFigures, SayWithTheirLineWhatIsWrongInTheirFile) {
  const std::string refusal = refusal_of(R"([
  {"figure": "a", "reason": "none"},
  {"figure": "b", "value": 1, "reason": "no tolerance"},
  {"figure": "c", "value": 1, "tolerance": 0.1, "absolute_tolerance": 1, "reason": "two"},
  {"figure": "d", "at_most": 1, "at_least": 0, "reason": "two"},
  {"figure": "e", "at_most": 1, "tolerance": 0.1, "reason": "of what?"},
  {"figure": "f", "at_mots": 1, "reason": "misspelt"},
  {"figure": "g", "equals": 1}
])");
  EXPECT_THAT(refusal, HasSubstr("figures.json:2:3: error: figure a has no requirements"));
  EXPECT_THAT(refusal, HasSubstr("figures.json:3:3: error: the value of b has no tolerance"));
  EXPECT_THAT(refusal, HasSubstr("figures.json:4:3: error: the value of c has two tolerances"));
  EXPECT_THAT(refusal, HasSubstr("figures.json:5:3: error: figure d has several requirements"));
  EXPECT_THAT(refusal, HasSubstr("figures.json:6:3: error: figure e has a tolerance and no value"));
  EXPECT_THAT(refusal, HasSubstr("did you mean \"at_most\"?"));
  EXPECT_THAT(refusal, HasSubstr("reason"));
  EXPECT_THAT(refusal_of("[]"), HasSubstr("error"));
  EXPECT_THAT(refusal_of("verdict: pass"), HasSubstr("error"));
}

TEST(ExpectedFigures, OfALiftAreHeldByItAndSurviveTheirFile) {
  const auto summary = test::sample_summary();
  const auto figures = expect_figures(summary);
  EXPECT_THAT(find_broken_figures(figures, summary), IsEmpty());
  const auto again = read_text(expected_figures_text(figures));
  EXPECT_EQ(expected_figures_text(again), expected_figures_text(figures));
  std::vector<std::string> paths;
  for (const ExpectedFigure& figure : figures) {
    paths.push_back(figure.path);
    EXPECT_FALSE(figure.reason.empty()) << figure.path;
  }
  // Null figures, such as the swing's utilisation, are nothing that can be held.
  EXPECT_THAT(paths, ElementsAre("verdict", "ropes.R1.max_static_tension_N",
                                 "ropes.R1.max_dynamic_tension_N", "ropes.R2.max_static_tension_N",
                                 "ropes.R2.max_dynamic_tension_N", "ropes.R1.dynamic_over_static",
                                 "ropes.R2.dynamic_over_static",
                                 "structure.simultaneous.static.checked_von_mises_Pa",
                                 "structure.simultaneous.dynamic.checked_von_mises_Pa",
                                 "structure.simultaneous.stress_increase_percent",
                                 "checks.hook C1.left.utilisation",
                                 "natural_periods.at the start.modes.pendulum.period_s"));
  auto other = summary;
  other["ropes"][0]["max_dynamic_tension_N"] = 112e3;
  const auto broken = find_broken_figures(figures, other);
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(figures[broken[0].index].path, "ropes.R1.max_dynamic_tension_N");
}

// Names of modes once told the hooks that go along, which swap.
TEST(ExpectedFigures, OfAModeThatHasAnotherNameTellTheNamesThatThereAre) {
  ExpectedFigure figure;
  figure.path = "natural_periods.at the start.modes.load and C1.left: roll about x.period_s";
  figure.value = 1;
  figure.tolerance = 0.01;
  const auto broken = find_broken_figures({figure}, test::sample_summary());
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken[0].complaint, "is not in the summary, whose modes then are: pendulum");
}

TEST(ExpectedFigures, AreWrittenInTheSyntaxOfTheirFile) {
  const test::TemporaryFolder folder;
  const auto figures = expect_figures(test::sample_summary());
  const std::string yaml = expected_figures_text(figures, FigureSyntax::yaml);
  EXPECT_THAT(yaml, StartsWith("- figure: \"verdict\"\n  equals: \"pass\"\n  reason: "));
  EXPECT_EQ(expected_figures_text(read_text(yaml)), expected_figures_text(figures));
  folder.write("figures.yaml", "# by hand\n" + yaml);
  folder.write("figures.json", expected_figures_text(figures));
  EXPECT_EQ(syntax_of_figures(folder.path() / "figures.yaml"), FigureSyntax::yaml);
  EXPECT_EQ(syntax_of_figures(folder.path() / "figures.json"), FigureSyntax::json);
  EXPECT_THROW(syntax_of_figures(folder.path() / "none.json"), InputError);
}

TEST(ExpectedFigures, AreRenewedWhereTheyAreOffAndNowhereElse) {
  auto figures = read_text(R"([
  {"figure": "ropes.R1.max_static_tension_N", "value": 100.4e3, "tolerance": 0.01, "reason": "in"},
  {"figure": "ropes.R2.max_static_tension_N", "value": 100e3, "tolerance": 0.01, "reason": "out"},
  {"figure": "ropes.R2.max_dynamic_tension_N", "at_most": 1, "reason": "required"}
])");
  const auto summary = test::sample_summary();
  const auto renewed = renew_figures(figures, summary);
  ASSERT_EQ(renewed.size(), 1u);
  EXPECT_EQ(renewed[0].index, 1u);
  EXPECT_EQ(*figures[0].value, 100.4e3);
  EXPECT_EQ(*figures[1].value, 200e3);
  EXPECT_EQ(*figures[1].tolerance, 0.01);
  const auto broken = find_broken_figures(figures, summary);
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken[0].index, 2u);
}

// Six digits of 10 123.456 kg are 4.3e-6 off, more than the tolerance of a mass.
TEST(ExpectedFigures, HoldTheLiftThatTheyWereTakenFrom) {
  auto summary = test::sample_summary();
  summary["structure"]["mass"]["total_kg"] = 10123.456;
  EXPECT_THAT(find_broken_figures(expect_figures(summary), summary), IsEmpty());
  auto mine = read_text(R"([
  {"figure": "ropes.R1.max_static_tension_N", "value": 5, "absolute_tolerance": 0.01,
   "reason": "a"},
  {"figure": "ropes.R2.max_static_tension_N", "value": 5, "tolerance": 0.01, "reason": "b"}
])");
  summary["ropes"][0]["max_static_tension_N"] = 123456.789;
  summary["ropes"][1]["max_static_tension_N"] = 123456.789;
  renew_figures(mine, summary);
  EXPECT_EQ(*mine[0].value, 123456.789);
  EXPECT_EQ(*mine[1].value, 123457);
  EXPECT_THAT(find_broken_figures(mine, summary), IsEmpty());
}

}  // namespace
}  // namespace blocklift::pipeline
