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

}  // namespace blocklift::structure
