#include "dynamics/multibody/derivatives.h"

#include "dynamics/errors.h"
#include "dynamics/index.h"

namespace blocklift::dynamics {
namespace {

using Composite = InverseDynamicsDerivatives::Composite;

ForceVector rigid_product(const Composite& body, const MotionVector& a) { return body.inertia * a; }

// B a, of which only the angular half of a counts.
ForceVector coriolis_product(const Composite& body, const MotionVector& a) {
  return {body.coriolis * a.angular, -2.0 * body.momentum.cross(a.angular)};
}

void set_body(const Link& link, const Pose& X_WB, const Vector3& p_OB, const MotionVector& V,
              const MotionVector& A, Composite& body) {
  const Vector3 h_Bo = X_WB.R * link.mass_moment;
  SpatialInertia about_Bo;
  about_Bo.J = rotate(X_WB.R, link.I_BBo);
  about_Bo.H = skew(h_Bo);
  about_Bo.M = {link.mass, 0, 0, link.mass, 0, link.mass};
  body.inertia = SpatialInertia::zero();
  add_shifted(about_Bo, p_OB, body.inertia);
  const Vector3 h = h_Bo + link.mass * p_OB;
  const ForceVector momentum = body.inertia * V;
  body.momentum = momentum.force;
  body.inertial = body.inertia * A + cross_dual(V, momentum);
  Matrix3 second = 2.0 * body.inertia.J.matrix();
  second.diagonal().array() -= body.inertia.J.trace();
  body.coriolis = skew(V.angular) * second - 2.0 * skew(h) * skew(V.linear);
  body.external = ForceVector::zero();
  body.arms.setZero();
}

void add_external(const ForceVector& F_Bo_W, const Vector3& p_OB, Composite& body) {
  body.external += shift_to(F_Bo_W, p_OB);
  body.arms += skew(F_Bo_W.force) * skew(p_OB);
}

void add_composite(const Composite& carried, Composite& carrier) {
  carrier.inertia += carried.inertia;
  carrier.coriolis += carried.coriolis;
  carrier.momentum += carried.momentum;
  carrier.inertial += carried.inertial;
  carrier.external += carried.external;
  carrier.arms += carried.arms;
}

// What the force on a composite body gains by the unit increment and by the unit velocity along one
// column, and what pairs with the columns further in.
struct ColumnForces {
  ForceVector unit;        // I S
  Vector3 swing;           // B^T S, angular half
  Vector3 external_turn;   // S^T (S_k x* F_ext - dF_ext/dq_k) = this . angular part of S_k
  ForceVector by_q, by_v;  // dF/dq, dF/dv

