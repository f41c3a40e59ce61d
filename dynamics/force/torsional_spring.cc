#include "dynamics/force/torsional_spring.h"

#include "dynamics/errors.h"
#include "dynamics/force/spring.h"
#include "dynamics/spatial/rotation_vector.h"

namespace blocklift::dynamics {

TorsionalSpring::TorsionalSpring(Definition definition) : definition_(std::move(definition)) {
  require_spring_value(definition_.name, "stiffness", definition_.stiffness);
  require_spring_value(definition_.name, "damping", definition_.damping);
  if (definition_.from == definition_.to) {
    throw ModelError("spring \"" + definition_.name +
                     "\" has both ends on one body, so it can do nothing; join two bodies");
  }
}

Vector3 TorsionalSpring::calc_turn(const MotionState& state) const {
  const Matrix3& R_WF = state.kinematics.X_WB[definition_.from].R;
  const Matrix3& R_WT = state.kinematics.X_WB[definition_.to].R;
  const Matrix3 turned = R_WT * definition_.R_FT_free.transpose() * R_WF.transpose();
  return rotation_vector(quaternion_from_rotation(turned));
}

Vector3 TorsionalSpring::relative_velocity(const MotionState& state) const {
  return state.kinematics.V_WB[definition_.to].angular -
         state.kinematics.V_WB[definition_.from].angular;
}

Vector3 TorsionalSpring::calc_moment(const MotionState& state) const {
  return -definition_.stiffness * calc_turn(state) - definition_.damping * relative_velocity(state);
}

void TorsionalSpring::add_forces(const MotionState& state, Loads& loads) const {
  const Vector3 moment = calc_moment(state);
  loads.F_Bo_W[definition_.to].moment += moment;
  loads.F_Bo_W[definition_.from].moment -= moment;
}

// theta in W turns with F and grows by the relative turn:
//   dtheta = turn_F x theta + J_l^-1(theta) (turn_T - turn_F).
void TorsionalSpring::add_derivatives(const MotionState& state,
                                      ForceDerivatives& derivatives) const {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Vector3 theta = calc_turn(state);
  const Matrix3 growth = inverse_left_jacobian(theta);
  derivatives.locate(0, definition_.from, Vector3::Zero());
  derivatives.locate(1, definition_.to, Vector3::Zero());
  Matrix6 by_to = Matrix6::Zero(), by_from = Matrix6::Zero(), by_velocity = Matrix6::Zero();
  by_to.topLeftCorner<3, 3>() = -definition_.stiffness * growth;
  by_from.topLeftCorner<3, 3>() = definition_.stiffness * (growth + skew(theta));
  by_velocity.topLeftCorner<3, 3>() = -definition_.damping * Matrix3::Identity();
  derivatives.add_wrench_block(1, 1, by_to, by_velocity, true);
  derivatives.add_wrench_block(1, 0, by_from, -by_velocity, true);
  derivatives.add_wrench_block(0, 1, -by_to, -by_velocity, true);
  derivatives.add_wrench_block(0, 0, -by_from, by_velocity, true);
}

EnergyAccount TorsionalSpring::calc_energy(const MotionState& state) const {
  return {.stored_energy = 0.5 * definition_.stiffness * calc_turn(state).squaredNorm(),
          .dissipated_power = definition_.damping * relative_velocity(state).squaredNorm()};
}

}  // namespace blocklift::dynamics
