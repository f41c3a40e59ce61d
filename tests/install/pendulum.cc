// A load on one rope swings by its installed kernel alone. Its period, counted over ten swings, is
// 2 pi sqrt(r/g), r the rope with its stretch; a swing of 0.01 rad is longer by theta^2/16 = 6e-6
// of it, what a sample of 1/100 s leaves of a straight line between samples is less.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "dynamics/simulation/time_integration.h"

using namespace blocklift::dynamics;

int main() {
  constexpr double g = 9.81, mass = 10e3, length = 20, axial_stiffness = 4e9;
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  const BodyIndex load =
      builder.add_body({.name = "load", .joint = {.kind = JointKind::translational}, .mass = mass});
  Mechanism mechanism = builder.build();
  std::vector<Rope> ropes;
  ropes.emplace_back(
      mechanism, RopeDefinition{.name = "rope",
                                .points = {{world_index, Vector3::Zero()}, {load, Vector3::Zero()}},
                                .axial_stiffness = axial_stiffness,
                                .unstretched_length = length});
  OperationBuilder operation;
  operation.add_winch("winch", 0, length);
  const double r = length * (1 + mass * g / axial_stiffness), angle = 0.01;
  const LiftSystem lift({.mechanism = std::move(mechanism),
                         .ropes = std::move(ropes),
                         .supports = {},
                         .elements = {},
                         .operation = operation.build(100),
                         .q_start = Vector3(r * std::sin(angle), 0, -r * std::cos(angle)),
                         .v_start = {}});
  const IntegrationResult run = integrate(lift, lift.q_start(), lift.v_start(),
                                          {.relative_tolerance = 1e-9, .sample_interval = 0.01});

  const Eigen::VectorXd x = run.history.body("load").pose.col(0);
  std::vector<double> crossings;
  for (Eigen::Index i = 1; i < x.size() && crossings.size() < 21; ++i)
    if (x[i - 1] * x[i] < 0)
      crossings.push_back(run.history.time[i - 1] + 0.01 * x[i - 1] / (x[i - 1] - x[i]));
  if (crossings.size() < 21) return std::puts("the load does not swing"), 1;
  const double period = (crossings[20] - crossings[0]) / 10;
  const double reference = 2 * std::numbers::pi * std::sqrt(r / g);
  std::printf("period %.6f s, reference %.6f s\n", period, reference);
  return std::abs(period / reference - 1) < 2e-5 ? 0 : 1;
}
