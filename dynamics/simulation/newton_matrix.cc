#include "dynamics/simulation/newton_matrix.h"

#include <algorithm>

namespace blocklift::dynamics {

namespace {

// Place of the first free entry that is not less than `index` among the free ones.
Eigen::Index place(const std::vector<int>& free, int index) {
  return std::lower_bound(free.begin(), free.end(), index) - free.begin();
}

}  // namespace

NewtonMatrix::NewtonMatrix(const LiftSystem& system)
    : tangent_(system),
      matrix_(system.nv_free(), system.nv_free()),
      factor_(system.nv_free()),
      right_(system.nv_free()),
      solution_(system.nv_free()),
      moved_(Eigen::VectorXd::Zero(system.nv_free())),
      x_q_(system.nq_free()) {
  const Mechanism& m = system.mechanism();
  if (!m.loops().empty()) loops_.emplace(system);
  if (system.water()) {
    response_.resize(system.memory_count(), system.water()->inertia().size());
    impedance_.resize(response_.cols(), response_.cols());
    by_velocity_.resize(response_.cols(), system.nv_free());
    memory_.resize(response_.rows(), 1);
    frames_.resize(response_.cols());
  }
  for (std::size_t i = 0; i < m.links().size(); ++i) {
    const Link& link = m.links()[i];
    const bool rates = velocities_are_rates(link.kind);
    for (int k = 0; rates && k < link.nv; ++k) {
      const int velocity = link.v_offset + k;
      if (m.driven()[velocity]) continue;
      plain_q_.push_back(place(m.free_coordinates(), link.q_offset + k));
      plain_v_.push_back(place(m.free_velocities(), link.v_offset + k));
    }
    if (rates || m.driven()[link.v_offset]) continue;
    Joint& joint = joints_.emplace_back();
    joint.link = static_cast<int>(i);
    joint.q = place(m.free_coordinates(), link.q_offset);
    joint.v = place(m.free_velocities(), link.v_offset);
    joint.nq = coordinate_count(link.kind);
    joint.nv = link.nv;
  }
  for (const ElasticMode& mode : m.elastic_modes()) {
    plain_q_.push_back(place(m.free_coordinates(), mode.q_index));
    plain_v_.push_back(place(m.free_velocities(), mode.v_index));
  }
}

void NewtonMatrix::set_point(const LiftSystem& system, double t, LiftWorkspace& w) {
  calc_tangent_matrices(system, t, w, tangent_);
  if (system.water()) system.water()->calc_output(tangent_.water_shares, output_);
  if (loops_) {
    loops_->calc(system, w);
    // As many rows as are independent: this changes at most where the mechanism passes a toggle.
    const Eigen::Index size = system.nv_free() + loops_->row_count();
    if (matrix_.rows() != size) {
      matrix_.resize(size, size);
      right_.resize(size);
      solution_.resize(size);
    }
  }
  for (Joint& joint : joints_) {
    const Link& link = system.mechanism().links()[joint.link];
    joint_rate_derivatives(link.kind, w.q.data() + link.q_offset, w.v.data() + link.v_offset,
                           joint.rates_by_q.topLeftCorner(joint.nq, joint.nq),
                           joint.rates_by_v.topLeftCorner(joint.nq, joint.nv));
    joint_increments(link.kind, w.q.data() + link.q_offset,
                     joint.increments.topLeftCorner(joint.nv, joint.nq));
  }
}

// result += factor by_increments Z.
void NewtonMatrix::multiply_by_Z(double factor,
                                 const Eigen::Ref<const Eigen::MatrixXd>& by_increments,
                                 Eigen::Ref<Eigen::MatrixXd> result) const {
  result += factor * by_increments;
  for (const Joint& joint : joints_) {
    const auto columns = by_increments.middleCols(joint.v, joint.nv);
    for (int j = 0; j < joint.nv; ++j) {
      for (int i = 0; i < joint.nv; ++i) {
        const double beyond = joint.Z(i, j) - (i == j ? 1.0 : 0.0);
        if (beyond != 0.0) result.col(joint.v + j) += (factor * beyond) * columns.col(i);
      }
    }
  }
}

// motion += gamma^2 J^T C R B J.
void NewtonMatrix::eliminate_memory(const RadiatedWater& water, double gamma,
                                    Eigen::Ref<Eigen::MatrixXd> motion) {
  const DraughtShares& shares = tangent_.water_shares;
  water.calc_resolvent(gamma, resolvent_);
  water.calc_input(shares, response_);
  impedance_.setZero();
  for (const RadiatedWater::Section& s : water.sections()) {
    if (shares.gain[s.draught] == 0.0) continue;
    auto response = response_.middleRows(s.first, s.count);
    water.apply(resolvent_, s, response);
    impedance_.noalias() += output_.middleCols(s.first, s.count) * response;
  }
  by_velocity_.noalias() = impedance_ * tangent_.frame_jacobian;
  motion.noalias() += (gamma * gamma) * (tangent_.frame_jacobian.transpose() * by_velocity_);
}

bool NewtonMatrix::factorise(const LiftSystem& system, double gamma) {
  gamma_ = gamma;
  for (Joint& joint : joints_) {
    const int nq = joint.nq;
    const int nv = joint.nv;
    Eigen::Matrix<double, 7, 7> kinematics = Eigen::Matrix<double, 7, 7>::Identity();
    kinematics.topLeftCorner(nq, nq) -= gamma * joint.rates_by_q.topLeftCorner(nq, nq);
    joint.inverse = kinematics.inverse();
    joint.Z.topLeftCorner(nv, nv) = joint.increments.topLeftCorner(nv, nq) *
                                    joint.inverse.topLeftCorner(nq, nq) *
                                    joint.rates_by_v.topLeftCorner(nq, nv);
  }
  const Eigen::Index n = system.nv_free();
  auto motion = matrix_.topLeftCorner(n, n);
  motion = tangent_.mass + gamma * tangent_.damping;
  multiply_by_Z(gamma * gamma, tangent_.stiffness, motion);
  if (system.water()) eliminate_memory(*system.water(), gamma, motion);
  if (loops_) {
    const Eigen::Index m = loops_->row_count();
    matrix_.topRightCorner(n, m) = -loops_->jacobian().transpose();
    auto demand = matrix_.bottomLeftCorner(m, n);
    demand = loops_->jacobian() + gamma * loops_->by_v();
    multiply_by_Z(gamma * gamma, loops_->by_q(), demand);
    matrix_.bottomRightCorner(m, m).setZero();
  }
  factor_.factorise(matrix_);
  return factor_.is_regular();
}

void NewtonMatrix::solve(const LiftSystem& system, ConstVectorRef b, VectorRef x) {
  const Eigen::Index nq = system.nq_free();
  const Eigen::Index nv = system.nv_free();
  // Y b_q.
  for (std::size_t i = 0; i < plain_q_.size(); ++i) moved_[plain_v_[i]] = b[plain_q_[i]];
  for (const Joint& joint : joints_) {
    x_q_.segment(joint.q, joint.nq).noalias() =
        joint.inverse.topLeftCorner(joint.nq, joint.nq) * b.segment(joint.q, joint.nq);
    moved_.segment(joint.v, joint.nv).noalias() =
        joint.increments.topLeftCorner(joint.nv, joint.nq) * x_q_.segment(joint.q, joint.nq);
  }
  right_.head(nv).noalias() = tangent_.mass * b.segment(nq, nv);
  right_.head(nv).noalias() -= gamma_ * (tangent_.stiffness * moved_);
  const RadiatedWater* water = system.water();
  if (water) {
    memory_.col(0) = b.segment(nq + nv, memory_.rows());
    frames_.setZero();
    for (const RadiatedWater::Section& s : water->sections()) {
      auto memory = memory_.middleRows(s.first, s.count);
      water->apply(resolvent_, s, memory);
      if (tangent_.water_shares.gain[s.draught] == 0.0) continue;
      frames_.noalias() += output_.middleCols(s.first, s.count) * memory.col(0);
    }
    right_.head(nv).noalias() -= gamma_ * (tangent_.frame_jacobian.transpose() * frames_);
  }
  if (loops_) {
    auto demand = right_.tail(loops_->row_count());
    demand.noalias() = loops_->jacobian() * b.segment(nq, nv);
    demand.noalias() -= gamma_ * (loops_->by_q() * moved_);
  }
  factor_.solve(right_, solution_);
  moved_ = solution_.head(nv);
  // x_q = (1 - gamma A)^-1 (b_q + gamma N x_v).
  for (std::size_t i = 0; i < plain_q_.size(); ++i) {
    x[plain_q_[i]] = b[plain_q_[i]] + gamma_ * moved_[plain_v_[i]];
  }
  for (const Joint& joint : joints_) {
    Eigen::Matrix<double, 7, 1> sum;
    sum.head(joint.nq) = b.segment(joint.q, joint.nq) +
                         gamma_ * (joint.rates_by_v.topLeftCorner(joint.nq, joint.nv) *
                                   moved_.segment(joint.v, joint.nv));
    x.segment(joint.q, joint.nq) =
        joint.inverse.topLeftCorner(joint.nq, joint.nq) * sum.head(joint.nq);
  }
  x.segment(nq, nv) = moved_;
  if (!water) return;
  frames_.noalias() = tangent_.frame_jacobian * moved_;
  for (const RadiatedWater::Section& s : water->sections()) {
    if (tangent_.water_shares.gain[s.draught] == 0.0) continue;
    memory_.middleRows(s.first, s.count).col(0).noalias() +=
        gamma_ * (response_.middleRows(s.first, s.count) * frames_);
  }
  x.segment(nq + nv, memory_.rows()) = memory_.col(0);
}

}  // namespace blocklift::dynamics
