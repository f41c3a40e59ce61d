// Temperatures in a deck's own load cases: bodies that expand as they like or not at all, and what
// bends through a difference of temperature, against the closed forms.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/formulation/solid.h"
#include "structure/load_cases/deck_heat.h"
#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/stress/shell_stress.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

constexpr double hot_modulus = 2e11, hot_ratio = 0.3, hot_coefficient = 1.2e-5;  // Pa, -, 1/K
constexpr double hot_rise = 50;                                                  // K
constexpr double hot_stress = hot_modulus * hot_coefficient * hot_rise;          // Pa

/// Expands by 1.2e-5 from 20 degrees on.
const char* const hot_steel = "MAT1,1,2.+11,,0.3,7850.,1.2-5,20.\n";

const char* const hot_case_control =
    "SOL 101\nCEND\nSPC = 1\nSUBCASE 1\nTEMPERATURE(LOAD) = 5\nBEGIN BULK\n";

ElasticModel hot_model(const Deck& deck, int degree) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  return {std::move(mesh), {degree, {}}};
}

/// A deck's first case and what it was solved on.
struct HotCase {
  explicit HotCase(Deck read, int degree = 2)
      : deck(std::move(read)),
        model(hot_model(deck, degree)),
        solution(solve_deck(model, deck, 1)) {}

  const DeckCaseSolution& first() const { return solution.cases.at(0); }
  Vector3 moved(int vertex) const {
    return first().motion.segment<3>(6L * model.space().node_of_vertex(vertex));
  }
  double largest_force() const {
    double largest = 0;
    for (const SupportReaction& reaction : first().reactions)
      largest = std::max(largest, reaction.force.norm());
    return largest;
  }
  CellHeat heat() const { return heat_of(model, deck, {first().load_case}).value(); }

  Deck deck;
  ElasticModel model;
  DeckSolution solution;
};

/// Nothing holds it: no stress, no reactions, no energy.
void expect_free(const HotCase& hot, double tolerance = 1e-7) {
  const DeckCaseSolution& one = hot.first();
  EXPECT_LT(one.stress.peak_von_mises.value, tolerance * hot_stress);
  EXPECT_LT(one.stress.checked_von_mises.value, tolerance * hot_stress);
  EXPECT_LT(hot.largest_force(), tolerance * hot_stress);  // areas are of 1 m^2 or less
  EXPECT_LT(one.force_residual, 1e-6);
  EXPECT_EQ(one.estimated_error, 0);
  const double held = hot.heat().held_energy()[0];
  EXPECT_GT(held, 0);
  EXPECT_LT(std::abs(one.strain_energy), 1e-7 * held);
}

/// Vertices move as a field says.
void expect_motion(const HotCase& hot, const std::function<Vector3(const Vector3&)>& expected) {
  for (std::size_t v = 0; v < hot.deck.mesh.vertices.size(); ++v)
    EXPECT_LT((hot.moved(static_cast<int>(v)) - expected(hot.deck.mesh.vertices[v])).norm(),
              1e-7 * hot_coefficient * hot_rise)
        << "vertex " << v;
}

/// Four plates about a grid that is off their middle, on 2 x 1 m, 20 mm thick.
std::string distorted_plate(const char* card_end = "") {
  std::string text;
  const std::array<std::array<double, 2>, 9> places{
      {{0, 0}, {1, 0}, {2, 0}, {0, 0.5}, {1.2, 0.4}, {2, 0.5}, {0, 1}, {1, 1}, {2, 1}}};
  for (std::size_t i = 0; i < places.size(); ++i)
    text += fmt::format("GRID,{},,{:.3f},{:.3f},0.\n", i + 1, places[i][0], places[i][1]);
  const std::array<std::array<int, 4>, 4> plates{
      {{1, 2, 5, 4}, {2, 3, 6, 5}, {4, 5, 8, 7}, {5, 6, 9, 8}}};
  for (std::size_t i = 0; i < plates.size(); ++i)
    text += fmt::format("CQUAD4,{},1,{},{},{},{}{}\n", i + 1, plates[i][0], plates[i][1],
                        plates[i][2], plates[i][3], card_end);
  return text + "PSHELL,1,1,.02,1,,1\n" + hot_steel;
}

/// Held as a body alone: grids 1, 3 and 7.
const char* const hot_plate_held = "SPC1,1,123,1\nSPC1,1,23,3\nSPC1,1,3,7\n";

