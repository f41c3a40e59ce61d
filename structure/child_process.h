#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "structure/packet.h"

namespace blocklift::structure {

/// What a child process may take at most.
struct ChildLimits {
  double seconds = 3600;  ///< of the processor
  double memory = 0;      ///< bytes more than this process has; 0: no limit
};

/// A child process came to no end of its own; the message says in which way, as the end of a
/// sentence: "was stopped after 60 s".
class ChildDied : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Does work that may crash or never end, for instance in a library that reads foreign files, in a
/// child process, and hands back what it makes there; nothing else of it is left here. What it
/// prints is dropped. Threads of this process do not exist in the child.
/// @param work its exceptions of kind std::exception are thrown here as ModelError with their text.
/// @throws ChildDied if the child crashes or exceeds its limits; ModelError if it cannot be
///   started.
Packet in_child_process(const std::function<Packet()>& work, const ChildLimits& limits);

/// In a child: from now on so many seconds of the processor are left, s.
void allow_processor_time(double seconds);

}  // namespace blocklift::structure
