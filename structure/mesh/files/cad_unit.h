#pragma once

#include <string>

namespace blocklift::structure {

/// Is a file geometry that OpenCASCADE reads, by its ending: .step, .stp, .iges, .igs, .brep?
bool is_cad_file(const std::string& path);

/// Unit of length that a STEP or IGES file declares for its geometry, m; 0: none, as in BREP files.
/// Where it declares one OpenCASCADE turns the coordinates into millimetres.
///
/// Of a STEP file it is the unit of length of its first GLOBAL_UNIT_ASSIGNED_CONTEXT (ISO
/// 10303-41): an SI unit with a prefix, or one that is converted from another. Units of measured
/// properties, such as of a volume in cubic metres, are not those of the geometry.
double declared_length(const std::string& path);

}  // namespace blocklift::structure
