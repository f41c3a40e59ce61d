#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/formulation/cell_heat.h"
#include "structure/mesh/fields/fields.h"
#include "structure/response/elastic_model.h"
#include "structure/square_site.h"

namespace blocklift::structure {

/// Square of plating over which the checked stress is a mean.
struct Square {
  Vector3 centre_B = Vector3::Zero();                    ///< on the plate's surface, m
  Vector3 e_1 = Vector3::Zero(), e_2 = Vector3::Zero();  ///< along its sides
  double size = 0;                                       ///< of a side, m
  int region = 0;                                        ///< place in Mesh::regions
  int shell = 0;                                         ///< place in Mesh::shells
  SquareSite site = SquareSite::field;
  /// Near a vertex where linear elasticity knows no limit of the stress. Else it is a lug's root
  /// that makes a corner.
  bool is_near_singularity = false;

  bool at_corner() const { return site != SquareSite::field; }
};

/// Checked stress of a block's plates for a set of motions: means over squares of a fixed size.
///
/// The squares (50 x 50 mm in IACS CSR, part 1, chapter 7, section 3) belong to the structure, not
/// to the mesh: they lie along the outlines of the plates' fields, flush with their corners, one
/// behind the other there and farther apart towards the middle, and on a lattice between. A field's
/// narrow end takes a smaller square. Closed plating without corners, and plating that turns by
/// more than 60 degrees, has them in the middles of the shells of the mesh. The mean strain is the
/// integral of the displacement along the square's outline,
///   mean e_ab = 1/A int sym(u_a nu_b) ds,   mean k_ab = 1/A int sym((theta x n)_a nu_b) ds,
/// which converges with the displacement, also where the strain itself has no limit. Of cells of
/// degree 1 the membrane shear is that of their stiffness (BilinearShear). Where plating is curved
/// the membrane strain of the displacements locks: there it is the mean of the strains that the
/// stiffness has (MembraneStrains).
class CheckedStress {
 public:
  /// @param motions freedoms x m, m and rad. The model must outlive this object.
  /// @param heat of as many cases as there are motions; null: none.
  CheckedStress(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions,
                double size = 0.05, int threads = 0, const CellHeat* heat = nullptr);
  /// The same of given squares of the same mesh.
  CheckedStress(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions,
                std::vector<Square> squares, int threads = 0);

  const std::vector<Square>& squares() const { return squares_; }
  /// Membrane von Mises stress of each square for factors of the m motions, Pa:
  /// sqrt(s11^2 - s11 s22 + s22^2 + 3 s12^2).
  Eigen::VectorXd von_mises(const Eigen::VectorXd& factors) const;
  /// Membrane stresses (11, 22, 12 a square) of each motion, Pa: 3 squares x m.
  const Eigen::MatrixXd& components() const { return components_; }
  /// Bending stresses on the normal's side, in the same order: the other side has their negative.
  const Eigen::MatrixXd& bending() const { return bending_; }

 private:
  void evaluate(const ElasticModel& model, const FieldWalker& walker,
                const Eigen::Ref<const Eigen::MatrixXd>& motions, int threads,
                const CellHeat* heat);

  std::vector<Square> squares_;
  Eigen::MatrixXd components_, bending_;
};

/// The squares of a mesh, see CheckedStress.
std::vector<Square> place_squares(const Mesh& mesh, const PlateFields& fields,
                                  const FieldWalker& walker, double size);

}  // namespace blocklift::structure
