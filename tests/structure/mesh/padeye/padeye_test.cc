// Padeyes: mesh, bearing pressure and stress.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/files/part_reader.h"
#include "structure/part/padeye_model.h"

namespace blocklift::structure {
namespace {

constexpr double pi = std::numbers::pi;

const Material high_tensile_steel{"steel", 206e9, 0.3, 7850, 355e6};

PadeyeGeometry padeye_with_cheeks() {
  return {0.3, 0.08, 0.131, 0.127, 0.22, 0.042, 0.55, 0.6, 0.6};
}

// A strip with a round end: half as wide as its hole twice over (d / D = 0.5), with a long shank.
PadeyeGeometry strip() { return {0.1, 0.01, 0.1, 0.1, 0, 0, 0.7, 0.1, 0.1}; }

PartModel bare_part(const PadeyeGeometry& geometry, int divisions) {
  PartModel part;
  part.mesh = make_part_mesh(make_padeye_mesh(geometry, divisions).mesh);
  part.materials = {high_tensile_steel};
  part.material_of_solid.assign(part.mesh.solids.size(), 0);
  return part;
}

SurfaceLoad pin_force(const Vector3& force) {
  SurfaceLoad load;
  load.name = "pin";
  load.group = "hole";
  load.kind = SurfaceLoad::Kind::bearing;
  load.vector = force;
  return load;
}

// Main plate: base, tangents and arc (Euclid); cheek plates: rings.
TEST(PadeyeMesh, HasTheVolumeOfItsPlatesToFourthOrder) {
  const PadeyeGeometry g = padeye_with_cheeks();
  const double to_corner = std::hypot(0.6, g.height);
  const double tangent = std::sqrt(to_corner * to_corner - g.radius * g.radius);
  const double base_angle = 2 * std::atan2(0.6, g.height);
  const double arc = 2 * pi - base_angle - 2 * std::acos(g.radius / to_corner);
  const double outline = 0.6 * g.height + tangent * g.radius + arc * g.radius * g.radius / 2;
  const double hole = pi * g.hole_diameter * g.hole_diameter / 4;
  const double exact = (outline - hole) * g.thickness +
                       2 * g.cheek_thickness * (pi * g.cheek_radius * g.cheek_radius - hole);
  double coarse = 0;
  for (const int divisions : {16, 32}) {
    const double error = find_part_mass(bare_part(g, divisions)).volume / exact - 1;
    if (divisions == 32) {
      EXPECT_LT(std::abs(error), std::abs(coarse) / 8);  // order 4 but for uneven rays
      EXPECT_LT(std::abs(error), 1e-5);
    }
    coarse = error;
  }
}

TEST(PadeyeMesh, RefusesMeasuresThatDoNotFit) {
  const auto fault = [](auto change) {
    PadeyeGeometry geometry = padeye_with_cheeks();
    change(geometry);
    const auto faults = padeye_faults(geometry);
    EXPECT_THROW(make_padeye_mesh(geometry), ModelError);
    return faults.empty() ? std::string() : faults[0];
  };
  EXPECT_EQ(padeye_faults(padeye_with_cheeks()).size(), 0u);
  EXPECT_EQ(fault([](auto& g) { g.hole_diameter = 0.7; }).substr(0, 17), "the hole's radius");
  EXPECT_EQ(fault([](auto& g) { g.pin_diameter = 0.14; }),
            "the pin, 140 mm, is larger than its hole, 131 mm");
  EXPECT_NE(fault([](auto& g) { g.cheek_radius = 0.31; }).find("beyond the main plate"),
            std::string::npos);
  EXPECT_NE(fault([](auto& g) { g.cheek_radius = 0.05; }).find("within the hole"),
            std::string::npos);
  EXPECT_NE(fault([](auto& g) { g.cheek_thickness = 0; }).find("both"), std::string::npos);
  EXPECT_NE(fault([](auto& g) { g.height = 0.06; }).find("base"), std::string::npos);
  EXPECT_THROW(make_padeye_mesh(padeye_with_cheeks(), 8), ModelError);
}

// The nodal forces sum up to the pin's force, without a moment about the middle of the hole, in any
// direction; the largest pressure of an even hole is 4 F / (pi d t).
TEST(BearingLoad, AddsUpToTheForceAndHasNoMoment) {
  PartModel part = bare_part(padeye_with_cheeks(), 20);
  for (const double angle : {0.0, 0.3, 1.7, 2.9, -1.234}) {
    const Vector3 force(2e6 * std::cos(angle), 2e6 * std::sin(angle), 1.1e5);
    part.surface_loads = {pin_force(force)};
    const Wrench found = resultant(part.mesh.nodes, part_load(part));
    EXPECT_LT((found.force - force).norm(), 1e-12 * force.norm());
    EXPECT_LT(found.moment.norm(), 1e-12 * force.norm());  // m
  }
}

TEST(BearingLoad, RefusesFacesThatCannotBearTheForce) {
  PartModel part = bare_part(padeye_with_cheeks(), 16);
  SurfaceLoad load = pin_force({0, -1e6, 0});
  load.group = "base";  // flat, below the axis: it bears nothing upwards or sideways
  load.vector = {0, 1e6, 0};
  part.surface_loads = {load};
  EXPECT_THROW(part_load(part), ModelError);
  part.surface_loads[0].group = "main";
  EXPECT_THROW(part_load(part), ModelError);
}

TEST(PadeyeModel, CarriesTheForceToItsBase) {
  const PadeyeModel padeye(padeye_with_cheeks(), high_tensile_steel, 20);
  PadeyeLoad load;
  load.force = {3e5, 1.9e6, -1e5};
  load.gravity_less_acceleration = {0, -9.81, 0};
  const PadeyeResult result = padeye.solve(load);
  EXPECT_LT(result.force_residual, 1e-10);
  EXPECT_LT(result.moment_residual, 1e-10);
  const double weight = 9.81 * find_part_mass(padeye.part()).mass;
  EXPECT_NEAR(result.reaction.force.y(), -1.9e6 + weight, 1e-2);
  EXPECT_NEAR(result.reaction.force.x(), -3e5, 1e-2);
  EXPECT_GT(result.main_plate.peak_von_mises.value, result.main_plate.checked_von_mises.value);
  EXPECT_GT(result.cheeks.checked_von_mises.value, 0);
}

// A base that moves as a rigid body leaves the padeye without stress; what it does besides adds up.
TEST(PadeyeModel, FollowsItsBase) {
  const PadeyeModel padeye(padeye_with_cheeks(), high_tensile_steel, 16);
  const auto base_of = [&](const auto& displacement) {
    Eigen::VectorXd u(3 * static_cast<Eigen::Index>(padeye.base_nodes().size()));
    for (std::size_t i = 0; i < padeye.base_nodes().size(); ++i)
      u.segment<3>(3 * static_cast<Eigen::Index>(i)) =
          displacement(Vector3(padeye.part().mesh.nodes.col(padeye.base_nodes()[i])));
    return u;
  };
  PadeyeLoad moved;
  moved.base_displacement = base_of([](const Vector3& p) -> Vector3 {
    return Vector3(1e-2, -2e-3, 3e-3) + Vector3(1e-3, 2e-3, -1e-3).cross(p);
  });
  EXPECT_LT(padeye.solve(moved).main_plate.peak_von_mises.value, 1e2);  // Pa, of E 206e9
  PadeyeLoad stretched, pulled, both;
  stretched.base_displacement =
      base_of([](const Vector3& p) -> Vector3 { return 1e-4 * p.x() * Vector3::UnitX(); });
  pulled.force = {0, 1e6, 0};
  both = stretched;
  both.force = pulled.force;
  const Eigen::VectorXd sum =
      padeye.solve(stretched).displacement + padeye.solve(pulled).displacement;
  EXPECT_LT((padeye.solve(both).displacement - sum).norm(), 1e-10 * sum.norm());
}

// Far from the hole, the shank of a strip has the stress F / (D t) of a bar. What hole and clamped
// base disturb dies away along the strip as exp(-2.1 y / c), c half its width (Fadle 1941): of a
// disturbance of the size of the stress 0.5 % is left two and a half half-widths from the hole's
// edge, 1.5 % two from the base.
TEST(PadeyeModel, ShankOfAStripIsABar) {
  PadeyeGeometry g = strip();
  g.height = 1.5;
  const PadeyeModel padeye(g, high_tensile_steel, 24);
  PadeyeLoad load;
  load.force = {0, 1e5, 0};
  const PadeyeResult result = padeye.solve(load);
  const double bar = 1e5 / (2 * g.radius * g.thickness);
  int seen = 0;
  for (std::size_t c = 0; c < padeye.columns().size(); ++c) {
    const auto& corners = padeye.columns()[c].corners;
    const bool far = std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector2d& p) {
      return p.y() < -g.hole_diameter / 2 - 2.5 * g.radius && p.y() > -g.height + 2 * g.radius;
    });
    if (!far) continue;
    ++seen;
    EXPECT_NEAR(result.column_von_mises[c], bar, 0.03 * bar);
  }
  EXPECT_GT(seen, 4);
}

