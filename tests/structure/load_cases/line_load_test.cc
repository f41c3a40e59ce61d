// Loads along bars (PLOAD1) against closed forms of slender beams.
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

// A bar of 100 x 200 mm and 4 m, bent along its height by forces along y.
constexpr double loaded_modulus = 2e11, loaded_length = 4, loaded_second_moment = 2e-4 / 3,
                 loaded_half_height = 0.1;
constexpr double loaded_shear_modulus = loaded_modulus / 2.6, loaded_torsion = 4.58e-5;
// Shear, which the bar has none of, is resisted by ten thousand times its area.
constexpr double slender_share = 1e-4;

std::string loaded_bar(const std::string& supports_and_loads, const std::string& offsets = "") {
  return "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n"
         "GRID,1,,0.,0.,0.\nGRID,2,,4.,0.,0.\n"
         "CBAR,1,1,1,2,0.,1.,0.\n" +
         offsets +
         "PBAR,1,1,0.02,6.6666667-5,1.6666667-5,4.58-5\n"
         "MAT1,1,2.+11,,0.3,7850.\n" +
         supports_and_loads + "ENDDATA\n";
}

const char* const clamped_at_first = "SPC1,1,123456,1\n";

ElasticModel loaded_model(const Deck& deck, int degree) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  return {std::move(mesh), {degree, {}}};
}

DeckCaseSolution solve_loaded(const Deck& deck, int degree = 3) {
  return solve_deck(loaded_model(deck, degree), deck, 1).cases.at(0);
}

Eigen::Matrix<double, 6, 1> motion_of_loaded(const Deck& deck, const DeckCaseSolution& solution,
                                             int vertex) {
  return solution.motion.segment<6>(6L * loaded_model(deck, 3).space().node_of_vertex(vertex));
}

double stress_of_moment(double moment) {
  return moment * loaded_half_height / loaded_second_moment;
}

struct ExpectedCantilever {
  double tip = 0;     ///< along y, m
  double moment = 0;  ///< at the clamp, N m
};

void expect_cantilever(const std::string& loads, const ExpectedCantilever& expected) {
  const Deck deck = test::nastran(loaded_bar(clamped_at_first + loads));
  const DeckCaseSolution solution = solve_loaded(deck);
  EXPECT_NEAR(motion_of_loaded(deck, solution, 1)[1], expected.tip,
              slender_share * std::abs(expected.tip))
      << loads;
  EXPECT_NEAR(solution.stress.peak_von_mises.value, stress_of_moment(expected.moment),
              1e-3 * stress_of_moment(expected.moment))
      << loads;
  EXPECT_LT(solution.force_residual, 1e-7) << loads;
}

// P a^2 (3 l - a) / (6 E I), P a at the clamp.
TEST(LineLoads, AForceBetweenTheEnds) {
  constexpr double force = 1e4, a = 1.5;
  const ExpectedCantilever expected{
      -force * a * a * (3 * loaded_length - a) / (6 * loaded_modulus * loaded_second_moment),
      force * a};
  expect_cantilever("PLOAD1,2,1,FY,LE,1.5,-10000.\n", expected);
  expect_cantilever("PLOAD1,2,1,FYE,FR,.375,-10000.,.375,-10000.\n", expected);
}

// Between two clamps and in the middle: P l / 8 there and at the ends; P l^3 / (192 E I).
TEST(LineLoads, AForceInTheMiddleBetweenTwoClamps) {
  const Deck deck = test::nastran(loaded_bar("SPC1,1,123456,1,2\nPLOAD1,2,1,FY,FR,.5,-10000.\n"));
  ASSERT_EQ(deck.mesh.beams.size(), 2U);
  const DeckCaseSolution solution = solve_loaded(deck, 1);
  const double due = stress_of_moment(1e4 * loaded_length / 8);
  EXPECT_NEAR(solution.stress.peak_von_mises.value, due, 1e-3 * due);
  const double sunk =
      -1e4 * std::pow(loaded_length, 3) / (192 * loaded_modulus * loaded_second_moment);
  EXPECT_NEAR(motion_of_loaded(deck, solution, 2)[1], sunk, slender_share * -sunk);
}

