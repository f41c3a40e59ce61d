// A rope over a sharp edge of a body that moves along it: where friction would hold the rope.
#include "pipeline/measures/edge_sliding.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/simulation/equilibrium.h"

namespace blocklift::pipeline {
namespace {

constexpr double friction = 0.2;
// From the edge to the ends, across it.
const Eigen::Vector2d to_anchor(-4, 0.5), to_lug(0.1, -3);

/// A load that is moved along its edge, with a rope from an anchor over the edge to a point of it.
dynamics::LiftSystem sliding_load() {
  dynamics::MechanismBuilder builder;
  const auto load =
      builder.add_body({.name = "load",
                        .joint = {.kind = dynamics::JointKind::prismatic, .axis = Vector3::UnitY()},
                        .mass = 1.0,
                        .driven = {true}});
  const auto beside =
      builder.add_body({.name = "beside",
                        .joint = {.kind = dynamics::JointKind::prismatic, .axis = Vector3::UnitZ()},
                        .mass = 1.0});
  const dynamics::Mechanism mechanism = builder.build();
  dynamics::RopeDefinition rope{
      .name = "R1",
      .points = {{dynamics::world_index, {to_anchor.x(), 0, to_anchor.y()}},
                 {load, {to_lug.x(), 0, to_lug.y()}}},
      .axial_stiffness = 1e6,
      .unstretched_length = 6.0,
      .edges = {{.name = "sill",
                 .body = load,
                 .begin_B = {0, -10, 0},
                 .end_B = {0, 10, 0},
                 .outside_B = {1, 0, 1},
                 .friction = friction}}};
  dynamics::ForceElements elements;
  std::get<std::vector<dynamics::JointSpring>>(elements).emplace_back(
      mechanism, dynamics::JointSpring::Definition{
                     .name = "s", .body = beside, .stiffness = 1.0, .free_coordinate = 0.0});
  dynamics::OperationBuilder operation;
  operation.add_joint_drive(mechanism, "drive", load, 0.0);
  operation.add_move("drive", {0.0, 3.0, {1.0, 10.0, 100.0}});
  return dynamics::LiftSystem({.mechanism = mechanism,
                               .ropes = {dynamics::Rope(mechanism, rope)},
                               .elements = elements,
                               .operation = operation.build(4.0),
                               .q_start = Eigen::Vector2d::Zero()});
}

/// |F_along| / |F_across| with the load moved by q and the rope over the edge at y = s of the load.
double pull_by_hand(double q, double s) {
  const double before = std::hypot(to_anchor.norm(), q + s), behind = std::hypot(to_lug.norm(), s);
  const double along = -s / behind - (q + s) / before;
  return std::abs(along) / (to_lug / behind + to_anchor / before).norm();
}

TEST(EdgeSliding, FrictionHoldsUntilItGivesWay) {
  const dynamics::LiftSystem system = sliding_load();
  const dynamics::History history =
      dynamics::static_sweep(system, dynamics::sample_times(4.0, 0.1), Eigen::Vector2d::Zero());
  const SidewaysHold hold = hold_sideways(system.ropes()[0], history, 0, 0);
  const double d1 = to_anchor.norm(), d2 = to_lug.norm();
  double held = 0;
  bool slid = false;
  for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
    const double q = history.bodies[0].pose(i, 1);
    const double pull = pull_by_hand(q, held);
    EXPECT_NEAR(std::abs(hold.pull[i]), pull, 1e-9);
    if (pull > friction) {
      slid = true;
      held = hold.place[i] - 10;
      EXPECT_NEAR(pull_by_hand(q, held), friction, 1e-9);
    }
    EXPECT_NEAR(hold.place[i], 10 + held, 1e-9);
    // The computation has the shortest line, straight when it is unrolled.
    EXPECT_NEAR(hold.slid[i], -q * d2 / (d1 + d2) - held, 1e-9);
  }
  EXPECT_TRUE(slid);
  EXPECT_LT(pull_by_hand(0.5, 0), friction);
}

}  // namespace
}  // namespace blocklift::pipeline
