#pragma once

#include <memory>
#include <string>

#include "pipeline/formats/mapped_file.h"
#include "pipeline/lift/lift_run.h"
#include "structure/accuracy/accuracy.h"
#include "structure/envelope/stress_basis.h"

namespace blocklift::pipeline {

/// Where the refinement of a block's mesh stands.
struct KeptRefinement {
  double first_elastic_period = 0;  ///< on the mesh that was begun with, s
  structure::RefinementState state;
};

/// Finished stages of a lift as bytes (kept_values.h), and back: bit for bit what they were.
/// The functions that read throw std::runtime_error for bytes that are of something else.
std::string bytes_of_flexibility(const LoadFlexibility& flexibility);
LoadFlexibility flexibility_of(const std::string& bytes);

/// All but the model, which is made again.
std::string bytes_of_motion(const LiftRun& run);
/// @param model of the case that the motion was of.
LiftRun motion_of(const std::string& bytes, BuiltLift model);

std::string bytes_of_stress_basis(const structure::StressBasis& basis);
/// The basis of a file of such bytes, into which it looks.
structure::StressBasis stress_basis_in(std::shared_ptr<const MappedFile> file);

std::string bytes_of_refinement(const KeptRefinement& refinement);
KeptRefinement refinement_of(const std::string& bytes);

}  // namespace blocklift::pipeline
