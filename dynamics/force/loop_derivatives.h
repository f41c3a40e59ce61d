#pragma once

#include "dynamics/force/force_derivatives.h"
#include "dynamics/multibody/loop_constraint.h"

namespace blocklift::dynamics {

/// Adds what the forces of the loops do by the motion while their multipliers lambda are held: the
/// part of d(G^T lambda)/dq that is not in the forces' held arms (see ForceDerivatives). Frames of
/// the base turn with it, rods and ropes with their points; gears have none. Exact off the
/// constraint too. `state`: of the same instant, from compute_loops. Does not allocate.
void add_loop_derivatives(const Mechanism& mechanism, const Kinematics& kinematics,
                          const LoopState& state, ConstVectorRef lambda,
                          ForceDerivatives& derivatives);

}  // namespace blocklift::dynamics
