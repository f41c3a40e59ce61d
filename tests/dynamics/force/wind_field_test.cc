#include "dynamics/force/wind_field.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/force/wind.h"
#include "dynamics/force/wind_load.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using test::expect_balanced;
using test::OneBody;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// ISO 19901-1: at U10 = 20 m/s, C = 0.0573 sqrt(4) = 0.1146.
TEST(WindField, ProfilesOverTheHeight) {
  WindField::Definition d = {.speed = 20, .heading = 0.5, .profile = WindProfile::npd};
  EXPECT_NEAR(WindField(d).calc_mean_speed(80), 20 * (1 + 0.1146 * std::log(8.0)), 1e-10);
  EXPECT_NEAR(WindField(d).calc_mean_speed(10), 20, 1e-12);
  d.profile = WindProfile::power;
  EXPECT_NEAR(WindField(d).calc_mean_speed(80), 20 * std::pow(8, 0.12), 1e-12);
  d.profile = WindProfile::uniform;
  const Vector3 u = WindField(d).calc_velocity(3, 77);
  EXPECT_LT((u - 20 * Vector3(std::cos(0.5), std::sin(0.5), 0)).norm(), 1e-12);
}

// The formulas by hand at U10 = 20 m/s, z = 10 m, f = 0.01 Hz.
TEST(WindField, GustSpectraByHand) {
  const double scaled = 1.72 * std::pow(2, -0.75);
  EXPECT_NEAR(calc_gust_density(GustSpectrum::npd, 0.01, 20, 10),
              1280 / std::pow(1 + std::pow(scaled, 0.468), 5 / 1.404), 1e-9);
  const double sigma = 0.15 * std::pow(0.5, -0.125) * 20, x = 0.01 * 10 / (0.025 * 20);
  EXPECT_NEAR(calc_gust_density(GustSpectrum::api, 0.01, 20, 10),
              sigma * sigma * x / 0.01 / std::pow(1 + 1.5 * x, 5.0 / 3), 1e-9);
  EXPECT_NEAR(calc_gust_density(GustSpectrum::davenport, 0.01, 20, 10, 0.003),
              4 * 0.003 * 400 * 0.36 / 0.01 / std::pow(1.36, 4.0 / 3), 1e-9);
  // Davenport's variance over all frequencies is 6 kappa U10^2 (int x/(1+x^2)^(4/3) dx = 3/2);
  // API's is sigma^2 (int 1/(1 + 1.5 x)^(5/3) dx = 1).
  WindField::Definition d = {.speed = 20, .heading = 0, .gusts = GustSpectrum::davenport};
  d.lowest_frequency = 1e-6, d.highest_frequency = 1e5, d.components = 400;
  EXPECT_NEAR(WindField(d).gust_deviation(), std::sqrt(6 * 0.003) * 20, 1e-3);
  d.gusts = GustSpectrum::api, d.lowest_frequency = 1e-9;
  EXPECT_NEAR(WindField(d).gust_deviation(), sigma, 2e-3 * sigma);
}

// An hour of gusts measures the deviation that was realised (the lowest components turn only a few
// times in it); the mean wind has none.
TEST(WindField, GustsAreReproducibleAndMeasureTheirDeviation) {
  WindField::Definition d = {.speed = 15, .heading = 0, .gusts = GustSpectrum::npd, .seed = 4};
  const WindField wind(d), same(d);
  double sum = 0, square = 0;
  constexpr int samples = 24000;
  for (int i = 0; i < samples; ++i) {
    const double gust = wind.calc_gust(i);
    sum += gust, square += gust * gust;
  }
  EXPECT_NEAR(sum / samples, 0, 0.05 * wind.gust_deviation());
  EXPECT_NEAR(std::sqrt(square / samples), wind.gust_deviation(), 0.05 * wind.gust_deviation());
  EXPECT_EQ(wind.calc_gust(17.3), same.calc_gust(17.3));
  EXPECT_EQ(wind.mean().calc_gust(17.3), 0);
}

// The formulas by hand. The operating gust turns at cos(pi x)^2 = 11/20, where sin(3 pi x) is
// 1.2 sqrt(0.45) and 1 - cos(2 pi x) 0.9, and in the middle, where they are -1 and 2.
TEST(WindGust, ShapesByHand) {
  using Shape = WindGust::Shape;
  const WindGust cosine(Shape::one_minus_cosine, 6, 20, 8);
  EXPECT_EQ(cosine.evaluate(19), 0);
  EXPECT_NEAR(cosine.evaluate(20 + 8.0 / 6), 6 * 0.25, 1e-12);
  EXPECT_NEAR(cosine.evaluate(24), 6, 1e-12);
  EXPECT_NEAR(cosine.evaluate(26), 3, 1e-12);
  EXPECT_EQ(cosine.evaluate(28.5), 0);
  const WindGust rise(Shape::coherent_rise, 15, 0, 10);
  EXPECT_NEAR(rise.evaluate(10.0 / 3), 15 * 0.25, 1e-12);
  EXPECT_EQ(rise.evaluate(100), 15);
  const WindGust operating(Shape::operating, 10, 5, 10.5);
  EXPECT_NEAR(operating.highest(), 7.4, 1e-12);
  EXPECT_NEAR(operating.evaluate(5 + 5.25), 7.4, 1e-12);
  EXPECT_NEAR(operating.lowest(), -3.7 * 1.2 * std::sqrt(0.45) * 0.9, 1e-12);
  for (double time = 0; time < 20; time += 0.01) {
    EXPECT_GE(operating.evaluate(time), operating.lowest() - 1e-12);
    EXPECT_LE(operating.evaluate(time), operating.highest() + 1e-12);
  }
}