  ColumnForces(const Composite& body, const MotionVector& S, const MotionVector& S_swing,
               const MotionVector& S_swing_rate, const MotionVector& S_rate)
      : unit(rigid_product(body, S)),
        swing(body.coriolis.transpose() * S.angular + 2.0 * body.momentum.cross(S.linear)),
        external_turn(body.external.moment.cross(S.angular) - body.arms.transpose() * S.angular +
                      body.external.force.cross(S.linear)),
        by_q(rigid_product(body, S_swing_rate) + coriolis_product(body, S_swing) +
             cross_dual(S, body.inertial)),
        by_v(rigid_product(body, S_swing + S_rate) + coriolis_product(body, S)) {
    by_q.moment -= S.linear.cross(body.external.force) + body.arms * S.angular;
  }
};

}  // namespace

MotionColumns::MotionColumns(const Mechanism& mechanism)
    : S(index(mechanism.nv()), MotionVector::zero()),
      S_swing(S.size()),
      S_rate(S.size()),
      V(index(mechanism.body_count()), MotionVector::zero()) {}

InverseDynamicsDerivatives::InverseDynamicsDerivatives(const Mechanism& mechanism)
    : dtau_dq(mechanism.nv(), mechanism.nv()),
      dtau_dv(mechanism.nv(), mechanism.nv()),
      mass(mechanism.nv(), mechanism.nv()),
      columns(mechanism),
      composites(index(mechanism.body_count())),
      A(composites.size(), MotionVector::zero()),
      S_swing_rate(index(mechanism.nv())) {}

void compute_motion_columns(const Mechanism& mechanism, const Kinematics& kinematics,
                            ConstVectorRef v, MotionColumns& columns) {
  columns.p_WO.setZero();
  for (const Link& link : mechanism.links()) columns.p_WO += kinematics.X_WB[link.body].p;
  if (!mechanism.links().empty()) {
    columns.p_WO /= static_cast<double>(mechanism.links().size());
  }
  for (const Link& link : mechanism.links()) {
    const std::size_t b = index(link.body);
    const Vector3 p_OB = kinematics.X_WB[b].p - columns.p_WO;
    const bool chain = velocities_are_rates(link.kind);
    columns.V[b] = shift(kinematics.V_WB[b], -p_OB);
    MotionVector before = columns.V[link.carrier];
    for (int k = link.v_offset; k < link.v_offset + link.nv; ++k) {
      const Vector3& direction = kinematics.direction_W[k];
      MotionVector& S = columns.S[k];
      S = mechanism.angular()[k] ? MotionVector{direction, p_OB.cross(direction)}
                                 : MotionVector{Vector3::Zero(), direction};
      columns.S_swing[k] = cross(before, S);
      columns.S_rate[k] = chain ? columns.S_swing[k] : cross(columns.V[b], S);
      if (chain) before = before + v[k] * S;
    }
  }
}

namespace {

// Accelerations at O outwards, and A_before x S + V_before x S_swing of each column.
void accelerate(const Link& link, const double* v, const double* vdot,
                InverseDynamicsDerivatives& d) {
  const bool chain = velocities_are_rates(link.kind);
  const MotionColumns& c = d.columns;
  MotionVector V_before = c.V[link.carrier];
  MotionVector A_before = d.A[link.carrier];
  MotionVector A = A_before;
  for (int k = link.v_offset; k < link.v_offset + link.nv; ++k) {
    const std::size_t i = index(k);
    d.S_swing_rate[i] = cross(A_before, c.S[i]) + cross(V_before, c.S_swing[i]);
    A = A + vdot[k] * c.S[i] + v[k] * c.S_swing[i];
    if (!chain) continue;
    A_before = A;
    V_before = V_before + v[k] * c.S[i];
  }
  d.A[link.body] = A;
}

// Row and column of velocity k of `link` in the three matrices.
void fill(const Mechanism& mechanism, const Link& link, int k, InverseDynamicsDerivatives& d) {
  const MotionColumns& c = d.columns;
  const std::size_t i = index(k);
  const MotionVector& S = c.S[i];
  const ColumnForces F(d.composites[link.body], S, c.S_swing[i], d.S_swing_rate[i], c.S_rate[i]);
  const bool chain = velocities_are_rates(link.kind);
  for (BodyIndex b = link.body; b != world_index;) {
    const Body& body = mechanism.bodies()[b];
    for (int j = body.v_offset; j < body.v_offset + body.nv(); ++j) {
      const std::size_t l = index(j);
      d.mass(k, j) = d.mass(j, k) = dot(F.unit, c.S[l]);
      d.dtau_dv(k, j) = dot(F.unit, c.S_swing[l] + c.S_rate[l]) + F.swing.dot(c.S[l].angular);
      d.dtau_dv(j, k) = dot(F.by_v, c.S[l]);
      // Within a joint of body-fixed columns each is moved by all, within a chain by those before.
      const bool own = b == link.body;
      if (!own || !chain || j <= k) {
        d.dtau_dq(k, j) = dot(F.unit, d.S_swing_rate[l]) + F.swing.dot(c.S_swing[l].angular) +
                          F.external_turn.dot(c.S[l].angular);
      }
      if (!own || (chain && j < k)) d.dtau_dq(j, k) = dot(F.by_q, c.S[l]);
    }
    b = body.carrier;
  }
  d.dtau_dv(k, k) += mechanism.damping()[i];
}

}  // namespace

void compute_inverse_dynamics_derivatives(const Mechanism& mechanism, const Kinematics& kinematics,
                                          ConstVectorRef v, ConstVectorRef vdot,
                                          const std::vector<ForceVector>& F_Bo_W,
                                          const std::vector<Matrix3>& arm_moments,
                                          InverseDynamicsDerivatives& d) {
  eigen_assert(v.size() == mechanism.nv() && vdot.size() == v.size());
  d.dtau_dq.setZero();
  d.dtau_dv.setZero();
  d.mass.setZero();
  compute_motion_columns(mechanism, kinematics, v, d.columns);
  d.A[world_index] = {Vector3::Zero(), -mechanism.gravity()};
  const auto external = [&](BodyIndex i, BodyIndex onto) {
    const std::size_t b = index(i);
    Composite& composite = d.composites[onto];
    add_external(F_Bo_W[b], kinematics.X_WB[b].p - d.columns.p_WO, composite);
    if (!arm_moments.empty()) composite.arms += arm_moments[b];
  };
  for (const Link& link : mechanism.links()) {
    const std::size_t b = index(link.body);
    accelerate(link, v.data(), vdot.data(), d);
    set_body(link, kinematics.X_WB[b], kinematics.X_WB[b].p - d.columns.p_WO, d.columns.V[b],
             d.A[b], d.composites[b]);
    external(link.body, link.body);
  }
  for (const BodyIndex i : mechanism.fixed_bodies()) {
    const BodyIndex carrier = mechanism.bodies()[i].carrier;
    if (carrier != world_index) external(i, carrier);
  }
  const std::vector<Link>& links = mechanism.links();
  for (auto link = links.rbegin(); link != links.rend(); ++link) {
    for (int k = link->v_offset; k < link->v_offset + link->nv; ++k) fill(mechanism, *link, k, d);
    if (link->carrier == world_index) continue;
    add_composite(d.composites[link->body], d.composites[link->carrier]);
  }
  for (const ElasticMode& mode : mechanism.elastic_modes()) {
    d.mass(mode.v_index, mode.v_index) = mode.modal_mass;
    d.dtau_dv(mode.v_index, mode.v_index) = mode.damping();
  }
}

// ---- forward dynamics ---------------------------------------------------------------------------

ForwardDynamicsDerivatives::ForwardDynamicsDerivatives(const Mechanism& mechanism)
    : inverse(mechanism),
      by_q(mechanism.nv(), mechanism.nv()),
      by_v(mechanism.nv(), mechanism.nv()),
      factor_(static_cast<Eigen::Index>(mechanism.free_velocities().size())) {
  const auto n = static_cast<Eigen::Index>(mechanism.free_velocities().size());
  free_mass_.resize(n, n);
  right_.resize(n, 2 * mechanism.nv());
}

void compute_forward_dynamics_derivatives(const Mechanism& mechanism, const Kinematics& kinematics,
                                          ConstVectorRef v, ConstVectorRef vdot,
                                          const std::vector<ForceVector>& F_Bo_W,
                                          ForwardDynamicsDerivatives& d) {
  compute_inverse_dynamics_derivatives(mechanism, kinematics, v, vdot, F_Bo_W, {}, d.inverse);
  const std::vector<int>& free = mechanism.free_velocities();
  const Eigen::Index n = mechanism.nv();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < free.size(); ++j) {
      d.free_mass_(row, static_cast<Eigen::Index>(j)) = d.inverse.mass(free[i], free[j]);
    }
    d.right_.row(row).head(n) = -d.inverse.dtau_dq.row(free[i]);
    d.right_.row(row).tail(n) = -d.inverse.dtau_dv.row(free[i]);
  }
  d.factor_.factorise(d.free_mass_);
  if (!d.factor_.is_positive()) {
    throw SimulationError(
        "the mass matrix of the free velocities is singular: some motion meets no "
        "inertia in the present configuration");
  }
  d.factor_.solve_columns_in_place(d.right_);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    d.by_q.row(free[i]) = d.right_.row(row).head(n);
    d.by_v.row(free[i]) = d.right_.row(row).tail(n);
  }
  for (const int k : mechanism.driven_velocities()) {
    d.by_q.row(k) = d.inverse.dtau_dq.row(k);
    d.by_v.row(k) = d.inverse.dtau_dv.row(k);
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      d.by_q.row(k) += d.inverse.mass(k, free[i]) * d.right_.row(row).head(n);
      d.by_v.row(k) += d.inverse.mass(k, free[i]) * d.right_.row(row).tail(n);
    }
  }
}

