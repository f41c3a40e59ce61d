#pragma once

#include <filesystem>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// Reads a Nastran deck: bulk data in free, small and large fields with its continuations, INCLUDE
/// of files below the deck's folder, and case control.
///
/// - GRID with input and output systems (CP, CD), CORD1 and CORD2 R, C, S
/// - CQUAD4, CQUAD8, CQUADR, CTRIA3, CTRIA6, CTRIAR with ZOFFS and thicknesses at corners (their
///   mean), PSHELL, PCOMP; MAT1, MAT2, MAT8. What is not one
///   isotropic material becomes a laminate, its nearest isotropic plate beside it
/// - CBAR, CBEAM with offsets and pin flags, CROD, CTUBE, CONROD; PBAR, PBARL, PBEAM, PBEAML (of
///   one section from end to end), PROD, PTUBE
/// - CHEXA, CPENTA, CTETRA, CPYRAM with and without middles of edges, PSOLID with CORDM; MAT9,
///   MAT11
/// - CONM1, CONM2, CMASS1, CMASS2 (of all three directions), NSM, NSM1, NSML, NSML1, NSMADD,
///   PARAM WTMASS; RBE1, RBE2, RBE3, RBAR, RROD, RTRPLT, RJOINT; MPC that resists no motion of the
///   whole, or holds one freedom; CELAS1, CELAS2, CBUSH, CBUSH1D, PELAS, PBUSH,
///   PBUSH1D; RSPLINE; CSHEAR with PSHEAR
/// - TEMP, TEMPD, TEMPP1, TEMPRB, with A and TREF of the materials, by TEMPERATURE of case control
/// - SPC, SPC1, SPCADD, SPCD, permanent constraints; FORCE and MOMENT with 1 and 2, PLOAD, PLOAD1
///   (of CBAR and CBEAM), PLOAD2, PLOAD4, GRAV, LOAD; SUBCASE
///
/// Solids are left out if so asked. Cards of aeroelasticity, optimisation, dynamics and the like
/// are in the ledger as left out; any other card is an error.
///
/// @throws DeckError with file and line of everything that is wrong or cannot be honoured.
Deck read_nastran(const std::filesystem::path& path, const UnitSystem& units,
                  const DeckOptions& options = {});

}  // namespace blocklift::structure
