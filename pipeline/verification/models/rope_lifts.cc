#include "pipeline/verification/models/rope_lifts.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace blocklift::dynamics::examples {

Matrix3 box_inertia(double mass, double x, double y, double z) {
  return mass / 12.0 * Vector3(y * y + z * z, x * x + z * z, x * x + y * y).asDiagonal();
}

LiftSystem SingleRopeLift::build() const {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  const BodyIndex load =
      builder.add_body({.name = "load", .joint = {.kind = JointKind::translational}, .mass = mass});
  Mechanism mechanism = builder.build();
  RopeDefinition rope{.name = "rope",
                      .points = {{world_index, Vector3::Zero()}, {load, Vector3::Zero()}},
                      .crane_stiffness = crane_stiffness,
                      .damping_time = damping_time,
                      .unstretched_length = length};
  if (tension_points.empty())
    rope.axial_stiffness = axial_stiffness;
  else
    rope.tension_law = TensionLaw(tension_points);
  std::vector<Rope> ropes;
  ropes.emplace_back(mechanism, std::move(rope));
  OperationBuilder operation;
  operation.add_winch("winch", 0, length);
  if (payout != 0.0) operation.add_move("winch", {payout_start, payout, limits});
  const Operation built = operation.build(duration);
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = std::move(ropes),
                     .supports = {},
                     .elements = {},
                     .operation = built,
                     .q_start = Vector3(0, 0, -length),
                     .v_start = {}});
}

LiftSystem block_on_six_ropes() {
  constexpr double mass = 860e3;
  constexpr double axial_stiffness = 6e8;
  constexpr double length = 30.0;
  constexpr double stretch = mass * g / (6.0 * axial_stiffness / length);
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  const BodyIndex block = builder.add_body({.name = "block",
                                            .joint = {.kind = JointKind::free},
                                            .mass = mass,
                                            .I_BBcm_B = box_inertia(mass, 24, 16, 10)});
  Mechanism mechanism = builder.build();
  // 1 % of critical damping in heave, shared by the six ropes.
  const double damping = 0.01 * 2.0 * std::sqrt(6.0 * axial_stiffness / length * mass) / 6.0;
  std::vector<Rope> ropes;
  OperationBuilder operation;
  for (const double x : {-10.0, 0.0, 10.0}) {
    for (const double y : {-6.0, 6.0}) {
      const int index = static_cast<int>(ropes.size());
      const std::string name = "rope " + std::to_string(index + 1);
      ropes.emplace_back(mechanism,
                         RopeDefinition{.name = name,
                                        .points = {{world_index, {x, y, 5.0 + length + stretch}},
                                                   {block, {x, y, 5.0}}},
                                        .axial_stiffness = axial_stiffness,
                                        .damping = damping,
                                        .unstretched_length = length});
      operation.add_winch(name, index, length);
      // 118 s at 0.05 m/s: 116 s of cruise and two ramps of 2 s.
      operation.add_move(name, {0.0, -0.05 * 118.0, {0.05, 0.025, 0.025e7}});
    }
  }
  const Operation built = operation.build(120.0);
  Eigen::VectorXd v_start(6);
  v_start << 0, 0, 0.002, 0.1, -0.05, 0;
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = std::move(ropes),
                     .supports = {},
                     .elements = {},
                     .operation = built,
                     .q_start = (Eigen::VectorXd(7) << 0, 0, 0, 1, 0, 0, 0).finished(),
                     .v_start = v_start});
}

}  // namespace blocklift::dynamics::examples
