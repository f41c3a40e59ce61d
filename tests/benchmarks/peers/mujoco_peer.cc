// MuJoCo: joint-space inertia by composite bodies, sparse LTL factors. Contacts and constraints are
// off, and of mj_forward only those stages are called without which there would be no
// accelerations.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "tests/benchmarks/peers/peer.h"

namespace blocklift::peers {

namespace {

using RowMatrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

std::string text(const double* values, int count) {
  std::ostringstream stream;
  stream.precision(17);
  for (int i = 0; i < count; ++i) stream << (i > 0 ? " " : "") << values[i];
  return stream.str();
}

std::string quaternion(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond e(R);
  const double values[] = {e.w(), e.x(), e.y(), e.z()};
  return text(values, 4);
}

// The inertia by its principal moments, which is how the library keeps it.
std::string inertial(const TreeBody& body) {
  const Eigen::Matrix3d I = Eigen::Map<const RowMatrix3>(body.I_BBcm.data());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(I);
  Eigen::Matrix3d R = solver.eigenvectors();
  if (R.determinant() < 0) R.col(0) *= -1;
  return "<inertial pos='" + text(body.p_BoBcm.data(), 3) + "' quat='" + quaternion(R) +
         "' mass='" + text(&body.mass, 1) + "' diaginertia='" +
         text(solver.eigenvalues().data(), 3) + "'/>";
}

// A model's text in files of a file system in memory: the reader of XML allows 100 elements within
// one another, which a chain of 100 bodies exceeds, so that every 40 levels the rest goes into a
// file of its own.
class ModelText {
 public:
  explicit ModelText(const TreeModel& model) : model_(model) {
    std::ostringstream xml;
    xml << "<mujoco><compiler angle='radian' inertiafromgeom='false'/><option gravity='0 0 "
        << -gravity << "'><flag constraint='disable' contact='disable' passive='disable'/></option>"
        << "<worldbody>";
    write_body(0, 1, xml);
    xml << "</worldbody></mujoco>";
    files_.insert(files_.begin(), xml.str());
  }

  mjModel* load() const {
    const auto system = std::make_unique<mjVFS>();
    mj_defaultVFS(system.get());
    for (std::size_t i = 0; i < files_.size(); ++i) {
      mj_makeEmptyFileVFS(system.get(), file_name(i).c_str(), static_cast<int>(files_[i].size()));
      std::copy(files_[i].begin(), files_[i].end(), static_cast<char*>(system->filedata[i]));
    }
    char error[1000] = "";
    mjModel* loaded = mj_loadXML(file_name(0).c_str(), system.get(), error, sizeof error);
    // Not by mj_deleteFileVFS, which does not return in release 2.2.2.
    for (std::size_t i = 0; i < files_.size(); ++i) mju_free(system->filedata[i]);
    if (!loaded) throw std::runtime_error(std::string("MuJoCo: ") + error);
    return loaded;
  }

 private:
  static std::string file_name(std::size_t i) { return "part" + std::to_string(i) + ".xml"; }

  void write_body(std::size_t i, int depth, std::ostream& xml) {
    const TreeBody& body = model_.bodies[i];
    const Eigen::Matrix3d R = Eigen::Map<const RowMatrix3>(body.R_PB.data());
    xml << "<body pos='" << text(body.p_PB.data(), 3) << "' quat='" << quaternion(R) << "'>"
        << inertial(body);
    if (body.free) {
      xml << "<freejoint/>";
    } else {
      xml << "<joint type='hinge' axis='" << text(body.axis.data(), 3) << "'/>";
    }
    for (std::size_t k = i + 1; k < model_.bodies.size(); ++k) {
      if (model_.bodies[k].parent != static_cast<int>(i)) continue;
      if (depth % 40 == 0) {
        std::ostringstream part;
        part << "<mujocoinclude>";
        write_body(k, depth + 1, part);
        part << "</mujocoinclude>";
        files_.push_back(part.str());
        xml << "<include file='" << file_name(files_.size()) << "'/>";
      } else {
        write_body(k, depth + 1, xml);
      }
    }
    xml << "</body>";
  }

  const TreeModel& model_;
  std::vector<std::string> files_;  ///< the main one first, once all is written
};

class MujocoTree : public TreeDynamics {
 public:
  explicit MujocoTree(const TreeModel& model)
      : floats_(model.floats()), model_(ModelText(model).load()), data_(mj_makeData(model_)) {}
  ~MujocoTree() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoTree(const MujocoTree&) = delete;
  MujocoTree& operator=(const MujocoTree&) = delete;

  void set_states(const std::vector<TreeState>& states) override {
    states_.clear();
    for (const TreeState& state : states) states_.push_back(own(state));
  }

  void evaluate(std::size_t which) override {
    const State& state = states_[which];
    std::copy(state.q.begin(), state.q.end(), data_->qpos);
    std::copy(state.v.begin(), state.v.end(), data_->qvel);
    mj_kinematics(model_, data_);
    mj_comPos(model_, data_);
    mj_crb(model_, data_);
    mj_factorM(model_, data_);
    mj_comVel(model_, data_);
    mj_rne(model_, data_, 0, data_->qfrc_bias);
    for (int i = 0; i < model_->nv; ++i) {
      data_->qfrc_smooth[i] = state.tau[i] - data_->qfrc_bias[i];
    }
    mj_solveM(model_, data_, data_->qacc, data_->qfrc_smooth, 1);
  }

  Accelerations accelerations() const override {
    Accelerations result(6, 0.0);
    if (floats_) {
      const RowMatrix3 R = Eigen::Map<const RowMatrix3>(data_->xmat + 9);
      Eigen::Map<Eigen::Vector3d>(result.data(), 3) =
          R * Eigen::Map<const Eigen::Vector3d>(data_->qacc + 3);
      std::copy(data_->qacc, data_->qacc + 3, result.begin() + 3);
    }
    result.insert(result.end(), data_->qacc + (floats_ ? 6 : 0), data_->qacc + model_->nv);
    return result;
  }

 private:
  struct State {
    std::vector<double> q, v, tau;
  };

  State own(const TreeState& state) const {
    State result;
    if (floats_) {
      result.q.assign(state.p_WB.begin(), state.p_WB.end());
      result.q.insert(result.q.end(), state.quaternion.begin(), state.quaternion.end());
      result.v.assign(state.v_WB.begin(), state.v_WB.end());
      const RowMatrix3 R = Eigen::Map<const RowMatrix3>(state.R_WB.data());
      const Eigen::Vector3d w_B =
          R.transpose() * Eigen::Map<const Eigen::Vector3d>(state.w_WB.data());
      result.v.insert(result.v.end(), w_B.begin(), w_B.end());
      result.tau.assign(6, 0.0);
    }
    result.q.insert(result.q.end(), state.q.begin(), state.q.end());
    result.v.insert(result.v.end(), state.v.begin(), state.v.end());
    result.tau.insert(result.tau.end(), state.tau.begin(), state.tau.end());
    return result;
  }

  bool floats_;
  mjModel* model_;
  mjData* data_;
  std::vector<State> states_;
};

std::unique_ptr<TreeDynamics> make_tree(const TreeModel& model) {
  return std::make_unique<MujocoTree>(model);
}

}  // namespace

}  // namespace blocklift::peers

extern "C" const blocklift::peers::PeerModule* peer_module() {
  static const blocklift::peers::PeerModule module{"MuJoCo", mj_versionString(),
                                                   blocklift::peers::make_tree, nullptr, nullptr};
  return &module;
}
