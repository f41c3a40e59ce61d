// Cross-sections against closed forms and published lists.

#include "structure/mesh/beams/sections.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"

namespace blocklift::structure {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Sections, FlatBar) {
  const Profile bar = flat_bar(0.2, 0.01);
  EXPECT_DOUBLE_EQ(bar.section.area, 0.002);
  EXPECT_DOUBLE_EQ(bar.centroid[0], 0.1);
  EXPECT_NEAR(bar.section.second_moment_3, 0.01 * std::pow(0.2, 3) / 12, 1e-15);
  EXPECT_NEAR(bar.section.second_moment_2, 0.2 * std::pow(0.01, 3) / 12, 1e-18);
  // Timoshenko and Goodier (1970), table of section 109: beta = 0.333 - 0.21 b / a for slender
  // bars.
  EXPECT_NEAR(bar.section.torsion, 0.2 * 1e-6 * (1.0 / 3 - 0.21 * 0.05), 1e-12);
  EXPECT_DOUBLE_EQ(bar.section.shear_area_2, 0.002 * 5 / 6);
}

// Timoshenko and Goodier (1970), section 109: J = 0.1406 a^4 of the square, 0.229 a b^3 for a = 2
// b.
TEST(Sections, TorsionOfRectangles) {
  EXPECT_NEAR(solid_rectangle(1, 1).section.torsion, 0.1406, 0.0004);
  EXPECT_NEAR(solid_rectangle(2, 1).section.torsion, 2 * 0.229, 0.001);
  EXPECT_NEAR(solid_rectangle(1, 2).section.torsion, 2 * 0.229, 0.001);
}

TEST(Sections, CircleAndPipe) {
  const Profile circle = solid_circle(0.1);
  EXPECT_NEAR(circle.section.area, pi * 0.01, 1e-15);
  EXPECT_NEAR(circle.section.second_moment_2, pi / 4 * 1e-4, 1e-15);
  EXPECT_NEAR(circle.section.torsion, pi / 2 * 1e-4, 1e-15);
  // Cowper (1966): 6 (1 + nu) / (7 + 6 nu).
  EXPECT_NEAR(circle.section.shear_area_2 / circle.section.area, 7.8 / 8.8, 1e-12);
  const Profile thin = pipe(0.1, 0.099);
  EXPECT_NEAR(thin.section.area, pi * (0.01 - 0.099 * 0.099), 1e-15);
  // Cowper (1966), thin tube: 2 (1 + nu) / (4 + 3 nu).
  EXPECT_NEAR(thin.section.shear_area_2 / thin.section.area, 2.6 / 4.9, 1e-4);
}

TEST(Sections, TeeByItsRectangles) {
  const double h = 0.4, tw = 0.01, b = 0.15, tf = 0.02;
  const Profile tee = tee_bar(h, tw, b, tf);
  const double web = (h - tf) * tw, flange = b * tf, a = web + flange;
  const double centre = (web * (h - tf) / 2 + flange * (h - tf / 2)) / a;
  EXPECT_NEAR(tee.section.area, a, 1e-15);
  EXPECT_NEAR(tee.centroid[0], centre, 1e-14);
  EXPECT_NEAR(tee.centroid[1], 0, 1e-14);
  const double i3 = tw * std::pow(h - tf, 3) / 12 + web * std::pow((h - tf) / 2 - centre, 2) +
                    b * std::pow(tf, 3) / 12 + flange * std::pow(h - tf / 2 - centre, 2);
  EXPECT_NEAR(tee.section.second_moment_3, i3, 1e-12 * i3);
  EXPECT_NEAR(tee.section.second_moment_2,
              tf * std::pow(b, 3) / 12 + (h - tf) * std::pow(tw, 3) / 12, 1e-15);
  EXPECT_NEAR(tee.section.product_23, 0, 1e-15);
  // The flange's middle bears all shear across: the shear centre lies there.
  EXPECT_NEAR(tee.section.shear_centre[0], h - tf / 2 - centre, 1e-12);
  EXPECT_NEAR(tee.section.shear_area_3, 5.0 / 6 * flange, 1e-12);
  EXPECT_NEAR(tee.section.torsion, ((h - tf / 2) * std::pow(tw, 3) + b * std::pow(tf, 3)) / 3,
              1e-15);
}

