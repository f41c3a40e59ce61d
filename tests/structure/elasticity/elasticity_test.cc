// Stiffness, loads and mass against fields that every correct element reproduces.
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/box_mesh.h"
#include "structure/elasticity/discretisation.h"
#include "structure/elasticity/elastic_model.h"
#include "structure/elasticity/load.h"
#include "structure/elasticity/stiffness.h"
#include "structure/error.h"
#include "structure/stress_tensor.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

using testing::box_mesh;

// Moves the inner vertices of the unit cube at random, by up to 0.15 of a cell.
Vector3 shaken(const Vector3& x) {
  static std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  for (int a = 0; a < 3; ++a)
    if (x[a] < 1e-9 || x[a] > 1 - 1e-9) return x;
  return x + Vector3(shift(random), shift(random), shift(random));
}

bool on_unit_cube(const Vector3& x) {
  return (x.array() < 1e-9).any() || (x.array() > 1 - 1e-9).any();
}

class PatchTest : public ::testing::TestWithParam<int> {};

// Irons and Razzaque (1972): a linear field given on the boundary is found inside exactly. The
// cells are distorted, and their own axes turned every way, so that the numbering of nodes on
// edges and faces is tried in all orientations.
TEST_P(PatchTest, LinearFieldIsExactOnDistortedTurnedCells) {
  BlockMesh mesh = box_mesh({3, 3, 3}, Vector3::Ones(), testing::steel(), shaken);
  testing::turn_cells(mesh);
  const Discretisation space(mesh, GetParam());
  Eigen::Matrix3d gradient;
  gradient << 1e-3, 2e-4, -3e-4, 5e-4, -7e-4, 1e-4, 4e-4, 6e-4, 9e-4;
  const auto field = [&](const Vector3& x) -> Vector3 { return gradient * x; };
  std::vector<FixedUnknown> fixed;
  testing::hold(space, on_unit_cube, field, {true, true, true}, fixed);
  const Eigen::VectorXd u =
      testing::solve(mesh, space, fixed, Eigen::VectorXd::Zero(space.unknowns()));
  double error = 0;
  for (int n = 0; n < space.node_count(); ++n)
    error = std::max(error, (u.segment<3>(3 * n) - field(space.nodes.col(n))).norm());
  EXPECT_LT(error, 1e-12 * gradient.norm());

  const CellStress stress(mesh, space, space.element.nodes());
  const Stress exact = stress_of_gradient(testing::steel(), gradient);
  for (int cell = 0; cell < space.cell_count(); ++cell)
    EXPECT_LT((stress(cell, u).colwise() - exact).cwiseAbs().maxCoeff(), 1e-10 * exact.norm());
}

INSTANTIATE_TEST_SUITE_P(Degrees, PatchTest, ::testing::Values(1, 2, 3, 4));

TEST(Stiffness, BoxAndGeneralIntegrationAgree) {
  // A cell that is a box but for 1e-9 m goes through the general way.
  BlockMesh box = box_mesh({1, 1, 1}, Vector3(2, 0.7, 0.02), testing::steel());
  BlockMesh general = box;
  general.vertices[7].x() += 1e-9;
  const Discretisation box_space(box, 3), general_space(general, 3);
  ASSERT_TRUE(box_space.shape_affine[0]);
  ASSERT_FALSE(general_space.shape_affine[0]);
  const Eigen::MatrixXd a = CellStiffness(box, box_space)(0);
  const Eigen::MatrixXd b = CellStiffness(general, general_space)(0);
  EXPECT_LT((a - b).norm(), 1e-6 * a.norm());
  EXPECT_LT((a - a.transpose()).norm(), 1e-13 * a.norm());
}

TEST(Stiffness, ThreadsDoNotChangeTheMatrix) {
  const BlockMesh mesh = box_mesh({3, 2, 2}, Vector3(3, 2, 1), testing::steel());
  const Discretisation space(mesh, 2);
  const SparseLower one = assemble_stiffness(mesh, space, 1);
  const SparseLower three = assemble_stiffness(mesh, space, 3);
  EXPECT_EQ(one.nonZeros(), stiffness_entries(space));
  EXPECT_EQ((one - three).norm(), 0.0);
}

