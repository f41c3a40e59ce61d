#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/elastic_model.h"

namespace blocklift::structure {

/// Patch of a plate over which the checked stress is averaged.
struct Patch {
  Vector3 centre_B;  ///< on the mid-plane, m
  int sheet = 0;     ///< place in BlockMesh::sheet_names
  int group = 0;     ///< place in HexMesh::groups
};

/// Membrane stress of a block's plates for a set of displacements.
///
/// Each plate rectangle between mesh lines is sampled by square-like patches of `patch_size`
/// (50 mm in IACS CSR, part 1, chapter 7): all of them in small rectangles; in large ones those
/// along the edges and corners and three in between along each direction, since the stress of a
/// cubic element has no further extremes to hide. The three in-plane components are averaged over
/// patch and thickness (all layers of a pad together), so bending drops out as in the rules'
/// membrane stress. Columns where plates cross belong to neither plate and are left out: their
/// stress is three-dimensional and that of the plates right beside them is sampled.
class MembraneStress {
 public:
  /// @param displacements unknowns x m, m.
  MembraneStress(const ElasticModel& model, const Eigen::MatrixXd& displacements,
                 double patch_size = 0.05);

  const std::vector<Patch>& patches() const { return patches_; }
  /// Membrane von Mises of each patch for factors of the m displacements, Pa:
  /// sqrt(s11^2 - s11 s22 + s22^2 + 3 s12^2).
  Eigen::VectorXd von_mises(const Eigen::VectorXd& factors) const;
  /// In-plane stresses (11, 22, 12 a patch) of each displacement, Pa: 3 patches x m.
  const Eigen::MatrixXd& components() const { return components_; }

 private:
  std::vector<Patch> patches_;
  Eigen::MatrixXd components_;
};

}  // namespace blocklift::structure
