#include "pipeline/files/standard/standard_rules.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/files/lift_case/lift_case.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::SampleLift;
using test::TemporaryFolder;
using test::with;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string sample_rules = R"(kind: standard
title: A yard's rules
name: Yard
edition: "2"
source: this test
weight_classes:
  weighed: {factor: 1.03, clause: "2.1"}
  B: {factor: 1.10, clause: "2.2"}
dynamic_amplification:
  quay: [{up_to: 100 t, factor: 1.10, clause: "3.1"}, {factor: 1.05, clause: "3.1"}]
)";

std::string complaints_about_rules(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("yard.yaml", text);
  Diagnostics diagnostics;
  ModelLibrary({}).read_standard("yard.yaml", diagnostics);
  return diagnostics.to_text();
}

TEST(StandardRulesTest, QuotesClausesWithTheStandardsName) {
  const TemporaryFolder folder;
  folder.write("yard.yaml", sample_rules);
  Diagnostics diagnostics;
  const auto rules = ModelLibrary({}).read_standard("yard.yaml", diagnostics);
  ASSERT_EQ(diagnostics.to_text(), "");
  EXPECT_EQ(rules->weight_classes[1].clause, "Yard 2.2");
  EXPECT_EQ(rules->dynamic_amplification[0].rows[1].clause, "Yard 3.1");
  EXPECT_FALSE(rules->sling);
}

TEST(StandardRulesTest, RefusesAFigureWithoutItsClause) {
  EXPECT_THAT(complaints_about_rules(
                  with(sample_rules, "{factor: 1.10, clause: \"2.2\"}", "{factor: 1.10}")),
              HasSubstr("yard.yaml:8:6: error: factor B lacks the key \"clause\""));
  EXPECT_THAT(complaints_about_rules(
                  with(sample_rules, "{factor: 1.05, clause: \"3.1\"}", "{factor: 1.05}")),
              HasSubstr("lacks the key \"clause\""));
}

// The checked stress is the mean over 50 mm: factors for smaller squares would allow too much.
TEST(StandardRulesTest, TakesFactorsOfSmallElements) {
  const auto rules = [](const std::string& square) {
    return sample_rules + "fine_mesh:\n  square: " + square +
           "\n  plate: {factor: 1.7, clause: \"5.1\"}\n"
           "  beside_weld: {factor: 1.5, clause: \"5.2\"}\n";
  };
  EXPECT_EQ(complaints_about_rules(rules("50 mm")), "");
  EXPECT_THAT(complaints_about_rules(rules("30 mm")), HasSubstr("yard.yaml:12:11: error: "));
}

TEST(StandardRulesTest, RefusesRowsThatLeaveWeightsOut) {
  EXPECT_THAT(complaints_about_rules(with(sample_rules, ", {factor: 1.05, clause: \"3.1\"}]", "]")),
              HasSubstr("the last row of quay, and it alone, has no up_to"));
  EXPECT_THAT(complaints_about_rules(sample_rules + "lug: {asme_bth: {factor: 2, clause: x}}\n"),
              HasSubstr("did you mean \"asme_bth_1\"?"));
}

TEST(StandardRulesTest, ShippedRulesAreSound) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BLOCKLIFT_MODELS "/standards")) {
    if (entry.path().extension() != ".yaml") continue;
    Diagnostics diagnostics;
    EXPECT_NE(ModelLibrary({}).read_standard(entry.path(), diagnostics), nullptr);
    EXPECT_EQ(diagnostics.to_text(), "") << entry.path();
    ++count;
  }
  EXPECT_GE(count, 9);
}

/// What is said about the sample lift with a standard, and the shipped models.
std::string complaints_about_standard(const std::string& standard, SampleLift lift = {}) {
  lift.lift_case += "standard: " + standard + "\n";
  const TemporaryFolder folder;
  lift.write(folder);
  Diagnostics diagnostics;
  ModelLibrary library({BLOCKLIFT_MODELS});
  read_lift_case("case.yaml", library, diagnostics);
  return diagnostics.to_text();
}

TEST(GivenStandardTest, IsReadWithItsRules) {
  EXPECT_EQ(complaints_about_standard("{rules: en-13001, hoisting_class: HC2}"), "");
  EXPECT_EQ(complaints_about_standard("{rules: [en-13001, standards/asme-bth-1-a], "
                                      "hoisting_class: HC2}"),
            "");
}

TEST(GivenStandardTest, NamesWhatIsMeant) {
  EXPECT_THAT(complaints_about_standard("{rules: nd-0028}"),
              HasSubstr("did you mean \"nd-0027\"?"));
  EXPECT_THAT(complaints_about_standard("{rules: en-13001, hoisting_class: HC5}"),
              HasSubstr("the rules EN 13001-2 have no hoisting class \"HC5\""));
  EXPECT_THAT(complaints_about_standard("{rules: asme-bth-1-a, setting: onshore}"),
              HasSubstr("the rules ASME BTH-1 know no setting"));
}

