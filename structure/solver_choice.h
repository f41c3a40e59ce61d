#pragma once

namespace blocklift::structure {

enum class SolverMethod { automatic, direct, iterative };

/// How the equations of a part are to be solved.
struct SolverChoice {
  /// Automatic: directly if the factor fits into the memory, else iteratively.
  SolverMethod method = SolverMethod::automatic;
  double tolerance = 1e-12;  ///< of an iteration: residual over load
};

}  // namespace blocklift::structure
