#include "dynamics/multibody/kinematics.h"

#include <cmath>

namespace blocklift::dynamics {
namespace {

// What a joint adds to the motion of its carrier, in W: placement and relative motion of the body.
struct RelativeMotion {
  const Link& link;
  const double* q;       // the joint's own entries
  const double* v;       // the joint's own entries
  const Pose& X_WC;      // of the carrier
  Vector3* direction;    // the joint's own columns
  Matrix3& R_WB;         // out
  Vector3& p_CB_W;       // out
  Vector3 w_relative;    // out: angular velocity of B in C
  Vector3 u_relative;    // out: velocity of Bo in C
  Vector3 bias_angular;  // out: angular part of dS/dt v beyond w_WC x w_relative
  Vector3 bias_linear;   // out: linear part of dS/dt v beyond w_WC x u_relative

  void revolute() {
    turn(q[0]);
    p_CB_W.noalias() = X_WC.R * link.p_CJ;
    direction[0].noalias() = X_WC.R * link.axis_C;
    w_relative = v[0] * direction[0];
    u_relative.setZero();
  }

  void prismatic() {
    R_WB.noalias() = X_WC.R * link.rotation_constant;
    direction[0].noalias() = X_WC.R * link.axis_C;
    p_CB_W = X_WC.R * link.p_CJ + q[0] * direction[0];
    w_relative.setZero();
    u_relative = v[0] * direction[0];
  }

  void cylindrical() {
    turn(q[0]);
    direction[0].noalias() = X_WC.R * link.axis_C;
    direction[1] = direction[0];
    p_CB_W = X_WC.R * link.p_CJ + q[1] * direction[0];
    w_relative = v[0] * direction[0];
    u_relative = v[1] * direction[0];
  }

  void universal() {
    turn(q[0]);
    R_WB *= rotation_about(link.second_axis_B, q[1]);
    p_CB_W.noalias() = X_WC.R * link.p_CJ;
    direction[0].noalias() = X_WC.R * link.axis_C;
    direction[1].noalias() = R_WB * link.second_axis_B;
    const Vector3 first = v[0] * direction[0];
    const Vector3 second = v[1] * direction[1];
    w_relative = first + second;
    u_relative.setZero();
    bias_angular = first.cross(second);
  }

  void spherical() {
    orient(q);
    p_CB_W.noalias() = X_WC.R * link.p_CJ;
    for (int k = 0; k < 3; ++k) direction[k] = R_WB.col(k);
    w_relative = R_WB * Eigen::Map<const Vector3>(v);
    u_relative.setZero();
  }

  void planar() {
    turn(q[2]);
    direction[0].noalias() = X_WC.R * link.first_direction_C;
    direction[1].noalias() = X_WC.R * link.second_direction_C;
    direction[2].noalias() = X_WC.R * link.axis_C;
    p_CB_W = X_WC.R * link.p_CJ + q[0] * direction[0] + q[1] * direction[1];
    w_relative = v[2] * direction[2];
    u_relative = v[0] * direction[0] + v[1] * direction[1];
  }

  void translational() {
    R_WB.noalias() = X_WC.R * link.rotation_constant;
    for (int k = 0; k < 3; ++k) direction[k] = R_WB.col(k);
    p_CB_W = X_WC.R * link.p_CJ + R_WB * Eigen::Map<const Vector3>(q);
    w_relative.setZero();
    u_relative = R_WB * Eigen::Map<const Vector3>(v);
  }

  void free() {
    orient(q + 3);
    const Vector3 p_JB = Eigen::Map<const Vector3>(q);
    p_CB_W = X_WC.R * (link.p_CJ + link.rotation_constant * p_JB);
    for (int k = 0; k < 3; ++k) direction[k] = direction[k + 3] = R_WB.col(k);
    w_relative = R_WB * Eigen::Map<const Vector3>(v);
    u_relative = R_WB * Eigen::Map<const Vector3>(v + 3);
    bias_linear = w_relative.cross(u_relative);
  }

 private:
  void turn(double angle) {
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    R_WB.noalias() =
        X_WC.R *
        (link.rotation_constant + s * link.rotation_sine + c * link.rotation_cosine).eval();
  }

