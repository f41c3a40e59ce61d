// Elements of Nastran decks and their properties, each by a small deck of its own.

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/beams/sections.h"
#include "structure/mesh/laminate.h"
#include "structure/mesh/mass_properties.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A quarter of a cylinder by one CQUAD8: its middles lie on the arc.
TEST(NastranReader, QuadraticShellsAreCurved) {
  const double s = std::sqrt(0.5);
  const Deck deck = nastran(
      "GRID,1,,1.,0.,0.\nGRID,2,,0.,1.,0.\nGRID,3,,0.,1.,2.\nGRID,4,,1.,0.,2.\n"
      "GRID,5,," +
      std::to_string(s) + "," + std::to_string(s) +
      ",0.\n"
      "GRID,6,,0.,1.,1.\nGRID,7,," +
      std::to_string(s) + "," + std::to_string(s) +
      ",2.\nGRID,8,,1.,0.,1.\n"
      "CQUAD8,1,5,1,2,3,4,5,6\n,7,8\n"
      "CTRIA6,2,5,1,2,4,5,\n"
      "PSHELL,5,7,.01,7,,7\nMAT1,7,206.+9,,.3,7850.\nCONM2,3,6,,100.\n");
  const Mesh& mesh = deck.mesh;
  expect_near(position(mesh, mesh.shells[0], {0.5, 0}), Vector3(s, s, 0), 1e-6);
  expect_near(position(mesh, mesh.shells[0], {1, 0.5}), Vector3(0, 1, 1), 1e-12);
  // Serendipity in the middle: half the sum of the middles less a quarter of the corners'.
  expect_near(position(mesh, mesh.shells[0], {0.5, 0.5}), Vector3(s, s, 1), 1e-6);
  // The side of the triangle from corner 2 to 4 is straight, that from 1 to 2 curved.
  expect_near(position(mesh, mesh.shells[1], {0.5, 0}), Vector3(s, s, 0), 1e-6);
  expect_near(position(mesh, mesh.shells[1], {1, 0.5}), Vector3(0.5, 0.5, 1), 1e-12);
  expect_near(position(mesh, mesh.shells[1], {0.3, 1}), Vector3(1, 0, 2), 1e-12);
  // The mass hangs on the middle of an edge.
  ASSERT_EQ(mesh.surface_points.size(), 1U);
  EXPECT_EQ(mesh.vertex_labels[mesh.surface_points[0].vertex], 6);
  expect_near(mesh.surface_points[0].xi, Eigen::Vector2d(1, 0.5), 1e-15);
  // Its arc is the parabola through the three points: half chord a, height 1 - a, slope s at its
  // ends, long a (sqrt(1 + s^2) + asinh(s) / s). Three Gauss points leave (b - a)^7 f^(6) /
  // 2,016,000, f = sqrt(1 + s^2 x^2) on (-1, 1), f^(6) up to 45 s^6 = 14.6: 9.3e-4 of a.
  const double slope = 2 * (1 - s) / s;
  const double arc = s * (std::sqrt(1 + slope * slope) + std::asinh(slope) / slope);
  EXPECT_NEAR(area(mesh, mesh.shells[0]), 2 * arc, 2 * s * 9.3e-4);
}

