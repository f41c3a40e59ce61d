#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"
#include "structure/rigid_body.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// A block ready for loads: mesh, finite elements, mass, and the load vectors of the unit loads.
/// Immutable; cheap to make beside the factorisation (nothing is assembled here).
///
/// Load vectors and motions have six rows a node: forces (N) and moments (N m), displacements (m)
/// and rotations (rad).
class ElasticModel {
 public:
  /// @param total_mass (kg) and centre_of_mass_B (m) as stated, outfitting included; absent:
  ///   those of the mesh.
  /// @throws ModelError as Space, find_mass_properties and spread_wrenches do.
  ElasticModel(Mesh mesh, const Resolution& resolution, std::optional<double> total_mass = {},
               std::optional<Vector3> centre_of_mass_B = {});
  ~ElasticModel();

  const Mesh& mesh() const { return *mesh_; }
  const Space& space() const { return *space_; }
  const Resolution& resolution() const { return resolution_; }
  const MassProperties& mass_properties() const { return mass_; }
  int freedoms() const { return space_->freedoms(); }
  int lug_count() const { return static_cast<int>(mesh_->lifting_points.size()); }
  /// Unit forces (1 N) along x, y, z at the pin of each lug: 3 columns a lug.
  const Eigen::MatrixXd& lug_loads() const { return lug_loads_; }
  /// Unit inertia fields, 12 columns in the order of InertiaField::coefficients.
  const Eigen::MatrixXd& inertia_loads() const { return inertia_loads_; }

  /// The same block in finer or coarser elements.
  std::unique_ptr<ElasticModel> with(const Resolution& resolution) const;
  /// The same elements with another mass and centre: the space, and with it the
  /// stiffness, is shared.
  std::unique_ptr<ElasticModel> with_mass(std::optional<double> total_mass,
                                          std::optional<Vector3> centre_of_mass_B) const;

 private:
  ElasticModel(std::shared_ptr<const Mesh> mesh, const Resolution& resolution,
               std::optional<double> total_mass, std::optional<Vector3> centre_of_mass_B);

  ElasticModel(const ElasticModel&) = default;
  void find_inertia();

  std::shared_ptr<const Mesh> mesh_;
  Resolution resolution_;
  std::optional<double> stated_mass_;
  std::optional<Vector3> stated_centre_B_;
  std::shared_ptr<const Space> space_;
  MassProperties mass_;
  Eigen::MatrixXd lug_loads_;
  Eigen::MatrixXd inertia_loads_;
};

/// Shell cells of a space that lie in a region of the mesh.
std::vector<int> cells_of_region(const Space& space, int region);

}  // namespace blocklift::structure
