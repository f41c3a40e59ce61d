#include "dynamics/multibody/loop_projection.h"

#include <cmath>
#include <limits>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

// Residual at which positions count as on the constraint (m, rad), and what rounding may leave of
// it where numbers are large.
constexpr double on_constraint = 1e-14;
constexpr double stalled_on_constraint = 1e-11;
constexpr int most_iterations = 12;
// Nearer to a toggle position than this the row that is being lost is left alone: dividing by what
// is left of it would turn rounding (1e-16) into moves that an integrator takes for errors, and it
// can be missed by the square of this only.
constexpr double lost_row = 1e-5;
// Velocity of a row that no free velocity can take up, relative to 1 m/s or the velocities there
// are.
constexpr double no_conflict = 1e-9;

}  // namespace

LoopProjector::LoopProjector(const Mechanism& mechanism, const Eigen::VectorXd& weights)
    : mechanism_(mechanism),
      kinematics_(mechanism),
      state_(mechanism),
      all_(LoopRows::all(mechanism)),
      independent_(LoopRows::none(mechanism)),
      jacobian_(Eigen::MatrixXd::Zero(mechanism.loop_row_count(), mechanism.nv())),
      qr_(static_cast<Eigen::Index>(mechanism.free_velocities().size()),
          mechanism.loop_row_count()),
      group_(static_cast<std::size_t>(mechanism.loop_row_count())),
      inverse_root_weight_(Eigen::VectorXd::Ones(qr_.rows())),
      zero_v_(Eigen::VectorXd::Zero(mechanism.nv())),
      move_(zero_v_),
      right_(Eigen::VectorXd::Zero(mechanism.loop_row_count())),
      free_move_(Eigen::VectorXd::Zero(qr_.rows())) {
  for (int row = 0; row < mechanism.loop_row_count(); ++row) {
    angles_.push_back(mechanism.loop_row_is_angle(row) ? 1 : 0);
  }
  if (weights.size() == 0) return;
  if (weights.size() != mechanism.nv() || !(weights.minCoeff() > 0.0) || !weights.allFinite()) {
    throw ModelError("weights of a projection onto loops: one positive number for each of the " +
                     std::to_string(mechanism.nv()) + " velocities is due");
  }
  Eigen::Index i = 0;
  for (const int k : mechanism.free_velocities()) {
    inverse_root_weight_[i++] = 1.0 / std::sqrt(weights[k]);
  }
}

void LoopProjector::evaluate(ConstVectorRef q) {
  compute_kinematics(mechanism_, q, zero_v_, kinematics_);
  compute_loops(mechanism_, kinematics_, q, zero_v_, state_);
}

double LoopProjector::largest_residual() const {
  return state_.residual.size() == 0 ? 0.0 : state_.residual.lpNorm<Eigen::Infinity>();
}

void LoopProjector::factorise(const LoopRows& rows, double threshold) {
  const Eigen::Index m = rows.count();
  auto G = jacobian_.topRows(m);
  calc_loop_jacobian(mechanism_, kinematics_, state_, rows.slot, G);
  auto transposed = qr_.columns(m);
  Eigen::Index i = 0;
  for (const int k : mechanism_.free_velocities()) {
    transposed.row(i) = inverse_root_weight_[i] * G.col(k).transpose();
    ++i;
  }
  for (Eigen::Index row = 0; row < m; ++row) {
    const auto slot = static_cast<std::size_t>(row);
    group_[slot] = angles_[rows.rows[slot]];
  }
  qr_.factorise(m, group_, threshold);
}

// Newton's method on the given rows until the residuals of all vanish.
bool LoopProjector::iterate(const LoopRows& rows, double threshold, VectorRef q) {
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const double residual = largest_residual();
    if (residual <= on_constraint) return true;
    if (!(residual < 0.5 * last)) return residual <= stalled_on_constraint;
    last = residual;
    factorise(rows, threshold);
    for (Eigen::Index row = 0; row < rows.count(); ++row) {
      right_[row] = -state_.residual[rows.rows[row]];
    }
    free_move_.setZero();
    qr_.correct(right_.head(rows.count()), free_move_);
    Eigen::Index i = 0;
    for (const int k : mechanism_.free_velocities()) {
      move_[k] = inverse_root_weight_[i] * free_move_[i];
      ++i;
    }
    mechanism_.integrate(q, move_, 1.0, q);
    evaluate(q);
  }
  return largest_residual() <= stalled_on_constraint;
}

void LoopProjector::look(ConstVectorRef q) {
  evaluate(q);
  factorise(all_, redundancy_threshold);
  independent_.choose(all_, qr_.pivots(), qr_.rank());
}

bool LoopProjector::project_positions(VectorRef q) {
  evaluate(q);
  // Rows that repeat others follow by themselves as long as the others still imply them.
  bool done = independent_.count() > 0 && iterate(independent_, lost_row, q);
  if (!done) done = iterate(all_, lost_row, q);
  if (!done) return false;
  factorise(all_, lost_row);
  independent_.choose(all_, qr_.pivots(), qr_.rank());
  return true;
}

bool LoopProjector::project_velocities(VectorRef v) {
  const Eigen::Index m = all_.count();
  right_.noalias() = jacobian_ * v;
  right_ *= -1.0;
  free_move_.setZero();
  qr_.correct(right_, free_move_);
  Eigen::Index i = 0;
  for (const int k : mechanism_.free_velocities()) {
    v[k] += inverse_root_weight_[i] * free_move_[i];
    ++i;
  }
  if (m == 0) return true;
  right_.noalias() = jacobian_ * v;
  const double size = std::max(1.0, v.lpNorm<Eigen::Infinity>());
  return right_.lpNorm<Eigen::Infinity>() <= no_conflict * size;
}

void LoopProjector::remove_normal_part(VectorRef v) {
  Eigen::Index i = 0;
  for (const int k : mechanism_.free_velocities()) {
    free_move_[i] = v[k] / inverse_root_weight_[i];
    ++i;
  }
  right_.setZero();
  qr_.correct(right_, free_move_);
  for (const int k : mechanism_.driven_velocities()) v[k] = 0.0;
  i = 0;
  for (const int k : mechanism_.free_velocities()) {
    v[k] = inverse_root_weight_[i] * free_move_[i];
    ++i;
  }
}

void LoopProjector::balance(VectorRef f, VectorRef lambda) {
  right_.setZero();
  qr_.correct(right_, f);
  qr_.multipliers(lambda);
}

}  // namespace blocklift::dynamics