// Pilkey (2005), Formulas for Stress, Strain, and Structural Matrices, has K = 2.51 on the net
// section of a strip of D = 2 d with a closely fitting pin whose middle lies D or more from the
// end. Here the end is round and lies at D / 2: it bends over the pin, and the hole's edge sees
// more.
TEST(PadeyeModel, RoundEndConcentratesMoreThanALongOne) {
  const PadeyeGeometry g = strip();
  double last = 0;
  for (const int divisions : {24, 48}) {
    const PadeyeModel padeye(g, high_tensile_steel, divisions);
    PadeyeLoad load;
    load.force = {0, 1e5, 0};
    const PadeyeResult result = padeye.solve(load);
    const PartStress stress = recover_part_stress(padeye.part(), result.displacement);
    double hoop = 0;  // at the hole, on its horizontal diameter
    for (std::size_t p = 0; p < stress.node.size(); ++p) {
      const Vector3 place = padeye.part().mesh.nodes.col(stress.node[p]);
      if (std::abs(place.head<2>().norm() - g.hole_diameter / 2) > 1e-9) continue;
      hoop = std::max(hoop, stress.averaged(1, static_cast<Eigen::Index>(p)));
    }
    const double net = 1e5 / ((2 * g.radius - g.hole_diameter) * g.thickness);
    EXPECT_GT(hoop / net, 2.51);
    EXPECT_LT(hoop / net, 1.5 * 2.51);
    if (divisions == 48) {
      EXPECT_NEAR(hoop / last, 1, 0.03);
    }
    last = hoop;
  }
}

}  // namespace
}  // namespace blocklift::structure
