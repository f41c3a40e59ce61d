#pragma once

#include <string>
#include <vector>

#include "dynamics/marine/hull/hull.h"
#include "pipeline/declaration/diagnostics.h"

namespace blocklift::pipeline {

/// A hull at its place.
struct PlacedHull {
  std::string name;  ///< "vessel B1"
  Mark mark;
  const dynamics::Hull* hull = nullptr;
  dynamics::Pose X_WB;
};

/// Complains, at the mark of the second, about each two hulls that cut each other, above or below
/// the water, or of which one holds the other.
void check_hulls_apart(const std::vector<PlacedHull>& hulls, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
