#include "dynamics/multibody/energy.h"

namespace blocklift::dynamics {
namespace {

// Momentum of one body about its centre of mass, in W, with where that centre is.
struct CentroidalMomentum {
  Vector3 p_WBcm;
  Vector3 v_WBcm;
  Vector3 angular;

  CentroidalMomentum(const Body& body, const Pose& X_WB, const MotionVector& V_WB) {
    const Vector3 c = X_WB.R * body.inertia.p_BoBcm;
    p_WBcm = X_WB.p + c;
    v_WBcm = shift(V_WB, c).linear;
    angular = X_WB.R * (body.inertia.I_BBcm * (X_WB.R.transpose() * V_WB.angular));
  }
};

template <class Visit>
void for_each_mass(const Mechanism& mechanism, const Kinematics& kinematics, Visit visit) {
  for (std::size_t b = 1; b < mechanism.bodies().size(); ++b) {
    const Body& body = mechanism.bodies()[b];
    const MotionVector& V_WB = kinematics.V_WB[b];
    visit(body.inertia.mass, V_WB, CentroidalMomentum(body, kinematics.X_WB[b], V_WB));
  }
}

}  // namespace

double calc_kinetic_energy(const Mechanism& mechanism, const Kinematics& kinematics) {
  double energy = 0;
  for_each_mass(mechanism, kinematics,
                [&](double mass, const MotionVector& V_WB, const CentroidalMomentum& body) {
                  energy +=
                      0.5 * mass * body.v_WBcm.squaredNorm() + 0.5 * V_WB.angular.dot(body.angular);
                });
  return energy;
}

double calc_vibration_energy(const Mechanism& mechanism, ConstVectorRef v) {
  double energy = 0;
  for (const ElasticMode& mode : mechanism.elastic_modes()) {
    energy += 0.5 * mode.modal_mass * v[mode.v_index] * v[mode.v_index];
  }
  return energy;
}

double calc_gravity_potential(const Mechanism& mechanism, const Kinematics& kinematics) {
  double energy = 0;
  for_each_mass(mechanism, kinematics,
                [&](double mass, const MotionVector&, const CentroidalMomentum& body) {
                  energy -= mass * mechanism.gravity().dot(body.p_WBcm);
                });
  return energy;
}

ForceVector calc_momentum(const Mechanism& mechanism, const Kinematics& kinematics) {
  ForceVector momentum = ForceVector::zero();
  for_each_mass(mechanism, kinematics,
                [&](double mass, const MotionVector&, const CentroidalMomentum& body) {
                  const Vector3 linear = mass * body.v_WBcm;
                  momentum += {body.angular + body.p_WBcm.cross(linear), linear};
                });
  return momentum;
}

double calc_damping_power(const Mechanism& mechanism, ConstVectorRef v) {
  double power = 0;
  for (int k = 0; k < mechanism.nv(); ++k) {
    power += mechanism.damping()[k] * v[k] * v[k];
  }
  return power;
}

RigidBodyInertia calc_mass_properties(const Mechanism& mechanism, const Kinematics& kinematics,
                                      BodyIndex body) {
  RigidBodyInertia sum = RigidBodyInertia::zero();
  const auto carries = [&](BodyIndex i) {
    while (i > body) i = mechanism.bodies()[i].parent;
    return i == body;
  };
  for (BodyIndex i = 1; i < mechanism.body_count(); ++i) {
    if (!carries(i)) continue;
    const auto b = static_cast<std::size_t>(i);
    sum = sum + transform(kinematics.X_WB[b], mechanism.bodies()[b].inertia);
  }
  return sum;
}

}  // namespace blocklift::dynamics
