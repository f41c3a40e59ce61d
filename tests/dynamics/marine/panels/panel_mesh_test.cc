#include "dynamics/marine/panels/panel_mesh.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/panels/enclosed_surface.h"
#include "dynamics/marine/panels/lone_rows.h"
#include "dynamics/marine/panels/panel_clusters.h"
#include "dynamics/marine/panels/panel_model.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/panels/surface_mesh.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Panel, AreaNormalAndCentroidByHand) {
  const Panel trapezium = make_panel(
      std::array{Vector3(0, 0, -1), Vector3(3, 0, -1), Vector3(2, 1, -1), Vector3(0, 1, -1)});
  EXPECT_DOUBLE_EQ(trapezium.area, 2.5);
  EXPECT_LT((trapezium.normal - Vector3(0, 0, 1)).norm(), 1e-15);
  // Square 2 x 2/2 and a triangle: (2 * 1 + 0.5 * (2 + 1/3)) / 2.5.
  EXPECT_NEAR(trapezium.centroid.x(), (2.0 * 1.0 + 0.5 * (2.0 + 1.0 / 3.0)) / 2.5, 1e-15);
}

TEST(Panel, RefusesWhatIsNoPanel) {
  EXPECT_THAT(
      [] {
        make_panel(std::array{Vector3(0, 0, 0), Vector3(1, 0, 0)});
      },
      ThrowsMessage<ModelError>(HasSubstr("3 or 4")));
  EXPECT_THAT(
      [] {
        make_panel(std::array{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(2, 0, 0)});
      },
      ThrowsMessage<ModelError>(HasSubstr("has no area")));
  EXPECT_THAT(
      [] {
        make_panel(std::array{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, not_a_number, 0)});
      },
      ThrowsMessage<ModelError>(HasSubstr("not a finite number")));
}

TEST(PanelShapes, KeepOutTheirVolume) {
  const RoundDivision division{.meridians = 12, .parallels = 3};
  EXPECT_NEAR(make_half_ellipsoid({1, 2, 3}, division).displaced_volume(), 4.0 * std::numbers::pi,
              1e-12);
  EXPECT_NEAR(make_ellipsoid({1, 2, 3}, {0, 0, -5}, division).displaced_volume(),
              8.0 * std::numbers::pi, 1e-11);
  EXPECT_NEAR(make_vertical_cylinder(2, 3, true, division).displaced_volume(),
              12.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(make_box_hull(10, 4, 2).displaced_volume(), 80.0, 1e-12);
  EXPECT_NEAR(make_ring(3, 2, 1.5, division).displaced_volume(), 7.5 * std::numbers::pi, 1e-12);
}

TEST(PanelMesh, SymmetricPartAndWholeAreTheSame) {
  const PanelMesh whole = make_box_hull(10, 4, 2, {.length = 6, .breadth = 4, .draught = 2});
  const PanelMesh quarter = restrict_to_symmetry(whole, {true, true});
  EXPECT_EQ(4 * quarter.size(), whole.size());
  EXPECT_NEAR(quarter.displaced_volume(), 80.0, 1e-12);
  const PanelMesh again = expand_symmetry(quarter);
  EXPECT_NEAR(again.displaced_volume(), 80.0, 1e-12);
  Vector3 sum = Vector3::Zero();
  for (const Panel& panel : again.panels) sum += panel.area * panel.normal;
  EXPECT_LT((sum - Vector3(0, 0, -40)).norm(), 1e-12);
  // Five panels along: the middle one lies across x = 0.
  EXPECT_THAT(
      [] {
        restrict_to_symmetry(make_box_hull(10, 4, 2, {.length = 5}), {true, false});
      },
      ThrowsMessage<ModelError>(HasSubstr("crosses the plane of symmetry x = 0")));
  EXPECT_THAT(
      [&] {
        restrict_to_symmetry(translate(whole, {7, 0, 0}), {true, false});
      },
      ThrowsMessage<ModelError>(HasSubstr("not symmetric")));
}

TEST(PanelMesh, FindsTheWaterLine) {
  const auto lines = find_water_lines(make_box_hull(10, 4, 2, {.length = 6, .breadth = 4}));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), 20U);
  EXPECT_NEAR(enclosed_area(lines[0]), 40.0, 1e-12);
  PanelMesh torn = make_box_hull(10, 4, 2);
  for (std::size_t k = 0; k < torn.panels.size(); ++k) {
    if (torn.panels[k].vertices[2].z() == 0.0) {
      torn.panels.erase(torn.panels.begin() + static_cast<std::ptrdiff_t>(k));
      break;
    }
  }
  EXPECT_THAT([&] { find_water_lines(torn); },
              ThrowsMessage<ModelError>(HasSubstr("leave a gap in the water line at (")));
  EXPECT_TRUE(find_water_lines(make_ellipsoid({1, 1, 1}, {0, 0, -3})).empty());
}

