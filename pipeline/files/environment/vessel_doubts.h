#pragma once

#include <string>
#include <vector>

#include "pipeline/files/environment/marine_parts.h"

namespace blocklift::pipeline {

/// Sentences about what vessels are asked to do in their sea:
///   - all that float in waves without radiation, in one sentence: they have the waves' forces, and
///     neither added mass nor what waves damp, so that they are no forecast;
///   - each whose linear damping of surge or sway pulls it along with the current, b U, beside a
///     current_load, whose coefficients hold the whole mean force.
std::vector<std::string> doubts_about_vessels(const MarineParts& parts);

}  // namespace blocklift::pipeline
