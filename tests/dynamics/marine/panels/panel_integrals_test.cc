#include "dynamics/marine/panels/panel_integrals.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "pipeline/verification/models/panel_quadrature.h"

namespace blocklift::dynamics {
namespace {

using examples::by_quadrature;
using examples::skew_quadrangle;

TEST(PanelIntegrals, AgreeWithQuadrature) {
  const Panel panel = skew_quadrangle();
  const std::vector<Panel> panels{
      panel, make_panel(std::array{panel.vertices[0], panel.vertices[1], panel.vertices[2]})};
  for (const Panel& shape : panels) {
    for (const Vector3& offset : {Vector3(0.4, 0.3, 0.6), Vector3(-2, 1, 0.5), Vector3(0, 0, -0.7),
                                  Vector3(5, -6, 7), Vector3(0.2, -1.5, 0.3)}) {
      // Along the panel's first edge, across it, and off it.
      const Vector3 along = (shape.vertices[1] - shape.vertices[0]).normalized();
      const Vector3 point = shape.centroid + offset.x() * along +
                            offset.y() * shape.normal.cross(along) + offset.z() * shape.normal;
      // The distance is more than 0.3 of the panel: 20 x 20 pieces of order 10 are exact to 1e-12.
      const PanelPotentials exact = by_quadrature(shape, point, 20);
      const PanelPotentials found = calc_panel_potentials(shape, point);
      EXPECT_NEAR(found.source, exact.source, 1e-12 * exact.source);
      EXPECT_NEAR(found.dipole, exact.dipole, 1e-12 * (std::abs(exact.dipole) + exact.source));
    }
  }
}

// A rectangle whose numbers are exact: its centroid lies on its diagonal to the last digit, where
// the solid angle of either half has no direction. Seen from there: 2 a arsinh(b/a) + 2 b
// arsinh(a/b).
TEST(PanelIntegrals, ExactRectangleFromItsCentroid) {
  const Panel side = make_panel(
      std::array{Vector3(0, 10, -2), Vector3(0, 10, 0), Vector3(2.5, 10, 0), Vector3(2.5, 10, -2)});
  const double a = 2.5, b = 2;
  const double exact = 2 * a * std::asinh(b / a) + 2 * b * std::asinh(a / b);
  EXPECT_NEAR(calc_panel_potentials(side, side.centroid).source, exact, 1e-12 * exact);
  const PointColumns points(PanelMesh{{side}, {}});
  double source = 0, dipole = 0;
  add_panel_potentials(side, points, PanelIntegral::both, 1.0, &source, &dipole);
  EXPECT_NEAR(source, exact, 1e-12 * exact);
  EXPECT_TRUE(std::isfinite(dipole));
}

// Unit square, seen from its centre: 4 arsinh 1. From a height h above it: 4 arctan(1/(4 h sqrt(h^2
// + 1/2))) sr.
TEST(PanelIntegrals, UnitSquareByHand) {
  const Panel square = make_panel(std::array{Vector3(-0.5, -0.5, -1), Vector3(0.5, -0.5, -1),
                                             Vector3(0.5, 0.5, -1), Vector3(-0.5, 0.5, -1)});
  const PanelPotentials own = calc_panel_potentials(square, Vector3(0, 0, -1));
  EXPECT_NEAR(own.source, 4.0 * std::asinh(1.0), 1e-14);
  EXPECT_EQ(own.dipole, 0.0);
  for (const double h : {1e-3, 0.1, 1.0, 10.0, 1000.0}) {
    const double angle = 4.0 * std::atan(1.0 / (4.0 * h * std::sqrt(h * h + 0.5)));
    const double above = calc_panel_potentials(square, Vector3(0, 0, -1 + h)).dipole;
    const double below = calc_panel_potentials(square, Vector3(0, 0, -1 - h)).dipole;
    // The angle is that of a product of complex numbers with parts of the size h beside 1: rounding
    // by some 1e-16 / h, and how much of it depends on the instructions that the compiler takes.
    const double tolerance = (1e-13 + 1e-15 / h) * angle;
    EXPECT_NEAR(above, angle, tolerance);
    EXPECT_NEAR(below, -angle, tolerance);
  }
  // Far away a point source: 1/r (1 + O(1/r^2)); the edges' logarithms cancel by the factor r^2.
  const PanelPotentials far = calc_panel_potentials(square, Vector3(1000, 2000, -500));
  EXPECT_NEAR(far.source * Vector3(1000, 2000, -499).norm(), 1.0, 1e-6);
}

// The dipoles of a closed surface are the solid angle: -4 pi inside (normals point outwards), 0
// outside, and half of it at a panel's own centroid.
TEST(PanelIntegrals, SolidAngleOfAClosedSurface) {
  const PanelMesh sphere =
      make_ellipsoid({1, 2, 0.7}, {0, 0, -3}, {.meridians = 12, .parallels = 4});
  const auto total = [&](const Vector3& point) {
    double sum = 0.0;
    for (const Panel& panel : sphere.panels) sum += calc_panel_potentials(panel, point).dipole;
    return sum;
  };
  EXPECT_NEAR(total({0.2, 0.4, -2.9}), -4.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(total({0.2, 3.0, -2.9}), 0.0, 1e-12);
  for (const Panel& panel : sphere.panels) {
    EXPECT_NEAR(total(panel.centroid), -2.0 * std::numbers::pi, 1e-11);
  }
}

// Each of the four ways to ask gives the same numbers.
TEST(PanelIntegrals, ColumnsAgreeWithSinglePoints) {
  const Panel panel = skew_quadrangle();
  PointColumns points(37);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double s = static_cast<double>(i);
    points.x[i] = std::sin(3.0 * s) * 4.0;
    points.y[i] = std::cos(5.0 * s) * 3.0;
    points.z[i] = -2.0 + std::sin(7.0 * s);
  }
  std::vector<double> source(37, 1.0), dipole(37, 2.0), source_alone(37, 0.0),
      dipole_alone(37, 0.0);
  add_panel_potentials(panel, points, PanelIntegral::both, -2.0, source.data(), dipole.data());
  add_panel_potentials(panel, points, PanelIntegral::source, 1.0, source_alone.data(), nullptr);
  add_panel_potentials(panel, points, PanelIntegral::dipole, 1.0, nullptr, dipole_alone.data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PanelPotentials one =
        calc_panel_potentials(panel, {points.x[i], points.y[i], points.z[i]});
    EXPECT_NEAR(source[i], 1.0 - 2.0 * one.source, 1e-13);
    EXPECT_NEAR(dipole[i], 2.0 - 2.0 * one.dipole, 1e-13);
    EXPECT_NEAR(source_alone[i], one.source, 1e-14);
    EXPECT_NEAR(dipole_alone[i], one.dipole, 1e-14);
  }
  // In the panel's plane the source needs no solid angle.
  PointColumns level(1);
  const Vector3 p = panel.centroid + 1.7 * (panel.vertices[1] - panel.vertices[0]);
  level.x[0] = p.x(), level.y[0] = p.y(), level.z[0] = p.z();
  double coplanar = 0.0;
  add_panel_potentials(panel, level, PanelIntegral::coplanar_source, 1.0, &coplanar, nullptr);
  EXPECT_NEAR(coplanar, calc_panel_potentials(panel, p).source, 1e-13);
}

}  // namespace
}  // namespace blocklift::dynamics
