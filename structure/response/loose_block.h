#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/error.h"
#include "structure/space/space.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {

/// A part of a block can move against the rest, and nothing resists.
class LooseBlock : public ModelError {
 public:
  /// Six rows, displacement and rotation: how the mesh's vertices (columns) move against most of
  /// the block, by any factor. Empty: it was not found.
  using Motion = Eigen::Matrix<double, 6, Eigen::Dynamic>;

  LooseBlock(const std::string& message, Motion the_motion)
      : ModelError(message), motion(std::move(the_motion)) {}
  Motion motion;
};

/// Says of a block that it is a mechanism, and where it moves most.
/// @param motion of a mechanism (freedoms), rigid motions of the whole in it or not.
/// @throws LooseBlock
[[noreturn]] void refuse_mechanism(const Space& space, const Eigen::VectorXd& motion);

/// The same where a factorisation failed: the motion is found by inverse iteration on a stiffness
/// that is raised by 1e-10 of its diagonal, which grows what nothing resists by 1e10 a step.
/// @param support that holds the block as a whole.
/// @throws LooseBlock
[[noreturn]] void refuse_mechanism(const Space& space, const std::vector<FixedUnknown>& support,
                                   const LooseUnknown& loose, int threads);

}  // namespace blocklift::structure
