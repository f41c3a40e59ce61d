#include "structure/material.h"

#include <cmath>
#include <string>

#include "structure/error.h"

namespace blocklift::structure {

void check_material(const Material& material) {
  const auto refuse = [&](const std::string& what, double value, const std::string& allowed) {
    throw ModelError("material \"" + material.name + "\": " + what + " is " +
                     std::to_string(value) + "; it must be " + allowed);
  };
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(material.youngs_modulus))
    refuse("Young's modulus", material.youngs_modulus, "positive, in Pa (steel: 206e9)");
  if (!(material.poisson_ratio > -1 && material.poisson_ratio < 0.5))
    refuse("Poisson's ratio", material.poisson_ratio, "above -1 and below 0.5 (steel: 0.3)");
  if (!(std::isfinite(material.density) && material.density >= 0))
    refuse("the density", material.density, "zero or positive, in kg/m^3 (steel: 7850)");
  // Infinite: it is not known, and nothing is held against it.
  if (!(material.yield_stress > 0))
    refuse("the yield stress", material.yield_stress, "positive, in Pa");
}

}  // namespace blocklift::structure
