#pragma once

namespace blocklift::pipeline {

/// Version of the program, as results carry it.
extern const char* const program_version;

}  // namespace blocklift::pipeline
