// Shear stress of a deck's bars, beams and rods, against closed forms.
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_solution.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

double peak_of(const Deck& deck, int degree) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  const DeckSolution solution = solve_deck(ElasticModel(std::move(mesh), {degree, {}}), deck, 1);
  return solution.cases.at(0).stress.checked_von_mises.value;
}

/// A cantilever of 1 m along x in two elements, its end loaded by cards; axis 2 upwards.
Deck loaded_nastran_bar(const std::string& property, const std::string& loads,
                        const std::string& element = "CBAR") {
  const std::string axis = element == "CROD" ? "" : ",0.,0.,1.";
  return test::nastran(fmt::format(
      "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,.4,0.,0.\n"
      "GRID,3,,1.,0.,0.\n{0},1,1,1,2{1}\n{0},2,1,2,3{1}\n{2}MAT1,1,2.+11,,0.3,7850.\n"
      "SPC1,1,123456,1\n{3}ENDDATA\n",
      element, axis, property, loads));
}

Deck loaded_abaqus_bar(const std::string& section, const std::string& data,
                       const std::string& loads) {
  return test::abaqus(fmt::format(
      "*NODE\n1, 0., 0., 0.\n2, .4, 0., 0.\n3, 1., 0., 0.\n*ELEMENT, TYPE=B31, ELSET=B\n1, 1, 2\n"
      "2, 2, 3\n*MATERIAL, NAME=STEEL\n*ELASTIC\n2.e11, .3\n*DENSITY\n7850.\n"
      "*BEAM SECTION, ELSET=B, SECTION={}, MATERIAL=STEEL\n{}\n0., 0., 1.\n"
      "*BOUNDARY\n1, 1, 6\n*STEP\n*STATIC\n*CLOAD\n{}*END STEP\n",
      section, data, loads));
}

double von_mises_of(double normal, double shear) {
  return std::sqrt(normal * normal + 3 * shear * shear);
}

// A round bar of 60 mm under 10 kN m: 16 T / (pi d^3) = 236 MPa, von Mises 408 MPa. Degree 1 has
// one Gauss point an element.
TEST(ShearOfBars, TwistedRoundBar) {
  const double expected = von_mises_of(0, 16 * 1e4 / (std::numbers::pi * std::pow(0.06, 3)));
  EXPECT_NEAR(expected, 408.4e6, 0.1e6);
  const std::string torque = "MOMENT,2,3,,1.,1.+4,0.,0.\n";
  for (const int degree : {1, 2, 3}) {
    for (const char* const shape : {"CBAR", "CBEAM"}) {
      const char* const property =
          shape == std::string("CBAR") ? "PBARL,1,1,,ROD\n,.03\n" : "PBEAML,1,1,,ROD\n,.03\n";
      EXPECT_NEAR(peak_of(loaded_nastran_bar(property, torque, shape), degree), expected,
                  1e-6 * expected);
    }
    EXPECT_NEAR(peak_of(loaded_abaqus_bar("CIRC", ".03", "3, 4, 1.e4\n"), degree), expected,
                1e-6 * expected);
  }
}

// Bending, torsion and force across at the clamp of a pipe: at the end of the axis that the force
// acts along sqrt(s^2 + 3 T^2 / W_t^2), s = F l / W.
TEST(ShearOfBars, PipeIsBentAndTwisted) {
  const double force = 2e4, torque = 1.5e4, outer = 0.1, inner = 0.09;
  const double inertia = std::numbers::pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
  const double expected = von_mises_of(force * outer / inertia, torque * outer / (2 * inertia));
  for (const int degree : {2, 3}) {
    EXPECT_NEAR(peak_of(loaded_nastran_bar("PBARL,1,1,,TUBE\n,.1,.09\n",
                                           "MOMENT,2,3,,1.,1.5+4,0.,0.\n"
                                           "FORCE,2,3,,2.+4,0.,0.,1.\n"),
                        degree),
                expected, 1e-6 * expected);
    EXPECT_NEAR(peak_of(loaded_abaqus_bar("PIPE", ".1, .01", "3, 4, 1.5e4\n3, 3, 2.e4\n"), degree),
                expected, 1e-6 * expected);
  }
}

