#pragma once

#include <filesystem>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// Reads an Abaqus input file (also CalculiX' dialect where it is the same): keywords with their
/// data, which may stand in a file of their own (INPUT = file), *INCLUDE of files, all of them
/// below the deck's folder, parts and instances shifted and turned, or none of them.
///
/// - *NODE, *NSET, *ELSET (GENERATE), *SURFACE of nodes, of shells' faces and edges and of solids'
///   faces, *TRANSFORM; *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY
/// - *TIE, *CONTACT PAIR that is tied
/// - *ELEMENT: S3, S4, S8, STRI65 and their kin, B31, B32, B33, PIPE31, PIPE32 (a quadratic beam is
///   two), T3D2, T3D3, MASS, ROTARYI, SPRING1, SPRING2, SPRINGA, rigid R3D3 and R3D4;
///   C3D4, C3D5, C3D6, C3D8, C3D10, C3D15, C3D20 and their kin
/// - *MATERIAL with ELASTIC (isotropic, LAMINA, ORTHOTROPIC, ENGINEERING CONSTANTS, ANISOTROPIC of
///   solids), DENSITY, the first stress of PLASTIC as yield stress; *ORIENTATION
/// - *SHELL SECTION with OFFSET and COMPOSITE, *BEAM SECTION (BOX, CIRC, I, L, PIPE, RECT), *BEAM
///   GENERAL SECTION with CENTROID, SHEAR CENTER, SECTION POINTS, TRANSVERSE SHEAR STIFFNESS,
///   *SOLID SECTION of trusses and solids, *MASS, *ROTARY INERTIA, *NONSTRUCTURAL MASS, *RELEASE
/// - *COUPLING with KINEMATIC or DISTRIBUTING (weighted by the area that nodes stand for), *RIGID
///   BODY, *MPC (BEAM; TIE and PIN of nodes at one place), *EQUATION that makes two freedoms at one
///   place equal
/// - *EXPANSION, *INITIAL CONDITIONS of temperatures, and *TEMPERATURE in steps
/// - *BOUNDARY, *STEP with *CLOAD, *DLOAD (P, PX, PY, PZ, GRAV), *DSLOAD (P); steps go on from the
///   ones before unless OP = NEW or PERTURBATION says otherwise
///
/// Solids are left out if so asked; what is printed or solved is in the ledger as left out; any
/// other keyword is an error.
///
/// @throws DeckError with file and line of everything that is wrong or cannot be honoured.
Deck read_abaqus(const std::filesystem::path& path, const UnitSystem& units,
                 const DeckOptions& options = {});

}  // namespace blocklift::structure
