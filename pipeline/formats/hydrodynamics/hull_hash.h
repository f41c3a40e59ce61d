#pragma once

#include "dynamics/marine/hull/hull.h"
#include "pipeline/formats/content_hash.h"

namespace blocklift::pipeline {

inline void add(ContentHash& hash, const dynamics::Vector3& v) {
  hash.add(std::span<const double>(v.data(), 3));
}

/// Vertices and panels of a hull; not its name.
inline void add(ContentHash& hash, const dynamics::Hull& hull) {
  for (const dynamics::Vector3& vertex : hull.vertices()) add(hash, vertex);
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    hash.add(static_cast<std::int64_t>(hull.panel(panel).size()));
    for (const int vertex : hull.panel(panel)) hash.add(static_cast<std::int64_t>(vertex));
  }
}

}  // namespace blocklift::pipeline