TEST(GivenStandardTest, AsksForWhatTheRulesNeed) {
  const std::string text = complaints_about_standard("{rules: nd-0027, weight_class: D}");
  EXPECT_THAT(text, HasSubstr("the rules 0027/ND have no weight class \"D\""));
  EXPECT_THAT(text, HasSubstr("the rules 0027/ND need a setting, and the case gives none"));
  EXPECT_THAT(text, HasSubstr("add setting: one of onshore, inshore, offshore"));
  EXPECT_THAT(text, HasSubstr("need a skew"));
  EXPECT_THAT(text, HasSubstr("the model of rope R1 has no material, which the rules 0027/ND need "
                              "for slings"));
}

TEST(GivenStandardTest, AsksNothingOfAModelThatIsNotThere) {
  SampleLift lift;
  const std::size_t at = lift.lift_case.find("model: ropes/", lift.lift_case.find("R1:"));
  lift.lift_case.insert(at + std::string("model: ").size(), "no-");
  const std::string text = complaints_about_standard("{rules: nd-0027}", lift);
  EXPECT_THAT(text, HasSubstr("there is no rope model \"no-ropes/"));
  EXPECT_THAT(text, Not(HasSubstr("the model of rope R1 has no")));
}

TEST(GivenStandardTest, LooksAtMasterLinksAndSheaves) {
  const std::string begin = "{rules: en-13001, hoisting_class: HC2, ";
  EXPECT_EQ(complaints_about_standard(
                begin + "master_links: {C1.left: {working_load: 5 t, breaking_load: 30 t}}}"),
            "");
  EXPECT_THAT(complaints_about_standard(
                  begin + "master_links: {C1.lefd: {working_load: 5 t, breaking_load: 30 t}}}"),
              AllOf(HasSubstr("a master link is at hook \"C1.lefd\", from which no sling hangs"),
                    HasSubstr("did you mean \"C1.left\"?")));
  EXPECT_THAT(complaints_about_standard(
                  begin + "master_links: {C1.left: {working_load: 5 t, breaking_load: 3 t}}}"),
              HasSubstr("the master link at hook C1.left breaks below its working load"));
  EXPECT_THAT(complaints_about_standard(
                  begin + "sheaves: {R7: {working_load: 5 t, breaking_load: 30 t, tread: 0.4 m}}}"),
              HasSubstr("a sheave is at \"R7\", which is no sling of the case"));
  EXPECT_THAT(
      complaints_about_standard(
          begin + "sheaves: {R1: {working_load: 5 t, breaking_load: 30 t, tread: 0.4 m}}}"),
      HasSubstr("the model of rope R1 has no diameter, which the bend diameter is held against"));
}

TEST(GivenStandardTest, LooksAtShacklesAndBends) {
  EXPECT_THAT(complaints_about_standard("{rules: en-13001, hoisting_class: HC2, shackles: {L1: "
                                        "{working_load: 5 t, breaking_load: 30 t}}}"),
              HasSubstr("the rules EN 13001-2 say nothing of shackles"));
  EXPECT_THAT(complaints_about_standard("{rules: nd-0027, shackles: {L9: {working_load: 5 t, "
                                        "breaking_load: 30 t}}}"),
              HasSubstr("a shackle is at lug \"L9\", which the load does not have"));
  EXPECT_THAT(complaints_about_standard("{rules: en-13001, hoisting_class: HC2, bend_diameter: "
                                        "100 mm}"),
              HasSubstr("the model of rope R1 has no diameter"));
}

// A load table has loads at lugs: rules on hooks, slings and motion would hold nothing.
TEST(GivenStandardTest, RefusesWhatALoadTableDoesNotHave) {
  SampleLift lift;
  lift.lift_case = test::sample_load_table_case;
  const std::string begin =
      "{rules: nd-0027, weight_class: weighed, setting: onshore, "
      "skew: determinate";
  const std::string shackle = ": {working_load: 5 t, breaking_load: 30 t}}";
  EXPECT_EQ(complaints_about_standard(begin + ", shackles: {L1" + shackle + "}", lift), "");
  for (const char* key : {"tilt: same_vessel", "centre_box: [1 m, 1 m, 1 m]",
                          "length_tolerance: 0.2 %", "wear: inspected", "bend_diameter: 0.3 m"}) {
    SCOPED_TRACE(key);
    EXPECT_THAT(complaints_about_standard(begin + ", " + key + "}", lift),
                HasSubstr("and the case has a load table"));
  }
  EXPECT_THAT(complaints_about_standard("{rules: en-13001, hoisting_class: HC2}", lift),
              HasSubstr("its factor grows with the hoisting speed"));
}

TEST(GivenStandardTest, RefusesAShackleAtWhichNothingPulls) {
  SampleLift lift;
  lift.lift_case = test::with(lift.lift_case, "to: L2", "to: L1");
  EXPECT_THAT(complaints_about_standard("{rules: nd-0027, shackles: {L2: {working_load: 5 t, "
                                        "breaking_load: 30 t}}}",
                                        lift),
              HasSubstr("a shackle is at lug L2, at which no rope ends"));
}

}  // namespace
}  // namespace blocklift::pipeline
