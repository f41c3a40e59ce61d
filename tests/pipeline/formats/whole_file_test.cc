// Files that are read whole: at once, and mapped.
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/mapped_file.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

std::string all_bytes() {
  std::string bytes;
  for (int i = 0; i < 100'000; ++i) bytes += static_cast<char>(i % 251);
  return bytes;
}

TEST(WholeFileTest, BothWaysHaveItsBytes) {
  const test::TemporaryFolder folder;
  folder.write("some", all_bytes());
  folder.write("none", "");
  EXPECT_EQ(read_file("some"), all_bytes());
  EXPECT_EQ(MappedFile("some").bytes(), all_bytes());
  EXPECT_EQ(read_file("none"), "");
  EXPECT_EQ(MappedFile("none").bytes(), "");
}

// Of the kernel's own files the size is said to be nothing.
TEST(WholeFileTest, WhatHasNoSizeIsReadToItsEnd) {
  EXPECT_NE(read_file("/proc/self/status").find("VmRSS"), std::string::npos);
}

TEST(WholeFileTest, WhatIsMappedStaysWhenTheFileIsReplaced) {
  const test::TemporaryFolder folder;
  write_file("kept", all_bytes());
  const MappedFile mapped("kept");
  write_file("kept", "other");
  EXPECT_EQ(mapped.bytes(), all_bytes());
  EXPECT_EQ(read_file("kept"), "other");
}

TEST(WholeFileTest, WhatIsNotThereIsSaid) {
  EXPECT_THROW(read_file("/nowhere/at all"), std::runtime_error);
  EXPECT_THROW(MappedFile("/nowhere/at all"), std::runtime_error);
}

}  // namespace
}  // namespace blocklift::pipeline