// u = alpha T x, whatever the elements' shape.
TEST(Heat, AFreePlateExpandsWithoutStress) {
  for (const int degree : {1, 2, 3}) {
    SCOPED_TRACE(degree);
    const HotCase hot(
        test::nastran(hot_case_control + distorted_plate() + hot_plate_held + "TEMPD,5,70.\n"),
        degree);
    expect_free(hot);
    expect_motion(hot, [](const Vector3& x) -> Vector3 { return hot_coefficient * hot_rise * x; });
  }
}

// With T = c x a free plate stays free of stress: u = alpha c (x^2 - y^2) / 2, v = alpha c x y, of
// second degree (Boley and Weiner 1960, section 3.9: a linear temperature stresses no free body).
TEST(Heat, ALinearTemperatureDoesNotStressAFreePlate) {
  std::string temperatures;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      temperatures += fmt::format("TEMP,5,{},{:.1f}\n", 3 * j + i + 1, 20 + 50.0 * i);
  std::string plate;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      plate += fmt::format("GRID,{},,{:.1f},{:.1f},0.\n", 3 * j + i + 1, 1.0 * i, 0.5 * j);
  plate += "CQUAD4,1,1,1,2,5,4\nCQUAD4,2,1,2,3,6,5\nCQUAD4,3,1,4,5,8,7\nCQUAD4,4,1,5,6,9,8\n";
  plate += std::string("PSHELL,1,1,.02,1,,1\n") + hot_steel;
  for (const int degree : {2, 3}) {
    SCOPED_TRACE(degree);
    const HotCase hot(test::nastran(hot_case_control + plate + hot_plate_held + temperatures),
                      degree);
    expect_free(hot);
    expect_motion(hot, [](const Vector3& x) -> Vector3 {
      return hot_coefficient * hot_rise *
             Vector3((x.x() * x.x() - x.y() * x.y()) / 2, x.x() * x.y(), 0);
    });
  }
}

// -E alpha T / (1 - nu) in both directions; it has this as its von Mises stress.
TEST(Heat, AHeldPlateIsPressed) {
  const double expected = hot_stress / (1 - hot_ratio);
  for (const int degree : {1, 2}) {
    SCOPED_TRACE(degree);
    const HotCase hot(test::nastran(hot_case_control + distorted_plate() +
                                    "SPC1,1,123456,1,THRU,9\nTEMPD,5,70.\n"),
                      degree);
    const DeckCaseSolution& one = hot.first();
    EXPECT_NEAR(one.stress.peak_von_mises.value, expected, 1e-6 * expected);
    EXPECT_NEAR(one.stress.checked_von_mises.value, expected, 1e-6 * expected);
    const CellHeat heat = hot.heat();
    ShellStress stress(hot.model.space(), Eigen::Vector2d(0.3, 0.6));
    const Eigen::VectorXd rows = stress.of_all(0, one.motion, &heat);
    EXPECT_NEAR(rows[membrane_stress_11], -expected, 1e-6 * expected);
    EXPECT_NEAR(rows[membrane_stress_22], -expected, 1e-6 * expected);
    EXPECT_NEAR(rows[membrane_stress_12], 0, 1e-6 * expected);
    // 1/2 sigma : alpha T, over 2 x 1 x 0.02 m^3.
    EXPECT_NEAR(one.strain_energy, expected * hot_coefficient * hot_rise * 0.04,
                1e-6 * one.strain_energy);
    EXPECT_LT(one.estimated_error, 1e-6);
  }
}

// A plate that is held on all sides and hotter on one by T: E alpha T / (2 (1 - nu)) at the
// surfaces, compression on the hot one (Timoshenko and Woinowsky-Krieger 1959, article 14).
TEST(Heat, ADifferenceThroughAHeldPlateBendsIt) {
  const double expected = hot_stress / (2 * (1 - hot_ratio));
  for (const int degree : {1, 2}) {
    SCOPED_TRACE(degree);
    // 50 K over 20 mm, the mean being that without strain.
    const HotCase hot(test::nastran(hot_case_control + distorted_plate() +
                                    "SPC1,1,123456,1,THRU,9\nTEMPD,5,20.\n"
                                    "TEMPP1,5,1,20.,2500.\n,2,THRU,4\n"),
                      degree);
    const DeckCaseSolution& one = hot.first();
    EXPECT_NEAR(one.stress.peak_von_mises.value, expected, 1e-6 * expected);
    const CellHeat heat = hot.heat();
    ShellStress stress(hot.model.space(), Eigen::Vector2d(0.3, 0.6));
    const Eigen::VectorXd rows = stress.of_all(1, one.motion, &heat);
    EXPECT_NEAR(rows[bending_stress_11], -expected, 1e-6 * expected);
    EXPECT_NEAR(rows[bending_stress_22], -expected, 1e-6 * expected);
    EXPECT_NEAR(rows[membrane_stress_11], 0, 1e-6 * expected);
  }
}

