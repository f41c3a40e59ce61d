#include "structure/response/flexibility.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "structure/error.h"
#include "structure/system/matter.h"

namespace blocklift::structure {

namespace {

constexpr int largest_steps = 60;

/// The block, free in space: projections onto what is no rigid motion.
class FreeBlock {
 public:
  explicit FreeBlock(const UnitResponses& responses) : responses_(responses) {
    const Eigen::Matrix3Xd& nodes = responses.model().space().nodes();
    const Vector3 centre = responses.model().mass_properties().centre_of_mass_B;
    rigid_.setZero(responses.model().freedoms(), 6);
    for (Eigen::Index n = 0; n < nodes.cols(); ++n) {
      rigid_.block<6, 6>(6 * n, 0).setIdentity();
      const Vector3 arm = nodes.col(n) - centre;
      for (int axis = 0; axis < 3; ++axis)
        rigid_.block<3, 1>(6 * n, 3 + axis) = Vector3::Unit(axis).cross(arm);
    }
    // The inertia of a rigid acceleration is a load that the model knows: M a = -f(a).
    const auto& loads = responses.model().inertia_loads();
    rigid_inertia_ = -loads.leftCols<6>();
    for (int axis = 0; axis < 3; ++axis)
      rigid_inertia_.col(3 + axis) += loads.leftCols<3>() * Vector3::Unit(axis).cross(centre);
    const Eigen::Matrix<double, 6, 6> gram = rigid_.transpose() * rigid_inertia_;
    const Eigen::LLT<Eigen::Matrix<double, 6, 6>> factor(gram);
    factor.matrixU().solveInPlace<Eigen::OnTheRight>(rigid_);
    factor.matrixU().solveInPlace<Eigen::OnTheRight>(rigid_inertia_);
  }

  const UnitResponses& responses() const { return responses_; }
  /// Loads with the inertia of the rigid acceleration that they give the block.
  Eigen::MatrixXd balanced(Eigen::MatrixXd loads) const {
    loads.noalias() -= rigid_inertia_ * (rigid_.transpose() * loads).eval();
    return loads;
  }
  /// Displacements less the mean rigid motion.
  Eigen::MatrixXd relative(Eigen::MatrixXd shapes) const {
    shapes.noalias() -= rigid_ * (rigid_inertia_.transpose() * shapes).eval();
    return shapes;
  }
  /// Displacements under balanced loads.
  Eigen::MatrixXd relax(const Eigen::MatrixXd& balanced_loads) const {
    return relative(responses_.solve(balanced_loads));
  }

 private:
  const UnitResponses& responses_;
  Eigen::MatrixXd rigid_;          // M-orthonormal
  Eigen::MatrixXd rigid_inertia_;  // M times that
};

/// M-orthonormal basis that grows by blocks, and the operator K^+ M on it.
class KrylovSpace {
 public:
  KrylovSpace(const FreeBlock& block, const Eigen::MatrixXd& start)
      : block_(block),
        mass_(mass_matrix(block.responses().model().space(),
                          block.responses().model().mass_properties())) {
    basis_.resize(start.rows(), 0);
    append(block.relative(start));
  }

  /// Applies the operator to the newest block. @returns false when the space is complete.
  bool grow() {
    const Eigen::Index size = basis_.cols(), width = size - newest_;
    Eigen::MatrixXd image = block_.relax(times_mass(basis_.rightCols(width)));
    const Eigen::MatrixXd share = basis_.transpose() * times_mass(image);
    operator_.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
    operator_.middleCols(newest_, width) = share;
    operator_.middleRows(newest_, width) = share.transpose();
    image.noalias() -= basis_ * share;
    coupling_ = append(std::move(image));
    return basis_.cols() > size;
  }

  /// Ritz values 1 / omega^2, the largest first, with relative residuals and vectors.
  struct Ritz {
    Eigen::VectorXd value, residual;
    Eigen::MatrixXd vectors;  // in the basis
  };
  Ritz ritz() const {
    const auto solved = algebra::symmetric_eigensystem(operator_);
    Ritz result;
    result.value = solved.values.reverse();
    result.vectors = solved.vectors.rowwise().reverse();
    const Eigen::Index width = coupling_.cols();
    result.residual = (coupling_ * result.vectors.bottomRows(width)).colwise().norm().transpose();
    result.residual.array() /= result.value.array();
    return result;
  }
  Eigen::MatrixXd shapes(const Eigen::MatrixXd& vectors) const {
    return basis_.leftCols(vectors.rows()) * vectors;
  }

