// Plates whose thickness varies within their elements, against the beam of the same sections.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/mesh/mass_properties.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

constexpr double wedge_modulus = 2e11, wedge_density = 7850;  // Pa, kg/m^3; Poisson's ratio is zero
constexpr double wedge_length = 1, wedge_width = 0.2, root_thickness = 0.03, tip_thickness = 0.01,
                 tip_force = 100;

double wedge_thickness(double x) {
  return root_thickness + (tip_thickness - root_thickness) * x / wedge_length;
}

/// Cards of a cantilever of n x 2 plates along x, nodes 1 + i + (n + 1) j.
std::string nastran_cantilever(int n) {
  std::string text = "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\nPSHELL,1,1,0.05,1,,1\n";
  text += fmt::format("MAT1,1,{},,0.,{}.\n", "2.+11", wedge_density);
  const auto node = [&](int i, int j) { return 1 + i + (n + 1) * j; };
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i <= n; ++i)
      text += fmt::format("GRID,{},,{:.8g},{:.8g},0.\n", node(i, j), wedge_length * i / n,
                          wedge_width * j / 2);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < n; ++i) {
      const double near = wedge_thickness(wedge_length * i / n),
                   far = wedge_thickness(wedge_length * (i + 1) / n);
      text += fmt::format("CQUAD4,{},1,{},{},{},{}\n,,,{:.8g},{:.8g},{:.8g},{:.8g}\n",
                          1 + i + n * j, node(i, j), node(i + 1, j), node(i + 1, j + 1),
                          node(i, j + 1), near, far, far, near);
    }
  for (int j = 0; j < 3; ++j) {
    text += fmt::format("SPC1,1,123456,{}\n", node(0, j));
    text += fmt::format("FORCE,2,{},,{},0.,0.,1.\n", node(n, j), j == 1 ? "50." : "25.");
  }
  return text + "ENDDATA\n";
}

/// The same as CalculiX and Abaqus say it.
std::string abaqus_cantilever(int n) {
  std::string text = "*NODE, NSET=ALL\n", thicknesses, elements;
  const auto node = [&](int i, int j) { return 1 + i + (n + 1) * j; };
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = wedge_length * i / n;
      text += fmt::format("{}, {:.8g}, {:.8g}, 0.\n", node(i, j), x, wedge_width * j / 2);
      thicknesses += fmt::format("{}, {:.8g}\n", node(i, j), wedge_thickness(x));
    }
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < n; ++i)
      elements += fmt::format("{}, {}, {}, {}, {}\n", 1 + i + n * j, node(i, j), node(i + 1, j),
                              node(i + 1, j + 1), node(i, j + 1));
  text += "*ELEMENT, TYPE=S4, ELSET=E\n" + elements + "*MATERIAL, NAME=M\n*ELASTIC\n2.e11, 0.\n";
  text += fmt::format("*DENSITY\n{},\n", wedge_density);
  text += "*SHELL SECTION, ELSET=E, MATERIAL=M, NODAL THICKNESS\n0.05\n*NODAL THICKNESS\n" +
          thicknesses + "*STEP\n*STATIC\n*BOUNDARY\n";
  for (int j = 0; j < 3; ++j) text += fmt::format("{}, 1, 6\n", node(0, j));
  text += "*CLOAD\n";
  for (int j = 0; j < 3; ++j)
    text += fmt::format("{}, 3, {}\n", node(n, j), j == 1 ? "50." : "25.");
  return text + "*END STEP\n";
}

ElasticModel model_of_taper(const Deck& deck) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  return {std::move(mesh), {3, {}}};
}

/// Of Timoshenko's beam under the force at its tip, m: the integrals of s^2 / I and 1 / A.
double wedge_deflection() {
  const double slope = (root_thickness - tip_thickness) / wedge_length,
               ratio = tip_thickness / root_thickness;
  const double bending =
      (-std::log(ratio) + 2 * ratio - ratio * ratio / 2 - 1.5) / (slope * slope * slope);
  const double shear = -std::log(ratio) / slope;
  return tip_force * (12 / (wedge_modulus * wedge_width) * bending +
                      shear / (5.0 / 6 * wedge_modulus / 2 * wedge_width));
}

