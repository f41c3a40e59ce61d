// A free block's compliance and modes at its lugs.
#include "structure/response/flexibility.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/response/unit_responses.h"
#include "structure/system/matter.h"
#include "tests/structure/block_models.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

class Flexibility : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    model_ = new ElasticModel(test::make_elastic_model(test::small_block(), 2));
    responses_ = new UnitResponses(*model_);
  }
  static void TearDownTestSuite() {
    delete responses_;
    delete model_;
  }
  static ElasticModel* model_;
  static UnitResponses* responses_;
};
ElasticModel* Flexibility::model_ = nullptr;
UnitResponses* Flexibility::responses_ = nullptr;

TEST_F(Flexibility, ModesAreOrthonormalAndSolveTheEigenproblem) {
  const FreeModes modes = find_free_modes(*responses_, 5, 1e-7);
  const Eigen::MatrixXd weighed =
      mass_matrix(model_->space(), model_->mass_properties()) * modes.shapes;
  EXPECT_LT(
      (modes.shapes.transpose() * weighed - Eigen::MatrixXd::Identity(5, 5)).cwiseAbs().maxCoeff(),
      1e-10);
  // No momentum in them.
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  for (Eigen::Index n = 0; n < model_->space().node_count(); ++n)
    momentum += weighed.block<3, 1>(6 * n, 0);
  EXPECT_LT(momentum.norm(), 1e-8 * weighed.col(0).cwiseAbs().sum());
  for (Eigen::Index k = 1; k < 5; ++k)
    EXPECT_GE(modes.angular_frequencies[k], modes.angular_frequencies[k - 1]);
}

// Column j is how the lugs move under a unit force at one of them that inertia balances.
TEST_F(Flexibility, ComplianceIsThatOfBalancedLoadCases) {
  const LugFlexibility flexibility = find_lug_flexibility(*responses_, 0);
  const Eigen::MatrixXd& compliance = flexibility.compliance;
  const auto lugs = static_cast<std::size_t>(model_->lug_count());
  ASSERT_EQ(compliance.rows(), 3 * model_->lug_count());
  LoadCase pull{"pull", std::vector<Vector3>(lugs, Vector3::Zero()), {}};
  pull.lug_forces_B[1] = Vector3(1e3, -2e3, 5e3);
  pull.lug_forces_B[2] = Vector3(0, 1e3, 4e3);
  Eigen::VectorXd forces(3 * model_->lug_count());
  for (std::size_t i = 0; i < lugs; ++i) forces.segment<3>(3 * i) = pull.lug_forces_B[i];
  pull.field = balancing_field(model_->mass_properties(),
                               resultant(model_->space(), model_->lug_loads() * forces));
  const Eigen::VectorXd relative = responses_->without_rigid_motion(responses_->displacement(pull));
  const Eigen::VectorXd moved = model_->lug_loads().transpose() * relative;
  EXPECT_LT((compliance * forces - moved).norm(), 1e-6 * moved.norm());
  EXPECT_LT((compliance - compliance.transpose()).norm(), 1e-12 * compliance.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(compliance);
  EXPECT_GT(solver.eigenvalues()[0], -1e-10 * solver.eigenvalues().tail<1>()[0]);
}

TEST_F(Flexibility, ModesTakeTheirPartOfTheCompliance) {
  const LugFlexibility flexibility = find_lug_flexibility(*responses_, 6);
  const double mass = model_->mass_properties().mass;
  const Eigen::MatrixXd by_modes =
      flexibility.shapes *
      (mass * flexibility.angular_frequencies.array().square()).inverse().matrix().asDiagonal() *
      flexibility.shapes.transpose();
  EXPECT_LT((by_modes + flexibility.residual_compliance - flexibility.compliance).norm(),
            1e-6 * flexibility.compliance.norm());
  EXPECT_LT(flexibility.residual_compliance.trace(), flexibility.compliance.trace());
}

constexpr double length = 12, depth = 0.5, thickness = 0.02;  // of the girder, m

// A girder with lugs at its ends and its middle.
BlockDescription make_girder() {
  constexpr double half_lug = 0.05;
  BlockDescription girder;
  girder.name = "girder";
  girder.materials = {test::steel()};
  girder.plates = {
      {"web", Axis::y, {0}, {{{0, length + 2 * half_lug}, {}, {0, depth}}}, thickness, "AH36"}};
  for (int i = 0; i < 3; ++i) {
    const std::string name = "L" + std::to_string(i + 1);
    const double x = half_lug + i * length / 2;
    const Interval along{x - half_lug, x + half_lug};
    girder.pads.push_back(
        {"pad_" + name, "web", Axis::y, 0, {{along, {}, {0.3, depth}}}, 0.02, ""});
    girder.lugs.push_back(
        {name, "pad_" + name, Axis::y, 0, {{along, {}, {depth, 0.6}}}, 0.02, "", {x, 0, 0.55}});
  }
  girder.largest_element = 1;
  return girder;
}

// A girder of depth h and thickness t with lugs at its ends and its middle, L apart: forces (-P/2,
// P, -P/2) are in balance and do the work P^2 (L^3 / 48 EI + L / 4 kappa G A) (Timoshenko 1921,
// simply supported beam; kappa = 10 (1 + nu) / (12 + 11 nu), Cowper 1966). The lug in the middle
// stiffens 0.1 m of 12 m, where 2.5 % of the energy is; the lugs themselves stretch by less than
// 0.1 %.
TEST(GirderFlexibility, ComplianceIsThatOfABeam) {
  const BlockDescription girder = make_girder();
  const ElasticModel model = test::make_elastic_model(girder, 3);
  const UnitResponses responses(model);
  const Eigen::MatrixXd compliance = find_lug_flexibility(responses, 0).compliance;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(9);
  forces[2] = forces[8] = -0.5;
  forces[5] = 1;
  const double E = girder.materials[0].youngs_modulus, nu = girder.materials[0].poisson_ratio;
  const double inertia = thickness * std::pow(depth, 3) / 12;
  const double kappa = 10 * (1 + nu) / (12 + 11 * nu), G = E / (2 * (1 + nu));
  const double expected =
      std::pow(length, 3) / (48 * E * inertia) + length / (4 * kappa * G * thickness * depth);
  EXPECT_NEAR(forces.dot(compliance * forces) / expected, 1, 0.01);
}

TEST_F(Flexibility, NoModesAreRefused) {
  EXPECT_THROW(find_free_modes(*responses_, 0), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
