#pragma once

namespace blocklift::structure {

/// Sets what the process may use in all, bytes, from now on; infinity to begin with.
void limit_memory(double bytes);
/// What is left of that limit, bytes, by what the process holds now; never negative.
double memory_within_limit();

}  // namespace blocklift::structure
