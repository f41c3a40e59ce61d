// Squares of the checked stress about chosen places.
#include "structure/stress/square_about.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/stress/squares.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

constexpr double asked_side = 0.05;

/// A plate of 8 x 1 m in few shells: between its ends and middle checked squares lie 0.5 m apart.
Mesh long_plate() {
  return examples::sheet_mesh([](double x, double y) { return Vector3(8 * x, y, 0); }, 4, 2, 0.02,
                              test::steel());
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

// A closed tank has no outline, and that of a pipe no corners: their squares lie over the shells.
// Here they do on a ring of 2 m that is a pipe of 0.4 m, closed or cut across, and no place of it
// is farther than a spacing of 0.5 m and some from one.
TEST(SquareAbout, ClosedPlatingHasSquares) {
  constexpr int around = 24, across = 12;
  const auto place = [](double i, double j) {
    const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
    const double radius = 2 + 0.4 * std::cos(b);
    return Vector3(radius * std::cos(a), radius * std::sin(a), 0.4 * std::sin(b));
  };
  for (const int used : {around, around / 2}) {
    Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
    for (int i = 0; i < around; ++i)
      for (int j = 0; j < across; ++j) mesh.vertices.push_back(place(i, j));
    const auto vertex = [&](int i, int j) { return i % around * across + j % across; };
    for (int i = 0; i < used; ++i)
      for (int j = 0; j < across; ++j) {
        Shell shell;
        shell.vertices = {vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)};
        shell.curvature = static_cast<int>(mesh.curved_shells.size());
        mesh.shells.push_back(shell);
        Eigen::Matrix3Xd points(3, 9);
        for (int row = 0; row < 3; ++row)
          for (int column = 0; column < 3; ++column)
            points.col(3 * row + column) = place(i + 0.5 * column, j + 0.5 * row);
        mesh.curved_shells.push_back(points);
      }
    const PlateFields fields = find_fields(mesh);
    ASSERT_EQ(fields.fields.size(), 1U);
    EXPECT_EQ(fields.fields[0].outlines.size(), used == around ? 0U : 2U);
    const FieldWalker walker(mesh, fields);
    const std::vector<Square> squares = place_squares(mesh, fields, walker, asked_side);
    for (int i = 0; i <= used; ++i)
      for (int j = 0; j < across; ++j) {
        double nearest = 1e300;
        for (const Square& square : squares)
          nearest = std::min(nearest, (square.centre_B - place(i, j)).norm());
        EXPECT_LT(nearest, 0.7) << i << " " << j;
      }
    const Vector3 wanted = place(5.5, 3.2);
    const auto square = square_about(mesh, fields, walker, wanted, asked_side);
    ASSERT_TRUE(square.has_value());
    EXPECT_LT((square->centre_B - wanted).norm(), 0.01);
  }
}

}  // namespace
}  // namespace blocklift::structure
