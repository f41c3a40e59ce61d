// The checked stress of plates that are meshed by triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/stress/squares.h"

namespace blocklift::structure {
namespace {

/// A plate of 2 x 1 m, its squares cut along one diagonal or the other, each triangle beginning at
/// another vertex; flat or bent about a cylinder of 4 m.
Mesh triangulated_plate(int variant, bool is_bent) {
  Mesh mesh = examples::sheet_mesh(
      [&](double x, double y) {
        return is_bent ? Vector3(4 * std::sin(x / 2), y, 4 * std::cos(x / 2))
                       : Vector3(2 * x, y, 0);
      },
      6, 3, 0.02, test::steel());
  const std::vector<Shell> squares = std::move(mesh.shells);
  mesh.shells.clear();
  for (std::size_t s = 0; s < squares.size(); ++s) {
    const auto& v = squares[s].vertices;
    const bool other = (s + static_cast<std::size_t>(variant)) % 2 == 0;
    const std::array<std::array<int, 3>, 2> halves =
        other ? std::array<std::array<int, 3>, 2>{{{v[0], v[1], v[3]}, {v[3], v[2], v[0]}}}
              : std::array<std::array<int, 3>, 2>{{{v[0], v[1], v[2]}, {v[1], v[3], v[2]}}};
    for (const std::array<int, 3>& half : halves) {
      const std::size_t first = (s + static_cast<std::size_t>(variant)) % 3;
      Shell shell = squares[s];
      shell.curvature = -1;
      shell.vertices = {half[first], half[(first + 1) % 3], half[(first + 2) % 3],
                        half[(first + 2) % 3]};
      mesh.shells.push_back(shell);
    }
  }
  return mesh;
}

// A plate that is stretched evenly has that stress in each of its squares, whatever its triangles.
TEST(SquaresOnTriangles, HaveTheStressOfAnEvenStretch) {
  for (const int degree : {2, 3})
    for (const int variant : {0, 1, 2, 3, 4, 5}) {
      const ElasticModel model(triangulated_plate(variant, false), {degree, {}});
      Eigen::MatrixXd u = Eigen::MatrixXd::Zero(model.freedoms(), 1);
      for (int n = 0; n < model.space().node_count(); ++n) {
        const Vector3 x = model.space().nodes().col(n);
        u.col(0).segment<3>(6 * n) << 1e-4 * x.x(), -0.3e-4 * x.y(), 0;
      }
      const CheckedStress checked(model, u);
      ASSERT_GT(checked.squares().size(), 20U);
      for (const double stress : Eigen::VectorXd(checked.von_mises(Eigen::VectorXd::Ones(1))))
        EXPECT_NEAR(stress, 206e9 * 1e-4, 1e-3) << "degree " << degree << ", variant " << variant;
    }
}

// Every place over a plate is found from every shell of it, beyond the vertices that triangles end
// in as well, and none beside it is.
TEST(SquaresOnTriangles, PlacesAreFoundFromAnywhere) {
  for (const int variant : {0, 1, 2}) {
    const Mesh mesh = triangulated_plate(variant, false);
    const PlateFields fields = find_fields(mesh);
    const FieldWalker walker(mesh, fields);
    for (int shell = 0; shell < static_cast<int>(mesh.shells.size()); ++shell)
      for (const double x : {0.013, 0.71, 1.333, 1.99})
        for (const double y : {0.001, 0.333, 0.52, 0.98}) {
          const auto found = walker.find({x, y, 0}, {shell, {0.5, 0.5}});
          ASSERT_TRUE(found) << x << ", " << y << " from " << shell;
          EXPECT_LT(
              (position(mesh, mesh.shells[found->shell], found->xi) - Vector3(x, y, 0)).norm(),
              1e-5);
        }
    EXPECT_FALSE(walker.find({2.1, 0.5, 0}, {0, {0.5, 0.5}}));
    EXPECT_FALSE(walker.find({1, -0.1, 0}, {0, {0.5, 0.5}}));
  }
}

/// A quarter of a ring of radii 0.2 and 0.3 m, cut into flat triangles with curved edges, 4 mm by
/// 13 to 20 mm.
Mesh triangulated_ring() {
  constexpr int cuts = 24;
  const auto on_ring = [](double i, double j) -> Vector3 {
    const double radius = 0.2 + 0.1 * i / cuts, angle = 0.5 * std::numbers::pi * j / cuts;
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
  };
  Mesh mesh = examples::sheet_mesh([&](double x, double y) { return on_ring(cuts * x, cuts * y); },
                                   cuts, cuts, 0.02, test::steel());
  const Shell like = mesh.shells.front();
  mesh.shells.clear();
  mesh.curved_shells.clear();
  using Corner = std::array<int, 2>;
  const auto add = [&](const Corner& a, const Corner& b, const Corner& c) {
    const auto vertex = [&](const Corner& corner) {
      const Vector3 place = on_ring(corner[0], corner[1]);
      const auto is_there = [&](const Vector3& other) { return (other - place).norm() < 1e-9; };
      return static_cast<int>(std::find_if(mesh.vertices.begin(), mesh.vertices.end(), is_there) -
                              mesh.vertices.begin());
    };
    const auto node = [&](const Corner& from, const Corner& to) {
      return on_ring(0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]));
    };
    Eigen::Matrix3Xd points(3, 9);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        // Shares of a, b and c, and the quadratic triangle's shape functions of them.
        const double s_c = 0.5 * j, s_b = 0.5 * i * (1 - s_c), s_a = 1 - s_b - s_c;
        points.col(3 * j + i) = s_a * (2 * s_a - 1) * node(a, a) +
                                s_b * (2 * s_b - 1) * node(b, b) +
                                s_c * (2 * s_c - 1) * node(c, c) + 4 * s_a * s_b * node(a, b) +
                                4 * s_b * s_c * node(b, c) + 4 * s_c * s_a * node(c, a);
      }
    Shell shell = like;
    shell.vertices = {vertex(a), vertex(b), vertex(c), vertex(c)};
    shell.curvature = static_cast<int>(mesh.curved_shells.size());
    mesh.curved_shells.push_back(std::move(points));
    mesh.shells.push_back(shell);
  };
  for (int i = 0; i < cuts; ++i)
    for (int j = 0; j < cuts; ++j) {
      add({i, j}, {i + 1, j}, {i + 1, j + 1});
      add({i, j}, {i + 1, j + 1}, {i, j + 1});
    }
  return mesh;
}

