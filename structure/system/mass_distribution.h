#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/rigid_body.h"
#include "structure/system/matter.h"

namespace blocklift::structure {

/// Where the mass of a structure is: what mass properties are found from, whatever mass and centre
/// are stated. It needs neither elements nor mesh once it is made, and a small part of their
/// memory.
class MassDistribution {
 public:
  explicit MassDistribution(const Matter& matter);

  /// See find_mass_properties, which gives the same to the last bit.
  /// @param stated_mass kg; null: the steel's. @param stated_centre m; null: the steel's.
  /// @throws ModelError as find_mass_properties does.
  MassProperties with(const double* stated_mass, const Vector3* stated_centre) const;

 private:
  struct Bit {
    double mass = 0;                  ///< kg
    Vector3 place = Vector3::Zero();  ///< m
  };
  std::vector<Bit> bits_;
  Eigen::Matrix3Xd nodes_;  ///< m; where the density is asked whether it is negative
};

}  // namespace blocklift::structure
