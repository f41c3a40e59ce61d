#pragma once

#include <stdexcept>
#include <string>

namespace blocklift::structure {

/// The structural model is wrong or cannot be solved; the message says what was found, what is
/// allowed and what to change.
class ModelError : public std::runtime_error {
 public:
  explicit ModelError(const std::string& message) : std::runtime_error(message) {}
};

/// The model is sound but too large for the memory that is free.
class NotEnoughMemory : public ModelError {
 public:
  using ModelError::ModelError;
};

}  // namespace blocklift::structure
