// Shapes of PBARL, PBEAML and *BEAM SECTION against the rectangles that they are drawn of.

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::HasSubstr;

/// From y to y and z to z, y being up and z to the right; a sign of -1 is a hole.
struct Rectangle {
  double y_0, y_1, z_0, z_1;
  double sign = 1;
};

struct Figures {
  double area = 0, y = 0, z = 0, about_z = 0, about_y = 0, product = 0;
  double top = -1e9, bottom = 1e9, right = -1e9, left = 1e9;
};

Figures sum_of(const std::vector<Rectangle>& drawn) {
  Figures sum;
  for (const Rectangle& part : drawn) {
    const double height = part.y_1 - part.y_0, width = part.z_1 - part.z_0;
    const double area = part.sign * height * width, y = (part.y_0 + part.y_1) / 2,
                 z = (part.z_0 + part.z_1) / 2;
    sum.area += area;
    sum.y += area * y;
    sum.z += area * z;
    sum.about_z += area * (y * y + height * height / 12);
    sum.about_y += area * (z * z + width * width / 12);
    sum.product += area * y * z;
    sum.top = std::max(sum.top, part.y_1);
    sum.bottom = std::min(sum.bottom, part.y_0);
    sum.right = std::max(sum.right, part.z_1);
    sum.left = std::min(sum.left, part.z_0);
  }
  sum.y /= sum.area;
  sum.z /= sum.area;
  sum.about_z -= sum.area * sum.y * sum.y;
  sum.about_y -= sum.area * sum.z * sum.z;
  sum.product -= sum.area * sum.y * sum.z;
  return sum;
}

/// About the centroid, whose place from the drawing's origin is given, m and mm.
void expect_drawn(const BeamSection& section, const std::vector<Rectangle>& drawn) {
  const Figures sum = sum_of(drawn);
  EXPECT_NEAR(section.area * 1e6, sum.area, 1e-9 * sum.area);
  EXPECT_NEAR(section.second_moment_3 * 1e12, sum.about_z, 1e-9 * sum.about_z);
  EXPECT_NEAR(section.second_moment_2 * 1e12, sum.about_y, 1e-9 * sum.about_y);
  EXPECT_NEAR(section.product_23 * 1e12, sum.product, 1e-9 * (sum.about_z + sum.about_y));
  Figures reach;
  for (const Eigen::Vector2d& point : section.stress_points) {
    reach.top = std::max(reach.top, 1000 * point[0]);
    reach.bottom = std::min(reach.bottom, 1000 * point[0]);
    reach.right = std::max(reach.right, 1000 * point[1]);
    reach.left = std::min(reach.left, 1000 * point[1]);
  }
  EXPECT_NEAR(reach.top, sum.top - sum.y, 1e-9);
  EXPECT_NEAR(reach.bottom, sum.bottom - sum.y, 1e-9);
  EXPECT_NEAR(reach.right, sum.right - sum.z, 1e-9);
  EXPECT_NEAR(reach.left, sum.left - sum.z, 1e-9);
}

BeamSection nastran_section(const std::string& shape) {
  const Deck deck = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nMAT1,7,206000.,,.3,7.85-9\nCBAR,1,5,1,2,0.,0.,1.\n"
      "PBARL,5,7,," +
          shape,
      "mm-t-N");
  return deck.mesh.section_of(deck.mesh.beams.at(0));
}

