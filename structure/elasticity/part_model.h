#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/part_joints.h"
#include "structure/formulation/solid_set.h"
#include "structure/material.h"
#include "structure/mesh/part_mesh.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {

/// Components of a group's nodes that are held.
struct PartSupport {
  std::string name;
  std::string group;
  std::array<bool, 3> fixed = {true, true, true};  ///< along x, y, z
  Vector3 displacement = Vector3::Zero();          ///< where fixed, m
};

/// A load on a group of faces, edges or points.
struct SurfaceLoad {
  enum class Kind { pressure, traction, force, bearing };
  std::string name;
  std::string group;
  Kind kind = Kind::force;
  double pressure = 0;               ///< against the face, positive pushes, Pa
  Vector3 vector = Vector3::Zero();  ///< traction, Pa; or the resultant, N
  Vector3 axis = Vector3::UnitZ();   ///< of the hole that bears, unit
  Vector3 point = Vector3::Zero();   ///< on that axis, m
};

/// A load on all material: b(x) = rho (g - omega x (omega x (x - point))), N/m^3.
struct BodyLoad {
  std::string name;
  Vector3 gravity = Vector3::Zero();           ///< g, or minus the acceleration of the part, m/s^2
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s
  Vector3 point = Vector3::Zero();             ///< on the axis, m
};

/// Mass, volume and centre of a part.
struct PartMass {
  double mass = 0;    ///< kg
  double volume = 0;  ///< m^3
  Vector3 centre = Vector3::Zero();
};

/// A part with its materials, supports and loads: linear elasticity on any mesh of solids.
///
/// Freedom 3 n + a is the displacement of node n along axis a.
struct PartModel {
  PartMesh mesh;
  std::vector<Material> materials;
  std::vector<int> material_of_solid;  ///< place in materials, in the order of mesh.solids
  std::vector<PartSupport> supports;
  std::vector<SurfaceLoad> surface_loads;
  std::vector<BodyLoad> body_loads;
  PartJoints joints;  ///< empty: bodies that share no node do not know of each other
};

/// The solids of a part, each material a law.
SolidSet solids_of(const PartModel& model);

/// Stiffness of one solid, N/m: unknown 3 i + a of its node i along axis a.
Eigen::MatrixXd part_element_stiffness(const PartModel& model, int solid);

PartMass find_part_mass(const PartModel& model);

/// Load vector of all loads, N. @throws ModelError if a pressure acts on faces that are on no
/// solid.
Eigen::VectorXd part_load(const PartModel& model);

/// Held unknowns of all supports; where two hold the same unknown, their displacements must agree.
/// @param support_of the place of the support in the model, one a held unknown.
/// @throws ModelError if they do not.
std::vector<FixedUnknown> part_supports(const PartModel& model, std::vector<int>& support_of);

/// `fixed` and, behind it, the unknowns of nodes that are on no solid (middles of circles and the
/// like).
std::vector<FixedUnknown> with_idle_nodes(const PartModel& model, std::vector<FixedUnknown> fixed);

}  // namespace blocklift::structure
