#pragma once

#include <map>
#include <string>

#include "structure/mesh/files/thickening.h"

namespace blocklift::structure {

/// The quadrangles of Gmsh's current model as plates, in the file's unit of length; a geometry is
/// meshed first. Groups of curves and points become node sets.
/// @param thickness of each plate by the name of its physical group, in the file's unit.
/// @throws ModelError naming groups that are not there or hold no quadrangles, triangles (a plate
///   is meshed with quadrangles alone), elements of a higher order, and surfaces that no thickness
///   names.
PlateMesh collect_plates(const std::map<std::string, double>& thickness);

}  // namespace blocklift::structure
