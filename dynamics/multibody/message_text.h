#pragma once

#include <sstream>
#include <string>

namespace blocklift::dynamics {

/// A message made of its parts, each as a stream writes it.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

}  // namespace blocklift::dynamics
