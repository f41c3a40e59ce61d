#pragma once

#include <optional>

#include "pipeline/declaration/format.h"
#include "structure/mesh/sections.h"

namespace blocklift::pipeline {

/// The profile of a stiffener or a bar by the shape's name and its measures; none after a
/// complaint.
Format<std::optional<structure::Profile>> profile_format();

}  // namespace blocklift::pipeline
