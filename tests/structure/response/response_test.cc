// Unit responses and stress recovery on a free block.
#include <cmath>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/box_mesh.h"
#include "structure/error.h"
#include "structure/response/block_error.h"
#include "structure/stress_tensor.h"
#include "structure/response/flexibility.h"
#include "structure/response/stress.h"
#include "structure/response/unit_responses.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

// The small block on its four lugs, once for all tests of it.
class SmallBlock : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    model_ = new ElasticModel(make_elastic_model(testing::small_block(), 3));
    responses_ = new UnitResponses(*model_);
  }
  static void TearDownTestSuite() {
    delete responses_;
    delete model_;
  }

  // Lug forces of a lift with sway; the field balances them.
  static LoadCase lift(double angular_velocity = 0) {
    LoadCase load_case{"lift", {}, {}};
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(model_->unknowns());
    for (int lug = 0; lug < 4; ++lug) {
      const Vector3 force(500.0 * lug, -800, 19000 + 1000.0 * lug);
      load_case.lug_forces_B.push_back(force);
      pull += model_->lug_loads().middleCols<3>(3 * lug) * force;
    }
    const double w = angular_velocity;
    InertiaField spin = InertiaField::moving(Vector3::Zero(), Vector3::Zero(), Vector3::Zero(),
                                             Vector3(w, -0.5 * w, 2 * w));
    pull += model_->inertia_loads() * spin.coefficients();
    load_case.field =
        balancing_field(model_->mass_properties(), resultant(model_->space().nodes, pull));
    load_case.field.angular_velocity_products = spin.angular_velocity_products;
    return load_case;
  }

  static ElasticModel* model_;
  static UnitResponses* responses_;
};
ElasticModel* SmallBlock::model_ = nullptr;
UnitResponses* SmallBlock::responses_ = nullptr;

TEST_F(SmallBlock, SuperpositionEqualsADirectSolve) {
  for (const double spin : {0.0, 0.7}) {
    const LoadCase load_case = lift(spin);
    const Eigen::VectorXd direct =
        responses_->without_rigid_motion(responses_->solve_directly(load_case));
    const Eigen::VectorXd superposed =
        responses_->without_rigid_motion(responses_->displacement(load_case));
    EXPECT_LT((superposed - direct).norm(), 1e-10 * direct.norm());
  }
}

TEST_F(SmallBlock, UnbalancedLoadsAreSuperposedToo) {
  LoadCase load_case = lift();
  load_case.field.acceleration_less_gravity += Vector3(0.5, -0.2, 1);
  load_case.field.angular_acceleration += Vector3(0.1, 0.2, -0.1);
  const Eigen::VectorXd direct = responses_->solve_directly(load_case);
  EXPECT_LT((responses_->displacement(load_case) - direct).norm(), 1e-8 * direct.norm());
  EXPECT_GT(responses_->balance(load_case).force_residual, 1e-2);
  EXPECT_GT(responses_->balance(load_case).reaction_over_weight, 1e-3);
}

TEST_F(SmallBlock, BalancedLoadsLeaveNoReaction) {
  const LoadBalance balance = responses_->balance(lift(0.7));
  EXPECT_LT(balance.force_residual, 1e-12);
  EXPECT_LT(balance.moment_residual, 1e-12);
  EXPECT_LT(balance.reaction_over_weight, 1e-7);
}

// A block at rest on the ground under slack ropes: what is left of cancelling forces is rounding.
TEST_F(SmallBlock, BlockThatNothingLoadsIsInBalance) {
  LoadCase load_case{"at rest", std::vector<Vector3>(4, Vector3::Zero()), {}};
  load_case.field.acceleration_less_gravity = Vector3(1e-12, 0, -2e-12);
  const LoadBalance balance = responses_->balance(load_case);
  EXPECT_LT(balance.force_residual, 1e-12);
  EXPECT_LT(balance.moment_residual, 1e-12);
  EXPECT_LT(balance.reaction_over_weight, 1e-12);
}

TEST_F(SmallBlock, ElasticDisplacementHasNoRigidPart) {
  const Eigen::Matrix3Xd u = responses_->elastic_displacement(lift());
  const Eigen::VectorXd flat = Eigen::Map<const Eigen::VectorXd>(u.data(), u.size());
  const Eigen::VectorXd again = responses_->without_rigid_motion(flat);
  EXPECT_LT((again - flat).norm(), 1e-12 * flat.norm());
  // A rigid motion added beforehand is taken out again.
  Eigen::VectorXd moved = flat;
  for (Eigen::Index n = 0; n < u.cols(); ++n)
    moved.segment<3>(3 * n) +=
        Vector3(1, 2, 3) + Vector3(0.1, -0.2, 0.3).cross(model_->space().nodes.col(n));
  EXPECT_LT((responses_->without_rigid_motion(moved) - flat).norm(), 1e-12 * moved.norm());
}

