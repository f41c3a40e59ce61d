#include "pipeline/files/library/model_library.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/files/lift_case/input_hash.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::SampleLift;
using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

std::vector<KeyChange> changes_of(const std::vector<std::string>& texts) {
  Diagnostics diagnostics;
  std::vector<KeyChange> changes;
  for (const std::string& text : texts)
    if (auto change = parse_key_change(text, {}, diagnostics)) changes.push_back(*change);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.to_text();
  return changes;
}

/// The case with these changes; the complaints, if there are any.
std::optional<LiftCase> read_with(ModelLibrary& library, const std::vector<std::string>& changes,
                                  std::string* complaints = nullptr) {
  Diagnostics diagnostics;
  library.set_changes(changes_of(changes));
  std::optional<LiftCase> lift_case = read_lift_case("case.yaml", library, diagnostics);
  if (complaints) *complaints = diagnostics.to_text();
  EXPECT_TRUE(lift_case || complaints) << diagnostics.to_text();
  return lift_case;
}

// The hash is of the texts of the case and of all its models, with their changes.
TEST(ModelLibrary, ReadsACaseAgainAsOneThatNeverReadItBefore) {
  const TemporaryFolder folder;
  SampleLift().write(folder);
  ModelLibrary library({});
  const std::vector<std::vector<std::string>> members = {
      {},
      {"plate:mass=11 t", "ropes.R1.length=2.01 m"},
      {"plate:mass=12 t", "ropes.R1.length=2.02 m", "ropes/tackle:axial_stiffness=210 MN"},
      {"plate:mass=12 t", "gantry:hoists.left.crane_stiffness=11 MN/m"},
      {"settle=11 s"},
      {}};
  for (const std::vector<std::string>& changes : members) {
    ModelLibrary fresh({});
    const auto expected = read_with(fresh, changes);
    const auto found = read_with(library, changes);
    ASSERT_TRUE(expected && found);
    EXPECT_EQ(hash_of_input(*found), hash_of_input(*expected));
    ASSERT_EQ(found->model_texts.size(), expected->model_texts.size());
    for (std::size_t i = 0; i < found->model_texts.size(); ++i)
      EXPECT_EQ(found->model_texts[i].name, expected->model_texts[i].name);
    EXPECT_EQ(found->load.model->mass->value, expected->load.model->mass->value);
    EXPECT_EQ(found->ropes[0].length.value, expected->ropes[0].length.value);
    EXPECT_EQ(found->ropes[0].rope.axial_stiffness, expected->ropes[0].rope.axial_stiffness);
    const HoistModel &hoist = found->cranes[0].model->hoists[0],
                     &hoist_expected = expected->cranes[0].model->hoists[0];
    EXPECT_EQ(hoist.crane_stiffness, hoist_expected.crane_stiffness);
    EXPECT_EQ(hoist.rope.axial_stiffness, hoist_expected.rope.axial_stiffness);
  }
}

TEST(ModelLibrary, ReadsOnlyWhatChangesAgain) {
  const TemporaryFolder folder;
  SampleLift().write(folder);
  ModelLibrary library({});
  const auto first = read_with(library, {"plate:mass=11 t"});
  const auto second = read_with(library, {"plate:mass=12 t"});
  const auto third = read_with(library, {"plate:mass=12 t", "ropes/tackle:damping_time=6 ms"});
  EXPECT_EQ(second->cranes[0].model, first->cranes[0].model);
  EXPECT_NE(second->load.model, first->load.model);
  EXPECT_EQ(third->load.model, second->load.model);
  // The crane's first hoist has that rope.
  EXPECT_NE(third->cranes[0].model, second->cranes[0].model);
  EXPECT_DOUBLE_EQ(third->cranes[0].model->hoists[0].rope.damping_time, 0.006);
  EXPECT_DOUBLE_EQ(second->cranes[0].model->hoists[0].rope.damping_time, 0.005);
}

TEST(ModelLibrary, ComplainsAgainAboutAModelWithMistakes) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.rope = with(lift.rope, "200 MN", "-200 MN");
  lift.write(folder);
  ModelLibrary library({});
  std::string first, second;
  EXPECT_FALSE(read_with(library, {}, &first));
  EXPECT_FALSE(read_with(library, {}, &second));
  EXPECT_THAT(first, HasSubstr("axial_stiffness"));
  EXPECT_EQ(second, first);
  // A change that does away with the mistake is followed, one that makes it is complained about.
  EXPECT_TRUE(read_with(library, {"ropes/tackle:axial_stiffness=200 MN"}, &first)) << first;
  EXPECT_FALSE(read_with(library, {"ropes/tackle:axial_stiffness=-1 MN"}, &first));
}

TEST(ModelLibrary, ComplainsAboutChangesOfModelsThatTheCaseHasNot) {
  const TemporaryFolder folder;
  SampleLift().write(folder);
  ModelLibrary library({});
  std::string complaints;
  for (int reading = 0; reading < 2; ++reading) {
    EXPECT_FALSE(read_with(library, {"plates:mass=11 t"}, &complaints));
    EXPECT_THAT(complaints, HasSubstr("no model \"plates\" to change"));
    EXPECT_THAT(complaints, HasSubstr("did you mean \"plate\"?"));
  }
}

}  // namespace
}  // namespace blocklift::pipeline
