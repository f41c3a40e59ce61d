// Unit responses and stress recovery on a free block.
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/accuracy/block_error.h"
#include "structure/error.h"
#include "structure/response/flexibility.h"
#include "structure/response/unit_responses.h"
#include "structure/stress/stress.h"
#include "structure/system/assembly.h"
#include "structure/system/matter.h"
#include "tests/structure/block_models.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

ElasticModel small_model(int degree) {
  return test::make_elastic_model(test::small_block(), degree);
}

// The small block on its four lugs, once for all tests of it.
class SmallBlock : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    model_ = new ElasticModel(small_model(3));
    responses_ = new UnitResponses(*model_);
  }
  static void TearDownTestSuite() {
    delete responses_;
    delete model_;
  }

  // Lug forces of a lift with sway; the field balances them.
  static LoadCase lift(double angular_velocity = 0) {
    LoadCase load_case{"lift", {}, {}};
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(model_->freedoms());
    for (int lug = 0; lug < 4; ++lug) {
      const Vector3 force(500.0 * lug, -800, 19000 + 1000.0 * lug);
      load_case.lug_forces_B.push_back(force);
      pull += model_->lug_loads().middleCols<3>(3 * lug) * force;
    }
    const double w = angular_velocity;
    InertiaField spin = InertiaField::moving(Vector3::Zero(), Vector3::Zero(), Vector3::Zero(),
                                             Vector3(w, -0.5 * w, 2 * w));
    pull += model_->inertia_loads() * spin.coefficients();
    load_case.field = balancing_field(model_->mass_properties(), resultant(model_->space(), pull));
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

// What rounding may leave at supports that carry nothing: each product of the equations K u = f is
// rounded by a share eps of its size, so a residual is at most eps sum |K| |u|, and the supports
// take the sum of all residuals. Source: Higham (2002), Accuracy and stability of numerical
// algorithms, section 3.5.
double largest_reaction_of_rounding(const ElasticModel& model, const Eigen::VectorXd& motion) {
  const SparseLower stiffness = assemble_stiffness(model.space());
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.space().unknowns());
  for (int freedom = 0; freedom < model.freedoms(); ++freedom) {
    const Space::Term *begin = model.space().begin_of(freedom),
                      *end = model.space().end_of(freedom);
    if (end - begin == 1) u[begin->unknown] = motion[freedom];
  }
  double sum = 0;
  for (Eigen::Index column = 0; column < stiffness.cols(); ++column)
    for (SparseLower::InnerIterator entry(stiffness, column); entry; ++entry)
      sum += std::abs(entry.value()) * (entry.row() == column
                                            ? std::abs(u[column])
                                            : std::abs(u[column]) + std::abs(u[entry.row()]));
  return std::numeric_limits<double>::epsilon() * sum;
}

