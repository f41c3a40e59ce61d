#include "structure/mesh/padeye/padeye_geometry.h"

#include <cmath>

#include <fmt/format.h>

namespace blocklift::structure {

std::vector<std::string> padeye_faults(const PadeyeGeometry& padeye) {
  std::vector<std::string> faults;
  const double hole = padeye.hole_diameter / 2;
  const auto mm = [](double length) { return fmt::format("{:.6g} mm", 1000 * length); };
  const auto require = [&](bool right, const std::string& text) {
    if (!right) faults.push_back(text);
  };
  require(padeye.thickness > 0 && hole > 0 && padeye.pin_diameter > 0,
          "thickness, hole and pin need a size above zero");
  require(padeye.radius > hole, fmt::format("the hole's radius, {}, reaches the edge of the main "
                                            "plate, whose radius is {}",
                                            mm(hole), mm(padeye.radius)));
  require(padeye.pin_diameter <= padeye.hole_diameter,
          fmt::format("the pin, {}, is larger than its hole, {}", mm(padeye.pin_diameter),
                      mm(padeye.hole_diameter)));
  require(padeye.height > hole,
          fmt::format("the hole's radius, {}, reaches the base, which lies {} from its middle",
                      mm(hole), mm(padeye.height)));
  require((padeye.cheek_radius > 0) == (padeye.cheek_thickness > 0),
          "cheek plates need both a radius and a thickness");
  if (padeye.has_cheeks()) {
    require(padeye.cheek_radius > hole,
            fmt::format("the cheek plates' radius, {}, lies within the hole, whose radius is {}",
                        mm(padeye.cheek_radius), mm(hole)));
    require(padeye.cheek_radius < padeye.radius,
            fmt::format("the cheek plates' radius, {}, reaches beyond the main plate, whose "
                        "radius is {}",
                        mm(padeye.cheek_radius), mm(padeye.radius)));
    require(padeye.cheek_radius < padeye.height,
            fmt::format("the cheek plates' radius, {}, reaches beyond the base, which lies {} "
                        "from the middle of the hole",
                        mm(padeye.cheek_radius), mm(padeye.height)));
  }
  for (const double end : {padeye.base_left, padeye.base_right})
    require(std::hypot(end, padeye.height) > padeye.radius,
            fmt::format("the base ends {} beside the hole's middle, within the main plate's "
                        "radius of {}",
                        mm(end), mm(padeye.radius)));
  require(padeye.base_left > hole && padeye.base_right > hole,
          "the base is narrower than the hole on one side of it");
  return faults;
}

}  // namespace blocklift::structure
