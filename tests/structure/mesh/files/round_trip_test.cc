// A deck written and read again is the same model.

#include <cmath>
#include <numbers>

#include "models/blocks/double-bottom-300t/generator.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/diagnosis/diagnosis.h"
#include "structure/mesh/files/abaqus/reader.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/card_writer.h"
#include "structure/mesh/files/nastran/reader.h"
#include "structure/mesh/files/nastran/writer.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::HasSubstr;

// Eleven digits of a field of sixteen columns.
constexpr double tolerance = 1e-10;

/// Everything that both decks say.
const std::string common = R"(CEND
TITLE = everything
SUBCASE 7
 SUBTITLE = lifted
 SPC = 5
 LOAD = 20
BEGIN BULK
CORD2R,3,,0.,0.,0.,0.,0.,1.
,1.,1.,0.
GRID,11,,0.,0.,.123456789,3
GRID,12,,2.,0.,0.
GRID,13,,2.,2.,.1
GRID,14,,0.,2.,0.
GRID,15,,1.,0.,.2
GRID,16,,2.,1.,0.
GRID,17,,1.,2.,.2
GRID,18,,0.,1.,0.,3
GRID,19,,5.,5.,3.
CQUAD4,101,5,11,12,13,14,,.02
CTRIA3,102,5,11,12,13
CQUAD8,103,6,11,12,13,14,15,16
,17,18
CTRIA6,104,6,11,12,14,15,19,18
CBAR,201,8,12,19,0.,0.,1.
CBAR,202,8,13,19,1.,0.,0.
,46,5,,,,,,
CROD,203,9,14,19
CONM2,301,19,,500.
,10.,1.,20.,2.,3.,30.
CELAS2,401,1000.,11,1,12,2
CELAS2,402,2000.,13,3
RBE2,501,19,123456,16,17
RBE2,502,19,12,18
RBE3,503,,15,123456,1.,123,11,12
,2.,123,13
PSHELL,5,7,.012,7,,7,,5.
PSHELL,6,7,.01,7,,7
PBAR,8,7,.01,4.-6,1.-6,2.-6,1.5
,.1,.05,-.1,.05
,.5,.25,1.-7
PROD,9,7,.001
MAT1,7,206.+9,,.3,7850.
,355.+6
SPC1,1,13,11
SPC,2,12,2,.01
SPCADD,5,1,2
LOAD,20,1.,2.,21,1.,22
FORCE,21,12,,10.,1.,2.,3.
MOMENT,21,13,,5.,0.,1.,1.
FORCE,22,11,,7.,0.,0.,1.
PLOAD2,22,1000.,101
GRAV,22,,9.81,0.,0.,-1.
PLOAD1,21,201,FZ,FR,0.,100.,1.,100.
)";

Deck common_deck() { return nastran(common); }

TEST(RoundTrip, Nastran) {
  const Deck deck = common_deck();
  expect_same(deck, nastran(to_nastran(deck)), tolerance);
}

TEST(RoundTrip, NastranInMillimetres) {
  Deck deck = common_deck();
  deck.units = unit_system("mm-t-N");
  const Deck again = nastran(to_nastran(deck), "mm-t-N");
  expect_same(deck, again, tolerance);
  EXPECT_DOUBLE_EQ(again.mesh.materials.at(0).yield_stress, 355e6);
}

TEST(RoundTrip, LaminatesBeamsAboutShearCentresAndBushings) {
  const Deck deck = nastran(R"(GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,2.,2.,0.
GRID,4,,0.,2.,0.
CQUAD4,10,5,1,2,3,4,30.
PCOMP,5,-.01,,,,,,
,7,.002,0.,,8,.025,10.
MAT1,7,206.+9,,.3,7850.
MAT8,8,1.+10,5.+9,.3,2.+9,1.+9,1.5+9,600.
CBEAM,1,9,1,2,0.,0.,1.
,4,,0.,0.,.5,0.,0.,.5
PBEAML,9,7,,L
,.2,.4,.02,.01,,YES,1.,.2
,.4,.02,.01
CBUSH,12,6,1,3,0.,0.,1.
,0.25
PBUSH,6,K,1000.,,,50.
)");
  ASSERT_EQ(deck.mesh.laminates.size(), 1U);
  const Deck again = nastran(to_nastran(deck));
  expect_same(deck, again, 1e-9);
  const auto across = [](const Deck& one) -> Vector3 {
    const Vector3& axis = one.mesh.shells[0].laminate_axis;
    return Vector3(axis.x(), axis.y(), 0).normalized();
  };
  EXPECT_LT((across(deck) - across(again)).norm(), 1e-9);
}

