#pragma once

#include <optional>

#include "structure/mesh/fields/fields.h"
#include "structure/mesh/fields/shell_tree.h"

namespace blocklift::structure {

/// A place within the steel of a plate.
struct PlatePlace : ShellPlace {
  double height = 0;                 ///< above the mid-surface, towards the shell's normal, m
  Vector3 normal = Vector3::Zero();  ///< of the shell there
};

/// Finds the plate of a mesh that holds a place.
class PlateFinder {
 public:
  /// The mesh must outlive this object, and its shells stay as they are.
  explicit PlateFinder(const Mesh& mesh);

  /// The place within a plate, to a thousandth of its thickness and 1e-5 of its shells' sizes; none
  /// where there is no plate.
  /// @param normal where several plates meet, the one whose normal is nearest to this direction or
  ///   its opposite; zero: the one whose mid-surface is nearest, counted in thicknesses.
  std::optional<PlatePlace> find(const Vector3& place,
                                 const Vector3& normal = Vector3::Zero()) const;

 private:
  const Mesh& mesh_;
  ShellTree tree_;
  double reach_ = 0;  ///< how far a plate's steel lies from its vertices' surface at most, m
};

}  // namespace blocklift::structure