// From 0 at 1 m to q at 3 m, the sum of forces at their places: q (x - 1) / 2 dx.
TEST(LineLoads, ALinearLoadOnAPart) {
  constexpr double q = 1e4;
  const auto antiderivative = [](double x) {
    return 13. / 4 * std::pow(x, 4) - 4 * std::pow(x, 3) - std::pow(x, 5) / 5;
  };
  const ExpectedCantilever expected{-q / 2 * (antiderivative(3) - antiderivative(1)) /
                                        (6 * loaded_modulus * loaded_second_moment),
                                    q * (1 + 4. / 3)};
  expect_cantilever("PLOAD1,2,1,FY,FR,.25,0.,.75,-10000.\n", expected);
  expect_cantilever("PLOAD1,2,1,FY,LE,1.,0.,3.,-10000.\n", expected);
}

// An even load on the outer half: q l^2 / 2 (1 - 1/4) at the clamp; q (41 l^4 / 384) / (E I).
TEST(LineLoads, AnEvenLoadOnAPart) {
  expect_cantilever(
      "PLOAD1,2,1,FY,FR,.5,-10000.,1.,-10000.\n",
      {-1e4 * 41 * std::pow(loaded_length, 4) / (384 * loaded_modulus * loaded_second_moment),
       1e4 * loaded_length * loaded_length * 3 / 8});
}

// A triangle between two clamps: q l^2 / 20 at its higher end. The cubic moments of a quarter of
// the bar are parabolas here, q l^2 / 7680 off at its ends: 0.3 %.
TEST(LineLoads, ATriangleBetweenTwoClamps) {
  const Deck deck =
      test::nastran(loaded_bar("SPC1,1,123456,1,2\nPLOAD1,2,1,FY,FR,0.,0.,1.,-10000.\n"));
  const double due = stress_of_moment(1e4 * loaded_length * loaded_length / 20);
  EXPECT_NEAR(solve_loaded(deck).stress.peak_von_mises.value, due, 4e-3 * due);
}

// M a (l - a / 2) / (E I) at the tip, M at the clamp; an even moment per length gives m l there and
// m l^3 / (3 E I) at the tip.
TEST(LineLoads, MomentsAcross) {
  constexpr double moment = 1e4, a = 1.5;
  expect_cantilever(
      "PLOAD1,2,1,MZ,LE,1.5,10000.\n",
      {moment * a * (loaded_length - a / 2) / (loaded_modulus * loaded_second_moment), moment});
  expect_cantilever(
      "PLOAD1,2,1,MZE,FR,0.,10000.,1.,10000.\n",
      {moment * std::pow(loaded_length, 3) / (3 * loaded_modulus * loaded_second_moment),
       moment * loaded_length});
}

// Even t per length: t l^2 / (2 G J); T at a place: T a / (G J).
TEST(LineLoads, MomentsAlong) {
  const auto twist = [](const std::string& load) {
    const Deck deck = test::nastran(loaded_bar(clamped_at_first + load));
    return motion_of_loaded(deck, solve_loaded(deck), 1)[3];
  };
  const double even =
      1000 * loaded_length * loaded_length / (2 * loaded_shear_modulus * loaded_torsion);
  EXPECT_NEAR(twist("PLOAD1,2,1,MX,FR,0.,1000.,1.,1000.\n"), even, 1e-6 * even);
  const double at_a_place = 1000 * 1.5 / (loaded_shear_modulus * loaded_torsion);
  EXPECT_NEAR(twist("PLOAD1,2,1,MXE,LE,1.5,1000.\n"), at_a_place, 1e-6 * at_a_place);
}

