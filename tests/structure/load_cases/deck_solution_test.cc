// A deck's own load cases, against closed forms.
#include "structure/load_cases/deck_solution.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

constexpr double youngs_modulus = 2e11;  // Pa

// Reactions are K q - f. A thin plate of one element resists stretching some 1e7 times as much as
// bending, and its stiffness is rounded to 1e-16 of the former.
constexpr double rounding = 1e-6;  // share of a reaction

/// Elements on a deck's mesh, whose materials need a yield stress to be sound.
ElasticModel model_of(const Deck& deck, int degree = 3) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  return {std::move(mesh), {degree, {}}};
}

DeckSolution solved(const Deck& deck, int degree = 3) {
  return solve_deck(model_of(deck, degree), deck, 1);
}

Eigen::Matrix<double, 6, 1> motion_of(const Deck& deck, const DeckCaseSolution& solution,
                                      int vertex, int degree = 3) {
  return solution.motion.segment<6>(6L * model_of(deck, degree).space().node_of_vertex(vertex));
}

const SupportReaction& reaction_at(const DeckCaseSolution& solution, int vertex) {
  for (const SupportReaction& reaction : solution.reactions)
    if (reaction.vertex == vertex) return reaction;
  throw ModelError("nothing is held there");
}

const char* const plate_properties =
    "PSHELL,1,1,0.01,1,,1\n"
    "MAT1,1,2.+11,,0.3,7850.\n";

