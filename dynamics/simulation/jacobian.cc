#include "dynamics/simulation/jacobian.h"

#include <algorithm>
#include <cmath>

#include "dynamics/force/loop_derivatives.h"
#include "dynamics/marine/loads/level_axes.h"

namespace blocklift::dynamics {

namespace {

std::size_t most_points(const LiftSystem& system) {
  std::size_t most = 2;
  for (const Rope& rope : system.ropes()) most = std::max(most, rope.most_path_points());
  for (const ElasticBody& body : system.elastic_bodies()) most = std::max(most, body.point_count());
  return most;
}

void calc_force_derivatives(const LiftSystem& system, double t, bool stretch_only, LiftWorkspace& w,
                            TangentMatrices& tangent) {
  compute_motion_columns(system.mechanism(), w.kinematics, w.v, tangent.inverse.columns);
  tangent.forces.start(w.kinematics, tangent.inverse.columns, stretch_only);
  for (std::size_t i = 0; i < system.ropes().size(); ++i) {
    const Rope& rope = system.ropes()[i];
    const bool pulls = w.rope_loads[i].taut || rope.hangs();
    if (!pulls || system.ends_elastically(static_cast<int>(i))) continue;
    rope.calc_path(w.kinematics, w.path);
    if (w.rope_loads[i].split.acts) {
      w.splits[i].add_derivatives(rope, w.kinematics, w.path, tangent.forces);
      continue;
    }
    rope.add_derivatives(w.kinematics, w.path, w.rope_loads[i], tangent.forces);
  }
  for (std::size_t i = 0; i < system.elastic_bodies().size(); ++i) {
    system.elastic_bodies()[i].add_derivatives(w.kinematics, w.ropes(system, nullptr), w.elastic[i],
                                               tangent.forces);
  }
  for (std::size_t i = 0; i < system.supports().size(); ++i) {
    system.supports()[i].add_derivatives(w.kinematics, w.support_loads[i], tangent.forces);
  }
  for (std::size_t i = 0; i < system.tugger_lines().size(); ++i)
    system.tugger_lines()[i].add_derivatives(w.kinematics, w.tugger_loads[i], tangent.forces);
  const MotionState state{t, w.q, w.v, w.kinematics};
  for_each_element(system.elements(), [&](const auto& element) {
    if constexpr (!is_tugger_line<decltype(element)>)
      element.add_derivatives(state, tangent.forces);
  });
  tangent.loads.F_Bo_W = w.loads.F_Bo_W;
  if (!w.loops || stretch_only) return;
  const Mechanism& mechanism = system.mechanism();
  add_loop_forces(mechanism, w.kinematics, w.loops->loops, w.loops->lambda, tangent.loads.F_Bo_W,
                  tangent.loads.tau);
  add_loop_derivatives(mechanism, w.kinematics, w.loops->loops, w.loops->lambda, tangent.forces);
}

}  // namespace

TangentMatrices::TangentMatrices(const LiftSystem& system)
    : mass(system.nv_free(), system.nv_free()),
      damping(system.nv_free(), system.nv_free()),
      stiffness(system.nv_free(), system.nv_free()),
      inverse(system.mechanism()),
      forces(system.mechanism(), most_points(system)),
      loads(system.mechanism()),
      frame_jacobian(system.water() ? system.water()->inertia().size() : 0, system.nv_free()) {
  if (system.water()) added.emplace(system.mechanism(), system.water()->inertia());
}

void calc_tangent_matrices(const LiftSystem& system, double t, LiftWorkspace& w,
                           TangentMatrices& tangent) {
  calc_force_derivatives(system, t, false, w, tangent);
  InverseDynamicsDerivatives& inverse = tangent.inverse;
  const ForceDerivatives& forces = tangent.forces;
  compute_inverse_dynamics_derivatives(system.mechanism(), w.kinematics, w.v, w.vdot,
                                       tangent.loads.F_Bo_W, forces.arm_moments(), inverse);
  const std::vector<int>& free = system.mechanism().free_velocities();
  Eigen::Index column = 0;
  if (tangent.added) {
    tangent.water_shares = system.water()->find_shares(w.kinematics);
    system.water()->calc_added_mass(tangent.water_shares, tangent.added->matrix);
    tangent.added->add_mass(system.mechanism(), w.kinematics, system.water()->inertia(),
                            inverse.mass);
    for (const int k : free) tangent.frame_jacobian.col(column++) = tangent.added->jacobian.col(k);
    turn_to_level_axes(system.water()->frames(), w.kinematics, tangent.frame_jacobian);
    column = 0;
  }
  for (const int k : free) {
    Eigen::Index row = 0;
    for (const int l : free) {
      tangent.mass(row, column) = inverse.mass(l, k);
      tangent.stiffness(row, column) = inverse.dtau_dq(l, k) - forces.dtau_dq()(l, k);
      tangent.damping(row, column) = inverse.dtau_dv(l, k) - forces.dtau_dv()(l, k);
      ++row;
    }
    ++column;
  }
}

void calc_elastic_stiffness(const LiftSystem& system, double t, LiftWorkspace& w,
                            TangentMatrices& tangent, Eigen::Ref<Eigen::MatrixXd> stiffness) {
  calc_force_derivatives(system, t, true, w, tangent);
  const std::vector<int>& free = system.mechanism().free_velocities();
  for (std::size_t j = 0; j < free.size(); ++j) {
    for (std::size_t i = 0; i < free.size(); ++i) {
      stiffness(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          -tangent.forces.dtau_dq()(free[i], free[j]);
    }
  }
}

JacobianWorkspace::JacobianWorkspace(const LiftSystem& system)
    : tangent(system),
      mass(system.nv_free()),
      increments(system.mechanism().nv(), system.mechanism().nq()),
      rates_by_q(system.mechanism().nq(), system.mechanism().nq()),
      rates_by_v(system.mechanism().nq(), system.mechanism().nv()),
      scaled(system.nv_free(), system.state_size()) {}

namespace {

// The rows of the water's memory, and what it does to the velocities (not yet divided by the mass).
void add_memory(const LiftSystem& system, Eigen::Index nq, Eigen::Index nv,
                JacobianWorkspace& workspace, Eigen::Ref<Eigen::MatrixXd> jacobian) {
  const RadiatedWater& water = *system.water();
  const Eigen::Index n = water.state_count();
  const Eigen::MatrixXd& J = workspace.tangent.frame_jacobian;
  const DraughtShares& shares = workspace.tangent.water_shares;
  Eigen::MatrixXd input, output;
  water.calc_input(shares, input);
  water.calc_output(shares, output);
  workspace.scaled.rightCols(n) = -(J.transpose() * output);
  jacobian.rightCols(n).topRows(nq).setZero();
  jacobian.bottomRows(n).leftCols(nq).setZero();
  jacobian.bottomRows(n).middleCols(nq, nv) = input * J;
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(water.inertia().size());
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(n), rate(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    unit[k] = 1.0;
    water.calc_rate(shares, unit, still, rate);
    jacobian.col(nq + nv + k).tail(n) = rate;
    unit[k] = 0.0;
  }
}

}  // namespace

void calc_jacobian(const LiftSystem& system, double t, ConstVectorRef y, const Contacts* contacts,
                   LiftWorkspace& w, JacobianWorkspace& workspace,
                   Eigen::Ref<Eigen::MatrixXd> jacobian) {
  const Mechanism& mechanism = system.mechanism();
  const Eigen::Index nq = system.nq_free();
  const Eigen::Index nv = system.nv_free();
  // The right-hand side goes into the first column, which is overwritten below.
  calc_right_hand_side(system, t, y, contacts, w, jacobian.col(0));
  TangentMatrices& tangent = workspace.tangent;
  calc_tangent_matrices(system, t, w, tangent);
  coordinate_increments(mechanism, w.q, workspace.increments);
  rate_derivatives(mechanism, w.q, w.v, workspace.rates_by_q, workspace.rates_by_v);
  const std::vector<int>& free_q = mechanism.free_coordinates();
  const std::vector<int>& free_v = mechanism.free_velocities();
  // -M^-1 (K E, C), and the kinematics above them.
  workspace.scaled.middleCols(nq, nv) = -tangent.damping;
  for (Eigen::Index j = 0; j < nq; ++j) {
    const int q_column = free_q[j];
    auto column = workspace.scaled.col(j);
    column.setZero();
    for (Eigen::Index k = 0; k < nv; ++k) {
      const double turn = workspace.increments(free_v[k], q_column);
      if (turn != 0.0) column -= turn * tangent.stiffness.col(k);
    }
    for (Eigen::Index i = 0; i < nq; ++i) {
      jacobian(i, j) = workspace.rates_by_q(free_q[i], q_column);
    }
  }
  for (Eigen::Index j = 0; j < nv; ++j) {
    for (Eigen::Index i = 0; i < nq; ++i) {
      jacobian(i, nq + j) = workspace.rates_by_v(free_q[i], free_v[j]);
    }
  }
  if (system.water()) add_memory(system, nq, nv, workspace, jacobian);
  workspace.mass.factorise(tangent.mass);
  workspace.mass.solve_columns_in_place(workspace.scaled);
  jacobian.middleRows(nq, nv) = workspace.scaled;
}

Eigen::MatrixXd difference_jacobian(const LiftSystem& system, double t, ConstVectorRef y,
                                    const Contacts* contacts, LiftWorkspace& w, double step) {
  const Eigen::Index n = system.state_size();
  Eigen::MatrixXd jacobian(n, n);
  Eigen::VectorXd shifted = y;
  Eigen::VectorXd plus(n), minus(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double h = step * std::max(1.0, std::abs(y[k]));
    shifted[k] = y[k] + h;
    calc_right_hand_side(system, t, shifted, contacts, w, plus);
    shifted[k] = y[k] - h;
    calc_right_hand_side(system, t, shifted, contacts, w, minus);
    shifted[k] = y[k];
    jacobian.col(k) = (plus - minus) / (2.0 * h);
  }
  return jacobian;
}

}  // namespace blocklift::dynamics
