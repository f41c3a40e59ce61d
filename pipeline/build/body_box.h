#pragma once

#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/mechanism/mechanism_parts.h"

namespace blocklift::pipeline {

/// The box around all plates of a block or its mesh, in its frame, as the drawing shows it.
BoxShape box_around(const BlockModel& block);
/// The box around a hull, in the vessel's frame, as the drawing shows it.
BoxShape box_around(const Vessel& vessel);
/// The box around what is lifted: a vessel or a block.
BoxShape box_around(const given::Load& load);

}  // namespace blocklift::pipeline