// MSC Nastran Quick Reference Guide, PBARL: the figures of the cross-sections, drawn here again.
TEST(NastranShapes, AreThoseOfTheirFigures) {
  const auto expect = [](const std::string& shape, const std::vector<Rectangle>& drawn) {
    SCOPED_TRACE(shape);
    expect_drawn(nastran_section(shape), drawn);
  };
  expect("BAR\n,30.,70.", {{0, 70, 0, 30}});
  expect("BOX\n,90.,70.,6.,4.", {{0, 70, 0, 90}, {6, 64, 4, 86, -1}});
  expect("I\n,200.,120.,80.,8.,10.,12.", {{0, 10, -60, 60}, {10, 188, -4, 4}, {188, 200, -40, 40}});
  expect("I1\n,92.,8.,180.,200.", {{0, 10, -50, 50}, {10, 190, -4, 4}, {190, 200, -50, 50}});
  expect("H\n,80.,24.,100.,8.", {{0, 100, -52, -40}, {0, 100, 40, 52}, {46, 54, -40, 40}});
  expect("T\n,100.,200.,10.,8.", {{190, 200, -50, 50}, {0, 190, -4, 4}});
  expect("T2\n,100.,200.,10.,8.", {{0, 10, -50, 50}, {10, 200, -4, 4}});
  expect("T1\n,100.,90.,10.,8.", {{0, 100, 90, 100}, {46, 54, 0, 90}});
  expect("CHAN\n,60.,200.,8.,10.", {{0, 10, 0, 60}, {10, 190, 0, 8}, {190, 200, 0, 60}});
  expect("CHAN1\n,52.,8.,180.,200.", {{0, 10, 0, 60}, {10, 190, 0, 8}, {190, 200, 0, 60}});
  expect("CHAN2\n,10.,8.,60.,200.", {{0, 60, 0, 10}, {0, 60, 190, 200}, {0, 8, 10, 190}});
  expect("CROSS\n,90.,10.,100.,8.", {{0, 100, -5, 5}, {46, 54, -50, -5}, {46, 54, 5, 50}});
  expect("Z\n,50.,8.,180.,200.", {{190, 200, -54, 4}, {10, 190, -4, 4}, {0, 10, -4, 54}});
  expect("L\n,60.,80.,8.,6.", {{0, 8, 0, 60}, {8, 80, 0, 6}});
  expect("HAT\n,50.,2.,40.,15.",
         {{48, 50, -20, 20}, {0, 48, -20, -18}, {0, 48, 18, 20}, {0, 2, -35, -20}, {0, 2, 20, 35}});
  expect("HAT1\n,80.,50.,40.,2.,3.", {{0, 3, -40, 40},
                                      {48, 50, -20, 20},
                                      {3, 48, -20, -18},
                                      {3, 48, 18, 20},
                                      {3, 5, -40, -20},
                                      {3, 5, 20, 40}});
  expect("DBOX\n,200.,100.,80.,6.,7.,8.,5.,4.\n,9.,3.",
         {{0, 100, 0, 200}, {4, 95, 6, 76.5, -1}, {3, 91, 83.5, 192, -1}});
}

TEST(NastranShapes, Hexagons) {
  const BeamSection section = nastran_section("HEXA\n,10.,50.,30.");
  EXPECT_NEAR(section.area * 1e6, 30 * 40, 1e-9);
  // A rectangle and what tapers on either side of it: b h^3 / 12 + d h^3 / 24.
  EXPECT_NEAR(section.second_moment_3 * 1e12, 30 * 27000 / 12.0 + 10 * 27000 / 24.0, 1e-6);
  // Of the two triangles about their own centroids and the middle.
  EXPECT_NEAR(section.second_moment_2 * 1e12,
              30 * 27000 / 12.0 + 2 * (30 * 1000 / 36.0 + 150 * std::pow(15 + 10 / 3.0, 2)), 1e-6);
  // A regular one: J = 1.0350 s^4 (Roark 1989, table 20: polygons), here by a formula of 7 %.
  const BeamSection regular =
      nastran_section("HEXA\n,10.,40.," + std::to_string(20 * std::sqrt(3.0)));
  EXPECT_NEAR(regular.torsion * 1e12, 1.035 * std::pow(20, 4), 0.08 * 1.035 * std::pow(20, 4));
}

// Closed shapes twist as Bredt's cells do, and walls that bear no flow by themselves: l t^3 / 3.
TEST(NastranShapes, CellsTwistTogether) {
  // A middle wall between equal cells bears nothing: 4 A^2 / sum of l / t around both.
  const double cells = 4 * std::pow(198.0 * 98, 2) / (198.0 + 98) + 98 * 8 / 3.0;
  EXPECT_NEAR(nastran_section("DBOX\n,200.,100.,100.,2.,2.,2.,2.,2.\n,2.,2.").torsion * 1e12, cells,
              1e-9 * cells);
  const double hat = 4 * std::pow(38 * 47.5, 2) / (38 / 2.0 + 47.5 + 38 / 3.0) + 2 * 21 * 125 / 3.0;
  EXPECT_NEAR(nastran_section("HAT1\n,80.,50.,40.,2.,3.").torsion * 1e12, hat, 1e-9 * hat);
}

