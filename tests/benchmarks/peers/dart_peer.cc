// DART: articulated-body algorithm of a skeleton.
#include <dart/config.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>

#include "tests/benchmarks/peers/peer.h"

namespace blocklift::peers {

namespace {

using namespace dart::dynamics;

Eigen::Vector3d vector(const Triple& a) { return {a[0], a[1], a[2]}; }
Eigen::Matrix3d matrix(const Rotation& a) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(a.data());
}
Eigen::Isometry3d pose(const Rotation& R, const Triple& p) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = matrix(R);
  X.translation() = vector(p);
  return X;
}

class DartTree : public TreeDynamics {
 public:
  explicit DartTree(const TreeModel& model)
      : floats_(model.floats()), skeleton_(Skeleton::create()) {
    skeleton_->setGravity({0, 0, -gravity});
    for (const TreeBody& body : model.bodies) {
      BodyNode* parent =
          body.parent < 0 ? nullptr : skeleton_->getBodyNode(static_cast<std::size_t>(body.parent));
      BodyNode::Properties properties;
      properties.mName = std::to_string(skeleton_->getNumBodyNodes());
      properties.mInertia = Inertia(body.mass, vector(body.p_BoBcm), matrix(body.I_BBcm));
      if (body.free) {
        skeleton_->createJointAndBodyNodePair<FreeJoint>(parent, FreeJoint::Properties(),
                                                         properties);
        continue;
      }
      RevoluteJoint::Properties joint;
      joint.mName = "joint" + properties.mName;
      joint.mAxis = vector(body.axis);
      joint.mT_ParentBodyToJoint = pose(body.R_PB, body.p_PB);
      skeleton_->createJointAndBodyNodePair<RevoluteJoint>(parent, joint, properties);
    }
  }

  void set_states(const std::vector<TreeState>& states) override {
    states_.clear();
    for (const TreeState& state : states) states_.push_back(own(state));
  }

  void evaluate(std::size_t which) override {
    const State& state = states_[which];
    skeleton_->setPositions(state.q);
    skeleton_->setVelocities(state.v);
    skeleton_->setForces(state.tau);
    skeleton_->computeForwardDynamics();
  }

  Accelerations accelerations() const override {
    Accelerations result(6, 0.0);
    if (floats_) {
      const BodyNode* base = skeleton_->getBodyNode(0);
      Eigen::Map<Eigen::Vector3d>(result.data(), 3) = base->getAngularAcceleration();
      Eigen::Map<Eigen::Vector3d>(result.data() + 3, 3) = base->getLinearAcceleration();
    }
    const Eigen::VectorXd vdot = skeleton_->getAccelerations();
    result.insert(result.end(), vdot.begin() + (floats_ ? 6 : 0), vdot.end());
    return result;
  }

 private:
  struct State {
    Eigen::VectorXd q, v, tau;
  };

  State own(const TreeState& state) {
    const auto n = static_cast<Eigen::Index>(state.q.size());
    const auto dofs = static_cast<Eigen::Index>(skeleton_->getNumDofs());
    State result{Eigen::VectorXd::Zero(dofs), Eigen::VectorXd::Zero(dofs),
                 Eigen::VectorXd::Zero(dofs)};
    if (floats_) {
      auto* joint = static_cast<FreeJoint*>(skeleton_->getJoint(0));
      joint->setRelativeTransform(pose(state.R_WB, state.p_WB));
      Eigen::Vector6d V;
      V << vector(state.w_WB), vector(state.v_WB);
      joint->setSpatialVelocity(V, Frame::World(), Frame::World());
      // A spatial velocity given in W counts at Bo when set by its two halves.
      joint->setLinearVelocity(vector(state.v_WB), Frame::World(), Frame::World());
      result.q.head<6>() = joint->getPositions();
      result.v.head<6>() = joint->getVelocities();
    }
    result.q.tail(n) = Eigen::Map<const Eigen::VectorXd>(state.q.data(), n);
    result.v.tail(n) = Eigen::Map<const Eigen::VectorXd>(state.v.data(), n);
    result.tau.tail(n) = Eigen::Map<const Eigen::VectorXd>(state.tau.data(), n);
    return result;
  }

  bool floats_;
  SkeletonPtr skeleton_;
  std::vector<State> states_;
};

std::unique_ptr<TreeDynamics> make_tree(const TreeModel& model) {
  return std::make_unique<DartTree>(model);
}

}  // namespace

}  // namespace blocklift::peers

extern "C" const blocklift::peers::PeerModule* peer_module() {
  static const blocklift::peers::PeerModule module{"DART", DART_VERSION,
                                                   blocklift::peers::make_tree, nullptr, nullptr};
  return &module;
}
