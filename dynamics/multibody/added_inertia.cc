#include "dynamics/multibody/added_inertia.h"

#include <string>

#include <Eigen/Core>

#include "algebra/decompositions.h"
#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

// Of the largest entry: asymmetry, and eigenvalues below zero, that count as rounding.
constexpr double rounding = 1e-6;

void check(const std::vector<BodyFrame>& frames, const Eigen::MatrixXd& matrix) {
  const auto size = static_cast<Eigen::Index>(6 * frames.size());
  if (matrix.rows() != size || matrix.cols() != size) {
    throw ModelError("the added inertia of " + std::to_string(frames.size()) +
                     " bodies is a matrix of " + std::to_string(matrix.rows()) + " x " +
                     std::to_string(matrix.cols()) + "; 6 rows and columns a body are due");
  }
  if (!matrix.allFinite()) throw ModelError("the added inertia has entries that are not finite");
  const Eigen::VectorXd scale = matrix.diagonal().cwiseAbs().cwiseSqrt().cwiseMax(1e-300);
  const Eigen::MatrixXd relative =
      scale.cwiseInverse().asDiagonal() * matrix * scale.cwiseInverse().asDiagonal();
  if ((relative - relative.transpose()).cwiseAbs().maxCoeff() > rounding) {
    throw ModelError("the added inertia is not symmetric: energy would come from nowhere");
  }
  if (algebra::symmetric_eigenvalues(relative)[0] < -rounding * static_cast<double>(size)) {
    throw ModelError("the added inertia is not positive: some motion would gain energy by moving");
  }
  for (const BodyFrame& frame : frames) {
    if (frame.body <= world_index) throw ModelError("added inertia is due to a body that can move");
  }
}

}  // namespace

AddedInertia::AddedInertia(std::vector<BodyFrame> frames, Eigen::MatrixXd matrix)
    : frames_(std::move(frames)), matrix_(std::move(matrix)) {
  check(frames_, matrix_);
  matrix_ = (0.5 * (matrix_ + matrix_.transpose())).eval();
}

std::vector<BodyIndex> AddedInertia::bodies() const {
  std::vector<BodyIndex> bodies;
  for (const BodyFrame& frame : frames_) bodies.push_back(frame.body);
  return bodies;
}

void AddedInertia::calc_velocity(const Kinematics& kinematics, VectorRef u) const {
  Eigen::Index row = 0;
  for (const BodyFrame& frame : frames_) {
    const auto b = static_cast<std::size_t>(frame.body);
    const Matrix3 R_WH = kinematics.X_WB[b].R * frame.X_BH.R;
    const MotionVector V = shift(kinematics.V_WB[b], kinematics.X_WB[b].R * frame.X_BH.p);
    u.segment<3>(row).noalias() = R_WH.transpose() * V.angular;
    u.segment<3>(row + 3).noalias() = R_WH.transpose() * V.linear;
    row += 6;
  }
}

void AddedInertia::calc_jacobian(const Mechanism& mechanism, const Kinematics& kinematics,
                                 Eigen::Ref<Eigen::MatrixXd> jacobian) const {
  jacobian.setZero();
  Eigen::Index row = 0;
  for (const BodyFrame& frame : frames_) {
    const auto b = static_cast<std::size_t>(frame.body);
    const Matrix3 R_WH = kinematics.X_WB[b].R * frame.X_BH.R;
    const Vector3 p_WR = kinematics.X_WB[b].apply(frame.X_BH.p);
    for (BodyIndex i = frame.body; i != world_index;) {
      const Body& link = mechanism.bodies()[i];
      const Vector3 arm = p_WR - kinematics.X_WB[i].p;
      for (int k = link.v_offset; k < link.v_offset + link.nv(); ++k) {
        const auto column = static_cast<std::size_t>(k);
        const Vector3& direction = kinematics.direction_W[column];
        if (mechanism.angular()[column]) {
          jacobian.block<3, 1>(row, k).noalias() = R_WH.transpose() * direction;
          jacobian.block<3, 1>(row + 3, k).noalias() = R_WH.transpose() * direction.cross(arm);
        } else {
          jacobian.block<3, 1>(row + 3, k).noalias() = R_WH.transpose() * direction;
        }
      }
      i = link.carrier;
    }
    row += 6;
  }
}

