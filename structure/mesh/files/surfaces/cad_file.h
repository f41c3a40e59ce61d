#pragma once

#include <map>
#include <string>
#include <vector>

#include "structure/mesh/files/cad_unit.h"
#include "structure/mesh/files/surfaces/fragments.h"

namespace blocklift::structure {

/// What a geometry has for a block.
struct CadSurfaces {
  double length = 1;                  ///< of the unit of the model's coordinates, m
  std::map<int, std::string> groups;  ///< of surfaces, by tag
  std::map<int, std::string> curves;  ///< groups of curves that bound no surface, by tag
  int solids_left_out = 0;
};

/// Imports a file into Gmsh's current model. Solids are removed with their faces, or refused.
///
/// The group of a surface or a curve is the last part of its label in the file, else its colour
/// ("colour #ff0000"), else "surface 3" or "curve 3".
/// @param length of the unit that the user says the file has, m.
/// @throws ModelError if the file declares another unit, cannot be read, or has neither
///   surfaces nor curves.
CadSurfaces open_cad_file(const std::string& path, double length, bool leave_solids_out);

}  // namespace blocklift::structure
