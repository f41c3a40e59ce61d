#pragma once

namespace blocklift::pipeline {

/// Version of the program, as results carry it.
inline constexpr const char* program_version = BLOCKLIFT_VERSION;

}  // namespace blocklift::pipeline
