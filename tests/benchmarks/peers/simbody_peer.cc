// Simbody: articulated-body algorithm, realised to accelerations as its integrators do it.
#include <Simbody.h>

#include "tests/benchmarks/peers/peer.h"
#include "tests/benchmarks/peers/simbody_simulations.h"

namespace blocklift::peers {

namespace {

using namespace SimTK;

Vec3 vector(const Triple& a) { return {a[0], a[1], a[2]}; }
Mat33 matrix(const SimTK::Real* a) {
  return {a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8]};
}
SimTK::Rotation rotation(const blocklift::peers::Rotation& a) {
  return SimTK::Rotation(matrix(a.data()), true);
}

Body body_of(const TreeBody& body) {
  const blocklift::peers::Rotation& I = body.I_BBcm;
  const Vec3 p = vector(body.p_BoBcm);
  const Inertia central(I[0], I[4], I[8], I[1], I[2], I[5]);
  return Body::Rigid(MassProperties(body.mass, p, central.shiftFromMassCenter(p, body.mass)));
}

class SimbodyTree : public TreeDynamics {
 public:
  explicit SimbodyTree(const TreeModel& model)
      : floats_(model.floats()),
        matter_(system_),
        forces_(system_),
        gravity_(forces_, matter_, Vec3(0, 0, -gravity)),
        applied_(forces_, matter_) {
    for (const TreeBody& body : model.bodies) {
      MobilizedBody& parent = body.parent < 0
                                  ? static_cast<MobilizedBody&>(matter_.updGround())
                                  : matter_.updMobilizedBody(MobilizedBodyIndex(body.parent + 1));
      if (body.free) {
        MobilizedBody::Free(parent, body_of(body));
        continue;
      }
      // A pin turns about z of its frames.
      const SimTK::Rotation R_BM(UnitVec3(vector(body.axis)), ZAxis);
      const Transform X_PF(rotation(body.R_PB) * R_BM, vector(body.p_PB));
      MobilizedBody::Pin(parent, X_PF, body_of(body), Transform(R_BM));
    }
    system_.realizeTopology();
    state_ = system_.getDefaultState();
    system_.realizeModel(state_);
  }

  void set_states(const std::vector<TreeState>& states) override {
    states_.clear();
    for (const TreeState& state : states) states_.push_back(own(state));
  }

  void evaluate(std::size_t which) override {
    const OwnState& state = states_[which];
    state_.updQ() = state.q;
    state_.updU() = state.v;
    applied_.setAllMobilityForces(state_, state.tau);
    system_.realize(state_, Stage::Acceleration);
  }

  Accelerations accelerations() const override {
    Accelerations result(6, 0.0);
    if (floats_) {
      const MobilizedBody& base = matter_.getMobilizedBody(MobilizedBodyIndex(1));
      const SpatialVec A = base.getBodyAcceleration(state_);
      for (int i = 0; i < 3; ++i) {
        result[i] = A[0][i];
        result[3 + i] = A[1][i];
      }
    }
    const Vector& vdot = state_.getUDot();
    for (int i = floats_ ? 6 : 0; i < vdot.size(); ++i) result.push_back(vdot[i]);
    return result;
  }

 private:
  struct OwnState {
    Vector q, v, tau;
  };

  OwnState own(const TreeState& state) const {
    const int n = static_cast<int>(state.q.size());
    OwnState result{Vector(state_.getNQ()), Vector(state_.getNU()), Vector(state_.getNU(), 0.0)};
    if (floats_) {
      for (int i = 0; i < 4; ++i) result.q[i] = state.quaternion[i];
      for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        result.q[4 + i] = state.p_WB[k];
        result.v[i] = state.w_WB[k];
        result.v[3 + i] = state.v_WB[k];
      }
    }
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      result.q[(floats_ ? 7 : 0) + i] = state.q[k];
      result.v[(floats_ ? 6 : 0) + i] = state.v[k];
      result.tau[(floats_ ? 6 : 0) + i] = state.tau[k];
    }
    return result;
  }

  bool floats_;
  MultibodySystem system_;
  SimbodyMatterSubsystem matter_;
  GeneralForceSubsystem forces_;
  Force::UniformGravity gravity_;
  Force::DiscreteForces applied_;
  State state_;
  std::vector<OwnState> states_;
};

std::unique_ptr<TreeDynamics> make_tree(const TreeModel& model) {
  return std::make_unique<SimbodyTree>(model);
}

std::string version() {
  int major = 0, minor = 0, patch = 0;
  SimTK_version_simbody(&major, &minor, &patch);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

}  // namespace

}  // namespace blocklift::peers

extern "C" const blocklift::peers::PeerModule* peer_module() {
  using namespace blocklift::peers;
  static const std::string number = version();
  static const PeerModule module{"Simbody", number.c_str(), make_tree, simulate_block_on_six_ropes,
                                 simulate_andrews};
  return &module;
}
