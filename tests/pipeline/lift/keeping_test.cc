// Drives that keep something, and faults at their worst instant, from a case file to the run.
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "pipeline/lift/worst_instant.h"
#include "pipeline/measures/measure.h"
#include "tests/pipeline/lift/operated_lift.h"

namespace blocklift::pipeline {
namespace {

using test::lift_with_operation;
using test::sample_mass;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

LiftRun run_without_modes(const LiftCase& lift_case) {
  return test::run_sample(lift_case, RunExtent{.natural_modes = false});
}

/// Mean of a measure in motion from one time (s) to another.
double mean_in_motion(const LiftCase& lift_case, const LiftRun& lift, const std::string& name,
                      double from, double to) {
  for (const LiftMeasure& measure : find_measures(lift_case, lift)) {
    if (measure.name() != name) continue;
    const Eigen::VectorXd& time = lift.dynamic_history().time;
    Eigen::Index first = 0, last = 0;
    (time.array() - from).abs().minCoeff(&first);
    (time.array() - to).abs().minCoeff(&last);
    return measure.in_motion.segment(first, last - first + 1).mean();
  }
  ADD_FAILURE() << "there is no measure " << name;
  return NAN;
}

/// A measure in motion at a time (s).
double in_motion(const LiftCase& lift_case, const LiftRun& lift, const std::string& name,
                 double time) {
  return mean_in_motion(lift_case, lift, name, time, time);
}

const std::string keep_level =
    "  - stage: lower\n"
    "    moves:\n"
    "      - {drives: [C1.left], by: 2 m, speed: 3 m/min}\n"
    "      - {drives: [C1.right], keeps: {level: C1.right, with: C1.left, reaction: 0.5 s, "
    "correction: 4 s}}\n"
    "  - stage: rest\n"
    "    moves: [{drives: [C1.right], keeps: {level: L2, with: L1, reaction: 0.5 s, "
    "correction: 4 s}, duration: 40 s}]\n"
    "  - stage: hoist\n"
    "    moves: [{drives: [C1.left, C1.right], to: 5 m}]\n";

// The second hook follows the first: behind by 0.05 m/s times 4 s while it moves. Then the load's
// lugs are brought level. The stages behind begin where it came to, at rest as in motion, and where
// it is hoisted to is where that is asked to be.
TEST(Keeping, LevelWithAnotherHook) {
  const LiftCase lift_case = lift_with_operation(keep_level);
  const LiftRun lift = run_without_modes(lift_case);
  ASSERT_EQ(lift.model.steerings.size(), 2u);
  const double end = lift.model.steerings[0].end;
  EXPECT_NEAR(in_motion(lift_case, lift, "C1.right: missed height", 0.75 * end), 0.05 * 4, 0.01);
  EXPECT_NEAR(
      in_motion(lift_case, lift, "C1.right: missed height", lift.model.steerings[1].end - 0.1), 0.0,
      1e-3);
  for (const dynamics::History* history : {&lift.static_history, &lift.dynamic_history()}) {
    const auto& right = history->rope("C1.right").unstretched_length;
    EXPECT_GT(right.maxCoeff(), 6.9);
    EXPECT_NEAR(right[right.size() - 1], 5.0, 1e-9);
  }
}

// A stage that ends by a condition ends the steering as well: the hook that follows stands soon
// after.
TEST(Keeping, EndsWithACondition) {
  const LiftRun lift = run_without_modes(
      lift_with_operation("  - stage: set down\n"
                          "    moves:\n"
                          "      - {drives: [C1.left], by: 2.5 m, speed: 3 m/min}\n"
                          "      - {drives: [C1.right], keeps: {level: C1.right, with: C1.left}}\n"
                          "    until: {ground_bears_at_least: 80 %}\n"
                          "  - stage: hoist\n"
                          "    moves: [{drives: [C1.left, C1.right], to: 5 m}]\n",
                          "ground: 0 m\n"
                          "ground_contact: {stiffness: 5 MN/m, damping: 200 kN s/m}\n"));
  const ScheduledStage& stage = lift.model.schedule.stages[0];
  ASSERT_TRUE(stage.stop);
  EXPECT_EQ(lift.model.schedule.steerings[0].steering.end, stage.stop->time);
  const auto& right = lift.dynamic_history().rope("C1.right");
  Eigen::Index at_end = 0;
  (lift.dynamic_history().time.array() - stage.end).abs().minCoeff(&at_end);
  EXPECT_NEAR(right.unstretched_rate[at_end], 0.0, 1e-3);
  EXPECT_NEAR(right.unstretched_length[right.unstretched_length.size() - 1], 5.0, 1e-9);
}

// The trolley stays plumb over a point of the world while the gantry stands: it goes there.
TEST(Keeping, AHeadOverAPoint) {
  const LiftRun lift = run_without_modes(lift_with_operation(
      "  - stage: go there\n"
      "    moves: [{drives: [C1.traverse], duration: 60 s, keeps: {head: C1.left, "
      "over: {body: world, point: [0 m, 6.5 m, 0 m]}}}]\n"));
  const auto& drives = lift.dynamic_history().drives;
  const auto traverse = std::find_if(drives.begin(), drives.end(),
                                     [](const auto& drive) { return drive.name == "C1.traverse"; });
  ASSERT_NE(traverse, drives.end());
  EXPECT_NEAR(traverse->position[traverse->position.size() - 1], 6.5, 1e-4);
}

// The left hoist takes more of the load by tilting it: its centre lies 0.7 m below lugs 4 m apart,
// so that a hook lower by d takes W 0.7 d / 16 m less, 4.3 kN for each metre. The operator is told
// so: by the stiffness of the rope alone, which is two thousand times as large, he would hardly
// move. The load bounces by 0.3 kN about what is asked, at any tolerance of the integration: means
// count.
TEST(Keeping, AShareAndATension) {
  const std::string operation =
      "  - stage: share\n"
      "    moves: [{drives: [C1.left], duration: 60 s, keeps: {WISH, stiffness: 4.3 kN/m, "
      "correction: 2 s, reaction: 0.5 s}}]\n";
  for (const std::string& wish :
       {std::string("share: 50.2 %, of: [C1.right]"), std::string("tension: 54.5 kN")}) {
    const LiftCase lift_case = lift_with_operation(test::with(operation, "WISH", wish));
    const LiftRun lift = run_without_modes(lift_case);
    const char* name = wish[0] == 's' ? "C1.left: missed share" : "C1.left: missed tension";
    const double first = in_motion(lift_case, lift, name, 0.0);
    const double end = lift.model.steerings[0].end;
    const double last = mean_in_motion(lift_case, lift, name, end - 10.5, end - 0.5);
    EXPECT_LT(std::abs(last), 0.1 * std::abs(first)) << wish;
  }
}

// A law from outside in place of the wish, which asks for the same by the same figure, gives the
// same motion, with a stage that ends by a condition, too: it begins anew with each of the runs.
TEST(Keeping, ALawFromOutsideInPlaceOfAWish) {
  const std::string operation =
      "  - stage: set down\n"
      "    moves:\n"
      "      - {drives: [C1.left], by: 2.5 m, speed: 3 m/min}\n"
      "      - {drives: [C1.right], keeps: {WISH, reaction: 0.5 s}}\n"
      "    until: {ground_bears_at_least: 80 %}\n";
  const std::string ground =
      "ground: 0 m\n"
      "ground_contact: {stiffness: 5 MN/m, damping: 200 kN s/m}\n";
  const LiftRun built_in = run_without_modes(lift_with_operation(
      test::with(operation, "WISH", "level: C1.right, with: C1.left, correction: 4 s"), ground));
  LiftCase lift_case = lift_with_operation(
      test::with(operation, "WISH",
                 "law: level, sees: {height: {level: C1.right, with: C1.left}, pull: {tension: R1},"
                 " part: {share: C1.left, of: [C1.right]}}"),
      ground);
  EXPECT_THAT([&] { run_without_modes(lift_case); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("case.yaml:"), HasSubstr("nobody gives the law \"level\""))));
  int begun = 0;
  lift_case.laws["level"] = [&](const std::vector<std::string>& figures) -> dynamics::SpeedLaw {
    EXPECT_THAT(figures, ::testing::ElementsAre("position", "speed", "height", "pull", "part"));
    ++begun;
    return [](double time, std::span<const double> seen) {
      if (time == 0) {
        EXPECT_NEAR(seen[0], 5.0, 1e-9);
        EXPECT_NEAR(seen[1], 0.0, 1e-9);
        EXPECT_GT(seen[3], 10e3);
        EXPECT_NEAR(seen[4], 0.5, 0.1);
      }
      return seen[2] / 4;
    };
  };
  const LiftRun own = run_without_modes(lift_case);
  EXPECT_GE(begun, 2);
  const Eigen::VectorXd& theirs = built_in.dynamic_history().rope("C1.right").unstretched_length;
  const Eigen::VectorXd& ours = own.dynamic_history().rope("C1.right").unstretched_length;
  ASSERT_EQ(ours.size(), theirs.size());
  EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 1e-9);
  for (const LiftMeasure& measure : find_measures(lift_case, own))
    EXPECT_THAT(measure.name(), ::testing::Not(HasSubstr("missed")));
}