/// A plate whose nodes are on its lower side.
const char* const plate_on_its_lower_side = R"(*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
*ELEMENT, TYPE=S4, ELSET=P
1, 1, 2, 3, 4
*MATERIAL, NAME=S
*ELASTIC
2.E11, .3
*EXPANSION
1.2E-5
*DENSITY
7850.
*SHELL SECTION, ELSET=P, MATERIAL=S, OFFSET=SNEG
.02
*BOUNDARY
1, 1, 6
*STEP
*STATIC
*TEMPERATURE
ALL, 25., 2500.
*END STEP
)";

// The same plate held at one grid alone becomes a part of a sphere of curvature alpha T', the hot
// side outside, whether the slope is given by elements or by nodes, with the nodes at one side.
TEST(Heat, ADifferenceThroughAFreePlateCurvesIt) {
  const double curvature = hot_coefficient * 2500;
  const HotCase hot(test::nastran(hot_case_control + distorted_plate() +
                                  "SPC1,1,123456,1\nTEMPP1,5,1,20.,2500.\n,2,THRU,4\n"));
  expect_free(hot);
  for (std::size_t v = 0; v < 9; ++v) {
    const Vector3& x = hot.deck.mesh.vertices[v];
    EXPECT_NEAR(hot.moved(static_cast<int>(v)).z(), -curvature * x.squaredNorm() / 2,
                1e-6 * curvature);
  }
  // 25 K at the nodes, on the lower side: 50 K in the middle.
  const HotCase off(test::abaqus(plate_on_its_lower_side));
  expect_free(off);
  EXPECT_NEAR(off.moved(2).z(), -curvature, 1e-6 * curvature);
  EXPECT_NEAR(off.moved(1).x(), hot_coefficient * 25, 1e-6 * hot_coefficient * 25);
}

/// Points of stress and shear areas of hot_bar's section. Without areas a bar is stiff in shear, with
/// 1e4 times the section's area (beam.h), which rounds what it moves by 1e-8 of it and more.
const char* const hot_bar_gives_way_in_shear =
    "\n,.05,.05,-.05,.05,-.05,-.05,.05,-.05\n,.8333333,.8333333";

/// A bar along x of 0.1 x 0.1 m and 2 m in two pieces.
std::string hot_bar(const std::string& ends, const std::string& section_end = "") {
  return "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\nCBAR,1,1,1,2,0.,1.,0.\n"
         "CBAR,2,1,2,3,0.,1.,0." +
         ends + "\nPBAR,1,1,.01,8.333333-6,8.333333-6,1.4-5" + section_end + "\n" + hot_steel;
}

TEST(Heat, ABarIsHeldByItsEnds) {
  const HotCase held(
      test::nastran(hot_case_control + hot_bar("") + "SPC1,1,123456,1,3\nTEMPD,5,70.\n"));
  EXPECT_NEAR(held.first().stress.peak_von_mises.value, hot_stress, 1e-8 * hot_stress);
  EXPECT_NEAR(held.largest_force(), hot_stress * 0.01, 1e-8 * hot_stress);
  EXPECT_NEAR(held.first().strain_energy, hot_stress * hot_coefficient * hot_rise * 0.01,
              1e-8 * held.first().strain_energy);
  const HotCase loose(
      test::nastran(hot_case_control + hot_bar("") + "SPC1,1,123456,1\nTEMPD,5,70.\n"));
  expect_free(loose);
  EXPECT_NEAR(loose.moved(2).x(), hot_coefficient * hot_rise * 2, 1e-10);
  // One end of it slides in the other's way: nothing holds it either.
  const HotCase sliding(test::nastran(hot_case_control + hot_bar("\n,,1") +
                                      "SPC1,1,123456,1,2,3\nTEMPRB,5,2,70.,70.\nTEMPD,5,20.\n"));
  EXPECT_LT(sliding.first().stress.peak_von_mises.value, 1e-8 * hot_stress);
  EXPECT_LT(sliding.largest_force(), 1e-8 * hot_stress);
  const HotCase rod(test::nastran(
      hot_case_control +
      std::string("GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nCROD,1,1,1,2\nPROD,1,1,.01\n") + hot_steel +
      "SPC1,1,123456,1,2\nTEMP,5,1,45.,2,95.\n"));
  EXPECT_NEAR(rod.largest_force(), hot_stress * 0.01, 1e-8 * hot_stress);
}

