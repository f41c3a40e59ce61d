// Orocos KDL: chains only, by its recursive Newton-Euler solver over the joint-space inertia.
#include <kdl/chain.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>

#include "tests/benchmarks/peers/peer.h"

namespace blocklift::peers {

namespace {

KDL::Vector vector(const Triple& a) { return {a[0], a[1], a[2]}; }

KDL::Chain build(const TreeModel& model) {
  KDL::Chain chain;
  for (const TreeBody& body : model.bodies) {
    // A segment's own frame is at its tip: with the joint at the tip, it is the body's frame.
    const Rotation& I = body.I_BBcm;
    const KDL::RigidBodyInertia inertia(body.mass, vector(body.p_BoBcm),
                                        KDL::RotationalInertia(I[0], I[4], I[8], I[1], I[2], I[5]));
    const Rotation& R = body.R_PB;
    const KDL::Frame tip(KDL::Rotation(R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]),
                         vector(body.p_PB));
    const KDL::Joint joint("", tip.p, tip.M * vector(body.axis), KDL::Joint::RotAxis);
    chain.addSegment(KDL::Segment("", joint, tip, inertia));
  }
  return chain;
}

class KdlChain : public TreeDynamics {
 public:
  explicit KdlChain(const TreeModel& model)
      : chain_(build(model)),
        solver_(chain_, KDL::Vector(0, 0, -gravity)),
        vdot_(chain_.getNrOfJoints()),
        forces_(chain_.getNrOfSegments(), KDL::Wrench::Zero()) {}

  void set_states(const std::vector<TreeState>& states) override {
    states_.clear();
    for (const TreeState& state : states) {
      states_.push_back({array(state.q), array(state.v), array(state.tau)});
    }
  }

  void evaluate(std::size_t which) override {
    const State& state = states_[which];
    solver_.CartToJnt(state.q, state.v, state.tau, forces_, vdot_);
  }

  Accelerations accelerations() const override {
    Accelerations result(6, 0.0);
    for (unsigned i = 0; i < vdot_.rows(); ++i) result.push_back(vdot_(i));
    return result;
  }

 private:
  struct State {
    KDL::JntArray q, v, tau;
  };

  static KDL::JntArray array(const std::vector<double>& values) {
    KDL::JntArray result(static_cast<unsigned>(values.size()));
    for (unsigned i = 0; i < result.rows(); ++i) result(i) = values[i];
    return result;
  }

  KDL::Chain chain_;
  KDL::ChainFdSolver_RNE solver_;
  std::vector<State> states_;
  KDL::JntArray vdot_;
  KDL::Wrenches forces_;
};

std::unique_ptr<TreeDynamics> make_tree(const TreeModel& model) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    if (model.bodies[i].free || model.bodies[i].parent != static_cast<int>(i) - 1) return nullptr;
  }
  return std::make_unique<KdlChain>(model);
}

}  // namespace

}  // namespace blocklift::peers

extern "C" const blocklift::peers::PeerModule* peer_module() {
  static const blocklift::peers::PeerModule module{"Orocos KDL", PEER_VERSION,
                                                   blocklift::peers::make_tree, nullptr, nullptr};
  return &module;
}
