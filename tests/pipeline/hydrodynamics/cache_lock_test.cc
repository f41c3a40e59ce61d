#include "pipeline/hydrodynamics/cache_lock.h"

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using test::TemporaryFolder;

void must_not_wait() { ADD_FAILURE() << "there is nobody to wait for"; }

TEST(CacheLock, TheSecondSaysThatItWaitsAndHasItsTurn) {
  const TemporaryFolder folder;
  const fs::path entry = folder.path() / "entry.h5";
  std::atomic<bool> waits{false}, has_turn{false};
  std::thread second;
  {
    const CacheLock first(entry, must_not_wait);
    second = std::thread([&] {
      const CacheLock lock(entry, [&] { waits = true; });
      has_turn = true;
    });
    for (int i = 0; i < 1000 && !waits; ++i) std::this_thread::sleep_for(milliseconds(5));
    std::this_thread::sleep_for(milliseconds(50));
    EXPECT_TRUE(waits);
    EXPECT_FALSE(has_turn);
  }
  second.join();
  EXPECT_TRUE(has_turn);
}

TEST(CacheLock, OtherEntriesAreOpen) {
  const TemporaryFolder folder;
  const CacheLock one(folder.path() / "one.h5", must_not_wait);
  const CacheLock other(folder.path() / "other.h5", must_not_wait);
}

TEST(CacheLock, OfAKilledRunHoldsNobodyUp) {
  const TemporaryFolder folder;
  const fs::path entry = folder.path() / "entry.h5";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const CacheLock lock(entry, [] {});
    std::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(fs::exists(entry.string() + ".lock"));
  const CacheLock next(entry, must_not_wait);
}

TEST(CacheLock, WhereNoFileCanBeMadeNobodyWaits) {
  const CacheLock lock("/nowhere/at/all/entry.h5", must_not_wait);
}

}  // namespace
}  // namespace blocklift::pipeline
