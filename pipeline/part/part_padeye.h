#pragma once

#include <vector>

#include "pipeline/checks/padeye_assessment.h"
#include "pipeline/files/structure/part_file.h"
#include "structure/mesh/padeye/padeye.h"
#include "structure/part/padeye_stress.h"

namespace blocklift::pipeline {

struct PartAssessment;

/// A part that is a padeye: what the hand formulae and the finite elements say of it, without
/// factors.
struct PartPadeye {
  structure::PadeyeFormulaInput input;
  structure::Vector3 force_P = structure::Vector3::Zero();  ///< of all pins on the hole, N
  std::vector<PadeyeFormulaAtWorst> formulas;  ///< strength under that force, then rules
  structure::PadeyeStress stress;
};

/// The mesh of a part's padeye, refinements included. @throws structure::ModelError if it would
/// have more than 256 elements around its hole.
structure::PadeyeMesh part_padeye_mesh(const PartFile& file);

/// Looks at the padeye of a solved part.
PartPadeye assess_part_padeye(const PartAssessment& assessment);

}  // namespace blocklift::pipeline
