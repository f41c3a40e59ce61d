#pragma once

#include <memory>
#include <vector>

#include "pipeline/measures/measure.h"
#include "pipeline/measures/solids.h"

namespace blocklift::pipeline {

/// A surface whose distance from others can be found at any pose.
class Solid {
 public:
  explicit Solid(const std::vector<Triangle>& triangles);
  ~Solid();
  Solid(Solid&&) noexcept;
  Solid& operator=(Solid&&) noexcept;

  /// Smallest distance of two surfaces, m: zero where they touch or cut one another. One that lies
  /// within the other without touching it is as far as their surfaces are. Distances beyond `most`
  /// are `most`.
  static double distance(const Solid& a, const dynamics::Pose& X_WA, const Solid& b,
                         const dynamics::Pose& X_WB, double most);

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// Distances over the operation: of the load from cranes, vessels, hook blocks, spreaders, tackles,
/// and the ground ashore; of spreaders from cranes; of ropes from the crane that they hang on, but
/// for the body that carries them; of cranes from one another. Cranes are the boxes of their
/// drawing. At most 600 instants of a history are looked at, and values between them are linear;
/// beyond 20 m all is far.
void add_clearances(const LiftCase& lift_case, const LiftRun& lift,
                    std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
