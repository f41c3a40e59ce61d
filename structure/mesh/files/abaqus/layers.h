#pragma once

#include <optional>
#include <string>
#include <vector>

#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/files/abaqus/orientation.h"
#include "structure/mesh/laminate.h"

namespace blocklift::structure {

/// Layers of a *SHELL SECTION, COMPOSITE from the bottom up. A layer's axis 1 is turned from the
/// section's by an angle, or that of an orientation of its own.
class AbaqusLayers {
 public:
  /// Reads the lines thickness, points, material, angle in degrees or name of an orientation.
  /// @throws CardError if a line is not one of a layer, or names what does not exist.
  AbaqusLayers(const AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& block);

  double thickness() const;  ///< of all, m
  /// With the angles of those that have one, and none of those that have an orientation.
  const std::vector<Ply>& plies() const { return plies_; }
  /// The name of the material that all layers have.
  std::optional<std::string> only_material() const;
  /// What keeps the expansion of one of them from being known.
  const std::string& obstacle() const { return obstacle_; }
  /// Has one of them an orientation of its own?
  bool have_axes() const;

  /// The layers of one plate with all of their angles, to 1e-4 rad.
  /// @param centre in the deck's units. @param normal of the plate.
  /// @param axis_1 of the section there; only its part along the plate counts.
  /// @throws CardError if axis 1 of the section or of an orientation stands on the plate.
  std::vector<Ply> at(const Vector3& centre, const Vector3& normal, const Vector3& axis_1) const;

 private:
  std::vector<Ply> plies_;
  std::vector<std::string> materials_;
  std::vector<std::optional<AbaqusAxes>> axes_;  ///< of each layer
  std::string obstacle_;
};

}  // namespace blocklift::structure
