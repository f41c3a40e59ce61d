// Shear panels, splines and springs along a line.
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/files/deck/shear_panel.h"
#include "structure/mesh/files/nastran/reader.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/mesh/mass_properties.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string aluminium_card = "MAT1,7,70.+9,,.3,2700.\n";
constexpr double young_of_aluminium = 70e9, poisson_of_aluminium = 0.3,
                 shear_of_aluminium = young_of_aluminium / (2 * (1 + poisson_of_aluminium));

/// The first turn that the equations give a vertex of theirs for a displacement of the others.
double turn_of(const Mesh& mesh, int vertex, const Vector3& axis,
               const std::vector<Vector3>& displacements) {
  for (const MotionEquation& equation : mesh.equations) {
    const MotionEquation::Term& first = equation.terms.front();
    if (first.vertex != vertex || (first.of_rotation.normalized() - axis).norm() > 1e-6) continue;
    double sum = 0;
    for (std::size_t t = 1; t < equation.terms.size(); ++t)
      sum -= equation.terms[t].of_displacement.dot(displacements[equation.terms[t].vertex]);
    return sum / first.of_rotation.norm();
  }
  return std::nan("");
}

/// Strain energy of a deck's one spring between turns about an axis.
template <typename Field>
double energy_of(const Deck& deck, const Field& displacement) {
  const Mesh& mesh = deck.mesh;
  std::vector<Vector3> displacements;
  for (const Vector3& place : mesh.vertices) displacements.push_back(displacement(place));
  const Spring& spring = mesh.springs.at(0);
  const Vector3 axis = spring.axes[0].col(2);
  const double stretch = turn_of(mesh, spring.vertices[0], axis, displacements) -
                         turn_of(mesh, spring.vertices[1], axis, displacements);
  return spring.stiffness * stretch * stretch / 2;
}

const std::string panel_of_two_metres =
    "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\nGRID,4,,0.,1.,0.\n"
    "CSHEAR,9,5,1,2,3,4\n";

TEST(NastranShearPanels, RectanglesBearShearAlone) {
  const Deck deck = nastran(panel_of_two_metres + "PSHEAR,5,7,.003,1.5\n" + aluminium_card);
  // G t a b gamma^2 / 2, however the shear comes about.
  const double energy = shear_of_aluminium * 0.003 * 2 * 1e-6 / 2;
  EXPECT_NEAR(energy_of(deck, [](const Vector3& x) { return Vector3(1e-3 * x.y(), 0, 0); }), energy,
              1e-9 * energy);
  EXPECT_NEAR(energy_of(deck, [](const Vector3& x) { return Vector3(0, 1e-3 * x.x(), 0); }), energy,
              1e-9 * energy);
  // Stretched both ways, bent in its plane, out of it, and turned it takes nothing.
  for (const auto& field : {+[](const Vector3& x) { return Vector3(x.x(), 2 * x.y(), 0); },
                            +[](const Vector3& x) { return Vector3((x.x() - 1) * x.y(), 0, 0); },
                            +[](const Vector3& x) { return Vector3(0, 0, x.x() * x.y()); },
                            +[](const Vector3& x) { return Vector3(-x.y(), x.x(), 0); }})
    EXPECT_NEAR(energy_of(deck, field), 0, 1e-9 * energy);
  const MeshMass mass = mass_properties(deck.mesh);
  EXPECT_NEAR(mass.mass, 2 * (0.003 * 2700 + 1.5), 1e-12);
  expect_near(mass.centre, Vector3(1, 0.5, 0), 1e-12);
  EXPECT_EQ(entry(deck, "CSHEAR").used, 1);
  EXPECT_EQ(entry(deck, "PSHEAR").used, 1);
}

// MSC Nastran's formula, which follows from the stress that leaves oblique edges free of tension:
// flexibility A (1 + 2 cot^2 phi / (1 + nu)) / (G t). The flow does work on what the sides' shear
// gives, here A gamma with the lower edge held and the upper one shifted along itself.
TEST(NastranShearPanels, ParallelogramsAreStiffer) {
  const double t = 0.003, height = 1, lean = 0.5;
  const Deck deck = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.5,1.,0.\nGRID,4,,.5,1.,0.\n"
      "CSHEAR,9,5,1,2,3,4\nPSHEAR,5,7,.003\n" +
      aluminium_card);
  const double area = 2, gamma = 1e-3, cotangent = lean / height;
  const double flexibility = area / (shear_of_aluminium * t) *
                             (1 + 2 * cotangent * cotangent / (1 + poisson_of_aluminium));
  const double energy = area * gamma * area * gamma / (2 * flexibility);
  EXPECT_NEAR(energy_of(deck, [&](const Vector3& x) { return Vector3(gamma * x.y(), 0, 0); }),
              energy, 1e-9 * energy);
}

