#pragma once

#include <cstdint>

#include "dynamics/marine/green/panel_method.h"
#include "pipeline/formats/hydrodynamics/hull_hash.h"

namespace blocklift::pipeline {

/// Adds what tells databases of one method from those of another. Those of the marched surface keep
/// the names that they had before there was a choice.
inline void add(ContentHash& hash, dynamics::PanelMethod method) {
  if (method == dynamics::PanelMethod::marched_surface) return;
  hash.add("green function");
  hash.add(std::int64_t{dynamics::hull_method_version});
}

}  // namespace blocklift::pipeline
