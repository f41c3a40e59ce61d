#pragma once

#include <optional>
#include <string>

#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

/// Axes that an *ORIENTATION gives to the material of a section, straight or cylindrical, turned
/// further or not.
class AbaqusAxes {
 public:
  /// Of the orientation of that name in a scope; without a name the part's own.
  /// @throws CardError if there is none, or what it says is not known.
  AbaqusAxes(const AbaqusScope& scope, const std::string& name);

  /// Are they the same at all places?
  bool is_straight() const { return !is_cylindrical_; }

  /// Columns, at a place in the deck's units.
  Eigen::Matrix3d at(const Vector3& place) const;

  /// Direction whose part along a plate at a place is axis 1 of its material: that of a turn about
  /// axis 3, which is to stand on the plate.
  /// @throws CardError if the orientation names another axis of its turn, for then Abaqus takes
  ///   other axes along the plate.
  Vector3 along_plate(const Vector3& place) const;

 private:
  void read(const AbaqusBlock& block);
  void turn_further(const AbaqusLine& line);

  const AbaqusScope* scope_;
  std::string name_;
  bool is_cylindrical_ = false;
  Eigen::Matrix3d straight_ = Eigen::Matrix3d::Identity(), further_ = Eigen::Matrix3d::Identity();
  std::optional<int> axis_of_turn_;  ///< 1 to 3; none: nothing is said of a turn
  Vector3 origin_ = Vector3::Zero(), axis_ = Vector3::UnitZ();
};

}  // namespace blocklift::structure
