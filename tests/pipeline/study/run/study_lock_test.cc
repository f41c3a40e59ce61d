#include "pipeline/study/run/study_lock.h"

#include <filesystem>
#include <optional>

#include <gtest/gtest.h>

#include "pipeline/declaration/diagnostics.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using Use = StudyLock::Use;

TEST(StudyLock, KeepsOthersOutUntilItsRunEnds) {
  const test::TemporaryFolder folder;
  std::optional<StudyLock> whole(std::in_place, "out", Use::whole);
  EXPECT_THROW(StudyLock("out", Use::whole), InputError);
  EXPECT_THROW(StudyLock("out", Use::part), InputError);
  whole.reset();
  const StudyLock part("out", Use::part);
  EXPECT_NO_THROW(StudyLock("out", Use::part));
  EXPECT_THROW(StudyLock("out", Use::whole), InputError);
}

TEST(StudyLock, ClearsAwayWhatKilledRunsLeftHalfWritten) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories("out/members");
  folder.write("out/members/.000001.json.part-77", "{");
  folder.write("out/members/000001.json", "{}");
  { const StudyLock part("out", Use::part); }
  EXPECT_TRUE(std::filesystem::exists("out/members/.000001.json.part-77"));
  const StudyLock whole("out", Use::whole);
  EXPECT_FALSE(std::filesystem::exists("out/members/.000001.json.part-77"));
  EXPECT_TRUE(std::filesystem::exists("out/members/000001.json"));
}

}  // namespace
}  // namespace blocklift::pipeline
