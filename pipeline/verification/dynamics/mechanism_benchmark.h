#pragma once

#include "pipeline/verification/dynamics/benchmark_reference.h"
#include "pipeline/verification/verification.h"

namespace blocklift::pipeline {

/// A mechanism file with its reference as a case of the suite: figures, bounds, convergence, and
/// forward against inverse dynamics along the motion.
VerificationCase mechanism_benchmark(BenchmarkReference reference);

}  // namespace blocklift::pipeline
