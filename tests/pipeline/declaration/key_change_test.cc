#include "pipeline/declaration/key_change.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

constexpr const char* text_to_change = R"(mass: 8 t
ropes:
  R1: {length: 3 m}
  R2: &second {length: 4 m}
  R3: *second
moves: [{by: 1 m}, {by: 2 m}]
centre: [1 m, [2 m, 3 m]]
empty:
)";

Document document_to_change() {
  return {std::make_shared<const std::string>("case.yaml"), text_to_change,
          YAML::Load(text_to_change)};
}

/// The document after a change, or the complaint.
std::string changed_by(const std::string& text) {
  Diagnostics diagnostics;
  const Mark mark{std::make_shared<const std::string>("--set"), 0, 0};
  const auto change = parse_key_change(text, mark, diagnostics);
  std::string changed;
  if (change)
    changed =
        ChangingDocument(document_to_change()).with({*change}, change->file, diagnostics).text;
  return diagnostics.has_errors() ? diagnostics.to_text() : changed;
}

TEST(KeyChange, ReachesTablesAndLists) {
  EXPECT_THAT(changed_by("mass=9 t"), HasSubstr("mass: 9 t\n"));
  EXPECT_THAT(changed_by("ropes.R1.length=3.1 m"), HasSubstr("length: 3.1 m"));
  EXPECT_EQ(YAML::Load(changed_by("moves[2].by=5 m"))["moves"][1]["by"].Scalar(), "5 m");
  EXPECT_EQ(YAML::Load(changed_by("moves[2].by=5 m"))["moves"][0]["by"].Scalar(), "1 m");
  EXPECT_EQ(YAML::Load(changed_by("centre[2][1]=7 m"))["centre"][1][0].Scalar(), "7 m");
  EXPECT_EQ(YAML::Load(changed_by("empty=1"))["empty"].Scalar(), "1");
  EXPECT_EQ(YAML::Load(changed_by("mass== 2 * 4 t"))["mass"].Scalar(), "= 2 * 4 t");
}

TEST(KeyChange, ChangesPlacesOfOneAnchorTogether) {
  const YAML::Node changed = YAML::Load(changed_by("ropes.R3.length=5 m"));
  EXPECT_EQ(changed["ropes"]["R2"]["length"].Scalar(), "5 m");
  EXPECT_EQ(changed["ropes"]["R1"]["length"].Scalar(), "3 m");
}

TEST(KeyChange, LeavesTheRestOfTheTextAsItIs) {
  std::string expected = text_to_change;
  expected.replace(expected.find("2 m}]"), 3, "-14.7 m");
  EXPECT_EQ(changed_by("moves[2].by=-14.7 m"), expected);
  // What needs quotes, or had none to be replaced, has the text written anew.
  for (const char* change :
       {"mass=a: b", "mass=# 3", "empty=5 m", "mass=- 3 m", "mass=x ", "mass=[1"}) {
    const std::string value = std::string(change).substr(std::string(change).find('=') + 1);
    const std::string key = std::string(change).substr(0, std::string(change).find('='));
    EXPECT_EQ(YAML::Load(changed_by(change))[key].Scalar(), value) << change;
  }
}