TEST(Stiffness, RigidMotionsTakeNoForce) {
  const BlockMesh mesh = box_mesh({2, 2, 2}, Vector3::Ones(), testing::steel(), shaken);
  const Discretisation space(mesh, 3);
  const SparseLower matrix = assemble_stiffness(mesh, space, 2);
  for (int mode = 0; mode < 6; ++mode) {
    Eigen::VectorXd u(space.unknowns());
    for (int n = 0; n < space.node_count(); ++n)
      u.segment<3>(3 * n) = mode < 3 ? Vector3(Vector3::Unit(mode))
                                     : Vector3(Vector3::Unit(mode - 3).cross(space.nodes.col(n)));
    const Eigen::VectorXd force = matrix.selfadjointView<Eigen::Lower>() * u;
    EXPECT_LT(force.norm(), 1e-12 * matrix.norm() * u.norm());
  }
}

TEST(Mass, SumsOfPlatesByHand) {
  // One plate of 4 x 3 x 0.02 m.
  BlockDescription block;
  block.name = "plate";
  block.materials = {testing::steel()};
  block.plates = {{"plate", Axis::z, {1}, {{{0, 4}, {0, 3}, {}}}, 0.02, "AH36"}};
  const ElasticModel model = make_elastic_model(block, 2);
  const MassProperties& mass = model.mass_properties();
  const double m = 4 * 3 * 0.02 * 7850;
  EXPECT_NEAR(mass.mass, m, 1e-10 * m);
  EXPECT_NEAR(mass.outfitting_mass, 0, 1e-9 * m);
  EXPECT_LT((mass.centre_of_mass_B - Vector3(2, 1.5, 1)).norm(), 1e-12);
  EXPECT_NEAR(mass.inertia_BBcm_B(0, 0), m / 12 * (9 + 0.0004), 1e-10 * m);
  EXPECT_NEAR(mass.inertia_BBcm_B(1, 1), m / 12 * (16 + 0.0004), 1e-10 * m);
  EXPECT_NEAR(mass.inertia_BBcm_B(2, 2), m / 12 * 25, 1e-10 * m);
  EXPECT_NEAR(mass.inertia_BBcm_B(0, 1), 0, 1e-9 * m);
}

TEST(Mass, OutfittingBringsMassAndCentreToWhatIsStated) {
  const BlockDescription block = testing::small_block();
  const ElasticModel model = make_elastic_model(block, 2);
  const MassProperties& mass = model.mass_properties();
  EXPECT_NEAR(mass.mass, *block.total_mass, 1e-9 * mass.mass);
  EXPECT_LT((mass.centre_of_mass_B - *block.centre_of_mass_B).norm(), 1e-9);
  EXPECT_NEAR(mass.steel_mass, volume(model.mesh()) * 7850, 1e-9 * mass.mass);
  EXPECT_NEAR(mass.outfitting_mass, mass.mass - mass.steel_mass, 1e-6);
  // The nodal moments are of the same mass.
  EXPECT_NEAR(model.mass_moments().col(0).sum(), mass.mass, 1e-9 * mass.mass);
  EXPECT_LT((model.mass_moments().rightCols<3>().colwise().sum().transpose() / mass.mass -
             mass.centre_of_mass_B)
                .norm(),
            1e-9);
}

TEST(Mass, CentreOutOfReachIsRefusedWithWhatTheSteelWeighs) {
  BlockDescription block = testing::small_block();
  block.centre_of_mass_B = Vector3(3.9, 1.5, 0.8);
  try {
    make_elastic_model(block, 1);
    FAIL() << "accepted";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("density would be negative"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("6.2 t"), std::string::npos) << error.what();
  }
}

TEST(Load, LugForceHasItsResultantAndNoMomentAboutThePin) {
  const ElasticModel model = make_elastic_model(testing::small_block(), 3);
  for (int lug = 0; lug < model.lug_count(); ++lug) {
    const Vector3 pin = model.mesh().lifting_points[static_cast<std::size_t>(lug)].p_BPin;
    for (int a = 0; a < 3; ++a) {
      const Wrench sum = resultant(model.space().nodes, model.lug_loads().col(3 * lug + a));
      EXPECT_LT((sum.force - Vector3::Unit(a)).norm(), 1e-10);
      EXPECT_LT((sum.moment - pin.cross(Vector3::Unit(a))).norm(), 1e-10);
    }
  }
}

