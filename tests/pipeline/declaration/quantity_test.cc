#include "pipeline/declaration/quantity.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace blocklift::pipeline {
namespace {

std::string message_of(const std::string& text, const std::vector<Dimension>& allowed) {
  try {
    parse_quantity(text, allowed);
  } catch (const QuantityError& error) {
    return error.what();
  }
  return "no error";
}

TEST(QuantityTest, ConvertsUnitsOfTheYardToSi) {
  EXPECT_DOUBLE_EQ(parse_quantity("860 t", Dimension::mass), 860000);
  EXPECT_DOUBLE_EQ(parse_quantity("12 m", Dimension::length), 12);
  EXPECT_DOUBLE_EQ(parse_quantity("18 mm", Dimension::length), 0.018);
  EXPECT_DOUBLE_EQ(parse_quantity("3 m/min", Dimension::speed), 0.05);
  EXPECT_DOUBLE_EQ(parse_quantity("45 deg", Dimension::angle), std::atan(1));
  EXPECT_DOUBLE_EQ(parse_quantity("45°", Dimension::angle), std::atan(1));
  // As copied from a report: a narrow no-break, a no-break and a thin space, a minus of its own.
  EXPECT_DOUBLE_EQ(parse_quantity("30\u202fMN", Dimension::force), 30e6);
  EXPECT_DOUBLE_EQ(parse_quantity("8\u00a0m/s", Dimension::speed), 8);
  EXPECT_DOUBLE_EQ(parse_quantity("\u22120.6\u2009m", Dimension::length), -0.6);
  EXPECT_DOUBLE_EQ(parse_number("\u22122"), -2);
  EXPECT_DOUBLE_EQ(parse_quantity("0.628 rad/s", Dimension::angular_speed), 0.628);
  EXPECT_DOUBLE_EQ(parse_quantity("1 rpm", Dimension::angular_speed), 8 * std::atan(1) / 60);
  EXPECT_DOUBLE_EQ(parse_quantity("355 MPa", Dimension::stress), 355e6);
  EXPECT_DOUBLE_EQ(parse_quantity("206 GPa", Dimension::stress), 206e9);
  EXPECT_DOUBLE_EQ(parse_quantity("250 kN", Dimension::force), 250e3);
  EXPECT_DOUBLE_EQ(parse_quantity("60 MN/m", Dimension::stiffness), 60e6);
  EXPECT_DOUBLE_EQ(parse_quantity("450 t m^2", Dimension::moment_of_inertia), 450e3);
  EXPECT_DOUBLE_EQ(parse_quantity("7850 kg/m^3", Dimension::density), 7850);
  EXPECT_DOUBLE_EQ(parse_quantity("7.85 t/m3", Dimension::density), 7850);
  EXPECT_DOUBLE_EQ(parse_quantity("5 ms", Dimension::time), 0.005);
  EXPECT_DOUBLE_EQ(parse_quantity("2 h", Dimension::time), 7200);
  EXPECT_DOUBLE_EQ(parse_quantity("10 knot", Dimension::speed), 10 * 1852.0 / 3600);
  EXPECT_DOUBLE_EQ(parse_quantity("3 kNm", Dimension::moment), 3000);
  EXPECT_DOUBLE_EQ(parse_quantity("22.75 %", Dimension::ratio), 0.2275);
  EXPECT_DOUBLE_EQ(parse_quantity("5 MN m/rad", Dimension::rotational_stiffness), 5e6);
}

TEST(QuantityTest, TakesAMassForItsWeightOnlyWhereALoadIsDue) {
  EXPECT_DOUBLE_EQ(parse_quantity("140 t", Dimension::load), 140e3 * 9.80665);
  EXPECT_DOUBLE_EQ(parse_quantity("140 tf", Dimension::load), 140e3 * 9.80665);
  EXPECT_DOUBLE_EQ(parse_quantity("250 kN", Dimension::load), 250e3);
  EXPECT_EQ(message_of("140 t", {Dimension::force}),
            "\"140 t\" is a mass; a force is due, for example \"250 kN\"");
}

TEST(QuantityTest, TellsWhichOfSeveralDimensionsItFound) {
  const std::vector<Dimension> travel = {Dimension::length, Dimension::angle};
  EXPECT_EQ(parse_quantity("16 m", travel).dimension, Dimension::length);
  EXPECT_EQ(parse_quantity("90 deg", travel).dimension, Dimension::angle);
  EXPECT_EQ(message_of("3 s", travel),
            "\"3 s\" is a time; a length or an angle is due, for example \"12 m\" or \"45 deg\"");
}

TEST(QuantityTest, SaysWhatIsWrong) {
  const std::vector<Dimension> speed = {Dimension::speed};
  EXPECT_EQ(message_of("3 m", speed),
            "\"3 m\" is a length; a speed is due, for example \"3 m/min\"");
  EXPECT_EQ(message_of("3", speed), "\"3\" has no unit; a speed is due, for example \"3 m/min\"");
  EXPECT_EQ(message_of("fast", speed),
            "\"fast\" is no number; a speed is due, for example \"3 m/min\"");
  EXPECT_EQ(message_of("3 furlong/fortnightt", speed),
            "\"3 furlong/fortnightt\" has the unknown unit \"furlong/fortnightt\"; a speed is due, "
            "for example \"3 m/min\"");
  EXPECT_EQ(message_of("860 ton", {Dimension::mass}),
            "\"860 ton\" is ambiguous: there are tons of 907, 1000 and 1016 kg; write \"t\" for "
            "1000 kg; a mass is due, for example \"860 t\"");
  EXPECT_EQ(message_of("1,5 m", {Dimension::length}),
            "\"1,5 m\" has a comma; decimals take a point (1.5) and thousands nothing (1000); a "
            "length is due, for example \"12 m\"");
  EXPECT_EQ(message_of(".nan m", {Dimension::length}),
            "\".nan m\" is no number; a length is due, for example \"12 m\"");
  EXPECT_EQ(message_of("nan m", {Dimension::length}),
            "\"nan m\" is not a finite number; a length is due, for example \"12 m\"");
  EXPECT_EQ(message_of("-inf m", {Dimension::length}),
            "\"-inf m\" is not a finite number; a length is due, for example \"12 m\"");
  EXPECT_EQ(
      message_of("1e999 m", {Dimension::length}),
      "\"1e999 m\" is too large or too small a number; a length is due, for example \"12 m\"");
  EXPECT_EQ(message_of("12 3 m", {Dimension::length}),
            "\"12 3 m\" is no quantity; a length is due, for example \"12 m\"");
  EXPECT_EQ(message_of("20 degC", {Dimension::angle}),
            "\"20 degC\" has the unknown unit \"degC\"; an angle is due, for example \"45 deg\"");
}

// UDUNITS itself would take a frequency for a time and a number for an angle.
TEST(QuantityTest, KeepsReciprocalsAndAnglesApart) {
  EXPECT_EQ(message_of("5 Hz", {Dimension::time}),
            "\"5 Hz\" is a frequency; a time is due, for example \"10 s\"");
  EXPECT_EQ(message_of("5 1/s", {Dimension::angular_speed}),
            "\"5 1/s\" is a frequency; an angular speed is due, for example \"0.5 deg/s\"");
  EXPECT_EQ(message_of("10 %", {Dimension::angle}),
            "\"10 %\" is a plain number; an angle is due, for example \"45 deg\"");
}

TEST(QuantityTest, ReadsPlainNumbersWhole) {
  EXPECT_DOUBLE_EQ(parse_number(" -1.5e3 "), -1500);
  EXPECT_THROW(parse_number("3 m"), QuantityError);
  EXPECT_THROW(parse_number(""), QuantityError);
}

RC_GTEST_PROP(QuantityProperty, TakesEveryFiniteNumberUnchangedInSiUnits, (double value)) {
  RC_PRE(std::isfinite(value) && (value == 0 || std::isnormal(value)));
  char text[64];
  std::snprintf(text, sizeof text, "%.17g m", value);
  RC_ASSERT(parse_quantity(text, Dimension::length) == value);
}

RC_GTEST_PROP(QuantityProperty, ScalesPrefixesByPowersOfTen, ()) {
  const int value = *rc::gen::inRange(-100000, 100000);
  const std::string number = std::to_string(value);
  const double newton = parse_quantity(number + " N", Dimension::force);
  const double meganewton = parse_quantity(number + "MN", Dimension::force);
  RC_ASSERT(std::abs(meganewton - 1e6 * newton) <= 1e-9 * std::abs(meganewton));
}

RC_GTEST_PROP(QuantityProperty, RefusesEveryOtherDimension, ()) {
  const int last = static_cast<int>(Dimension::mass_per_length);
  const auto due = static_cast<Dimension>(*rc::gen::inRange(0, last + 1));
  const auto found = static_cast<Dimension>(*rc::gen::inRange(0, last + 1));
  const auto is_load = [](Dimension d) {
    return d == Dimension::load || d == Dimension::force || d == Dimension::mass;
  };
  RC_PRE(due != found && !(is_load(due) && is_load(found)));
  RC_ASSERT_THROWS_AS(parse_quantity(text_of(found).example, due), QuantityError);
}

TEST(Quantity, IsWrittenInTheUnitsOfInput) {
  EXPECT_EQ(format_quantity(0.01, Dimension::angular_speed), "0.572958 deg/s");
  EXPECT_EQ(format_quantity(860e3, Dimension::mass), "860 t");
  EXPECT_EQ(format_quantity(25, Dimension::mass), "25 kg");
  EXPECT_EQ(format_quantity(9806.65, Dimension::load), "1 t");
  EXPECT_EQ(format_quantity(355e6, Dimension::stress), "355 MPa");
  EXPECT_EQ(format_quantity(0.05, Dimension::speed), "3 m/min");
  EXPECT_EQ(format_quantity(0, Dimension::force), "0 kN");
}

RC_GTEST_PROP(QuantityProperty, ReadsItsOwnExamplesAndOutput, ()) {
  const int last = static_cast<int>(Dimension::mass_per_length);
  const auto dimension = static_cast<Dimension>(*rc::gen::inRange(0, last + 1));
  const double value = parse_quantity(text_of(dimension).example, dimension);
  const double again = parse_quantity(format_quantity(value, dimension), dimension);
  RC_ASSERT(std::abs(again - value) <= 1e-5 * std::abs(value));
}

RC_GTEST_PROP(QuantityProperty, NeverBreaksOnAnyText, (const std::string& text)) {
  try {
    parse_quantity(text, Dimension::length);
  } catch (const QuantityError&) {
  }
}

}  // namespace
}  // namespace blocklift::pipeline
