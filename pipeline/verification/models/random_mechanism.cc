#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::dynamics::examples {

BodyDefinition random_body(Random& random, JointKind kind, const std::string& name,
                           const std::string& parent) {
  BodyDefinition body;
  body.name = name;
  body.parent = parent;
  body.joint.kind = kind;
  body.joint.axis = random.direction();
  if (kind == JointKind::universal || kind == JointKind::planar) {
    body.joint.second_axis = body.joint.axis.cross(random.direction()).normalized();
  }
  body.X_PJ = random.pose(1);
  body.mass = random.uniform(0.5, 3);
  body.p_BoBcm_B = random.vector(0.5);
  // Three pairs of point masses on perpendicular lines: an inertia that a body can have.
  const Matrix3 R = random.rotation();
  const Vector3 second(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
  body.I_BBcm_B = R * (second.sum() * Vector3::Ones() - second).asDiagonal() * R.transpose();
  return body;
}

Mechanism random_tree(Random& random, int count, bool with_drives) {
  static constexpr JointKind kinds[] = {
      JointKind::free,        JointKind::revolute,  JointKind::fixed,
      JointKind::cylindrical, JointKind::spherical, JointKind::planar,
      JointKind::prismatic,   JointKind::universal, JointKind::translational};
  MechanismBuilder builder;
  builder.set_gravity(random.vector(10));
  for (int i = 0; i < count; ++i) {
    const JointKind kind = kinds[(i + random.integer(0, 1)) % 9];
    const int parent = random.integer(std::max(0, i - 3), i);
    BodyDefinition body =
        random_body(random, kind, "body" + std::to_string(i + 1),
                    parent == 0 ? std::string(world_name) : "body" + std::to_string(parent));
    const auto nv = static_cast<std::size_t>(velocity_count(kind));
    if (random.integer(0, 1) == 0) {
      for (std::size_t k = 0; k < nv; ++k) body.damping.push_back(random.uniform(0, 2));
    }
    if (with_drives && random.integer(0, 2) == 0) {
      body.driven.assign(nv, true);
      // Now and then a single coordinate of a joint that allows it.
      if (nv > 1 && velocities_are_rates(kind)) body.driven[0] = false;
    }
    builder.add_body(body);
  }
  return builder.build();
}

Eigen::VectorXd random_configuration(Random& random, const Mechanism& mechanism) {
  Eigen::VectorXd q = random.values(mechanism.nq(), 2);
  mechanism.normalise(q);
  return q;
}

std::vector<ForceVector> random_forces(Random& random, const Mechanism& mechanism) {
  std::vector<ForceVector> forces;
  for (int i = 0; i < mechanism.body_count(); ++i) forces.push_back(random.force());
  return forces;
}

std::vector<ForceVector> no_forces(const Mechanism& mechanism) {
  return std::vector<ForceVector>(static_cast<std::size_t>(mechanism.body_count()),
                                  ForceVector::zero());
}

}  // namespace blocklift::dynamics::examples
