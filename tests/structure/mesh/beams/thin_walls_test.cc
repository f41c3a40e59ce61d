// Thin walls with cells against closed forms.

#include "structure/mesh/beams/thin_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "structure/error.h"

namespace blocklift::structure {
namespace {

using Vector2 = Eigen::Vector2d;

/// Two cells of width a and b and height h side by side, walls of six thicknesses.
struct TwoCells {
  double a = 0.6, b = 0.9, h = 0.5;
  double left = 0.01, middle = 0.02, right = 0.015, near = 0.008, far = 0.012;

  std::vector<Vector2> nodes() const {
    return {{0, 0}, {h, 0}, {h, a}, {0, a}, {h, a + b}, {0, a + b}};
  }
  std::vector<Wall> walls() const {
    return {{0, 1, left}, {1, 2, near},  {2, 3, middle}, {3, 0, near},
            {2, 4, far},  {4, 5, right}, {5, 3, far}};
  }
};

// Bredt's equations of two cells: each twists by the same, (q_1 S_1 - q_2 S_12) / (2 A_1) = G
// theta and so on; T = 2 (A_1 q_1 + A_2 q_2). Timoshenko and Goodier (1970), section 117.
TEST(ThinWalls, TorsionOfTwoCells) {
  const TwoCells cells;
  const double common = cells.h / cells.middle;
  Eigen::Matrix2d around;
  around << cells.h / cells.left + 2 * cells.a / cells.near + common, -common, -common,
      cells.h / cells.right + 2 * cells.b / cells.far + common;
  const Vector2 areas(cells.a * cells.h, cells.b * cells.h);
  const double torsion = 4 * areas.dot(around.inverse() * areas);
  std::vector<Wall> walls = cells.walls();
  EXPECT_NEAR(ThinWalls(cells.nodes(), walls).torsion(), torsion, 1e-12 * torsion);
  // In any order, drawn from either end.
  std::reverse(walls.begin(), walls.end());
  std::swap(walls[1].from, walls[1].to);
  EXPECT_NEAR(ThinWalls(cells.nodes(), walls).torsion(), torsion, 1e-12 * torsion);
}

// Walls that bound no cell add l t^3 / 3.
TEST(ThinWalls, FinsTwistByThemselves) {
  const std::vector<Vector2> nodes{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 2}};
  const double t = 0.02;
  const std::vector<Wall> box{{0, 1, t}, {1, 2, t}, {2, 3, t}, {3, 0, t}};
  std::vector<Wall> finned = box;
  finned.push_back({2, 4, t});
  const double alone = 4 / (4 / t);
  EXPECT_NEAR(ThinWalls({nodes.begin(), nodes.begin() + 4}, box).torsion(), alone, 1e-14);
  EXPECT_NEAR(ThinWalls(nodes, finned).torsion(), alone + t * t * t / 3, 1e-14);
}

// A wall in the middle of a box that bends about the axis through it bears no shear across itself;
// along itself it bears with the others: three equal webs at one height have a third each, but for
// what flows along the flanges.
TEST(ThinWalls, ShearOfTwoEqualCells) {
  TwoCells cells;
  cells.a = cells.b = 0.7;
  cells.left = cells.middle = cells.right = 0.01;
  cells.near = cells.far = 0.01;
  const ThinWalls both(cells.nodes(), cells.walls());
  EXPECT_NEAR(both.shear_centre()[0], cells.h / 2, 1e-12);
  EXPECT_NEAR(both.shear_centre()[1], 0.7, 1e-12);
  const ThinWalls box({{0, 0}, {cells.h, 0}, {cells.h, 1.4}, {0, 1.4}},
                      {{0, 1, 0.01}, {1, 2, 0.01}, {2, 3, 0.01}, {3, 0, 0.01}});
  EXPECT_NEAR(both.shear_area(1), box.shear_area(1), 1e-12);
  EXPECT_GT(both.shear_area(0), 1.3 * box.shear_area(0));
  EXPECT_LT(both.shear_area(0), 3 * 0.01 * cells.h);
  // A vanishing middle wall leaves the box.
  cells.middle = 1e-9;
  const ThinWalls nearly(cells.nodes(), cells.walls());
  EXPECT_NEAR(nearly.shear_area(0), box.shear_area(0), 1e-6 * box.shear_area(0));
  EXPECT_NEAR(nearly.torsion(), box.torsion(), 1e-6 * box.torsion());
}

// Timoshenko and Goodier (1970), section 125: a circular tube that is slit has its shear centre 2 r
// from its middle, on the side away from the slit.
TEST(ThinWalls, ASlitTubeHasItsShearCentreOutside) {
  constexpr int count = 400;
  constexpr double radius = 0.5, t = 0.001;
  std::vector<Vector2> nodes;
  std::vector<Wall> walls;
  for (int i = 0; i <= count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    nodes.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    if (i > 0) walls.push_back({i - 1, i, t});
  }
  const ThinWalls slit(nodes, walls);
  EXPECT_NEAR(slit.shear_centre()[0], -2 * radius, 1e-4);
  EXPECT_NEAR(slit.shear_centre()[1], 0, 1e-9);
  EXPECT_NEAR(slit.torsion(), 2 * std::numbers::pi * radius * t * t * t / 3, 1e-4 * slit.torsion());
}

TEST(ThinWalls, PartsThatHangTogetherByNothingAreRefused) {
  EXPECT_THROW(ThinWalls({{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {{0, 1, 0.1}, {2, 3, 0.1}}), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
