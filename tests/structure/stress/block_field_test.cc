// Motion and stress at places within a block's plates.
#include "structure/stress/block_field.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/error.h"
#include "structure/stress/shell_stress.h"
#include "tests/structure/motions.h"

namespace blocklift::structure {
namespace {

using Motion6 = Eigen::Matrix<double, 6, 1>;

constexpr double thickness = 0.02;

Eigen::Isometry3d tilt() {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.rotate(Eigen::AngleAxisd(0.7, Vector3(1, 2, -0.5).normalized()));
  X.pretranslate(Vector3(3, -1, 2));
  return X;
}

Mesh flat_plate(int m, int n) {
  return examples::sheet_mesh([](double x, double y) { return Vector3(2 * x, y, 0); }, m, n,
                              thickness, examples::plain_steel());
}

/// Stretching with a bending that is uniform, in the plate's own axes:
/// u = (s x - k x z, -nu s y, w), w = k x^2 / 2, theta = (0, -k x, 0).
Motion6 stretch_and_bend(const Vector3& p, double stretch, double curvature) {
  Motion6 motion;
  motion << stretch * p.x(), -0.3 * stretch * p.y(), curvature * p.x() * p.x() / 2, 0,
      -curvature * p.x(), 0;
  return motion;
}

class TiltedPlate : public ::testing::TestWithParam<int> {
 protected:
  TiltedPlate() : model_(test::moved(flat_plate(4, 2), tilt()), {GetParam(), {}}) {
    motion_ = test::motion_of(model_.space(), [](const Vector3& place) -> Motion6 {
      Motion6 own = stretch_and_bend(tilt().inverse() * place, 1e-4, 2e-3);
      own << tilt().linear() * Vector3(own.head<3>()), tilt().linear() * Vector3(own.tail<3>());
      return own;
    });
  }
  ElasticModel model_;
  Eigen::VectorXd motion_;
};

// Hooke's law in the plane: s_11 = E s - E / (1 - nu^2) k z, s_22 = -nu E / (1 - nu^2) k z; the
// uniform bending has no shear, which elements of degree 2 and more hold exactly.
TEST_P(TiltedPlate, StressAtAHeightIsHookesLaw) {
  const Material steel = examples::plain_steel();
  const double e = steel.youngs_modulus, nu = steel.poisson_ratio;
  for (const double z : {-0.01, -0.004, 0.0, 0.01})
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(0.31, 0.2), Eigen::Vector2d(1.5, 0.5)}) {
      const SteelPlace place = find_cell(model_.space(), tilt() * Vector3(p.x(), p.y(), z));
      ASSERT_GE(place.cell, 0);
      EXPECT_NEAR(place.height, z, 1e-12);
      const Stress found = stresses_at(model_, motion_, place);
      Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
      expected(0, 0) = 1e-4 * e - e / (1 - nu * nu) * 2e-3 * z;
      expected(1, 1) = -nu * e / (1 - nu * nu) * 2e-3 * z;
      expected = (tilt().linear() * expected * tilt().linear().transpose()).eval();
      const double tolerance = 1e-7 * 1e-4 * e;
      EXPECT_NEAR(found[0], expected(0, 0), tolerance);
      EXPECT_NEAR(found[1], expected(1, 1), tolerance);
      EXPECT_NEAR(found[2], expected(2, 2), tolerance);
      EXPECT_NEAR(found[3], expected(0, 1), tolerance);
      EXPECT_NEAR(found[4], expected(1, 2), tolerance);
      EXPECT_NEAR(found[5], expected(2, 0), tolerance);
    }
}

TEST_P(TiltedPlate, MovesOffItsMiddleAsItsSectionsTurn) {
  const double z = 0.009;
  const Vector3 own(1.3, 0.7, z);
  const Eigen::MatrixXd found = displacements_at(model_, motion_, tilt() * own);
  Vector3 expected = stretch_and_bend(own, 1e-4, 2e-3).head<3>();
  expected.x() -= 2e-3 * own.x() * z;
  EXPECT_LT((found - tilt().linear() * expected).norm(), 1e-12);
}

TEST_P(TiltedPlate, EndsAtItsSurfacesAndEdges) {
  for (const Vector3& outside : {Vector3(1, 0.5, 0.0102), Vector3(1, 0.5, -0.0102),
                                 Vector3(-1e-3, 0.5, 0), Vector3(1, 1.001, 0), Vector3(40, 0, 0)})
    EXPECT_LT(find_cell(model_.space(), tilt() * outside).cell, 0) << outside.transpose();
  for (const Vector3& edge : {Vector3(0, 0, 0.01), Vector3(2, 1, -0.01), Vector3(2, 0.4, 0)})
    EXPECT_GE(find_cell(model_.space(), tilt() * edge).cell, 0) << edge.transpose();
  EXPECT_THROW(displacements_at(model_, motion_, tilt() * Vector3(1, 0.5, 0.02)), ModelError);
}