// A trapezoid's stress falls off with the square of the distance from where its sides meet: cut
// along a parallel to its ends, the two parts take the whole's energy, but for what Gauss' rule of
// four points leaves of 1 / r^3 between widths of 1 to 0.4 (0.04 %).
TEST(NastranShearPanels, TrapezoidsMayBeDivided) {
  const Material aluminium{.name = "aluminium",
                           .youngs_modulus = young_of_aluminium,
                           .poisson_ratio = poisson_of_aluminium,
                           .density = 2700};
  const auto half_width = [](double x) { return 1 - 0.2 * x; };
  const auto panel = [&](double from, double to) {
    return make_shear_panel({Vector3(from, -half_width(from), 0), Vector3(to, -half_width(to), 0),
                             Vector3(to, half_width(to), 0), Vector3(from, half_width(from), 0)},
                            aluminium, 0.002);
  };
  const ShearPanel whole = panel(0, 3), first = panel(0, 1.2), second = panel(1.2, 3);
  // The flow at an end over the mean of all edges': it goes with one over the square of the width,
  // along the sides with one over the product of both.
  const auto flow_at = [&](double end, double other) {
    const double ratio = half_width(end) / half_width(other);
    return 4 / ((1 + ratio) * (1 + ratio));
  };
  const double scale_1 = flow_at(0, 3) / flow_at(0, 1.2), scale_2 = flow_at(3, 0) / flow_at(3, 1.2);
  EXPECT_NEAR(scale_1 * scale_1 / first.stiffness + scale_2 * scale_2 / second.stiffness,
              1 / whole.stiffness, 1e-3 / whole.stiffness);
  EXPECT_NEAR(whole.area, first.area + second.area, 1e-12);
  Vector3 sum = Vector3::Zero();
  for (const Vector3& force : whole.corner_forces) sum += force;
  EXPECT_LT(sum.norm(), 1e-12);
}

TEST(NastranShearPanels, EdgesThatWorkAsBars) {
  const Deck deck = nastran(panel_of_two_metres + "PSHEAR,5,7,.003,,1.,1.5\n" + aluminium_card);
  ASSERT_EQ(deck.mesh.beams.size(), 4U);
  // F1 T A / (L12 + L34) = 0.003 * 2 / 4 on the long edges; F2 T^2 / 2 on the short ones.
  EXPECT_DOUBLE_EQ(deck.mesh.section_of(deck.mesh.beams[0]).area, 0.0015);
  EXPECT_DOUBLE_EQ(deck.mesh.section_of(deck.mesh.beams[2]).area, 0.75 * 9e-6);
  EXPECT_THAT(deck.mesh.beams[0].vertices, ElementsAre(0, 1));
  EXPECT_THAT(deck.mesh.beams[3].vertices, ElementsAre(3, 0));
  EXPECT_NEAR(mass_properties(deck.mesh).mass, 2 * 0.003 * 2700, 1e-12);
}

// What is written of it, links and a spring, is the same model.
TEST(NastranShearPanels, RoundTrip) {
  const Deck deck = nastran(panel_of_two_metres + "PSHEAR,5,7,.003,,.5,.5\n" + aluminium_card);
  const DeckFolder folder;
  const auto path = folder.path() / "back.bdf";
  write_nastran(deck, path);
  const Deck back = read_nastran(path, UnitSystem());
  const auto shear = [](const Vector3& x) { return Vector3(1e-3 * x.y(), 0, 0); };
  EXPECT_NEAR(energy_of(back, shear), energy_of(deck, shear), 1e-6 * energy_of(deck, shear));
  EXPECT_NEAR(mass_properties(back.mesh).mass, mass_properties(deck.mesh).mass, 1e-9);
}

TEST(NastranShearPanels, WhatCannotBeOneIsRefused) {
  EXPECT_THAT(complaints_of_nastran(panel_of_two_metres + aluminium_card),
              HasSubstr("deck.bdf:5: error: CSHEAR: property 5 does not exist, or is no PSHEAR"));
  EXPECT_THAT(complaints_of_nastran(panel_of_two_metres + "PSHEAR,5,7,0.\n" + aluminium_card),
              HasSubstr("PSHEAR 5: T must be positive"));
  const std::string property = "PSHEAR,5,7,.003\n" + aluminium_card;
  EXPECT_THAT(complaints_of_nastran("GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,.4\n"
                                    "GRID,4,,0.,1.,0.\nCSHEAR,9,5,1,2,3,4\n" +
                                    property),
              HasSubstr("CSHEAR 9: its corners are off their plane by more than 5 %"));
  EXPECT_THAT(complaints_of_nastran("GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,.5,.4,0.\n"
                                    "GRID,4,,0.,1.,0.\nCSHEAR,9,5,1,2,3,4\n" +
                                    property),
              HasSubstr("CSHEAR 9: its corners are those of no convex quadrilateral"));
}