TEST(NastranReader, BarWithOffsetsAndReleases) {
  const Deck deck = nastran(R"(CORD2C,1,,0.,0.,0.,0.,0.,1.
,1.,0.,0.
GRID,1,1,2.,90.,0.,1
GRID,2,,0.,2.,3.,1
GRID,3,,5.,2.,0.
CBAR,10,5,1,2,1.,0.,0.
,45,56,.1,.2,0.,.1,.2,0.
CBAR,11,5,1,2,3,,,BOO
,,,0.,.1,0.,0.,.1,0.
PBAR,5,7,.01,4.-6,1.-6,2.-6,1.5
,.1,.05,-.1,.05
,.5,.25,1.-7
MAT1,7,206.+9,,.3,7850.
)");
  const Beam& bar = deck.mesh.beams.at(0);
  // At 90 degrees: radial is y, tangential -x.
  expect_near(bar.axis_2, Vector3::UnitY(), 1e-12);
  expect_near(bar.offset[0], Vector3(-0.2, 0.1, 0), 1e-12);
  EXPECT_THAT(bar.release[0], ElementsAre(false, false, false, true, true, false));
  EXPECT_THAT(bar.release[1], ElementsAre(false, false, false, false, true, true));
  // Towards grid 3: x; offsets along the bar's own y.
  const Beam& other = deck.mesh.beams.at(1);
  expect_near(other.axis_2, Vector3(5, 0, 0), 1e-12);
  expect_near(other.offset[1], Vector3(0.1, 0, 0), 1e-12);
  const BeamSection& section = deck.mesh.section_of(bar);
  EXPECT_DOUBLE_EQ(section.second_moment_3, 4e-6);  // I1 bends in the plane of axes 1 and 2
  EXPECT_DOUBLE_EQ(section.second_moment_2, 1e-6);
  EXPECT_DOUBLE_EQ(section.product_23, 1e-7);
  EXPECT_DOUBLE_EQ(section.shear_area_2, 0.005);
  EXPECT_DOUBLE_EQ(section.shear_area_3, 0.0025);
  EXPECT_DOUBLE_EQ(section.mass_per_length, 1.5);
  EXPECT_EQ(section.stress_points.size(), 2U);
}

TEST(NastranReader, ShapesOfBars) {
  const auto section = [](const std::string& card) {
    const Deck deck =
        nastran("GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nMAT1,7,206000.,,.3,7.85-9\n" + card, "mm-t-N");
    return deck.mesh.section_of(deck.mesh.beams.at(0));
  };
  const auto bar = [&](const std::string& shape) {
    return section("CBAR,1,5,1,2,0.,0.,1.\nPBARL,5,7,," + shape);
  };
  const double mm4 = 1e-12;
  // y is up, z across: a bar of width 10 and height 20.
  EXPECT_NEAR(bar("BAR\n,10.,20.").second_moment_3, 10 * 8000 / 12.0 * mm4, 1e-20);
  EXPECT_NEAR(bar("BAR\n,10.,20.").area, 200e-6, 1e-18);
  EXPECT_NEAR(bar("ROD\n,10.").area, std::numbers::pi * 1e-4, 1e-12);
  EXPECT_NEAR(bar("TUBE\n,10.,9.").area, std::numbers::pi * 19e-6, 1e-12);
  EXPECT_NEAR(bar("TUBE2\n,10.,1.").area, std::numbers::pi * 19e-6, 1e-12);
  EXPECT_NEAR(bar("T\n,100.,200.,10.,8.").area, (1000 + 190 * 8) * 1e-6, 1e-15);
  EXPECT_NEAR(bar("T2\n,100.,200.,10.,8.").second_moment_3,
              bar("T\n,100.,200.,10.,8.").second_moment_3, 1e-20);
  EXPECT_NEAR(bar("I\n,200.,100.,80.,8.,10.,12.").area, (1000 + 960 + 178 * 8) * 1e-6, 1e-15);
  EXPECT_NEAR(bar("I1\n,92.,8.,180.,200.").area, (2 * 1000 + 180 * 8) * 1e-6, 1e-15);
  EXPECT_NEAR(bar("CHAN\n,60.,200.,8.,10.").area, (2 * 600 + 180 * 8) * 1e-6, 1e-15);
  EXPECT_NEAR(bar("CHAN1\n,52.,8.,180.,200.").second_moment_3,
              bar("CHAN\n,60.,200.,8.,10.").second_moment_3, 1e-18);
  EXPECT_NEAR(bar("CHAN2\n,10.,8.,60.,200.").second_moment_2,
              bar("CHAN\n,60.,200.,8.,10.").second_moment_3, 1e-18);
  EXPECT_NEAR(bar("BOX\n,100.,200.,10.,8.").second_moment_3,
              (100 * 8e6 - 84 * std::pow(180, 3)) / 12 * mm4, 1e-16);
  EXPECT_NEAR(bar("BOX1\n,100.,200.,10.,10.,8.,8.").second_moment_3,
              bar("BOX\n,100.,200.,10.,8.").second_moment_3, 1e-18);
  EXPECT_NEAR(bar("H\n,80.,20.,100.,8.").area, (20 * 100 + 80 * 8) * 1e-6, 1e-15);
  EXPECT_NEAR(bar("T1\n,100.,90.,10.,8.").area, (1000 + 720) * 1e-6, 1e-15);
  EXPECT_NEAR(bar("CROSS\n,90.,10.,100.,8.").area, (1000 + 720) * 1e-6, 1e-15);
  EXPECT_LT(bar("Z\n,50.,8.,180.,200.").product_23, 0);
  EXPECT_NEAR(bar("Z\n,50.,8.,180.,200.").area, (180 * 8 + 20 * 58) * 1e-6, 1e-15);
  EXPECT_NEAR(bar("HAT\n,50.,2.,40.,15.").area, (40 * 2 + 2 * 46 * 2 + 2 * 17 * 2) * 1e-6, 1e-15);
  // A mass beyond the bar's follows the dimensions: t/mm is 1e6 kg/m.
  EXPECT_NEAR(bar("BAR\n,10.,20.,1.-6").mass_per_length, 1.0, 1e-12);
  EXPECT_THAT(complaints_of_nastran("GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCBAR,1,5,1,2,0.,0.,1.\n"
                                    "PBARL,5,7,,HAT9\n,1.,2.,3.\nMAT1,7,2.+11,,.3"),
              HasSubstr("deck.bdf:4: error: PBARL 5: the shape \"HAT9\" is not known"));
}