/// A square plate of n x n shells, its nodes 1 + i + (n + 1) j, with case control.
std::string square_plate(int n, double side, const std::string& cards) {
  std::string text = "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n";
  const auto node = [&](int i, int j) { return 1 + i + (n + 1) * j; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      text += fmt::format("GRID,{},,{:.8g},{:.8g},0.\n", node(i, j), side * i / n, side * j / n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      text += fmt::format("CQUAD4,{},1,{},{},{},{}\n", 1 + i + n * j, node(i, j), node(i + 1, j),
                          node(i + 1, j + 1), node(i, j + 1));
  return text + plate_properties + cards + "ENDDATA\n";
}

std::string held_edges(int n, const std::string& components) {
  std::string text;
  for (int i = 0; i <= n; ++i)
    for (const int node : {1 + i, 1 + i + (n + 1) * n, 1 + (n + 1) * i, 1 + n + (n + 1) * i})
      text += fmt::format("SPC1,1,{},{}\n", components, node);
  return text;
}

// Timoshenko and Woinowsky-Krieger (1959), table 35: a clamped square plate under even pressure,
// w = 0.00126 q a^4 / D and M = -0.0513 q a^2 in the middle of an edge. The deck holds its nodes
// alone: elements of degree 3 have others between them, which must not bulge through the edge.
TEST(DeckSolution, ClampedPlateIsTimoshenkos) {
  constexpr int n = 8;
  constexpr double pressure = 1000, side = 1;
  const Deck deck =
      test::nastran(square_plate(n, side, held_edges(n, "123456") + "PLOAD2,2,-1000.,1,THRU,64\n"));
  const DeckSolution solution = solved(deck);
  ASSERT_EQ(solution.cases.size(), 1U);
  const DeckCaseSolution& one = solution.cases[0];
  const double stiffness = youngs_modulus * std::pow(0.01, 3) / (12 * (1 - 0.09));
  const double expected = 0.00126532 * pressure * std::pow(side, 4) / stiffness;
  const int middle = (n + 1) * n / 2 + n / 2;
  // The thickness of a hundredth of the side adds its shear: 0.1 %.
  EXPECT_NEAR(std::abs(motion_of(deck, one, middle)[2]), expected, 2e-3 * expected);
  EXPECT_NEAR(one.applied.force.norm(), pressure, 1e-9 * pressure);
  EXPECT_LT(one.force_residual, 1e-9);
  EXPECT_LT(one.moment_residual, 1e-9);
  // 6 M / t^2 at the edge's middle, and its von Mises with the stress along the edge.
  const double across = 6 * 0.0513 * pressure / 1e-4, along = 0.3 * across;
  const double edge = std::sqrt(across * across - across * along + along * along);
  EXPECT_NEAR(one.stress.peak_von_mises.value, edge, 0.03 * edge);
  EXPECT_LT(one.estimated_error, 0.05);
  // What is checked is membrane stress, of which a plate that bends has none.
  ASSERT_EQ(one.stress.groups.size(), 1U);
  EXPECT_FALSE(one.stress.groups[0].checked_von_mises.part.empty());
  EXPECT_LT(one.stress.groups[0].checked_von_mises.value, 1e-6 * edge);
}

// Forces that are in balance by themselves leave the supports nothing but rounding.
TEST(DeckSolution, LoadsInBalanceHaveNoResidual) {
  std::string cards = "SPC1,1,123,1\nSPC1,1,23,3\nSPC1,1,3,7\n";
  for (const int node : {1, 4, 7}) cards += fmt::format("FORCE,2,{},0,1.,-1000.,0.,0.\n", node);
  for (const int node : {3, 6, 9}) cards += fmt::format("FORCE,2,{},0,1.,1000.,0.,0.\n", node);
  const DeckSolution solution = solved(test::nastran(square_plate(2, 1, cards)));
  ASSERT_EQ(solution.cases.size(), 1U);
  EXPECT_LT(solution.cases[0].force_residual, 1e-9);
  EXPECT_LT(solution.cases[0].moment_residual, 1e-9);
}

// Held along its edges, which do not turn along themselves, a plate sinks by w = 0.00406235 q a^4 /
// D (the same book, table 8) and, by its shear, 0.0736713 q a^2 / (5/6 G t); finer meshes come
// nearer.
TEST(DeckSolution, SimplySupportedPlateConverges) {
  constexpr double t = 0.01, pressure = 1000;
  const double bending = youngs_modulus * t * t * t / (12 * (1 - 0.09));
  const double shear = 5. / 6 * youngs_modulus / 2.6 * t;
  const double expected = pressure * (0.00406235 / bending + 0.0736713 / shear);
  double last = 1;
  for (const int n : {2, 4, 8}) {
    std::string supports = fmt::format("SPC1,1,126,1\nSPC1,1,2,{}\n", n + 1);
    for (int i = 0; i <= n; ++i)
      supports += fmt::format("SPC1,1,35,{},{}\nSPC1,1,34,{},{}\n", 1 + i, 1 + i + (n + 1) * n,
                              1 + (n + 1) * i, 1 + n + (n + 1) * i);
    const Deck deck = test::nastran(
        square_plate(n, 1, supports + fmt::format("PLOAD2,2,-1000.,1,THRU,{}\n", n * n)));
    const DeckSolution solution = solved(deck);
    const double middle =
        std::abs(motion_of(deck, solution.cases.at(0), (n + 1) * (n / 2) + n / 2)[2]);
    const double error = std::abs(middle / expected - 1);
    EXPECT_LT(error, last) << n;
    last = error;
  }
  EXPECT_LT(last, 1e-4);
}

// A plate of 10 x 10 x 0.3 in, clamped along one edge and pulled by 100 lbf at each of six nodes of
// the other, against MSC Nastran 2012 with CQUAD4 (public results of pyNastran's model "plate"):
// two elements of one degree and of different make, at nodes away from the loaded corners.
TEST(DeckSolution, AgreesWithNastran) {
  std::string cards;
  for (int j = 0; j <= 5; ++j)
    cards += fmt::format("SPC1,1,123456,{}\nFORCE,2,{},,100.,1.,0.,0.\n", 1 + 6 * j, 6 + 6 * j);
  std::string text = square_plate(5, 10, cards);
  const std::string properties = plate_properties;
  text.replace(text.find(properties), properties.size(),
               "PSHELL,1,1,0.3,1,,1\nMAT1,1,7.+7,,0.3,0.0003\n");
  const Deck deck = test::nastran(text, "in-lbf");
  EXPECT_EQ(own_degree(deck), 1);
  const DeckSolution solution = solved(deck, 1);
  const DeckCaseSolution& one = solution.cases.at(0);
  const UnitSystem units = unit_system("in-lbf");
  const auto pulled = [&](int node) { return motion_of(deck, one, node - 1, 1)[0] / units.length; };
  EXPECT_NEAR(pulled(14), 5.094331e-6, 0.005 * 5.1e-6);
  EXPECT_NEAR(pulled(16), 1.552539e-5, 0.005 * 1.6e-5);
  EXPECT_NEAR(pulled(18), 2.542402e-5, 0.005 * 2.5e-5);
  EXPECT_NEAR(pulled(12), 2.663531e-5, 0.01 * 2.7e-5);
  const auto pull = [&](int node) { return reaction_at(one, node - 1).force.x() / units.force; };
  EXPECT_NEAR(pull(1), -71.41975, 0.005 * 71);
  EXPECT_NEAR(pull(7), -116.1780, 0.005 * 116);
  EXPECT_NEAR(pull(13), -112.4022, 0.005 * 112);
}

// A bar of 2 m, pinned at one end, on a plane inclined by 30 degrees at the other, with a force in
// its middle: the plane's reaction is normal to it, R cos 30 = P / 2, and the pin takes the rest.
TEST(DeckSolution, SupportsHoldAlongAxesOfTheirOwn) {
  const Deck deck = test::nastran(
      "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n"
      "CORD2R,7,,0.,0.,0.,0.,0.,1.,+\n+,0.8660254,0.5,0.\n"
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.,7\n"
      "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,0.\n"
      "PBAR,1,1,0.01,1.-5,1.-5,2.-5\nMAT1,1,2.+11,,0.3,7850.\n"
      "SPC1,1,12345,1\nSPC1,1,2,3\nFORCE,2,2,,600.,0.,-1.,0.\nENDDATA\n");
  const DeckSolution solution = solved(deck);
  const DeckCaseSolution& one = solution.cases.at(0);
  const double normal = 300 / std::cos(std::numbers::pi / 6);
  const Vector3 expected(-normal * 0.5, 300, 0);
  EXPECT_LT((reaction_at(one, 2).force - expected).norm(), 1e-4);  // the axes have seven digits
  EXPECT_LT((reaction_at(one, 0).force - Vector3(normal * 0.5, 300, 0)).norm(), 1e-4);
  EXPECT_LT(reaction_at(one, 0).moment.norm(), 1e-4);
  EXPECT_LT(one.moment_residual, 1e-6);
}

// A strip of plate pulled out by 1 mm at its end, held at the other: F = E A u / L, nu = 0.
TEST(DeckSolution, GivenDisplacementsPull) {
  const Deck deck = test::nastran(
      "SOL 101\nCEND\nSPC = 1\nBEGIN BULK\n"
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,0.5,0.\nGRID,4,,0.,0.5,0.\n"
      "CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,0.01,1,,1\nMAT1,1,2.+11,,0.,7850.\n"
      "SPC1,1,123456,1\nSPC1,1,1345,4\nSPC,1,2,1,0.001\nSPC,1,3,1,0.001\nENDDATA\n");
  const DeckSolution solution = solved(deck);
  ASSERT_EQ(solution.cases.size(), 1U);
  const DeckCaseSolution& one = solution.cases[0];
  const double force = youngs_modulus * 0.5 * 0.01 * 0.001 / 2;
  EXPECT_NEAR(reaction_at(one, 1).force.x() + reaction_at(one, 2).force.x(), force, 1e-6 * force);
  EXPECT_NEAR(reaction_at(one, 1).force.x(), force / 2, 1e-6 * force);
  EXPECT_NEAR(one.stress.checked_von_mises.value, force / 0.005, 1e-6 * force / 0.005);
  EXPECT_NEAR(one.strain_energy, 0.5 * force * 0.001, 1e-6 * force * 0.001);
}

// Weight on its supports: mass from plates, a point mass and a bar, gravity aslant, two cases that
// share a factorisation and one that nothing holds.
TEST(DeckSolution, SupportsBearTheWeight) {
  const Deck deck = test::nastran(
      "SOL 101\nCEND\n"
      "SUBCASE 1\n SUBTITLE = weight\n SPC = 1\n LOAD = 2\n"
      "SUBCASE 2\n SPC = 1\n LOAD = 3\n"
      "SUBCASE 5\n SUBTITLE = adrift\n LOAD = 3\n"
      "SUBCASE 6\n SPC = 1\n"
      "BEGIN BULK\n"
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\nGRID,4,,0.,1.,0.\n"
      "CQUAD4,1,1,1,2,3,4\nCBAR,2,2,2,3,0.,0.,1.\nCONM2,3,3,,40.\n"
      "PSHELL,1,1,0.01,1,,1\nPBAR,2,1,0.001,1.-6,1.-6,2.-6\nMAT1,1,2.+11,,0.3,7850.\n"
      "SPC1,1,123456,1,4\nGRAV,2,,9.81,0.6,0.,-0.8\nFORCE,3,3,,500.,0.,0.,-1.\nENDDATA\n");
  const DeckSolution solution = solved(deck);
  ASSERT_EQ(solution.cases.size(), 2U);
  const double mass = 7850 * 0.02 + 7850 * 0.001 + 40;
  const Vector3 weight = 9.81 * mass * Vector3(0.6, 0, -0.8);
  EXPECT_LT((solution.cases[0].applied.force - weight).norm(), 1e-9 * weight.norm());
  EXPECT_LT((solution.cases[0].supported.force + weight).norm(), rounding * weight.norm());
  EXPECT_LT((solution.cases[1].supported.force - Vector3(0, 0, 500)).norm(), rounding * 500);
  EXPECT_LT((solution.cases[1].supported.moment - Vector3(500, -1000, 0)).norm(), rounding * 1000);
  EXPECT_EQ(solution.cases[0].stress.name, "case 1 (weight)");
  ASSERT_EQ(solution.skipped.size(), 2U);
  EXPECT_EQ(solution.skipped[0].load_case, 2);
  EXPECT_FALSE(solution.skipped[0].is_held);
  EXPECT_TRUE(solution.skipped[1].is_held);
}

// A load on a bar, even along it: the cantilever's end sinks by q L^4 / (8 E I) and turns by
// q L^3 / (6 E I).
TEST(DeckSolution, LoadsAlongBars) {
  const Deck deck = test::nastran(
      "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n"
      "GRID,1,,0.,0.,0.\nGRID,2,,3.,0.,0.\n"
      "CBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,0.01,1.-5,1.-5,2.-5\nMAT1,1,2.+11,,0.3,7850.\n"
      "SPC1,1,123456,1\nPLOAD1,2,1,FY,FR,0.,-200.,1.,-200.\nENDDATA\n");
  const DeckSolution solution = solved(deck);
  const DeckCaseSolution& one = solution.cases.at(0);
  const double bending = youngs_modulus * 1e-5;
  const Eigen::Matrix<double, 6, 1> end = motion_of(deck, one, 1);
  EXPECT_NEAR(end[1], -200 * 81 / (8 * bending), 1e-3 * 200 * 81 / (8 * bending));
  EXPECT_NEAR(end[5], -200 * 27 / (6 * bending), 1e-3 * 200 * 27 / (6 * bending));
  EXPECT_NEAR(reaction_at(one, 0).force.y(), 600, rounding * 600);
  EXPECT_NEAR(reaction_at(one, 0).moment.z(), 900, rounding * 900);
}

// A support on a node that follows others through a rigid link holds them: a cantilever whose end
// is held by way of an RBE2 is the cantilever.
TEST(DeckSolution, SupportsHoldThroughLinks) {
  const Deck deck = test::nastran(
      "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n"
      "GRID,1,,0.,0.,0.\nGRID,2,,3.,0.,0.\nGRID,9,,0.,0.5,0.\n"
      "CBAR,1,1,1,2,0.,1.,0.\nRBE2,5,1,123456,9\n"
      "PBAR,1,1,0.01,1.-5,1.-5,2.-5\nMAT1,1,2.+11,,0.3,7850.\n"
      "SPC1,1,123456,9\nFORCE,2,2,,100.,0.,1.,0.\nENDDATA\n");
  const DeckSolution solution = solved(deck);
  const DeckCaseSolution& one = solution.cases.at(0);
  const double sunk = 100 * 27 / (3 * youngs_modulus * 1e-5);
  EXPECT_NEAR(motion_of(deck, one, 1)[1], sunk, 1e-3 * sunk);
  EXPECT_LT((reaction_at(one, 2).force - Vector3(0, -100, 0)).norm(), rounding * 100);
  EXPECT_LT((reaction_at(one, 2).moment - Vector3(0, 0, -300)).norm(), rounding * 300);
}

// A plate pulled at its nodes: triangles, which are squares with one edge drawn together, have no
// other stress beside those nodes than squares have. It was a thousand times as large where tied
// strains were taken near the point that such an edge is.
TEST(DeckSolution, TrianglesHaveTheStressOfSquares) {
  constexpr int n = 4;
  std::string cards;
  for (int j = 0; j <= n; ++j)
    cards += fmt::format("SPC1,1,123456,{}\nFORCE,2,{},,100.,1.,0.,0.\n", 1 + (n + 1) * j,
                         1 + n + (n + 1) * j);
  const std::string squares = square_plate(n, 1, cards);
  std::string triangles = squares;
  for (int e = 1; e <= n * n; ++e) {
    const int first = 1 + (e - 1) % n + (n + 1) * ((e - 1) / n), above = first + n + 1;
    const std::string square =
        fmt::format("CQUAD4,{},1,{},{},{},{}\n", e, first, first + 1, above + 1, above);
    triangles.replace(triangles.find(square), square.size(),
                      fmt::format("CTRIA3,{},1,{},{},{}\nCTRIA3,{},1,{},{},{}\n", e, first,
                                  first + 1, above + 1, 100 + e, first, above + 1, above));
  }
  for (const int degree : {2, 3, 4}) {
    const double of_squares =
        solved(test::nastran(squares), degree).cases.at(0).stress.peak_von_mises.value;
    const double of_triangles =
        solved(test::nastran(triangles), degree).cases.at(0).stress.peak_von_mises.value;
    EXPECT_LT(of_triangles, 1.3 * of_squares) << degree;
    EXPECT_GT(of_triangles, 0.6 * of_squares) << degree;
  }
}

std::string why_not_solved(const Deck& deck) {
  try {
    solved(deck);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "solved";
}

// Three bars in a row that turn about their first end, by themselves and by way of a rigid link:
// the message has the end that moves most, whatever the others may be moved by.
TEST(DeckSolution, TellsWhatSupportsLeaveFree) {
  const auto bars = [](const std::string& cards) {
    return test::nastran(
        "SOL 101\nCEND\nSUBCASE 4\n SPC = 1\n LOAD = 2\nBEGIN BULK\n"
        "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\nGRID,4,,4.,0.,0.\n"
        "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,0.\nCBAR,3,1,3,4,0.,1.,0.\n"
        "PBAR,1,1,0.01,1.-5,1.-5,2.-5\nMAT1,1,2.+11,,0.3,7850.\n"
        "FORCE,2,2,,100.,0.,1.,0.\n" +
        cards + "ENDDATA\n");
  };
  for (const std::string support : {"SPC1,1,12345,1\n", "SPC1,1,2345,1\nSPC,1,1,1,0.002\n",
                                    "GRID,9,,0.,0.,0.5\nRBE2,5,1,123456,9\nSPC1,1,12345,9\n"})
    EXPECT_THAT(why_not_solved(bars(support)),
                ::testing::AllOf(::testing::HasSubstr("the supports of case 4 leave a part free"),
                                 ::testing::HasSubstr("at (4, 0, 0) m, displacement along y")))
        << support;
}

// The same in Abaqus' words: clamped at one end, a force and a moment at the other.
TEST(DeckSolution, SolvesStepsOfAbaqus) {
  const Deck deck = test::abaqus(
      "*NODE\n1, 0., 0., 0.\n2, 3., 0., 0.\n"
      "*ELEMENT, TYPE=B31, ELSET=ALL\n1, 1, 2\n"
      "*BEAM GENERAL SECTION, ELSET=ALL, SECTION=GENERAL, DENSITY=7850.\n"
      "0.01, 1.E-5, 0., 1.E-5, 2.E-5\n0., 0., -1.\n2.E11, 7.7E10\n"
      "*STEP\n*STATIC\n*BOUNDARY\n1, 1, 6\n*CLOAD\n2, 2, -50.\n2, 6, 20.\n*END STEP\n");
  const DeckSolution solution = solved(deck);
  ASSERT_EQ(solution.cases.size(), 1U);
  const double bending = youngs_modulus * 1e-5;
  const double sunk = -50 * 27 / (3 * bending) + 20 * 9 / (2 * bending);
  EXPECT_NEAR(motion_of(deck, solution.cases[0], 1)[1], sunk, 2e-3 * std::abs(sunk));
  EXPECT_NEAR(reaction_at(solution.cases[0], 0).moment.z(), 130, 1e-5);
}

/// A cube of 1 m whose lower corners are held against displacement; grid 9 is above it.
std::string held_cube(const std::string& cards) {
  return "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n"
         "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
         "GRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\n"
         "GRID,9,,.5,.3,1.5\nCHEXA,1,1,1,2,3,4,5,6\n,7,8\nPSOLID,1,1\n"
         "MAT1,1,2.+11,,0.3,7850.\nSPC1,1,123,1,2,3,4\n" +
         cards + "ENDDATA\n";
}

// A link that counts the rotations of solids' grids, which resist none, spreads forces and moments
// to their displacements: all of them arrive at the supports.
TEST(DeckSolution, LinksOnSolidsPassMomentsOn) {
  const Deck deck =
      test::nastran(held_cube("RBE3,20,,9,123456,1.,123456,5,6\n,7,8\n"
                              "FORCE,2,9,,1000.,1.,0.,-1.\nMOMENT,2,9,,500.,1.,0.,0.\n"));
  const DeckSolution solution = solved(deck, 1);
  const DeckCaseSolution& one = solution.cases.at(0);
  EXPECT_LT(one.force_residual, rounding);
  EXPECT_LT(one.moment_residual, rounding);
  // r x F + M about the origin, r = (0.5, 0.3, 1.5), F = (1000, 0, -1000).
  test::expect_near(one.supported.moment, -Vector3(-300 + 500, 1500 + 500, -300), 1e-2);
}

// A solid's grid takes no moment, nor does a joint of rods; a support takes one itself.
TEST(DeckSolution, LoadsThatNothingBearsAreRefused) {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      solved(test::nastran(text), 1);
    } catch (const ModelError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(complaint(held_cube("FORCE,2,5,,1000.,1.,0.,0.\nMOMENT,2,6,,500.,0.,1.,0.\n")),
              ::testing::HasSubstr("a moment acts at node 6 at (1, 0, 1) m: no element resists the "
                                   "rotation about y there"));
  const Deck held = test::nastran(
      held_cube("FORCE,2,5,,1000.,1.,0.,0.\nMOMENT,2,1,,500.,0.,1.,0.\nSPC1,1,456,1\n"));
  const DeckSolution solution = solved(held, 1);
  EXPECT_NEAR(reaction_at(solution.cases.at(0), 0).moment.y(), -500, 1e-9);
  EXPECT_LT(solution.cases[0].moment_residual, rounding);
  const std::string tripod =
      "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n"
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,.3,.3,1.\n"
      "CROD,1,1,1,4\nCROD,2,1,2,4\nCROD,3,1,3,4\nPROD,1,1,.001\nMAT1,1,2.+11,,0.3,7850.\n"
      "SPC1,1,123,1,2,3\nFORCE,2,4,,1000.,0.,0.,-1.\n";
  EXPECT_EQ(complaint(tripod + "ENDDATA\n"), "");
  EXPECT_THAT(complaint(tripod + "MOMENT,2,4,,500.,1.,0.,0.\nENDDATA\n"),
              ::testing::HasSubstr("do not arrive at the supports"));
  // A blank torsion constant is none.
  EXPECT_THAT(complaint("SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n"
                        "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCBAR,1,1,1,2,0.,0.,1.\n"
                        "PBAR,1,1,.01,1.-5,1.-5\nMAT1,1,2.+11,,0.3,7850.\nSPC1,1,123456,1\n"
                        "MOMENT,2,2,,500.,1.,0.,0.\nENDDATA\n"),
              ::testing::HasSubstr("or about bars without a torsion constant"));
}

/// Largest displacement of the nodes at a place.
double displacement_at(const Deck& deck, const DeckCaseSolution& solution, const Vector3& place) {
  const ElasticModel model = model_of(deck, 2);
  double largest = 0;
  for (int node = 0; node < model.space().node_count(); ++node)
    if ((model.space().nodes().col(node) - place).norm() < 1e-9)
      largest = std::max(largest, solution.motion.segment<3>(6L * node).norm());
  return largest;
}

// Of a linear element an edge between held corners is held; the middle that a quadratic one has
// there is a node of its own, free where the deck does not hold it.
TEST(DeckSolution, MiddlesOfTheDeckAreFreeUnlessHeld) {
  const std::string push = "FORCE,2,5,,1.+6,1.,0.,-1.\n";
  const std::string linear = held_cube(push);
  const std::string middles =
      "GRID,11,,.5,0.,0.\nGRID,12,,1.,.5,0.\nGRID,13,,.5,1.,0.\nGRID,14,,0.,.5,0.\n"
      "GRID,15,,0.,0.,.5\nGRID,16,,1.,0.,.5\nGRID,17,,1.,1.,.5\nGRID,18,,0.,1.,.5\n"
      "GRID,19,,.5,0.,1.\nGRID,20,,1.,.5,1.\nGRID,21,,.5,1.,1.\nGRID,22,,0.,.5,1.\n";
  const auto quadratic = [&](const std::string& more) {
    std::string text = held_cube(push + middles + more);
    const std::string corners = ",7,8\n";
    return text.replace(text.find(corners), corners.size(),
                        ",7,8,11,12,13,14,15,16\n,17,18,19,20,21,22\n");
  };
  const auto moved = [](const std::string& text) {
    const Deck deck = test::nastran(text);
    return displacement_at(deck, solved(deck, 2).cases.at(0), Vector3(0.5, 0, 0));
  };
  EXPECT_LT(moved(linear), 1e-15);
  EXPECT_GT(moved(quadratic("")), 1e-8);
  EXPECT_LT(moved(quadratic("SPC1,1,123,11\n")), 1e-15);
  // Written, the middles that the reader made are nodes, and held.
  const Deck deck = test::nastran(linear);
  const DeckSolution before = solved(deck, 2);
  for (const Deck& again : {test::nastran(to_nastran(deck)), test::abaqus(to_abaqus(deck))})
    EXPECT_NEAR(solved(again, 2).cases.at(0).strain_energy, before.cases.at(0).strain_energy,
                1e-7 * before.cases[0].strain_energy);
}

// The same of an edge of a plate: clamped corners alone, or all of the edge's nodes.
TEST(DeckSolution, MiddlesOfPlatesAreFreeUnlessHeld) {
  const auto moved = [](const std::string& card, const std::string& more) {
    const Deck deck = test::nastran(
        "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n"
        "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
        "GRID,5,,.5,0.,0.\nGRID,6,,1.,.5,0.\nGRID,7,,.5,1.,0.\nGRID,8,,0.,.5,0.\n" +
        card + plate_properties + "SPC1,1,123456,1,4\nFORCE,2,3,,1000.,0.,0.,1.\n" + more +
        "ENDDATA\n");
    return displacement_at(deck, solved(deck, 2).cases.at(0), Vector3(0, 0.5, 0));
  };
  const std::string eight = "CQUAD8,1,1,1,2,3,4,5,6\n,7,8\n";
  EXPECT_LT(moved("CQUAD4,1,1,1,2,3,4\n", ""), 1e-12);
  EXPECT_GT(moved(eight, ""), 1e-6);
  EXPECT_LT(moved(eight, "SPC1,1,123456,8\n"), 1e-12);
}

}  // namespace
}  // namespace blocklift::structure