 private:
  Eigen::MatrixXd times_mass(const Eigen::MatrixXd& shapes) const { return mass_ * shapes; }
  // Appends columns orthonormalised; what depends on the basis is left out. Returns the factor B of
  // columns = new basis B, of the part that is orthogonal to the old one.
  Eigen::MatrixXd append(Eigen::MatrixXd columns) {
    const Eigen::VectorXd before = (columns.array() * times_mass(columns).array()).colwise().sum();
    Eigen::MatrixXd factor = Eigen::MatrixXd::Identity(columns.cols(), columns.cols());
    const double negligible = 1e-24 * std::max(largest_, before.maxCoeff());
    largest_ = std::max(largest_, before.maxCoeff());
    for (int pass = 0; pass < 2; ++pass) {
      if (basis_.cols() > 0) columns -= basis_ * (basis_.transpose() * times_mass(columns)).eval();
      columns = block_.relative(std::move(columns));
      const auto gram =
          algebra::symmetric_eigensystem<Eigen::Dynamic>(columns.transpose() * times_mass(columns));
      Eigen::Index dependent = 0;
      while (dependent < columns.cols() && gram.values[dependent] <= (pass == 0 ? negligible : 0.1))
        ++dependent;
      const Eigen::Index kept = columns.cols() - dependent;
      const Eigen::VectorXd root = gram.values.tail(kept).cwiseSqrt();
      const Eigen::MatrixXd turn = gram.vectors.rightCols(kept);
      factor = (root.asDiagonal() * turn.transpose() * factor).eval();
      columns = (columns * turn * root.cwiseInverse().asDiagonal()).eval();
      if (kept == 0) break;
    }
    newest_ = basis_.cols();
    basis_.conservativeResize(Eigen::NoChange, newest_ + columns.cols());
    basis_.rightCols(columns.cols()) = columns;
    return factor;
  }

  const FreeBlock& block_;
  Eigen::SparseMatrix<double> mass_;
  Eigen::MatrixXd basis_, operator_, coupling_;
  Eigen::Index newest_ = 0;
  double largest_ = 0;
};

// Mixtures of the lugs' responses, whose shapes the lift excites, and noise, which no mode escapes.
Eigen::MatrixXd start_shapes(const UnitResponses& responses, int width) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto noise = [&] { return normal(random); };
  const Eigen::Index lug_forces = 3 * responses.model().lug_count();
  Eigen::MatrixXd shapes = Eigen::MatrixXd::NullaryExpr(responses.model().freedoms(), width, noise);
  if (lug_forces == 0) return shapes;
  const Eigen::MatrixXd responses_of_lugs = responses.displacements().leftCols(lug_forces) *
                                            Eigen::MatrixXd::NullaryExpr(lug_forces, width, noise);
  return responses_of_lugs + 1e-3 * responses_of_lugs.norm() / shapes.norm() * shapes;
}

FreeModes find_modes(const UnitResponses& responses, const FreeBlock& block, int count,
                     double residual) {
  const int width = std::clamp(count, 4, 8);
  KrylovSpace space(block, start_shapes(responses, width));
  for (int step = 0; step < largest_steps; ++step) {
    const bool complete = !space.grow();
    const KrylovSpace::Ritz ritz = space.ritz();
    if (ritz.value.size() < count) {
      if (complete) break;
      continue;
    }
    if (!complete && !(ritz.residual.head(count).maxCoeff() <= residual)) continue;
    if (!(ritz.value[count - 1] > 0)) break;
    return {ritz.value.head(count).cwiseSqrt().cwiseInverse(),
            space.shapes(ritz.vectors.leftCols(count))};
  }
  throw ModelError("the " + std::to_string(count) +
                   " lowest natural modes of the free block were not found; ask for fewer");
}

Eigen::MatrixXd positive_part(const Eigen::MatrixXd& symmetric) {
  const auto [values, vectors] = algebra::symmetric_eigensystem(symmetric);
  return vectors * values.cwiseMax(0).asDiagonal() * vectors.transpose();
}

}  // namespace

FreeModes find_free_modes(const UnitResponses& responses, int count, double residual) {
  if (count < 1) throw ModelError("at least one natural mode must be asked for");
  return find_modes(responses, FreeBlock(responses), count, residual);
}

LugFlexibility find_lug_flexibility(const UnitResponses& responses, int modes) {
  const FreeBlock block(responses);
  const Eigen::MatrixXd loads = block.balanced(responses.model().lug_loads());
  LugFlexibility result;
  result.compliance = loads.transpose() * block.relax(loads);
  result.compliance = (0.5 * (result.compliance + result.compliance.transpose())).eval();
  result.shapes.resize(loads.cols(), 0);
  result.residual_compliance = result.compliance;
  if (modes > 0) {
    const FreeModes free = find_modes(responses, block, modes, 1e-5);
    const Eigen::MatrixXd at_lugs = loads.transpose() * free.shapes;
    result.angular_frequencies = free.angular_frequencies;
    result.shapes = std::sqrt(responses.model().mass_properties().mass) * at_lugs;
    const Eigen::MatrixXd by_modes = at_lugs * free.angular_frequencies.cwiseInverse().asDiagonal();
    result.residual_compliance -= by_modes * by_modes.transpose();
  }
  result.residual_compliance = positive_part(result.residual_compliance);
  return result;
}

}  // namespace blocklift::structure
