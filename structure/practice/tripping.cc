#include "structure/practice/tripping.h"

#include <cmath>
#include <numbers>

namespace blocklift::structure {

double tripping_stress(const Material& material, const TrippingSection& section, double length) {
  const double warping = std::numbers::pi * section.shear_height / length;
  return (material.shear_modulus() * section.torsion +
          material.youngs_modulus * section.second_moment * warping * warping) /
         section.polar_moment;
}

double tripping_strength(double elastic, double yield) {
  const double square = yield / elastic, slenderness = std::sqrt(square);
  if (slenderness <= 0.6) return yield;
  const double sum = 1 + 0.35 * (slenderness - 0.6) + square;
  return yield * (sum - std::sqrt(sum * sum - 4 * square)) / (2 * square);
}

}  // namespace blocklift::structure