// Where a beam's section changes between its grids there is none: it is as warm as between them.
TEST(Heat, ABeamOfSeveralStationsIsWarmAlongItsLine) {
  const HotCase hot(test::nastran(std::string(hot_case_control) +
                                  "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nCBEAM,1,1,1,2,0.,1.,0.\n"
                                  "PBEAM,1,1,.02,4.-6,1.-6,0.,2.-6,0.\n,NO,.5,.01\n,NO,1.,.02\n" +
                                  hot_steel + "SPC1,1,123456,1\nTEMP,5,1,30.,2,70.\n"));
  EXPECT_NEAR(hot.moved(1).x(), hot_coefficient * 30 * 2, 1e-10);
  EXPECT_LT(hot.first().stress.peak_von_mises.value, 1e-7 * hot_stress);
}

// By T' across it a bar curves by alpha T' where it is free; held at both ends it has the moment
// E I alpha T' and the stress E alpha T' h / 2 (Timoshenko 1955, part I, article 50).
TEST(Heat, ADifferenceAcrossABarBendsIt) {
  const double curvature = hot_coefficient * 500;  // 50 K over 0.1 m
  const std::string across = "TEMPRB,5,1,20.,20.,500.,500.\nTEMPRB,5,2,20.,20.,500.,500.\n";
  const HotCase loose(test::nastran(hot_case_control + hot_bar("", hot_bar_gives_way_in_shear) +
                                    "SPC1,1,123456,1\n" + across));
  EXPECT_LT(loose.first().stress.peak_von_mises.value, 1e-7 * hot_stress);
  EXPECT_NEAR(loose.moved(2).y(), -curvature * 2, 1e-8 * curvature);
  EXPECT_NEAR(loose.moved(2).z(), 0, 1e-8 * curvature);
  const HotCase held(
      test::nastran(hot_case_control + hot_bar("") + "SPC1,1,123456,1,3\n" + across));
  EXPECT_NEAR(held.first().stress.peak_von_mises.value, hot_stress / 2, 1e-6 * hot_stress);
  double moment = 0;
  for (const SupportReaction& reaction : held.first().reactions)
    moment = std::max(moment, reaction.moment.norm());
  EXPECT_NEAR(moment, hot_modulus * 8.333333e-6 * curvature, 1e-6 * moment);
}

/// A box of 2 x 1 x 1 m of two solids, its grids counted along x first.
std::string hot_box() {
  std::string text;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i)
        text += fmt::format("GRID,{},,{}.,{}.,{}.\n", 1 + i + 3 * j + 6 * k, i, j, k);
  return text + "CHEXA,1,1,1,2,5,4,7,8\n,11,10\nCHEXA,2,1,2,3,6,5,8,9\n,12,11\nPSOLID,1,1\n" +
         hot_steel;
}

const char* const hot_box_held = "SPC1,1,123,1\nSPC1,1,23,3\nSPC1,1,3,4\n";

