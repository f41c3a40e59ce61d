#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/error.h"
#include "structure/space/space.h"
#include "structure/system/linear_solver.h"
#include "structure/system/sparse_matrix.h"

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

/// Solves for load vectors, a column each.
using SolveEquations = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& loads)>;
/// Factorises a stiffness with what holds it.
using FactoriseHeld = std::function<SolveEquations(const SparseLower& stiffness)>;

/// A motion that nothing resists where a factorisation failed, by any factor (freedoms): inverse
/// iteration on a stiffness that is raised by 1e-10 of its diagonal, which grows what nothing
/// resists by 1e10 a step. Empty: the raised one cannot be factorised either.
Eigen::VectorXd find_free_motion(const Space& space, const FactoriseHeld& factorise, int threads);

/// The freedom that moves most: a displacement, or a rotation where displacements are rounding
/// beside it, as of a bar that spins about its axis.
/// @param motion six rows a node
int most_moved_freedom(const Space& space, const Eigen::Ref<const Eigen::VectorXd>& motion);

/// Says of a block that it is a mechanism, and where it moves most.
/// @param motion of a mechanism (freedoms), rigid motions of the whole in it or not.
/// @throws LooseBlock
[[noreturn]] void refuse_mechanism(const Space& space, const Eigen::VectorXd& motion);

/// The same where a factorisation failed: the motion is found first.
/// @param support that holds the block as a whole.
/// @throws LooseBlock
[[noreturn]] void refuse_mechanism(const Space& space, const std::vector<FixedUnknown>& support,
                                   const LooseUnknown& loose, int threads);

}  // namespace blocklift::structure