BeamSection abaqus_section(const std::string& section, Eigen::Vector2d* centroid = nullptr) {
  const Deck deck = abaqus(
      "*NODE\n1,0.,0.,0.\n2,1000.,0.,0.\n*ELEMENT, TYPE=B31, ELSET=B\n1,1,2\n"
      "*MATERIAL, NAME=S\n*ELASTIC\n206000.,.3\n*DENSITY\n7.85e-9,\n*BEAM SECTION, ELSET=B, "
      "MATERIAL=S, SECTION=" +
          section + "0.,1.,0.\n",
      "mm-t-N");
  const Beam& beam = deck.mesh.beams.at(0);
  // n1 is the world's y, so that n2 is z.
  if (centroid) *centroid = 1000 * beam.offset[0].tail<2>();
  return deck.mesh.section_of(beam);
}

// Here y is n1, z n2.
TEST(AbaqusShapes, AreThoseOfTheirFigures) {
  expect_drawn(abaqus_section("RECT\n30.,70.\n"), {{0, 30, 0, 70}});
  expect_drawn(abaqus_section("BOX\n90.,70.,6.,5.,4.,3.\n"), {{0, 90, 0, 70}, {4, 84, 3, 65, -1}});
  Eigen::Vector2d centroid;
  const BeamSection trapezoid = abaqus_section("TRAPEZOID\n100.,60.,40.,20.\n", &centroid);
  EXPECT_NEAR(trapezoid.area * 1e6, 70 * 60, 1e-9);
  // Its centroid lies at b (a + 2 c) / (3 (a + c)) above the base.
  const double above = 60 * (100 + 2 * 40) / (3.0 * (100 + 40));
  expect_near(centroid, Eigen::Vector2d(0, above - 20), 1e-9);
  EXPECT_NEAR(trapezoid.second_moment_2 * 1e12, 216000.0 * (10000 + 4 * 4000 + 1600) / (36 * 140.0),
              1e-6);
  const BeamSection hexagon = abaqus_section("HEX\n50.,5.\n");
  const double inner = 50 - 5 / std::sqrt(0.75);
  const auto moment = [](double radius) { return 5 * std::sqrt(3) / 16 * std::pow(radius, 4); };
  EXPECT_NEAR(hexagon.area * 1e6, 1.5 * std::sqrt(3) * (2500 - inner * inner), 1e-9);
  EXPECT_NEAR(hexagon.second_moment_2 * 1e12, moment(50) - moment(inner), 1e-6);
  EXPECT_NEAR(hexagon.second_moment_3 * 1e12, moment(50) - moment(inner), 1e-6);
}

// Walls from point to point; back at a point that was there they close a cell.
TEST(AbaqusShapes, Walls) {
  Eigen::Vector2d centroid;
  const BeamSection angle =
      abaqus_section("ARBITRARY\n2, 0., 0., 100., 0., 10.\n100., 80., 8.\n", &centroid);
  EXPECT_NEAR(angle.area * 1e6, 1000 + 640, 1e-9);
  expect_near(centroid, Eigen::Vector2d(50000 + 64000, 640 * 40) / 1640, 1e-9);
  EXPECT_NEAR(angle.torsion * 1e12, (100 * 1000 + 80 * 512) / 3.0, 1e-6);
  const BeamSection ring = abaqus_section(
      "ARBITRARY\n4, 0., 0., 100., 0., 5.\n100., 60., 5.\n0., 60., 5.\n0., 0., 5.\n");
  EXPECT_NEAR(ring.torsion * 1e12, 4 * 36e6 / (320 / 5.0), 1e-3);
  EXPECT_THAT(
      complaints_of_abaqus("*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n*ELEMENT, TYPE=B31, ELSET=B\n1,1,2\n"
                           "*MATERIAL, NAME=S\n*ELASTIC\n2e11,.3\n*BEAM SECTION, ELSET=B, "
                           "MATERIAL=S, SECTION=ARBITRARY\n3, 0.,0.,1.,0.,.1\n"),
      HasSubstr("3 segments are due"));
}

}  // namespace
}  // namespace blocklift::structure::test
