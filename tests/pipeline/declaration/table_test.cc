#include "pipeline/declaration/table.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/declaration/document.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

struct Wheel {
  Located<std::string> name;
  double radius = std::nan("");
  std::optional<double> width;
};

enum class Colour { red, green };

struct Cart {
  double mass = std::nan("");
  Located<double> speed;
  Colour colour = Colour::red;
  std::array<double, 3> position{};
  std::vector<Wheel> wheels;
  std::vector<double> stations;
  int seats = 0;
  bool covered = false;
};

Format<Cart> cart_format() {
  Table<Wheel> wheel("wheel", "What the cart rolls on.");
  wheel
      .required("radius", &Wheel::radius, quantity(Dimension::length, Range::positive()),
                "of rolling")
      .optional("width", &Wheel::width, quantity(Dimension::length), "of the tread");
  const Format<double> length = quantity(Dimension::length);
  const auto one = converted<double, std::vector<double>>(
      length, [](double value) { return std::vector{value}; });
  Table<Cart> cart("cart", "A cart.");
  cart.required("mass", &Cart::mass, quantity(Dimension::mass, Range::positive()), "laden")
      .by_default("speed", &Cart::speed, quantity(Dimension::speed), "3 m/min", "when pulled")
      .optional("colour", &Cart::colour,
                choice<Colour>({{"red", Colour::red}, {"green", Colour::green}}), "of the paint")
      .optional("position", &Cart::position, array_of<double, 3>(length), "in the yard")
      .optional("wheels", &Cart::wheels, named_tables(wheel.format()), "its wheels")
      .optional("stations", &Cart::stations,
                by_shape<std::vector<double>>(one, list_of(length), {}), "stops")
      .optional("seats", &Cart::seats, integer(Range::between(0, 9)), "for passengers")
      .optional("covered", &Cart::covered, boolean(), "has a roof");
  return cart.format();
}

struct Result {
  Cart cart;
  std::string complaints;
};

Result read_cart(std::string_view text) {
  const test::TemporaryFolder folder;
  folder.write("cart.yaml", text);
  Diagnostics diagnostics;
  Result result;
  if (const auto document = load_document("cart.yaml", diagnostics)) {
    Reading reading(*document, diagnostics);
    cart_format().read(document->root, reading, result.cart);
  }
  result.complaints = diagnostics.to_text();
  return result;
}

TEST(TableTest, ReadsEveryKeyIntoItsMember) {
  const auto [cart, complaints] = read_cart(
      "mass: 2 t\nspeed: 6 m/min\ncolour: green\nposition: [1 m, 2 m, 30 cm]\n"
      "wheels: {left: {radius: 40 cm, width: 5 cm}, right: {radius: 0.5 m}}\n"
      "stations: [1 m, 2 m]\nseats: 4\ncovered: true\n");
  EXPECT_EQ(complaints, "");
  EXPECT_DOUBLE_EQ(cart.mass, 2000);
  EXPECT_DOUBLE_EQ(cart.speed.value, 0.1);
  EXPECT_EQ(cart.speed.mark.line, 2);
  EXPECT_EQ(cart.colour, Colour::green);
  EXPECT_DOUBLE_EQ(cart.position[2], 0.3);
  ASSERT_EQ(cart.wheels.size(), 2U);
  EXPECT_EQ(cart.wheels[0].name.value, "left");
  EXPECT_DOUBLE_EQ(cart.wheels[0].width.value(), 0.05);
  EXPECT_FALSE(cart.wheels[1].width);
  EXPECT_EQ(cart.stations.size(), 2U);
  EXPECT_EQ(cart.seats, 4);
  EXPECT_TRUE(cart.covered);
}

TEST(TableTest, FillsInDeclaredDefaults) {
  const auto [cart, complaints] = read_cart("mass: 2 t\nstations: 3 m\n");
  EXPECT_EQ(complaints, "");
  EXPECT_DOUBLE_EQ(cart.speed.value, 0.05);
  EXPECT_EQ(cart.stations, std::vector<double>{3});
}

