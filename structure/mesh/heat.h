#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// How a material expands: strain = coefficient (temperature - reference) in all directions.
struct MaterialExpansion {
  double coefficient = 0;  ///< 1/K
  double reference = 0;    ///< temperature without strain, where nothing else says one
  std::string obstacle;    ///< why the coefficient does not say all of it; empty: it does
};

/// Strains xx, yy, zz, xy, yz, zx (of shear twice epsilon_xy) per kelvin.
using ExpansionStrains = Eigen::Matrix<double, 6, 1>;

/// Expansion of a layered plate in axes 1 and 2 of its own: what holds it back where it is warmer
/// by T + z T', z from the middle of its height.
struct LaminateExpansion {
  /// int Q alpha (1, z, z^2) dz, in the order 11, 22, 12: N/(m K), N/K, N m/K. Membrane forces are
  /// T of the first and T' of the second, moments T of the second and T' of the third. Source:
  /// Jones (1999), chapter 4, thermal effects.
  std::array<Eigen::Vector3d, 3> forces{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                        Eigen::Vector3d::Zero()};
  /// int alpha . Q alpha (1, z, z^2) dz.
  Eigen::Vector3d energies = Eigen::Vector3d::Zero();
  double reference = 0;
  std::string obstacle;  ///< as a material's
};

/// Expansion of a mesh's materials. A material that has no entry has no known expansion.
struct Expansions {
  std::vector<MaterialExpansion> of_materials;    ///< by place in Mesh::materials
  std::vector<ExpansionStrains> of_elasticities;  ///< by place in Mesh::elasticities, block's axes
  std::vector<LaminateExpansion> of_laminates;    ///< by place in Mesh::laminates

  /// Notes the expansion of a material of the mesh.
  void set(int material, MaterialExpansion expansion) {
    if (static_cast<int>(of_materials.size()) <= material)
      of_materials.resize(static_cast<std::size_t>(material) + 1);
    of_materials[static_cast<std::size_t>(material)] = std::move(expansion);
  }
};

/// Temperatures of a load case, in the deck's degrees, of which only differences count.
struct TemperatureField {
  std::string name;  ///< such as "temperature set 5"
  /// The temperatures count from the materials' references; else they are what they have risen by.
  bool counts_from_reference = false;
  std::vector<double> at_vertices;  ///< not a number: none is given
  /// Slopes there, K/m: along the normal of a shell or axis 3 of a beam, and along axis 2 of a
  /// beam. Empty: there are none.
  std::vector<Eigen::Vector2d> slopes;
  struct OfShell {
    double mean = 0, slope = 0;  ///< over the height; along the normal, K/m
  };
  struct OfBeam {
    std::array<double, 2> mean{};  ///< over the section, at its ends
    std::array<Eigen::Vector2d, 2> slopes{Eigen::Vector2d::Zero(),  ///< along axes 3 and 2, K/m
                                          Eigen::Vector2d::Zero()};
  };
  /// Of cells by their place in the mesh, which have nothing of their vertices' temperatures then.
  std::map<int, OfShell> shells;
  std::map<int, OfBeam> beams;
  std::string obstacle;  ///< why they cannot be computed with; empty: they can
};

}  // namespace blocklift::structure
