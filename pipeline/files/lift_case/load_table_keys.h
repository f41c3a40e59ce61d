#pragma once

#include "pipeline/declaration/document.h"

namespace blocklift::pipeline {

/// Complains, each at its line, about the keys of a case with a load table that nothing would read:
/// those of cranes, ropes and water, of the motion, and of limits and rules that need a motion.
void check_keys_beside_load_table(const Document& document, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
