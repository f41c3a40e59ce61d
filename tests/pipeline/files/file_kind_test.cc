#include "pipeline/files/file_kind.h"

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

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

std::string complaint_about(const char* text) {
  write("file.yaml", text);
  Diagnostics diagnostics;
  const bool complained = complain_about_untold_kind("file.yaml", diagnostics);
  EXPECT_EQ(complained, diagnostics.has_errors());
  return diagnostics.to_text();
}

TEST(FileKind, WhatAFileWithoutItsKindWasMeantToBeIsSaidOnce) {
  const TemporaryFolder temporary;
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint_about("mesh: {file: a.bdf, units: mm-t-N}\nlugs: {L1: {node: 1}}\n"),
              HasSubstr("file.yaml:1:1: error: this is a block by its keys, and does not say so\n"
                        "    begin the file with \"kind: block\"\n1 error"));
  EXPECT_THAT(complaint_about("title: a deck\nplates: {}\n"), HasSubstr("\"kind: block\""));
  EXPECT_THAT(complaint_about("mesh: {file: a.step}\nsupports: {}\nloads: {}\n"),
              HasSubstr("begin the file with \"part: NAME\""));
  EXPECT_THAT(complaint_about("title: a deck\nkind: blok\n"),
              ::testing::AllOf(HasSubstr("file.yaml:2:7: error: kind \"blok\" is not known"),
                               HasSubstr("did you mean \"block\"?")));
}

TEST(FileKind, FilesThatSayWhatTheyAreOrTellNothingAreLeftToTheirReaders) {
  const TemporaryFolder temporary;
  for (const char* text : {"kind: block\nlugs: {}\n", "part: ring\nloads: {}\n",
                           "case: lift\nlugs: {}\n", "mechanism: crank\n",
                           "cranes: {}\nsupports: {}\n", "title: a lift\nload: {}\n", "- 1\n", ""})
    EXPECT_EQ(complaint_about(text), "") << text;
}

}  // namespace
}  // namespace blocklift::pipeline
