#pragma once

#include "pipeline/files/lift_case/lift_case.h"

/// Key tables of the parts of a case that stand in sources of their own.
namespace blocklift::pipeline {

/// A point of a body of a lift, which may be given by its name alone.
Format<Located<RopePoint>> rope_point_format();

/// What the operator of a drive keeps, and what laws of Python see, at points in that format.
Format<given::Keep> keep_format(const Format<Located<RopePoint>>& point);
/// A law of a mechanism's drive, and what it sees, at such points.
Format<given::Keep> mechanism_law_format(const Format<Located<RopePoint>>& point);
/// A stage of a mechanism's operation, which ends with the last of its moves.
Format<given::Stage> steered_stage_format(const Format<given::Keep>& keeps);
/// What goes wrong.
Format<given::Fault> fault_format();

Format<DynamicsSettings> dynamics_format();
Format<StructureSettings> structure_format();
Format<CheckSettings> checks_format();

}  // namespace blocklift::pipeline
