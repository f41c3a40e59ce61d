#include "structure/mesh/directional.h"

#include <array>

#include <Eigen/Dense>

#include "algebra/decompositions.h"

namespace blocklift::structure {

namespace {

/// The tensor's components behind the six numbers of a stress: xx, yy, zz, xy, yz, zx.
constexpr std::array<std::array<Eigen::Index, 2>, 6> places{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

}  // namespace

Elasticity orthotropic_elasticity(const OrthotropicConstants& constants) {
  const Vector3 &e = constants.youngs_moduli, &nu = constants.poisson_ratios,
                &g = constants.shear_moduli;
  Elasticity compliance = Elasticity::Zero();
  compliance.topLeftCorner<3, 3>() << 1 / e[0], -nu[0] / e[0], -nu[1] / e[0], -nu[0] / e[0],
      1 / e[1], -nu[2] / e[1], -nu[1] / e[0], -nu[2] / e[1], 1 / e[2];
  compliance.diagonal().tail<3>() << 1 / g[0], 1 / g[2], 1 / g[1];  // 12, 23, 31
  return algebra::inverse_of(compliance);
}

bool is_positive(const Elasticity& elasticity) {
  if (!elasticity.allFinite()) return false;
  const algebra::ColumnVector<6> values = algebra::symmetric_eigenvalues(elasticity);
  return values[0] > 1e-9 * values[5];
}

// Stresses turn as sigma = T sigma_own; since both have one energy, epsilon_own = T' epsilon.
Elasticity turned(const Elasticity& own, const Eigen::Matrix3d& axes) {
  Elasticity turn;
  for (std::size_t k = 0; k < places.size(); ++k) {
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    stress(places[k][0], places[k][1]) = stress(places[k][1], places[k][0]) = 1;
    const Eigen::Matrix3d seen = axes * stress * axes.transpose();
    for (std::size_t c = 0; c < places.size(); ++c)
      turn(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)) =
          seen(places[c][0], places[c][1]);
  }
  return turn * own * turn.transpose();
}

ExpansionStrains turned(const ExpansionStrains& own, const Eigen::Matrix3d& axes) {
  Eigen::Matrix3d strain;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto [i, j] = places[k];
    strain(i, j) = strain(j, i) = own[k] / (i == j ? 1 : 2);
  }
  const Eigen::Matrix3d seen = axes * strain * axes.transpose();
  ExpansionStrains result;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto [i, j] = places[k];
    result[k] = seen(i, j) * (i == j ? 1 : 2);
  }
  return result;
}

MaterialExpansion even_expansion(const ExpansionStrains& strains, double reference,
                                 const std::string& obstacle, const std::string& name) {
  ExpansionStrains even = ExpansionStrains::Zero();
  even.head<3>().setConstant(strains[0]);
  MaterialExpansion expansion{strains[0], reference, obstacle};
  if (obstacle.empty() && !(strains - even).isZero(1e-9 * strains.cwiseAbs().maxCoeff()))
    expansion.obstacle = name + " bears alike in all directions and expands by the direction";
  return expansion;
}

Material nearest_isotropic(const Elasticity& elasticity) {
  const double direct = elasticity.topLeftCorner<3, 3>().trace();
  const double across = elasticity(0, 1) + elasticity(1, 2) + elasticity(2, 0);
  const double shear = elasticity.diagonal().tail<3>().sum();
  const double k = (direct + 2 * across) / 9, g = (direct - across + 3 * shear) / 15;
  Material material;
  material.youngs_modulus = 9 * k * g / (3 * k + g);
  material.poisson_ratio = (3 * k - 2 * g) / (2 * (3 * k + g));
  return material;
}

bool is_isotropic(const Elasticity& elasticity) {
  const Elasticity even = isotropic_elasticity(nearest_isotropic(elasticity));
  return (elasticity - even).cwiseAbs().maxCoeff() < 1e-3 * even.diagonal().minCoeff();
}

Elasticity isotropic_elasticity(const Material& material) {
  Elasticity law = Elasticity::Zero();
  law.topLeftCorner<3, 3>().setConstant(material.lame_lambda());
  law.diagonal().head<3>().array() += 2 * material.shear_modulus();
  law.diagonal().tail<3>().setConstant(material.shear_modulus());
  return law;
}

Elasticity elasticity_of(const Mesh& mesh, const Solid& solid) {
  return solid.elasticity >= 0 ? mesh.elasticities[solid.elasticity]
                               : isotropic_elasticity(mesh.materials[solid.material]);
}

}  // namespace blocklift::structure