TEST(Heat, ASolidExpandsFreelyOrIsPressed) {
  const HotCase loose(test::nastran(hot_case_control + hot_box() + hot_box_held + "TEMPD,5,70.\n"));
  expect_free(loose);
  expect_motion(loose, [](const Vector3& x) -> Vector3 { return hot_coefficient * hot_rise * x; });
  std::string temperatures;
  for (int n = 0; n < 12; ++n)
    temperatures += fmt::format("TEMP,5,{},{}.\n", n + 1, 20 + 50 * (n % 3));
  const HotCase linear(test::nastran(hot_case_control + hot_box() + hot_box_held + temperatures));
  expect_free(linear);
  expect_motion(linear, [](const Vector3& x) -> Vector3 {
    return hot_coefficient * hot_rise *
           Vector3((x.x() * x.x() - x.y() * x.y() - x.z() * x.z()) / 2, x.x() * x.y(),
                   x.x() * x.z());
  });
  const HotCase held(
      test::nastran(hot_case_control + hot_box() + "SPC1,1,123,1,THRU,12\nTEMPD,5,70.\n"));
  const double expected = hot_stress / (1 - 2 * hot_ratio);
  const CellHeat heat = held.heat();
  const Eigen::VectorXd stress =
      solid_corner_stresses(held.model.space(), 1, held.first().motion, &heat);
  for (Eigen::Index corner = 0; corner < 8; ++corner)
    for (Eigen::Index c = 0; c < 6; ++c)
      EXPECT_NEAR(stress[6 * corner + c], c < 3 ? -expected : 0, 1e-8 * expected);
  EXPECT_LT(held.first().estimated_error, 1e-6);
}

