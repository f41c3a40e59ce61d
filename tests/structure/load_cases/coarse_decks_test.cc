// Decks of few elements, which between their nodes must be no softer and no stiffer than the deck
// says.
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_solution.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

// Of reactions, which are K q - f: a bar resists stretching some thousand times as much as bending,
// and its stiffness is rounded to 1e-16 of the former.
constexpr double balanced = 1e-7;

DeckSolution solve_coarse(const Deck& deck, int degree) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  return solve_deck(ElasticModel(std::move(mesh), {degree, {}}), deck, 1);
}

// A bar of 100 x 200 mm and 4 m between two nodes.
std::string one_bar(const std::string& supports_and_loads,
                    const std::string& control = "LOAD = 2\n") {
  return "SOL 101\nCEND\nSPC = 1\n" + control +
         "BEGIN BULK\n"
         "GRID,1,,0.,0.,0.\nGRID,2,,4.,0.,0.\n"
         "CBAR,1,1,1,2,0.,1.,0.\n"
         "PBAR,1,1,0.02,6.6666667-5,1.6666667-5,4.58-5\n"
         "MAT1,1,2.+11,,0.3,7850.\n" +
         supports_and_loads + "ENDDATA\n";
}

const char* const even_load = "PLOAD1,2,1,FY,FR,0.,-10000.,1.,-10000.\n";

// w l^2 / 12 at the ends: 13.33 kN m, 20 MPa.
TEST(CoarseDecks, BarBetweenTwoClampsBends) {
  const DeckSolution solution =
      solve_coarse(test::nastran(one_bar(fmt::format("SPC1,1,123456,1,2\n{}", even_load))), 1);
  EXPECT_NEAR(solution.cases[0].stress.peak_von_mises.value, 20e6, 1e-3 * 20e6);
}

// w l^2 / 8 in the middle, where no node of the deck is: 20 kN m, 30 MPa.
TEST(CoarseDecks, BarBetweenTwoHingesBendsInItsMiddle) {
  const DeckSolution solution = solve_coarse(
      test::nastran(one_bar(fmt::format("SPC1,1,1234,1\nSPC1,1,23,2\n{}", even_load))), 1);
  EXPECT_NEAR(solution.cases[0].stress.peak_von_mises.value, 30e6, 1e-3 * 30e6);
  EXPECT_NEAR(solution.cases[0].stress.peak_von_mises.point_B.x(), 2, 1e-9);
}

// 12 E I d / l^3 with d = 5 mm: 12.5 kN; 6 E I d / l^2 bends the ends by 37.5 MPa.
TEST(CoarseDecks, ClampThatSettlesPullsBySlopeDeflection) {
  const DeckSolution solution = solve_coarse(
      test::nastran(one_bar("SPC1,1,123456,1\nSPC1,1,13456,2\nSPC,1,2,2,0.005\n", "")), 1);
  const DeckCaseSolution& one = solution.cases[0];
  for (const SupportReaction& reaction : one.reactions)
    EXPECT_NEAR(reaction.force.norm(), 12.5e3, 5e-3 * 12.5e3);  // and its shear
  EXPECT_NEAR(one.stress.peak_von_mises.value, 37.5e6, 5e-3 * 37.5e6);
}

// Where moments alone act, forces are rounding, and are not held against each other.
TEST(CoarseDecks, BalanceUnderAMomentIsRounding) {
  const DeckSolution solution =
      solve_coarse(test::nastran(one_bar("SPC1,1,123456,1\nMOMENT,2,2,,1000.,0.,0.,1.\n")), 1);
  EXPECT_LT(solution.cases[0].force_residual, balanced);
  EXPECT_LT(solution.cases[0].moment_residual, balanced);
}

TEST(CoarseDecks, SpringsToTheGroundAreInTheBalance) {
  const DeckSolution solution = solve_coarse(
      test::nastran(one_bar("SPC1,1,123456,1\nCELAS2,9,50000.,2,2\nFORCE,2,2,,1000.,0.,1.,0.\n")),
      1);
  const DeckCaseSolution& one = solution.cases[0];
  EXPECT_LT(one.force_residual, balanced);
  EXPECT_LT(one.moment_residual, balanced);
  EXPECT_NEAR(one.supported.force.y(), -1000, 1000 * balanced);
}

// Two plates of 1 x 1 m, clamped at x = 0; nodes 3 and 6 at x = 2.
std::string two_plates(const std::string& end_of_plates) {
  return "SOL 101\nCEND\nSPC = 1\nBEGIN BULK\n"
         "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\n"
         "GRID,4,,0.,1.,0.\nGRID,5,,1.,1.,0.\nGRID,6,,2.,1.,0.\n"
         "CQUAD4,1,1,1,2,5,4\nCQUAD4,2,1,2,3,6,5\n"
         "PSHELL,1,1,0.01,1,,1\nMAT1,1,2.+11,,0.3,7850.\n"
         "SPC1,1,123456,1,4\n" +
         end_of_plates + "ENDDATA\n";
}

