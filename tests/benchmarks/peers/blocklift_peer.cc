#include "tests/benchmarks/peers/blocklift_peer.h"

#include "dynamics/multibody/forward_dynamics.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/models/rope_lifts.h"
#include "tests/dynamics/multibody/sample_loops.h"

namespace blocklift::peers {

namespace {

using namespace dynamics;

Vector3 vector(const Triple& a) { return {a[0], a[1], a[2]}; }
Matrix3 matrix(const Rotation& a) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(a.data());
}

Mechanism build(const TreeModel& model) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -gravity});
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const TreeBody& body = model.bodies[i];
    builder.add_body({.name = std::to_string(i),
                      .parent = body.parent < 0 ? "world" : std::to_string(body.parent),
                      .joint = {.kind = body.free ? JointKind::free : JointKind::revolute,
                                .axis = body.free ? Vector3::UnitZ() : vector(body.axis)},
                      .X_PJ = {matrix(body.R_PB), vector(body.p_PB)},
                      .mass = body.mass,
                      .p_BoBcm_B = vector(body.p_BoBcm),
                      .I_BBcm_B = matrix(body.I_BBcm)});
  }
  return builder.build();
}

class BlockliftTree : public TreeDynamics {
 public:
  explicit BlockliftTree(const TreeModel& model)
      : floats_(model.floats()),
        mechanism_(build(model)),
        kinematics_(mechanism_),
        workspace_(mechanism_),
        forces_(static_cast<std::size_t>(mechanism_.body_count()), ForceVector::zero()),
        vdot_(mechanism_.nv()) {}

  void set_states(const std::vector<TreeState>& states) override {
    states_.clear();
    for (const TreeState& state : states) states_.push_back(own(state));
  }

  void evaluate(std::size_t which) override {
    State& state = states_[which];
    compute_kinematics(mechanism_, state.q, state.v, kinematics_);
    compute_forward_dynamics(mechanism_, kinematics_, state.v, forces_, workspace_, state.tau,
                             vdot_);
  }

  Accelerations accelerations() const override {
    Accelerations result(6, 0.0);
    if (floats_) {
      const MotionVector& A = workspace_.A_WB[1];
      Eigen::Map<Vector3>(result.data(), 3) = A.angular;
      Eigen::Map<Vector3>(result.data() + 3, 3) = A.linear;
    }
    result.insert(result.end(), vdot_.begin() + (floats_ ? 6 : 0), vdot_.end());
    return result;
  }

 private:
  struct State {
    Eigen::VectorXd q, v, tau;
  };

  State own(const TreeState& state) const {
    State result{Eigen::VectorXd(mechanism_.nq()), Eigen::VectorXd(mechanism_.nv()),
                 Eigen::VectorXd::Zero(mechanism_.nv())};
    const auto n = static_cast<Eigen::Index>(state.q.size());
    result.q.tail(n) = Eigen::Map<const Eigen::VectorXd>(state.q.data(), n);
    result.v.tail(n) = Eigen::Map<const Eigen::VectorXd>(state.v.data(), n);
    result.tau.tail(n) = Eigen::Map<const Eigen::VectorXd>(state.tau.data(), n);
    if (floats_) {
      const Matrix3 R = matrix(state.R_WB);
      result.q.head<3>() = vector(state.p_WB);
      result.q.segment<4>(3) = Eigen::Map<const Vector4>(state.quaternion.data());
      result.v.head<3>() = R.transpose() * vector(state.w_WB);
      result.v.segment<3>(3) = R.transpose() * vector(state.v_WB);
    }
    return result;
  }

  bool floats_;
  Mechanism mechanism_;
  Kinematics kinematics_;
  ForwardDynamicsWorkspace workspace_;
  std::vector<ForceVector> forces_;
  std::vector<State> states_;
  Eigen::VectorXd vdot_;
};

std::unique_ptr<TreeDynamics> make_tree(const TreeModel& model) {
  return std::make_unique<BlockliftTree>(model);
}

SimulationRun simulate_block_on_six_ropes(double accuracy) {
  static const LiftSystem lift = examples::block_on_six_ropes();
  const double interval = BlockOnSixRopes::duration / BlockOnSixRopes::samples;
  const IntegrationResult run =
      integrate(lift, lift.q_start(), lift.v_start(),
                {.relative_tolerance = accuracy, .sample_interval = interval, .works = false});
  SimulationRun result;
  for (int i = 1; i <= BlockOnSixRopes::samples; ++i) {
    const auto p = run.history.bodies[0].pose.row(i);
    result.values.insert(result.values.end(), {p[0], p[1], p[2]});
  }
  result.steps = run.statistics.steps;
  result.evaluations = run.statistics.right_hand_sides;
  return result;
}

LiftSystem squeezer() {
  Mechanism mechanism = test::AndrewsSqueezer{LoopKind::point_on_line}.build();
  ForceElements elements;
  std::get<std::vector<PointSpring>>(elements).emplace_back(
      PointSpring::Definition{.name = "spring",
                              .from = {world_index, {Andrews::xc, Andrews::yc, 0}},
                              .to = {mechanism.body_index("K3"), {Andrews::sd, -Andrews::sc, 0}},
                              .stiffness = Andrews::stiffness,
                              .free_length = Andrews::free_length});
  std::get<std::vector<JointLoad>>(elements).emplace_back(
      mechanism, JointLoad::Definition{.name = "drive",
                                       .body = mechanism.body_index("K1"),
                                       .load = LoadTable(Vector3(Andrews::moment, 0, 0))});
  return LiftSystem({.mechanism = std::move(mechanism),
                     .elements = std::move(elements),
                     .operation = OperationBuilder().build(Andrews::duration),
                     .q_start = test::AndrewsSqueezer::q_start()});
}

SimulationRun simulate_andrews(double accuracy) {
  static const LiftSystem system = squeezer();
  const IntegrationResult run = integrate(
      system, system.q_start(), system.v_start(),
      {.relative_tolerance = accuracy, .sample_interval = Andrews::duration, .works = false});
  const Eigen::VectorXd& q = run.q_end;  // in the order of the tree: K1 K2 K3 K5 K4 K7 K6
  return {{q[0], q[1], q[2], q[4], q[3], q[6], q[5]},
          run.statistics.steps,
          run.statistics.right_hand_sides};
}

}  // namespace

const PeerModule& blocklift_module() {
  static constexpr PeerModule module{"Blocklift", "this tree", make_tree,
                                     simulate_block_on_six_ropes, simulate_andrews};
  return module;
}

}  // namespace blocklift::peers
