#pragma once

#include <filesystem>
#include <string>

#include "pipeline/rigging/rig_lift.h"

namespace blocklift::pipeline {

/// The case file with the chosen slings as its ropes' models, the chosen spreader bars and, where
/// it has a standard, the chosen master links at its hooks, the sheaves of its slings
/// and (with rules for shackles) the chosen
/// shackles at its lugs. A sling is named where the case finds a model of
/// that name with the same breaking load, else its keys are written. Comments of the file are lost,
/// and places that share an anchor are written out where they change.
std::string rigged_case_text(const RiggedLift& rigged);

/// Writes that case, once it was read back without complaint.
/// @throws InputError if it cannot be read from there, for instance since models that lie beside
///   the case are not found beside the file; nothing is written then.
void write_rigged_case(const RiggedLift& rigged, const std::filesystem::path& file);

}  // namespace blocklift::pipeline