// An edge whose nodes a rigid link binds is pulled as one whose nodes are held.
TEST(CoarseDecks, RigidLinkHoldsAllOfAnEdge) {
  const Deck held =
      test::nastran(two_plates("SPC1,1,23456,3,6\nSPC,1,3,1,0.001\nSPC,1,6,1,0.001\n"));
  const Deck linked = test::nastran(
      two_plates("GRID,9,,2.,0.5,0.\nRBE2,7,9,123456,3,6\nSPC1,1,23456,9\nSPC,1,9,1,0.001\n"));
  for (const int degree : {1, 2, 3}) {
    const double expected = solve_coarse(held, degree).cases[0].strain_energy;
    EXPECT_NEAR(solve_coarse(linked, degree).cases[0].strain_energy, expected, 1e-9 * expected);
  }
}

// Two sheets of 0.5 x 0.4 m, of one piece or with a seam of their own nodes.
std::string sheets_with_seam(bool is_tied, int direction) {
  std::string text =
      "*NODE\n1,0,0,0\n2,0,.4,0\n3,.5,0,0\n4,.5,.4,0\n5,1,0,0\n6,1,.4,0\n7,.5,0,0\n8,.5,.4,0\n"
      "*ELEMENT,TYPE=S4R,ELSET=A\n1,1,3,4,2\n*ELEMENT,TYPE=S4R,ELSET=B\n";
  text += is_tied ? "2,7,5,6,8\n" : "2,3,5,6,4\n";
  text +=
      "*ELSET,ELSET=ALL\nA,B\n*MATERIAL,NAME=M\n*ELASTIC\n2e11,.3\n*DENSITY\n7850.\n"
      "*SHELL SECTION,ELSET=ALL,MATERIAL=M\n.01\n";
  if (is_tied)
    text +=
        "*NSET,NSET=SLAVES\n7,8\n*SURFACE,NAME=S,TYPE=NODE\nSLAVES,1.\n"
        "*SURFACE,NAME=MASTER,TYPE=ELEMENT\nA,SPOS\n"
        "*TIE,NAME=T,POSITION TOLERANCE=.005\nS,MASTER\n";
  return text + fmt::format(
                    "*NSET,NSET=ROOT\n1,2\n*BOUNDARY\nROOT,1,6\n*STEP\n*STATIC\n*CLOAD\n"
                    "5,{0},100.\n6,{0},100.\n*END STEP\n",
                    direction);
}

TEST(CoarseDecks, TiedSeamDoesNotGapeBetweenItsNodes) {
  for (const int direction : {1, 2, 3})
    for (const int degree : {1, 2, 3}) {
      const auto energy = [&](bool is_tied) {
        return solve_coarse(test::abaqus(sheets_with_seam(is_tied, direction)), degree)
            .cases[0]
            .strain_energy;
      };
      EXPECT_NEAR(energy(true), energy(false), 1e-8 * energy(false))
          << "direction " << direction << ", degree " << degree;
    }
}

// A cantilever of 1 x 0.1 m, 10 mm thick, of 4 x 2 squares cut into triangles, bent in its plane:
// P l^3 / 3 E I + P l / (5/6 G A). The clamp holds the plate across, too, and its shear as it
// leaves the clamp: half a percent.
TEST(CoarseDecks, TrianglesBendInTheirPlane) {
  constexpr int m = 4, n = 2;
  std::string text = "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n";
  const auto node = [&](int i, int j) { return 1 + i + (m + 1) * j; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i)
      text += fmt::format("GRID,{},,{:.8g},{:.8g},0.\n", node(i, j), 1.0 * i / m, 0.1 * j / n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i)
      text += fmt::format("CTRIA3,{},1,{},{},{}\nCTRIA3,{},1,{},{},{}\n", 1 + 2 * (i + m * j),
                          node(i, j), node(i + 1, j), node(i + 1, j + 1), 2 + 2 * (i + m * j),
                          node(i + 1, j + 1), node(i, j + 1), node(i, j));
  text += "PSHELL,1,1,0.01,1,,1\nMAT1,1,2.+11,,0.3,7850.\n";
  for (int j = 0; j <= n; ++j)
    text += fmt::format("SPC1,1,123456,{}\nFORCE,2,{},,{},0.,1.,0.\n", node(0, j), node(m, j),
                        j == 0 || j == n ? 25 : 50);
  const Deck deck = test::nastran(text + "ENDDATA\n");
  const double inertia = 0.01 * 1e-3 / 12, shear = 5. / 6 * 2e11 / 2.6 * 1e-3;
  const double expected = 100 / (3 * 2e11 * inertia) + 100 / shear;
  for (const auto& [degree, tolerance] : {std::pair{2, 0.02}, std::pair{3, 0.01}}) {
    const DeckCaseSolution one = solve_coarse(deck, degree).cases[0];
    const double work = 2 * one.strain_energy / 100;  // the load's mean displacement
    EXPECT_NEAR(work, expected, tolerance * expected) << "degree " << degree;
  }
}

}  // namespace
}  // namespace blocklift::structure