INSTANTIATE_TEST_SUITE_P(BlockField, TiltedPlate, ::testing::Values(2, 3, 4));

/// A deck on z = 0 with a lug, y = 0.5, standing on it.
Mesh deck_with_lug() {
  Mesh mesh = flat_plate(2, 2);
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0.5, 0.5);
  mesh.vertices.emplace_back(1, 0.5, 0.5);
  const auto vertex_at = [&](const Vector3& place) {
    for (int v = 0; v < first; ++v)
      if ((mesh.vertices[v] - place).norm() < 1e-9) return v;
    return -1;
  };
  mesh.shell_sections.push_back({0.05, 0, 0});
  mesh.shells.push_back({{vertex_at({0, 0.5, 0}), vertex_at({1, 0.5, 0}), first, first + 1},
                         static_cast<int>(mesh.shell_sections.size()) - 1,
                         0,
                         -1,
                         0});
  return mesh;
}

// The foot of a padeye: at a place within deck and lug the plate is meant that its own is.
TEST(BlockField, WherePlatesMeetTheNormalTellsWhichIsMeant) {
  const ElasticModel model(deck_with_lug(), {2, {}});
  const SteelFinder finder(model.space());
  const int lug = static_cast<int>(model.mesh().shells.size()) - 1;
  const auto shell_at = [&](const Vector3& place, const Vector3& normal) {
    const SteelPlace found = finder.find(place, normal);
    return found.cell < 0 ? -1 : model.space().shells()[found.cell].shell;
  };
  const Vector3 foot(0.5, 0.52, 0);
  EXPECT_EQ(shell_at(foot, Vector3::UnitY()), lug);
  EXPECT_EQ(shell_at(foot, -Vector3::UnitY()), lug);
  EXPECT_NE(shell_at(foot, Vector3::UnitZ()), lug);
  EXPECT_NE(shell_at(foot, Vector3::Zero()), lug);               // on the deck's middle
  EXPECT_EQ(shell_at({0.5, 0.52, 0.2}, Vector3::UnitZ()), lug);  // no other is there
  // A rigid motion is the same from either plate.
  const Vector3 turn(1e-3, -2e-3, 3e-3);
  const Eigen::VectorXd rigid = test::motion_of(model.space(), [&](const Vector3& p) {
    Motion6 motion;
    motion << turn.cross(p), turn;
    return motion;
  });
  for (const Vector3& normal : {Vector3(0, 1, 0), Vector3(0, 0, 1)})
    EXPECT_LT((displacements_at(model, rigid, foot, normal) - turn.cross(foot)).norm(), 1e-14);
}

// A triangle is a square with one edge shrunk to a point: a uniform strain is met there, too.
TEST(ShellStress, UniformStrainIsMetInEveryPointOfATriangle) {
  Mesh mesh = flat_plate(1, 1);
  mesh.shells = {{{0, 1, 2, 2}, 0, 0, -1, 1}, {{3, 2, 1, 1}, 0, 0, -1, 2}};
  const double e = examples::plain_steel().youngs_modulus;
  for (const int degree : {1, 2, 3}) {
    const ElasticModel model(mesh, {degree, {}});
    const Eigen::VectorXd motion = test::motion_of(
        model.space(), [](const Vector3& p) { return stretch_and_bend(p, 1e-4, 0); });
    Eigen::Matrix2Xd corners(2, 4);
    corners << 0, 1, 0, 1, 0, 0, 1, 1;
    ShellStress stress(model.space(), corners);
    for (int cell = 0; cell < 2; ++cell) {
      const Eigen::VectorXd rows = stress.of_all(cell, motion);
      for (Eigen::Index q = 0; q < 4; ++q) {
        const PlateVonMises found =
            plate_von_mises(rows.segment<shell_stress_rows>(shell_stress_rows * q));
        EXPECT_NEAR(found.membrane, 1e-4 * e, 1e-6 * e * 1e-4) << "degree " << degree;
        EXPECT_NEAR(found.largest(), 1e-4 * e, 1e-6 * e * 1e-4) << "degree " << degree;
      }
    }
  }
}

}  // namespace
}  // namespace blocklift::structure
