#pragma once

#include <array>
#include <vector>

#include "structure/practice/bar_chains.h"
#include "structure/practice/stiffened_plate.h"
#include "structure/practice/tripping.h"

namespace blocklift::structure {

/// The plate along which a beam runs: one shell on either side of it.
struct PlateAlong {
  std::array<int, 2> shells{-1, -1};  ///< -1: the beam is no stiffener
  Vector3 normal = Vector3::Zero();   ///< unit, across the beam
};

/// The stiffeners of a mesh: beams along which just two shells meet that go on from one another by
/// less than 30 degrees.
struct StiffenerChains {
  std::vector<PlateAlong> plates;  ///< of each beam of the mesh
  /// From support to support: a plate that stands off by more than 30 degrees, a solid, a beam out
  /// of the plate, or one in it with five times the second moment about the plate.
  std::vector<BarChain> chains;
};

StiffenerChains find_stiffeners(const Mesh& mesh, const MeetingPoints& points);

/// A beam's section, seen along the normal of its plate, heights from the line of its vertices.
/// @param share place on the beam from its first vertex, 0 to 1.
StiffenerSection stiffener_section(const Mesh& mesh, const Beam& beam, const Vector3& normal,
                                   double share);

/// A beam's section as it turns about its toe on its plate: the section's own end on the plate's
/// side of its centroid, above the line of the beam's vertices.
/// @param plate_height of the plate's mid-surface from the line of the vertices, m.
TrippingSection tripping_section(const Mesh& mesh, const Beam& beam, const Vector3& normal,
                                 double plate_height, double share);

/// Height of the mid-surface of a shell above its vertices, along a normal, m.
double plate_height(const Mesh& mesh, const Shell& shell, const Vector3& normal);

}  // namespace blocklift::structure
