// Stiffeners that turn about their toes: sections by hand, the strength's own equation.
#include "structure/practice/tripping.h"

#include <cmath>

#include <gtest/gtest.h>

#include "structure/mesh/beams/sections.h"
#include "structure/practice/stiffener_chains.h"
#include "tests/structure/practice/sample_steel.h"

namespace blocklift::structure {
namespace {

using test::steel_s355;

constexpr double plate = 0.01;  // thickness, m

/// A profile below a plate, along x.
TrippingSection below_plate(const Profile& profile) {
  Mesh mesh;
  mesh.materials = {steel_s355};
  mesh.beam_sections = {profile.section};
  mesh.vertices = {Vector3::Zero(), Vector3(2, 0, 0)};
  Beam beam;
  beam.vertices = {0, 1};
  beam.axis_2 = -Vector3::UnitZ();
  const Vector3 axis_3 = Vector3::UnitX().cross(beam.axis_2);
  beam.offset.fill((plate / 2 + profile.centroid[0]) * beam.axis_2 + profile.centroid[1] * axis_3);
  mesh.beams = {beam};
  const TrippingSection seen = tripping_section(mesh, beam, Vector3::UnitZ(), 0, 0);
  const TrippingSection other = tripping_section(mesh, beam, -Vector3::UnitZ(), 0, 1);
  EXPECT_NEAR(other.polar_moment, seen.polar_moment, 1e-15);
  EXPECT_NEAR(std::abs(other.shear_height), std::abs(seen.shear_height), 1e-15);
  return seen;
}

// With r from the toe a flat bar has I_po = h^3 t / 3 + h t^3 / 12 and its shear centre at h / 2.
// DNV-RP-C201, equation 7.34, has (1 + 2 (h / l)^2) G (t / h)^2 of a thin flat bar: the torsion
// constant of the real one is 3.8 % smaller.
TEST(Tripping, AFlatBarByHand) {
  const double h = 0.2, t = 0.012, length = 2.4;
  const TrippingSection section = below_plate(flat_bar(h, t));
  EXPECT_NEAR(section.polar_moment, h * h * h * t / 3 + h * t * t * t / 12, 1e-15);
  EXPECT_NEAR(section.second_moment, h * t * t * t / 12, 1e-15);
  EXPECT_NEAR(std::abs(section.shear_height), h / 2, 1e-15);
  EXPECT_NEAR(section.torsion, h * t * t * t / 3 * (1 - 0.63 * t / h), 1e-12);
  const double elastic = tripping_stress(steel_s355, section, length);
  const double expected =
      (1 + 2 * std::pow(h / length, 2)) * steel_s355.shear_modulus() * std::pow(t / h, 2);
  EXPECT_NEAR(elastic, expected, 0.05 * expected);
  EXPECT_LT(elastic, expected);
  // Without the ends' hold the Saint-Venant part alone is left.
  EXPECT_NEAR(tripping_stress(steel_s355, section, 1e6),
              steel_s355.shear_modulus() * section.torsion / section.polar_moment, 1);
}

// Rectangles about the toe: web and flange of a tee and of an angle, whose flange goes from the
// web's outer face to its tip.
TEST(Tripping, TeesAndAnglesByHand) {
  const double height = 0.3, web = 0.011, width = 0.1, flange = 0.016;
  const double stem = height - flange, level = height - flange / 2;
  const double of_stem = web * std::pow(stem, 3) / 3 + stem * std::pow(web, 3) / 12;
  const double at_level = width * flange * (level * level + flange * flange / 12);
  const TrippingSection tee = below_plate(tee_bar(height, web, width, flange));
  EXPECT_NEAR(tee.polar_moment, of_stem + at_level + flange * std::pow(width, 3) / 12, 1e-13);
  EXPECT_NEAR(tee.second_moment, stem * std::pow(web, 3) / 12 + flange * std::pow(width, 3) / 12,
              1e-14);
  // Web and flange meet in the shear centre.
  EXPECT_NEAR(std::abs(tee.shear_height), level, 1e-4);

  const TrippingSection angle = below_plate(angle_bar(height, web, width, flange));
  const double tip = width - web / 2, face = -web / 2;
  const double across = flange * (std::pow(tip, 3) - std::pow(face, 3)) / 3;
  EXPECT_NEAR(angle.polar_moment, of_stem + at_level + across, 1e-13);
  const double middle = width * flange * (tip + face) / 2 / (width * flange + stem * web);
  EXPECT_NEAR(
      angle.second_moment,
      stem * std::pow(web, 3) / 12 + across - (width * flange + stem * web) * middle * middle,
      1e-13);
}

// The strength x f_y is the smaller root of (1 - x) (1 - lambda^2 x) = mu x, Ayrton and Perry's
// equation, and yield up to a slenderness of 0.6.
TEST(Tripping, TheStrengthIsAyrtonsAndPerrys) {
  const double yield = steel_s355.yield_stress;
  EXPECT_EQ(tripping_strength(yield / (0.6 * 0.6 - 1e-12), yield), yield);
  EXPECT_EQ(tripping_strength(10 * yield, yield), yield);
  for (const double slenderness : {0.61, 0.8, 1.0, 1.5, 3.0}) {
    const double square = slenderness * slenderness;
    const double x = tripping_strength(yield / square, yield) / yield;
    EXPECT_NEAR((1 - x) * (1 - square * x), 0.35 * (slenderness - 0.6) * x, 1e-12);
    EXPECT_LT(x, std::min(1.0, 1 / square)) << slenderness;
  }
}

}  // namespace
}  // namespace blocklift::structure