TEST(Keeping, RefusesWhatCannotBe) {
  const auto refuses = [](const std::string& move, const std::string& message) {
    EXPECT_THAT([&] { lift_with_operation("  - stage: go\n    moves: [" + move + "]\n"); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("case.yaml:"), HasSubstr(message))))
        << move;
  };
  refuses("{drives: [C1.left], keeps: {level: C1.left}}", "nothing says how long");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {reaction: 1 s}}",
          "does not say what is kept");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {level: C1.left, tension: 5 kN}}",
          "two things");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {level: C1.middle}}",
          "keeps the height of \"C1.middle\"");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {level: L3}}", "lug \"L3\"");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {share: 50 %}}", "share goes with of");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {share: 50 %, of: [R9]}}", "\"R9\"");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {share: 50 %, of: [C1.left]}}", "with itself");
  refuses("{drives: [C1.traverse], duration: 9 s, keeps: {tension: 5 kN}}", "is no winch");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {head: C1.left, over: L1}}", "is a winch");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {tension: 5 kN, tolerance: 1 m}}",
          "the tolerance is");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {tension: 5 kN, reaction: 4 s}}",
          "further and further");
  refuses("{drives: [C1.left], by: 1 m, keeps: {tension: 5 kN}}", "takes no \"by\"");
  const auto law_refuses = [&](const std::string& drive, const std::string& more,
                               const std::string& message) {
    refuses("{drives: [" + drive + "], duration: 9 s, keeps: {law: own, " + more + "}}", message);
  };
  law_refuses("C1.left", "tension: 5 kN", "two things");
  law_refuses("C1.left", "correction: 2 s", "no correction");
  law_refuses("C1.left", "sees: {height: {}}", "nothing is seen");
  law_refuses("C1.left", "sees: {height: {level: L1, tension: R1}}", "two things are seen");
  law_refuses("C1.left", "sees: {height: {level: L9}}", "a law that sees the height of lug \"L9\"");
  law_refuses("C1.left", "sees: {pull: {tension: R11}}", "did you mean \"R1\"");
  law_refuses("C1.left", "sees: {pull: {share: R1}}", "share goes with of");
  law_refuses("C1.left", "sees: {pull: {share: R1, of: [R1]}}", "with itself");
  law_refuses("C1.left", "sees: {swing: {head: C1.left, over: L1}}", "is a winch");
  law_refuses("C1.left", "sees: {speed: {tension: R1}}", "of its own drive anyway");
  law_refuses("C1.lft", "every: 0.1 s", "did you mean \"C1.left\"");
  law_refuses("C1.left", "every: 5 s", "every");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {level: C1.left, every: 1 s}}",
          "every goes with law");
  refuses("{drives: [C1.left], by: 1 m}, {drives: [C1.left], keeps: {tension: 5 kN}}",
          "overlaps itself");
  refuses("{drives: [C1.left], duration: 9 s, keeps: {tension: 5 kN}, speed: 60 m/min}",
          "more than C1.left can do");
}

