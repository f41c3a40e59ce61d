#pragma once

#include "dynamics/simulation/lift_system.h"
#include "tests/dynamics/multibody/sample_loops.h"

/// Systems with loops that several tests and benchmarks share.
namespace blocklift::dynamics::test {

/// Andrews' squeezer with its spring and drive moment over 0.03 s, from rest.
LiftSystem andrews(LoopKind kind);
/// Its configuration at 0.03 s, extrapolated in quadruple precision, in the order of
/// AndrewsSqueezer.
Eigen::VectorXd andrews_q_end();

/// A mechanism alone, under gravity, over a duration (s).
LiftSystem mechanism_alone(Mechanism mechanism, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                           double duration);

}  // namespace blocklift::dynamics::test