// The axis of a PBEAML's T is its shear centre, in the flange: the centroid hangs below.
TEST(NastranReader, BeamsAreAboutTheirShearCentre) {
  const Deck deck = nastran(R"(GRID,1,,0.,0.,0.
GRID,2,,4.,0.,0.
CBEAM,1,5,1,2,0.,0.,1.
CBEAM,2,6,1,2,0.,0.,1.
,,,0.,0.,.5,0.,0.,.5
PBEAML,5,7,,T
,.2,.4,.02,.01,,YES,1.,.2
,.4,.02,.01
PBEAM,6,7,.01,4.-6,1.-6,0.,2.-6
,.1,.05,-.1,.05
,YES,1.,.01,4.-6,1.-6,0.,2.-6
,.1,.05,-.1,.05
,1.,0.,,,,,,
,,,,,.03,.02,.03,.02
MAT1,7,206.+9,,.3,7850.
)");
  const Profile tee = tee_bar(0.4, 0.01, 0.2, 0.02);
  const Beam& beam = deck.mesh.beams.at(0);
  expect_near(beam.offset[0], Vector3(0, 0, -tee.section.shear_centre[0]), 1e-12);
  EXPECT_NEAR(deck.mesh.section_of(beam).area, tee.section.area, 1e-15);
  // The neutral axis of the other lies at y = 0.03, z = 0.02; the element's z is the world's -y.
  expect_near(deck.mesh.beams.at(1).offset[0], Vector3(0, -0.02, 0.53), 1e-12);
  const BeamSection& section = deck.mesh.section_of(deck.mesh.beams.at(1));
  EXPECT_DOUBLE_EQ(section.shear_area_2, 0.01);
  EXPECT_EQ(section.shear_area_3, std::numeric_limits<double>::infinity());
  expect_near(section.shear_centre, Eigen::Vector2d(-0.03, -0.02), 1e-15);
  expect_near(section.twist_centre(), section.shear_centre, 0);
}