// ---- increments ---------------------------------------------------------------------------------

namespace {

// The turn, in B, that a change of a quaternion amounts to: theta = 2 vec(conj(Q) dQ) / |Q|^2.
Eigen::Matrix<double, 3, 4> quaternion_turn(const Vector4& Q) {
  Eigen::Matrix<double, 3, 4> turn;
  turn << -Q.tail<3>(), Q[0] * Matrix3::Identity() - skew(Q.tail<3>());
  return (2.0 / Q.squaredNorm()) * turn;
}

}  // namespace

void joint_increments(JointKind kind, const double* q, Eigen::Ref<Eigen::MatrixXd> increments) {
  increments.setZero();
  const auto quaternion = quaternion_offset(kind);
  if (!quaternion) {
    increments.setIdentity();
    return;
  }
  const Vector4 Q = Eigen::Map<const Vector4>(q + *quaternion);
  increments.block<3, 4>(0, *quaternion) = quaternion_turn(Q);
  if (kind == JointKind::free) {
    increments.block<3, 3>(3, 0) = rotation_from_quaternion(Q).transpose();
  }
}

void joint_rate_derivatives(JointKind kind, const double* q, const double* v,
                            Eigen::Ref<Eigen::MatrixXd> by_q, Eigen::Ref<Eigen::MatrixXd> by_v) {
  by_q.setZero();
  by_v.setZero();
  const auto quaternion = quaternion_offset(kind);
  if (!quaternion) {
    by_v.setIdentity();
    return;
  }
  // dQ/dt = 1/2 Q (0, w), linear in both.
  const int first = *quaternion;
  const Vector4 Q = Eigen::Map<const Vector4>(q + first);
  const Vector3 w = Eigen::Map<const Vector3>(v);
  auto turn = by_q.block<4, 4>(first, first);
  turn.row(0).tail<3>() = -0.5 * w.transpose();
  turn.col(0).tail<3>() = 0.5 * w;
  turn.bottomRightCorner<3, 3>() = -0.5 * skew(w);
  auto spin = by_v.block<4, 3>(first, 0);
  spin.row(0) = -0.5 * Q.tail<3>().transpose();
  spin.bottomRows<3>() = 0.5 * (Q[0] * Matrix3::Identity() + skew(Q.tail<3>()));
  if (kind != JointKind::free) return;
  // dp/dt = R u:  d(R u) = -R [u]x theta.
  const Matrix3 R = rotation_from_quaternion(Q);
  by_q.block<3, 4>(0, first) = -R * skew(Eigen::Map<const Vector3>(v + 3)) * quaternion_turn(Q);
  by_v.block<3, 3>(0, 3) = R;
}