// A bar from the origin to (3, 4, 0): what is projected counts per length seen along the force.
TEST(LineLoads, DirectionsAndProjections) {
  const auto applied = [](const std::string& load) {
    const Deck deck = test::nastran(
        "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,3.,4.,0.\n"
        "CBAR,1,1,1,2,0.,0.,1.\nPBAR,1,1,0.02,6.7-5,1.7-5,4.58-5\nMAT1,1,2.+11,,0.3,7850.\n"
        "SPC1,1,123456,1\n" +
        load + "ENDDATA\n");
    return solve_loaded(deck).applied;
  };
  const auto expect_force = [&](const std::string& load, const Vector3& force, double share) {
    const Wrench wrench = applied(load);
    EXPECT_LT((wrench.force - force).norm(), 1e-9 * force.norm()) << load;
    const Vector3 moment = (share * Vector3(3, 4, 0)).cross(force);
    EXPECT_LT((wrench.moment - moment).norm(), 1e-8 * force.norm()) << load;
  };
  expect_force("PLOAD1,2,1,FY,FR,0.,100.,1.,100.\n", Vector3(0, 500, 0), 0.5);
  expect_force("PLOAD1,2,1,FY,FRPR,0.,100.,1.,100.\n", Vector3(0, 300, 0), 0.5);
  expect_force("PLOAD1,2,1,FX,LEPR,0.,100.,5.,100.\n", Vector3(400, 0, 0), 0.5);
  expect_force("PLOAD1,2,1,FZ,LEPR,0.,0.,5.,100.\n", Vector3(0, 0, 250), 2. / 3);
  expect_force("PLOAD1,2,1,FY,FRPR,.25,100.\n", Vector3(0, 100, 0), 0.25);
  expect_force("PLOAD1,2,1,FXE,FR,0.,100.,1.,100.\n", Vector3(300, 400, 0), 0.5);
  expect_force("PLOAD1,2,1,FYE,FRPR,0.,100.,1.,100.\n", Vector3(0, 0, 500), 0.5);
  expect_force("PLOAD1,2,1,FZE,FR,0.,100.,1.,100.\n", Vector3(400, -300, 0), 0.5);
  const Wrench turned = applied("PLOAD1,2,1,MZE,FR,0.,100.,1.,100.\n");
  EXPECT_LT((turned.moment - Vector3(400, -300, 0)).norm(), 1e-6);
}

// The line that the offsets lead to bears the load, and its length counts: from (0, 0, 0.3) to
// (4, 0, 3.3) it is 5 m.
TEST(LineLoads, OffsetBarsBearTheirLoadsBesideTheirGrids) {
  const auto applied = [](const std::string& load, const std::string& offsets) {
    return solve_loaded(test::nastran(loaded_bar(clamped_at_first + load, offsets))).applied;
  };
  const Wrench even = applied("PLOAD1,2,1,FY,FR,0.,100.,1.,100.\n", ",,,0.,0.,.3,0.,0.,.3\n");
  EXPECT_LT((even.moment - Vector3(2, 0, .3).cross(Vector3(0, 400, 0))).norm(), 1e-6);
  const Wrench leaning = applied("PLOAD1,2,1,FY,LE,2.5,100.\n", ",,,0.,0.,.3,0.,0.,3.3\n");
  EXPECT_LT((leaning.moment - Vector3(2, 0, 1.8).cross(Vector3(0, 100, 0))).norm(), 1e-6);
  const Wrench whole = applied("PLOAD1,2,1,FY,FR,0.,100.,1.,100.\n", ",,,0.,0.,.3,0.,0.,3.3\n");
  EXPECT_LT((whole.force - Vector3(0, 500, 0)).norm(), 1e-6);
}

// A bar along a plate's edge, which is not divided: whatever cells it has, all of the load acts.
TEST(LineLoads, CellsOfABarAlongAPlateShareTheLoad) {
  const Deck deck = test::nastran(
      "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n"
      "GRID,1,,0.,0.,0.\nGRID,2,,4.,0.,0.\nGRID,3,,4.,1.,0.\nGRID,4,,0.,1.,0.\n"
      "CQUAD4,10,5,1,2,3,4\nPSHELL,5,1,.01,1,,1\nCBAR,1,1,1,2,0.,0.,1.\n"
      "PBAR,1,1,0.02,6.7-5,1.7-5,4.58-5\nMAT1,1,2.+11,,0.3,7850.\nSPC1,1,123456,1,4\n"
      "PLOAD1,2,1,FZ,FR,.3,-100.\nPLOAD1,2,1,FZ,FR,.2,0.,.9,-100.\nENDDATA\n");
  EXPECT_EQ(deck.mesh.beams.size(), 1U);
  ASSERT_EQ(deck.remarks.size(), 1U);
  EXPECT_THAT(deck.remarks[0].text, HasSubstr("not divided there"));
  for (const int degree : {1, 2, 3}) {
    Mesh mesh = deck.mesh;
    for (Material& material : mesh.materials) material.yield_stress = 235e6;
    const DeckCaseSolution solution =
        solve_deck(ElasticModel(std::move(mesh), {degree, {}}), deck, 1).cases.at(0);
    EXPECT_NEAR(solution.applied.force.z(), -240, 1e-6) << degree;
    // 100 N at 1.2 m, 140 N at 0.8 + 2/3 * 2.8 m.
    EXPECT_NEAR(solution.applied.moment.y(), 100 * 1.2 + 140 * (0.8 + 2. / 3 * 2.8), 1e-6)
        << degree;
  }
}

