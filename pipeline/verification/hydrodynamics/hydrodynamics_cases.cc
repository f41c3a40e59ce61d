#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"

namespace blocklift::pipeline {

std::vector<VerificationCase> hydrodynamics_cases() {
  return {floating_cube(),
          righting_arms_of_a_box(),
          closed_path_of_buoyancy(),
          panel_integrals(),
          deep_sphere(),
          floating_hemisphere(),
          truncated_cylinder(),
          long_barge(),
          two_hemispheres(),
          distant_cubes(),
          haskind_relation(),
          standing_cylinder(),
          mean_drift_of_waves(),
          drag_of_a_current(),
          thousand_periods(),
          free_decay_of_a_sphere(),
          sphere_through_files(),
          bodies_at_a_joint(),
          moonpool(),
          barges_side_by_side(),
          three_hulls()};
}

}  // namespace blocklift::pipeline
