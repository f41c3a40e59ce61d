#include "structure/mesh/files/deck/plausibility.h"

#include <fmt/format.h>

namespace blocklift::structure {

void check_plausible(const Material& material, const std::string& name, const UnitSystem& units,
                     DeckLog& log, SourceLine line, double least_modulus) {
  const double modulus = material.youngs_modulus, density = material.density;
  if (!(modulus > 0)) throw CardError{fmt::format("{} has no positive Young's modulus", name)};
  if (modulus < least_modulus || modulus > 2e12)
    throw CardError{fmt::format(
        "{} has a Young's modulus of {:.3g} MPa if units are {}; solids have {:g} to 2,000,000 MPa "
        "(steel 206,000). Is the deck in other units?",
        name, modulus / 1e6, units.name, least_modulus / 1e6)};
  if (!(density >= 0)) throw CardError{fmt::format("{} has a negative density", name)};
  if (density > 1e5)
    throw CardError{fmt::format(
        "{} has a density of {:.4g} kg/m^3 if units are {}; steel has 7850. Is the deck in other "
        "units, or does it give weights?",
        name, density, units.name)};
  if (density > 23e3)
    log.remark(
        line, fmt::format("{} has a density of {:.4g} kg/m^3, more than any metal", name, density));
  if (density > 0 && density < 1)
    log.remark(line,
               fmt::format("{} has a density of {:.4g} kg/m^3, less than air", name, density));
}

void check_poisson_ratio(const Material& material, const std::string& name) {
  if (!(material.poisson_ratio > -1 && material.poisson_ratio < 0.5))
    throw CardError{fmt::format("{} has Poisson's ratio {:g}; it must be above -1 and below 0.5",
                                name, material.poisson_ratio)};
}

std::string remark_on_directional_solids(int count) {
  return fmt::format(
      "{} {} of a material that depends on the direction: what is checked of such solids is the "
      "von Mises stress, which says little of their strength",
      count, count == 1 ? "solid is" : "solids are");
}

}  // namespace blocklift::structure
