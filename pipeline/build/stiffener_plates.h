#pragma once

#include <string>
#include <vector>

#include "pipeline/files/structure/block_model.h"

namespace blocklift::pipeline {

/// What is to be known of stiffeners that are plates: a sentence for each row with its sheets and
/// how their area and second moment differ from the profile's, and a last one on what is checked of
/// them and what is not; copies of a row are named once. Empty without any.
std::vector<std::string> describe_stiffener_plates(const BlockModel& block);

}  // namespace blocklift::pipeline
