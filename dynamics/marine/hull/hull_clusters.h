#pragma once

#include "dynamics/marine/hull/triangle_tree.h"

namespace blocklift::dynamics {

/// A hull made ready for fast evaluation. Immutable; may be shared by threads.
class HullClusters {
 public:
  /// @throws ModelError if the hull has no panels, is open or turned inwards, or has vertices that
  ///   are not finite (see diagnose).
  explicit HullClusters(const Hull& hull);

  const Hull& hull() const { return hull_; }
  const EnclosedVolume& enclosed() const { return enclosed_; }

  /// Its surface of few triangles, panels of one plane joined (join_flat_panels): for what is exact
  /// on any triangle, as the pressure of still water is.
  const TriangleTree& faces() const { return faces_; }

 private:
  Hull hull_;
  EnclosedVolume enclosed_;
  TriangleTree faces_;
};

}  // namespace blocklift::dynamics
