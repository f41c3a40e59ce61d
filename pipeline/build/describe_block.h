#pragma once

#include <string>

#include "pipeline/files/structure/block_model.h"
#include "structure/mesh/plates/block_description.h"

namespace blocklift::pipeline {

/// The block as the structure's mesh generator takes it.
/// @param name of the block, for messages.
/// @param largest_element longest edge of an element, m.
structure::BlockDescription describe_block(const BlockModel& model, const std::string& name,
                                           double largest_element);

}  // namespace blocklift::pipeline
