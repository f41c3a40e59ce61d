// `blocklift validate` and `blocklift schema` as a user meets them: run as a process.

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::run_blocklift;
using test::SampleLift;
using test::TemporaryFolder;
using test::with;

std::size_t files_in(const fs::path& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::recursive_directory_iterator(folder)) ++count;
  return count;
}

TEST(ValidateCommand, TakesTheShippedCases) {
  for (const auto& folder : fs::directory_iterator(BLOCKLIFT_CASES)) {
    if (!fs::exists(folder.path() / "case.yaml")) continue;
    const Outcome outcome = run_blocklift("validate '" + folder.path().string() + "'");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
}

TEST(ValidateCommand, SaysWhatIsInASoundFile) {
  const TemporaryFolder folder;
  SampleLift().write(folder);
  const Outcome outcome =
      run_blocklift("validate . gantry/crane.yaml plate.yaml gantry/ropes/tackle.yaml");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out,
            ".: valid, lift case small-lift: 1 crane, 2 ropes, 2 stages, 80 s\n"
            "gantry/crane.yaml: valid, crane with 2 bodies, 2 drives and 2 hoists\n"
            "plate.yaml: valid, block with 2 kinds of plates and 2 lugs\n"
            "gantry/ropes/tackle.yaml: valid, rope\n");
}

// A folder of a case that holds a study of it, too; keys that are set are the case's.
TEST(ValidateCommand, ReadsTheStudyBesideACase) {
  const TemporaryFolder folder;
  SampleLift().write(folder);
  folder.write("study.yaml",
               "study: s\ncase: case.yaml\ndesign: random\nmembers: 3\nvary:\n"
               "  wait: {keys: [settle], values: [20 s, 30 s]}\n");
  const Outcome sound = run_blocklift("validate .");
  EXPECT_EQ(sound.exit_code, 0) << sound.err;
  EXPECT_NE(sound.out.find(".: valid, lift case small-lift"), std::string::npos) << sound.out;
  EXPECT_NE(sound.out.find("study.yaml: valid, study s of case.yaml with 1 variable and 3 members"),
            std::string::npos)
      << sound.out;
  const Outcome set = run_blocklift("validate . --set 'settle=21 s'");
  EXPECT_EQ(set.exit_code, 0) << set.err;
  EXPECT_EQ(set.out.find("study"), std::string::npos) << set.out;
  folder.write("study.yaml",
               "study: s\ncase: case.yaml\ndesign: random\nmembers: 3\nvary:\n"
               "  wait: {keys: [setle], values: [20 s, 30 s]}\n");
  const Outcome wrong = run_blocklift("validate .");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("study.yaml:6:"), std::string::npos) << wrong.err;
}

// The plate weighs 10 t.
TEST(ValidateCommand, WeighsALoadTable) {
  const auto validate_table = [](const std::string& direction, const std::string& loads) {
    const TemporaryFolder folder;
    SampleLift lift;
    lift.lift_case =
        with(with(test::sample_load_table_case, "direction: [0, 0, 2]", "direction: " + direction),
             "static: {L1: 5 t, L2: 50 kN}", "static: " + loads);
    lift.write(folder);
    return run_blocklift("validate .");
  };
  const Outcome sound = validate_table("[0, 0, 1]", "{L1: 5 t, L2: 5 t}");
  EXPECT_EQ(sound.exit_code, 0) << sound.err;
  EXPECT_EQ(sound.out.find("warning"), std::string::npos) << sound.out;
  const Outcome heavy = validate_table("[0, 0, 1]", "{L1: 7 t, L2: 7 t}");
  EXPECT_EQ(heavy.exit_code, 0) << heavy.err;
  EXPECT_NE(heavy.out.find("warning: The loads of the table at rest sum to 14 t, 40.0 % more than "
                           "the weight of the block, 10 t"),
            std::string::npos)
      << heavy.out;
  const Outcome beside = validate_table("[0, 0, 1]", "{L1: 2 t, L2: 8 t}");
  EXPECT_NE(beside.out.find("warning: The loads of the table at rest pull 1.2 m beside the centre "
                            "of mass"),
            std::string::npos)
      << beside.out;
  const Outcome down = validate_table("[0, 0, -1]", "{L1: 5 t, L2: 5 t}");
  EXPECT_EQ(down.exit_code, 2);
  EXPECT_NE(down.err.find("they press the block down at its lugs"), std::string::npos) << down.err;
}

