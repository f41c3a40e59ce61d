#include "dynamics/multibody/mass_matrix.h"

namespace blocklift::dynamics {
namespace {

// Force about Bo that accelerates the composite body along one velocity at unit rate.
ForceVector unit_acceleration_force(const SpatialInertia& inertia, bool angular,
                                    const Vector3& direction) {
  if (angular) return {inertia.J * direction, inertia.H.transpose() * direction};
  return {inertia.H * direction, inertia.M * direction};
}

}  // namespace

MassMatrixWorkspace::MassMatrixWorkspace(const Mechanism& mechanism)
    : composite(static_cast<std::size_t>(mechanism.body_count())) {}

void compute_mass_matrix(const Mechanism& mechanism, const Kinematics& kinematics,
                         MassMatrixWorkspace& workspace, Eigen::Ref<Eigen::MatrixXd> mass_matrix) {
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  mass_matrix.setZero();
  for (const Link& link : mechanism.links()) {
    const Matrix3& R = kinematics.X_WB[index(link.body)].R;
    SpatialInertia& inertia = workspace.composite[index(link.body)];
    inertia.J = rotate(R, link.I_BBo);
    inertia.H = skew(R * link.mass_moment);
    inertia.M = {link.mass, 0, 0, link.mass, 0, link.mass};
  }
  const std::vector<Link>& links = mechanism.links();
  for (auto link = links.rbegin(); link != links.rend(); ++link) {
    const SpatialInertia& inertia = workspace.composite[index(link->body)];
    for (int k = link->v_offset; k < link->v_offset + link->nv; ++k) {
      ForceVector F = unit_acceleration_force(inertia, mechanism.angular()[index(k)],
                                              kinematics.direction_W[index(k)]);
      // Down to the base: the same force seen at each carrier's origin, along its own velocities.
      for (BodyIndex i = link->body; i != world_index;) {
        const Body& body = mechanism.bodies()[index(i)];
        for (int j = body.v_offset; j < body.v_offset + body.nv(); ++j) {
          const Vector3& part = mechanism.angular()[index(j)] ? F.moment : F.force;
          mass_matrix(k, j) = mass_matrix(j, k) = kinematics.direction_W[index(j)].dot(part);
        }
        F = shift_to(F, kinematics.p_CB_W[index(i)]);
        i = body.carrier;
      }
    }
    if (link->carrier != world_index) {
      add_shifted(inertia, kinematics.p_CB_W[index(link->body)],
                  workspace.composite[index(link->carrier)]);
    }
  }
  for (const ElasticMode& mode : mechanism.elastic_modes()) {
    mass_matrix(mode.v_index, mode.v_index) = mode.modal_mass;
  }
}

}  // namespace blocklift::dynamics
