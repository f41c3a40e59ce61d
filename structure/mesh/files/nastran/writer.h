#pragma once

#include <filesystem>
#include <string>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// A deck as Nastran bulk data with case control (SOL 101), in the deck's own numbers and units.
///
/// Numbers of elements that several share, or that are not given, are new ones beyond the greatest.
/// Fields are small where all of a card's values are short, else large: reals keep eleven digits.
/// Cards: GRID, CORD2R, CQUAD4, CQUAD8, CTRIA3, CTRIA6, PSHELL (laminates by MAT2), MAT1, CBAR,
/// CBEAM (where the shear centre is not the centroid), CROD, CONM2, RBE2, RBE3, CELAS2, CBUSH
/// (springs with arms), CTETRA, CPENTA, CHEXA, CPYRAM, PSOLID, MAT9, SPC1, SPC, FORCE, MOMENT,
/// PLOAD4, PLOAD1, GRAV, LOAD.
///
/// @throws ModelError for what no card says: shells without section or curved beyond quadratic,
///   temperatures (write_abaqus has them), supports along different axes at a vertex, springs whose
///   arms do not meet.
std::string to_nastran(const Deck& deck);

/// @throws ModelError also if the file cannot be written.
void write_nastran(const Deck& deck, const std::filesystem::path& path);

}  // namespace blocklift::structure
