// The estimated error of triangles that lock, against that of their displacement.
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/accuracy/block_error.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {
namespace {

// A strip of 12 x 1.1, 0.0032 thick, twisted by a right angle and pushed at its end along its width:
// 5256e-6 under a force of 1e-6 (Belytschko, Wong and Stolarski 1989, Int. J. Numer. Methods Eng.
// 28, 385-414). Facets of 24 x 4 squares of two hold one another by their drilling, which is nearly
// all of the error.
TEST(ErrorOfTriangles, DrillingThatHoldsFacetsIsPartOfIt) {
  constexpr double length = 12, width = 1.1, force = 1e-6, published = 5256e-6;
  Mesh mesh = examples::sheet_mesh(
      [](double x, double y) -> Vector3 {
        const double turn = std::numbers::pi / 2 * x, across = width * (y - 0.5);
        return {length * x, across * std::sin(turn), across * std::cos(turn)};
      },
      24, 4, 0.0032, {"unit", 29e6, 0.22, 1, 1});
  examples::divide_into_triangles(mesh, true);
  const ElasticModel model(std::move(mesh), {1, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      model.space(), [](const Vector3& p) { return std::abs(p.x()) < 1e-9; }, {0, 1, 2, 3, 4, 5},
      fixed);
  const Eigen::VectorXd load = examples::edge_load(
      model.space(), [](const Vector3& p) { return p.x() > length - 1e-9; },
      [](const Vector3&) -> Vector3 {
        return {0, force / width, 0};
      });
  const Eigen::VectorXd motion = examples::solve(model.space(), load, fixed);
  const double lacking = 1 - motion.dot(load) / (force * published);
  const double said = estimate_block_error(model, motion).relative;
  EXPECT_GT(said, 0.8 * std::sqrt(lacking));
  EXPECT_LT(said, 1.25 * std::sqrt(lacking));
}

}  // namespace
}  // namespace blocklift::structure