// Between its ends a spline is the cubic line of a slender beam.
TEST(NastranSplines, FollowACubicLine) {
  const Deck deck = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.5,0.,0.\nGRID,4,,4.,0.,0.\nGRID,5,,6.,0.,0.\n"
      "RSPLINE,9,.1,1,2,123456,3,123456,4,\n,,5\n");
  // Grid 4 has no components: nothing lies between it and grid 5.
  ASSERT_EQ(deck.mesh.equations.size(), 12U);
  const auto displacement = [](double x) -> Vector3 {
    return {0.3 + 0.2 * x, 0.1 - x + 0.5 * x * x - 0.07 * x * x * x,
            2 * x - 0.4 * x * x + 0.03 * x * x * x};
  };
  // theta_y = -dw/dx, theta_z = dv/dx.
  const auto rotation = [](double x) -> Vector3 {
    return {0.6 - 0.1 * x, -(2 - 0.8 * x + 0.09 * x * x), -1 + x - 0.21 * x * x};
  };
  for (const MotionEquation& equation : deck.mesh.equations) {
    double sum = 0;
    for (const MotionEquation::Term& term : equation.terms) {
      const double x = deck.mesh.vertices[term.vertex].x();
      sum += term.of_displacement.dot(displacement(x)) + term.of_rotation.dot(rotation(x));
    }
    EXPECT_NEAR(sum, 0, 1e-12);
    MotionEquation balanced = equation;
    EXPECT_LT(balance(deck.mesh, balanced), 1e-12);
  }
  const std::string grids =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.5,0.,0.\nGRID,4,,1.,1.,0.\n";
  EXPECT_THAT(complaints_of_nastran(grids + "RSPLINE,9,.1,1,2,123,3\n"),
              HasSubstr("RSPLINE 9: grid 2 follows in some components alone"));
  EXPECT_THAT(complaints_of_nastran(grids + "RSPLINE,9,.1,1,4,123456,3\n"),
              HasSubstr("RSPLINE 9: grid 4 lies not between grids 1 and 3"));
  EXPECT_THAT(complaints_of_nastran(grids + "RSPLINE,9,.1,1,2,123456\n"),
              HasSubstr("RSPLINE 9: the last grid must not follow"));
}

TEST(NastranSprings, AlongALine) {
  const Deck deck = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,3000.,4000.,0.\nCORD2R,3,,0.,0.,0.,1.,0.,0.\n,0.,0.,1.\n"
      "CBUSH1D,8,5,1,2\nCBUSH1D,9,5,2,,3\nPBUSH1D,5,2000.,10.,.4\n",
      "mm-t-N");
  const Mesh& mesh = deck.mesh;
  ASSERT_EQ(mesh.springs.size(), 2U);
  EXPECT_DOUBLE_EQ(mesh.springs[0].stiffness, 2e6);
  EXPECT_THAT(mesh.springs[0].components, ElementsAre(0, 0));
  expect_near(mesh.springs[0].axes[0].col(0), Vector3(0.6, 0.8, 0), 1e-12);
  EXPECT_THAT(mesh.springs[1].vertices, ElementsAre(1, -1));
  expect_near(mesh.springs[1].axes[0].col(0), Vector3(0, 0, 1), 1e-12);
  // Half of 400 kg at either end; at the ground it is no block's.
  EXPECT_NEAR(mass_properties(mesh).mass, 600, 1e-9);
  EXPECT_THAT(entry(deck, "PBUSH1D").left_out, HasSubstr("damping"));
  EXPECT_THAT(complaints_of_nastran("GRID,1,,0.,0.,0.\nCBUSH1D,8,6,1\nPBUSH1D,5,2000.\n"),
              HasSubstr("CBUSH1D: property 6 does not exist, or is no PBUSH1D"));
  EXPECT_THAT(complaints_of_nastran("GRID,1,,0.,0.,0.\nCBUSH,8,5,1,,,,,0\nPBUSH1D,5,2000.\n"),
              HasSubstr("CBUSH: property 5 does not exist, or is no PBUSH"));
  EXPECT_THAT(complaints_of_nastran("GRID,1,,0.,0.,0.\nCBUSH1D,8,5,1\nPBUSH1D,5,2000.\n"),
              HasSubstr("CBUSH1D 8 has no length and no coordinate system (CID)"));
}

}  // namespace
}  // namespace blocklift::structure::test
