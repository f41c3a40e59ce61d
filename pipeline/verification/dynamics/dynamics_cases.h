#pragma once

#include <vector>

#include "pipeline/files/library/model_library.h"
#include "pipeline/verification/verification.h"

namespace blocklift::pipeline {

/// Cases of the dynamics. Those written in code are declared below; mechanisms with references,
/// which are files, follow from the library's benchmarks.
std::vector<VerificationCase> dynamics_cases(const ModelLibrary& library);

/// Open chains of revolute joints let go at rest: accelerations.
VerificationCase open_chains();
/// Forward dynamics, inverse dynamics and mass matrix against each other on random trees.
VerificationCase random_trees();
/// A load on one elastic rope: closed forms.
VerificationCase load_on_a_rope();
/// A load that swings while it is hoisted.
VerificationCase hoisted_pendulum();
/// An 860 t block hoisted on six ropes.
VerificationCase block_on_six_ropes();

}  // namespace blocklift::pipeline
