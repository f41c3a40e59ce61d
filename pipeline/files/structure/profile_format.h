#pragma once

#include <optional>

#include "pipeline/declaration/format.h"
#include "pipeline/declaration/geometry_format.h"
#include "structure/mesh/beams/sections.h"

namespace blocklift::pipeline {

/// The profile of a stiffener or a bar by the shape's name and its measures; none after a
/// complaint.
Format<std::optional<structure::Profile>> profile_format();

/// Complains where a profile, unless it is round, has no direction towards which it stands.
void check_direction(const std::optional<structure::Profile>& profile,
                     const std::optional<Vector3>& towards, Reading& reading, const Mark& mark);

}  // namespace blocklift::pipeline
