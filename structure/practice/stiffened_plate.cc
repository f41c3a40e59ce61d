#include "structure/practice/stiffened_plate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "structure/practice/panel_buckling.h"

namespace blocklift::structure {

StiffenedSection join_sections(const StiffenerSection& stiffener,
                               const std::array<PlateStrip, 2>& plates) {
  StiffenedSection joined;
  double first_moment = stiffener.area * stiffener.height;
  joined.area = stiffener.area;
  for (const PlateStrip& plate : plates) {
    joined.area += plate.width * plate.thickness;
    first_moment += plate.width * plate.thickness * plate.height;
  }
  joined.height = first_moment / joined.area;
  joined.second_moment =
      stiffener.second_moment + stiffener.area * std::pow(stiffener.height - joined.height, 2);
  for (const PlateStrip& plate : plates)
    joined.second_moment +=
        plate.width * plate.thickness *
        (plate.thickness * plate.thickness / 12 + std::pow(plate.height - joined.height, 2));
  return joined;
}

double effective_width_share(const Material& material, double thickness, double width) {
  const double critical = 4 * euler_stress(material, thickness, width);
  const double slenderness = std::sqrt(material.yield_stress / critical);
  return slenderness <= 0.673 ? 1 : (slenderness - 0.22) / (slenderness * slenderness);
}

Column stiffener_column(const Material& material, const StiffenerSection& stiffener,
                        const std::array<PlateStrip, 2>& plates, double length) {
  constexpr double alpha = 0.49;  // open stiffeners
  std::array<PlateStrip, 2> effective = plates;
  for (PlateStrip& plate : effective)
    plate.width *= effective_width_share(material, plate.thickness, 2 * plate.width);
  const StiffenedSection gross = join_sections(stiffener, plates);
  const StiffenedSection reduced = join_sections(stiffener, effective);
  double farthest = std::max(std::abs(stiffener.lowest - reduced.height),
                             std::abs(stiffener.highest - reduced.height));
  double apart = std::abs(stiffener.height - gross.height);
  for (const PlateStrip& plate : plates) {
    farthest = std::max(farthest, std::abs(plate.height - reduced.height) + plate.thickness / 2);
    apart = std::max(apart, std::abs(plate.height - gross.height));
  }
  constexpr double held = std::numeric_limits<double>::infinity();
  Column column;
  column.area = gross.area;
  column.effective_area = reduced.area;
  column.elastic_modulus = material.youngs_modulus;
  column.yield_stress = material.yield_stress;
  column.length = length;
  column.second_moments = {gross.second_moment, held};
  column.section_moduli = {reduced.second_moment / farthest, held};
  column.imperfection = alpha + 0.09 * apart / std::sqrt(gross.second_moment / gross.area);
  return column;
}

}  // namespace blocklift::structure
