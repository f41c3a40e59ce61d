// Members run no farther than their figures ask, and their figures are those of a whole run.
#include "pipeline/study/members/members.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/study/design/study_design.h"
#include "pipeline/study/members/asked_figures.h"
#include "pipeline/study/run/study_run.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

class Members : public ::testing::Test {
 protected:
  Members() {
    std::filesystem::copy(BLOCKLIFT_SMALL_LIFT, "lift", std::filesystem::copy_options::recursive);
  }

  StudyFile study_of(const std::string& figures, const std::string& run = "simulate") const {
    folder_.write("study.yaml", "study: small\ncase: lift\ndesign: grid\nrun: " + run +
                                    (figures.empty() ? "" : "\nfigures: [" + figures + "]") +
                                    "\nvary: {w: {keys: ['block:mass'], values: [8.1 t]}}\n");
    return read_study("study.yaml");
  }
  static Member run(const StudyFile& study) {
    StudyBlocks blocks(study, "members");
    std::filesystem::create_directories("members");
    Member member = run_member(study, make_design(study).row(0), 0, blocks);
    EXPECT_EQ(member.failure, "");
    return member;
  }

  const test::TemporaryFolder folder_;
};

// What is held against the members' figures afterwards computes none of them again.
TEST_F(Members, DoNotFollowFromLimitsTitlesAndComments) {
  const auto identity = [&](const std::string& value, const std::string& rest) {
    folder_.write(
        "study.yaml",
        "study: small\ncase: lift\ndesign: grid\nfigures: [ropes.R1.max_dynamic_tension_N]\n"
        "vary:\n  h: {keys: [ropes.R1.length], values: [2.9 m, " +
            value +
            "]}\n  p: {keys: [settle], values: [4 s]}\n"
            "limits:\n  height: h\n  period: p\n"
            "  of: [{figure: ropes.R1.max_dynamic_tension_N, at: " +
            rest);
    return identity_of_study(read_study("study.yaml"));
  };
  const std::string as_it_was = identity("3 m", "30 kN}]\n");
  EXPECT_EQ(identity("3 m", "31 kN}]\n  alpha: 0.7\ntitle: of today # at noon\n"), as_it_was);
  EXPECT_NE(identity("3.01 m", "30 kN}]\n"), as_it_was);
}

// A part of which nothing is known beside a figure makes the whole run of it. The same operations
// in the same order give the same bits: nothing is tolerated.
TEST_F(Members, HaveTheFiguresOfAWholeRun) {
  const std::vector<std::string> paths = {
      "ropes.R1.max_dynamic_tension_N",
      "ropes.R2.time_of_max_dynamic_s",
      "ropes.R1.linked_dynamic_N.R3",
      "ropes.R1.dynamic_over_static",
      "hoists.C1.left.max_dynamic_tension_N",
      "hoists.C1.left.max_swing_rad",
      "cranes.C1.max_static_load_N",
      "cranes.C1.max_dynamic_load_N",
      "stages.carry.load.max_dynamic_tension_N",
      "'measures.load: tilt.dynamic'",
      "'measures.load: righting height.static'",
      "energy.relative_imbalance",
      "solver.steps",
  };
  std::string all = "timing.simulated_s";
  for (const std::string& path : paths) all += ", " + path;
  const StudyFile whole_study = study_of(all);
  EXPECT_TRUE(AskedFigures(whole_study).is_among_all());
  const Member whole = run(whole_study);
  EXPECT_TRUE(whole.unknown.empty());
  ASSERT_EQ(whole.figures.size(), paths.size() + 1);
  for (const std::string& path : paths) {
    const StudyFile study = study_of(path);
    EXPECT_FALSE(AskedFigures(study).is_among_all()) << path;
    const Member member = run(study);
    ASSERT_EQ(member.figures.size(), 1U) << path;
    const auto& [name, value] = member.figures.front();
    EXPECT_EQ(value, whole.figure(name)) << path;
    EXPECT_EQ(member.unit(name), whole.unit(name)) << path;
  }
}

// The mesh of a study stays; what its members state is held against it all the same.
TEST_F(Members, CannotWeighLessThanTheirPlates) {
  folder_.write(
      "study.yaml",
      "study: small\ncase: lift\ndesign: grid\nrun: simulate\nfigures: "
      "[ropes.R1.max_dynamic_tension_N]\nvary: {w: {keys: ['block:mass'], values: [8 t, 3 "
      "t]}}\n");
  const StudyFile study = read_study("study.yaml");
  StudyBlocks blocks(study, "members");
  std::filesystem::create_directories("members");
  const Eigen::MatrixXd design = make_design(study);
  EXPECT_EQ(run_member(study, design.row(0), 0, blocks).failure, "");
  EXPECT_NE(run_member(study, design.row(1), 1, blocks).failure.find("its plates alone weigh"),
            std::string::npos);
}

