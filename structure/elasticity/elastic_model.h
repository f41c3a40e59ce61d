#pragma once

#include <optional>

#include <Eigen/Core>

#include "structure/elasticity/discretisation.h"
#include "structure/elasticity/load.h"
#include "structure/mesh/hex_mesh.h"
#include "structure/mesh/plates/block_description.h"

namespace blocklift::structure {

/// A block ready for loads: mesh, nodes, mass, and the load vectors of the unit loads.
/// Immutable; cheap to make beside the factorisation (nothing is assembled here).
class ElasticModel {
 public:
  /// @param degree of the elements, 1 to 4; 3 is right for one layer of thin plate.
  /// @param total_mass (kg) and centre_of_mass_B (m) as stated, outfitting included; absent:
  ///   those of the mesh.
  /// @throws ModelError as find_mass_properties and pin_loads do.
  ElasticModel(BlockMesh mesh, int degree, std::optional<double> total_mass = {},
               std::optional<Vector3> centre_of_mass_B = {});

  const BlockMesh& mesh() const { return mesh_; }
  const Discretisation& space() const { return space_; }
  const MassProperties& mass_properties() const { return mass_; }
  int unknowns() const { return space_.unknowns(); }
  int lug_count() const { return static_cast<int>(mesh_.lugs.size()); }
  /// int rho N_n dV and int rho N_n x dV, kg and kg m, a row each node.
  const NodalMoments& mass_moments() const { return mass_moments_; }
  /// Unit forces (1 N) along x, y, z at the pin of each lug: 3 columns a lug.
  const Eigen::MatrixXd& lug_loads() const { return lug_loads_; }
  /// Unit inertia fields, 12 columns in the order of InertiaField::coefficients.
  const Eigen::MatrixXd& inertia_loads() const { return inertia_loads_; }

 private:
  BlockMesh mesh_;
  Discretisation space_;
  MassProperties mass_;
  NodalMoments mass_moments_;
  Eigen::MatrixXd lug_loads_;
  Eigen::MatrixXd inertia_loads_;
};

/// Meshes a description and makes the model of it.
ElasticModel make_elastic_model(const BlockDescription& description, int degree);

}  // namespace blocklift::structure
