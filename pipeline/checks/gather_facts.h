#pragma once

#include "pipeline/checks/assessment.h"
#include "pipeline/standards/lift_facts.h"

namespace blocklift::pipeline {

/// What a finished run knows that standards ask for. The case names rules.
LiftFacts gather_facts(const Assessment& assessment);

}  // namespace blocklift::pipeline
