#pragma once

#include <optional>

#include "pipeline/build/build_lift.h"
#include "structure/response/unit_responses.h"

namespace blocklift::pipeline {

/// How the block of a case gives way at its lugs, from its structure: static condensation, and
/// natural modes where the settings ask for them; none if it is taken as rigid.
std::optional<LoadFlexibility> make_flexibility(const structure::UnitResponses& responses,
                                                const DynamicsSettings& settings);

}  // namespace blocklift::pipeline
