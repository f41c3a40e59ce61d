// Linked with the structural library, whose SuperLU_DIST keeps all memory that was ever allocated.
// For glibc's allocator: not built with sanitizers, which bring their own.
#include "pipeline/command_line/freed_memory.h"

#include <unistd.h>

#include <cstring>
#include <fstream>
#include <memory>

#include <gtest/gtest.h>

#include "structure/system/linear_solver.h"

namespace blocklift::pipeline {
namespace {

double resident_megabytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0, resident = 0;
  file >> size >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

// A large block beneath a smaller one that lives on, as the stiffness lies beneath its factor.
std::unique_ptr<char[]> touched(std::size_t size) {
  auto block = std::make_unique<char[]>(size);
  std::memset(block.get(), 1, size);
  return block;
}

TEST(FreedMemory, BeyondHalfAGigabyteGoesBack) {
  ASSERT_GT(structure::available_memory(), 0);  // keeps the library among those that are loaded
  return_freed_memory();
  auto block = touched(900'000'000);
  const double before = resident_megabytes();
  block.reset();
  EXPECT_LT(resident_megabytes(), before - 850);
}

TEST(FreedMemory, BeneathWhatLivesOnIsUsedAgain) {
  return_freed_memory();
  auto below = touched(200'000'000);
  const auto above = touched(50'000'000);
  const double before = resident_megabytes();
  below.reset();
  const auto again = touched(190'000'000);
  EXPECT_LT(resident_megabytes(), before + 10);
}

TEST(FreedMemory, IsKeptUntilMoreIsWantedThanThereIs) {
  return_freed_memory();
  keep_freed_memory();
  touched(900'000'000).reset();
  const double kept = resident_megabytes();
  EXPECT_GT(kept, 850);
  structure::memory_for(0);
  EXPECT_GT(resident_megabytes(), kept - 10);
  structure::memory_for(1e18);
  EXPECT_LT(resident_megabytes(), kept - 850);
}

}  // namespace
}  // namespace blocklift::pipeline
