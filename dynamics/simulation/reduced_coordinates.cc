#include "dynamics/simulation/reduced_coordinates.h"

#include "dynamics/errors.h"
#include "dynamics/multibody/assembly.h"
#include "dynamics/multibody/derivatives.h"

namespace blocklift::dynamics {

ReducedCoordinates::ReducedCoordinates(const LiftSystem& system)
    : system_(system),
      reference_(system.q_start()),
      basis_(Eigen::MatrixXd::Identity(system.nv_free(), system.nv_free())),
      increment_(Eigen::VectorXd::Zero(system.mechanism().nv())) {
  if (!system.mechanism().loops().empty()) projector_.emplace(system.mechanism());
}

void ReducedCoordinates::set_reference(VectorRef q) {
  if (projector_) {
    if (!projector_->project_positions(q)) assemble(system_.mechanism(), q);
    projector_->look(q);
    basis_ = projector_->factorisation().complement();
  }
  reference_ = q;
}

void ReducedCoordinates::move_to(const Eigen::VectorXd& z, VectorRef q) {
  const Mechanism& mechanism = system_.mechanism();
  Eigen::Index i = 0;
  const Eigen::VectorXd moves = basis_ * z;
  for (const int k : mechanism.free_velocities()) increment_[k] = moves[i++];
  mechanism.integrate(reference_, increment_, 1.0, q);
  if (projector_ && !projector_->project_positions(q)) {
    throw SimulationError("the loops cannot be closed there; they miss: " +
                          describe_residual(mechanism, projector_->state().residual, 1e-9));
  }
}

Eigen::MatrixXd ReducedCoordinates::tangent() {
  const Mechanism& mechanism = system_.mechanism();
  const std::vector<int>& free = mechanism.free_velocities();
  Eigen::MatrixXd whole(mechanism.nv(), mechanism.nv());
  increment_jacobian(mechanism, increment_, whole);
  Eigen::MatrixXd result = whole(free, free) * basis_;
  if (!projector_) return result;
  Eigen::VectorXd column = Eigen::VectorXd::Zero(mechanism.nv());
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    column(free) = result.col(j);
    projector_->remove_normal_part(column);
    result.col(j) = column(free);
  }
  return result;
}

void ReducedCoordinates::balance(VectorRef f, VectorRef lambda) {
  if (projector_) projector_->balance(f, lambda);
}

double ReducedCoordinates::loop_force(int k, ConstVectorRef lambda) const {
  return projector_ ? projector_->jacobian().col(k).dot(lambda) : 0.0;
}

}  // namespace blocklift::dynamics
