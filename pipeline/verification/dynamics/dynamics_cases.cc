#include "pipeline/verification/dynamics/dynamics_cases.h"

namespace blocklift::pipeline {

std::vector<VerificationCase> dynamics_cases(const ModelLibrary& /*library*/) {
  return {open_chains(), random_trees(), load_on_a_rope(), hoisted_pendulum(),
          block_on_six_ropes()};
}

}  // namespace blocklift::pipeline
