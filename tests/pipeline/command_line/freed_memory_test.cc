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
TEST(FreedMemory, GoesBackFromBeneathWhatLivesOn) {
  ASSERT_GT(structure::available_memory(), 0);  // keeps the library among those that are loaded
  return_freed_memory();
  constexpr std::size_t size = 200'000'000;
  auto below = std::make_unique<char[]>(size);
  std::memset(below.get(), 1, size);
  const auto above = std::make_unique<char[]>(size / 4);
  std::memset(above.get(), 1, size / 4);
  const double before = resident_megabytes();
  below.reset();
  EXPECT_LT(resident_megabytes(), before - 190);
}

}  // namespace
}  // namespace blocklift::pipeline