TEST(Load, InertiaFieldsHaveTheResultantsOfARigidBody) {
  const ElasticModel model = make_elastic_model(testing::small_block(), 2);
  const MassProperties& mass = model.mass_properties();
  const Vector3 a(0.3, -0.2, 9.5), alpha(0.05, 0.02, -0.07), omega(0.4, -0.3, 0.2);
  const InertiaField field = InertiaField::moving(a, Vector3::Zero(), alpha, omega);
  const Wrench sum = resultant(model.space().nodes, model.inertia_loads() * field.coefficients());
  const Vector3 c = mass.centre_of_mass_B;
  const Vector3 at_centre = a + alpha.cross(c) + omega.cross(omega.cross(c));
  const Vector3 force = -mass.mass * at_centre;
  // Newton-Euler; the moment about B's origin.
  const Vector3 spin = mass.inertia_BBcm_B * alpha + omega.cross(mass.inertia_BBcm_B * omega);
  EXPECT_LT((sum.force - force).norm(), 1e-10 * force.norm());
  EXPECT_LT((sum.moment - (c.cross(force) - spin)).norm(), 1e-9 * force.norm());
}

// Tapered cells and a density that varies: what the element's own degree asks of the quadrature is
// not enough for the moment of the inertia loads.
TEST_P(PatchTest, InertiaOfTaperedCellsWithOutfittingIsThatOfTheRigidBody) {
  const Vector3 centre(0.53, 0.49, 0.52);
  const ElasticModel model(box_mesh({3, 3, 3}, Vector3::Ones(), testing::steel(), shaken),
                           GetParam(), 9e3, centre);
  const MassProperties& mass = model.mass_properties();
  InertiaField field;
  field.acceleration_less_gravity = Vector3(0.4, -0.2, 9.8);
  field.angular_acceleration = Vector3(0.7, -0.3, 0.9);
  const Wrench sum = resultant(model.space().nodes, model.inertia_loads() * field.coefficients());
  const Vector3 force = -mass.mass * (field.acceleration_less_gravity +
                                      field.angular_acceleration.cross(mass.centre_of_mass_B));
  const Vector3 moment =
      mass.centre_of_mass_B.cross(force) - mass.inertia_BBcm_B * field.angular_acceleration;
  EXPECT_LT((sum.force - force).norm(), 1e-12 * force.norm());
  EXPECT_LT((sum.moment - moment).norm(), 1e-12 * moment.norm());
}

TEST(Load, BalancingFieldLeavesNoResultant) {
  const ElasticModel model = make_elastic_model(testing::small_block(), 2);
  const Eigen::VectorXd pull = model.lug_loads() * Eigen::VectorXd::LinSpaced(12, -2e4, 5e4);
  const InertiaField field =
      balancing_field(model.mass_properties(), resultant(model.space().nodes, pull));
  const Wrench rest =
      resultant(model.space().nodes, pull + model.inertia_loads() * field.coefficients());
  EXPECT_LT(rest.force.norm(), 1e-8);
  EXPECT_LT(rest.moment.norm(), 1e-8);
}

TEST(Load, TractionOnAFaceSumsToPressureTimesArea) {
  const BlockMesh mesh = box_mesh({2, 3, 1}, Vector3(2, 3, 0.5), testing::steel());
  const Discretisation space(mesh, 3);
  const Eigen::VectorXd load = traction_load(
      mesh, space, [](const Vector3&, const Vector3& n) { return n.z() > 0.5; },
      [](const Vector3&, const Vector3& n) -> Vector3 { return -2.0 * n; });
  const Wrench sum = resultant(space.nodes, load);
  EXPECT_LT((sum.force - Vector3(0, 0, -12)).norm(), 1e-12);
  EXPECT_LT((sum.moment - Vector3(1, 1.5, 0.5).cross(Vector3(0, 0, -12))).norm(), 1e-11);
}

TEST(Solver, FreeStructureIsRefused) {
  const BlockMesh mesh = box_mesh({1, 1, 1}, Vector3::Ones(), testing::steel());
  const Discretisation space(mesh, 1);
  SparseLower stiffness = assemble_stiffness(mesh, space, 1);
  ConstrainedSystem system(std::move(stiffness), {{0, 0}, {1, 0}});
  EXPECT_THROW(
      {
        system.factorise();
        // Rounding may let the last pivots pass; then the solution is beyond all measure.
        Eigen::VectorXd load = Eigen::VectorXd::Zero(24);
        load[23] = 1;
        if (system.solve(load).norm() > 1) throw ModelError("unbounded");
      },
      ModelError);
}

TEST(Solver, ElementDegreeBeyondFourIsRefused) {
  EXPECT_THROW(ReferenceElement(5), ModelError);
  EXPECT_THROW(ReferenceElement(0), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
