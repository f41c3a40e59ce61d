#pragma once

#include "dynamics/multibody/mechanism.h"

namespace blocklift::dynamics {

struct AssemblySettings {
  /// nv, positive: what it costs to move each coordinate away from the start, and each velocity
  /// from its own; empty: 1 each. Large where a value is meant to be kept.
  Eigen::VectorXd weights = {};
  int largest_iterations = 200;  ///< of one attempt
  int attempts = 12;  ///< further starts, turned and displaced at random, where the first fails
};

/// Moves the free coordinates of q (nq) to the closest configuration that closes all loops; driven
/// ones stay. Does nothing to a mechanism without loops.
///
/// Levenberg and Marquardt's method on the residuals, then along the constraint towards the start
/// until nothing is gained. Where that ends in a dead point, other starts nearby are tried (always
/// the same ones), and the closest of the first that succeed is taken.
/// @throws SimulationError if no attempt succeeds: by how much each loop misses (m, rad) at the
/// best, and which loop the others would close without.
void assemble(const Mechanism& mechanism, VectorRef q, const AssemblySettings& settings = {});

/// The same, and the closest free velocities v (nv) that the loops and the driven ones allow.
/// @throws SimulationError further if driven velocities contradict the loops, naming both.
void assemble(const Mechanism& mechanism, VectorRef q, VectorRef v,
              const AssemblySettings& settings = {});

/// By how much each loop misses, for messages: "loop "B" by 0.12 m and 0.3 rad, ..."; only those
/// that miss by more than `tolerance`.
std::string describe_residual(const Mechanism& mechanism, ConstVectorRef residual,
                              double tolerance);

}  // namespace blocklift::dynamics