// ---- Faults at their worst instant -----------------------------------------------------------

const std::string hoist =
    "  - stage: lower\n"
    "    moves: [{drives: [C1.left, C1.right], by: 1.5 m, speed: 6 m/min}]\n"
    "  - stage: carry\n"
    "    moves: [{drives: [C1.travel], by: 10 m}]\n";

// Of a load that is lowered the worst stop is one at full speed, and its figure is that of the case
// in which the fault comes at that instant. Other instants are hardly worse.
TEST(WorstInstant, IsFoundWhereAStopHurts) {
  const LiftCase sought = lift_with_operation(
      hoist, "faults: [{worst_for: [all], stops: [all], within: 0.3 s, watched: 5 s}]\n");
  const BuiltLift model = prepare_lift(sought, sample_mass(), [](auto&&...) {});
  ASSERT_TRUE(model.worst);
  const WorstInstant& worst = *model.worst;
  EXPECT_GT(worst.trials.size(), 60u);
  EXPECT_GT(worst.worst.share, worst.undisturbed.share);
  const double lowered = model.schedule.stages[0].end;
  EXPECT_LT(worst.worst.time, lowered);
  const auto share_at = [&](double time) {
    const LiftCase given = lift_with_operation(
        hoist, "faults: [{at: " + std::to_string(time) + " s, stops: [all], within: 0.3 s}]\n");
    const LiftRun lift = run_without_modes(given);
    double largest = 0;
    for (const char* rope : {"R1", "R2", "C1.left", "C1.right"}) {
      const auto& tension = lift.dynamic_history().rope(rope).tension;
      for (Eigen::Index i = 0; i < tension.size(); ++i)
        if (lift.dynamic_history().time[i] > time)
          largest = std::max(largest, tension[i] / (*rope == 'R' || rope[3] == 'l' ? 1e6 : 980665));
    }
    return largest;
  };
  EXPECT_NEAR(share_at(worst.worst.time), worst.worst.share, 1e-4 * worst.worst.share);
  for (double time = 0.35; time < lowered; time += 1.15)
    EXPECT_LT(share_at(time), 1.02 * worst.worst.share) << time;
  // The run itself has the fault.
  EXPECT_EQ(model.system.operation().winches()[0].length.evaluate(lowered).velocity, 0.0);
}

