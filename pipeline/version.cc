#include "pipeline/version.h"

namespace blocklift::pipeline {

const char* const program_version = BLOCKLIFT_VERSION;

}  // namespace blocklift::pipeline
