#include "pipeline/files/structure/rectangle_keys.h"

#include <fmt/format.h>

#include "pipeline/declaration/geometry_format.h"

namespace blocklift::pipeline {

Format<std::array<double, 2>> extent_format() {
  const auto pair = array_of<double, 2>(quantity(Dimension::length));
  return {pair.description,
          [pair](const YAML::Node& node, Reading& reading, std::array<double, 2>& value) {
            if (!pair.read(node, reading, value)) return false;
            if (value[0] < value[1]) return true;
            reading.error(node,
                          fmt::format("extent {} ends at {:.6g} m, where it begins at {:.6g} m",
                                      reading.key(), value[1], value[0]),
                          {"an extent is [lower end, upper end]"});
            return false;
          }};
}

void check_extents(const std::array<Extent, 3>& extent, std::size_t normal, const Axes& names,
                   Reading& reading, const Mark& mark) {
  for (const auto& [name, axis] : names) {
    if (axis == normal && extent[axis]) {
      reading.error(
          extent[axis]->mark,
          fmt::format("{} is normal to {} and so has no extent along it", reading.owner(), name),
          {"its place along the normal is \"at\""});
    } else if (axis != normal && !extent[axis]) {
      reading.error(mark, fmt::format("{} lacks the key \"{}\"", reading.owner(), name),
                    {"it is the extent along " + name + ": [lower end, upper end]"});
    }
  }
}

bool has_plate_axes(const YAML::Node& node) { return node["u"] || node["v"] || node["n"]; }

}  // namespace blocklift::pipeline