// Between limits of time it is found between them.
TEST(WorstInstant, IsSoughtBetweenLimits) {
  const BuiltLift model = prepare_lift(
      lift_with_operation(
          hoist, "faults: [{worst_for: [R1, C1.left], stops: [C1.left], from: 8 s, to: 10 s}]\n"),
      sample_mass(), [](auto&&...) {});
  ASSERT_TRUE(model.worst);
  for (const WorstInstant::Trial& trial : model.worst->trials) {
    EXPECT_GE(trial.time, 8.0);
    EXPECT_LE(trial.time, 10.0);
    EXPECT_THAT(trial.rope, ::testing::AnyOf("R1", "C1.left"));
  }
  // In the time to settle nothing moves.
  EXPECT_THAT(
      [&] {
        prepare_lift(
            lift_with_operation(hoist, "faults: [{worst_for: [all], stops: [all], from: 46 s}]\n"),
            sample_mass(), [](auto&&...) {});
      },
      ThrowsMessage<dynamics::SimulationError>(HasSubstr("nothing moves")));
}

TEST(WorstInstant, RefusesWhatCannotBe) {
  const auto refuses = [](const std::string& fault, const std::string& message) {
    EXPECT_THAT([&] { lift_with_operation(hoist, "faults: [" + fault + "]\n"); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("case.yaml:"), HasSubstr(message))))
        << fault;
  };
  refuses("{stops: [all]}", "does not say when");
  refuses("{at: 3 s, worst_for: [all], stops: [all]}", "both an instant and worst_for");
  refuses("{at: 3 s, from: 1 s, stops: [all]}", "go with worst_for");
  refuses("{worst_for: [R7], stops: [all]}", "\"R7\"");
  refuses("{worst_for: [all], stops: [all], from: 9 s, to: 3 s}", "before it is sought");
  refuses("{worst_for: [all], stops: [C1.left]}, {worst_for: [all], parts: [R1]}",
          "one fault at a time");
}

}  // namespace
}  // namespace blocklift::pipeline