TEST(Sections, AngleHasAProductOfInertia) {
  const double h = 0.2, t = 0.01, b = 0.1;
  const Profile angle = angle_bar(h, t, b, t);
  const double web = (h - t) * t, flange = b * t, a = web + flange;
  const Eigen::Vector2d of_web((h - t) / 2, 0), of_flange(h - t / 2, (b - t) / 2);
  const Eigen::Vector2d centre = (web * of_web + flange * of_flange) / a;
  EXPECT_NEAR((angle.centroid - centre).norm(), 0, 1e-14);
  const double product = web * (of_web - centre).prod() + flange * (of_flange - centre).prod();
  EXPECT_NEAR(angle.section.product_23, product, 1e-12 * std::abs(product));
  // Thin walls that meet in a point bear shear without a moment about it.
  EXPECT_NEAR((angle.section.shear_centre + centre - Eigen::Vector2d(h - t / 2, 0)).norm(), 0,
              1e-12);
}

// Timoshenko (1945): e = b^2 h^2 t / (4 I) from the web's middle, of a channel of one thickness.
TEST(Sections, ShearCentreOfAChannel) {
  const double h = 0.3, b = 0.1, t = 0.002;
  const Profile bar = channel(h, t, b, t);
  const double height = h - t, width = b - t / 2;
  const double i = t * std::pow(height, 3) / 12 + 2 * width * t * std::pow(height / 2, 2);
  const double e = width * width * height * height * t / (4 * i);
  const double from_web = bar.section.shear_centre[1] + bar.centroid[1] - (t / 2 - b / 2);
  EXPECT_NEAR(from_web, -e, 1e-9 * e);
  EXPECT_NEAR(bar.section.shear_centre[0], 0, 1e-12);
}

// Shear area of an I's web by thin walls: I^2 / int (Q^2 / t) ds by hand over web and flanges.
TEST(Sections, ShearAreaOfAnI) {
  const double h = 0.4, tw = 0.01, b = 0.2, tf = 0.015;
  const Profile beam = i_beam(h, tw, b, tf, b, tf);
  const double d = h - tf, i = tw * d * d * d / 12 + 2 * b * tf * d * d / 4;
  // Flanges: q = tf d / 2 s / I, s to b / 2, four of them; web: q = (b tf d / 2 + tw (d^2/4 - z^2)
  // / 2) / I.
  const double flanges = 4 * std::pow(tf * d / 2, 2) * std::pow(b / 2, 3) / 3 / tf;
  const double c = b * tf * d / 2 + tw * d * d / 8, k = tw / 2;
  const double web =
      (c * c * d - 2 * c * k * std::pow(d, 3) / 12 + k * k * std::pow(d, 5) / 80) / tw;
  EXPECT_NEAR(beam.section.shear_area_2, i * i / (flanges + web), 1e-10);
  EXPECT_NEAR(beam.section.shear_centre.norm(), 0, 1e-12);
}

// Bredt: J = 4 A^2 / sum (l / t); the shear area of a square thin tube is 5/12 of its area: the
// walls along the force bear it as 5/6 of a rectangle would but for the flow in from the others.
TEST(Sections, Box) {
  const Profile tube = box(0.101, 0.101, 0.001);
  EXPECT_NEAR(tube.section.torsion, 4 * std::pow(0.01, 2) / (4 * 0.1 / 0.001), 1e-12);
  EXPECT_NEAR(tube.section.area, 0.101 * 0.101 - 0.099 * 0.099, 1e-15);
  EXPECT_NEAR(tube.section.second_moment_2, (std::pow(0.101, 4) - std::pow(0.099, 4)) / 12, 1e-15);
  // By symmetry the flow vanishes in the middle of the walls across: half the tube is a channel of
  // half width, I = 2 t a^3 / 3, q = a s / (2 I) t there and rises by t (a^2/4 - z^2) / (2 I).
  const double a = 0.1, t = 0.001, i = 2.0 / 3 * t * a * a * a;
  const double across = 4 * std::pow(t * a / 2, 2) * std::pow(a / 2, 3) / 3 / t;
  const double c = t * a * a / 4 + t * a * a / 8, k = t / 2;
  const double along =
      2 * (c * c * a - 2 * c * k * std::pow(a, 3) / 12 + k * k * std::pow(a, 5) / 80) / t;
  EXPECT_NEAR(tube.section.shear_area_2, i * i / (across + along), 1e-12);
  EXPECT_NEAR(tube.section.shear_area_3, tube.section.shear_area_2, 1e-12);
  EXPECT_NEAR(tube.section.shear_centre.norm(), 0, 1e-12);
}

