#pragma once

#include <optional>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// How PLOAD4 names a face of a solid: by a corner of it (G1), where the pressure P1 acts, and a
/// second corner that tells which of the faces there it is (G3 or G4):
/// - of a tetrahedron the one that is not on the face;
/// - of a face with four corners the opposite one;
/// - none for a triangle of a wedge;
/// - for a triangle of a pyramid the other corner that it has in common with the base.
/// Source: MSC Nastran, Quick Reference Guide, PLOAD4; that of pyramids' triangles as in Altair
/// OptiStruct's.
struct FaceGrids {
  int corner = 0;                            ///< vertex
  std::optional<int> second = std::nullopt;  ///< a vertex
};

/// Place among the faces of the solid's topology; -1: no face, or more than one, is named so.
int face_of(const Solid& solid, const FaceGrids& grids);

/// How a face is named whose pressures begin at its first corner.
FaceGrids grids_of_face(const Solid& solid, int face);

}  // namespace blocklift::structure
