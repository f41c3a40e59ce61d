#pragma once

#include <vector>

#include "pipeline/verification/verification.h"

namespace blocklift::pipeline {

/// Cases of the sea: hydrostatics and the panel method.
std::vector<VerificationCase> hydrodynamics_cases();

/// A cube that floats upright and heeled far over.
VerificationCase floating_cube();
/// Righting arms of a box to 180 degrees.
VerificationCase righting_arms_of_a_box();
/// Work of buoyancy round a closed path of poses.
VerificationCase closed_path_of_buoyancy();
/// Integrals over a flat panel against quadrature; solid angle of a closed body.
VerificationCase panel_integrals();
/// Added mass of a sphere deep under the surface.
VerificationCase deep_sphere();
/// Added mass and damping of a hemisphere over frequency, with convergence; energy; Ogilvie's
/// relations.
VerificationCase floating_hemisphere();
/// Surge and heave of a cylinder with a flat bottom, with their order of convergence.
VerificationCase truncated_cylinder();
/// Short waves beside long barges, in a long run, against the section in two dimensions.
VerificationCase long_barge();
/// Symmetry of two bodies' coefficients.
VerificationCase two_hemispheres();
/// Surge and heave of a cube on another one five waves away.
VerificationCase distant_cubes();
/// Diffraction directly and by Haskind's relation.
VerificationCase haskind_relation();
/// Excitation of a cylinder that stands on the bottom.
VerificationCase standing_cylinder();
/// Mean drift of a standing column; waves sent out against damping; energy at a free body.
VerificationCase mean_drift_of_waves();
/// A sphere that a current takes along.
VerificationCase drag_of_a_current();
/// A sphere in a regular wave over 1,000 periods.
VerificationCase thousand_periods();
/// Free decay of a floating sphere, directly and by Cummins' equation; steps of the convolution.
VerificationCase free_decay_of_a_sphere();
/// The shipped sphere from its file to a database's file, and its decay in a mechanism that names
/// it.
VerificationCase sphere_through_files();
/// A ring that slides along a spar, both bodies of one database, in regular waves: simulated from a
/// mechanism file against the same equations in the frequency domain.
VerificationCase bodies_at_a_joint();
/// Water that swings in a moonpool, without and with a lid that damps it.
VerificationCase moonpool();
/// Two barges with a gap between them: forces, and the resonance of its water.
VerificationCase barges_side_by_side();
/// Two pontoons and a ship across their bows, a launch, by both methods.
VerificationCase three_hulls();

}  // namespace blocklift::pipeline