// Two elements along the beam serve: with curvatures of second degree the tip is within 0.1 % and
// the stress, largest where the plate is twice as thick as at the tip, within 2 %. With the mean of
// each element the beam would bend by 18 % more, and its stress be 1.8 times as large. The force
// acts at three nodes, which moves their places by a thousandth.
TEST(Taper, CantileverBendsAsTheBeamDoes) {
  for (const Deck& deck :
       {test::nastran(nastran_cantilever(2)), test::abaqus(abaqus_cantilever(2))}) {
    ASSERT_EQ(deck.mesh.shell_tapers.size(), 4U);
    EXPECT_NEAR(deck.mesh.shell_sections[deck.mesh.shells[0].section].thickness, 0.025, 1e-12);
    const ElasticModel model = model_of_taper(deck);
    const DeckSolution solution = solve_deck(model, deck, 1);
    ASSERT_EQ(solution.cases.size(), 1U);
    const DeckCaseSolution& found = solution.cases[0];
    const double tip = found.motion[6L * model.space().node_of_vertex(5) + 2];
    EXPECT_NEAR(tip, wedge_deflection(), 5e-3 * wedge_deflection());
    const double worst = 6 * tip_force * (wedge_length / 2) / (wedge_width * 0.02 * 0.02);
    EXPECT_NEAR(found.stress.peak_von_mises.value, worst, 0.04 * worst);
    EXPECT_LT(found.estimated_error, 0.1);
  }
  // Finer: the closed form.
  const Deck fine = test::nastran(nastran_cantilever(8));
  const ElasticModel model = model_of_taper(fine);
  const DeckSolution solution = solve_deck(model, fine, 1);
  const DeckCaseSolution& found = solution.cases[0];
  EXPECT_NEAR(found.motion[6L * model.space().node_of_vertex(17) + 2], wedge_deflection(),
              2e-3 * wedge_deflection());
  const double worst = 6 * tip_force * (wedge_length / 2) / (wedge_width * 0.02 * 0.02);
  EXPECT_NEAR(found.stress.peak_von_mises.value, worst, 0.01 * worst);
}

TEST(Taper, MassIsThatOfTheWedge) {
  const Deck deck = test::nastran(nastran_cantilever(2));
  const double mass =
      wedge_density * wedge_width * wedge_length * (root_thickness + tip_thickness) / 2;
  // Of a trapezium: L (t_0 + 2 t_1) / (3 (t_0 + t_1)) from its thick end.
  const double centre =
      wedge_length * (root_thickness + 2 * tip_thickness) / (3 * (root_thickness + tip_thickness));
  EXPECT_NEAR(mass_properties(deck.mesh).mass, mass, 1e-9 * mass);
  EXPECT_NEAR(mass_properties(deck.mesh).centre.x(), centre, 1e-9);
  const ElasticModel model = model_of_taper(deck);
  EXPECT_NEAR(model.mass_properties().mass, mass, 1e-9 * mass);
  EXPECT_NEAR(model.mass_properties().centre_of_mass_B.x(), centre, 1e-9);
  // About y through the centre: of the middle surface, and with what the thickness adds.
  const double slope = (tip_thickness - root_thickness) / wedge_length;
  const double about_root =
      root_thickness * std::pow(wedge_length, 3) / 3 + slope * std::pow(wedge_length, 4) / 4;
  const double flat = wedge_density * wedge_width * about_root - mass * centre * centre;
  const double across = wedge_density * wedge_width *
                        (std::pow(tip_thickness, 4) - std::pow(root_thickness, 4)) / (48 * slope);
  EXPECT_NEAR(mass_properties(deck.mesh).inertia(1, 1), flat, 1e-9 * flat);
  EXPECT_NEAR(model.mass_properties().inertia_BBcm_B(1, 1), flat + across, 1e-9 * flat);
}

