#include "pipeline/verification/suite/suite.h"

#include <iterator>

#include "pipeline/verification/dynamics/dynamics_cases.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"
#include "pipeline/verification/shells/shell_cases.h"
#include "pipeline/verification/structure/structure_cases.h"

namespace blocklift::pipeline {

std::vector<VerificationCase> verification_suite(const ModelLibrary& library) {
  std::vector<VerificationCase> suite;
  for (std::vector<VerificationCase>& stage :
       std::vector<std::vector<VerificationCase>>{dynamics_cases(library), hydrodynamics_cases(),
                                                  structure_cases(library), shell_cases()}) {
    suite.insert(suite.end(), std::make_move_iterator(stage.begin()),
                 std::make_move_iterator(stage.end()));
  }
  return suite;
}

}  // namespace blocklift::pipeline