TEST_F(SmallBlock, StressesScaleWithTheLoads) {
  const StressRecovery recovery(*responses_);
  LoadCase once = lift(), twice = once;
  for (Vector3& force : twice.lug_forces_B) force *= 2;
  twice.field.acceleration_less_gravity *= 2;
  twice.field.angular_acceleration *= 2;
  const LoadCaseResult a = recovery.evaluate(once), b = recovery.evaluate(twice);
  EXPECT_NEAR(b.checked_von_mises.value, 2 * a.checked_von_mises.value,
              1e-6 * b.checked_von_mises.value);
  EXPECT_NEAR(b.peak_von_mises.value, 2 * a.peak_von_mises.value, 1e-6 * b.peak_von_mises.value);
  EXPECT_NEAR(b.displacement.value, 2 * a.displacement.value, 1e-6 * b.displacement.value);
  EXPECT_GT(a.peak_von_mises.value, a.checked_von_mises.value);
  // The whole is the largest of its groups, and no neighbourhood exceeds it.
  double largest = 0;
  for (const GroupStress& group : a.groups)
    largest = std::max(largest, group.checked_von_mises.value);
  EXPECT_EQ(largest, a.checked_von_mises.value);
  ASSERT_EQ(a.lugs.size(), 4U);
  for (const LugNeighbourhood& lug : a.lugs) {
    EXPECT_LE(lug.checked_von_mises.value, a.checked_von_mises.value);
    EXPECT_GT(lug.checked_von_mises.value, 0);
    EXPECT_FALSE(lug.checked_von_mises.part.empty());
  }
}

TEST_F(SmallBlock, WrongNumberOfLugForcesIsRefused) {
  LoadCase load_case = lift();
  load_case.lug_forces_B.pop_back();
  EXPECT_THROW(responses_->coefficients(load_case), ModelError);
}

// Free bar of length L pulled at one end: the stress falls linearly from F/A to 0 (d'Alembert: a
// section at x carries what accelerates the part behind it, N = F x / L), and nothing reacts.
// The pull is spread over the last tenth of the bar; there N = F x/L - F (x - 0.9 L) / (0.1 L).
// The true error from the energies of better elements: |u - u_h|^2 = f (u - u_h) in the energy norm
// (Galerkin's orthogonality), cubic elements standing for u.
TEST(BlockErrorEstimate, IsOfTheTrueErrorsSizeAndFallsWithTheDegree) {
  LoadCase load_case{"lift", std::vector<Vector3>(4, Vector3(0, 0, 20e3)), {}};
  std::vector<double> energy, estimate;
  for (const int degree : {1, 2, 3}) {
    const ElasticModel model = make_elastic_model(testing::small_block(), degree);
    if (degree == 1) {
      Wrench pull;
      for (const LiftingPoint& lug : model.mesh().lifting_points) {
        pull.force += Vector3(0, 0, 20e3);
        pull.moment += lug.p_BPin.cross(Vector3(0, 0, 20e3));
      }
      load_case.field = balancing_field(model.mass_properties(), pull);
    }
    const UnitResponses responses(model);
    const Eigen::VectorXd u = responses.displacement(load_case);
    energy.push_back(u.dot(responses.load_vector(load_case)));
    estimate.push_back(estimate_block_error(model, u).relative);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const double truth = std::sqrt(1 - energy[i] / energy[2]);
    EXPECT_GT(estimate[i], 0.3 * truth) << "degree " << i + 1;
    EXPECT_LT(estimate[i], 2 * truth) << "degree " << i + 1;
  }
  EXPECT_LT(estimate[1], estimate[0]);
  EXPECT_LT(estimate[2], estimate[1]);
}

TEST(BlockErrorEstimate, LinearDisplacementHasNone) {
  const ElasticModel model = make_elastic_model(testing::small_block(), 2);
  Eigen::VectorXd u(model.unknowns());
  for (int n = 0; n < model.space().node_count(); ++n) {
    const Vector3 x = model.space().nodes.col(n);
    u.segment<3>(3 * n) = 1e-4 * Vector3(x.x() + x.y(), 2 * x.z(), x.x() - x.y());
  }
  EXPECT_LT(estimate_block_error(model, u).relative, 1e-9);
}

TEST(FreeBar, StressFallsLinearlyAndNothingReacts) {
  Material material = testing::steel();
  material.poisson_ratio = 0;
  BlockMesh mesh = testing::box_mesh({10, 1, 1}, Vector3(10, 0.4, 0.3), material);
  mesh.groups.push_back({"lug", 0});
  mesh.cell_group.back() = 1;
  mesh.lugs = {{"lug", Vector3(9.5, 0.2, 0.15), 1, 0, 1}};
  const ElasticModel model(mesh, 3);
  const UnitResponses responses(model);
  const double force = 1e5, area = 0.4 * 0.3;
  LoadCase load_case{"pull", {Vector3(force, 0, 0)}, {}};
  load_case.field.acceleration_less_gravity.x() = force / model.mass_properties().mass;
  const LoadBalance balance = responses.balance(load_case);
  EXPECT_LT(balance.force_residual, 1e-12);
  EXPECT_LT(balance.reaction_over_weight, 1e-9);
  const Eigen::VectorXd u = responses.displacement(load_case);
  const CellStress stress(model.mesh(), model.space(), model.space().element.nodes());
  for (int cell = 0; cell < 10; ++cell) {
    const auto values = stress(cell, u);
    for (Eigen::Index q = 0; q < values.cols(); ++q) {
      const double x = position(model.mesh(), cell, stress.points().col(q)).x();
      const double carried = force * (x / 10 - (cell == 9 ? x - 9 : 0));
      EXPECT_NEAR(values(0, q), carried / area, 1e-6 * force / area);
      EXPECT_LT(values.col(q).tail<5>().norm(), 1e-6 * force / area);
    }
  }
}

