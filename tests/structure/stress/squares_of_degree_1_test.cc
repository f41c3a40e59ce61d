// The checked stress of plates whose elements are bilinear.
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/stress/squares.h"

namespace blocklift::structure {
namespace {

// A plate of 1 x 0.4 m that lies askew and bends in its plane: u = k x y, v = -k x^2 / 2 at the
// nodes. Between them a bilinear cell has a shear k (x - x_middle), which its stiffness does not
// have and the checked stress neither.
TEST(SquaresOfDegree1, HaveNoShearWhereAPlateBendsInItsPlane) {
  const Vector3 a = Vector3(2, 1, 2) / 3, b = Vector3(-2, 2, 1) / 3;
  const double curvature = 1e-4, half = 0.2;  // 1/m, m
  for (const int cells : {1, 2, 3}) {
    const ElasticModel model(
        examples::sheet_mesh([&](double x, double y) -> Vector3 { return x * a + 0.4 * y * b; },
                             cells, 1, 0.02, examples::plain_steel()),
        {1, {}});
    Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(model.freedoms(), 1);
    for (int n = 0; n < model.space().node_count(); ++n) {
      const Vector3 place = model.space().nodes().col(n);
      const double x = place.dot(a), y = place.dot(b) - half;
      motion.col(0).segment<3>(6 * n) = curvature * (x * y * a - x * x / 2 * b);
    }
    const CheckedStress checked(model, motion);
    ASSERT_GT(checked.squares().size(), 10U);
    for (std::size_t s = 0; s < checked.squares().size(); ++s) {
      const Square& square = checked.squares()[s];
      const Vector3 c = checked.components().col(0).segment<3>(3 * static_cast<Eigen::Index>(s));
      const Eigen::Matrix3d stress =
          c[0] * square.e_1 * square.e_1.transpose() + c[1] * square.e_2 * square.e_2.transpose() +
          c[2] * (square.e_1 * square.e_2.transpose() + square.e_2 * square.e_1.transpose());
      // A bilinear cell does not grow narrower where it is longer: s_22 = nu s_11.
      const double along = 210e9 / (1 - 0.09) * curvature * (square.centre_B.dot(b) - half);
      const Eigen::Matrix3d expected = along * (a * a.transpose() + 0.3 * b * b.transpose());
      EXPECT_LT((stress - expected).norm(), 1e-6 * 210e9 * curvature) << cells << " cells";
    }
  }
}

// A warped plate turns as a rigid body: z = x (y - 0.2) / 2. Along one plane of a cell its rotation
// would have a shear of some hundredths. What is left is how far the plate bulges from the plane of
// a square of 50 mm: 1.3e-5 of the rotation by the same integral over squares of this surface.
TEST(SquaresOfDegree1, HaveNoStressWhereAWarpedPlateTurns) {
  const Vector3 rotation(0.3, 0.5, 0.8);
  const ElasticModel model(examples::sheet_mesh(
                               [](double x, double y) -> Vector3 {
                                 return Vector3(x, 0.4 * y, x * (0.4 * y - 0.2) / 2);
                               },
                               2, 1, 0.02, examples::plain_steel()),
                           {1, {}});
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(model.freedoms(), 1);
  for (int n = 0; n < model.space().node_count(); ++n) {
    motion.col(0).segment<3>(6 * n) = rotation.cross(Vector3(model.space().nodes().col(n)));
    motion.col(0).segment<3>(6 * n + 3) = rotation;
  }
  const CheckedStress checked(model, motion);
  ASSERT_GT(checked.squares().size(), 10U);
  EXPECT_LT(checked.components().cwiseAbs().maxCoeff(), 4e-5 * 210e9);
}

}  // namespace
}  // namespace blocklift::structure