TEST_F(SmallBlock, BalancedLoadsLeaveNoReaction) {
  const LoadCase load_case = lift(0.7);
  const LoadBalance balance = responses_->balance(load_case);
  EXPECT_LT(balance.force_residual, 1e-12);
  EXPECT_LT(balance.moment_residual, 1e-12);
  const double weight = model_->mass_properties().mass *
                        std::max(load_case.field.acceleration_less_gravity.norm(), 9.80665);
  const double bound =
      largest_reaction_of_rounding(*model_, responses_->displacement(load_case)) / weight;
  EXPECT_LT(bound, 1e-5);  // or it would say nothing
  EXPECT_LT(balance.reaction_over_weight, bound);
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

TEST_F(SmallBlock, ElasticMotionHasNoRigidPart) {
  const Eigen::VectorXd u = responses_->without_rigid_motion(responses_->displacement(lift()));
  EXPECT_LT((responses_->without_rigid_motion(u) - u).norm(), 1e-12 * u.norm());
  // A rigid motion added beforehand is taken out again.
  Eigen::VectorXd moved = u;
  const Vector3 turned(0.1, -0.2, 0.3);
  for (Eigen::Index n = 0; n < model_->space().node_count(); ++n) {
    moved.segment<3>(6 * n) += Vector3(1, 2, 3) + turned.cross(model_->space().nodes().col(n));
    moved.segment<3>(6 * n + 3) += turned;
  }
  EXPECT_LT((responses_->without_rigid_motion(moved) - u).norm(), 1e-12 * moved.norm());
}

// Sites are parts of the whole: the largest of any group at any site is that of the block.
double once_by_site(const LoadCaseResult& result) {
  double largest = 0;
  for (const GroupStress& group : result.groups)
    for (const SquareSite site : square_sites) {
      EXPECT_LE(group.at_site[site].value, group.checked_von_mises.value);
      largest = std::max(largest, group.at_site[site].value);
    }
  return largest;
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
  EXPECT_GE(a.checked_von_mises.value, a.field_von_mises.value);
  EXPECT_EQ(once_by_site(a), a.checked_von_mises.value);
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

// A strip of `length` x `width` in the plane z = 0 whose last tenth is the lug.
Mesh strip(double length, double width, double thickness) {
  Material material = test::steel();
  material.poisson_ratio = 0;
  Mesh mesh =
      examples::sheet_mesh([&](double x, double y) { return Vector3(length * x, width * y, 0); },
                           10, 1, thickness, material);
  mesh.groups.push_back({"lug", 0});
  mesh.regions.push_back({"lug", 1, true});
  mesh.shells.back().region = 1;
  LiftingPoint lug;
  lug.name = "lug";
  lug.p_BPin = Vector3(0.95 * length, width / 2, 0);
  lug.region = 1;
  lug.radius = 1;
  mesh.lifting_points = {lug};
  return mesh;
}

// Free bar of length L pulled at one end: the stress falls linearly from F/A to 0 (d'Alembert: a
// section at x carries what accelerates the part behind it, N = F x / L), and nothing reacts.
// The pull is spread over the last tenth of the bar; there N = F x/L - F (x - 0.9 L) / (0.1 L).
TEST(FreeBar, StressFallsLinearlyAndNothingReacts) {
  const ElasticModel model(strip(10, 0.4, 0.3), {3, {}});
  const UnitResponses responses(model);
  const double force = 1e5, area = 0.4 * 0.3;
  LoadCase load_case{"pull", {Vector3(force, 0, 0)}, {}};
  load_case.field.acceleration_less_gravity.x() = force / model.mass_properties().mass;
  const LoadBalance balance = responses.balance(load_case);
  EXPECT_LT(balance.force_residual, 1e-12);
  EXPECT_LT(balance.reaction_over_weight, 1e-9);
  const Eigen::MatrixXd u = responses.displacement(load_case);
  const StressPoints points(model.space());
  const Eigen::MatrixXd stress = points.stresses(0, points.count(), u);
  for (int point = 0; point < points.count(); ++point) {
    // The point lies a hundredth of the cell inside it: by so much its place differs at most.
    const double x = points.place(point).x();
    const double carried = force * (x / 10 - std::max(0.0, x - 9));
    EXPECT_NEAR(stress.block(6 * point, 0, 6, 1).norm(), carried / area, 0.011 * force / area);
  }
}

// Free thin bar in bending vibration: Euler-Bernoulli, first free-free bending mode
// f = 22.373 / (2 pi L^2) sqrt(E I / (rho A)) (Blevins, table 8-1). Slender enough (L/h = 50) for
// shear and rotary inertia to take less than 1 %; the method is a block Krylov one.
TEST(FreeBar, FirstElasticPeriodIsThatOfAFreeFreeBeam) {
  const ElasticModel model(strip(10, 0.4, 0.2), {3, {}});
  const UnitResponses responses(model);
  const double frequency =
      22.3733 / (2 * M_PI * 100) * std::sqrt(206e9 * 0.2 * 0.2 / 12 / test::steel().density);
  const FreeModes modes = find_free_modes(responses, 1);
  EXPECT_NEAR(modes.angular_frequencies[0] / (2 * M_PI * frequency), 1, 0.01);
}

// A plate in tension and bending: the membrane stress is the tension alone, to rounding, and the
// bending stress E t curvature / 2 apart.
TEST(CheckedStress, BendingDropsOut) {
  const Material material = test::steel();
  const double thickness = 0.02, curvature = 1e-2;
  const Mesh mesh = examples::sheet_mesh([](double x, double y) { return Vector3(2 * x, y, 0); }, 4,
                                         2, thickness, material);
  const ElasticModel model(mesh, {3, {}});
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(model.freedoms(), 2);
  for (int n = 0; n < model.space().node_count(); ++n) {
    const Vector3 x = model.space().nodes().col(n);
    u.col(0).segment<3>(6 * n) << 1e-4 * x.x(), -0.3e-4 * x.y(), 0;
    // Pure bending with anticlastic curvature: sigma_xx = E curvature z.
    u.col(1).segment<3>(6 * n) << 0, 0, -0.5 * curvature * (x.x() * x.x() - 0.3 * x.y() * x.y());
    u.col(1).segment<3>(6 * n + 3) << 0.3 * curvature * x.y(), curvature * x.x(), 0;
  }
  const CheckedStress checked(model, u);
  ASSERT_GT(checked.squares().size(), 20U);
  for (const double stress : Eigen::VectorXd(checked.von_mises(Eigen::Vector2d(1, 0))))
    EXPECT_NEAR(stress, 206e9 * 1e-4, 1e-3);
  for (const double stress : Eigen::VectorXd(checked.von_mises(Eigen::Vector2d(1, 1))))
    EXPECT_NEAR(stress, 206e9 * 1e-4, 1e-3);
  EXPECT_LT(checked.von_mises(Eigen::Vector2d(0, 1)).maxCoeff(), 1e-3);
  for (Eigen::Index s = 0; s < checked.bending().rows(); s += 3)
    EXPECT_NEAR((checked.bending().block<3, 1>(s, 1).norm()), 206e9 * curvature * thickness / 2, 1);
}

// However a plate is divided into shells or regions, its squares are the same.
TEST(CheckedStress, SquaresBelongToThePlateAndNotToItsMesh) {
  const auto squares_of = [](int m, int n, bool divided) {
    Mesh mesh = examples::sheet_mesh([](double x, double y) { return Vector3(2 * x, y, 0); }, m, n,
                                     0.02, test::steel());
    if (divided) {
      mesh.regions.push_back({"other half", 0, false});
      for (std::size_t s = 0; s < mesh.shells.size(); s += 2) mesh.shells[s].region = 1;
    }
    const PlateFields fields = find_fields(mesh);
    return place_squares(mesh, fields, FieldWalker(mesh, fields), 0.05);
  };
  const std::vector<Square> coarse = squares_of(2, 1, false), fine = squares_of(7, 5, true);
  ASSERT_EQ(coarse.size(), fine.size());
  for (std::size_t s = 0; s < coarse.size(); ++s)
    EXPECT_LT((coarse[s].centre_B - fine[s].centre_B).norm(), 1e-9);
}

// The true error from the energies of better elements: |u - u_h|^2 = f (u - u_h) in the energy norm
// (Galerkin's orthogonality), elements of degree 4 standing for u.
TEST(BlockErrorEstimate, IsOfTheTrueErrorsSizeAndFallsWithTheDegree) {
  LoadCase load_case{"lift", std::vector<Vector3>(4, Vector3(0, 0, 20e3)), {}};
  std::vector<double> energy, estimate;
  for (const int degree : {3, 4}) {
    const ElasticModel model = small_model(degree);
    Wrench pull;
    for (const LiftingPoint& lug : model.mesh().lifting_points) {
      pull.force += Vector3(0, 0, 20e3);
      pull.moment += lug.p_BPin.cross(Vector3(0, 0, 20e3));
    }
    load_case.field = balancing_field(model.mass_properties(), pull);
    const UnitResponses responses(model);
    const Eigen::VectorXd u = responses.displacement(load_case);
    energy.push_back(u.dot(responses.load_vector(load_case)));
    estimate.push_back(estimate_block_error(model, u).relative);
  }
  const double truth = std::sqrt(1 - energy[0] / energy[1]);
  EXPECT_GT(estimate[0], 0.3 * truth);
  EXPECT_LT(estimate[1], estimate[0]);
}

// More motions than are computed together.
TEST(BlockErrorEstimate, OfManyMotionsIsThatOfEach) {
  const ElasticModel model = small_model(2);
  const Eigen::MatrixXd motions = 1e-3 * Eigen::MatrixXd::Random(model.freedoms(), 11);
  const std::vector<BlockError> errors = estimate_block_errors(model, motions);
  ASSERT_EQ(errors.size(), 11U);
  for (Eigen::Index m = 0; m < motions.cols(); ++m) {
    const BlockError alone = estimate_block_error(model, motions.col(m));
    EXPECT_DOUBLE_EQ(errors[m].relative, alone.relative);
    EXPECT_EQ(errors[m].worst_part, alone.worst_part);
    EXPECT_NEAR((errors[m].of_cells - alone.of_cells).norm(), 0, 1e-12 * alone.of_cells.norm());
  }
}

// Pressure on the bottom joins the basis: superposed it is what a solution of its own gives, with
// or without lug forces and a spin beside it, and nothing reacts.
TEST_F(SmallBlock, AddedLoadsAreSuperposedLikeAllOthers) {
  UnitResponses responses(*model_);
  const int before = responses.count();
  std::vector<int> cells(model_->space().shells().size());
  std::iota(cells.begin(), cells.end(), 0);
  Eigen::Matrix<double, 6, 2> wrenches;
  wrenches.col(0) << 0, 0, 1, 0, 0, 0;
  wrenches.col(1) << 0, 0, 1, 0.5, -1, 0;
  const Eigen::MatrixXd loads = spread_wrenches(model_->space(), cells, Vector3(2, 1, 0), wrenches);
  responses.add_loads(loads);
  EXPECT_EQ(responses.count(), before + 2);
  LoadCase load_case = lift(0.3);
  const Eigen::VectorXd dry = responses.displacement(load_case);
  EXPECT_LT((dry - responses_->displacement(load_case)).norm(), 1e-9 * dry.norm());
  load_case.added = Eigen::Vector2d(4e3, -1e3);
  const Wrench pressed = resultant(model_->space(), loads * load_case.added);
  const InertiaField given_way = balancing_field(model_->mass_properties(), pressed);
  load_case.field.acceleration_less_gravity += given_way.acceleration_less_gravity;
  load_case.field.angular_acceleration += given_way.angular_acceleration;
  const Eigen::VectorXd superposed = responses.displacement(load_case);
  const Eigen::VectorXd direct = responses.solve_directly(load_case);
  EXPECT_LT((superposed - direct).norm(), 1e-8 * direct.norm());
  EXPECT_GT((superposed - dry).norm(), 1e-3 * dry.norm());
  EXPECT_LT(responses.balance(load_case).reaction_over_weight, 1e-6);
  load_case.added = Eigen::Vector3d::Zero();
  EXPECT_THROW(responses.coefficients(load_case), ModelError);
}

// An L of three panels in the plane z = 0 with its inner corner at (1, 1), and a web below its edge
// y = 1: squares that touch the web are beside a weld, those along the free edge x = 1 are not.
TEST(SquareSites, AreToldApartAtAnInnerCorner) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  const auto panel = [&](double x, double y) {
    examples::add_sheet(
        mesh, [=](double s, double t) { return Vector3(x + s, y + t, 0); }, 2, 2);
  };
  panel(0, 0);
  panel(1, 0);
  panel(0, 1);
  const auto squares_of = [](const Mesh& of) {
    const PlateFields fields = find_fields(of);
    return place_squares(of, fields, FieldWalker(of, fields), 0.05);
  };
  const Vector3 corner(1, 1, 0);
  int bare = 0;
  for (const Square& square : squares_of(mesh)) {
    EXPECT_EQ(square.at_corner(), (square.centre_B - corner).norm() <= 0.15);
    EXPECT_NE(square.site, SquareSite::welded_corner);
    if (square.at_corner()) ++bare;
  }
  EXPECT_GE(bare, 4);

  Mesh stiffened = mesh;
  examples::add_beams(stiffened, {1, 1, 0}, {2, 1, 0}, 0, Vector3::UnitY());
  examples::add_sheet(
      mesh, [](double s, double t) { return Vector3(1 + s, 1, -0.3 * t); }, 2, 1);
  for (const Mesh& welded : {mesh, stiffened}) {
    int beside = 0, apart = 0;
    for (const Square& square : squares_of(welded)) {
      if (!square.at_corner() || std::abs(square.centre_B.z()) > 1e-9) continue;
      const Vector3 off = square.centre_B - corner;
      const bool touches = std::hypot(std::min(off.x(), 0.0), off.y()) < 0.0375;
      EXPECT_EQ(square.site, touches ? SquareSite::welded_corner : SquareSite::corner)
          << square.centre_B.transpose();
      ++(touches ? beside : apart);
    }
    EXPECT_GE(beside, 2);
    EXPECT_GE(apart, 1);
  }
}

// A lug on the edge of a plate from its corner (0, 0) to (0.5, 0): the toe within the edge has no
// limit of the stress, the root as a whole makes a corner.
TEST(SquareSites, AreCornersAlongALugsRoot) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  examples::add_sheet(
      mesh, [](double s, double t) { return Vector3(2 * s, t, 0); }, 4, 2);
  const auto plates = static_cast<std::ptrdiff_t>(mesh.shells.size());
  examples::add_sheet(
      mesh, [](double s, double t) { return Vector3(0.5 * s, 0, 0.3 * t); }, 1, 1);
  mesh.regions.push_back({"L1", 0, true});
  const int lug = static_cast<int>(mesh.regions.size()) - 1;
  for (auto shell = mesh.shells.begin() + plates; shell != mesh.shells.end(); ++shell)
    shell->region = lug;
  const PlateFields fields = find_fields(mesh);
  const Vector3 toe(0.5, 0, 0);
  int at_root = 0;
  for (const Square& square : place_squares(mesh, fields, FieldWalker(mesh, fields), 0.05)) {
    if (square.region == lug) continue;
    const Vector3 from_root(std::max(square.centre_B.x() - 0.5, 0.0), square.centre_B.y(), 0);
    EXPECT_EQ(square.at_corner(), from_root.norm() <= 0.15) << square.centre_B.transpose();
    EXPECT_EQ(square.is_near_singularity, (square.centre_B - toe).norm() <= 0.15)
        << square.centre_B.transpose();
    if (square.at_corner() && !square.is_near_singularity) ++at_root;
  }
  EXPECT_GE(at_root, 4);
}

}  // namespace
}  // namespace blocklift::structure
