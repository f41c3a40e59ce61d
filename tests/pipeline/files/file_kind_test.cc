#include "pipeline/files/file_kind.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const char* text) { std::ofstream(path) << text; }

TEST(FileKind, AFolderStandsForTheFileInIt) {
  const TemporaryFolder temporary;
  fs::create_directory("block");
  EXPECT_EQ(input_file("block"), "block");
  EXPECT_EQ(kind_of_file("block"), FileKind::lift_case);  // whose reader says what is missing
  write("block/block.yaml", "kind: block\n");
  EXPECT_EQ(input_file("block"), "block/block.yaml");
  EXPECT_EQ(kind_of_file("block"), FileKind::block);
  EXPECT_EQ(kind_of_file("block/block.yaml"), FileKind::block);
  EXPECT_EQ(input_file("block/block.yaml"), "block/block.yaml");
}

TEST(FileKind, ACaseComesBeforeWhatLiesBesideIt) {
  const TemporaryFolder temporary;
  fs::create_directory("lift");
  write("lift/study.yaml", "study: spread\n");
  EXPECT_EQ(kind_of_file("lift"), FileKind::study);
  write("lift/case.yaml", "title: a lift\n");
  EXPECT_EQ(input_file("lift"), "lift/case.yaml");
  EXPECT_EQ(kind_of_file("lift"), FileKind::lift_case);
}

TEST(FileKind, AnInputIsCalledByItsFolderOrByItself) {
  const TemporaryFolder temporary;
  fs::create_directory("hull-12");
  EXPECT_EQ(name_of_input("hull-12/"), "hull-12");  // there is nothing in it that has a name
  write("hull-12/block.yaml", "kind: block\n");
  write("hull-12/other.yaml", "kind: block\n");
  EXPECT_EQ(name_of_input("hull-12"), "hull-12");
  EXPECT_EQ(name_of_input("hull-12/block.yaml"), "hull-12");
  EXPECT_EQ(name_of_input("hull-12/other.yaml"), "other");
}

}  // namespace
}  // namespace blocklift::pipeline
