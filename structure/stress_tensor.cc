#include "structure/stress_tensor.h"

#include <cmath>

#include <Eigen/Dense>

namespace blocklift::structure {

double von_mises(const Stress& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 +
                   3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

double complementary_energy(const Material& material, const Stress& s) {
  const double nu = material.poisson_ratio, trace = s.head<3>().sum();
  return ((1 + nu) * (s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm()) -
          nu * trace * trace) /
         material.youngs_modulus;
}

Stress stress_of_gradient(const Material& material, const Eigen::Matrix3d& g) {
  const double mu = material.shear_modulus();
  const double pressure = material.lame_lambda() * g.trace();
  Stress stress;
  stress << pressure + 2 * mu * g(0, 0), pressure + 2 * mu * g(1, 1), pressure + 2 * mu * g(2, 2),
      mu * (g(0, 1) + g(1, 0)), mu * (g(1, 2) + g(2, 1)), mu * (g(2, 0) + g(0, 2));
  return stress;
}

Eigen::Matrix3d plane_stress_law(const Material& material) {
  const double nu = material.poisson_ratio;
  Eigen::Matrix3d law;
  law << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  return material.youngs_modulus / (1 - nu * nu) * law;
}

}  // namespace blocklift::structure
