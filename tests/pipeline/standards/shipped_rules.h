#pragma once

#include <stdexcept>
#include <string>

#include "pipeline/files/library/model_library.h"

namespace blocklift::pipeline::test {

/// Rules of models/standards, by name. @throws std::runtime_error with the complaints.
inline StandardRules shipped_rules(const std::string& name) {
  ModelLibrary library({BLOCKLIFT_MODELS});
  Diagnostics diagnostics;
  const auto rules = library.load_standard({name, {}}, ".", diagnostics);
  if (diagnostics.has_errors()) throw std::runtime_error(diagnostics.to_text());
  return *rules;
}

}  // namespace blocklift::pipeline::test
