#pragma once

#include <string>

#include "structure/response/unit_responses.h"

namespace blocklift::structure {

/// Writes a load case for ParaView: an XML file of VTK (`.vtu`, unstructured grid, binary).
///
/// Cells are divided along their long edges as often as the element's degree, so that cubic shapes
/// show; points of neighbouring cells are apart, so that stress jumps show. Point data:
/// `displacement` (m, relative to the mean rigid motion), `von_mises` (Pa). Cell data: `group`,
/// `material`, `plate` (numbers from 0; the names stand in the field data `group_names` and
/// `material_names`).
/// @throws ModelError if the file cannot be written.
void write_vtu(const std::string& path, const UnitResponses& responses, const LoadCase& load_case);

}  // namespace blocklift::structure
