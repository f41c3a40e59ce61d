// Thin plates of triangles of three nodes, which lock by shear where their diagonals run towards a
// held corner.
#include <cmath>

#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {
namespace {

constexpr double pressure = 1000;  // Pa

struct PlateCase {
  double thickness = 0;
  bool is_clamped = false;
  double long_side = 1;  // over the short one
};

/// Deflection at the middle of a plate over q a^4 / D, by a quarter of it of n x n squares of two.
/// a, the short side, is 2 m. Diagonals run from the middle to the held corner.
double deflection(const PlateCase& plate, int n) {
  Mesh mesh = examples::sheet_mesh(
      [&](double x, double y) -> Vector3 {
        return {x, plate.long_side * y, 0};
      },
      n, n, plate.thickness, examples::plain_steel());
  examples::divide_into_triangles(mesh, true);
  const Material steel = examples::plain_steel();
  const ElasticModel model(std::move(mesh), {1, {}});
  const Space& space = model.space();
  const auto is_at = [](int component, double value) {
    return [=](const Vector3& place) { return std::abs(place[component] - value) < 1e-9; };
  };
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3&) { return true; }, {0, 1, 5}, fixed);
  examples::hold(space, is_at(0, 0), {4}, fixed);
  examples::hold(space, is_at(1, 0), {3}, fixed);
  const std::vector<int> by_rest = {2, 3, 4};
  examples::hold(space, is_at(0, 1), plate.is_clamped ? by_rest : std::vector<int>{2, 3}, fixed);
  examples::hold(space, is_at(1, plate.long_side),
                 plate.is_clamped ? by_rest : std::vector<int>{2, 4}, fixed);
  const Eigen::VectorXd load = examples::area_load(space, [](const Vector3&) -> Vector3 {
    return {0, 0, pressure};
  });
  const Eigen::VectorXd motion = examples::solve(space, load, fixed);
  const double rigidity = steel.youngs_modulus * std::pow(plate.thickness, 3) /
                          (12 * (1 - steel.poisson_ratio * steel.poisson_ratio));
  return examples::displacement_at(space, motion, {0, 0, 0}).z() * rigidity /
         (pressure * std::pow(2.0, 4));
}

// Timoshenko and Woinowsky-Krieger (1959), tables 8 and 35: 0.00406 q a^4 / D simply supported,
// 0.00126 clamped. With all of their shear these plates gave way a thousandth of it at a
// ten-thousandth of the half side.
TEST(TriangleBending, ThinPlatesDoNotLockByTheirDiagonals) {
  for (const double thickness : {1e-4, 0.02}) {
    EXPECT_NEAR(deflection({thickness, false}, 8), 0.00406, 0.03 * 0.00406) << thickness;
    EXPECT_NEAR(deflection({thickness, true}, 8), 0.00126, 0.03 * 0.00126) << thickness;
  }
}

// A plate of 1 x 5 is a strip in its middle: 0.01297 of table 8, and 1 / 384. Five times as long as
// wide, these triangles give way by 5.5 % too much where the plate is clamped.
TEST(TriangleBending, LongTrianglesDoNotLock) {
  EXPECT_NEAR(deflection({1e-4, false, 5}, 8), 0.01297, 0.03 * 0.01297);
  EXPECT_NEAR(deflection({1e-4, true, 5}, 8), 1.0 / 384, 0.06 / 384);
}

// What is taken from the shear goes with the square of the elements: so does the whole error.
TEST(TriangleBending, ConvergesWithTheSquareOfTheElements) {
  const double exact = 0.0040623527;  // Navier's series
  const double coarse = std::abs(deflection({1e-4, false}, 8) - exact),
               fine = std::abs(deflection({1e-4, false}, 16) - exact);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2);
}

}  // namespace
}  // namespace blocklift::structure
