#include "tests/dynamics/simulation/sample_mechanisms.h"

namespace blocklift::dynamics::test {

LiftSystem andrews(LoopKind kind) {
  Mechanism mechanism = AndrewsSqueezer{kind}.build();
  const BodyIndex K1 = mechanism.body_index("K1");
  const BodyIndex K3 = mechanism.body_index("K3");
  ForceElements elements;
  std::get<std::vector<PointSpring>>(elements).emplace_back(
      PointSpring::Definition{.name = "spring",
                              .from = {world_index, AndrewsSqueezer::p_WC},
                              .to = {K3, AndrewsSqueezer::p_K3D},
                              .stiffness = AndrewsSqueezer::spring_stiffness,
                              .free_length = AndrewsSqueezer::spring_free_length});
  // A spring so soft and so far wound up that its moment is constant to 1e-14.
  constexpr double stiffness = 1e-17;
  std::get<std::vector<JointSpring>>(elements).emplace_back(
      mechanism, JointSpring::Definition{.name = "drive moment",
                                         .body = K1,
                                         .stiffness = stiffness,
                                         .free_coordinate = AndrewsSqueezer::moment / stiffness});
  OperationBuilder operation;
  return LiftSystem({.mechanism = std::move(mechanism),
                     .elements = std::move(elements),
                     .operation = operation.build(0.03),
                     .q_start = AndrewsSqueezer::q_start()});
}

Eigen::VectorXd andrews_q_end() {
  Eigen::VectorXd q(7);
  q << 15.81077119515370709712, -15.75637105841183946973, 0.04082224011964580486,
      0.52440996587995406937, -0.53473011634207959377, 1.04808074104193787307,
      0.53473011634207959377;
  return q;
}

LiftSystem mechanism_alone(Mechanism mechanism, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                           double duration) {
  OperationBuilder operation;
  return LiftSystem({.mechanism = std::move(mechanism),
                     .operation = operation.build(duration),
                     .q_start = q,
                     .v_start = v});
}

}  // namespace blocklift::dynamics::test
