#pragma once

#include <string>

#include <Eigen/Core>

#include "structure/material.h"
#include "structure/mesh/heat.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Constants of an orthotropic material in axes of its own.
struct OrthotropicConstants {
  Vector3 youngs_moduli = Vector3::Zero();   ///< E_1, E_2, E_3, Pa
  Vector3 poisson_ratios = Vector3::Zero();  ///< nu_12, nu_13, nu_23: -epsilon_j / epsilon_i
  Vector3 shear_moduli = Vector3::Zero();    ///< G_12, G_13, G_23, Pa
};

/// The inverse of the compliance of the constants; Jones (1999), equation 2.29. Not positive
/// (is_positive) where they belong to no material.
Elasticity orthotropic_elasticity(const OrthotropicConstants& constants);

/// Whether every strain stores energy.
bool is_positive(const Elasticity& elasticity);

/// The elasticity seen from the block's axes.
/// @param axes columns: the material's own axes in the block's.
Elasticity turned(const Elasticity& own, const Eigen::Matrix3d& axes);

/// The same of an expansion.
ExpansionStrains turned(const ExpansionStrains& own, const Eigen::Matrix3d& axes);

/// Expansion of a material that bears alike in all directions; one that does not expand alike has
/// an obstacle, where it has none yet.
MaterialExpansion even_expansion(const ExpansionStrains& strains, double reference,
                                 const std::string& obstacle, const std::string& name);

/// Young's modulus and Poisson's ratio of the isotropic material with the invariants of an
/// elasticity, E in Pa: of compression by all its axes, 9 K = C_iijj, and of shear,
/// 15 G = (3 C_ijij - C_iijj) / 2. Source: Voigt (1910), mean over all directions.
Material nearest_isotropic(const Elasticity& elasticity);

/// Whether an elasticity is that of its nearest isotropic material to one part in a thousand.
bool is_isotropic(const Elasticity& elasticity);

/// The law of a material that is the same in all directions.
Elasticity isotropic_elasticity(const Material& material);

/// The law of a solid of a mesh, along the block's axes.
Elasticity elasticity_of(const Mesh& mesh, const Solid& solid);

}  // namespace blocklift::structure
