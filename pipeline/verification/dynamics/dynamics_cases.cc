#include "pipeline/verification/dynamics/dynamics_cases.h"

#include <utility>

#include "pipeline/verification/dynamics/mechanism_benchmark.h"

namespace blocklift::pipeline {

std::vector<VerificationCase> dynamics_cases(const ModelLibrary& library) {
  std::vector<VerificationCase> cases = {open_chains(), random_trees(), load_on_a_rope(),
                                         hoisted_pendulum(), block_on_six_ropes()};
  Diagnostics diagnostics;
  for (const std::filesystem::path& file : library.files_of("benchmarks", "reference.yaml")) {
    std::optional<BenchmarkReference> reference = read_benchmark_reference(file, diagnostics);
    if (reference) cases.push_back(mechanism_benchmark(std::move(*reference)));
  }
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return cases;
}

}  // namespace blocklift::pipeline