TEST(KeyChange, FindsValuesBehindLettersOfSeveralBytesAndAnchors) {
  Diagnostics diagnostics;
  for (const char* text : {"title: Lüfter – α\nmass: 8 t  # α\nafter: 1\n",
                           "mass: &m 8 t\nafter: 1\n", "mass: \"8 t\"\nafter: 1\n",
                           "mass: 8\n  t\nafter: 1\n", "\xEF\xBB\xBFmass: 8 t\nafter: 1\n",
                           "\xEF\xBB\xBFx: 1\nmass: 8 t\nafter: 1\n", "{mass: 8 t, after: 1}"}) {
    ChangingDocument document(
        {std::make_shared<const std::string>("case.yaml"), text, YAML::Load(text)});
    const Document changed = document.with({{"", "mass", "9.5 t", {}}}, "", diagnostics);
    EXPECT_EQ(YAML::Load(changed.text)["mass"].Scalar(), "9.5 t") << text;
    EXPECT_EQ(YAML::Load(changed.text)["after"].Scalar(), "1") << text;
  }
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST(KeyChange, IsTakenBackBeforeTheNext) {
  Diagnostics diagnostics;
  ChangingDocument document(document_to_change());
  const std::vector<KeyChange> first = {{"", "mass", "9 t", {}},
                                        {"", "ropes.R2.length", "5 m", {}},
                                        {"", "ropes.R3.length", "6 m", {}},
                                        {"", "empty", "7", {}},
                                        {"ropes/other", "mass", "1 t", {}}};
  const Document changed = document.with(first, "", diagnostics);
  EXPECT_EQ(changed.root["mass"].Scalar(), "9 t");
  EXPECT_EQ(changed.root["ropes"]["R2"]["length"].Scalar(), "6 m");
  EXPECT_EQ(changed.root["empty"].Scalar(), "7");
  const Document next = document.with({{"", "ropes.R1.length", "2 m", {}}}, "", diagnostics);
  EXPECT_EQ(next.root["mass"].Scalar(), "8 t");
  EXPECT_EQ(next.root["ropes"]["R2"]["length"].Scalar(), "4 m");
  EXPECT_TRUE(next.root["empty"].IsNull());
  EXPECT_EQ(next.root["ropes"]["R1"]["length"].Scalar(), "2 m");
  EXPECT_EQ(document.with({}, "", diagnostics).text, text_to_change);
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST(KeyChange, KeepsTheLineOfTheKeyForLaterComplaints) {
  Diagnostics diagnostics;
  const Document document = ChangingDocument(document_to_change())
                                .with({{"", "ropes.R1.length", "5 m", {}}}, "", diagnostics);
  EXPECT_EQ(document.mark_of(document.root["ropes"]["R1"]["length"]).line, 3);
}

TEST(KeyChange, SaysWhatIsThereInPlaceOfTheKey) {
  EXPECT_THAT(changed_by("ropes.R1.lenght=3 m"), HasSubstr("did you mean \"length\"?"));
  EXPECT_THAT(changed_by("rops.R1.length=3 m"), HasSubstr("did you mean \"ropes\"?"));
  EXPECT_THAT(changed_by("moves[3].by=3 m"), HasSubstr("case.yaml: moves has 2 items"));
  EXPECT_THAT(changed_by("mass[1]=3 m"), HasSubstr("case.yaml: mass is no list"));
  EXPECT_THAT(changed_by("mass.value=3 m"), HasSubstr("case.yaml: mass is no table"));
  EXPECT_THAT(changed_by("moves.1.by=3 m"),
              HasSubstr("case.yaml: moves is a list: its items are moves[1] to [2]"));
  EXPECT_THAT(changed_by("ropes=3 m"), HasSubstr("ropes is a table"));
  EXPECT_THAT(changed_by("moves=3 m"), HasSubstr("moves is a list"));
}

TEST(KeyChange, IsRefusedWhereItSaysNothing) {
  for (const char* text :
       {"", "mass", "mass=", "=3 t", "moves[x].by=1 m", "moves[1.by=1 m", "block:=3 t"})
    EXPECT_THAT(changed_by(text), HasSubstr("changes nothing")) << text;
  EXPECT_THAT(changed_by("moves[0].by=1 m"), HasSubstr("places of a list are counted from 1"));
  EXPECT_THAT(changed_by("moves[00].by=1 m"), HasSubstr("\"moves[00].by\" has no place 0"));
  EXPECT_THAT(changed_by("moves[1].by[0=1 m"), HasSubstr("changes nothing"));
}

TEST(KeyChange, NamesAModelBeforeAColon) {
  Diagnostics diagnostics;
  const auto change = parse_key_change("blocks/hull-860t:mass=870 t", {}, diagnostics);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->file, "blocks/hull-860t");
  EXPECT_EQ(change->key, "mass");
  EXPECT_EQ(change->value, "870 t");
  const auto clock = parse_key_change("title=at 12:30", {}, diagnostics);
  ASSERT_TRUE(clock);
  EXPECT_EQ(clock->file, "");
}

}  // namespace
}  // namespace blocklift::pipeline
