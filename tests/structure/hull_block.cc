#include "tests/structure/hull_block.h"

#include <string>

namespace blocklift::structure::test {

Material steel() { return {"AH36", 206e9, 0.3, 7850, 355e6}; }

namespace {

// Positions from first to last in steps.
std::vector<double> every(double first, double last, double step) {
  std::vector<double> positions;
  for (double p = first; p < last + step / 2; p += step) positions.push_back(p);
  return positions;
}

// Pad in a web frame under the deck and a lug above it, at a side of the block.
void add_hull_lug(BlockDescription& block, const std::string& name, double x, double y_lower,
                  double y_upper) {
  const double middle = (y_lower + y_upper) / 2;
  block.pads.push_back(
      {"pad_" + name, "web_frames", Axis::x, x, {{{}, {y_lower, y_upper}, {6, 8}}}, 0.05, ""});
  block.lugs.push_back({name,
                        "pad_" + name,
                        Axis::x,
                        x,
                        {{{}, {y_lower, y_upper}, {8, 9}}},
                        0.05,
                        "",
                        {x, middle, 8.6}});
}

}  // namespace

BlockDescription hull_block() {
  BlockDescription block;
  block.name = "hull-860t";
  block.materials = {steel()};
  const Interval length{0, 32}, width{0, 20}, depth{0, 8};
  const auto add = [&](const std::string& name, Axis normal, std::vector<double> positions,
                       Interval x, Interval y, Interval z, double thickness) {
    block.plates.push_back({name, normal, std::move(positions), {{x, y, z}}, thickness, "AH36"});
  };
  add("bottom", Axis::z, {0}, length, width, {}, 0.020);
  add("tween_deck", Axis::z, {4}, length, width, {}, 0.014);
  add("deck", Axis::z, {8}, length, width, {}, 0.018);
  add("sides", Axis::y, {0, 20}, length, {}, depth, 0.018);
  add("web_frames", Axis::x, every(0, 32, 16.0 / 3), {}, width, depth, 0.014);
  add("girders", Axis::y, {5, 10, 15}, length, {}, depth, 0.014);
  const std::vector<double> stiffener_lines = {2, 7.5, 12.5, 18};
  add("bottom_stiffeners", Axis::y, stiffener_lines, length, {}, {0, 0.4}, 0.014);
  add("tween_deck_stiffeners", Axis::y, stiffener_lines, length, {}, {3.65, 4}, 0.012);
  add("deck_stiffeners", Axis::y, stiffener_lines, length, {}, {7.65, 8}, 0.012);
  for (int i = 0; i < 3; ++i) {
    add_hull_lug(block, "L" + std::to_string(2 * i + 1), 16.0 / 3 * (1 + 2 * i), 0, 2);
    add_hull_lug(block, "L" + std::to_string(2 * i + 2), 16.0 / 3 * (1 + 2 * i), 18, 20);
  }
  block.total_mass = 860e3;
  block.centre_of_mass_B = Vector3(15.6, 9.9, 3.9);
  block.largest_element = 2.7;
  return block;
}

BlockDescription cross_of_plates() {
  BlockDescription block;
  block.name = "cross";
  block.materials = {steel()};
  block.plates = {{"flat", Axis::z, {0}, {{{0, 2}, {0, 1}, {}}}, 0.02, "AH36"},
                  {"upright", Axis::x, {1}, {{{}, {0, 1}, {-0.5, 0.5}}}, 0.01, "AH36"}};
  block.largest_element = 0.6;
  return block;
}

BlockDescription small_block() {
  BlockDescription block;
  block.name = "small";
  block.materials = {steel()};
  block.plates = {
      {"bottom", Axis::z, {0}, {{{0, 4}, {0, 3}, {}}}, 0.020, "AH36"},
      {"sides", Axis::y, {0, 3}, {{{0, 4}, {}, {0, 2}}}, 0.015, "AH36"},
      {"frames", Axis::x, {0, 2, 4}, {{{}, {0, 3}, {0, 2}}}, 0.012, "AH36"},
  };
  const double corners[4][2] = {{0, 0}, {4, 0}, {0, 3}, {4, 3}};
  for (int i = 0; i < 4; ++i) {
    const std::string name = "L" + std::to_string(i + 1);
    const double x = corners[i][0], y = corners[i][1];
    const Interval along = x == 0 ? Interval{0, 0.8} : Interval{3.2, 4};
    block.pads.push_back({"pad_" + name, "sides", Axis::y, y, {{along, {}, {1.2, 2}}}, 0.035, ""});
    block.lugs.push_back({name,
                          "pad_" + name,
                          Axis::y,
                          y,
                          {{along, {}, {2, 2.4}}},
                          0.035,
                          "",
                          {(along.lower + along.upper) / 2, y, 2.25}});
  }
  block.total_mass = 8e3;
  block.centre_of_mass_B = Vector3(2.05, 1.48, 0.75);
  block.largest_element = 1;
  return block;
}

}  // namespace blocklift::structure::test