// Two layers of one Poisson's ratio that are warmed curve as Timoshenko's strip does, in both
// directions: k = 6 (a_2 - a_1) T (1 + m)^2 / (h (3 (1 + m)^2 + (1 + m n)(m^2 + 1 / (m n)))), with
// m and n the ratios of their thickness and modulus. Source: Timoshenko (1925), J. Opt. Soc. Am.
// 11, 233-255, equation 4.
TEST(Heat, TwoMetalsCurve) {
  const double m = 0.008 / 0.004, n = 2e11 / 1e11, h = 0.012, differ = 1.1e-5, rise = 100;
  const double curvature = 6 * differ * rise * std::pow(1 + m, 2) /
                           (h * (3 * std::pow(1 + m, 2) + (1 + m * n) * (m * m + 1 / (m * n))));
  const HotCase hot(test::abaqus(R"(*NODE, NSET=ALL
1, 0., 0., 0.
2, .5, 0., 0.
3, 1., 0., 0.
4, 0., .2, 0.
5, .5, .2, 0.
6, 1., .2, 0.
*ELEMENT, TYPE=S4, ELSET=P
1, 1, 2, 5, 4
2, 2, 3, 6, 5
*MATERIAL, NAME=STEEL
*ELASTIC
2.E11, .3
*EXPANSION
1.2E-5
*DENSITY
7850.
*MATERIAL, NAME=BRASS
*ELASTIC
1.E11, .3
*EXPANSION
2.3E-5
*DENSITY
7850.
*SHELL SECTION, ELSET=P, COMPOSITE
.008, 3, STEEL, 0.
.004, 3, BRASS, 0.
*BOUNDARY
1, 1, 6
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 20.
*STEP
*STATIC
*TEMPERATURE
ALL, 120.
*END STEP
)"));
  for (int v = 0; v < 6; ++v) {
    const Vector3& x = hot.deck.mesh.vertices[static_cast<std::size_t>(v)];
    EXPECT_NEAR(hot.moved(v).z(), -curvature * x.squaredNorm() / 2, 1e-6 * curvature);
  }
  // The layers hold one another and the whole has neither force nor moment.
  EXPECT_LT(hot.first().stress.peak_von_mises.value, 1e-6 * 2e11 * differ * rise);
  EXPECT_GT(hot.first().strain_energy, 0);
}

// Layers of one elasticity and different expansion are no plate of one material.
TEST(Heat, LayersThatDifferInExpansionAloneAreKept) {
  const std::string layers = distorted_plate();
  const std::string text =
      hot_case_control + layers.substr(0, layers.find("PSHELL")) +
      "PCOMP,1,,,,,20.\n,1,.01,0.,,2,.01,0.\nMAT1,1,2.+11,,0.3,7850.,1.2-5,20.\n"
      "MAT1,2,2.+11,,0.3,7850.,2.4-5\nSPC1,1,123456,1\nTEMPD,5,70.\n";
  const HotCase hot(test::nastran(text));
  // Timoshenko's formula for m = n = 1: 3/2 (a_2 - a_1) T / h.
  const double curvature = 1.5 * hot_coefficient * hot_rise / 0.02;
  EXPECT_NEAR(hot.moved(8).z(), -curvature * 5 / 2, 1e-6 * curvature);
}

// Aluminium between sheets of steel: alpha = sum(E t alpha) / sum(E t), the ratios nu being one.
// The layers store energy and the plate has no stress, so that no error of it can be told.
TEST(Heat, LayersThatHoldOneAnotherLeaveTheirPlateWithoutError) {
  const std::string layers = distorted_plate();
  const HotCase hot(test::nastran(
      hot_case_control + layers.substr(0, layers.find("PSHELL")) +
      "PCOMP,1,,,,,20.\n,1,.005,0.,,2,.01,0.\n,1,.005,0.\nMAT1,1,2.+11,,0.3,7850.,1.2-5,20.\n"
      "MAT1,2,.7+11,,0.3,2700.,2.4-5\nTEMPD,5,70.\n" +
      hot_plate_held));
  const double coefficient = (2e11 * 1.2e-5 + 0.7e11 * 2.4e-5) / (2e11 + 0.7e11);
  expect_motion(hot, [&](const Vector3& x) -> Vector3 { return coefficient * hot_rise * x; });
  EXPECT_GT(hot.first().strain_energy, 1e-3 * hot.heat().held_energy()[0]);
  EXPECT_EQ(hot.first().estimated_error, 0);
}

// Steel on aluminium, pulled up at a corner: the estimate of its error is the same beside a case
// that is hot, to the rounding of two solutions.
TEST(Heat, AHotCaseChangesNoOtherOnesError) {
  const std::string layers = distorted_plate();
  const auto deck = [&](const std::string& other_case) {
    return test::nastran(
        "SOL 101\nCEND\nSPC = 1\nSUBCASE 1\nLOAD = 2\n" + other_case + "BEGIN BULK\n" +
        layers.substr(0, layers.find("PSHELL")) +
        "PCOMP,1,,,,,20.\n,1,.01,0.,,2,.01,0.\nMAT1,1,2.+11,,0.3,7850.,1.2-5,20.\n"
        "MAT1,2,.7+11,,0.33,2700.,2.4-5\nSPC1,1,123456,1,4,7\nFORCE,2,9,0,100.,0.,0.,1.\n"
        "TEMPD,5,70.\n");
  };
  const HotCase alone(deck("")), beside(deck("SUBCASE 2\nTEMPERATURE(LOAD) = 5\n"));
  ASSERT_EQ(alone.solution.cases.size(), 1U);
  ASSERT_EQ(beside.solution.cases.size(), 2U);
  EXPECT_GT(alone.first().estimated_error, 1e-3);
  EXPECT_NEAR(beside.first().estimated_error, alone.first().estimated_error, 1e-9);
}

// Strains count from TREF, or from the initial temperatures where there are some.
TEST(Heat, StrainsCountFromAReference) {
  const std::string bar = hot_bar("") + "SPC1,1,123456,1\nTEMPD,5,70.,6,30.\n";
  const auto end_with = [&](const std::string& control) {
    return HotCase(test::nastran("SOL 101\nCEND\nSPC = 1\nSUBCASE 1\n" + control + "BEGIN BULK\n" +
                                 bar))
        .moved(2)
        .x();
  };
  EXPECT_NEAR(end_with("TEMP(LOAD) = 5\n"), hot_coefficient * 50 * 2, 1e-10);
  EXPECT_NEAR(end_with("TEMPERATURE = 5\n"), hot_coefficient * 50 * 2, 1e-10);
  EXPECT_NEAR(end_with("TEMP(LOAD) = 5\nTEMP(INIT) = 6\n"), hot_coefficient * 40 * 2, 1e-10);
}

// Temperatures of Abaqus' steps go on until others take their place, and OP = NEW takes them back.
TEST(Heat, StepsGoOn) {
  const Deck deck = test::abaqus(R"(*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
*ELEMENT, TYPE=T3D2, ELSET=P
1, 1, 2
*MATERIAL, NAME=S
*ELASTIC
2.E11, .3
*EXPANSION, ZERO=300.
1.2E-5
*DENSITY
7850.
*SOLID SECTION, ELSET=P, MATERIAL=S
.01
*BOUNDARY
1, 1, 6
2, 2, 6
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 20.
*STEP
*STATIC
*TEMPERATURE
ALL, 70.
*END STEP
*STEP
*STATIC
*CLOAD
2, 1, 1.
*END STEP
*STEP
*STATIC
*TEMPERATURE, OP=NEW
2, 40.
*END STEP
)");
  const ElasticModel model = hot_model(deck, 2);
  const DeckSolution solution = solve_deck(model, deck, 1);
  ASSERT_EQ(solution.cases.size(), 3U);
  const std::array<double, 3> rises{50, 50, 10};
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(solution.cases[c].motion[6L * model.space().node_of_vertex(1)],
                hot_coefficient * rises[c], 1e-9)
        << c;
}

/// Compares a deck's first case with that of the deck as Abaqus' input file has it.
void expect_same_in_abaqus(const Deck& deck) {
  const HotCase own{deck}, again(test::abaqus(to_abaqus(deck)));
  EXPECT_NEAR(again.first().strain_energy, own.first().strain_energy,
              1e-6 * own.heat().held_energy()[0]);
  for (int v = 0; v < static_cast<int>(deck.mesh.vertices.size()); ++v)
    EXPECT_LT((own.moved(v) - again.moved(v)).norm(), 1e-6 * hot_coefficient * hot_rise)
        << "vertex " << v;
}

// Each step says the temperatures of all nodes: initial ones of those that the case has none for.
TEST(Heat, NodesWithoutATemperatureAreWrittenForAbaqus) {
  const std::string text =
      to_abaqus(test::nastran(hot_case_control + hot_bar("") +
                              "GRID,9,,5.,0.,0.\nSPC1,1,123456,1\nTEMP,5,1,30.,2,50.,3,70.\n"));
  EXPECT_THAT(text, HasSubstr("\n3, 5.000000000000e+01\n"));
  EXPECT_THAT(text, HasSubstr("\n9, 0.000000000000e+00\n"));
}

TEST(Heat, IsWrittenForAbaqus) {
  std::string temperatures;
  for (int n = 0; n < 12; ++n)
    temperatures += fmt::format("TEMP,5,{},{}.\n", n + 1, 20 + 7 * n + n * n);
  expect_same_in_abaqus(test::nastran(hot_case_control + hot_box() + hot_box_held + temperatures));
  expect_same_in_abaqus(test::nastran(hot_case_control + distorted_plate() +
                                      "SPC1,1,123456,1,THRU,3\nTEMPD,5,70.\nTEMP,5,5,90.\n"));
  expect_same_in_abaqus(test::abaqus(plate_on_its_lower_side));
  expect_same_in_abaqus(test::nastran(hot_case_control + hot_bar("") +
                                      "SPC1,1,123456,1\nTEMP,5,1,30.,2,50.,3,70.\n"));
  const Deck of_elements = test::nastran(hot_case_control + distorted_plate() + hot_plate_held +
                                         "TEMPD,5,20.\nTEMPP1,5,1,70.\n");
  EXPECT_THROW(to_abaqus(of_elements), ModelError);
  EXPECT_THROW(to_nastran(of_elements), ModelError);
}

/// What is said of a deck whose temperatures cannot be computed with.
std::string refusal(const std::string& text) {
  const Deck deck = test::nastran(text);
  try {
    solve_deck(hot_model(deck, 2), deck, 1);
  } catch (const ModelError& error) {
    return error.what();
  }
  return {};
}

TEST(Heat, WhatCannotBeComputedIsRefused) {
  const std::string held = "SPC1,1,123456,1\n";
  EXPECT_THAT(
      refusal(hot_case_control + hot_bar("") + held + "TEMP,5,1,70.\n"),
      HasSubstr("case 1: temperature set 5 cannot be computed with: node 2 of beam 1 has no "
                "temperature"));
  EXPECT_THAT(refusal(hot_case_control + hot_bar("") + held +
                      "TEMPD,5,70.\nMATT1,1,,,,,7\nTABLEM1,7\n,0.,1.-5,100.,2.-5,ENDT\n"),
              HasSubstr("MAT1 1 expands by the temperature (MATT1 at "));
  EXPECT_THAT(refusal(hot_case_control + distorted_plate() + held +
                      "TEMPD,5,70.\nTEMPP3,5,1,0.,20.,.01,30.\n"),
              HasSubstr("TEMPP3 at "));
  EXPECT_THAT(test::complaints_of_nastran(hot_case_control + hot_bar("") + held),
              HasSubstr("subcase 1: temperature set 5 does not exist"));
}

}  // namespace
}  // namespace blocklift::structure
