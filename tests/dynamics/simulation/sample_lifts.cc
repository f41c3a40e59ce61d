#include "tests/dynamics/simulation/sample_lifts.h"

#include <array>
#include <cmath>

namespace blocklift::dynamics::test {

namespace {

/// One goliath crane's bodies, added to a mechanism at the place x along the runway.
struct Goliath {
  Goliath(MechanismBuilder& builder, const std::string& name, double x);

  std::string name;
  BodyIndex gantry, upper_trolley, lower_trolley;
  std::array<BodyIndex, 3> hooks;  ///< upper 1, upper 2, lower
  /// Sheave of each hoist in its trolley's frame.
  static constexpr std::array<double, 3> sheave_x = {-3.0, 3.0, 0.0};
  BodyIndex trolley(std::size_t hoist) const { return hoist < 2 ? upper_trolley : lower_trolley; }
  std::string hoist_name(std::size_t hoist) const {
    constexpr std::array<const char*, 3> names = {"upper_1", "upper_2", "lower"};
    return name + "." + names[hoist];
  }
};

Goliath::Goliath(MechanismBuilder& builder, const std::string& crane, double x) : name(crane) {
  const auto driven_body = [&](const std::string& body, const std::string& parent, double mass,
                               const Vector3& axis, const Vector3& position) {
    return builder.add_body({.name = name + "." + body,
                             .parent = parent,
                             .joint = {.kind = JointKind::prismatic, .axis = axis},
                             .X_PJ = Pose::translation(position),
                             .mass = mass,
                             .I_BBcm_B = examples::box_inertia(mass, 10, 10, 10),
                             .driven = {true}});
  };
  const std::string gantry_name = name + ".gantry";
  gantry = driven_body("gantry", "world", 2900e3, Vector3::UnitX(), {x, 0, 0});
  upper_trolley = driven_body("upper_trolley", gantry_name, 160e3, Vector3::UnitY(), {0, 0, 86});
  lower_trolley = driven_body("lower_trolley", gantry_name, 110e3, Vector3::UnitY(), {0, 0, 74});
  for (std::size_t i = 0; i < 3; ++i) {
    hooks[i] = builder.add_body({.name = hoist_name(i) + ".hook",
                                 .parent = name + (i < 2 ? ".upper_trolley" : ".lower_trolley"),
                                 .joint = {.kind = JointKind::translational},
                                 .mass = 8e3});
  }
}

constexpr double upper_y = 41.0;
constexpr double lower_y = 59.0;
constexpr double sling_length = 9.0;

/// Drives, winches, hoist ropes and slings of a crane.
void add_ropes(const Mechanism& mechanism, const Goliath& crane, BodyIndex block, double crane_x,
               std::vector<Rope>& ropes, OperationBuilder& operation, Eigen::VectorXd& q) {
  operation.add_joint_drive(mechanism, crane.name + ".travel", crane.gantry, 0.0);
  operation.add_joint_drive(mechanism, crane.name + ".upper_traverse", crane.upper_trolley,
                            upper_y);
  operation.add_joint_drive(mechanism, crane.name + ".lower_traverse", crane.lower_trolley,
                            lower_y);
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = i < 2 ? 64.5 : 52.5;
    const Vector3 sheave(Goliath::sheave_x[i], 0.0, -1.0);
    operation.add_winch(crane.hoist_name(i), static_cast<int>(ropes.size()), length);
    ropes.emplace_back(mechanism, RopeDefinition{.name = crane.hoist_name(i),
                                                 .points = {{crane.trolley(i), sheave},
                                                            {crane.hooks[i], Vector3::Zero()}},
                                                 .axial_stiffness = 800e6,
                                                 .crane_stiffness = 60e6,
                                                 .damping_time = 5e-3,
                                                 .unstretched_length = length});
    const Vector3 lug(16.0 + crane_x + Goliath::sheave_x[i], i < 2 ? 1.0 : 19.0, 8.5);
    ropes.emplace_back(mechanism, RopeDefinition{.name = "sling " + crane.hoist_name(i),
                                                 .points = {{crane.hooks[i], Vector3::Zero()},
                                                            {block, lug - Vector3(15.2, 9.8, 3.9)}},
                                                 .axial_stiffness = 400e6,
                                                 .damping_time = 5e-3,
                                                 .unstretched_length = sling_length});
    q.segment<3>(mechanism.body(crane.hooks[i]).q_offset) = sheave - Vector3(0, 0, length);
  }
}

Operation turn_over(OperationBuilder& operation) {
  const MotionLimits winch{0.05, 0.05, 0.1};
  const MotionLimits travel{0.5, 0.1, 0.2};
  double t = 10.0;
  const auto move_all = [&](std::initializer_list<const char*> drives, double by,
                            const MotionLimits& limits, const char* stage) {
    const double start = t;
    for (const char* drive : drives) {
      const RestToRestMove move(start, by, limits);
      operation.add_move(drive, move);
      t = move.end();
    }
    operation.add_stage(stage, start, t);
  };
  const auto hoists = {"C1.upper_1", "C1.upper_2", "C1.lower",
                       "C2.upper_1", "C2.upper_2", "C2.lower"};
  move_all(hoists, -12.0, winch, "hoist up");
  t += 10.0;
  move_all({"C1.travel", "C2.travel"}, 60.0, travel, "travel");
  t += 10.0;
  const double start = t;
  move_all({"C1.lower", "C2.lower"}, 16.0, winch, "turn over");
  // The lower trolleys come in as the block tilts: 18 m between the lugs stay 18 m.
  std::vector<double> paid_out, shift;
  for (double s = 0.0; s <= 16.0; s += 2.0) {
    paid_out.push_back(s);
    shift.push_back(std::sqrt(18.0 * 18.0 - s * s) - 18.0);
  }
  for (const std::string crane : {"C1", "C2"}) {
    operation.add_follower(crane + ".lower_traverse", crane + ".lower", start, t,
                           NaturalSpline(paid_out, shift));
  }
  t += 10.0;
  move_all(hoists, 6.0, winch, "hoist down");
  return operation.build(std::max(1000.0, t + 20.0));
}

}  // namespace