  void orient(const double* quaternion) {
    R_WB = X_WC.R * link.rotation_constant *
           rotation_from_quaternion(Eigen::Map<const Vector4>(quaternion));
  }
};

void move_link(const Link& link, const double* q, const double* v, Kinematics& kinematics) {
  const auto b = static_cast<std::size_t>(link.body);
  const auto c = static_cast<std::size_t>(link.carrier);
  const MotionVector& V_WC = kinematics.V_WB[c];
  const Vector3& w_C = V_WC.angular;
  RelativeMotion motion{link,
                        q + link.q_offset,
                        v + link.v_offset,
                        kinematics.X_WB[c],
                        kinematics.direction_W.data() + link.v_offset,
                        kinematics.X_WB[b].R,
                        kinematics.p_CB_W[b],
                        Vector3::Zero(),
                        Vector3::Zero(),
                        Vector3::Zero(),
                        Vector3::Zero()};
  switch (link.kind) {
    case JointKind::revolute:
      motion.revolute();
      break;
    case JointKind::prismatic:
      motion.prismatic();
      break;
    case JointKind::cylindrical:
      motion.cylindrical();
      break;
    case JointKind::universal:
      motion.universal();
      break;
    case JointKind::spherical:
      motion.spherical();
      break;
    case JointKind::planar:
      motion.planar();
      break;
    case JointKind::translational:
      motion.translational();
      break;
    case JointKind::free:
      motion.free();
      break;
    case JointKind::fixed:
      break;  // no link has it
  }
  const Vector3& r = kinematics.p_CB_W[b];
  const Vector3 swing = w_C.cross(r);
  kinematics.X_WB[b].p = kinematics.X_WB[c].p + r;
  kinematics.V_WB[b].angular = w_C + motion.w_relative;
  kinematics.V_WB[b].linear = V_WC.linear + swing + motion.u_relative;
  kinematics.A_bias_W[b].angular = w_C.cross(motion.w_relative) + motion.bias_angular;
  kinematics.A_bias_W[b].linear = w_C.cross(swing + 2.0 * motion.u_relative) + motion.bias_linear;
}

void carry_fixed_bodies(const Mechanism& mechanism, Kinematics& kinematics) {
  for (const BodyIndex i : mechanism.fixed_bodies()) {
    const auto b = static_cast<std::size_t>(i);
    const Body& body = mechanism.bodies()[b];
    const auto c = static_cast<std::size_t>(body.carrier);
    const Pose& X_WC = kinematics.X_WB[c];
    const Vector3& w_C = kinematics.V_WB[c].angular;
    const Vector3 r = X_WC.R * body.X_CJ.p;
    const Vector3 swing = w_C.cross(r);
    kinematics.X_WB[b].R.noalias() = X_WC.R * body.X_CJ.R;
    kinematics.X_WB[b].p = X_WC.p + r;
    kinematics.V_WB[b].angular = w_C;
    kinematics.V_WB[b].linear = kinematics.V_WB[c].linear + swing;
    kinematics.p_CB_W[b] = r;
    kinematics.A_bias_W[b].angular.setZero();
    kinematics.A_bias_W[b].linear = w_C.cross(swing);
  }
}

}  // namespace

Kinematics::Kinematics(const Mechanism& mechanism)
    : X_WB(static_cast<std::size_t>(mechanism.body_count())),
      V_WB(X_WB.size()),
      direction_W(static_cast<std::size_t>(mechanism.nv()), Vector3::Constant(not_a_number)),
      p_CB_W(X_WB.size(), Vector3::Constant(not_a_number)),
      A_bias_W(X_WB.size()) {
  X_WB[0] = Pose::identity();
  V_WB[0] = MotionVector::zero();
  p_CB_W[0].setZero();
  A_bias_W[0] = MotionVector::zero();
}

void compute_kinematics(const Mechanism& mechanism, ConstVectorRef q, ConstVectorRef v,
                        Kinematics& kinematics) {
  eigen_assert(q.size() == mechanism.nq() && v.size() == mechanism.nv());
  for (const Link& link : mechanism.links()) move_link(link, q.data(), v.data(), kinematics);
  carry_fixed_bodies(mechanism, kinematics);
}

void compute_accelerations(const Mechanism& mechanism, const Kinematics& kinematics,
                           ConstVectorRef vdot, std::vector<MotionVector>& A_WB) {
  const auto accelerate = [&](BodyIndex body, BodyIndex carrier) -> MotionVector& {
    const auto b = static_cast<std::size_t>(body);
    const auto c = static_cast<std::size_t>(carrier);
    A_WB[b] = shift(A_WB[c], kinematics.p_CB_W[b]) + kinematics.A_bias_W[b];
    return A_WB[b];
  };
  A_WB[0] = MotionVector::zero();
  for (const Link& link : mechanism.links()) {
    MotionVector& A = accelerate(link.body, link.carrier);
    for (int k = link.v_offset; k < link.v_offset + link.nv; ++k) {
      const auto i = static_cast<std::size_t>(k);
      (mechanism.angular()[i] ? A.angular : A.linear) += vdot[k] * kinematics.direction_W[i];
    }
  }
  for (const BodyIndex i : mechanism.fixed_bodies()) {
    accelerate(i, mechanism.bodies()[i].carrier);
  }
}

void point_jacobian(const Mechanism& mechanism, const Kinematics& kinematics, BodyIndex body,
                    const Vector3& p_BoQ_B, Eigen::Ref<Eigen::Matrix3Xd> jacobian) {
  jacobian.setZero();
  const Vector3 p_Q = point_position(kinematics, body, p_BoQ_B);
  for (BodyIndex i = body; i != world_index;) {
    const Body& link = mechanism.bodies()[i];
    const Vector3 arm = p_Q - kinematics.X_WB[i].p;
    for (int k = link.v_offset; k < link.v_offset + link.nv(); ++k) {
      const auto column = static_cast<std::size_t>(k);
      const Vector3& direction = kinematics.direction_W[column];
      jacobian.col(k) = mechanism.angular()[column] ? direction.cross(arm) : direction;
    }
    i = link.carrier;
  }
}

void body_jacobian(const Mechanism& mechanism, const Kinematics& kinematics, BodyIndex body,
                   Eigen::Ref<Eigen::Matrix<double, 6, Eigen::Dynamic>> jacobian) {
  jacobian.setZero();
  const Vector3& p_Bo = kinematics.X_WB[body].p;
  for (BodyIndex i = body; i != world_index;) {
    const Body& link = mechanism.bodies()[i];
    const Vector3 arm = p_Bo - kinematics.X_WB[i].p;
    for (int k = link.v_offset; k < link.v_offset + link.nv(); ++k) {
      const auto column = static_cast<std::size_t>(k);
      const Vector3& direction = kinematics.direction_W[column];
      if (mechanism.angular()[column]) {
        jacobian.col(k) << direction, direction.cross(arm);
      } else {
        jacobian.col(k).tail<3>() = direction;
      }
    }
    i = link.carrier;
  }
}

}  // namespace blocklift::dynamics
