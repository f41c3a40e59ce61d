#pragma once

#include <optional>
#include <string>

#include "structure/mesh/beams/sections.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Gives the shells of a group that have no section one.
void give_thickness(Mesh& mesh, const std::string& group, double thickness, int material);

/// Gives the beams of a group that have no section a profile, which stands towards a direction.
///
/// Its foot is on the faces of the plates along whose edges the beams lie and whose normal is
/// within 45 degrees of that direction; else its origin is on the nodes. Where two beams of the
/// group meet at less than 46 degrees, so do the lines of their centroids.
/// @param towards none, of round profiles alone: they have their middle on the nodes.
/// @throws ModelError naming a beam that runs along the direction.
void give_profile(Mesh& mesh, const std::string& group, const Profile& profile,
                  const std::optional<Vector3>& towards, int material);

/// Axis of a tank or pipe, about which frames run.
struct FrameAxis {
  Vector3 point = Vector3::Zero();   ///< on it, m
  Vector3 along = Vector3::UnitZ();  ///< a unit vector
  bool is_outside = false;           ///< the frames stand away from it
};

/// The same with a profile that stands, in the middle of each beam, straight towards an axis.
/// @throws ModelError naming a beam whose middle lies on the axis, or that runs towards it.
void give_profile(Mesh& mesh, const std::string& group, const Profile& profile,
                  const FrameAxis& axis, int material);

}  // namespace blocklift::structure