void AddedInertia::calc_force(const Kinematics& kinematics, const std::vector<MotionVector>& A_WB,
                              const Eigen::MatrixXd& matrix, ConstVectorRef u, VectorRef momentum,
                              VectorRef force) const {
  // du/dt goes into `momentum` first.
  Eigen::Index row = 0;
  for (const BodyFrame& frame : frames_) {
    const auto b = static_cast<std::size_t>(frame.body);
    const Matrix3 R_WH = kinematics.X_WB[b].R * frame.X_BH.R;
    const Vector3 acceleration = point_acceleration(kinematics, A_WB, frame.body, frame.X_BH.p);
    const Vector3 w = u.segment<3>(row);
    momentum.segment<3>(row).noalias() = R_WH.transpose() * A_WB[b].angular;
    momentum.segment<3>(row + 3) =
        R_WH.transpose() * acceleration - w.cross(Vector3(u.segment<3>(row + 3)));
    row += 6;
  }
  force.noalias() = matrix * momentum;
  momentum.noalias() = matrix * u;
  for (row = 0; row < size(); row += 6) {
    const Vector3 w = u.segment<3>(row), v = u.segment<3>(row + 3);
    const Vector3 h = momentum.segment<3>(row), l = momentum.segment<3>(row + 3);
    force.segment<3>(row) += w.cross(h) + v.cross(l);
    force.segment<3>(row + 3) += w.cross(l);
  }
}

void add_frame_forces(const std::vector<BodyFrame>& frames, const Kinematics& kinematics,
                      ConstVectorRef force, std::vector<ForceVector>& F_Bo_W) {
  Eigen::Index row = 0;
  for (const BodyFrame& frame : frames) {
    const auto b = static_cast<std::size_t>(frame.body);
    const Matrix3 R_WH = kinematics.X_WB[b].R * frame.X_BH.R;
    const ForceVector F_R_W{R_WH * force.segment<3>(row), R_WH * force.segment<3>(row + 3)};
    F_Bo_W[b] += shift_to(F_R_W, kinematics.X_WB[b].R * frame.X_BH.p);
    row += 6;
  }
}

AddedInertiaWorkspace::AddedInertiaWorkspace(const Mechanism& mechanism,
                                             const AddedInertia& inertia)
    : matrix(inertia.matrix()),
      jacobian(Eigen::MatrixXd::Zero(inertia.size(), mechanism.nv())),
      product(jacobian),
      velocity(Eigen::VectorXd::Zero(inertia.size())),
      momentum(velocity),
      force(velocity) {}

void AddedInertiaWorkspace::add_mass(const Mechanism& mechanism, const Kinematics& kinematics,
                                     const AddedInertia& inertia,
                                     Eigen::Ref<Eigen::MatrixXd> mass) {
  inertia.calc_jacobian(mechanism, kinematics, jacobian);
  product.noalias() = matrix * jacobian;
  // Products without blocking, column by column: those of large matrices take memory.
  for (Eigen::Index k = 0; k < mass.cols(); ++k) {
    mass.col(k).noalias() += jacobian.transpose() * product.col(k);
  }
}

void AddedInertiaWorkspace::add_force(const Kinematics& kinematics, const AddedInertia& inertia,
                                      const std::vector<MotionVector>& A_WB, VectorRef tau) {
  inertia.calc_velocity(kinematics, velocity);
  inertia.calc_force(kinematics, A_WB, matrix, velocity, momentum, force);
  tau.noalias() += jacobian.transpose() * force;
}

}  // namespace blocklift::dynamics
