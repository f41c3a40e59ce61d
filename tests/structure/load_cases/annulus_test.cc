// Discs with a hole whose thickness is even or grows as the radius does: bent by a pressure and
// turned about their axis, against the closed forms.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/LU>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

constexpr double disc_modulus = 2e11, disc_ratio = 0.3, disc_density = 7850;  // Pa, -, kg/m^3
constexpr double disc_hole = 0.5, disc_rim = 1.5;                             // radii, m
constexpr double disc_slope = 0.02;  // thickness over radius, or the even thickness in m
constexpr double disc_pressure = 1000, disc_spin = 100;  // Pa, rad/s
constexpr int disc_along = 3, disc_around = 4;           // elements

int disc_node(int i, int j) { return 1 + i + (2 * disc_along + 1) * j; }

/// A quarter of a disc about z of elements with eight nodes: its sides are planes of symmetry, its
/// rim is held across. Case 1 is a pressure along z, case 2 the rotation.
std::string quarter_disc(bool is_tapered) {
  std::string text = fmt::format(
      "SOL 101\nCEND\nSPC = 1\nSUBCASE 1\nLOAD = 2\nSUBCASE 2\nLOAD = 3\nBEGIN BULK\n"
      "MAT1,1,2.+11,,0.3,7850.\nPSHELL,1,1,0.02,1,,1\nRFORCE,3,0,0,{:.12g},0.,0.,1.\n",
      disc_spin / (2 * std::numbers::pi));
  const auto radius = [](int i) {
    return disc_hole + (disc_rim - disc_hole) * i / (2 * disc_along);
  };
  for (int j = 0; j <= 2 * disc_around; ++j)
    for (int i = 0; i <= 2 * disc_along; ++i) {
      if (i % 2 == 1 && j % 2 == 1) continue;
      const double angle = std::numbers::pi / 2 * j / (2 * disc_around);
      text += fmt::format("GRID,{},,{:.12f},{:.12f},0.\n", disc_node(i, j),
                          radius(i) * std::cos(angle), radius(i) * std::sin(angle));
    }
  for (int j = 0; j < 2 * disc_around; j += 2)
    for (int i = 0; i < 2 * disc_along; i += 2) {
      text += fmt::format("CQUAD8,{},1,{},{},{},{},{},{}\n,{},{}", disc_node(i, j), disc_node(i, j),
                          disc_node(i + 2, j), disc_node(i + 2, j + 2), disc_node(i, j + 2),
                          disc_node(i + 1, j), disc_node(i + 2, j + 1), disc_node(i + 1, j + 2),
                          disc_node(i, j + 1));
      const double near = disc_slope * radius(i), far = disc_slope * radius(i + 2);
      if (is_tapered) text += fmt::format(",{:.12g},{:.12g},{:.12g},{:.12g}", near, far, far, near);
      text += fmt::format("\nPLOAD4,2,{},{}.\n", disc_node(i, j), disc_pressure);
    }
  for (int i = 0; i <= 2 * disc_along; ++i)
    text += fmt::format("SPC1,1,246,{}\nSPC1,1,156,{}\n", disc_node(i, 0),
                        disc_node(i, 2 * disc_around));
  for (int j = 0; j <= 2 * disc_around; ++j)
    text += fmt::format("SPC1,1,3,{}\n", disc_node(2 * disc_along, j));
  return text + "ENDDATA\n";
}

/// A sum of powers of the radius.
struct Powers {
  Eigen::Vector4d factors = Eigen::Vector4d::Zero(), exponents = Eigen::Vector4d::Zero();

