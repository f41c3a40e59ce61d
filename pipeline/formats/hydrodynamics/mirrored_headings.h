#pragma once

#include <string>

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::pipeline {

/// Adds the waves that a file leaves out because a plane of symmetry gives them: with y = 0,
/// headings from 0 to 180 degrees make a whole turn; with x = 0, too, those from 0 to 90. Forces
/// and mean drift of the mirrored waves are the mirror images; headings then ascend from 0. A far
/// field, which no file of another program holds, is not mirrored.
///
/// Nothing is changed of several bodies, of headings that go round already or would not even so
/// (gaps of 45 degrees at most), and of a body that is not symmetric as far as its figures tell:
/// its reference point lies in the plane, what couples modes along the plane and across it is
/// within 1 % of the root of both modes' own radiation forces, and waves along the plane, of which
/// there are some, press it across by no more than 1 % of what any wave does to a mode of that kind
/// (displacements or rotations).
/// @return the planes, "y = 0" or "y = 0 and x = 0"; empty: nothing was changed.
std::string mirror_headings(dynamics::HydrodynamicDatabase& database);

}  // namespace blocklift::pipeline