LiftSystem two_goliaths() {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -examples::g});
  const Goliath first(builder, "C1", -8.0);
  const Goliath second(builder, "C2", 8.0);
  const BodyIndex block = builder.add_body({.name = "block",
                                            .joint = {.kind = JointKind::free},
                                            .mass = 860e3,
                                            .I_BBcm_B = examples::box_inertia(860e3, 32, 20, 8)});
  Mechanism mechanism = builder.build();
  Eigen::VectorXd q = mechanism.zero_configuration();
  q.segment<3>(mechanism.body(block).q_offset) = Vector3(-16.0 + 15.2, 40.0 + 9.8, 3.0 + 3.9);
  std::vector<Rope> ropes;
  OperationBuilder operation;
  add_ropes(mechanism, first, block, -8.0, ropes, operation, q);
  add_ropes(mechanism, second, block, 8.0, ropes, operation, q);
  const Wind wind = Wind::level(8.0, 0.5);
  ForceElements elements;
  auto& areas = std::get<std::vector<WindArea>>(elements);
  for (const Goliath* crane : {&first, &second}) {
    for (std::size_t i = 0; i < 3; ++i) {
      areas.emplace_back(
          wind, WindArea::Definition{.name = crane->hoist_name(i),
                                     .centre_of_pressure = {crane->hooks[i], Vector3::Zero()},
                                     .area = 3.0,
                                     .coefficient = 1.2,
                                     .normal_B = {}});
    }
  }
  areas.emplace_back(wind, WindArea::Definition{.name = "block side",
                                                .centre_of_pressure = {block, Vector3::Zero()},
                                                .area = 256.0,
                                                .coefficient = 1.2,
                                                .normal_B = Vector3::UnitY()});
  const Operation built = turn_over(operation);
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = std::move(ropes),
                     .supports = {},
                     .elements = std::move(elements),
                     .operation = built,
                     .q_start = q,
                     .v_start = {}});
}

}  // namespace blocklift::dynamics::test