  double value(double r) const { return derivative(r, 0); }
  double derivative(double r, int order) const {
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const double m = exponents[i];
      sum += factors[i] * (order == 0 ? std::pow(r, m) : m * std::pow(r, m - 1));
    }
    return sum;
  }
  double integral(double from, double to) const {
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const double m = exponents[i] + 1;
      sum += factors[i] * (std::abs(m) < 1e-12 ? std::log(to / from)
                                               : (std::pow(to, m) - std::pow(from, m)) / m);
    }
    return sum;
  }
  /// f' + nu f / r: without it neither edge bears a force or a moment.
  double free_term(int i, double r) const {
    return (exponents[i] + disc_ratio) * std::pow(r, exponents[i] - 1);
  }
  /// Factors 0 and 1 so that f' + nu f / r vanishes at the hole and at the rim.
  void free_edges() {
    Eigen::Matrix2d matrix;
    Eigen::Vector2d right;
    const double edges[] = {disc_hole, disc_rim};
    for (int row = 0; row < 2; ++row) {
      matrix.row(row) << free_term(0, edges[row]), free_term(1, edges[row]);
      right[row] = -factors[2] * free_term(2, edges[row]) - factors[3] * free_term(3, edges[row]);
    }
    factors.head<2>() = matrix.inverse() * right;
  }
  /// The largest von Mises stress where its parts are "stiffness(r) (f' + nu f / r)" along and
  /// "stiffness(r) (f / r + nu f')" around.
  template <typename Stiffness>
  double largest_stress(const Stiffness& stiffness) const {
    double largest = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double r = disc_hole + (disc_rim - disc_hole) * i / 1000;
      const double slope = derivative(r, 1), over = value(r) / r;
      const double along = stiffness(r) * (slope + disc_ratio * over),
                   around = stiffness(r) * (over + disc_ratio * slope);
      largest = std::max(largest, std::sqrt(along * along - along * around + around * around));
    }
    return largest;
  }
};

/// Displacement outwards of a disc that turns, m: with a thickness as r^n the equilibrium of a ring
/// (Timoshenko and Goodier 1951, art. 30, for n = 0) is
/// r^2 u'' + (1 + n) r u' + (n nu - 1) u = -(1 - nu^2) rho w^2 r^3 / E, of powers alone.
Powers displacement_of_spin(int n) {
  const double nu = disc_ratio, root = std::sqrt(n * n / 4.0 + 1 - n * nu);
  Powers u;
  u.exponents << -n / 2.0 + root, -n / 2.0 - root, 3, 0;
  u.factors[2] = -(1 - nu * nu) * disc_density * disc_spin * disc_spin /
                 (disc_modulus * (6 + 3.0 * (1 + n) + n * nu - 1));
  u.free_edges();
  return u;
}

/// Rotation of a disc's cross-sections under the pressure, its thickness "disc_slope r": the
/// equilibrium (r M_r)' - M_t = r Q with the plate's stiffness k r^3 is
/// r^2 b'' + 4 r b' + (3 nu - 1) b = -q / (2 k) (1 - a^2 / r^2), a the hole's radius.
constexpr double disc_stiffness =
    disc_modulus * disc_slope * disc_slope * disc_slope / (12 * (1 - disc_ratio * disc_ratio));

Powers rotation_of_pressure() {
  const double nu = disc_ratio, root = std::sqrt(13 - 12 * nu) / 2;
  const double q = disc_pressure / (2 * disc_stiffness);
  Powers b;
  b.exponents << -1.5 + root, -1.5 - root, 0, -2;
  b.factors[2] = -q / (3 * nu - 1);
  b.factors[3] = q * disc_hole * disc_hole / (3 * nu - 3);
  b.free_edges();
  return b;
}

/// How far the hole's edge moves along the pressure, m: by the rotation and by shear, w' = -b + g,
/// g = Q / (5/6 G t), Q = -q (r^2 - a^2) / (2 r).
double deflection_of_pressure() {
  const double shear = 5.0 / 6 * disc_modulus / (2 * (1 + disc_ratio)) * disc_slope;
  const double of_shear =
      disc_pressure / (2 * shear) *
      (disc_rim - disc_hole - disc_hole * disc_hole * (1 / disc_hole - 1 / disc_rim));
  return rotation_of_pressure().integral(disc_hole, disc_rim) + of_shear;
}

ElasticModel model_of_disc(const Deck& deck) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  return {std::move(mesh), {3, {}}};
}

