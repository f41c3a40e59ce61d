#include "pipeline/terminal/run_log.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/terminal/progress_bar.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(RunLog, HoldsArgumentsStagesWarningsAndTheEnd) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "run.log";
  begin_log({.quiet = true, .verbose = false, .file = file.string()}, {"assess", "a case"});
  EXPECT_TRUE(is_quiet());
  { const ProgressBar stage("time integration"); }
  say_warning("the load stands in the ground");
  log_error("it broke");
  end_log(3);
  const std::string text = content_of(file);
  for (const char* part :
       {": blocklift assess a case\n", "info: time integration begins\n",
        "info: time integration took 0.0 s\n", "warning: the load stands in the ground\n",
        "error: it broke\n", "info: exit code 3 after 0.0 s, at most "})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis missing in\n" << text;

  // A second run goes on in the same file.
  begin_log({.quiet = false, .verbose = false, .file = file.string()}, {"report"});
  EXPECT_FALSE(is_quiet());
  begin_log({}, {});
  EXPECT_TRUE(content_of(file).starts_with(text));
  EXPECT_NE(content_of(file).find(": blocklift report\n"), std::string::npos);
}

TEST(RunLog, RefusesAFileThatCannotBeWritten) {
  EXPECT_THROW(begin_log({.quiet = false, .verbose = false, .file = "/proc/nowhere/log"}, {}),
               LogError);
}

}  // namespace
}  // namespace blocklift::pipeline
