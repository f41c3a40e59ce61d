#include "pipeline/verification/structure/structure_cases.h"

#include <utility>

namespace blocklift::pipeline {

std::vector<VerificationCase> structure_cases(const ModelLibrary& library) {
  std::vector<VerificationCase> cases = {lifted_block(), error_estimate(library)};
  for (VerificationCase& part : part_cases(library)) cases.push_back(std::move(part));
  return cases;
}

}  // namespace blocklift::pipeline
