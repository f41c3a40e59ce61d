#include "pipeline/verification/shells/shell_cases.h"

#include <iterator>

namespace blocklift::pipeline {

std::vector<VerificationCase> shell_cases() {
  std::vector<VerificationCase> all;
  for (std::vector<VerificationCase>& some : std::vector<std::vector<VerificationCase>>{
           patch_cases(), plate_cases(), curved_shell_cases(), strip_cases(), membrane_cases(),
           vibration_cases(), nafems_cases(), girder_cases(), box_girder_cases(), frame_cases()})
    all.insert(all.end(), std::make_move_iterator(some.begin()),
               std::make_move_iterator(some.end()));
  return all;
}

}  // namespace blocklift::pipeline
