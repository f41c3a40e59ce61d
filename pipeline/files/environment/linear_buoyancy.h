#pragma once

#include <optional>
#include <vector>

#include "pipeline/declaration/geometry_format.h"
#include "pipeline/files/vessel/freedom_matrix.h"

namespace blocklift::pipeline {

namespace given {

struct Vessel;

/// Buoyancy by its stiffness at rest, in place of that of the hull.
struct LinearBuoyancy {
  /// Of buoyancy and weight; none: that of the vessel's database, or of its hull at rest.
  std::optional<Located<FreedomMatrix>> stiffness;
  std::optional<Vector3> about;  ///< in the vessel's frame, m; none: its centre of mass
  Mark place;

  /// Of heave, roll and pitch; N/m, N, N m. Only if it is given.
  Eigen::Matrix3d given() const { return values_of(stiffness->value).block<3, 3>(2, 2); }
};

}  // namespace given

Format<given::LinearBuoyancy> linear_buoyancy_format();

/// Complains about vessels of which no linear buoyancy can be made: that no database tells the
/// waves' forces of, or that change their draught; whose database has no stiffness, or one that is
/// more than that of buoyancy and weight; that drift by the stiffness of their hull.
/// @param in_waves whether there are waves.
void check_linear_buoyancy(const std::vector<given::Vessel>& vessels, bool in_waves,
                           Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