std::vector<WettedBody> spheres(const std::vector<double>& x) {
  std::vector<WettedBody> bodies;
  const PanelMesh sphere = make_half_ellipsoid({1, 1, 1}, {.meridians = 16, .parallels = 4});
  for (const double at : x) {
    bodies.push_back(
        {"sphere at " + std::to_string(at), translate(sphere, {at, 0, 0}), {at, 0, 0}});
  }
  return bodies;
}

/// Area of the regular polygon that the outer edge is, less the water lines.
double area_to_cover(const std::vector<WaterLine>& lines, double radius, std::size_t sides) {
  const double n = static_cast<double>(sides);
  double area = 0.5 * n * radius * radius * std::sin(2.0 * std::numbers::pi / n);
  for (const WaterLine& line : lines) area -= enclosed_area(line);
  return area;
}

TEST(SurfaceMesh, CoversTheWaterAroundOneBody) {
  const auto lines = find_water_lines(spheres({0}));
  const SurfaceMesh surface = make_surface_mesh(lines, {.first_ring = 0.1, .radius = 30});
  EXPECT_NEAR(surface.mesh.total_area(), area_to_cover(lines, 30.0, 16), 1e-9);
  for (const Panel& panel : surface.mesh.panels) {
    EXPECT_LT((panel.normal - Vector3(0, 0, -1)).norm(), 1e-15);
    EXPECT_LT(std::abs(panel.centroid.z()), 1e-15);
  }
  EXPECT_EQ(4 * restrict_to_symmetry(surface.mesh, {true, true}).size(), surface.mesh.size());
}

// The parts of two bodies meet half way: nothing is left out, nothing covered twice, so that the
// areas add up to that of the outer polygon, whose corners lie on the circle.
TEST(SurfaceMesh, CoversTheWaterBetweenBodies) {
  for (const double gap : {0.2, 1.0, 6.0}) {
    const auto bodies = spheres({-1.0 - gap / 2, 1.0 + gap / 2});
    const auto lines = find_water_lines(bodies);
    const SurfaceMesh surface = make_surface_mesh(lines, {.first_ring = 0.1, .radius = 30});
    double covered = surface.mesh.total_area();
    for (const WaterLine& line : lines) covered += enclosed_area(line);
    const double disc = std::numbers::pi * 900.0;
    EXPECT_LT(covered, disc);
    EXPECT_GT(covered, 0.9 * disc);  // a polygon of 12 corners and more
    EXPECT_EQ(4 * restrict_to_symmetry(surface.mesh, {true, true}).size(), surface.mesh.size());
    // No two panels overlap: each centroid lies in its own panel only (dipole of a flat panel from
    // just above: 2 pi inside, 0 outside).
    double worst = 0.0;
    for (std::size_t i = 0; i < surface.mesh.panels.size(); i += 7) {
      double angle = 0.0;
      for (const Panel& panel : surface.mesh.panels) {
        const Vector3 above = surface.mesh.panels[i].centroid - Vector3(0, 0, 1e-7);
        angle += calc_panel_potentials(panel, above).dipole;
      }
      worst = std::max(worst, std::abs(angle - 2.0 * std::numbers::pi));
    }
    EXPECT_LT(worst, 1e-4);
  }
}

// The innermost ring is a quarter of the water line's edge wide, however long the waves are.
TEST(SurfaceMesh, RingsFollowThePanelsOfTheHull) {
  for (const int meridians : {16, 48}) {
    const std::vector<WettedBody> bodies{
        {"cylinder", make_vertical_cylinder(1, 0.5, true, {.meridians = meridians}), {}}};
    const auto lines = find_water_lines(bodies);
    const SurfaceMesh surface = make_surface_mesh(lines, surface_settings(lines, 10.0, 20.0));
    const double edge = (lines[0][1] - lines[0][0]).norm();
    double innermost = std::numeric_limits<double>::infinity();
    for (const Panel& panel : surface.mesh.panels) {
      innermost = std::min(innermost, panel.area / edge);
    }
    EXPECT_NEAR(innermost, 0.25 * edge, 0.05 * edge);
  }
}

