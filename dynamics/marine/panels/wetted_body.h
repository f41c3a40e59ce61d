#pragma once

#include "dynamics/marine/hull/hull.h"
#include "dynamics/marine/panels/panel_model.h"

namespace blocklift::dynamics {

/// The part of a hull that is under water at a pose, as panels for the panel method.
///
/// Each of the hull's panels is cut at z = 0; what is left is divided into quadrangles and
/// triangles. Panels that are not flat to a hundredth of their size are divided into the hull's
/// triangles first, and so are those that touch the water line and are not flat at all: its edges
/// then meet exactly. Vertices nearer to the surface than a thousandth of their smallest panel's
/// size are moved onto it, so that no slivers arise. Where two of the hull's panels lie on each
/// other, one from either side, the hull has no thickness, and both are left out. `p_BoR_B` is the
/// point about which rotations and moments are taken (m).
/// @throws ModelError if nothing is under water.
WettedBody make_wetted_body(const Hull& hull, const Pose& X_WB,
                            const Vector3& p_BoR_B = Vector3::Zero());

}  // namespace blocklift::dynamics
