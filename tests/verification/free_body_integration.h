#pragma once

#include "tests/verification/free_body_constraints.h"

namespace blocklift::free_bodies {

/// State of all bodies of a mechanism at the given times (s), the first of which is that of
/// `start`.
///
/// Unknowns are position, quaternion Q, velocity and angular velocity of every body, and the
/// multipliers lambda, mu, sigma of the stabilised index-2 form of Gear, Gupta and Leimkuhler
/// (1985):
///   dp/dt = v + G_v^T mu,   dQ/dt = 1/2 Q (0, w + G_w^T mu) + sigma Q,
///   m dv/dt = m g + G_v^T lambda,   I dw/dt + w x I w = G_w^T lambda,
///   g(p, Q) = 0,   G (v; w) = 0,   |Q|^2 = 1,
/// integrated by SUNDIALS' IDA (BDF of variable order) with a dense Jacobian by central
/// differences. Redundant equations are left out by a choice made at the start.
///
/// @param tolerance relative and absolute (m, rad, m/s, rad/s), local.
/// @throws std::runtime_error if IDA fails.
std::vector<State> integrate(const dynamics::Mechanism& mechanism,
                             const std::vector<dynamics::LoopDefinition>& loops, const State& start,
                             const std::vector<double>& times, double tolerance);

}  // namespace blocklift::free_bodies
