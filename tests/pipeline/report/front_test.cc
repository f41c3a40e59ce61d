#include "pipeline/report/front.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/report/check_groups.h"
#include "pipeline/report/figures.h"
#include "pipeline/report/html.h"
#include "pipeline/report/input_values.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Json check(const std::string& name, double utilisation, bool pass = true) {
  return {{"name", name}, {"demand", 1e6 * utilisation}, {"limit", 1e6},
          {"unit", "N"},  {"utilisation", utilisation},  {"pass", pass}};
}

Json checks() {
  return Json::array({check("rope R1: tension", 0.4), check("rope R2: tension", 0.6),
                      check("lug L1: base: bending by weight", 0.2),
                      check("Rules 5: sling R1 by breaking load", 0.9),
                      check("Rules 5: shackle L1 by working load", 0.3),
                      check("swing: largest angle", 0.1, false)});
}

Json page(const Json& list_of_checks) {
  return {{"summary",
           {{"verdict", "fail"}, {"checks", list_of_checks}, {"standard", {{"name", "Rules 5"}}}}},
          {"case", {{"name", "sample"}, {"yaml", "case: sample\nropes:\n  R1: {length: 12 m}\n"}}}};
}

TEST(CheckGroups, SortsKindsAndTheirChecksByWhatGoverns) {
  const Json list = checks();
  std::vector<std::string> names;
  for (const CheckGroup& group : group_checks(list, "Rules 5")) names.push_back(group.name);
  EXPECT_THAT(names, ElementsAre("swing", "Rules 5: sling", "rope", "Rules 5: shackle", "lug"));
  const CheckGroup ropes = group_checks(list, "Rules 5")[2];
  ASSERT_EQ(ropes.checks.size(), 2U);
  EXPECT_EQ((*ropes.checks[0])["name"], "rope R2: tension");
  EXPECT_EQ((*governing_check(list))["name"], "swing: largest angle");
  EXPECT_EQ(governing_check(Json::array()), nullptr);
  EXPECT_EQ(governing_check(Json()), nullptr);
}

TEST(Front, ShowsTheGoverningCheckOfEachGroupAndEveryOneInTheAnnex) {
  const std::string shown = checks_html(page(checks()));
  EXPECT_THAT(shown, HasSubstr("rope R2"));
  EXPECT_THAT(shown, HasSubstr("governing of 2 checks: rope"));
  EXPECT_THAT(shown, Not(HasSubstr("rope R1")));
  const std::string annex = annex_html(page(checks()));
  EXPECT_LT(annex.find("rope R2"), annex.find("rope R1"));
  EXPECT_THAT(annex, HasSubstr("<code>ropes.R1.length</code></th><td class=\"left\">12 m</td>"));
  EXPECT_EQ(checks_html(page(Json::array())), "");
}

TEST(Front, HasTheBandOfTheMeshBesideTheUtilisation) {
  Json with_band = check("buckling of panels in web", 0.5);
  EXPECT_THAT(checks_html(page(Json::array({with_band}))), Not(HasSubstr("by the mesh")));
  with_band["utilisation_band"] = {0.47, 0.53};
  EXPECT_THAT(checks_html(page(Json::array({with_band}))),
              HasSubstr(figures::share(0.47) + " to " + figures::share(0.53) + " by the mesh"));
  with_band["utilisation_band"] = {0.188, 0.192};  // both round alike
  EXPECT_THAT(checks_html(page(Json::array({with_band}))),
              HasSubstr(">" + figures::share(0.19) + " by the mesh"));
}

TEST(Front, TakesTheLargestRopeOfThoseThatCarryTheLoadAndNamesTheOthersBesideIt) {
  Json data = page(checks());
  const auto rope = [](const std::string& name, double tension, double ratio) {
    return Json{{"name", name}, {"max_dynamic_tension_N", tension}, {"dynamic_over_static", ratio}};
  };
  Json sling = rope("R1", 9.80665e6, 1.02);
  sling["lug"] = "L1";
  data["summary"]["ropes"] = Json::array({rope("W1", 19.6133e6, 1.05), sling});
  const std::string html = front_html(data);
  EXPECT_THAT(html, HasSubstr(figures::tonnes(9.80665e6) + " tonnes in R1<br>other ropes up to " +
                              figures::tonnes(19.6133e6) + " tonnes in W1"));
  EXPECT_THAT(html, HasSubstr("rope R1<br>other ropes up to 1.050 in W1"));
  data["summary"]["ropes"] = Json::array({rope("W1", 19.6133e6, 1.05)});
  EXPECT_THAT(front_html(data), HasSubstr("rope W1</div>"));
}

