#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Mass of a mesh before finite elements are made on it.
struct MeshMass {
  double mass = 0;                                    ///< kg
  Vector3 centre = Vector3::Zero();                   ///< m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre, kg m^2
};

/// Mass of a shell per area where it is so thick, kg/m^2: the plate's own and what its section
/// bears besides (paint, outfit, non-structural mass of decks).
double mass_per_area(const Mesh& mesh, const Shell& shell, double thickness);

/// Mass of a beam per length, kg/m: its own and what its section bears besides.
double mass_per_length(const Mesh& mesh, const BeamSection& section);

/// Mass of a mesh: plates over their mid-surfaces (Gauss' rule, exact for flat plates), beams along
/// the lines of their centroids (BeamLines), point masses. What lies across a plate or a beam's
/// line (t^2 / 12 and the like) is left out of the inertia. Shells without section weigh nothing.
MeshMass mass_properties(const Mesh& mesh);

/// The same of each group; the last entry is the point masses.
std::vector<MeshMass> mass_by_group(const Mesh& mesh);

/// Area of a shell between its vertices or, if it is curved, of its surface, m^2.
double area(const Mesh& mesh, const Shell& shell);

}  // namespace blocklift::structure