void coordinate_increments(const Mechanism& mechanism, ConstVectorRef q,
                           Eigen::Ref<Eigen::MatrixXd> increments) {
  increments.setZero();
  for (const Link& link : mechanism.links()) {
    joint_increments(
        link.kind, q.data() + link.q_offset,
        increments.block(link.v_offset, link.q_offset, link.nv, coordinate_count(link.kind)));
  }
  for (const ElasticMode& mode : mechanism.elastic_modes()) {
    increments(mode.v_index, mode.q_index) = 1.0;
  }
}

void rate_derivatives(const Mechanism& mechanism, ConstVectorRef q, ConstVectorRef v,
                      Eigen::Ref<Eigen::MatrixXd> by_q, Eigen::Ref<Eigen::MatrixXd> by_v) {
  by_q.setZero();
  by_v.setZero();
  for (const Link& link : mechanism.links()) {
    const int nq = coordinate_count(link.kind);
    joint_rate_derivatives(link.kind, q.data() + link.q_offset, v.data() + link.v_offset,
                           by_q.block(link.q_offset, link.q_offset, nq, nq),
                           by_v.block(link.q_offset, link.v_offset, nq, link.nv));
  }
  for (const ElasticMode& mode : mechanism.elastic_modes()) {
    by_v(mode.q_index, mode.v_index) = 1.0;
  }
}

void increment_jacobian(const Mechanism& mechanism, ConstVectorRef u,
                        Eigen::Ref<Eigen::MatrixXd> jacobian) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  jacobian.setIdentity();
  for (const Link& link : mechanism.links()) {
    if (velocities_are_rates(link.kind)) continue;
    const auto at = link.v_offset;
    Matrix6 ad = Matrix6::Zero();
    ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = skew(u.segment<3>(at));
    if (link.kind == JointKind::free) ad.bottomLeftCorner<3, 3>() = skew(u.segment<3>(at + 3));
    Matrix6 sum = Matrix6::Identity();
    Matrix6 term = Matrix6::Identity();
    for (int n = 1; n < 60; ++n) {
      term = (-1.0 / (n + 1)) * (term * ad).eval();
      sum += term;
      if (term.lpNorm<Eigen::Infinity>() < 1e-17 * sum.lpNorm<Eigen::Infinity>()) break;
    }
    jacobian.block(at, at, link.nv, link.nv) = sum.topLeftCorner(link.nv, link.nv);
  }
}

}  // namespace blocklift::dynamics