double displacement_of_disc(const ElasticModel& model, const DeckCaseSolution& found, int node,
                            int axis) {
  const auto& labels = model.mesh().vertex_labels;
  const auto place = std::find(labels.begin(), labels.end(), node);
  EXPECT_NE(place, labels.end());
  return found
      .motion[6L * model.space().node_of_vertex(static_cast<int>(place - labels.begin())) + axis];
}

// Arcs of 22.5 degrees of second degree are within 1e-4 of the circle.
TEST(Annulus, TurnsAsTheClosedFormSays) {
  for (const bool is_tapered : {false, true}) {
    const Deck deck = test::nastran(quarter_disc(is_tapered));
    ASSERT_EQ(deck.mesh.shell_tapers.size(), is_tapered ? 12U : 0U);
    const ElasticModel model = model_of_disc(deck);
    const DeckSolution solution = solve_deck(model, deck, 1);
    ASSERT_EQ(solution.cases.size(), 2U);
    const Powers u = displacement_of_spin(is_tapered ? 1 : 0);
    if (!is_tapered) {
      // Timoshenko and Goodier's own solution, at the rim.
      const double rim =
          disc_density * disc_spin * disc_spin * disc_rim / (4 * disc_modulus) *
          ((1 - disc_ratio) * disc_rim * disc_rim + (3 + disc_ratio) * disc_hole * disc_hole);
      EXPECT_NEAR(u.value(disc_rim), rim, 1e-12 * rim);
    }
    for (const int i : {0, 2, 2 * disc_along}) {
      const double r = disc_hole + (disc_rim - disc_hole) * i / (2 * disc_along);
      EXPECT_NEAR(displacement_of_disc(model, solution.cases[1], disc_node(i, 0), 0), u.value(r),
                  1e-3 * u.value(r));
      EXPECT_NEAR(displacement_of_disc(model, solution.cases[1], disc_node(i, 2 * disc_around), 1),
                  u.value(r), 1e-3 * u.value(r));
    }
    const double worst =
        u.largest_stress([](double) { return disc_modulus / (1 - disc_ratio * disc_ratio); });
    EXPECT_NEAR(solution.cases[1].stress.peak_von_mises.value, worst, 0.03 * worst);
  }
}

TEST(Annulus, TaperedBendsAsTheClosedFormSays) {
  const Deck deck = test::nastran(quarter_disc(true));
  const ElasticModel model = model_of_disc(deck);
  const DeckSolution solution = solve_deck(model, deck, 1);
  const double expected = deflection_of_pressure();
  for (const int j : {0, 2 * disc_around})
    EXPECT_NEAR(displacement_of_disc(model, solution.cases[0], disc_node(0, j), 2), expected,
                2e-3 * expected);
  // 6 M / t^2, the stiffness k r^3 over the thickness squared.
  const double worst = rotation_of_pressure().largest_stress(
      [](double r) { return 6 * disc_stiffness * r / (disc_slope * disc_slope); });
  EXPECT_NEAR(solution.cases[0].stress.peak_von_mises.value, worst, 0.03 * worst);
  EXPECT_LT(solution.cases[0].estimated_error, 0.05);
}

// Thickness, rotation and pressure go through both writers.
TEST(Annulus, IsTheSameWhenWrittenAndReadAgain) {
  const Deck deck = test::nastran(quarter_disc(true));
  const ElasticModel model = model_of_disc(deck);
  const DeckSolution solution = solve_deck(model, deck, 1);
  for (const Deck& again : {test::nastran(to_nastran(deck)), test::abaqus(to_abaqus(deck))}) {
    EXPECT_EQ(again.mesh.shell_tapers.size(), deck.mesh.shell_tapers.size());
    const ElasticModel other = model_of_disc(again);
    const DeckSolution found = solve_deck(other, again, 1);
    ASSERT_EQ(found.cases.size(), 2U);
    for (std::size_t c = 0; c < 2; ++c)
      EXPECT_NEAR(found.cases[c].strain_energy, solution.cases[c].strain_energy,
                  1e-7 * solution.cases[c].strain_energy);
  }
}

}  // namespace
}  // namespace blocklift::structure