// The axis of a CBAR is its centroids', about which it twists, too; a tee keeps its shear centre
// for what is checked of stiffeners.
TEST(NastranReader, BarsTwistAboutTheirCentroid) {
  const Deck deck = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,4.,0.,0.\nCBAR,1,5,1,2,0.,0.,1.\n"
      "PBARL,5,7,,T\n,.2,.4,.02,.01\nMAT1,7,206.+9,,.3,7850.\n");
  const BeamSection& section = deck.mesh.section_of(deck.mesh.beams.at(0));
  expect_near(section.shear_centre, tee_bar(0.4, 0.01, 0.2, 0.02).section.shear_centre, 1e-15);
  EXPECT_TRUE(section.twist_centre().isZero(0));
  EXPECT_TRUE(deck.mesh.beams[0].offset[0].isZero(0));
}

TEST(NastranReader, TaperedBeams) {
  const std::string line = "GRID,1,,0.,0.,0.\nGRID,2,,4.,0.,0.\nCBEAM,1,5,1,2,0.,0.,1.\n";
  const std::string material = "MAT1,7,206.+9,,.3,7850.\n";
  const Deck shaped =
      nastran(line + "PBEAML,5,7,,BAR\n,.2,.4,,YES,.5,,.35\n,YES,1.,.2,.3\n" + material);
  const Beam& beam = shaped.mesh.beams.at(0);
  ASSERT_GE(beam.end_section, 0);
  EXPECT_NEAR(section_at(shaped.mesh, beam, 0).area, 0.08, 1e-12);
  EXPECT_NEAR(section_at(shaped.mesh, beam, 0.5).area, 0.07, 1e-12);
  EXPECT_NEAR(section_at(shaped.mesh, beam, 1).second_moment_3, 0.2 * 0.027 / 12, 1e-9);
  // Blank figures between the ends are on the line; those at the end are as at the beginning.
  const Deck given =
      nastran(line +
              "PBEAM,5,7,.02,4.-6,1.-6,0.,2.-6,3.\n,.1,.05,-.1,.05\n,YES,1.,.01,,,,,1.\n"
              ",.05,.05,-.05,.05\n,NO,.5\n,1.,1.,,,,,,\n,,,,,.03,.0,.01,.0\n" +
              material);
  const BeamSection end = section_at(given.mesh, given.mesh.beams.at(0), 1);
  EXPECT_DOUBLE_EQ(end.area, 0.01);
  EXPECT_DOUBLE_EQ(end.second_moment_3, 4e-6);
  EXPECT_DOUBLE_EQ(end.mass_per_length, 1);
  expect_near(end.stress_points.at(0), Eigen::Vector2d(0.05, 0.05), 1e-15);
  EXPECT_NEAR(given.mesh.beams[0].offset[0].norm(), 0.03, 1e-12);
  EXPECT_NEAR(given.mesh.beams[0].offset[1].norm(), 0.01, 1e-12);
}