TEST(RoundTrip, TaperedBeams) {
  const Deck deck = nastran(R"(GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,2.,2.,0.
CBEAM,1,9,1,2,0.,0.,1.
CBEAM,2,8,2,3,0.,0.,1.
PBEAML,9,7,,L
,.2,.4,.02,.01,,YES,1.,.1
,.3,.02,.01
PBEAM,8,7,.02,4.-6,1.-6,0.,2.-6,3.
,.1,.05,-.1,.05
,YES,1.,.01,2.-6,1.-6,0.,1.-6,1.
,.05,.05,-.05,.05
,1.,1.
MAT1,7,206.+9,,.3,7850.
)");
  const Deck again = nastran(to_nastran(deck));
  expect_same(deck, again, 1e-9);
  ASSERT_EQ(again.mesh.beams.size(), 2U);
  for (std::size_t b = 0; b < 2; ++b) {
    const BeamSection was = section_at(deck.mesh, deck.mesh.beams[b], 1),
                      is = section_at(again.mesh, again.mesh.beams[b], 1);
    EXPECT_NEAR(is.area, was.area, 1e-9 * was.area);
    EXPECT_NEAR(is.second_moment_3, was.second_moment_3, 1e-9 * was.second_moment_3);
    EXPECT_NEAR(is.mass_per_length, was.mass_per_length, 1e-9);
    EXPECT_LT((is.shear_centre - was.shear_centre).norm(), 1e-9);
    EXPECT_LT((again.mesh.beams[b].offset[1] - deck.mesh.beams[b].offset[1]).norm(), 1e-9);
  }
  EXPECT_THROW(to_abaqus(deck), ModelError);
}

TEST(RoundTrip, Abaqus) {
  Deck deck = common_deck();
  // Not among Abaqus' words: a part of the displacements along axes of a node's own.
  deck.mesh.rigid_links.erase(deck.mesh.rigid_links.begin() + 1);
  const Deck again = abaqus(to_abaqus(deck));
  // Cells come by their sections; masses and inertias apart.
  EXPECT_EQ(again.mesh.vertex_labels, deck.mesh.vertex_labels);
  EXPECT_EQ(again.mesh.shells.size(), deck.mesh.shells.size());
  EXPECT_EQ(again.mesh.beams.size(), deck.mesh.beams.size());
  const MeshMass a = mass_properties(deck.mesh), b = mass_properties(again.mesh);
  EXPECT_NEAR(a.mass, b.mass, tolerance * a.mass);
  EXPECT_LT((a.centre - b.centre).norm(), tolerance);
  EXPECT_LT((a.inertia - b.inertia).norm(), tolerance * a.inertia.norm());
  // What was read from Abaqus' words goes back whole.
  expect_same(again, abaqus(to_abaqus(again)), 1e-14);
  // And by the other's words, too.
  const Deck across = nastran(to_nastran(again));
  expect_same(again, across, tolerance);
}

TEST(RoundTrip, WhatNoCardSaysIsRefused) {
  Deck deck = common_deck();
  EXPECT_THROW(to_abaqus(deck), ModelError);  // a link along axes of its own
  deck.mesh.shells[0].section = -1;
  EXPECT_THROW(to_nastran(deck), ModelError);
  Deck turned = common_deck();
  turned.support_sets[0].supports.push_back(turned.support_sets[0].supports[0]);
  turned.support_sets[0].supports.back().axes = Eigen::Matrix3d::Identity();
  EXPECT_THROW(to_nastran(turned), ModelError);
}