TEST(WindGust, TableIsStraightBetweenItsPoints) {
  const WindGust gust({10, 11, 30}, {0, 6, 2});
  EXPECT_EQ(gust.evaluate(0), 0);
  EXPECT_NEAR(gust.evaluate(10.5), 3, 1e-12);
  EXPECT_NEAR(gust.evaluate(20.5), 4, 1e-12);
  EXPECT_EQ(gust.evaluate(31), 2);
  EXPECT_EQ(gust.highest(), 6);
  EXPECT_THAT(
      [] {
        WindGust({1, 1}, {0, 1});
      },
      ThrowsMessage<ModelError>(HasSubstr("must ascend")));
  EXPECT_THAT([] { WindGust({1}, {1}); }, ThrowsMessage<ModelError>(HasSubstr("two points")));
  EXPECT_THAT([] { WindGust(WindGust::Shape::operating, 5, 1, 0); },
              ThrowsMessage<ModelError>(HasSubstr("the duration 0")));
}

// It adds to the mean at every height, and the wind at rest has none of it.
TEST(WindField, TakesASingleGust) {
  WindField::Definition d = {.speed = 8, .heading = 0, .profile = WindProfile::power};
  d.gust.emplace(WindGust::Shape::one_minus_cosine, 6, 20, 8);
  const WindField wind(d);
  EXPECT_NEAR(wind.calc_velocity(24, 40).x(), 8 * std::pow(4, 0.12) + 6, 1e-12);
  EXPECT_NEAR(wind.calc_velocity(10, 40).x(), wind.mean().calc_velocity(24, 40).x(), 1e-12);
}

TEST(WindField, RefusesWhatCannotBe) {
  EXPECT_THAT([] { WindField({.speed = -1, .heading = 0}); },
              ThrowsMessage<ModelError>(HasSubstr("the wind has the speed -1")));
  EXPECT_THAT(
      [] {
        WindField({.speed = 1, .heading = 0, .gusts = GustSpectrum::npd, .lowest_frequency = 1});
      },
      ThrowsMessage<ModelError>(HasSubstr("must ascend")));
}

// The area takes the wind at its own height.
TEST(WindArea, FollowsTheField) {
  OneBody body;
  body.q.head<3>() << 0, 0, 80;
  body.update();
  const auto wind = std::make_shared<const WindField>(
      WindField::Definition{.speed = 20, .heading = 0, .profile = WindProfile::npd});
  const WindArea area(wind, {.name = "a",
                             .centre_of_pressure = {1, Vector3::Zero()},
                             .area = 10,
                             .coefficient = 1.2,
                             .normal_B = {}});
  const double u = wind->calc_mean_speed(80);
  EXPECT_NEAR(area.calc_force(body.state()).x(), 0.5 * 1.25 * 1.2 * 10 * u * u, 1e-9);
}

// Coefficients 45 degrees apart: halfway between headings, mirrored on the other side, about a
// point off the origin.
TEST(WindLoad, FollowsItsCoefficients) {
  OneBody body;
  constexpr double pi = std::numbers::pi;
  WindLoad::Definition d = {
      .name = "ship",
      .reference = {1, {0, 0, 5}},
      .frontal_area = 100,
      .lateral_area = 400,
      .height = 10,
      .length = 80,
      .table = {{0, 0.8, 0, 0, 0, 0}, {pi / 2, 0, 0.9, -0.5, 0, 0.1}, {pi, -0.7, 0, 0, 0, 0}},
      .wind = nullptr};
  const auto force = [&](double heading) {
    d.wind =
        std::make_shared<const WindField>(WindField::Definition{.speed = 10, .heading = heading});
    return WindLoad(d).calc_force(body.state());
  };
  const double q = 0.5 * 1.25 * 100;
  const ForceVector side = force(pi / 2);
  EXPECT_NEAR(side.force.y(), q * 400 * 0.9, 1e-9);
  EXPECT_NEAR(side.moment.x(), -q * 400 * 10 * 0.5, 1e-9);
  EXPECT_NEAR(side.moment.z(), q * 400 * 80 * 0.1, 1e-9);
  EXPECT_NEAR(force(-pi / 2).force.y(), -q * 400 * 0.9, 1e-9);
  EXPECT_NEAR(force(pi / 4).force.x(), q * 100 * 0.4, 1e-9);
  EXPECT_NEAR(force(pi).force.x(), -q * 100 * 0.7, 1e-9);
  body.v.setRandom();
  body.update();
  expect_balanced(body, WindLoad(d));
  d.table.pop_back();
  d.table.pop_back();
  EXPECT_THAT([&] { WindLoad w(d); }, ThrowsMessage<ModelError>(HasSubstr("for 1 headings")));
}

}  // namespace
}  // namespace blocklift::dynamics