// Between stations its figures are linear: each part is a beam of its own. The line of stress
// points is left out.
TEST(NastranReader, BeamsThatAreNotLinearFromEndToEndAreDivided) {
  const std::string line = "GRID,1,,0.,0.,0.\nGRID,2,,4.,0.,0.\nCBEAM,9,5,1,2,0.,0.,1.\n";
  const std::string ends = ",5,45,0.,0.,.1,0.,0.,.3\n";
  const std::string material = "MAT1,7,206.+9,,.3,7850.\n";
  const Deck deck = nastran(line + ends +
                            "PBEAM,5,7,.02,4.-6,1.-6,0.,2.-6,3.\n,NO,.5,.01,6.-6,,,,5.\n,NO,.25,"
                            ".04,,2.-6\n,NO,1.\n,1.,.5\n,,,,,.04,0.,.08,0.\n" +
                            material);
  const Mesh& mesh = deck.mesh;
  ASSERT_EQ(mesh.beams.size(), 3U);
  EXPECT_THAT(mesh.vertex_labels, ElementsAre(1, 2, 3, 4));
  expect_near(mesh.vertices[2], Vector3(1, 0, 0), 1e-12);
  expect_near(mesh.vertices[3], Vector3(2, 0, 0), 1e-12);
  const std::vector<std::array<int, 2>> ways{{0, 2}, {2, 3}, {3, 1}};
  const std::vector<double> areas{0.02, 0.04, 0.01, 0.02}, moments{4e-6, 4e-6, 6e-6, 4e-6},
      others{1e-6, 2e-6, 1e-6, 1e-6}, extra{3, 3, 5, 3}, places{0, 1, 2, 4};
  // Offsets and the neutral axis, which lies across the line between the ends' offsets, are linear
  // from end to end.
  const Vector3 across = Vector3(-0.2, 0, 4).normalized();
  const auto offset = [&](double x) -> Vector3 {
    return Vector3(0, 0, 0.1 + 0.05 * x) + (0.04 + 0.01 * x) * across;
  };
  const double slope = (Vector3(4, 0, 0) + offset(4) - offset(0)).norm() / 4;
  double mass = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Beam& beam = mesh.beams[i];
    EXPECT_EQ(beam.label, 9);
    EXPECT_EQ(beam.vertices, ways[i]);
    for (std::size_t end = 0; end < 2; ++end) {
      const BeamSection section = section_at(mesh, beam, static_cast<double>(end));
      EXPECT_DOUBLE_EQ(section.area, areas[i + end]);
      EXPECT_DOUBLE_EQ(section.second_moment_3, moments[i + end]);
      EXPECT_DOUBLE_EQ(section.second_moment_2, others[i + end]);
      EXPECT_DOUBLE_EQ(section.mass_per_length, extra[i + end]);
      EXPECT_DOUBLE_EQ(section.shear_area_3, areas[i + end] / 2);
      expect_near(beam.offset[end], offset(places[i + end]), 1e-12);
    }
    mass += (places[i + 1] - places[i]) *
            (7850 * (areas[i] + areas[i + 1]) + extra[i] + extra[i + 1]) / 2;
  }
  EXPECT_NEAR(mass_properties(mesh).mass / mass, slope, 1e-12);
  EXPECT_TRUE(mesh.beams[0].release[0][4]);
  EXPECT_EQ(mesh.beams[0].release[1], BeamRelease{});
  EXPECT_EQ(mesh.beams[1].release[0], BeamRelease{});
  EXPECT_THAT(mesh.beams[2].release[1], ElementsAre(false, false, false, true, true, false));
}

TEST(NastranReader, ShapedBeamsAreDividedAtTheirStations) {
  const Deck deck = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,4.,0.,0.\nCBEAM,9,5,1,2,0.,0.,1.\nPBEAML,5,7,,BAR\n"
      ",.2,.4,,NO,.25,.1\n,NO,1.\nMAT1,7,206.+9,,.3,7850.\nPLOAD1,3,9,FZ,FR,0.,-5.,1.,-5.\n");
  ASSERT_EQ(deck.mesh.beams.size(), 2U);
  EXPECT_NEAR(section_at(deck.mesh, deck.mesh.beams[0], 1).area, 0.04, 1e-12);
  EXPECT_NEAR(section_at(deck.mesh, deck.mesh.beams[0], 1).second_moment_3, 0.1 * 0.064 / 12,
              1e-12);
  EXPECT_NEAR(section_at(deck.mesh, deck.mesh.beams[1], 1).area, 0.08, 1e-12);
  // What acts on the beam acts on both.
  EXPECT_EQ(deck.load_sets.at(0).beam_loads.size(), 2U);
}

