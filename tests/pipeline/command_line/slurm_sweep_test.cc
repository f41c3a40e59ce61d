// `blocklift sweep --slurm`: the jobs that it writes, run by a stand-in for Slurm's sbatch.

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of_file;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// Takes a script, says a job's number with the cluster's name, as Slurm may, and runs what is asked
// of it: every task of an array, or the one job.
constexpr const char* sbatch = R"(#!/bin/bash
echo "$@" >> "$CALLS"
script="${@: -1}"
tasks=$(sed -n 's/^#SBATCH --array=1-//p' "$script")
for task in $(seq ${tasks:-1}); do
  ${tasks:+env SLURM_ARRAY_TASK_ID=$task} bash "$script" >> "$CALLS.out" 2>&1 || exit 1
done
echo "$((40 + $(wc -l < "$CALLS")));north"
)";

class SlurmSweep : public ::testing::Test {
 protected:
  SlurmSweep() {
    fs::create_directory("it's here");
    fs::copy(BLOCKLIFT_SMALL_LIFT, "it's here/lift", fs::copy_options::recursive);
    folder_.write("it's here/study.yaml",
                  "study: spread\ncase: lift\nmembers: 7\nvary:\n  weight: {keys: ['block:mass'], "
                  "spread: {law: normal, mean: 8 t, deviation: 0.2 t}}\n");
    folder_.write("bin/sbatch", sbatch);
    fs::permissions("bin/sbatch", fs::perms::owner_all);
  }
  /// With the stand-in on the path, from the study's folder.
  Outcome run(const std::string& arguments) const {
    const std::string bin = (folder_.path() / "bin").string();
    return test::run_command("cd \"it's here\" && PATH='" + bin + "':\"$PATH\" CALLS='" + bin +
                             "/calls' '" BLOCKLIFT_EXECUTABLE "' " + arguments);
  }
  const test::TemporaryFolder folder_;
};

TEST_F(SlurmSweep, SubmitsPartsAndAJobThatJoinsThem) {
  const Outcome outcome =
      run("sweep study.yaml -o out --slurm --parts 3 --workers 2 --sbatch=--partition=long "
          "--sbatch --time=30");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << text_of_file("bin/calls.out");
  EXPECT_EQ(outcome.out, "job 41: 3 parts; job 42: joins them\n");
  const std::string calls = text_of_file("bin/calls");
  EXPECT_THAT(calls, AllOf(HasSubstr("slurm/part-%a.log"), HasSubstr("--dependency=afterok:41 ")));
  const std::string parts = text_of_file("it's here/out/slurm/parts.sh");
  EXPECT_THAT(
      parts, AllOf(HasSubstr("\n#SBATCH --array=1-3\n"), HasSubstr("\n#SBATCH --cpus-per-task=2\n"),
                   HasSubstr("\n#SBATCH --partition=long\n#SBATCH --time=30\n")));
  for (const char* member : {"1/members/000000.json", "3/members/000002.json"})
    EXPECT_TRUE(fs::exists(fs::path("it's here/out/parts") / member)) << member;
  EXPECT_THAT(text_of_file("bin/calls.out"), HasSubstr("3: 2 members taken over\n"));

  ASSERT_EQ(run("sweep study.yaml -o whole -q").exit_code, 0);
  for (const char* file : {"study.csv", "study.json"})
    EXPECT_EQ(text_of_file(fs::path("it's here/out") / file),
              text_of_file(fs::path("it's here/whole") / file));
}

TEST_F(SlurmSweep, OnlyWritesWhereItIsToldToOrThereIsNoSlurm) {
  const Outcome written = run("sweep study.yaml -o out --slurm=write");
  ASSERT_EQ(written.exit_code, 0) << written.err;
  EXPECT_THAT(written.out, ::testing::ContainsRegex("submits 7[ \n]+parts"));
  EXPECT_FALSE(fs::exists("bin/calls"));
  EXPECT_FALSE(fs::exists("it's here/out/members"));
  EXPECT_TRUE(fs::exists("it's here/out/slurm/submit.sh"));

  fs::remove("bin/sbatch");
  const Outcome nowhere = test::run_command("cd \"it's here\" && PATH=. '" BLOCKLIFT_EXECUTABLE
                                            "' sweep study.yaml -o out --slurm");
  EXPECT_EQ(nowhere.exit_code, 0) << nowhere.err;
  EXPECT_THAT(nowhere.out, HasSubstr("there is no sbatch here"));
}

TEST_F(SlurmSweep, SaysWhatIsWrong) {
  const auto refused = [&](const std::string& arguments, const std::string& text) {
    const Outcome outcome = run("sweep study.yaml -o out " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_FALSE(fs::exists("it's here/out/slurm")) << arguments;
  };
  refused("--slurm=later", "later not in {submit,write}");
  refused("--slurm --part 1/3", "--part excludes --slurm");
  refused("--parts 3", "--parts requires --slurm");
  refused("--slurm --parts 0", "0 not in range");
  refused("--slurm --sbatch long", "an option of sbatch is due, for example --partition=long");
  folder_.write("it's here/study.yaml",
                "study: spread\ncase: lift\ndesign: search\nmembers: 20\n"
                "maximise: ropes.R1.max_static_tension_N\n"
                "vary: {weight: {keys: ['block:mass'], between: [7 t, 9 t]}}\n");
  refused("--slurm", "a search has no parts");
}

// What Slurm refuses is no success, and the jobs can still be submitted by hand.
TEST_F(SlurmSweep, TellsOfJobsThatAreNotTaken) {
  folder_.write("bin/sbatch", "#!/bin/sh\necho 'sbatch: error: invalid partition' >&2\nexit 1\n");
  const Outcome outcome = run("sweep study.yaml -o out --slurm");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("invalid partition"),
                                 HasSubstr("blocklift: error: Slurm did not take the jobs"),
                                 HasSubstr("slurm/submit.sh submits them")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("parts")));
}

}  // namespace
}  // namespace blocklift::pipeline