// Taken together four by four where that is possible; nothing is lost, and edges are kept.
TEST(PanelClusters, OfABoxCoverIt) {
  const PanelMesh box = make_box_hull(8, 4, 2, {8, 4, 2, 1.0});
  const PanelClusters clusters = cluster_panels(box);
  EXPECT_EQ(4 * clusters.count, box.size());
  Eigen::VectorXd areas(box.size()), depths(box.size());
  for (int k = 0; k < box.size(); ++k) {
    areas[k] = box.panels[k].area;
    depths[k] = box.panels[k].centroid.z();
  }
  EXPECT_NEAR(clusters.sum(areas).sum(), box.total_area(), 1e-12);
  for (int k = 0; k < clusters.count; ++k) EXPECT_NEAR(clusters.sum(areas)[k], 4.0, 1e-12);
  // Bottom and sides are not mixed: a cluster's mean depth is that of either.
  const Eigen::MatrixXd mean = clusters.average(areas, depths);
  for (int k = 0; k < clusters.count; ++k) {
    EXPECT_LT(std::min(std::abs(mean(k, 0) + 2.0), std::abs(mean(k, 0) + 1.0)), 1e-12);
  }
  EXPECT_EQ(cluster_panels(box, 1.0).count, box.size());
}

TEST(SurfaceMesh, ThreeBodiesInARow) {
  const auto lines = find_water_lines(spheres({-3, 0, 3}));
  const SurfaceMesh surface = make_surface_mesh(lines, {.first_ring = 0.15, .radius = 40});
  EXPECT_EQ(4 * restrict_to_symmetry(surface.mesh, {true, true}).size(), surface.mesh.size());
}

// Three columns about a thinner one: lines half way between them do not meet in points. Each
// panel's centroid lies in its own panel alone, as between two bodies.
TEST(SurfaceMesh, CoversTheWaterBetweenColumnsOfAPlatform) {
  const auto line_of_column = [](double x, double y, double radius, int vertices) {
    WaterLine line;
    for (int k = 0; k < vertices; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / vertices;
      line.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle), 0.0);
    }
    return line;
  };
  const std::vector<WaterLine> lines{
      line_of_column(0, 0, 3.25, 12), line_of_column(14.43, 25, 6, 28),
      line_of_column(14.43, -25, 6, 28), line_of_column(-28.87, 0, 6, 28)};
  const SurfaceMesh surface = make_surface_mesh(lines, {.first_ring = 1.5, .radius = 150});
  double covered = surface.mesh.total_area();
  for (const WaterLine& line : lines) covered += enclosed_area(line);
  EXPECT_LT(covered, std::numbers::pi * 150.0 * 150.0);
  EXPECT_GT(covered, 0.98 * std::numbers::pi * 150.0 * 150.0);
  EXPECT_EQ(2 * restrict_to_symmetry(surface.mesh, {false, true}).size(), surface.mesh.size());
  for (std::size_t i = 0; i < surface.mesh.panels.size(); i += 7) {
    double angle = 0.0;
    for (const Panel& panel : surface.mesh.panels) {
      const Vector3 above = surface.mesh.panels[i].centroid - Vector3(0, 0, 1e-6);
      angle += calc_panel_potentials(panel, above).dipole;
    }
    EXPECT_NEAR(angle, 2.0 * std::numbers::pi, 1e-4);
  }
}

/// A ring with a hole of 2 m, and what floats in it.
std::vector<WettedBody> ring_around(const std::vector<PanelMesh>& inner) {
  std::vector<WettedBody> bodies{
      {"ring", make_ring(4, 2, 1, {.meridians = 24, .parallels = 3}), {}}};
  for (const PanelMesh& hull : inner) bodies.push_back({"spar", hull, {}});
  return bodies;
}