TEST(RoundTrip, RealsOfSixteenColumns) {
  EXPECT_EQ(CardField(0.0).text(), "0.");
  EXPECT_EQ(CardField(2.0).text(), "2.");
  EXPECT_EQ(CardField(-0.5).text(), "-0.5");
  EXPECT_EQ(CardField(206000.0).text(), "206000.");
  for (const double value : {-1.0 / 3e7, 1e300 / 7, 123456.789012345678, -9.87654321098e-101}) {
    const std::string text = CardField(value).text();
    EXPECT_LE(text.size(), 16U) << text;
    EXPECT_NE(text.find('.'), std::string::npos);
  }
}

std::string group_of(const Mesh& mesh, const Shell& shell) {
  return mesh.groups[mesh.regions[shell.region].group].name;
}

// The generated block: all of it comes back, and the doctor has nothing against it.
TEST(RoundTrip, DoubleBottom) {
  const Deck deck = models::make_double_bottom({.cells_per_spacing = 2, .bays = 8});
  const Deck again = nastran(to_nastran(deck), "mm-t-N");
  expect_same(deck, again, tolerance);
  for (std::size_t s = 0; s < deck.mesh.shells.size(); s += 100)
    EXPECT_EQ(group_of(again.mesh, again.mesh.shells[s]), group_of(deck.mesh, deck.mesh.shells[s]));
  const Diagnosis diagnosis = diagnose(again.mesh);
  EXPECT_EQ(diagnosis.parts, 1);
  for (const Finding& finding : diagnosis.findings)
    EXPECT_EQ(finding.severity, Severity::note) << finding.kind << ": " << finding.text;
  const Deck other = abaqus(to_abaqus(deck), "mm-t-N");
  EXPECT_NEAR(mass_properties(other.mesh).mass, diagnosis.mass.mass, 1e-9 * diagnosis.mass.mass);
}

// Plates by hand: their areas times thickness; manholes take their circles away.
TEST(RoundTrip, MassOfTheDoubleBottomByHand) {
  const models::DoubleBottomMeasures measures{.cells_per_spacing = 4, .bays = 8};
  const Deck deck = models::make_double_bottom(measures);
  const std::vector<MeshMass> groups = mass_by_group(deck.mesh);
  const auto mass = [&](const std::string& name) {
    for (std::size_t g = 0; g < deck.mesh.groups.size(); ++g)
      if (deck.mesh.groups[g].name == name) return groups[g].mass;
    return 0.0;
  };
  const double length = 6.4, steel = 7850;
  EXPECT_NEAR(mass("bottom"), 14.4 * length * 0.016 * steel, 1e-6);
  EXPECT_NEAR(mass("inner bottom"), 16 * length * 0.015 * steel, 1e-6);
  EXPECT_NEAR(mass("side"), 9.6 * length * 0.014 * steel, 1e-6);
  // Thirteen chords for a quarter of a circle of 1.6 m: short by (pi / 52)^2 / 6.
  const double arc = std::numbers::pi / 2 * 1.6;
  EXPECT_NEAR(mass("bilge"), arc * length * 0.016 * steel, 7e-4 * arc * length * 0.016 * steel);
  // Manholes are polygons of eight sides of 0.3 m radius: 2 sqrt(2) r^2 each.
  const double hole = 2 * std::sqrt(2.0) * 0.09;
  EXPECT_NEAR(mass("girders"), (4 * length * 1.6 - 4 * 2 * hole) * 0.014 * steel, 1e-6);
  EXPECT_NEAR(mass("brackets"), 3 * 0.32 * 0.014 * steel, 1e-6);
  const double bulb = deck.mesh.beam_sections.at(0).area;
  EXPECT_NEAR(mass("bottom longitudinals"), 15 * length * bulb * steel, 1e-6);
  EXPECT_NEAR(mass("floor stiffeners"), 3 * 15 * 1.6 * 0.15 * 0.012 * steel, 1e-6);
  EXPECT_NEAR(mass("girder stiffeners"), 4 * 6 * 1.6 * 0.15 * 0.012 * steel, 1e-6);
}

}  // namespace
}  // namespace blocklift::structure::test