// Over many small cells with curved edges the way to a place is found, too, and squares of 50 mm
// lie all along the hole.
TEST(SquaresOnTriangles, LieOnFineTrianglesWithCurvedEdges) {
  const Mesh mesh = triangulated_ring();
  const PlateFields fields = find_fields(mesh);
  ASSERT_EQ(fields.fields.size(), 1U);
  const FieldWalker walker(mesh, fields);
  const auto ring = [](double radius, double angle) -> Vector3 {
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
  };
  for (int shell = 0; shell < static_cast<int>(mesh.shells.size()); shell += 7) {
    const Vector3 start = position(mesh, mesh.shells[shell], {0.5, 0.5});
    const double angle = std::atan2(start.y(), start.x());
    for (const double radius : {0.203, 0.231, 0.268, 0.297})
      for (const double off : {-0.1, 0.0, 0.1}) {
        if (angle + off < 0.01 || angle + off > 0.5 * std::numbers::pi - 0.01) continue;
        const auto found = walker.find(ring(radius, angle + off), {shell, {0.5, 0.5}});
        ASSERT_TRUE(found) << radius << ", " << angle + off << " from " << shell;
        EXPECT_LT((position(mesh, mesh.shells[found->shell], found->xi) - ring(radius, angle + off))
                      .norm(),
                  1e-6);
      }
  }
  int beside_hole = 0;
  for (const Square& square : place_squares(mesh, fields, walker, 0.05))
    if (square.centre_B.norm() < 0.23) ++beside_hole;
  EXPECT_GE(beside_hole, 5);
}

// Facets of a cylinder that is pulled along its axis.
TEST(SquaresOnTriangles, LieOnFacetsOfACylinder) {
  const ElasticModel model(triangulated_plate(1, true), {3, {}});
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(model.freedoms(), 1);
  for (int n = 0; n < model.space().node_count(); ++n)
    u(6 * n + 1, 0) = 1e-4 * model.space().nodes()(1, n);
  const CheckedStress checked(model, u);
  ASSERT_GT(checked.squares().size(), 20U);
  // Held across: s_1 = E e / (1 - nu^2), s_2 = nu s_1.
  const double along = 206e9 * 1e-4 / (1 - 0.09);
  const double expected = along * std::sqrt(1 - 0.3 + 0.09);
  for (const double stress : Eigen::VectorXd(checked.von_mises(Eigen::VectorXd::Ones(1))))
    EXPECT_NEAR(stress, expected, 1e-3 * expected);
}

}  // namespace
}  // namespace blocklift::structure
