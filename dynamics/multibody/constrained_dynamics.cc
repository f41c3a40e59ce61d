#include "dynamics/multibody/constrained_dynamics.h"

#include <algorithm>

#include "dynamics/index.h"

namespace blocklift::dynamics {
namespace {

// Rows that were chosen as independent elsewhere: only what no number can divide is left out.
constexpr double chosen_threshold = 1e-12;

// Changes the solution (L vdot) by the least that meets the chosen rows; leaves their multipliers.
void enforce_loops(const Mechanism& mechanism, const Kinematics& kinematics, ConstVectorRef q,
                   ConstVectorRef v, ConstVectorRef vdot, const LoopRows* rows,
                   ConstrainedDynamicsWorkspace& w) {
  const LoopRows& chosen = rows ? *rows : w.all_rows;
  const Eigen::Index m = chosen.count();
  compute_loops(mechanism, kinematics, q, v, w.loops);
  calc_loop_accelerations(mechanism, kinematics, w.loops, vdot, w.inverse.A_WB, w.accelerations);
  auto G = w.jacobian.topRows(m);
  calc_loop_jacobian(mechanism, kinematics, w.loops, chosen.slot, G);
  auto B = w.free_jacobian.topRows(m);
  Eigen::Index i = 0;
  for (const int k : mechanism.free_velocities()) B.col(i++) = G.col(k);
  w.factor.solve_rows(B);
  w.qr.columns(m) = B.transpose();
  for (Eigen::Index row = 0; row < m; ++row) {
    const int which = chosen.rows[row];
    w.group[row] = mechanism.loop_row_is_angle(which) ? 1 : 0;
    w.right[row] = -w.accelerations[which];
  }
  w.qr.factorise(m, w.group, rows ? chosen_threshold : redundancy_threshold);
  w.rank = w.qr.rank();
  w.qr.correct(w.right.head(m), w.solution);
  w.qr.multipliers(w.multipliers.head(m));
}

}  // namespace

LoopRows LoopRows::none(const Mechanism& mechanism) {
  LoopRows result;
  const auto count = index(mechanism.loop_row_count());
  result.rows.reserve(count);
  result.slot.assign(count, -1);
  return result;
}

LoopRows LoopRows::all(const Mechanism& mechanism) {
  LoopRows result = none(mechanism);
  for (int row = 0; row < mechanism.loop_row_count(); ++row) {
    result.slot[row] = row;
    result.rows.push_back(row);
  }
  return result;
}

void LoopRows::choose(const LoopRows& from, const std::vector<int>& chosen, Eigen::Index count) {
  std::fill(slot.begin(), slot.end(), -1);
  for (Eigen::Index i = 0; i < count; ++i) {
    slot[from.rows[chosen[i]]] = 0;
  }
  rows.clear();
  for (std::size_t row = 0; row < slot.size(); ++row) {
    if (slot[row] < 0) continue;
    slot[row] = static_cast<int>(rows.size());
    rows.push_back(static_cast<int>(row));
  }
}

ConstrainedDynamicsWorkspace::ConstrainedDynamicsWorkspace(const Mechanism& mechanism,
                                                           const AddedInertia* inertia)
    : loops(mechanism),
      lambda(Eigen::VectorXd::Zero(mechanism.loop_row_count())),
      inverse(mechanism),
      composite(mechanism),
      factor(mechanism, inertia ? inertia->bodies() : std::vector<BodyIndex>{}),
      all_rows(LoopRows::all(mechanism)),
      mass(Eigen::MatrixXd::Zero(mechanism.nv(), mechanism.nv())),
      jacobian(Eigen::MatrixXd::Zero(mechanism.loop_row_count(), mechanism.nv())),
      free_jacobian(Eigen::MatrixXd::Zero(mechanism.loop_row_count(), factor.size())),
      qr(factor.size(), mechanism.loop_row_count()),
      bias(Eigen::VectorXd::Zero(mechanism.nv())),
      accelerations(lambda),
      right(lambda),
      solution(Eigen::VectorXd::Zero(factor.size())),
      multipliers(lambda),
      group(index(mechanism.loop_row_count())) {
  if (inertia) added.emplace(mechanism, *inertia);
}

void compute_constrained_dynamics(const Mechanism& mechanism, const Kinematics& kinematics,
                                  ConstVectorRef q, ConstVectorRef v,
                                  const std::vector<ForceVector>& F_Bo_W, const LoopRows* rows,
                                  ConstrainedDynamicsWorkspace& w, VectorRef tau, VectorRef vdot,
                                  const AddedInertia* added) {
  const std::vector<int>& free = mechanism.free_velocities();
  const LoopRows& chosen = rows ? *rows : w.all_rows;
  const Eigen::Index m = chosen.count();

  for (const int k : free) vdot[k] = 0.0;
  compute_inverse_dynamics(mechanism, kinematics, v, vdot, F_Bo_W, w.inverse, w.bias);
  compute_mass_matrix(mechanism, kinematics, w.composite, w.mass);
  if (added) {
    w.added->add_mass(mechanism, kinematics, *added, w.mass);
    w.added->add_force(kinematics, *added, w.inverse.A_WB, w.bias);
  }
  w.factor.factorise(mechanism, w.mass);
  Eigen::Index i = 0;
  for (const int k : free) w.solution[i++] = tau[k] - w.bias[k];
  w.factor.solve_transposed(w.solution);

  if (mechanism.loop_row_count() > 0) {
    enforce_loops(mechanism, kinematics, q, v, vdot, rows, w);
  }
  w.factor.solve(w.solution);

  w.lambda.setZero();
  for (Eigen::Index row = 0; row < m; ++row) {
    w.lambda[chosen.rows[row]] = w.multipliers[row];
  }
  for (const int k : mechanism.driven_velocities()) {
    double force = w.bias[k] - w.jacobian.topRows(m).col(k).dot(w.multipliers.head(m));
    i = 0;
    for (const int j : free) force += w.mass(j, k) * w.solution[i++];
    tau[k] = force;
  }
  i = 0;
  for (const int k : free) vdot[k] = w.solution[i++];
}

}  // namespace blocklift::dynamics
