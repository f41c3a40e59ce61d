#pragma once

#include <string>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"
#include "structure/mesh/padeye/padeye_geometry.h"

namespace blocklift::structure {

/// A padeye where one of a block's lugs is, in its frame P (PadeyeGeometry): the middle plane of
/// its main plate is that of the lug, the line y = -height, z = 0 runs along the edge of the
/// plating that the lug stands on.
struct PadeyeInBlock {
  std::string lug;  ///< name of the lifting point
  PadeyeGeometry geometry;
  Eigen::Matrix3d R_BP = Eigen::Matrix3d::Identity();
  Vector3 p_BP = Vector3::Zero();  ///< the middle of the hole, m
};

/// Puts a padeye of solids in the place of a lug's shells, or on a mesh whose lug has none.
///
/// - The lug's shells beyond the base go; those within the plating, an insert, stay. The solids, of
///   the lug's region and material, are quadratic hexahedra (make_padeye_mesh). On a mesh without
///   lug plates (add_lug) they are a region more, of the lug's name and of the steel below.
/// - The base follows the plating as stand_on_plating() ties it: its motion is the projection of
///   the plate's edge along the base, and what the padeye exerts is spread along that edge.
/// - The pin is the reference of a distributing link over the bore: a force there is spread as an
///   even traction with a part that turns, of the same resultant. Weights are the faces' areas,
///   lumped as those of the diagonal of the mass matrix (Hinton, Rock and Zienkiewicz 1976).
///
/// Where shells went, labels of cells count from 1 again: shells, beams, solids. A mesh keeps those
/// that it has, and the solids' follow them.
/// @param divisions elements around the hole.
/// @throws ModelError naming the lug, if something but its base is joined to its plate beyond the
///   base, if there is no such plate, if its shells are not divided at the base, if no plate lies
///   below a part of the base, or if a mesh has a plate where the padeye is to be; as
///   make_padeye_mesh does.
void stand_padeye(Mesh& mesh, const PadeyeInBlock& padeye, int divisions = 16);

}  // namespace blocklift::structure