// Bredt: T / (2 A_0 t) in the thinner walls.
TEST(ShearOfBars, TwistedBox) {
  const double torque = 2e4, area = 0.19 * 0.284, wall = 0.01;
  const double expected = von_mises_of(0, torque / (2 * area * wall));
  EXPECT_NEAR(peak_of(loaded_nastran_bar("PBARL,1,1,,BOX\n,.2,.3,.016,.01\n",
                                         "MOMENT,2,3,,1.,2.+4,0.,0.\n"),
                      2),
              expected, 1e-6 * expected);
  EXPECT_NEAR(peak_of(loaded_abaqus_bar("BOX", ".3, .2, .016, .01, .016, .01", "3, 4, 2.e4\n"), 2),
              expected, 1e-6 * expected);
}

// V S / (I t) in the web of an I under a force at its end. A moment there takes half of the bending
// from the clamp: F l / 2 is left, whose stress the web's shear exceeds.
TEST(ShearOfBars, ForceThroughTheWebOfAnI) {
  const double h = 0.4, t = 0.006, b = 0.2, flange = 0.02, force = 1e5;
  const double level = h - flange;
  const double inertia = b * flange * level * level / 2 + t * std::pow(level, 3) / 12;
  const double shear = force * (b * flange * level / 2 + t * level * level / 8) / (inertia * t);
  const double bending = force / 2 * h / 2 / inertia;
  const double expected = von_mises_of(0, shear);
  ASSERT_LT(std::hypot(bending, 0.9 * expected), expected);
  const Deck deck = loaded_nastran_bar(
      fmt::format("PBARL,1,1,,I\n,{},{},{},{},{},{}\n", h, b, b, t, flange, flange),
      "FORCE,2,3,,1.+5,0.,0.,1.\nMOMENT,2,3,,1.,0.,5.+4,0.\n");
  for (const int degree : {2, 3}) EXPECT_NEAR(peak_of(deck, degree), expected, 1e-6 * expected);
}

// Rods: tau = T C / J with the C of PROD; without, that of a round bar whose A and J they are.
TEST(ShearOfBars, TwistedRod) {
  const double area = std::numbers::pi * 9e-4, torsion = std::numbers::pi / 2 * 81e-8, torque = 1e4;
  const std::string figures = fmt::format("PROD,1,1,{:.10g},{:.10g}", area, torsion);
  const std::string loads = "MOMENT,2,3,,1.,1.+4,0.,0.\nFORCE,2,3,,1.+5,1.,0.,0.\n";
  const auto expected = [&](double arm) {
    return von_mises_of(1e5 / area, torque * arm / torsion);
  };
  const auto found = [&](const std::string& property) {
    return peak_of(loaded_nastran_bar(property + "\n", "SPC1,1,2356,2,3\n" + loads, "CROD"), 2);
  };
  EXPECT_NEAR(found(figures + ",.02"), expected(0.02), 1e-6 * expected(0.02));
  EXPECT_NEAR(found(figures), expected(0.03), 1e-6 * expected(0.03));
  EXPECT_NEAR(found("PTUBE,1,1,.06"), expected(0.03), 1e-6 * expected(0.03));
}

// Of a bar by figures alone bending is what it was; a twist shows an estimate, which covers the
// square that these figures are.
TEST(ShearOfBars, BarByFigures) {
  const double a = 0.1, torsion = 0.1406 * std::pow(a, 4);
  const std::string property = fmt::format(
      "PBAR,1,1,.01,8.333333-6,8.333333-6,{:.8g}\n,.05,.05,.05,-.05,-.05,.05,-.05,-.05\n", torsion);
  const double bending = 1e4 / (a * a * a / 6);
  EXPECT_NEAR(peak_of(loaded_nastran_bar(property, "FORCE,2,3,,1.+4,0.,0.,1.\n"), 2), bending,
              1e-5 * bending);
  const double twist = von_mises_of(0, 1e4 / (0.208 * a * a * a));
  const double found = peak_of(loaded_nastran_bar(property, "MOMENT,2,3,,1.,1.+4,0.,0.\n"), 2);
  EXPECT_GE(found, twist * 0.999);
  EXPECT_LE(found, twist * 1.1);
}

}  // namespace
}  // namespace blocklift::structure
