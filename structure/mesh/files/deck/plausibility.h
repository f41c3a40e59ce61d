#pragma once

#include "structure/mesh/files/deck/log.h"

namespace blocklift::structure {

/// Holds a material against what materials can be, so that a deck in other units than said is
/// found: a modulus between 1 MPa and 2 TPa, a density of no more than 100 t/m^3 (a remark beyond
/// 23 t/m^3: decks make materials heavier to meet a weight).
/// @param name such as "MAT1 3"
/// @param least_modulus Pa; less is another unit's.
/// @throws CardError naming the value in SI and the system of units.
void check_plausible(const Material& material, const std::string& name, const UnitSystem& units,
                     DeckLog& log, SourceLine line, double least_modulus = 1e6);

/// @throws CardError if Poisson's ratio is none that plates and solids can have. (Bars take E and G
/// apart, whatever ratio these stand for.)
void check_poisson_ratio(const Material& material, const std::string& name);

/// What is to be said of solids whose material depends on the direction.
std::string remark_on_directional_solids(int count);

}  // namespace blocklift::structure
