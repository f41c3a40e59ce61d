#pragma once

#include <string>

#include "structure/mesh/diagnosis/diagnosis.h"

namespace blocklift::structure {

/// A drawing of a mesh seen from above a corner, as SVG: its outline (free edges, folds, joints of
/// several shells, changes of section), its beams, and a mark at each place of a finding, the first
/// of them with their numbers. Lines in front hide nothing.
///
/// It has no styles of a page's; `width` pixels wide, as high as the mesh asks.
std::string finding_picture(const Mesh& mesh, const Finding& finding, double width = 760);

}  // namespace blocklift::structure