TEST(ValidateCommand, SetsKeysOfACaseAndItsModels) {
  const TemporaryFolder folder;
  SampleLift().write(folder);
  const Outcome negative = run_blocklift("validate . --set 'plate:mass=-1 t'");
  EXPECT_EQ(negative.exit_code, 2);
  EXPECT_NE(negative.err.find("mass \"-1 t\" must be"), std::string::npos) << negative.err;
  const Outcome of_model = run_blocklift("validate plate.yaml --set 'mass=1 t'");
  EXPECT_EQ(of_model.exit_code, 2);
  EXPECT_NE(of_model.err.find("--set mass=1 t: error: no key of plate.yaml is set"),
            std::string::npos)
      << of_model.err;
}

TEST(ValidateCommand, WarnsOfDoubtfulValues) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.block = with(lift.block, "206 GPa", "0.2 GPa");
  lift.write(folder);
  const Outcome outcome = run_blocklift("validate .");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("warning: Material steel has a Young's modulus of 0.2 GPa"),
            std::string::npos)
      << outcome.out;
}

TEST(ValidateCommand, SaysEverythingThatIsWrongAndWritesNothing) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.lift_case = with(lift.lift_case, "to: L2", "to: L7");
  lift.lift_case = with(lift.lift_case, "speed: 15 m/min", "speed: 3 m");
  lift.crane = with(lift.crane, "mass: 8 t", "mass: -8 t");
  lift.write(folder);
  const std::size_t files_before = files_in(folder.path());
  const Outcome outcome = run_blocklift("validate case.yaml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(
      outcome.err,
      "case.yaml:10:28: error: rope R2 ends at lug \"L7\", which block plate does not have\n"
      "    its lugs are L1, L2; did you mean \"L1\"?\n"
      "case.yaml:18:48: error: speed \"3 m\" is a length; a speed or an angular speed is due, "
      "for example \"3 m/min\" or \"0.5 deg/s\"\n"
      "gantry/crane.yaml:10:19: error: mass \"-8 t\" must be at least 0\n"
      "3 errors\n");
  EXPECT_EQ(files_in(folder.path()), files_before);
}

TEST(ValidateCommand, RefusesFilesThatAreNoInput) {
  const TemporaryFolder folder;
  folder.write("empty.yaml", "");
  folder.write("binary.yaml", std::string("\0\1\2\3", 4));
  folder.write("latin1.yaml",
               "title: Gr\xfc\xdf"
               "e\n");
  folder.write("huge.yaml", "a: 1\n");
  fs::resize_file("huge.yaml", 50'000'000);
  const Outcome outcome =
      run_blocklift("validate empty.yaml binary.yaml latin1.yaml huge.yaml missing.yaml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "empty.yaml: error: the file is empty; keys and values are due\n"
            "binary.yaml: error: the file is binary, not text; a YAML file is due\n"
            "latin1.yaml:1:10: error: the byte 0xFC is not UTF-8; save the file as UTF-8\n"
            "huge.yaml: error: the file has 50.0 MB; an input file has at most 10 MB\n"
            "missing.yaml: error: there is no such file\n"
            "5 errors\n");
}

TEST(ValidateCommand, FindsModelsWhereTheEnvironmentSays) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.lift_case = with(lift.lift_case, "model: gantry", "model: cranes/small");
  lift.write(folder);
  folder.write("elsewhere/cranes/small/crane.yaml", lift.crane);
  folder.write("elsewhere/ropes/tackle.yaml", lift.rope);
  setenv("BLOCKLIFT_MODELS", (folder.path() / "elsewhere").c_str(), 1);
  const Outcome found = run_blocklift("validate case.yaml");
  setenv("BLOCKLIFT_MODELS", "/nowhere", 1);
  const Outcome missing = run_blocklift("validate case.yaml");
  unsetenv("BLOCKLIFT_MODELS");
  EXPECT_EQ(found.exit_code, 0) << found.err;
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err.substr(0, 66),
            "case.yaml:6:12: error: there is no crane model \"cranes/small\"\n    ");
}