TEST(NastranReader, StationsThatCannotBeDividedAt) {
  const std::string plate =
      "GRID,1,,0.,0.,0.\nGRID,2,,4.,0.,0.\nGRID,3,,4.,1.,0.\nGRID,4,,0.,1.,0.\n"
      "CQUAD4,1,6,1,2,3,4\nPSHELL,6,7,.01,7,,7\nMAT1,7,206.+9,,.3,7850.\nCBEAM,9,5,1,2,0.,0.,1.\n";
  EXPECT_THAT(
      complaints_of_nastran(plate + "PBEAM,5,7,.02,4.-6,1.-6,0.,2.-6\n,NO,.5,.01\n,NO,1.\n"),
      HasSubstr("its beam runs along the edge of a plate: divide the beam and the plate"));
  EXPECT_THAT(complaints_of_nastran(
                  plate + "PBEAM,5,7,.02,4.-6,1.-6,0.,2.-6\n,NO,.5,.01\n,NO,.5,.02\n,NO,1.\n"),
              HasSubstr("two stations are at X/XB = 0.5"));
  EXPECT_THAT(complaints_of_nastran(plate + "PBEAM,5,7,.02,4.-6,1.-6,0.,2.-6\n,NO,0.,.01\n"),
              HasSubstr("X/XB is 0; more than 0 is due"));
}

TEST(NastranReader, Rods) {
  const Deck deck = nastran(R"(GRID,1,,0.,0.,0.
GRID,2,,4.,0.,0.
CROD,1,5,1,2
CTUBE,2,6,1,2
CONROD,3,1,2,7,.003,1.-6,,2.
PROD,5,7,.001,1.-7
PTUBE,6,7,.1,.01
MAT1,7,206.+9,,.3,7850.
)");
  for (const Beam& rod : deck.mesh.beams) EXPECT_TRUE(rod.is_rod);
  EXPECT_NEAR(deck.mesh.section_of(deck.mesh.beams[0]).area, 0.001, 1e-15);
  EXPECT_NEAR(deck.mesh.section_of(deck.mesh.beams[1]).area,
              std::numbers::pi * (0.05 * 0.05 - 0.04 * 0.04), 1e-15);
  EXPECT_NEAR(deck.mesh.section_of(deck.mesh.beams[2]).mass_per_length, 2, 1e-15);
}

