#include "dynamics/multibody/inverse_dynamics.h"

namespace blocklift::dynamics {
namespace {

// Force and moment about Bo that the body's motion asks for, less gravity: Newton's and Euler's
// laws
// (paper eq. 3) for accelerations of the ordinary kind.
ForceVector inertial_force(const Mechanism& mechanism, const Kinematics& kinematics, std::size_t b,
                           const MotionVector& A) {
  const RigidBodyInertia& inertia = mechanism.bodies()[b].inertia;
  if (inertia.mass == 0) return ForceVector::zero();
  const Matrix3& R = kinematics.X_WB[b].R;
  const Vector3& w = kinematics.V_WB[b].angular;
  const Vector3 c = R * inertia.p_BoBcm;
  const Vector3 a_cm = A.linear + A.angular.cross(c) + w.cross(w.cross(c));
  const Vector3 force = inertia.mass * (a_cm - mechanism.gravity());
  const Vector3 spin = R * (inertia.I_BBcm * (R.transpose() * w));
  const Vector3 moment = R * (inertia.I_BBcm * (R.transpose() * A.angular)) + w.cross(spin);
  return {moment + c.cross(force), force};
}

}  // namespace

InverseDynamicsWorkspace::InverseDynamicsWorkspace(const Mechanism& mechanism)
    : A_WB(static_cast<std::size_t>(mechanism.body_count())), F_joint_W(A_WB.size()) {}

void compute_inverse_dynamics(const Mechanism& mechanism, const Kinematics& kinematics,
                              ConstVectorRef v, ConstVectorRef vdot,
                              const std::vector<ForceVector>& F_Bo_W,
                              InverseDynamicsWorkspace& workspace, VectorRef tau) {
  compute_accelerations(mechanism, kinematics, vdot, workspace.A_WB);
  std::vector<ForceVector>& F = workspace.F_joint_W;
  F[0] = -1.0 * F_Bo_W[0];
  const std::size_t n = mechanism.bodies().size();
  for (std::size_t b = 1; b < n; ++b) {
    F[b] = inertial_force(mechanism, kinematics, b, workspace.A_WB[b]) - F_Bo_W[b];
  }
  for (std::size_t b = n - 1; b > 0; --b) {
    const Body& body = mechanism.bodies()[b];
    for (int k = body.v_offset; k < body.v_offset + body.nv(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vector3& along = mechanism.angular()[i] ? F[b].moment : F[b].force;
      tau[k] = kinematics.direction_W[i].dot(along) + mechanism.damping()[i] * v[k];
    }
    const auto parent = static_cast<std::size_t>(body.parent);
    F[parent] += shift_to(F[b], kinematics.X_WB[b].p - kinematics.X_WB[parent].p);
  }
  for (const ElasticMode& mode : mechanism.elastic_modes()) {
    const int k = mode.v_index;
    tau[k] = mode.modal_mass * vdot[k] + mode.damping() * v[k];
  }
}

}  // namespace blocklift::dynamics