TEST(Front, SpeaksOfInstantsOnlyWhereThereAreSome) {
  Json data = page(checks());
  data["summary"]["structure"]["simultaneous"] = {{"stress_increase_percent", 18.5}};
  EXPECT_THAT(front_html(data), HasSubstr("increase, worst instant of a rope's maximum"));
  EXPECT_THAT(front_html(data), HasSubstr(" mm, each at its worst instant<"));
  data["summary"]["structure"]["load_table"] = {{"weight_N", 1.0}};
  EXPECT_THAT(front_html(data), HasSubstr("increase, loads of the table"));
  EXPECT_THAT(front_html(data), Not(HasSubstr("instant")));
  // An increase is from one instant to another, of the stress to others than of the deformation.
  data["summary"]["structure"]["history"] = {
      {"static", {{"time_s", 12.0}, {"max_displacement_time_s", 13.5}}},
      {"dynamic", {{"time_s", 20.5}, {"max_displacement_time_s", 21.0}}}};
  EXPECT_THAT(front_html(data), HasSubstr("MPa, each at its worst instant: 12.0 and 20.5 s"));
  EXPECT_THAT(front_html(data), HasSubstr("mm, each at its worst instant: 13.5 and 21.0 s"));
}

TEST(Front, SaysThatTheVerdictIsIndicativeAndWhy) {
  Json data = page(checks());
  EXPECT_THAT(front_html(data), Not(HasSubstr("ndicative")));
  data["summary"]["indicative"] = "the mesh is <coarse>";
  EXPECT_THAT(front_html(data), HasSubstr("Indicative only: the mesh is &lt;coarse&gt;."));
}

TEST(Front, LinksToThePageOfTheMeshWhereThereIsOne) {
  Json data = page(checks());
  EXPECT_THAT(front_html(data), Not(HasSubstr("href")));
  data["summary"]["mesh_page"] = "mesh.html";
  EXPECT_THAT(front_html(data), HasSubstr("<dt>Mesh of the block</dt><dd><a href=\"mesh.html\">"));
}

TEST(Front, PutsTheDocumentsTextIntoTheMarginsAsStrings) {
  Json data = page(checks());
  data["summary"]["document"] = {{"project", "A \"quoted\" </style>"}, {"checked", "N. N."}};
  const std::string css = margins_css(data);
  EXPECT_THAT(css, HasSubstr("@top-left{content:\"A \\22 quoted\\22  \\3c /style>\"}"));
  EXPECT_THAT(css, HasSubstr("checked N. N."));
  EXPECT_THAT(front_html(data), HasSubstr("A &quot;quoted&quot; &lt;/style&gt;"));
}

TEST(InputValues, AreListedByTheirPlaces) {
  std::vector<std::string> lines;
  for (const InputValue& one :
       list_input_values("a: 1\nb: {c: [1 m, 2 m], d: []}\nmoves: [{drive: x}, {drive: y}]\ne:\n"))
    lines.push_back(one.key + "=" + one.value);
  EXPECT_THAT(lines, ElementsAre("a=1", "b.c=[1 m, 2 m]", "b.d=[]", "moves[1].drive=x",
                                 "moves[2].drive=y", "e="));
  EXPECT_TRUE(list_input_values("a: [1").empty());
  EXPECT_TRUE(list_input_values("").empty());
}

TEST(Figures, AreRoundedAndGroupedAsThePageDoes) {
  EXPECT_EQ(figures::kilonewtons(987654.0), "988");
  EXPECT_EQ(figures::kilonewtons(2218123.0), "2\u202f218");
  EXPECT_EQ(figures::kilonewtons(99964.0), "100");  // as many digits as 103 beside it
  EXPECT_EQ(figures::kilonewtons(99940.0), "99.9");
  EXPECT_EQ(figures::tonnes(9806650.0), "1\u202f000.0");
  EXPECT_EQ(figures::tonnes(110.0), "0.0112");
  EXPECT_EQ(figures::fixed(-1234567.0, 1), "\u22121\u202f234\u202f567.0");
  EXPECT_EQ(figures::fixed(-0.01, 1), "0.0");
  EXPECT_EQ(figures::change(15.34), "+15.3\u202f%");
  EXPECT_EQ(figures::share(0.949), "95\u202f%");
  EXPECT_EQ(figures::significant(0.01234, 3), "0.0123");
  EXPECT_EQ(figures::millimetres(-1e308), "-inf");  // beyond any number in its unit
  EXPECT_EQ(figures::fixed(Json(), 1), figures::missing);
  EXPECT_EQ(figures::fixed(std::nan(""), 1), figures::missing);
  EXPECT_EQ(figures::in_report_unit(2.5e6, "Pa").text, "2.50");
  EXPECT_EQ(figures::in_report_unit(2.5e6, "kg").unit, "tonnes");
}

}  // namespace
}  // namespace blocklift::pipeline