// Bars in a row, each with an even load of its own: none takes that of another.
TEST(LineLoads, EachBarOfARowHasItsOwn) {
  constexpr int bars = 40;
  constexpr double length = 0.1;
  std::string text = "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\nGRID,1,,0.,0.,0.\n";
  double force = 0, moment = 0;
  for (int k = 1; k <= bars; ++k) {
    text += fmt::format(
        "GRID,{1},,{2:.2f},0.,0.\nCBAR,{0},1,{0},{1},0.,1.,0.\n"
        "PLOAD1,2,{0},FY,FR,0.,{0}.,1.,{0}.\n",
        k, k + 1, length * k);
    force += k * length;
    moment += k * length * length * (k - 0.5);
  }
  const Deck deck = test::nastran(
      text +
      "PBAR,1,1,0.02,6.7-5,1.7-5,4.58-5\nMAT1,1,2.+11,,0.3,7850.\nSPC1,1,123456,1\nENDDATA\n");
  const Wrench applied = solve_loaded(deck).applied;
  EXPECT_LT((applied.force - Vector3(0, force, 0)).norm(), 1e-9 * force);
  EXPECT_LT((applied.moment - Vector3(0, 0, moment)).norm(), 1e-9 * moment);
}

// A taper is divided at the place of a load: its sections there lie between those of its ends.
TEST(LineLoads, TapersAreDividedToo) {
  const Deck deck = test::nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,4.,0.,0.\nCBEAM,9,5,1,2,0.,0.,1.\n"
      "PBEAM,5,7,.02,4.-6,1.-6,0.,2.-6\n,NO,1.,.04,8.-6,2.-6,0.,4.-6\n"
      "MAT1,7,206.+9,,.3,7850.\nPLOAD1,3,9,FZ,FR,.25,-5.\n");
  ASSERT_EQ(deck.mesh.beams.size(), 2U);
  EXPECT_NEAR(section_at(deck.mesh, deck.mesh.beams[0], 1).area, 0.025, 1e-12);
  EXPECT_NEAR(section_at(deck.mesh, deck.mesh.beams[1], 0).area, 0.025, 1e-12);
  EXPECT_NEAR(section_at(deck.mesh, deck.mesh.beams[1], 1).area, 0.04, 1e-12);
  ASSERT_EQ(deck.load_sets.at(0).beam_loads.size(), 1U);
}

// Written and read again, loads along bars act as before; for Abaqus they are put on the nodes.
TEST(LineLoads, WrittenAndReadAgainTheyAreTheSame) {
  const Deck deck = test::nastran(
      loaded_bar(std::string(clamped_at_first) +
                     "PLOAD1,2,1,FY,LE,1.5,-10000.\nPLOAD1,2,1,FZ,FR,.25,0.,.75,-100.\n"
                     "PLOAD1,2,1,MX,FR,0.,20.,1.,20.\nPLOAD1,2,1,FY,FR,0.,-100.,1.,-100.\n",
                 ",,,0.,0.,.3,0.,0.,.3\n"));
  const DeckCaseSolution before = solve_loaded(deck);
  const Deck again = test::nastran(to_nastran(deck));
  const Eigen::Matrix<double, 6, 1> tip = motion_of_loaded(deck, before, 1);
  EXPECT_LT((motion_of_loaded(again, solve_loaded(again), 1) - tip).norm(), 1e-6 * tip.norm());
  const Wrench steps = solve_loaded(test::abaqus(to_abaqus(deck))).applied;
  EXPECT_LT((steps.force - before.applied.force).norm(), 1e-6 * before.applied.force.norm());
  EXPECT_LT((steps.moment - before.applied.moment).norm(), 1e-6 * before.applied.moment.norm());
}

}  // namespace
}  // namespace blocklift::structure
