// Ground that bears the load, and stages that end by a condition.
#include "pipeline/lift/stage_end.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "pipeline/lift/stage_loads.h"
#include "tests/pipeline/lift/operated_lift.h"

namespace blocklift::pipeline {
namespace {

using test::run_sample;
using test::sample_mass;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double g = 9.81;
constexpr double weight = 10e3 * g;
constexpr double corner_stiffness = 5e6;  // N/m

const std::string ground =
    "ground: 0 m\n"
    "ground_contact: {stiffness: 5 MN/m, damping: 200 kN s/m}\n";

/// The sample lift with another operation. Its load hangs 1.8 m above the ground at first.
LiftCase lift_above_ground(const std::string& operation, const std::string& more = ground) {
  return test::lift_with_operation(operation, more);
}

const std::string lower_beyond =
    "  - stage: carry\n"
    "    moves: [{drives: [C1.travel], by: 10 m}]\n"
    "  - stage: lower\n"
    "    moves: [{drives: [C1.left, C1.right], by: 2.5 m}]\n";

double pads(const dynamics::History& history, Eigen::Index sample) {
  double sum = 0;
  for (const dynamics::SupportHistory& pad : history.supports) sum += pad.normal_force[sample];
  return sum;
}

double work_of(const Eigen::VectorXd& works) { return works[works.size() - 1] - works[0]; }

// Lowered 0.7 m beyond the ground it stands there, where it was set down, on four of its corners:
// each sinks in by a quarter of its weight over its stiffness. What drives and winches gave and
// damping and friction took is what the energies differ by.
TEST(GroundContact, BearsTheLoadWhereItIsSetDown) {
  const LiftRun lift = run_sample(lift_above_ground(lower_beyond));
  for (const dynamics::History* history : {&lift.static_history, &lift.dynamic_history()}) {
    const Eigen::Index last = history->sample_count() - 1;
    const Vector3 p = history->body("load").X_WB(last).p;
    EXPECT_NEAR(p.z(), -weight / (4 * corner_stiffness), 2e-4);
    // In motion it swings while it comes down.
    EXPECT_NEAR(p.x(), -2 + 10, history == &lift.static_history ? 0.01 : 0.15);
    EXPECT_NEAR(pads(*history, last), weight, 1e-3 * weight);
    EXPECT_EQ(pads(*history, 0), 0);
    EXPECT_EQ(history->rope("R1").tension[last], 0);
  }
  const dynamics::EnergyHistory& energy = lift.dynamic_history().energy;
  const Eigen::VectorXd sum = energy.kinetic + energy.gravity + energy.elastic;
  EXPECT_NEAR(work_of(sum),
              work_of(energy.drive_work) + work_of(energy.winch_work) +
                  work_of(energy.outside_work) - work_of(energy.dissipated),
              2e-3 * weight);
}

// What has slid stays where it came to rest: nothing pulls it back to where it was set down.
// Nothing but friction holds it: it is dragged when the crane goes on, and by no more than
// friction.
TEST(GroundContact, ATautSlingDragsTheLoad) {
  const LiftRun lift =
      run_sample(lift_above_ground("  - stage: set down\n"
                                   "    moves: [{drives: [C1.left, C1.right], by: 1.82 m}]\n"
                                   "  - stage: drag\n"
                                   "    moves: [{drives: [C1.travel], by: 20 m}]\n"));
  const dynamics::History& history = lift.dynamic_history();
  const double travelled = history.body("load").X_WB(history.sample_count() - 1).p.x() + 2;
  EXPECT_GT(travelled, 15);
  EXPECT_LT(travelled, 20.5);
}

TEST(GroundContact, NeedsAStiffnessAndAHeight) {
  EXPECT_THAT([] { lift_above_ground(lower_beyond, "ground_contact: {damping: 1 kN s/m}\n"); },
              ThrowsMessage<InputError>(HasSubstr("stiffness")));
  EXPECT_THAT(
      [] { lift_above_ground(lower_beyond, "ground_contact: {stiffness: 5 MN/m}\nsea: {}\n"); },
      ThrowsMessage<InputError>(HasSubstr("its height is not known")));
}

std::string lower_until(const std::string& condition) {
  return "  - stage: lower\n"
         "    moves: [{drives: [C1.left, C1.right], by: 2.5 m, speed: 3 m/min}]\n"
         "    until: " +
         condition +
         "\n"
         "  - stage: hoist\n"
         "    moves: [{drives: [C1.left, C1.right], to: 5 m}]\n";
}

// The winches turn until the slings go slack, stop within a second, and hoist back to where they
// were. Both histories follow the same operation.
TEST(StageEnd, ComesWhenTheSlingsGoSlack) {
  const LiftCase lift_case = lift_above_ground(lower_until("{slack: R1}"));
  const LiftRun lift = run_sample(lift_case);
  const std::vector<StageLoads> stages = find_stage_loads(lift);
  ASSERT_TRUE(stages[0].met);
  EXPECT_FALSE(stages[1].met);
  const double met = *stages[0].met;
  EXPECT_GT(stages[0].end, met);
  EXPECT_LT(stages[0].end, met + 1);
  // Nearly all that the tackles stretch by and the corners sink in is let out besides 1.8 m.
  const dynamics::History& history = lift.dynamic_history();
  for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
    if (history.time[i] < met) {
      EXPECT_GT(history.rope("R1").tension[i], 0) << history.time[i];
    }
  }
  double first_slack = 0;
  for (const dynamics::ContactEvent& event : lift.dynamic_result.events) {
    if (event.acts || event.contact != lift.model.system.rope_index("R1")) continue;
    first_slack = event.time;
    break;
  }
  EXPECT_NEAR(first_slack, met, 1e-3);
  const double let_out = history.ropes[0].unstretched_length.maxCoeff() - 5;
  EXPECT_GT(let_out, 1.8);
  EXPECT_LT(let_out, 1.8 + 0.2);
  const Eigen::Index last = history.sample_count() - 1;
  EXPECT_NEAR(history.ropes[0].unstretched_length[last], 5, 1e-9);
  EXPECT_NEAR(lift.static_history.ropes[0].unstretched_length.maxCoeff() - 5, let_out, 1e-2);
  EXPECT_NEAR(history.rope("R1").tension[last], weight / 2, 0.02 * weight);
}

// Four fifths of the weight are off while the ropes still bear the fifth.
TEST(StageEnd, ComesWhenAShareOfTheWeightIsOff) {
  for (const char* condition : {"{ropes_bear_at_most: 20 %}", "{ground_bears_at_least: 80 %}"}) {
    const LiftCase lift_case = lift_above_ground(lower_until(condition));
    const BuiltLift model = build_lift(lift_case, sample_mass());
    ASSERT_EQ(model.schedule.waiting_stage(), 0U);
    const double met = find_stage_end(lift_case, model, 0, [](auto&&...) {});
    const LiftRun lift = run_sample(lift_case);
    EXPECT_EQ(lift.model.schedule.stages[0].stop->met, met);
    const dynamics::History& history = lift.dynamic_history();
    Eigen::Index sample = 0;
    (history.time.array() - met).abs().minCoeff(&sample);
    // Samples are a twentieth of a second apart, in which the winches let out 2.5 mm.
    const double by_ropes =
        history.rope("R1").last_force(sample, 2) + history.rope("R2").last_force(sample, 2);
    EXPECT_NEAR(by_ropes, 0.2 * weight, 0.15 * weight) << condition;
  }
}

// With a reaction of two seconds the winches let out more, by the speed times that.
TEST(StageEnd, ComesLaterByTheReaction) {
  const auto let_out = [](const std::string& condition) {
    const BuiltLift model =
        prepare_lift(lift_above_ground(lower_until(condition)), sample_mass(), [](auto&&...) {});
    return model.system.operation()
        .winches()[0]
        .length.evaluate(model.schedule.stages[0].end)
        .position;
  };
  const double difference = let_out("{slack: R1, reaction: 2 s}") - let_out("{slack: R1}");
  EXPECT_NEAR(difference, 2 * 3.0 / 60, 1e-6);
}

TEST(StageEnd, FailsWhereTheConditionDoesNotComeAbout) {
  const LiftCase lift_case = lift_above_ground(lower_until("{slack: R1, within: 20 s}"));
  EXPECT_THAT([&] { prepare_lift(lift_case, sample_mass(), [](auto&&...) {}); },
              ThrowsMessage<dynamics::SimulationError>(
                  AllOf(HasSubstr("\"lower\" waits for R1 to go slack"), HasSubstr("20 s"))));
}

TEST(StageEnd, RefusesWhatCannotBe) {
  const auto refuses = [](const std::string& condition, const std::string& more,
                          const std::string& message) {
    EXPECT_THAT([&] { lift_above_ground(lower_until(condition), more); },
                ThrowsMessage<InputError>(HasSubstr(message)))
        << condition;
  };
  refuses("{slack: R3}", ground, "\"R3\", which is no rope");
  refuses("{within: 3 s}", ground, "does not say what ends it");
  refuses("{slack: R1, taut: R2}", ground, "several conditions");
  refuses("{ground_bears_at_least: 80 %}", "", "nothing is there");
}

}  // namespace
}  // namespace blocklift::pipeline
