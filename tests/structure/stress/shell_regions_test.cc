// The outer shell of blocks of any direction.
#include "structure/stress/shell_regions.h"

#include <numbers>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/error.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/system/matter.h"
#include "tests/structure/hull_block.h"
#include "tests/structure/motions.h"

namespace blocklift::structure {
namespace {

/// Closed box of 4 x 2 x 1 m about the frame's origin with a bulkhead, and a lug on its deck.
Mesh box_with_bulkhead() {
  BlockDescription block;
  block.materials = {test::steel()};
  const std::array<Interval, 3> all = {{{-2, 2}, {-1, 1}, {-0.5, 0.5}}};
  block.plates = {{"level", Axis::z, {-0.5, 0.5}, all, 0.01, "AH36"},
                  {"sides", Axis::y, {-1, 1}, all, 0.01, "AH36"},
                  {"across", Axis::x, {-2, 0, 2}, all, 0.01, "AH36"}};
  block.pads = {{"pad", "across", Axis::x, 0, {{{}, {-0.3, 0.3}, {0, 0.5}}}, 0.02, ""}};
  block.lugs = {{"L", "pad", Axis::x, 0, {{{}, {-0.3, 0.3}, {0.5, 0.9}}}, 0.02, "", {0, 0, 0.8}}};
  block.largest_element = 0.7;
  return generate_shell_mesh(block);
}

double area_of(const Space& space, const std::vector<int>& cells) {
  double area = 0;
  for_each_shell_point(space, cells,
                       [&](const MatterPoint& point) { area += point.volume / 0.01; });
  return area;
}

TEST(ShellRegions, OuterPlatesOfATurnedBoxMakeTheShell) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  for (const double angle : {0.0, 0.5, std::numbers::pi / 4}) {
    X.linear() = Eigen::AngleAxisd(angle, Vector3(0.3, 0.1, 1).normalized()).toRotationMatrix();
    const ElasticModel model(test::moved(box_with_bulkhead(), X), {1, {}});
    const ShellRegions shell(model, 100);
    std::array<double, 6> areas{};
    for (const ShellRegion& region : shell.regions()) {
      const Vector3 outward = X.linear().transpose() * region.outward_B,
                    centre = X.linear().transpose() * region.centre_B;
      Eigen::Index axis = 0;
      EXPECT_NEAR(outward.cwiseAbs().maxCoeff(&axis), 1, 1e-9);
      const double side = outward[axis];
      const Vector3 half_size(2, 1, 0.5);
      EXPECT_NEAR(side * centre[axis], half_size[axis], 1e-9);  // not the bulkhead, nor the lug
      areas[2 * axis + (side > 0 ? 1 : 0)] += area_of(model.space(), region.cells);
    }
    for (std::size_t face = 0; face < 6; ++face)
      EXPECT_NEAR(areas[face], (std::array{2.0, 4.0, 8.0}[face / 2]), 1e-9) << face;
    // A place outside belongs to the face that it lies before and that looks its way.
    const auto& above = shell.regions()[shell.nearest(
        X * Vector3(1.9, 0.2, 0.7), X.linear() * Vector3(0.5, 0, 1).normalized())];
    EXPECT_NEAR((X.linear().transpose() * above.outward_B).z(), 1, 1e-9);
    const auto& end =
        shell.regions()[shell.nearest(X * Vector3(1.9, 0.2, 0.7), X.linear() * Vector3::UnitX())];
    EXPECT_NEAR((X.linear().transpose() * end.outward_B).x(), 1, 1e-9);
  }
}

TEST(ShellRegions, LoadsHaveTheWrenchesOfTheirRegions) {
  const ElasticModel model(box_with_bulkhead(), {2, {}});
  const ShellRegions shell(model, 0.9);
  const auto count = static_cast<Eigen::Index>(shell.regions().size());
  const Eigen::MatrixXd wrenches = Eigen::MatrixXd::Random(6 * count, 2);
  const Eigen::MatrixXd loads = shell.loads(wrenches);
  for (Eigen::Index k = 0; k < 2; ++k) {
    Wrench expected;
    for (Eigen::Index r = 0; r < count; ++r) {
      const Vector3 force = wrenches.col(k).segment<3>(6 * r);
      expected.force += force;
      expected.moment +=
          wrenches.col(k).segment<3>(6 * r + 3) + shell.regions()[r].centre_B.cross(force);
    }
    const Wrench found = resultant(model.space(), loads.col(k));
    EXPECT_LT((found.force - expected.force).norm(), 1e-10);
    EXPECT_LT((found.moment - expected.moment).norm(), 1e-10);
  }
  EXPECT_THROW(ShellRegions(model, 0), ModelError);
}

// A cylinder without ends: outside and inside of each cell look at nothing and at the opposite
// wall.
TEST(ShellRegions, CurvedPlatingIsOutsideOnItsConvexSide) {
  const Mesh mesh = examples::sheet_mesh(
      [](double x, double y) {
        const double angle = 2 * std::numbers::pi * y;
        return Vector3(3 * x, std::cos(angle), std::sin(angle));
      },
      3, 12, 0.01, examples::plain_steel(), 3);
  const ElasticModel model(mesh, {3, {}});
  const ShellRegions shell(model, 1.1);
  double area = 0;
  for (const ShellRegion& region : shell.regions()) {
    area += area_of(model.space(), region.cells);
    EXPECT_GT(
        region.outward_B.dot(Vector3(0, region.centre_B.y(), region.centre_B.z()).normalized()),
        0.99);
  }
  // Each cell once: 12 arcs of order 3 are round to 1e-5.
  EXPECT_NEAR(area, 2 * std::numbers::pi * 3, 1e-3);
}

}  // namespace
}  // namespace blocklift::structure
