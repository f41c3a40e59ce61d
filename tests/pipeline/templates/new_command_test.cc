// `blocklift new` as a user meets it: every template is valid and runs as it was written.
#include <filesystem>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/templates/new_case.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using ::testing::HasSubstr;
using ::testing::Not;

Outcome run(const std::string& arguments) {
  return test::run_program(BLOCKLIFT_EXECUTABLE, arguments);
}

class EveryTemplate : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryTemplate, IsValidAndRunsAsTheProgramSays) {
  const test::TemporaryFolder folder;
  const Outcome written = run("new " + GetParam() + " my-lift");
  ASSERT_EQ(written.exit_code, 0) << written.err;
  for (const auto& entry : fs::directory_iterator("my-lift")) {
    const std::string text = test::text_of_file(entry.path());
    EXPECT_THAT(text, Not(HasSubstr("NAME_OF_FOLDER"))) << entry.path();
    EXPECT_TRUE(text.starts_with("#")) << entry.path() << " does not say what it is";
  }
  // "run it: blocklift assess my-lift"
  const std::string mark = "run it: blocklift ";
  const std::size_t at = written.out.find(mark);
  ASSERT_NE(at, std::string::npos) << written.out;
  const std::string command = written.out.substr(at + mark.size());
  const std::string arguments = command.substr(0, command.find('\n'));
  const std::string file = arguments.substr(arguments.find(' ') + 1);
  const Outcome valid = run("validate " + file);
  EXPECT_EQ(valid.exit_code, 0) << valid.err;
  EXPECT_THAT(valid.out, HasSubstr("my-lift"));
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  // A study has other results than the case beside it, which would lie among them.
  const bool is_study = GetParam() == "study";
  EXPECT_TRUE(fs::exists(is_study ? "results/my-lift-study" : "results/my-lift")) << outcome.out;
  // The floating crane is for a first look, without the water that moves along: it is warned of that
  // alone. Other templates show no warning.
  std::string out = outcome.out;
  if (GetParam() == "floating-crane") {
    const std::string first_look = "warning: In waves, and radiation: none";
    ASSERT_THAT(out, HasSubstr(first_look));
    out.erase(out.find(first_look), first_look.size());
  }
  EXPECT_THAT(out, Not(HasSubstr("warning:")));
}

INSTANTIATE_TEST_SUITE_P(NewCommand, EveryTemplate, ::testing::ValuesIn(template_kinds()),
                         [](const auto& info) {
                           std::string name = info.param;
                           for (char& letter : name)
                             if (letter == '-') letter = '_';
                           return name;
                         });

TEST(NewCommand, RefusesAFolderThatIsThereAndLeavesItAlone) {
  const test::TemporaryFolder folder;
  folder.write("mine/notes.txt", "keep me");
  const Outcome outcome = run("new part mine");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("mine: error: is there already"));
  EXPECT_EQ(std::distance(fs::directory_iterator("mine"), {}), 1);
  EXPECT_EQ(run("new part mine/notes.txt").exit_code, 2);
  const Outcome in_a_file = run("new part mine/notes.txt/case");
  EXPECT_EQ(in_a_file.exit_code, 2) << in_a_file.err;
}

TEST(NewCommand, NamesTheKindsThatThereAre) {
  const test::TemporaryFolder folder;
  const Outcome outcome = run("new turnover x");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("turn-over"));
  EXPECT_FALSE(fs::exists("x"));
}

TEST(NewCommand, MakesANameOfAnyFolder) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(run("new mechanism 'deep/my lift no. 1/'").exit_code, 0);
  EXPECT_THAT(test::text_of_file("deep/my lift no. 1/mechanism.yaml"),
              HasSubstr("mechanism: my-lift-no--1\n"));
  // Nothing lies beside the folder.
  EXPECT_EQ(std::distance(fs::directory_iterator("deep"), {}), 1);
}

}  // namespace
}  // namespace blocklift::pipeline
