#pragma once

#include "structure/stopwatch.h"

namespace blocklift::pipeline {

using structure::Stopwatch;

}  // namespace blocklift::pipeline
