#pragma once

#include <filesystem>
#include <string>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// A deck as an Abaqus input file without parts, in the deck's own numbers and units.
///
/// Shells become S4, S3, S8R, STRI65; beams B31 of general sections (one for each section,
/// orientation and offset), released by *RELEASE; rods T3D2, which lack torsion; links couplings;
/// masses away from their vertex hang on a node of their own. Load cases become steps that each
/// state all supports and loads anew, temperatures among them (AbaqusTemperatureText).
///
/// @throws ModelError for what no keyword says: laminates, quadratic pyramids, beams with other
///   offsets at either end or released against displacement, springs with arms, links that bind a
///   part of the displacements or rotations along axes of their own.
std::string to_abaqus(const Deck& deck);

/// @throws ModelError also if the file cannot be written.
void write_abaqus(const Deck& deck, const std::filesystem::path& path);

}  // namespace blocklift::structure
