#include "pipeline/build/history_memory.h"

#include <limits>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/history.h"
#include "structure/limits.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

/// Values in all columns of a history.
Eigen::Index values_of(const dynamics::History& history) {
  Eigen::Index values = history.time.size();
  for (const dynamics::BodyHistory& body : history.bodies)
    values += body.pose.size() + body.velocity.size() + body.acceleration.size() + body.load.size();
  for (const dynamics::RopeHistory& rope : history.ropes)
    values += rope.tension.size() + rope.elongation.size() + rope.unstretched_length.size() +
              rope.unstretched_rate.size() + rope.first_force.size() + rope.last_force.size();
  for (const dynamics::RopeHistory& rope : history.ropes)
    for (const dynamics::EdgeHistory& edge : rope.edges)
      values += edge.force.size() + edge.wrap.size() + edge.first_angle.size() +
                edge.last_angle.size() + edge.first_place.size() + edge.last_place.size() +
                edge.first_tension.size() + edge.last_tension.size();
  for (const dynamics::DriveHistory& drive : history.drives)
    values += drive.position.size() + drive.velocity.size() + drive.force.size();
  for (const dynamics::SupportHistory& pad : history.supports) values += pad.normal_force.size();
  for (const dynamics::LoopHistory& loop : history.loops)
    values += loop.force.size() + loop.multipliers.size() + loop.residual.size();
  const dynamics::EnergyHistory& energy = history.energy;
  for (const auto* column : {&energy.kinetic, &energy.gravity, &energy.elastic, &energy.drive_work,
                             &energy.winch_work, &energy.outside_work, &energy.dissipated})
    values += column->size();
  return values;
}

class HistoryMemory : public ::testing::Test {
 protected:
  HistoryMemory() {
    test::SampleLift().write(folder_);
    lift_case_ = read_lift_case("case.yaml");
    LoadMass load;
    load.mass = 10e3;
    load.p_BoBcm_B = {2, 0, 0.5};
    load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
    lift_.emplace(build_lift(lift_case_, load));
  }
  ~HistoryMemory() override { structure::limit_memory(std::numeric_limits<double>::infinity()); }

  test::TemporaryFolder folder_;
  LiftCase lift_case_;
  std::optional<BuiltLift> lift_;
};

TEST_F(HistoryMemory, IsThatOfTheHistoriesColumns) {
  constexpr int samples = 10;
  for (const bool with_works : {false, true}) {
    const dynamics::History history(lift_->system, samples, with_works);
    // A history keeps one column more for itself, and the run its times.
    EXPECT_EQ(static_cast<double>(8 * (values_of(history) + 2 * samples)),
              samples * bytes_of_sample(lift_->system, with_works));
  }
  const double duration = lift_->system.operation().duration();
  for (const double interval : {0.05, 0.07, 1.0})
    EXPECT_EQ(sample_count({&lift_->system, interval}),
              static_cast<double>(dynamics::sample_times(duration, interval).size()));
  const auto ropes = static_cast<double>(lift_->system.ropes().size());
  EXPECT_EQ(sample_count({&lift_->system, 1.0, "", true, true}),
            sample_count({&lift_->system, 1.0, "", true}) + ropes);
}

TEST_F(HistoryMemory, IsRefusedWithFiguresWhereItIsTooMuch) {
  EXPECT_NO_THROW(require_memory(lift_case_, *lift_));
  structure::limit_memory(20e9);
  lift_case_.dynamics.sample_interval = lift_->system.operation().duration() / 1e9;
  try {
    require_memory(lift_case_, *lift_);
    FAIL() << "1,000,000,001 samples do not fit in 20 GB";
  } catch (const dynamics::SimulationError& error) {
    EXPECT_THAT(error.what(), HasSubstr(std::to_string(1000000001 + lift_->system.ropes().size()) +
                                        " samples every "));
    EXPECT_THAT(error.what(),
                HasSubstr(" GB may be used: sample less often by "
                          "`dynamics.static_interval` or `dynamics.sample_interval`"));
  }
}

}  // namespace
}  // namespace blocklift::pipeline