// Free thin bar in axial and bending vibration: Euler-Bernoulli, first free-free bending mode
// f = 22.373 / (2 pi L^2) sqrt(E I / (rho A)) (Blevins, table 8-1). Slender enough (L/h = 50) for
// shear and rotary inertia to take less than 1 %; the method is a block Krylov one.
TEST(FreeBar, FirstElasticPeriodIsThatOfAFreeFreeBeam) {
  Material material = testing::steel();
  material.poisson_ratio = 0;
  const BlockMesh mesh = testing::box_mesh({10, 1, 1}, Vector3(10, 0.4, 0.2), material);
  const ElasticModel model(mesh, 3);
  const UnitResponses responses(model);
  const double frequency =
      22.3733 / (2 * M_PI * 100) * std::sqrt(206e9 * 0.2 * 0.2 / 12 / material.density);
  const FreeModes modes = find_free_modes(responses, 1);
  EXPECT_NEAR(modes.angular_frequencies[0] / (2 * M_PI * frequency), 1, 0.01);
}

// A plate strip of two layers in tension and bending: the membrane stress is the tension alone.
TEST(MembraneStress, BendingDropsOut) {
  Material material = testing::steel();
  const BlockMesh mesh = testing::box_mesh({4, 2, 2}, Vector3(2, 1, 0.02), material);
  const ElasticModel model(mesh, 3);
  Eigen::MatrixXd u(model.unknowns(), 2);
  for (int n = 0; n < model.space().node_count(); ++n) {
    const Vector3 x = model.space().nodes.col(n);
    const double z = x.z() - 0.01, curvature = 1e-2;
    u.col(0).segment<3>(3 * n) << 1e-4 * x.x(), -0.3e-4 * x.y(), -0.3e-4 * x.z();
    // Pure bending with anticlastic curvature: sigma_xx = E curvature z.
    u.col(1).segment<3>(3 * n) << curvature * z * x.x(), -0.3 * curvature * z * x.y(),
        -0.5 * curvature * (x.x() * x.x() + 0.3 * (z * z - x.y() * x.y()));
  }
  const MembraneStress membrane(model, u);
  for (const double stress : Eigen::VectorXd(membrane.von_mises(Eigen::Vector2d(1, 0))))
    EXPECT_NEAR(stress, 206e9 * 1e-4, 1e-3);
  for (const double stress : Eigen::VectorXd(membrane.von_mises(Eigen::Vector2d(1, 1))))
    EXPECT_NEAR(stress, 206e9 * 1e-4, 1e-3);
  EXPECT_LT(membrane.von_mises(Eigen::Vector2d(0, 1)).maxCoeff(), 1e-3);
}

// Pressure on the bottom joins the basis: superposed it is what a solution of its own gives, with or without
// lug forces and a spin beside it, and nothing reacts.
TEST_F(SmallBlock, AddedLoadsAreSuperposedLikeAllOthers) {
  UnitResponses responses(*model_);
  const int before = responses.count();
  Eigen::MatrixXd loads(model_->unknowns(), 2);
  for (int k = 0; k < 2; ++k)
    loads.col(k) = traction_load(
        model_->mesh(), model_->space(),
        [](const Vector3&, const Vector3& n) { return n.z() < -0.9; },
        [k](const Vector3& place, const Vector3& n) -> Vector3 { return -(k + place.x()) * n; });
  responses.add_loads(loads);
  EXPECT_EQ(responses.count(), before + 2);
  LoadCase load_case = lift(0.3);
  const Eigen::VectorXd dry = responses.displacement(load_case);
  EXPECT_LT((dry - responses_->displacement(load_case)).norm(), 1e-9 * dry.norm());
  load_case.added = Eigen::Vector2d(4e3, -1e3);
  const Wrench pressed = resultant(model_->space().nodes, loads * load_case.added);
  const InertiaField given_way = balancing_field(model_->mass_properties(), pressed);
  load_case.field.acceleration_less_gravity += given_way.acceleration_less_gravity;
  load_case.field.angular_acceleration += given_way.angular_acceleration;
  const Eigen::VectorXd superposed = responses.displacement(load_case);
  const Eigen::VectorXd direct = responses.solve_directly(load_case);
  EXPECT_LT((superposed - direct).norm(), 1e-8 * direct.norm());
  EXPECT_GT((superposed - dry).norm(), 0.01 * dry.norm());
  EXPECT_LT(responses.balance(load_case).reaction_over_weight, 1e-6);
  load_case.added = Eigen::Vector3d::Zero();
  EXPECT_THROW(responses.coefficients(load_case), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
