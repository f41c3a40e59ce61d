// How the forces of the sea change with the motion, against central differences of the whole
// right-hand side: a barge with a boom, afloat, in a current, moving fast.
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/simulation/jacobian.h"
#include "dynamics/simulation/newton_matrix.h"
#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;

Mechanism barge_with_boom() {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -9.81});
  builder.add_body({.name = "barge",
                    .joint = {.kind = JointKind::free},
                    .mass = 120,
                    .p_BoBcm_B = {0.3, 0.1, -0.2},
                    .I_BBcm_B = Vector3(300, 900, 1000).asDiagonal()});
  BodyDefinition boom;
  boom.name = "boom";
  boom.parent = "barge";
  boom.joint = {JointKind::revolute, Vector3::UnitY()};
  boom.X_PJ = Pose::translation({4, 0, 1});
  boom.mass = 10;
  boom.p_BoBcm_B = {2, 0, 1};
  boom.I_BBcm_B = Vector3(3, 9, 10).asDiagonal();
  builder.add_body(boom);
  return builder.build();
}

LiftSystem system_with(ForceElements elements, const Eigen::VectorXd& q) {
  return LiftSystem({.mechanism = barge_with_boom(),
                     .ropes = {},
                     .supports = {},
                     .elements = std::move(elements),
                     .operation = OperationBuilder().build(1.0),
                     .q_start = q,
                     .v_start = {}});
}

// Forces must be analytical to the accuracy of the differences.
void expect_jacobian(const ForceElements& elements, Random& random) {
  for (int i = 0; i < 20; ++i) {
    const Mechanism mechanism = barge_with_boom();
    Eigen::VectorXd q = examples::random_configuration(random, mechanism);
    q.head<3>() *= 0.5;
    const LiftSystem system = system_with(elements, q);
    LiftWorkspace w(system);
    Eigen::VectorXd y(system.state_size());
    get_state(system, q, random.values(mechanism.nv(), 1), y);
    JacobianWorkspace workspace(system);
    Eigen::MatrixXd J(y.size(), y.size());
    const Contacts contacts = find_contacts(system, 0.0, y, w);
    calc_jacobian(system, 0.0, y, &contacts, w, workspace, J);
    const Eigen::MatrixXd difference = difference_jacobian(system, 0.0, y, &contacts, w, 1e-6);
    EXPECT_LT((difference - J).lpNorm<Eigen::Infinity>(), 1e-5 * J.lpNorm<Eigen::Infinity>());
  }
}

std::shared_ptr<const HullClusters> small_barge() {
  return std::make_shared<const HullClusters>(make_box({12, 6, 3}, {6, 3, 2, 1}));
}

TEST(MarineJacobian, OfBuoyancy) {
  Random random(2);
  ForceElements elements;
  const auto sea = std::make_shared<const Sea>(Sea{WaveField(Water{.density = 1}), {}});
  std::get<std::vector<HullForce>>(elements).push_back(HullForce({"barge", 1, small_barge(), sea}));
  expect_jacobian(elements, random);
}

TEST(MarineJacobian, OfLinearBuoyancy) {
  Random random(7);
  ForceElements elements;
  LinearBuoyancy::Definition d;
  d.name = "b";
  d.frame = {1, {rotation_about(Vector3(1, 2, 3).normalized(), 0.4), {1, -0.5, 0.3}}};
  d.rest_height = 0.2;
  d.buoyancy = 1300;
  d.centre = {0.4, -0.7};
  d.stiffness << 700, 90, -50, 90, 2000, 300, -50, 300, 8000;
  std::get<std::vector<LinearBuoyancy>>(elements).emplace_back(d);
  expect_jacobian(elements, random);
}

TEST(MarineJacobian, OfDampingWetInPart) {
  Random random(3);
  ForceElements elements;
  QuadraticDamping::Definition d;
  d.name = "d";
  d.point = {1, {1, 2, -1}};
  d.linear << 1, 2, 3, 4, 5, 6;
  d.quadratic << 6, 5, 4, 3, 2, 1;
  d.sea = std::make_shared<const Sea>(Sea{WaveField(), Current::uniform(1.5, 0.4)});
  d.hull = small_barge();
  d.reference_volume = 1000;
  std::get<std::vector<QuadraticDamping>>(elements).push_back(QuadraticDamping(d));
  expect_jacobian(elements, random);
}

