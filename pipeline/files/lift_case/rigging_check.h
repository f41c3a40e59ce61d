#pragma once

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// Complains about ropes, spreaders and equalised hoists of a case that do not fit together. Parts
/// that could not be read are passed over.
void check_rigging(const LiftCase& lift_case, Diagnostics& diagnostics);

/// Complains about a rope that has a curve of tension and friction at its sheaves.
void check_curve_without_friction(const given::Rope& rope, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
