#include "dynamics/simulation/state_projection.h"

#include <cmath>

#include "dynamics/errors.h"
#include "dynamics/multibody/assembly.h"
#include "dynamics/multibody/derivatives.h"
#include "dynamics/multibody/loop_diagnosis.h"

namespace blocklift::dynamics {

StateProjection::StateProjection(const LiftSystem& system, LiftWorkspace& w, double t)
    : system_(system) {
  find_quaternions();
  const Mechanism& m = system.mechanism();
  if (m.loops().empty()) return;
  set_drives(system, t, true, w);
  assemble(m, w.q, w.v);
  projector_.emplace(m);
  w.loop_rows = LoopRows::none(m);
  projected_.setZero(system.state_size());
  error_q_.setZero(m.nq());
  error_v_.setZero(m.nv());
  increment_.setZero(m.nv());
}

void StateProjection::find_quaternions() {
  const Mechanism& m = system_.mechanism();
  for (std::size_t i = 0; i < m.free_coordinates().size(); ++i) {
    for (const Body& body : m.bodies()) {
      const auto offset = quaternion_offset(body.joint.kind);
      if (!offset || body.parent < 0) continue;
      if (m.free_coordinates()[i] == body.q_offset + *offset) {
        quaternions_.push_back(static_cast<Eigen::Index>(i));
      }
    }
  }
}

bool StateProjection::leaves_nothing_free() const {
  return projector_ && projector_->independent_rows().count() >= system_.nv_free();
}

void StateProjection::project(double t, VectorRef y, LiftWorkspace& w) {
  for (const Eigen::Index i : quaternions_) y.segment<4>(i).normalize();
  if (!projector_) return;
  project_onto_loops(t, y, projected_, w);
  y.head(projected_.size()) = projected_;
}

bool StateProjection::calc_correction(double t, ConstVectorRef y, VectorRef correction,
                                      LiftWorkspace& w) {
  correction.setZero();
  if (projector_) {
    project_onto_loops(t, y, projected_, w);
    correction.head(projected_.size()) = projected_ - y.head(projected_.size());
    return true;
  }
  for (const Eigen::Index i : quaternions_) {
    const Vector4 quaternion = y.segment<4>(i);
    const double norm = quaternion.norm();
    if (!(norm > 0.0) || !std::isfinite(norm)) return false;
    correction.segment<4>(i) = quaternion / norm - quaternion;
  }
  return true;
}

void StateProjection::project_error(ConstVectorRef y, VectorRef error, const LiftWorkspace& w) {
  if (projector_) return remove_what_opens_loops(error, w);
  for (const Eigen::Index i : quaternions_) {
    const Vector4 unit = y.segment<4>(i).normalized();
    auto e = error.segment<4>(i);
    e -= (unit.dot(e) * unit).eval();
  }
}

// The state that belongs to `y` on the loops, and which rows are independent there.
void StateProjection::project_onto_loops(double t, ConstVectorRef y, VectorRef projected,
                                         LiftWorkspace& w) {
  set_state(system_, y, w);
  set_drives(system_, t, true, w);
  if (!projector_->project_positions(w.q) || !projector_->project_velocities(w.v)) {
    throw SimulationError(describe_failure());
  }
  *w.loop_rows = projector_->independent_rows();
  get_state(system_, w.q, w.v, projected);
  const Eigen::Index memory = system_.memory_count();
  const Eigen::Index first = system_.nq_free() + system_.nv_free();
  projected.segment(first, memory) = y.segment(first, memory);
}

std::string StateProjection::describe_failure() const {
  const std::string missing =
      describe_residual(system_.mechanism(), projector_->state().residual, 1e-9);
  return missing != "none" ? "the loops cannot be closed near by; they miss: " + missing
                           : "a drive moves as the loops forbid";
}

// Takes out of an error (state_size) what is not along the loops at the last projection.
void StateProjection::remove_what_opens_loops(VectorRef error, const LiftWorkspace& w) {
  const Mechanism& m = system_.mechanism();
  error_q_.setZero();
  error_v_.setZero();
  Eigen::Index i = 0;
  for (const int k : m.free_coordinates()) error_q_[k] = error[i++];
  for (const int k : m.free_velocities()) error_v_[k] = error[i++];
  for (const Link& link : m.links()) {
    if (velocities_are_rates(link.kind)) {
      increment_.segment(link.v_offset, link.nv) = error_q_.segment(link.q_offset, link.nv);
      continue;
    }
    const int nq = coordinate_count(link.kind);
    Eigen::Matrix<double, 6, 7> map;
    auto increments = map.topLeftCorner(link.nv, nq);
    joint_increments(link.kind, w.q.data() + link.q_offset, increments);
    increment_.segment(link.v_offset, link.nv).noalias() =
        increments * error_q_.segment(link.q_offset, nq);
  }
  for (const ElasticMode& mode : m.elastic_modes()) {
    increment_[mode.v_index] = error_q_[mode.q_index];
  }
  projector_->remove_normal_part(increment_);
  projector_->remove_normal_part(error_v_);
  m.calc_rates(w.q, increment_, error_q_);
  get_state(system_, error_q_, error_v_, error);
}

}  // namespace blocklift::dynamics
