// Decks of quadratic triangles (CTRIA6) that stand for curved plating, which must not lock.
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_solution.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

using std::numbers::pi;
using Chart = std::function<Vector3(double, double)>;
using Selects = std::function<bool(const Vector3&)>;

/// A sheet of 2 m n triangles with six nodes, whose diagonals run to and fro.
class Triangles {
 public:
  Triangles(const Chart& chart, int m, int n) {
    const auto at = [&](double x, double y) { return node(chart(x / m, y / n)); };
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1),
                  ab = at(i + 0.5, j), bc = at(i + 1, j + 0.5), cd = at(i + 0.5, j + 1),
                  da = at(i, j + 0.5), middle = at(i + 0.5, j + 0.5);
        if ((i + j) % 2 == 0) {
          add(a, b, c, ab, bc, middle);
          add(a, c, d, middle, cd, da);
        } else {
          add(a, b, d, ab, middle, da);
          add(b, c, d, bc, cd, middle);
        }
      }
  }

  int node(const Vector3& place) {
    const auto rounded = [](double x) { return std::lround(1e7 * x); };
    const auto [found, is_new] =
        numbers_.try_emplace({rounded(place.x()), rounded(place.y()), rounded(place.z())},
                             static_cast<int>(numbers_.size()) + 1);
    if (is_new) {
      places_[found->second] = place;
      cards_ += fmt::format("GRID*,{},,{:.13f},{:.13f}\n*,{:.13f}\n", found->second, place.x(),
                            place.y(), place.z());
    }
    return found->second;
  }

  void hold(const char* components, const Selects& selects) {
    for (const auto& [number, place] : places_)
      if (selects(place)) cards_ += fmt::format("SPC1,1,{},{}\n", components, number);
  }

  void load(const std::string& card) { cards_ += card; }

  /// Displacement and rotation at a node's place.
  Eigen::Matrix<double, 6, 1> motion(double modulus, double thickness, const Vector3& place) const {
    const Deck deck =
        test::nastran("SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n" + cards_ +
                      fmt::format("PSHELL,1,1,{:.10g},1,,1\nMAT1,1,{:.10g},,0.3,7850.\nENDDATA\n",
                                  thickness, modulus));
    Mesh mesh = deck.mesh;
    for (Material& material : mesh.materials) material.yield_stress = 235e6;
    const ElasticModel model(std::move(mesh), {2, {}});
    const DeckSolution solution = solve_deck(model, deck, 1);
    Eigen::Index nearest = 0;
    (model.space().nodes().colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
    return solution.cases.at(0).motion.segment<6>(6 * nearest);
  }

 private:
  void add(int a, int b, int c, int ab, int bc, int ca) {
    cards_ += fmt::format("CTRIA6,{},1,{},{},{},{},{},{}\n", ++triangles_, a, b, c, ab, bc, ca);
  }

  std::map<std::array<long, 3>, int> numbers_;
  std::map<int, Vector3> places_;
  std::string cards_;
  int triangles_ = 0;
};

// NAFEMS (1990), LE2: a sixth of a half pipe of 1 m, clamped along one generator, moments along the
// other. It bends evenly as a wide beam: its end turns by 12 (1 - nu^2) M phi R / E t^3. Linear
// ties, and triangles that lock, turned by 0.75 of it at 10 mm.
TEST(CurvedTriangles, PipeBendsByMomentsAlongItsGenerator) {
  constexpr double angle = pi / 6, breadth = 0.5, modulus = 210e9;
  for (const double thickness : {0.01, 0.001}) {
    SCOPED_TRACE(thickness);
    Triangles pipe(
        [](double x, double y) -> Vector3 {
          return {std::sin(angle * x), breadth * y, std::cos(angle * x)};
        },
        3, 2);
    pipe.hold("123456", [](const Vector3& p) { return p.x() < 1e-6; });
    pipe.hold("246", [](const Vector3& p) {
      return p.x() > 1e-6 && (p.y() < 1e-6 || p.y() > breadth - 1e-6);
    });
    const double moment = 1e9 * std::pow(thickness, 3);  // for each metre
    for (const auto& [y, share] :
         {std::pair(0.0, 1.0), {0.125, 4.0}, {0.25, 2.0}, {0.375, 4.0}, {0.5, 1.0}})
      pipe.load(fmt::format("MOMENT,2,{},,{:.10g},0.,1.,0.\n",
                            pipe.node({std::sin(angle), y, std::cos(angle)}),
                            moment * breadth * share / 12));
    const double expected =
        12 * (1 - 0.3 * 0.3) * moment * angle / (modulus * std::pow(thickness, 3));
    const Eigen::Matrix<double, 6, 1> end =
        pipe.motion(modulus, thickness, {std::sin(angle), 0.25, std::cos(angle)});
    EXPECT_NEAR(end[4], expected, 0.01 * expected);
  }
}

// MacNeal and Harder (1985): a quarter of a hemisphere of 10 m, 40 mm thick, with a hole of 18
// degrees, pulled and pushed at its rim; 0.0935 m by fine meshes (Simo, Fox, Rifai 1989). With
// 8 x 8 squares of two triangles it is 0.0878.
TEST(CurvedTriangles, HemisphereWithAHoleIsPulledOutOfRound) {
  for (const auto& [cells, tolerance] : {std::pair(8, 0.07)}) {
    SCOPED_TRACE(cells);
    constexpr double height = 72 * pi / 180;
    Triangles quarter(
        [](double x, double y) -> Vector3 {
          const double a = pi / 2 * x, b = height * y;
          return {10 * std::cos(b) * std::cos(a), 10 * std::cos(b) * std::sin(a), 10 * std::sin(b)};
        },
        cells, cells);
    quarter.hold("156", [](const Vector3& p) { return p.x() < 1e-6; });
    quarter.hold("246", [](const Vector3& p) { return p.y() < 1e-6; });
    quarter.hold("3", [](const Vector3& p) { return p.x() > 10 - 1e-6; });
    // The published figures are of 6.825e7 Pa and 1 N: a thousand times both are no other model.
    quarter.load(fmt::format("FORCE,2,{},,1000.,1.,0.,0.\nFORCE,2,{},,1000.,0.,-1.,0.\n",
                             quarter.node({10, 0, 0}), quarter.node({0, 10, 0})));
    const Eigen::Matrix<double, 6, 1> pulled = quarter.motion(6.825e10, 0.04, {10, 0, 0});
    EXPECT_NEAR(pulled[0], 0.0935, tolerance * 0.0935);
  }
}

}  // namespace
}  // namespace blocklift::structure
