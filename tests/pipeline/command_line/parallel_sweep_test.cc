// `blocklift sweep` on several processes, and when some of them are lost.

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of_file;
using ::testing::HasSubstr;

constexpr const char* launcher = "mpirun --allow-run-as-root --oversubscribe ";
constexpr const char* program = "'" BLOCKLIFT_EXECUTABLE "' ";

Outcome sweep_on_processes(int count, const std::string& arguments) {
  return test::run_command(launcher + ("-n " + std::to_string(count) + " ") + program + arguments);
}

/// A shell's words that wait until a study in "out" has some members, and kill a process then.
std::string kill_in_the_middle(const std::string& process) {
  return "until [ $(ls out/members 2>/dev/null | wc -l) -gt 5 ]; do sleep 0.02; done; kill -9 " +
         process;
}

class ParallelSweep : public ::testing::Test {
 protected:
  ParallelSweep() {
    fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive);
    write_study(
        "members: 60\nvary:\n"
        "  weight: {keys: ['block:mass'], spread: {law: normal, mean: 8 t, deviation: 0.2 t}}\n");
  }
  void write_study(const std::string& lines) const {
    folder_.write("study.yaml", "study: spread\ncase: lift\n" + lines);
  }
  static void run_alone() {
    ASSERT_EQ(test::run_blocklift("sweep study.yaml -o alone -q").exit_code, 0);
  }
  static void expect_figures_of_alone(const std::string& folder) {
    EXPECT_EQ(text_of_file(folder + "/study.csv"), text_of_file("alone/study.csv"));
    EXPECT_EQ(text_of_file(folder + "/study.json"), text_of_file("alone/study.json"));
  }
  /// Two processes, the second of which is killed in the middle.
  Outcome run_with_a_lost_process(const std::string& options) const {
    const std::string study = std::string(program) + "sweep study.yaml -o out";
    folder_.write("second.sh", "(" + kill_in_the_middle("$$") + ") &\nexec " + study + "\n");
    return test::run_command(launcher + options + " -n 1 " + study + " : -n 1 sh second.sh");
  }

  const test::TemporaryFolder folder_;
};

TEST_F(ParallelSweep, GivesTheSameOnAnyNumberOfProcesses) {
  run_alone();
  const Outcome two = sweep_on_processes(2, "sweep study.yaml -o two --log two.log");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  EXPECT_THAT(two.out, ::testing::StartsWith("spread\n"));
  EXPECT_EQ(two.out.find("60 members, 0 failed"), two.out.rfind("60 members, 0 failed"));
  EXPECT_THAT(two.err, ::testing::MatchesRegex(test::only_progress));
  ASSERT_EQ(sweep_on_processes(3, "sweep study.yaml -o three -q --workers 2").exit_code, 0);
  expect_figures_of_alone("two");
  expect_figures_of_alone("three");
}

TEST_F(ParallelSweep, FindsTheStressOnSeveralProcesses) {
  write_study(
      "run: stress\ndesign: grid\nfigures: [structure.history.dynamic.checked_von_mises_Pa]\n"
      "vary:\n  weight: {keys: ['block:mass'], values: [8 t, 8.2 t, 8.4 t]}\n");
  run_alone();
  ASSERT_EQ(sweep_on_processes(2, "sweep study.yaml -o two -q").exit_code, 0);
  expect_figures_of_alone("two");
}

TEST_F(ParallelSweep, SearchesOnSeveralProcesses) {
  write_study(
      "design: search\nmembers: 24\nmaximise: ropes.R1.max_static_tension_N\n"
      "vary: {weight: {keys: ['block:mass'], between: [7 t, 9 t]}}\n"
      "subject_to: [{figure: ropes.R2.max_static_tension_N, at_most: 23 kN}]\n");
  run_alone();
  const Outcome two = sweep_on_processes(2, "sweep study.yaml -o two -q");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  expect_figures_of_alone("two");
}

// The launcher ends all processes with the one that is lost.
TEST_F(ParallelSweep, GoesOnAfterAProcessWasKilled) {
  run_alone();
  EXPECT_NE(run_with_a_lost_process("").exit_code, 0);
  EXPECT_FALSE(fs::exists("out/study.json"));
  EXPECT_TRUE(fs::exists("out/members/000000.json"));
  ASSERT_EQ(sweep_on_processes(2, "sweep study.yaml -o out -q").exit_code, 0);
  expect_figures_of_alone("out");
}

TEST_F(ParallelSweep, DoesWithoutAProcessWhereTheLauncherBearsIt) {
  run_alone();
  const Outcome outcome = run_with_a_lost_process("--enable-recovery -x BLOCKLIFT_LOST_AFTER=3");
  EXPECT_THAT(outcome.out, HasSubstr("process 1 is lost: nothing was heard of it for 3 s"));
  EXPECT_THAT(outcome.out, HasSubstr("60 members, 0 failed"));
  expect_figures_of_alone("out");
}

// MPI joins all processes or none, and waits for one that will never come.
TEST_F(ParallelSweep, EndsWhereAProcessIsLostBeforeItHasJoined) {
  folder_.write("second.sh", "kill -9 $$\n");
  const Outcome outcome = test::run_command(
      launcher + ("--enable-recovery -x BLOCKLIFT_LOST_AFTER=1 -n 1 " + std::string(program)) +
      "sweep study.yaml -o out : -n 1 sh second.sh");
  // The launcher that bears losses calls this 0, whatever its processes ended with.
  EXPECT_THAT(outcome.out,
              HasSubstr("2 processes were started, and not all of them have joined for 1 s"));
  EXPECT_THAT(outcome.err, HasSubstr("the processes have not joined for 5 s"));
  EXPECT_FALSE(fs::exists("out"));
}

TEST_F(ParallelSweep, GivesALostWorkersMemberToAnother) {
  run_alone();
  const Outcome outcome = test::run_command(
      std::string(program) + "sweep study.yaml -o out & study=$!; " +
      kill_in_the_middle("$(cut -d ' ' -f 1 /proc/$study/task/$study/children)") + "; wait $study");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("60 members, 0 failed"));
  expect_figures_of_alone("out");
}

TEST_F(ParallelSweep, SaysOnceWhatIsWrong) {
  const Outcome outcome = sweep_on_processes(3, "sweep nowhere.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  const std::string said = "nowhere.yaml: error: there is no such file";
  EXPECT_THAT(outcome.err, HasSubstr(said));
  EXPECT_EQ(outcome.err.find(said), outcome.err.rfind(said));
  EXPECT_FALSE(fs::exists("out"));
}

// A machine that has another case than the first one's would give figures of another lift.
TEST_F(ParallelSweep, RefusesAProcessWithAnotherCase) {
  fs::create_directories("other");
  fs::copy("lift", "other/lift", fs::copy_options::recursive);
  fs::copy("study.yaml", "other/study.yaml");
  const std::string block = text_of_file("other/lift/block.yaml");
  folder_.write("other/lift/block.yaml", block + "# as it was before\n");
  const std::string study = std::string(program) + "sweep study.yaml -o out";
  const Outcome outcome =
      test::run_command(launcher + ("-n 1 " + study + " : -n 1 -wdir other " + study));
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_THAT(outcome.err, HasSubstr("process 1: its study, case or version of the program is "
                                     "another than that of the first process"));
}

}  // namespace
}  // namespace blocklift::pipeline