// A moonpool's line runs the other way round, so that the lines add up to the water plane.
TEST(PanelMesh, OpeningsRunClockwise) {
  const auto lines = find_water_lines(ring_around({}));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NEAR(enclosed_area(lines[0]) + enclosed_area(lines[1]), 12 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(std::min(enclosed_area(lines[0]), enclosed_area(lines[1])), -4 * std::numbers::pi,
              1e-12);
}

// Water within a body is covered once, as the water outside: a moonpool, the gap to a body in it of
// another number of panels, and that to a body that does not lie in the middle.
TEST(SurfaceMesh, CoversTheWaterThatABodyEmbraces) {
  const PanelMesh spar = make_vertical_cylinder(1.5, 3, true, {.meridians = 20, .parallels = 4});
  const std::vector<std::vector<PanelMesh>> inner{{}, {spar}, {translate(spar, {0.2, 0.1, 0})}};
  for (const auto& within : inner) {
    const auto bodies = ring_around(within);
    const auto lines = find_water_lines(bodies);
    const SurfaceMesh surface = make_surface_mesh(lines, surface_settings(lines, 4.0, 12.0));
    const double held = within.empty() ? 0.0 : 2.25 * std::numbers::pi;
    double inside = 0.0;
    for (const Panel& panel : surface.mesh.panels) {
      EXPECT_LT((panel.normal - Vector3(0, 0, -1)).norm(), 1e-15);
      if (panel.centroid.norm() < 2.0) inside += panel.area;
    }
    EXPECT_NEAR(inside, 4.0 * std::numbers::pi - held, 1e-9);
    if (&within == &inner[1]) {
      EXPECT_EQ(4 * restrict_to_symmetry(surface.mesh, {true, true}).size(), surface.mesh.size());
    }
    // Each centroid lies in its own panel only, as between bodies.
    for (std::size_t i = 0; i < surface.mesh.panels.size(); i += 13) {
      double angle = 0.0;
      for (const Panel& panel : surface.mesh.panels) {
        const Vector3 above = surface.mesh.panels[i].centroid - Vector3(0, 0, 1e-7);
        angle += calc_panel_potentials(panel, above).dipole;
      }
      EXPECT_NEAR(angle, 2.0 * std::numbers::pi, 1e-3);
    }
  }
}

TEST(SurfaceMesh, RefusesWhatDoesNotFitIntoAnOpening) {
  const auto refused = [](const std::vector<PanelMesh>& inner) {
    const auto lines = find_water_lines(ring_around(inner));
    make_surface_mesh(lines, surface_settings(lines, 4.0, 12.0));
  };
  const PanelMesh spar = make_vertical_cylinder(0.5, 3, true, {.meridians = 12, .parallels = 4});
  EXPECT_THAT(
      [&] {
        refused({translate(spar, {1, 0, 0}), translate(spar, {-1, 0, 0})});
      },
      ThrowsMessage<ModelError>(HasSubstr("two bodies float in one opening")));
  EXPECT_THAT(
      [&] {
        refused({translate(spar, {-1.8, 0, 0})});
      },
      ThrowsMessage<ModelError>(HasSubstr("two water lines intersect")));
  const EnclosedSurface hollow{{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {0, 1}}, {}};
  std::vector<Panel> panels;
  const auto widths = [](const PlanePolygon&) { return RingWidths{0.1, 0.1, 1.4, 1.1}; };
  EXPECT_THAT([&] { mesh_enclosed_surface(hollow, widths, 1e-9, panels); },
              ThrowsMessage<ModelError>(HasSubstr("cannot be seen from its middle")));
}

TEST(SurfaceMesh, NamesWhatIsWrong) {
  const auto lines = find_water_lines(spheres({0, 1.5}));
  EXPECT_THAT([&] { make_surface_mesh(lines, {.first_ring = 0.1, .radius = 30}); },
              ThrowsMessage<ModelError>(HasSubstr("two water lines intersect")));
  const auto one = find_water_lines(spheres({0}));
  EXPECT_THAT([&] { make_surface_mesh(one, {.first_ring = 0.1, .radius = 1.2}); },
              ThrowsMessage<ModelError>(HasSubstr("at least one and a half times")));
  EXPECT_THAT([&] { make_surface_mesh(one, {.first_ring = 0.0, .radius = 30}); },
              ThrowsMessage<ModelError>(HasSubstr("positive first ring")));
}

TEST(PanelModel, NamesWhatIsWrongWithAHull) {
  const SurfaceMesh none;
  const PanelMesh box = make_box_hull(10, 4, 2);
  const auto build = [&](const PanelMesh& hull, const Water& water, const Symmetry& symmetry) {
    return PanelModel({{"barge", hull, Vector3::Zero()}}, none, water, symmetry);
  };
  EXPECT_THAT(
      [&] {
        build(translate(box, {0, 0, 0.5}), {}, {});
      },
      ThrowsMessage<ModelError>(HasSubstr("barge has a panel above the water at")));
  EXPECT_THAT([&] { build(box, {.depth = 1.5}, {}); },
              ThrowsMessage<ModelError>(HasSubstr("reaches below the bottom")));
  EXPECT_THAT(
      [&] {
        build(translate(box, {1, 0, 0}), {}, {true, false});
      },
      ThrowsMessage<ModelError>(HasSubstr("not symmetric in the plane x = 0")));
  PanelMesh inverted;
  for (const Panel& panel : box.panels) {
    std::vector<Vector3> points(panel.vertices.rbegin(), panel.vertices.rend());
    inverted.panels.push_back(make_panel(points));
  }
  EXPECT_THAT([&] { build(inverted, {}, {}); },
              ThrowsMessage<ModelError>(HasSubstr("normals point into the body")));
  PanelMesh open = box;
  open.panels.erase(open.panels.begin() + 20);  // of the bottom
  EXPECT_THAT([&] { build(open, {}, {}); }, ThrowsMessage<ModelError>(HasSubstr("is open")));
}

TEST(PanelModel, FindsThePlanesOfSymmetry) {
  EXPECT_EQ(find_symmetry(spheres({0})), (Symmetry{true, true}));
  EXPECT_EQ(find_symmetry(spheres({-2, 2})), (Symmetry{true, true}));
  EXPECT_EQ(find_symmetry(spheres({0, 3})), (Symmetry{false, true}));
}

// Of five panels in a row the last has no partner: it goes with the pair beside it, so that nothing
// is as fine as before. Where rows may be left over it stays.
TEST(PanelMesh, WhatIsLeftOverGoesWithItsNeighbour) {
  std::vector<Panel> panels;
  for (int k = 0; k < 5; ++k) {
    const double x = 2.0 * k;
    panels.push_back(make_panel(
        std::array<Vector3, 4>{{{x, 0, -1}, {x, 2, -1}, {x + 2, 2, -1}, {x + 2, 0, -1}}}));
  }
  const PanelMesh row = make_panel_mesh(panels);
  EXPECT_EQ(cluster_panels(row).count, 1);
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  EXPECT_EQ(cluster_panels(row, unlimited, LeftOver::stays).count, 2);
}

// A row that is even has none left over, wherever rounding has its longest edge.
TEST(PanelMesh, OfEvenRowsNothingIsLeftOver) {
  for (const int meridians : {24, 48}) {
    const PanelMesh cylinder = make_vertical_cylinder(
        10.0, 5.0, true, {.meridians = meridians, .parallels = meridians / 12, .grading = 1.0});
    const PanelModel quarter({{"cylinder", cylinder, Vector3::Zero()}}, {}, {1000.0, 9.80665},
                             {true, true});
    const PanelClusters clusters = cluster_panels(quarter.body_mesh());
    EXPECT_EQ(4 * clusters.count, quarter.body_mesh().size()) << meridians;
  }
}

// Sides of one panel become two high; what has a neighbour to go with stays.
TEST(PanelMesh, LoneRowsAreHalved) {
  const PanelMesh box = make_box_hull(16.0, 8.0, 2.0, {8, 4, 1, 1.0});
  const PanelMesh halved = halve_lone_rows(box, {});
  EXPECT_EQ(box.size(), 8 * 4 + 2 * 8 + 2 * 4);
  EXPECT_EQ(halved.size(), 8 * 4 + 2 * (2 * 8 + 2 * 4));
  EXPECT_NEAR(halved.total_area(), box.total_area(), 1e-12);
  EXPECT_NEAR(halved.displaced_volume(), 16.0 * 8.0 * 2.0, 1e-9);
  for (const Panel& panel : halved.panels) {
    EXPECT_NEAR(panel.area, std::abs(panel.normal.z()) < 0.5 ? 2.0 : 4.0, 1e-12);
  }
  // Nothing is taken together across a plane of symmetry: a strip along it is halved.
  const PanelMesh narrow = make_box_hull(16.0, 4.0, 4.0, {8, 2, 2, 1.0});
  EXPECT_EQ(halve_lone_rows(narrow, {}).size(), narrow.size());
  EXPECT_EQ(halve_lone_rows(narrow, {false, true}).size(), narrow.size() + 8 * 2 + 2 * 2 * 2);
}

}  // namespace
}  // namespace blocklift::dynamics
