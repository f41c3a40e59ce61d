#pragma once

#include <stdexcept>

namespace blocklift::dynamics {

/// The model cannot be what was meant: a wrong name, a negative mass, an axis without length.
/// The message says what was found, what is allowed, and which body it concerns.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The model is well formed, but the computation failed at some state: a singular pose, no
/// equilibrium.
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace blocklift::dynamics
