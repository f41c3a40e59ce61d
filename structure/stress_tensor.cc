#include "structure/stress_tensor.h"

#include <cmath>

namespace blocklift::structure {

double von_mises(const Stress& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 +
                   3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

Eigen::Matrix3d plane_stress_law(const Material& material) {
  const double nu = material.poisson_ratio;
  Eigen::Matrix3d law;
  law << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  return material.youngs_modulus / (1 - nu * nu) * law;
}

}  // namespace blocklift::structure