// Over a triangle the integral of t x is A / 12 times the sum of t_i x_j, where those of one corner
// count twice.
TEST(Taper, TrianglesHaveOne) {
  const Deck deck = test::nastran(
      "SOL 101\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.5,1.,0.\n"
      "CTRIA3,1,1,1,2,3\n,,,0.01,0.03,0.02\nPSHELL,1,1,0.05,1,,1\nMAT1,1,2.+11,,0.3,7850.\n"
      "ENDDATA\n");
  const Vector3 thickness(0.01, 0.03, 0.02), x(0, 2, 0.5);
  const double mass = 7850 * thickness.mean();  // of one square metre
  const double moment = 7850 * (thickness.sum() * x.sum() + thickness.dot(x)) / 12;
  EXPECT_NEAR(mass_properties(deck.mesh).mass, mass, 1e-9 * mass);
  EXPECT_NEAR(mass_properties(deck.mesh).centre.x(), moment / mass, 1e-9);
  for (const Deck& again : {test::nastran(to_nastran(deck)), test::abaqus(to_abaqus(deck))}) {
    EXPECT_NEAR(mass_properties(again.mesh).mass, mass, 1e-9 * mass);
    EXPECT_NEAR(mass_properties(again.mesh).centre.x(), moment / mass, 1e-9);
  }
}

TEST(Taper, WhatIsNotKnownIsRefused) {
  std::string text = abaqus_cantilever(2);
  EXPECT_EQ(test::complaints_of_abaqus(text), "");
  const auto begin = text.find("*NODAL THICKNESS"), end = text.find("*STEP");
  const std::string missing = test::complaints_of_abaqus(text.substr(0, begin) + text.substr(end));
  EXPECT_THAT(missing, ::testing::HasSubstr("nodes of element 1 have no *NODAL THICKNESS"));
  // Layers of one material are a plate; of two they are not.
  const std::string even = "MATERIAL=M, NODAL THICKNESS\n0.05\n";
  text.replace(text.find(even), even.size(),
               "COMPOSITE, NODAL THICKNESS\n0.03, 3, M, 0.\n0.02, 3, N, 0.\n");
  text.insert(text.find("*SHELL SECTION"), "*MATERIAL, NAME=N\n*ELASTIC\n1.e11, 0.3\n");
  EXPECT_THAT(test::complaints_of_abaqus(text),
              ::testing::HasSubstr("cannot have the thickness of their nodes"));
}

// CalculiX asks no section: shells at nodes without a thickness keep their section's there.
TEST(Taper, NodesWithoutAThicknessHaveTheSections) {
  std::string text = abaqus_cantilever(2);
  const std::string asked = ", NODAL THICKNESS";
  text.replace(text.find(asked), asked.size(), "");
  const std::string at_tip = fmt::format("3, {:.8g}\n", tip_thickness);
  text.replace(text.find(at_tip, text.find("*NODAL THICKNESS")), at_tip.size(), "");
  const Deck deck = test::abaqus(text);
  ASSERT_EQ(deck.mesh.shell_tapers.size(), 4U);
  EXPECT_NEAR(thickness_at(deck.mesh, deck.mesh.shells[1], {1, 0}), 0.05, 1e-12);
  EXPECT_NEAR(thickness_at(deck.mesh, deck.mesh.shells[1], {1, 1}), tip_thickness, 1e-12);
}

TEST(Taper, IsWrittenAndReadAgain) {
  const Deck deck = test::nastran(nastran_cantilever(2));
  for (const Deck& again : {test::nastran(to_nastran(deck)), test::abaqus(to_abaqus(deck))}) {
    ASSERT_EQ(again.mesh.shells.size(), deck.mesh.shells.size());
    for (std::size_t s = 0; s < deck.mesh.shells.size(); ++s) {
      const Shell& one = deck.mesh.shells[s];
      const Shell& other =
          *std::find_if(again.mesh.shells.begin(), again.mesh.shells.end(),
                        [&](const Shell& shell) { return shell.label == one.label; });
      ASSERT_GE(other.taper, 0);
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(again.mesh.shell_tapers[other.taper][i], deck.mesh.shell_tapers[one.taper][i],
                    1e-12);
      EXPECT_NEAR(again.mesh.section_of(other).thickness, deck.mesh.section_of(one).thickness,
                  1e-12);
    }
  }
}

// Abaqus knows one thickness at a node.
TEST(Taper, AStepAtANodeIsNotWrittenForAbaqus) {
  Deck deck = test::nastran(nastran_cantilever(2));
  deck.mesh.shells[1].taper = -1;
  try {
    to_abaqus(deck);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("of which one has a thickness that varies"));
  }
}

}  // namespace
}  // namespace blocklift::structure