TEST(TableTest, SaysWhatADecimalCommaDid) {
  EXPECT_EQ(
      read_cart("mass: 1 t\nwheels: {left: {radius: 3,5 m}}\n").complaints,
      "cart.yaml:2:25: error: radius \"3\" has no unit; a length is due, for example \"12 m\"\n"
      "cart.yaml:2:27: error: wheel left has no key \"5 m\"\n"
      "    decimals take a point (1.5): what stands behind a comma is a key of its own\n"
      "2 errors\n");
}

TEST(TableTest, SaysWhatADecimalCommaDidInAList) {
  EXPECT_EQ(read_cart("mass: 1 t\nposition: [-4,5 m, 3 m, 6 m]\n").complaints,
            "cart.yaml:2:11: error: position has 4 items; 3 are due, each a length\n"
            "    decimals take a point (1.5): a comma begins the next item\n1 error\n");
}

TEST(TableTest, SaysOnceWhatIsWrongBehindAnAnchor) {
  EXPECT_EQ(
      read_cart("mass: 1 t\nwheels: {left: &wheel {radius: 3}, right: *wheel, third: *wheel}\n")
          .complaints,
      "cart.yaml:2:32: error: radius \"3\" has no unit; a length is due, for example \"12 m\"\n"
      "1 error\n");
}

TEST(TableTest, GathersEverythingThatIsWrong) {
  EXPECT_EQ(read_cart("sped: 3 m/min\nspeed: 3 m\ncolour: gren\nposition: [1 m, 2 m]\n"
                      "wheels:\n  left: {radius: -40 cm}\n  right: {}\nseats: 12\ncovered: maybe\n")
                .complaints,
            "cart.yaml:1:1: error: cart has no key \"sped\"\n"
            "    its keys are mass, speed, colour, position, wheels, stations, seats, covered; did "
            "you mean \"speed\"?\n"
            "cart.yaml:1:1: error: cart lacks the key \"mass\"\n"
            "    a mass is due: laden\n"
            "cart.yaml:2:8: error: speed \"3 m\" is a length; a speed is due, for example \"3 "
            "m/min\"\n"
            "cart.yaml:3:9: error: colour \"gren\" does not exist\n"
            "    it must be one of red, green; did you mean \"green\"?\n"
            "cart.yaml:4:11: error: position has 2 items; 3 are due, each a length\n"
            "cart.yaml:6:18: error: radius \"-40 cm\" must be greater than 0\n"
            "cart.yaml:7:10: error: wheel right lacks the key \"radius\"\n"
            "    a length is due: of rolling\n"
            "cart.yaml:8:8: error: seats \"12\" must be from 0 to 9\n"
            "cart.yaml:9:10: error: covered \"maybe\" must be true or false\n"
            "9 errors\n");
}

// What is behind a mistyped key is read as what was meant, so that it is not missed as well.
TEST(TableTest, ComplainsOnceOfAMistypedKey) {
  const auto [cart, complaints] =
      read_cart("mas: 2 t\nwheels: {left: {radus: 40 cm}}\nstation: [1 m, 2 m]\n");
  EXPECT_EQ(complaints,
            "cart.yaml:1:1: error: cart has no key \"mas\"\n"
            "    its keys are mass, speed, colour, position, wheels, stations, seats, covered; did "
            "you mean \"mass\"?\n"
            "cart.yaml:2:17: error: wheel left has no key \"radus\"\n"
            "    its keys are radius, width; did you mean \"radius\"?\n"
            "cart.yaml:3:1: error: cart has no key \"station\"\n"
            "    its keys are mass, speed, colour, position, wheels, stations, seats, covered; did "
            "you mean \"stations\"?\n"
            "3 errors\n");
  EXPECT_DOUBLE_EQ(cart.mass, 2000);
  EXPECT_EQ(cart.stations.size(), 2U);
  // Two mistakes are two complaints, and the right key beside the mistyped one is what counts.
  EXPECT_EQ(read_cart("mass: 2 t\nwheels: {left: {radus: 40}}\nmas: 3 kg\n").complaints,
            "cart.yaml:2:17: error: wheel left has no key \"radus\"\n"
            "    its keys are radius, width; did you mean \"radius\"?\n"
            "cart.yaml:2:24: error: radius \"40\" has no unit; a length is due, for example \"12 "
            "m\"\n"
            "cart.yaml:3:1: error: cart has no key \"mas\"\n"
            "    its keys are mass, speed, colour, position, wheels, stations, seats, covered; did "
            "you mean \"mass\"?\n"
            "3 errors\n");
}