TEST(MarineJacobian, OfCurrentOnAHullWetInPart) {
  Random random(8);
  ForceElements elements;
  CurrentLoad::Definition d;
  d.name = "c";
  d.reference = {1, {1, 2, -1}};
  d.coefficients = {
      20,
      20,
      0,
      12,
      {{0, 1, 0, 0, 0, 0}, {1.5, 0.2, 1, 0, 0, 0.2}, {std::numbers::pi, -1, 0, 0, 0, 0}}};
  d.sea =
      std::make_shared<const Sea>(Sea{WaveField(Water{.density = 1}), Current::uniform(1.5, 0.4)});
  d.hull = small_barge();
  d.reference_volume = 1000;
  std::get<std::vector<CurrentLoad>>(elements).push_back(CurrentLoad(d));
  expect_jacobian(elements, random);
}

TEST(MarineJacobian, OfMooringAndTuggerLines) {
  Random random(5);
  ForceElements elements;
  auto& lines = std::get<std::vector<MooringLine>>(elements);
  lines.push_back(
      MooringLine({"m1", {world_index, {-60, 10, -20}}, {1, {1, 2, -0.5}}, {68, 10, 1e5, true}}));
  lines.push_back(MooringLine({"m2", {2, {2, 0, 1}}, {world_index, {30, 0, 10}}, {40, 5, 1e5}}));
  std::get<std::vector<TuggerLine>>(elements).push_back(
      TuggerLine({"t", {2, {2, 0, 1}}, {world_index, {30, 20, 10}}, 100, 10, 5}));
  std::get<std::vector<TuggerLine>>(elements).push_back(
      TuggerLine({"h", {2, {2, 0, 1}}, {world_index, {-30, 20, 10}}, 0, 10, 0, 400}));
  expect_jacobian(elements, random);
}

TEST(MarineJacobian, OfWindOnTheBarge) {
  Random random(6);
  ForceElements elements;
  const auto wind =
      std::make_shared<const WindField>(WindField::Definition{.speed = 12, .heading = 0.3});
  std::get<std::vector<WindLoad>>(elements).push_back(WindLoad(
      {"w",
       {1, {1, 0, 2}},
       10,
       20,
       3,
       12,
       {{0, 1, 0, 0, 0, 0}, {1.5, 0.2, 1, 0.3, 0.1, 0.2}, {std::numbers::pi, -1, 0, 0, 0, 0}},
       wind}));
  expect_jacobian(elements, random);
}

TEST(MarineJacobian, OfASunkenMember) {
  Random random(4);
  ForceElements elements;
  const auto sea =
      std::make_shared<const Sea>(Sea{WaveField(Water{.density = 1}), Current::uniform(1.5, 0.4)});
  // Wholly under water at any attitude.
  std::get<std::vector<MorisonMember>>(elements).push_back(
      MorisonMember({"m", 1, {0.2, 0.3, -0.1}, {1.0, -0.5, 0.4}, 0.5, 1, 3, sea}));
  for (int i = 0; i < 20; ++i) {
    const Mechanism mechanism = barge_with_boom();
    Eigen::VectorXd q = examples::random_configuration(random, mechanism);
    q[2] = -10;
    const LiftSystem system = system_with(elements, q);
    LiftWorkspace w(system);
    Eigen::VectorXd y(system.state_size());
    get_state(system, q, random.values(mechanism.nv(), 1), y);
    JacobianWorkspace workspace(system);
    Eigen::MatrixXd J(y.size(), y.size());
    const Contacts contacts;
    calc_jacobian(system, 0.0, y, &contacts, w, workspace, J);
    const Eigen::MatrixXd difference = difference_jacobian(system, 0.0, y, &contacts, w, 1e-6);
    EXPECT_LT((difference - J).lpNorm<Eigen::Infinity>(), 1e-6 * J.lpNorm<Eigen::Infinity>());
  }
}

}  // namespace
}  // namespace blocklift::dynamics