TEST(NastranReader, RigidAndDistributingLinks) {
  const Deck deck = nastran(R"(CORD2C,1,,0.,0.,0.,0.,0.,1.
,1.,0.,0.
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,0.,1.,0.,1
GRID,4,,0.,0.,1.
GRID,5,,0.,0.,2.
RBE2,10,1,123456,2,3
RBE2,11,4,1,2,3,1.2-5
RBE3,12,,5,123456,1.,123,1,2
,2.5,123,3,4,UM,5,123
RBAR,13,1,5,123456,,,123
RBE1,14,4,123456
,UM,5,456
)");
  const Mesh& mesh = deck.mesh;
  ASSERT_EQ(mesh.rigid_links.size(), 5U);
  EXPECT_THAT(mesh.rigid_links[0].slaves, ElementsAre(1, 2));
  // A part of the displacements counts along the axes of each dependent grid.
  EXPECT_THAT(mesh.rigid_links[1].slaves, ElementsAre(2));
  expect_near(mesh.rigid_links[1].axes.col(0), Vector3::UnitY(), 1e-12);
  EXPECT_THAT(mesh.rigid_links[2].slaves, ElementsAre(1));
  EXPECT_THAT(mesh.rigid_links[3].bound, ElementsAre(true, true, true, false, false, false));
  EXPECT_THAT(mesh.rigid_links[4].bound, ElementsAre(false, false, false, true, true, true));
  ASSERT_EQ(mesh.distributing_links.size(), 1U);
  EXPECT_EQ(mesh.distributing_links[0].reference, 4);
  EXPECT_THAT(mesh.distributing_links[0].vertices, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(mesh.distributing_links[0].weights, ElementsAre(1, 1, 2.5, 2.5));
  EXPECT_THAT(entry(deck, "RBE2").left_out, HasSubstr("thermal"));
  // Which freedoms UM has the solver eliminate changes nothing.
  EXPECT_THAT(entry(deck, "RBE3").left_out, ::testing::IsEmpty());
  const std::string pair = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n";
  const Deck warmed = nastran(pair + "RBE3,12,,1,123,1.,123,2,3\n,UM,2,123,,,,,\n,ALPHA,1.2-5\n");
  EXPECT_THAT(entry(warmed, "RBE3").left_out, HasSubstr("thermal"));
}

TEST(NastranReader, Springs) {
  const Deck deck = nastran(R"(CORD2C,1,,0.,0.,0.,0.,0.,1.
,1.,0.,0.
GRID,1,,0.,1.,0.,1
GRID,2,,2.,1.,0.
CELAS1,10,5,1,1,2,1
CELAS2,11,200.,,,2,4
CBUSH,12,6,1,2,0.,0.,1.
,0.25
CBUSH,13,6,2,,,,,0
PELAS,5,100.
PBUSH,6,K,1000.,,,50.
)",
                            "mm-t-N");
  const Mesh& mesh = deck.mesh;
  ASSERT_EQ(mesh.springs.size(), 6U);
  EXPECT_DOUBLE_EQ(mesh.springs[0].stiffness, 1e5);  // N/mm
  expect_near(mesh.springs[0].axes[0].col(0), Vector3::UnitY(), 1e-12);
  expect_near(mesh.springs[0].axes[1].col(0), Vector3::UnitX(), 1e-12);
  EXPECT_DOUBLE_EQ(mesh.springs[1].stiffness, 0.2);  // N mm/rad
  EXPECT_THAT(mesh.springs[1].vertices, ElementsAre(1, -1));
  EXPECT_THAT(mesh.springs[1].components, ElementsAre(3, 3));
  // A quarter of the way from 1 to 2; along it, and about it.
  expect_near(mesh.springs[2].arms[0], Vector3(0.5e-3, 0, 0), 1e-15);
  expect_near(mesh.springs[2].arms[1], Vector3(-1.5e-3, 0, 0), 1e-15);
  expect_near(mesh.springs[2].axes[0].col(0), Vector3::UnitX(), 1e-12);
  EXPECT_DOUBLE_EQ(mesh.springs[2].stiffness, 1e6);
  EXPECT_THAT(mesh.springs[3].components, ElementsAre(3, 3));
  EXPECT_DOUBLE_EQ(mesh.springs[3].stiffness, 0.05);
  EXPECT_EQ(mesh.springs[4].vertices[1], -1);
}

TEST(NastranReader, Masses) {
  const Deck deck = nastran(R"(PARAM,WTMASS,0.1
CORD2R,1,,0.,0.,0.,0.,0.,1.
,0.,1.,0.
GRID,1,,1.,2.,3.
CONM2,10,1,1,50.,1.,0.,0.
,1.,.1,2.,.2,.3,3.
CONM2,11,1,-1,50.,1.,2.,4.
CONM1,12,1,,50.,,50.
,50.,,-50.,,60.,50.
,,60.,,,,,,10.
)");
  const PointMass& mass = deck.mesh.masses.at(0);
  EXPECT_DOUBLE_EQ(mass.mass, 5);
  expect_near(mass.offset, Vector3::UnitY(), 1e-12);
  // Turned by 90 degrees about z: what was about x is about y; products change place and sign.
  Eigen::Matrix3d inertia;
  inertia << 2, 0.1, 0.3, 0.1, 1, -0.2, 0.3, -0.2, 3;
  expect_near(mass.inertia, 0.1 * inertia, 1e-12);
  expect_near(deck.mesh.masses.at(1).offset, Vector3(0, 0, 1), 1e-12);
  // The matrix of 50 at (0, 0, 1) from its grid: m c^2 = 50 of its 60 about x and y.
  const PointMass& matrix = deck.mesh.masses.at(2);
  EXPECT_DOUBLE_EQ(matrix.mass, 5);
  expect_near(matrix.offset, Vector3(0, 0, 1), 1e-12);
  expect_near(matrix.inertia, Eigen::Matrix3d::Identity(), 1e-12);
  EXPECT_THAT(complaints_of_nastran("GRID,1,,0.,0.,0.\nCONM1,12,1,,50.,,40.\n,50.\n"),
              HasSubstr("deck.bdf:2: error: CONM1: CONM1 12 is not the matrix of a rigid body"));
}

