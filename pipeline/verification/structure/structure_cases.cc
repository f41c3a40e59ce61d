#include "pipeline/verification/structure/structure_cases.h"

namespace blocklift::pipeline {

std::vector<VerificationCase> structure_cases() {
  return {manufactured_solution(), clamped_plate(), nafems_le10()};
}

}  // namespace blocklift::pipeline