TEST(TableTest, SaysWhatIsDueInGoodGrammar) {
  EXPECT_EQ(read_cart("mass: 2 t\nwheels:\n").complaints,
            "cart.yaml:2:1: error: wheels has no value; names, each with the keys of a wheel are "
            "due\n1 error\n");
  EXPECT_EQ(names_hint("its lugs are", {}, "L1"), "it has no lugs");
  EXPECT_EQ(names_hint("the outputs are", {}, "tension"), "there are no outputs");
  EXPECT_EQ(names_hint("they have", {}, "x"), "they have none");
}

TEST(TableTest, NamesWhatStandsInTheWrongShape) {
  EXPECT_EQ(
      read_cart("mass: [1 t]\nspeed:\nposition: 3 m\nwheels: [1]\nstations: {a: 1}\n").complaints,
      "cart.yaml:1:7: error: mass is a list; a mass is due\n"
      "cart.yaml:2:1: error: speed has no value; a speed is due\n"
      "cart.yaml:3:11: error: position \"3 m\" is no list; a list of 3 items, each a length is "
      "due\n"
      "cart.yaml:4:9: error: wheels is a list; names, each with the keys of a wheel are due\n"
      "cart.yaml:5:11: error: stations is a table of keys; a length, or a list, each item a "
      "length is due\n"
      "5 errors\n");
  EXPECT_EQ(read_cart("- 1\n- 2\n").complaints,
            "cart.yaml:1:1: error: the file is a list; the keys of a cart are due\n1 error\n");
}

TEST(TableTest, RefusesAKeyGivenTwice) {
  EXPECT_EQ(read_cart("mass: 1 t\nseats: 1\nmass: 2 t\n").complaints,
            "cart.yaml:3:1: error: key \"mass\" is given twice\n    it stands first in line 1\n"
            "1 error\n");
}

TEST(TableTest, RefusesNamesThatNobodyCouldReferTo) {
  EXPECT_EQ(read_cart("mass: 1 t\nwheels: {\"front left\": {radius: 1 m}}\n").complaints,
            "cart.yaml:2:10: error: \"front left\" cannot be a name\n"
            "    names have letters (a to z, A to Z), digits, _ and - only\n1 error\n");
}

TEST(TableTest, FollowsAnchorsAndMergeKeys) {
  const auto [cart, complaints] = read_cart(
      "mass: 1 t\nwheels:\n  left: &wheel {radius: 1 m, width: 10 cm}\n"
      "  right: {<<: *wheel, radius: 2 m}\n  spare: *wheel\n");
  EXPECT_EQ(complaints, "");
  ASSERT_EQ(cart.wheels.size(), 3U);
  EXPECT_DOUBLE_EQ(cart.wheels[1].radius, 2);
  EXPECT_DOUBLE_EQ(cart.wheels[1].width.value(), 0.1);
  EXPECT_DOUBLE_EQ(cart.wheels[2].radius, 1);
}

TEST(TableTest, StopsWhenAliasesMultiplyWithoutEnd) {
  std::string bomb = "mass: 1 t\nstations: &a [1 m]\n";
  std::string items;
  for (int i = 0; i < 2000; ++i) items += "*w, ";
  bomb += "wheels: {a: &w {radius: 1 m}, b: &m {<<: [" + items + "]}";
  for (int i = 0; i < 2000; ++i) bomb += ", w" + std::to_string(i) + ": *m";
  bomb += "}\n";
  EXPECT_NE(read_cart(bomb).complaints.find("more than 1000000 values"), std::string::npos);
  // An alias to its own parent is endless, too.
  EXPECT_NE(read_cart("mass: 1 t\n<<: &x {<<: *x}\n").complaints.find("nested too deeply"),
            std::string::npos);
}

}  // namespace
}  // namespace blocklift::pipeline