// PCOMP of layers of one material is a plate; of two, its A, B, D are those of the stack.
TEST(NastranReader, LayeredPlates) {
  const std::string mesh =
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\nGRID,4,,0.,2.,0.\n"
      "CQUAD4,10,5,1,2,3,4,30.\nMAT1,7,206.+9,,.3,7850.\nMAT1,8,1.+8,,.3,60.\n";
  const Deck one = nastran(mesh + "PCOMP,5,0.,2.5\n,7,.004,0.,YES,7,.006,45.,YES\n");
  EXPECT_TRUE(one.mesh.laminates.empty());
  EXPECT_NEAR(one.mesh.shell_sections[0].thickness, 0.01, 1e-15);
  EXPECT_NEAR(one.mesh.shell_sections[0].offset, 0.005, 1e-15);  // its bottom is on the grids
  EXPECT_NEAR(one.mesh.shell_sections[0].mass_per_area, 2.5, 1e-15);
  const Deck two = nastran(mesh + "PCOMP,5,,,,,,,SYM\n,7,.001,0.,,8,.025\n");
  ASSERT_EQ(two.mesh.laminates.size(), 1U);
  const Material steel = {"", 206e9, 0.3, 7850, 0}, foam = {"", 1e8, 0.3, 60, 0};
  const Laminate expected = stack({{isotropic_ply(steel), 0.001, 0},
                                   {isotropic_ply(foam), 0.05, 0},
                                   {isotropic_ply(steel), 0.001, 0}});
  expect_near(two.mesh.laminates[0].bending, expected.bending, 1e-9 * expected.bending.norm());
  expect_near(two.mesh.laminates[0].shear, expected.shear, 1e-9 * expected.shear.norm());
  EXPECT_NEAR(mass_properties(two.mesh).mass, 4 * (2 * 7.85 + 0.05 * 60), 1e-9);
  // The layers' axis 1 is 30 degrees off the first side.
  expect_near(two.mesh.shells[0].laminate_axis, Vector3(std::cos(std::numbers::pi / 6), 0.5, 0),
              1e-12);
}

TEST(NastranReader, PlatesWithAnotherBendingStiffness) {
  const std::string mesh =
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\n"
      "CTRIA3,10,5,1,2,3\nMAT1,7,206.+9,,.3,7850.\n";
  const Deck deck = nastran(mesh + "PSHELL,5,7,.01,7,3.,7\n");
  ASSERT_EQ(deck.mesh.laminates.size(), 1U);
  const double d = 206e9 / 0.91 * 1e-6 / 12;
  EXPECT_NEAR(deck.mesh.laminates[0].bending(0, 0), 3 * d, 1e-6 * d);
  EXPECT_NEAR(deck.mesh.laminates[0].membrane(0, 0), 206e9 / 0.91 * 0.01, 1);
  // MAT8 of equal moduli is no different from MAT1.
  const Deck same = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\nCTRIA3,10,5,1,2,3\n"
      "MAT8,7,2.6+11,2.6+11,.3,1.+11,,,7850.\nPSHELL,5,7,.01,7,,7\n");
  EXPECT_TRUE(same.mesh.laminates.empty());
  EXPECT_DOUBLE_EQ(same.mesh.materials[0].youngs_modulus, 2.6e11);
}

}  // namespace
}  // namespace blocklift::structure::test
