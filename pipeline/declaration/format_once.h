#pragma once

namespace blocklift::pipeline {

/// The format that `make` puts together, made when it is first asked for and kept. A lift case has
/// a thousand keys: to declare them takes longer than to read a file, and studies read thousands.
template <auto make>
const auto& format_once() {
  static const auto format = make();
  return format;
}

}  // namespace blocklift::pipeline
