#pragma once

#include <functional>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include "structure/mesh/mesh_part.h"
#include "structure/rigid_body.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// A bit of a structure's matter and how it moves: u = sum over nodes of N_i (u_i + theta_i x arm).
struct MatterPoint {
  const int* nodes = nullptr;
  const double* values = nullptr;  ///< N_i
  int node_count = 0;
  Vector3 arm = Vector3::Zero();    ///< from the nodes' surface or line, m
  Vector3 place = Vector3::Zero();  ///< m
  double volume = 0;                ///< m^3; 0 for a mass without one
  double mass = 0;                  ///< kg
};

using VisitMatter = std::function<void(const MatterPoint&)>;

/// Visits the matter of some shell cells: Gauss points of the degree plus one, at two heights +-t /
/// sqrt(12) about the mid-surface, which carry the section's first and second moments exactly.
void for_each_shell_point(const Space& space, const std::vector<int>& cells,
                          const VisitMatter& visit);

/// Visits all matter: shells, beams (four points a section, which carry its moments of inertia),
/// solids and
/// point masses (six points, for the same reason).
void for_each_matter_point(const Space& space, const VisitMatter& visit);

/// A Gauss point of a shell cell on the surface of its nodes.
struct ShellGaussPoint {
  Vector3 place = Vector3::Zero();   ///< m
  Vector3 normal = Vector3::Zero();  ///< unit
  double volume = 0;                 ///< of half the thickness, m^3
  double thickness = 0;              ///< m
};

/// All matter of a space, its shells' points found once for all that is summed over them.
class Matter {
 public:
  /// @param threads 0: as many as the machine has. The space must outlive this object.
  explicit Matter(const Space& space, int threads = 0);

  const Space& space() const { return space_; }
  /// Visits what for_each_matter_point does, in its order.
  void visit(const VisitMatter& visit) const;
  /// Visits the matter of one shell cell.
  void visit_shell(int cell, const VisitMatter& visit) const;
  /// Visits all that is no shell.
  void visit_others(const VisitMatter& visit) const;

 private:
  const Space& space_;
  std::vector<Eigen::VectorXd> shapes_;  ///< at each Gauss point of a cell
  std::vector<ShellGaussPoint> points_;  ///< cell by cell
};

/// Adds to load vectors (a column each, six rows a node) forces at a point of matter: 3 x columns,
/// N.
template <typename Loads, typename Forces>
void add_forces(const MatterPoint& point, const Forces& forces, Loads& loads) {
  const bool has_arm = !point.arm.isZero(0);
  for (int i = 0; i < point.node_count; ++i) {
    const Eigen::Index row = 6 * static_cast<Eigen::Index>(point.nodes[i]);
    for (Eigen::Index k = 0; k < forces.cols(); ++k) {
      const Vector3 force = point.values[i] * forces.col(k);
      loads.template block<3, 1>(row, k) += force;
      if (has_arm) loads.template block<3, 1>(row + 3, k) += point.arm.cross(force);
    }
  }
}

/// Force and moment about B's origin of a load vector (six rows a node).
Wrench resultant(const Space& space, const Eigen::Ref<const Eigen::VectorXd>& load);

/// Integrates the mass; with a stated mass (kg) and centre (m), spreads the difference as a density
/// that is linear in place: see MassProperties.
/// @throws ModelError if the density would be negative somewhere, the message naming the mass and
///   the centre of the steel, or there is no mass.
MassProperties find_mass_properties(const Matter& matter, const double* stated_mass,
                                    const Vector3* stated_centre);
MassProperties find_mass_properties(const Space& space, const double* stated_mass,
                                    const Vector3* stated_centre);

/// Load vectors of the twelve unit inertia fields (columns, in the order of
/// InertiaField::coefficients), N.
/// @param threads 0: as many as the machine has; sums are formed in one order, whatever the number.
Eigen::MatrixXd inertia_loads(const Matter& matter, const MassProperties& mass, int threads = 0);
Eigen::MatrixXd inertia_loads(const Space& space, const MassProperties& mass);
/// The same of a part of the mesh alone.
Eigen::MatrixXd inertia_loads(const Space& space, const MassProperties& mass, const MeshPart& part);

/// Load vectors of wrenches about a point (force, moment; a column each), spread over some shell
/// cells as a body force b(x) = c + d x (x - point) with c and d such that the resultant is the
/// wrench. Over a flat plate a force across it is a pressure linear in place.
/// @throws ModelError if the cells have no volume.
Eigen::MatrixXd spread_wrenches(const Space& space, const std::vector<int>& cells,
                                const Vector3& point, const Eigen::MatrixXd& wrenches);

/// Adds the same to load vectors (freedoms x wrenches); only the cells' own nodes are touched.
void add_spread_wrenches(const Space& space, const std::vector<int>& cells, const Vector3& point,
                         const Eigen::MatrixXd& wrenches, Eigen::MatrixXd& loads);

/// Consistent mass matrix of all freedoms, outfitting included, kg.
Eigen::SparseMatrix<double> mass_matrix(const Space& space, const MassProperties& mass);

}  // namespace blocklift::structure
