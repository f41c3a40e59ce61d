// Squares of the checked stress about chosen places.
#include "structure/stress/square_about.h"

#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/stress/squares.h"

namespace blocklift::structure {
namespace {

constexpr double asked_side = 0.05;

/// A plate of 8 x 1 m in few shells: between its ends and middle checked squares lie 0.5 m apart.
Mesh long_plate() {
  return testing::sheet_mesh([](double x, double y) { return Vector3(8 * x, y, 0); }, 4, 2, 0.02,
                             testing::steel());
}

std::optional<Square> square_near(const Mesh& mesh, const Vector3& place) {
  const PlateFields fields = find_fields(mesh);
  return square_about(mesh, fields, FieldWalker(mesh, fields), place, asked_side);
}

TEST(SquareAbout, LiesInTheMiddleOfAPlaceWithinThePlate) {
  const Mesh mesh = long_plate();
  for (const Vector3& place :
       {Vector3(4, 0.5, 0), Vector3(3.777, 0.123, 0), Vector3(7.9, 0.9, 0)}) {
    const std::optional<Square> square = square_near(mesh, place);
    ASSERT_TRUE(square.has_value());
    EXPECT_LT((square->centre_B - place).norm(), 1e-9);
    EXPECT_EQ(square->size, asked_side);
  }
  // The level of a place over the plate does not count.
  const std::optional<Square> below = square_near(mesh, {4, 0.5, 0.01});
  ASSERT_TRUE(below.has_value());
  EXPECT_LT((below->centre_B - Vector3(4, 0.5, 0)).norm(), 1e-9);
}

// At an edge it is flush with it, at a corner with both.
TEST(SquareAbout, StaysInsideThePlate) {
  const Mesh mesh = long_plate();
  const std::optional<Square> at_edge = square_near(mesh, {4, 0, 0}),
                              at_corner = square_near(mesh, {8, 1, 0});
  ASSERT_TRUE(at_edge.has_value());
  EXPECT_LT((at_edge->centre_B - Vector3(4, 0.025, 0)).norm(), 1e-9);
  ASSERT_TRUE(at_corner.has_value());
  EXPECT_LT((at_corner->centre_B - Vector3(7.975, 0.975, 0)).norm(), 1e-9);
}

TEST(SquareAbout, IsNoneWhereThereIsNoPlating) {
  EXPECT_FALSE(square_near(long_plate(), {4, 1.2, 0}).has_value());
  EXPECT_FALSE(square_near(long_plate(), {4, 0.5, 0.3}).has_value());
}

// Plates bent in their own plane: u = k x y, v = -k x^2 / 2 - nu k y^2 / 2 have the stress E k y
// along x and no other (beam theory, exact for a plate), whose mean over a square is that at its
// centre.
TEST(SquareAbout, HasTheStressOfThePlaceAskedFor) {
  const double k = 1e-4;
  const ElasticModel model(long_plate(), {2, {}});
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(model.freedoms(), 1);
  for (int n = 0; n < model.space().node_count(); ++n) {
    const Vector3 x = model.space().nodes().col(n);
    u.col(0).segment<3>(6 * n) << k * x.x() * x.y(),
        -0.5 * k * (x.x() * x.x() + 0.3 * x.y() * x.y()), 0;
    u(6 * n + 5, 0) = -k * x.x();
  }
  for (const Vector3& place : {Vector3(4, 0.5, 0), Vector3(3.25, 0.81, 0)}) {
    const std::optional<Square> square = square_near(model.mesh(), place);
    ASSERT_TRUE(square.has_value());
    const CheckedStress checked(model, u, {*square});
    EXPECT_NEAR(checked.von_mises(Eigen::VectorXd::Ones(1))[0], 206e9 * k * place.y(), 1e-3);
  }
}

}  // namespace
}  // namespace blocklift::structure