// Before the run it is said at the value's own place, once, with what it does to the block.
TEST_F(Members, AreHeldAgainstTheirPlatesBeforeTheRun) {
  const auto plan = [&](const std::string& lines) -> std::string {
    folder_.write("study.yaml", "study: small\ncase: lift\ndesign: grid\nvary:\n" + lines);
    try {
      plan_members(read_study("study.yaml"), [](double) {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(plan("  w: {keys: ['block:mass'], values: [8 t, 7 t, 9 t]}\n"), "");
  const std::string light = plan("  w: {keys: ['block:mass'], values: [8 t, 3 t, 9 t]}\n");
  EXPECT_EQ(light.find("study.yaml:5:43: error: a member of the study is impossible: w = 3000 kg\n"
                       "    "),
            0U)
      << light;
  EXPECT_NE(light.find("block's mass is stated as 3 t, and its plates alone weigh"),
            std::string::npos)
      << light;
  EXPECT_TRUE(light.ends_with("\n1 error\n")) << light;
  // A centre of mass that no outfitting draws there.
  const std::string far = plan("  x: {keys: ['block:centre_of_mass[1]'], values: [2 m, 40 m]}\n");
  EXPECT_NE(far.find("study.yaml:5:56: error: a member of the study is impossible: x = 40 m"),
            std::string::npos)
      << far;
  // Thicker plates weigh more than is stated: each block has plates of its own, and the first is
  // sound.
  const std::string thick = plan(
      "  w: {keys: ['block:mass'], values: [8 t, 9 t]}\n"
      "  t: {keys: ['block:plates.bottom.thickness'], values: [20 mm, 60 mm]}\n");
  EXPECT_NE(thick.find("study.yaml:6:64: error: a member of the study is impossible: t = 0.06 m"),
            std::string::npos)
      << thick;
  // What is wrong with the case itself no value is to blame for.
  std::ifstream stream("lift/block.yaml");
  std::string block{std::istreambuf_iterator<char>(stream), {}};
  block.replace(block.find("mass: 8 t"), 9, "mass: 2 t");
  folder_.write("lift/block.yaml", block);
  const std::string own = plan("  l: {keys: [ropes.R1.length], values: [3 m, 3.01 m]}\n");
  EXPECT_NE(own.find("block.yaml:5:7: error: the block's mass is stated as 2 t"), std::string::npos)
      << own;
  EXPECT_EQ(own.find("a member of the study"), std::string::npos) << own;
}

TEST_F(Members, HaveTheStressOfAWholeRun) {
  const std::string stress = "structure.history.dynamic.checked_von_mises_Pa";
  const std::string increase = "structure.history.stress_increase_percent";
  const Member part = run(study_of(stress + ", " + increase, "stress"));
  const Member whole = run(study_of(stress + ", " + increase + ", timing.simulated_s", "stress"));
  EXPECT_GT(part.figure(stress), 1e6);
  EXPECT_EQ(part.figure(stress), whole.figure(stress));
  EXPECT_EQ(part.figure(increase), whole.figure(increase));
}

TEST_F(Members, FindNothingThatIsNotAskedFor) {
  const auto extent = [&](const std::string& figures) {
    return AskedFigures(study_of(figures)).extent();
  };
  const RunExtent tension = extent("ropes.R1.max_dynamic_tension_N, cranes.C1.max_dynamic_load_N");
  EXPECT_FALSE(tension.at_rest || tension.natural_modes || tension.energy || tension.motion ||
               tension.rope_forces || tension.accelerations || tension.righting_height);
  EXPECT_TRUE(extent("ropes.R1.max_static_tension_N").at_rest);
  EXPECT_TRUE(extent("hoists.C1.left.max_swing_rad").rope_forces);
  const RunExtent energy = extent("energy.relative_imbalance");
  EXPECT_TRUE(energy.energy);
  EXPECT_FALSE(energy.at_rest || energy.motion || energy.rope_forces);
  // The usual figures have loads at rest and in motion, and natural periods.
  const RunExtent usual = extent("");
  EXPECT_TRUE(usual.at_rest && usual.natural_modes);
  EXPECT_FALSE(usual.energy || usual.accelerations);
}

}  // namespace
}  // namespace blocklift::pipeline