// Areas of EN 10067 as makers publish them, cm^2, to their last digit.
TEST(Sections, BulbFlatsHaveTheirPublishedAreas) {
  struct Listed {
    double height, thickness, area;
  };
  constexpr std::array<Listed, 10> listed{{{120, 6, 9.31},
                                           {140, 8, 13.8},
                                           {160, 9, 17.8},
                                           {180, 10, 22.5},
                                           {200, 10, 25.6},
                                           {240, 11, 34.9},
                                           {280, 11, 42.6},
                                           {320, 12, 54.2},
                                           {370, 14, 73.3},
                                           {430, 17, 103.0}}};
  for (const Listed& bulb : listed) {
    const Profile profile = bulb_flat(bulb.height / 1000, bulb.thickness / 1000);
    EXPECT_NEAR(profile.section.area * 1e4, bulb.area, 0.006 * bulb.area)
        << bulb.height << " x " << bulb.thickness;
  }
}

// The outline's moments by counting small squares within it.
TEST(Sections, BulbFlatByCounting) {
  const double h = 0.2, t = 0.01, c = 0.028, r = 0.008, slope = 1 / std::sqrt(3.0);
  const auto inside = [&](double x, double y) {  // from the web's face beside the bulb
    if (y <= 0) return true;
    if (y > c || x < h - r * (1 + slope) - (c - y) * slope) return false;
    const double dx = x - (h - r), dy = y - (c - r);
    const bool rounds = dy > 0 && (dx > 0 || dx > -std::tan(pi / 3) * dy);
    return !rounds || dx * dx + dy * dy <= r * r;
  };
  double area = 0, first_2 = 0, first_3 = 0, second = 0;
  const double step = 5e-5;
  for (double x = step / 2; x < h; x += step)
    for (double y = -t + step / 2; y < c; y += step)
      if (inside(x, y)) {
        area += step * step;
        first_2 += x * step * step;
        first_3 += (y + t / 2) * step * step;
        second += x * x * step * step;
      }
  const Profile profile = bulb_flat(h, t);
  EXPECT_NEAR(profile.section.area, area, 1e-3 * area);
  EXPECT_NEAR(profile.centroid[0], first_2 / area, 1e-3 * h);
  EXPECT_NEAR(profile.centroid[1], first_3 / area, 1e-4);
  const double i = second - first_2 * first_2 / area;
  EXPECT_NEAR(profile.section.second_moment_3, i, 2e-3 * i);
}

TEST(Sections, SeenFromElsewhere) {
  const Profile angle = angle_bar(0.2, 0.01, 0.1, 0.012);
  const Profile turned = seen(angle, true, false, true);
  EXPECT_DOUBLE_EQ(turned.section.second_moment_2, angle.section.second_moment_3);
  EXPECT_DOUBLE_EQ(turned.section.product_23, -angle.section.product_23);
  EXPECT_DOUBLE_EQ(turned.centroid[0], angle.centroid[1]);
  EXPECT_DOUBLE_EQ(turned.centroid[1], -angle.centroid[0]);
  EXPECT_DOUBLE_EQ(turned.section.shear_centre[0], angle.section.shear_centre[1]);
  EXPECT_DOUBLE_EQ(turned.section.shear_centre[1], -angle.section.shear_centre[0]);
}

TEST(Sections, RefuseWhatCannotBe) {
  EXPECT_THROW(flat_bar(0, 0.01), ModelError);
  EXPECT_THROW(pipe(0.1, 0.1), ModelError);
  EXPECT_THROW(box(0.1, 0.1, 0.05), ModelError);
  EXPECT_THROW(tee_bar(0.1, 0.01, 0.1, std::nan("")), ModelError);
  try {
    bulb_flat(0.25, 0.01);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("250 mm high; EN 10067 has 120, 140"));
  }
}

}  // namespace
}  // namespace blocklift::structure
