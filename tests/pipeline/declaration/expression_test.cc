#include "pipeline/declaration/expression.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Parameters sample() {
  Parameters parameters;
  parameters.set("boom", {40.0, {1, 0, 0, 0}});
  parameters.set("mass", {2000.0, {0, 1, 0, 0}});
  parameters.set("tilt", {0.5, {0, 0, 0, 1}});
  parameters.set("share", {0.4, {}});
  parameters.set("a", {3.0, {1, 0, 0, 0}});  // UDUNITS has a unit of this name
  return parameters;
}

double value(const char* text, Dimension due) {
  return evaluate_expression(text, sample(), {due}).value;
}

TEST(Expression, IsWhatStandsBehindAnEqualsSign) {
  EXPECT_TRUE(is_expression("= 3 m"));
  EXPECT_TRUE(is_expression("  =boom"));
  EXPECT_FALSE(is_expression("3 m"));
  EXPECT_FALSE(is_expression(""));
}

TEST(Expression, EvaluatesWithUnits) {
  EXPECT_DOUBLE_EQ(value("= boom / 2 + 30 cm", Dimension::length), 20.3);
  EXPECT_DOUBLE_EQ(value("= 0.4 * mass", Dimension::mass), 800);
  EXPECT_DOUBLE_EQ(value("= share * mass * (boom / 2)^2 / 12", Dimension::moment_of_inertia),
                   0.4 * 2000 * 400 / 12);
  EXPECT_DOUBLE_EQ(value("= boom * sin(tilt)", Dimension::length), 40 * std::sin(0.5));
  EXPECT_DOUBLE_EQ(value("= atan2(3 m, boom) + 90 deg", Dimension::angle),
                   std::atan2(3, 40) + std::acos(0.0));
  EXPECT_DOUBLE_EQ(value("= 3 m/min", Dimension::speed), 0.05);
  EXPECT_DOUBLE_EQ(value("= 20 kN s/m", Dimension::damping), 20e3);
  EXPECT_DOUBLE_EQ(value("= sqrt(boom^2 + (30 m)^2)", Dimension::length), 50);
  EXPECT_DOUBLE_EQ(value("= boom > 30 m ? 2 m : 1 m", Dimension::length), 2);
  EXPECT_DOUBLE_EQ(value("= min(boom, 3 m)", Dimension::length), 3);
  EXPECT_DOUBLE_EQ(value("= -a", Dimension::length), -3);  // the parameter, not the unit
  EXPECT_DOUBLE_EQ(value("= 1e3 * 2.5e-3 m", Dimension::length), 2.5);
  EXPECT_DOUBLE_EQ(value("= mass", Dimension::load), 2000 * 9.80665);
  EXPECT_DOUBLE_EQ(value("= 2 * pi * share", Dimension::ratio), 0.8 * std::acos(-1.0));
}

TEST(Expression, ANumberWithItsUnitIsOneFactor) {
  EXPECT_DOUBLE_EQ(value("= boom / 2 m", Dimension::ratio), 20);
  EXPECT_DOUBLE_EQ(value("= mass / 2 m^2 * 1 m", Dimension::mass_per_length), 1000);
}

TEST(Expression, ZeroHasTheDimensionThatIsDue) {
  EXPECT_EQ(value("= boom - 40 m", Dimension::mass), 0);
  EXPECT_THAT(
      [] {
        evaluate_expression("= 0 * boom", sample(), {Dimension::length, Dimension::angle});
      },
      ThrowsMessage<ExpressionError>(HasSubstr("does not say what it measures")));
}

TEST(Expression, KnowsItsDimension) {
  EXPECT_THAT([] { value("= 2 * mass", Dimension::length); },
              ThrowsMessage<ExpressionError>(
                  "\"= 2 * mass\" is a mass; a length is due, for example \"12 m\""));
  EXPECT_THAT([] { value("= boom * mass", Dimension::length); },
              ThrowsMessage<ExpressionError>(HasSubstr("is of the unit kg m")));
  for (const char* text : {"= boom + mass", "= boom + 3", "= sin(boom)", "= exp(tilt)",
                           "= sqrt(mass)", "= boom > 3 ? 3 m : 2 m"}) {
    EXPECT_THAT([&] { evaluate_expression(text, sample()); },
                ThrowsMessage<ExpressionError>(HasSubstr("has no dimension")))
        << text;
  }
}

std::vector<std::string> hints_of(const char* text) {
  try {
    evaluate_expression(text, sample());
  } catch (const ExpressionError& error) {
    return error.hints();
  }
  return {"no error"};
}

TEST(Expression, SaysWhatIsWrong) {
  const auto complaint = [](const char* text) -> std::string {
    try {
      evaluate_expression(text, sample());
    } catch (const ExpressionError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(complaint("= 2 * bom"),
            "\"= 2 * bom\" uses \"bom\", which is no parameter and no unit");
  EXPECT_THAT(hints_of("= 2 * bom"),
              ElementsAre("the parameters are boom, mass, tilt, share, a; did you mean \"boom\"?"));
  EXPECT_EQ(complaint("= 2 boom"), "\"= 2 boom\" has the parameter \"boom\" right behind a number");
  EXPECT_EQ(complaint("= sine(tilt)"), "\"= sine(tilt)\" calls \"sine\", which is no function");
  EXPECT_EQ(complaint("= (boom"), "\"= (boom\" lacks a closing bracket");
  EXPECT_EQ(complaint("= boom *"), "\"= boom *\" ends where a value is due");
  EXPECT_EQ(complaint("="), "\"=\" ends where a value is due");
  EXPECT_EQ(complaint("= boom mass"), "\"= boom mass\" lacks an operator between two values");
  EXPECT_EQ(complaint("= boom $ 2"),
            "\"= boom $ 2\" has the character \"$\", which no expression has");
  EXPECT_EQ(complaint("= boom / 0"), "\"= boom / 0\" gives no finite number");
  EXPECT_EQ(complaint("= 3 ton"),
            "\"= 3 ton\" is ambiguous: there are tons of 907, 1000 and 1016 kg");
}

TEST(Expression, ParametersHaveNamesOfTheirOwn) {
  for (const char* name : {"boom", "L1", "boom_length", "a"})
    EXPECT_TRUE(is_parameter_name(name)) << name;
  for (const char* name : {"", "1st", "boom-length", "m", "kN", "sin", "pi", "deg"}) {
    EXPECT_FALSE(is_parameter_name(name)) << name;
  }
}

}  // namespace
}  // namespace blocklift::pipeline
