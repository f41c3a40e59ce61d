#pragma once

#include <vector>

#include "structure/mesh/beams/sections.h"
#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

/// A keyword's blocks of one scope, with those that follow it and belong to it.
struct SectionBlocks {
  const AbaqusScope* scope = nullptr;
  const AbaqusBlock* block = nullptr;
  std::vector<const AbaqusBlock*> details;  ///< CENTROID, SHEAR CENTER, ...
};

/// What a beam's section says beside Mesh::beam_sections.
struct BeamShape {
  Profile profile;  ///< in the axes n1 (2) and n2 (3), its origin the beam's node
  int material = 0;
  Vector3 axis_2 = -Vector3::UnitZ();
};

/// Of a *BEAM SECTION: a shape by its dimensions. @throws CardError for what is wrong or not known.
BeamShape read_beam_section(AbaqusModel& model, const SectionBlocks& blocks);
/// Of a *BEAM GENERAL SECTION: figures or a shape, with moduli of its own or a material; sections
/// whose moduli agree share one. @throws CardError as above.
BeamShape read_general_beam_section(AbaqusModel& model, const SectionBlocks& blocks);

/// A beam of three nodes becomes two from node to node, which lie on one another where the middle
/// lies beyond an end along the line between the ends. @throws CardError there.
void refuse_folded_beam(long label, const Vector3& from, const Vector3& middle, const Vector3& to);

}  // namespace blocklift::structure
