// The block's elasticity felt by the ropes of a lift.
#include "pipeline/coupling/block_flexibility.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "dynamics/simulation/equilibrium.h"
#include "pipeline/lift/block_assessment.h"
#include "pipeline/lift/lift_run.h"
#include "pipeline/lift/natural_modes.h"
#include "pipeline/results/files/lift_scene.h"
#include "tests/pipeline/small_lift.h"

namespace blocklift::pipeline {
namespace {

const structure::UnitResponses& responses() {
  static const structure::UnitResponses all(*test::small_lift().model);
  return all;
}

LiftCase lift_case(Flexibility flexibility) {
  LiftCase result = test::read_small_lift();
  result.dynamics.flexibility = flexibility;
  result.dynamics.elastic_modes = {4, {}};
  return result;
}

BuiltLift build(Flexibility kind, double factor = 1) {
  const LiftCase the_case = lift_case(kind);
  std::optional<LoadFlexibility> flexibility = make_flexibility(responses(), the_case.dynamics);
  if (flexibility) flexibility->compliance *= factor;
  return build_lift(the_case, load_mass(test::small_lift().mass()), nullptr,
                    flexibility ? &*flexibility : nullptr);
}

Eigen::VectorXd tensions(const BuiltLift& lift) {
  Eigen::VectorXd q = lift.system.q_start();
  dynamics::EquilibriumSolver(lift.system).solve(0, q);
  dynamics::LiftWorkspace w(lift.system);
  w.q = q;
  w.v.setZero();
  dynamics::set_drives(lift.system, 0, false, w);
  dynamics::calc_loads(lift.system, 0, nullptr, w);
  Eigen::VectorXd result(static_cast<Eigen::Index>(lift.ropes.size()));
  for (std::size_t i = 0; i < lift.ropes.size(); ++i)
    result[i] = w.rope_loads[lift.ropes[i].rope].tension;
  return result;
}

TEST(BlockFlexibility, RigidCasesHaveNone) {
  EXPECT_FALSE(make_flexibility(responses(), lift_case(Flexibility::rigid).dynamics));
  EXPECT_TRUE(build(Flexibility::rigid).system.elastic_bodies().empty());
}

TEST(BlockFlexibility, AStifferBlockComesToTheRigidOne) {
  const Eigen::VectorXd rigid = tensions(build(Flexibility::rigid));
  const auto difference = [&](double factor) {
    return (tensions(build(Flexibility::static_, factor)) - rigid).norm() / rigid.norm();
  };
  // The difference is of the first order in the compliance; the tensions of four slings follow from
  // statics but for small angles and one degree, so that of ten times the compliance is still
  // small.
  EXPECT_NEAR(difference(1) / difference(10), 0.1, 0.01);
  EXPECT_LT(difference(1e-3), 1e-6);
}

TEST(BlockFlexibility, ModesAtRestAreTheStaticCompliance) {
  const BuiltLift modal = build(Flexibility::modal);
  const dynamics::Mechanism& mechanism = modal.system.mechanism();
  EXPECT_EQ(mechanism.body_count(), build(Flexibility::rigid).system.mechanism().body_count());
  ASSERT_EQ(mechanism.elastic_modes().size(), 4U);
  EXPECT_EQ(mechanism.elastic_modes()[3].name, "load.mode_4");
  EXPECT_EQ(mechanism.elastic_modes()[3].body, modal.load);
  const Eigen::VectorXd still = tensions(build(Flexibility::static_));
  EXPECT_LT((tensions(modal) - still).norm(), 1e-5 * still.norm());
}

// Vibration of the block counts as the load's motion, and is told by the mode that has most of it.
TEST(BlockFlexibility, NaturalModesTellOfVibration) {
  const LiftRun run = run_lift(
      lift_case(Flexibility::modal), build(Flexibility::modal), [](auto&&...) {},
      RunExtent{.energy = false});
  EXPECT_EQ(run.dynamic_history().elastic_modes.size(), 4U);
  EXPECT_GT(run.dynamic_history().elastic_mode("load.mode_1").coordinate.norm(), 0);
  const nlohmann::ordered_json list =
      natural_periods_json(run.model.system.mechanism(), run.natural_modes)[0]["modes"];
  int found = 0;
  for (const nlohmann::ordered_json& mode : list) {
    const auto name = mode["name"].get<std::string>();
    if (!name.starts_with("load: vibration in load.mode_")) continue;
    ++found;
    double vibration = 0;
    for (const auto& [which, share] : mode["energy_share_by_elastic_mode"].items())
      vibration += share.get<double>();
    EXPECT_GT(vibration, 0.3) << name;
    EXPECT_GE(mode["energy_share_by_body"]["load"].get<double>(), vibration - 0.005) << name;
  }
  EXPECT_GE(found, 2);
}

// The two stages agree on the balance of the block in each state, or assess_block throws.
TEST(BlockFlexibility, LoadsOnAFlexibleBlockBalance) {
  for (const Flexibility kind : {Flexibility::static_, Flexibility::modal}) {
    const LiftRun run = run_lift(lift_case(kind), build(kind), [](auto&&...) {});
    const BlockAttachment attachment = attach_block(run.model, test::small_lift().lugs());
    const structure::StressRecovery recovery(responses());
    const BlockAssessment block =
        assess_block(responses(), recovery, attachment, run.static_history, run.dynamic_history());
    EXPECT_GT(block.simultaneous.dynamic_state.result.checked_von_mises.value, 0);
    const Eigen::VectorXd& kept = run.dynamic_history().energy.elastic;
    EXPECT_GT(kept.minCoeff(), 0);
  }
}

}  // namespace
}  // namespace blocklift::pipeline
