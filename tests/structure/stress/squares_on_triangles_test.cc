// The checked stress of plates that are meshed by triangles.
#include <array>
#include <cmath>
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
  Mesh mesh = testing::sheet_mesh(
      [&](double x, double y) {
        return is_bent ? Vector3(4 * std::sin(x / 2), y, 4 * std::cos(x / 2))
                       : Vector3(2 * x, y, 0);
      },
      6, 3, 0.02, testing::steel());
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
