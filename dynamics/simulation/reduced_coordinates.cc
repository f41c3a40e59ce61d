#include "dynamics/simulation/reduced_coordinates.h"

#include <limits>

#include "dynamics/errors.h"
#include "dynamics/multibody/assembly.h"
#include "dynamics/multibody/derivatives.h"

namespace blocklift::dynamics {
namespace {

// Residual at which positions count as on the loops (m, rad), and what rounding may leave of it.
constexpr double on_loops = 1e-14;
constexpr double stalled_on_loops = 1e-11;
constexpr int most_iterations = 20;

}  // namespace

ReducedCoordinates::ReducedCoordinates(const LiftSystem& system)
    : system_(system),
      kinematics_(system.mechanism()),
      rows_(LoopRows::none(system.mechanism())),
      reference_(system.q_start()),
      basis_(Eigen::MatrixXd::Identity(system.nv_free(), system.nv_free())),
      normal_(system.nv_free(), 0),
      increment_(Eigen::VectorXd::Zero(system.mechanism().nv())) {
  if (system.mechanism().loops().empty()) return;
  projector_.emplace(system.mechanism());
  state_.emplace(system.mechanism());
}

void ReducedCoordinates::set_reference(VectorRef q) {
  if (projector_) {
    if (!projector_->project_positions(q)) assemble(system_.mechanism(), q);
    projector_->look(q);
    const RankRevealingQr& qr = projector_->factorisation();
    basis_ = qr.complement();
    normal_ = qr.range();
    rows_.choose(LoopRows::all(system_.mechanism()), qr.pivots(), qr.rank());
    evaluate(q);
  }
  reference_ = q;
  increment_.setZero();
}

// Loops, their Jacobian and its product with N at q.
void ReducedCoordinates::evaluate(ConstVectorRef q) {
  const Mechanism& mechanism = system_.mechanism();
  const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(mechanism.nv());
  compute_kinematics(mechanism, q, at_rest, kinematics_);
  compute_loops(mechanism, kinematics_, q, at_rest, *state_);
  jacobian_.resize(rows_.count(), mechanism.nv());
  calc_loop_jacobian(mechanism, kinematics_, *state_, rows_.slot, jacobian_);
  free_jacobian_ = jacobian_(Eigen::all, mechanism.free_velocities());
  if (rows_.count() > 0) gn_.factorise(free_jacobian_ * normal_);
}

// Newton's step in y that closes the loops: dy = -(G D N)^-1 g.
Eigen::VectorXd ReducedCoordinates::closing_move(const Eigen::MatrixXd& increments) {
  Eigen::VectorXd residual(rows_.count());
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    residual[i] = state_->residual[rows_.rows[i]];
  }
  return -algebra::LuFactors<double>(free_jacobian_ * increments * normal_).solve(residual);
}

Eigen::MatrixXd ReducedCoordinates::seen_along(const Eigen::MatrixXd& stiffness) {
  if (!projector_) {
    // The increments of few joints, those that turn about no fixed axis, are not just added up.
    const Eigen::MatrixXd moves = tangent();
    Eigen::MatrixXd seen = stiffness;
    for (Eigen::Index j = 0; j < moves.cols(); ++j) {
      for (Eigen::Index i = 0; i < moves.rows(); ++i) {
        const double beyond = moves(i, j) - (i == j ? 1.0 : 0.0);
        if (beyond != 0.0) seen.col(j) += beyond * stiffness.col(i);
      }
    }
    return seen;
  }
  return virtual_motions().transpose() * stiffness * tangent();
}

void ReducedCoordinates::move_to(const Eigen::VectorXd& z, VectorRef q) {
  const Mechanism& mechanism = system_.mechanism();
  const std::vector<int>& free = mechanism.free_velocities();
  Eigen::VectorXd moves = basis_ * z;
  increment_(free) = moves;
  mechanism.integrate(reference_, increment_, 1.0, q);
  if (!projector_) return;
  Eigen::MatrixXd increments(mechanism.nv(), mechanism.nv());
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    evaluate(q);
    const double miss = state_->residual.lpNorm<Eigen::Infinity>();
    if (miss <= on_loops || (!(miss < 0.5 * last) && miss <= stalled_on_loops)) return;
    if (!(miss < 2.0 * last) || rows_.count() == 0) break;
    last = miss;
    increment_jacobian(mechanism, increment_, increments);
    moves += normal_ * closing_move(increments(free, free));
    increment_(free) = moves;
    mechanism.integrate(reference_, increment_, 1.0, q);
  }
  throw SimulationError("the loops cannot be closed there; they miss: " +
                        describe_residual(mechanism, state_->residual, 1e-9));
}

Eigen::MatrixXd ReducedCoordinates::tangent() {
  const Mechanism& mechanism = system_.mechanism();
  const std::vector<int>& free = mechanism.free_velocities();
  Eigen::MatrixXd whole(mechanism.nv(), mechanism.nv());
  increment_jacobian(mechanism, increment_, whole);
  if (!projector_) return whole(free, free);
  const Eigen::MatrixXd increments = whole(free, free);
  Eigen::MatrixXd moves = basis_;
  if (rows_.count() > 0) {
    const Eigen::MatrixXd closed = free_jacobian_ * increments;
    moves -= normal_ * algebra::LuFactors<double>(closed * normal_).solve_columns(closed * basis_);
  }
  return increments * moves;
}

Eigen::MatrixXd ReducedCoordinates::virtual_motions() const {
  if (rows_.count() == 0) return basis_;
  return basis_ - normal_ * gn_.solve_columns(free_jacobian_ * basis_);
}

void ReducedCoordinates::balance(VectorRef f, VectorRef lambda) const {
  lambda.setZero();
  if (rows_.count() == 0) return;
  const Eigen::VectorXd normal_force = normal_.transpose() * f;
  Eigen::VectorXd chosen = gn_.solve_transposed(normal_force);
  chosen *= -1.0;
  f += free_jacobian_.transpose() * chosen;
  for (Eigen::Index i = 0; i < chosen.size(); ++i) {
    lambda[rows_.rows[i]] = chosen[i];
  }
}

void ReducedCoordinates::balance_at_reference(VectorRef f, VectorRef lambda) {
  if (projector_) projector_->balance(f, lambda);
}

double ReducedCoordinates::loop_force(int k, ConstVectorRef lambda) const {
  return projector_ ? projector_->jacobian().col(k).dot(lambda) : 0.0;
}

}  // namespace blocklift::dynamics