TEST(ValidateCommand, ReadsNothingOutsideUnlessThatIsAllowed) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.lift_case = with(lift.lift_case, "model: gantry", "model: ../yard/gantry");
  folder.write("case/case.yaml", lift.lift_case);
  folder.write("case/plate.yaml", lift.block);
  folder.write("case/ropes/tackle.yaml", lift.rope);
  folder.write("yard/gantry.yaml", lift.crane);
  const Outcome refused = run_blocklift("validate case");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("case.yaml:6:12: error: \"../yard/gantry\" leads outside"),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(run_blocklift("validate case --allow-outside").exit_code, 0);
  setenv("BLOCKLIFT_ALLOW_OUTSIDE", "1", 1);
  EXPECT_EQ(run_blocklift("validate case").exit_code, 0);
  setenv("BLOCKLIFT_MODELS", (folder.path() / "yard").c_str(), 1);
  unsetenv("BLOCKLIFT_ALLOW_OUTSIDE");
  EXPECT_EQ(run_blocklift("validate case").exit_code, 0);  // it lies among the models now
  unsetenv("BLOCKLIFT_MODELS");
}

TEST(ValidateCommand, TellsWrongUseByItsExitCode) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_blocklift("").exit_code, 2);
  EXPECT_EQ(run_blocklift("validate").exit_code, 2);
  EXPECT_EQ(run_blocklift("lift everything").exit_code, 2);
  EXPECT_EQ(run_blocklift("--help").exit_code, 0);
  EXPECT_EQ(run_blocklift("--version").out.substr(0, 10), "blocklift ");
}

TEST(SchemaCommand, PrintsSchemaAndManual) {
  const TemporaryFolder folder;
  const Outcome schema = run_blocklift("schema --kind rope");
  EXPECT_EQ(schema.exit_code, 0);
  EXPECT_EQ(schema.out.substr(0, 2), "{\n");
  EXPECT_EQ(run_blocklift("schema --manual").out.substr(0, 14), "# Input files\n");
  EXPECT_EQ(run_blocklift("schema --kind boat").exit_code, 2);
}

TEST(ValidateCommand, SaysWhatTheMeshGeneratorWillRefuse) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.block = with(lift.block, "z: [1 m, 1.4 m], thickness: 40 mm, pin: [0 m, 0 m, 1.2 m]",
                    "z: [1.1 m, 1.4 m], thickness: 40 mm, pin: [0 m, 0 m, 1.2 m]");
  lift.write(folder);
  const std::string complaint =
      "plate.yaml:1:1: error: not joined to the rest of the block: L1 at x = 0 m; extend them "
      "until they reach another plate\n1 error\n";
  for (const char* file : {"validate case.yaml", "validate plate.yaml", "assess case.yaml"}) {
    const Outcome outcome = run_blocklift(file);
    EXPECT_EQ(outcome.exit_code, 2) << file;
    EXPECT_EQ(outcome.err, complaint) << file;
    EXPECT_FALSE(fs::exists("results"));
  }
}

TEST(ValidateCommand, SaysThatABlockWeighsLessThanItsPlates) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.block = with(lift.block, "mass: 10 t", "mass: 1.8 t");
  lift.write(folder);
  // Bottom, webs without the hole, what pads are thicker, and lugs: 1,965.6 kg.
  const std::string complaint =
      "plate.yaml:4:7: error: the block's mass is stated as 1.8 t, and its plates alone weigh "
      "1.966 t\n"
      "    give the mass in the lift, outfitting included; or mend thicknesses, openings and "
      "densities of the plates; or leave mass and centre_of_mass out: then they are those of the "
      "plates\n1 error\n";
  for (const char* file :
       {"validate case.yaml", "validate plate.yaml", "assess case.yaml", "simulate case.yaml"}) {
    const Outcome outcome = run_blocklift(file);
    EXPECT_EQ(outcome.exit_code, 2) << file;
    EXPECT_EQ(outcome.err, complaint) << file;
    EXPECT_FALSE(fs::exists("results"));
  }
  // Within a twentieth, as shells that overlap at joints may make it.
  folder.write("plate.yaml", with(lift.block, "mass: 1.8 t", "mass: 1.9 t"));
  EXPECT_EQ(run_blocklift("validate case.yaml").exit_code, 0);
}

TEST(ValidateCommand, RefusesAnEmptyName) {
  const Outcome outcome = run_blocklift("validate ''");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.substr(0, 45), "input: error: the name of the case is empty\n ");
}

TEST(AssessBeforeTheRun, SaysThatResultsCannotBeWritten) {
  const TemporaryFolder folder;
  SampleLift().write(folder);
  folder.write("taken", "a file");
  const Outcome outcome = run_blocklift("assess case.yaml --output taken/results");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "taken/results: error: results cannot be written here: " +
                             (folder.path() / "taken").string() +
                             " is no folder\n    name another folder with --output\n1 error\n");
}

}  // namespace
}  // namespace blocklift::pipeline
