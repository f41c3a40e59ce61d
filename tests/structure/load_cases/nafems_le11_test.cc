// NAFEMS LE11: a solid that is a cylinder, a taper and a sphere, warmed along radius and axis.
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "structure/formulation/solid.h"
#include "structure/load_cases/deck_heat.h"
#include "structure/load_cases/deck_solution.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

/// Place (radius, height) in a patch of the half section, from 0 to 1 along it and through it.
using Patch = std::function<Eigen::Vector2d(double along, double through)>;

Patch between(const Eigen::Vector2d& inner_begin, const Eigen::Vector2d& inner_end,
              const Eigen::Vector2d& outer_begin, const Eigen::Vector2d& outer_end) {
  return [=](double along, double through) -> Eigen::Vector2d {
    return (1 - through) * ((1 - along) * inner_begin + along * inner_end) +
           through * ((1 - along) * outer_begin + along * outer_end);
  };
}

/// A quarter of the body in elements with 20 nodes: 4 by 2 by 4 n in the sphere, and so on.
class HotBodyOfRevolution {
 public:
  explicit HotBodyOfRevolution(int n) : n_(n) {
    const double s = std::sqrt(0.5), waist = s + 0.69, top = waist + 0.4;
    add(4, [s](double along, double through) -> Eigen::Vector2d {
      const double inner = along * std::numbers::pi / 4, outer = along * std::asin(s / 1.4);
      return (1 - through) * Eigen::Vector2d(std::cos(inner), std::sin(inner)) +
             1.4 * through * Eigen::Vector2d(std::cos(outer), std::sin(outer));
    });
    add(5, between({s, s}, {s, waist}, {std::sqrt(1.96 - 0.5), s}, {1, waist}));
    add(2, between({s, waist}, {s, top}, {1, waist}, {1, top}));
    finish(top);
  }

  const std::string& text() const { return text_; }

 private:
  void add(int along, const Patch& patch) {
    for (int i = 0; i < along * n_; ++i)
      for (int j = 0; j < 2 * n_; ++j)
        for (int k = 0; k < 4 * n_; ++k)
          add_solid([&](const Vector3& local) -> Vector3 {
            const Eigen::Vector2d at =
                patch((i + local.x()) / (along * n_), (j + local.y()) / (2 * n_));
            const double angle = std::numbers::pi / 2 * (k + local.z()) / (4 * n_);
            return {at[0] * std::cos(angle), at[0] * std::sin(angle), at[1]};
          });
  }

  void add_solid(const std::function<Vector3(const Vector3&)>& place) {
    static constexpr std::array<std::array<double, 3>, 20> nodes{
        {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0},  {0, 0, 1},  {1, 0, 1},  {1, 1, 1},
         {0, 1, 1},  {.5, 0, 0}, {1, .5, 0}, {.5, 1, 0}, {0, .5, 0}, {.5, 0, 1}, {1, .5, 1},
         {.5, 1, 1}, {0, .5, 1}, {0, 0, .5}, {1, 0, .5}, {1, 1, .5}, {0, 1, .5}}};
    elements_ += std::to_string(++solids_);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      elements_ += fmt::format("{}{}", i == 10 ? ",\n" : ", ",
                               node(place({nodes[i][0], nodes[i][1], nodes[i][2]})));
    elements_ += '\n';
  }

  int node(const Vector3& place) {
    const auto rounded = [](double x) { return std::lround(1e7 * x); };
    const auto [found, is_new] =
        known_.try_emplace({rounded(place.x()), rounded(place.y()), rounded(place.z())},
                           static_cast<int>(known_.size()) + 1);
    if (is_new)
      nodes_ += fmt::format("{}, {:.12f}, {:.12f}, {:.12f}\n", found->second, place.x(), place.y(),
                            place.z());
    return found->second;
  }

  void finish(double top) {
    text_ = "*NODE\n" + nodes_ + "*ELEMENT, TYPE=C3D20, ELSET=BODY\n" + elements_ +
            "*MATERIAL, NAME=M\n*ELASTIC\n2.1E11, .3\n*EXPANSION\n2.3E-4\n*DENSITY\n7850.\n"
            "*SOLID SECTION, ELSET=BODY, MATERIAL=M\n*BOUNDARY\n";
    std::string temperatures;
    for (const auto& [place, number] : known_) {
      const double x = 1e-7 * static_cast<double>(place[0]),
                   y = 1e-7 * static_cast<double>(place[1]),
                   z = 1e-7 * static_cast<double>(place[2]);
      if (place[0] == 0) text_ += fmt::format("{}, 1\n", number);
      if (place[1] == 0) text_ += fmt::format("{}, 2\n", number);
      if (place[2] == 0 || std::abs(z - top) < 1e-6) text_ += fmt::format("{}, 3\n", number);
      temperatures += fmt::format("{}, {:.8f}\n", number, std::hypot(x, y) + z);
    }
    text_ += "*STEP\n*STATIC\n*TEMPERATURE\n" + temperatures + "*END STEP\n";
  }

  int n_, solids_ = 0;
  std::map<std::array<long, 3>, int> known_;
  std::string nodes_, elements_, text_;
};

// Elements of the same kind and division by a program of its own, which is
// tests/verification/references/hot_body_of_revolution.py, give -100.96 MPa with n = 1 and
// -103.30 MPa with n = 2. Source: NAFEMS (1990), The standard NAFEMS benchmarks, LE11: -105 MPa.
TEST(NafemsLe11, AxialStressAtTheInnerFoot) {
  for (const auto& [n, expected] : {std::pair(1, -100.96e6), std::pair(2, -103.30e6)}) {
    SCOPED_TRACE(n);
    const Deck deck = test::abaqus(HotBodyOfRevolution(n).text());
    Mesh mesh = deck.mesh;
    for (Material& material : mesh.materials) material.yield_stress = 235e6;
    const ElasticModel model(std::move(mesh), {2, {}});
    const DeckSolution solution = solve_deck(model, deck, 1);
    ASSERT_EQ(solution.cases.size(), 1U);
    const CellHeat heat = heat_of(model, deck, {0}).value();
    int found = 0;
    for (std::size_t s = 0; s < deck.mesh.solids.size(); ++s)
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const int vertex = deck.mesh.solids[s].vertices[corner];
        if ((deck.mesh.vertices[static_cast<std::size_t>(vertex)] - Vector3(1, 0, 0)).norm() > 1e-6)
          continue;
        ++found;
        const Eigen::VectorXd stress = solid_corner_stresses(model.space(), static_cast<int>(s),
                                                             solution.cases[0].motion, &heat);
        const double axial = stress[6 * static_cast<Eigen::Index>(corner) + 2];
        EXPECT_NEAR(axial, expected, 1e-3 * std::abs(expected));
        EXPECT_NEAR(axial, -105e6, (n == 1 ? 0.05 : 0.02) * 105e6);
      }
    EXPECT_EQ(found, 1);
  }
}

}  // namespace
}  // namespace blocklift::structure
