#pragma once

#include <string>

namespace blocklift::structure {

/// Isotropic linear elastic material (Hooke):
///   sigma = lambda tr(epsilon) 1 + 2 mu epsilon.
struct Material {
  std::string name;
  double youngs_modulus = 0;  ///< E, Pa, positive
  double poisson_ratio = 0;   ///< nu, above -1 and below 0.5
  double density = 0;         ///< kg/m^3, not negative
  double yield_stress = 0;    ///< Pa, positive; infinite where it is not known

  /// First Lame constant lambda = E nu / ((1 + nu)(1 - 2 nu)), Pa.
  double lame_lambda() const {
    return youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
  }
  /// Shear modulus mu = E / (2 (1 + nu)), Pa.
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
};

/// @throws ModelError naming the material and the constant that is out of range.
void check_material(const Material& material);

}  // namespace blocklift::structure
