#include "dynamics/marine/loads/level_axes.h"

#include <cmath>

namespace blocklift::dynamics {

double find_heading(const Matrix3& R_WH) { return std::atan2(R_WH(1, 0), R_WH(0, 0)); }

Matrix3 level_axes(const Matrix3& R_WH) {
  const double size = std::hypot(R_WH(0, 0), R_WH(1, 0));
  const double c = size > 0.0 ? R_WH(0, 0) / size : 1.0;
  const double s = size > 0.0 ? R_WH(1, 0) / size : 0.0;
  Matrix3 R_WL;
  R_WL << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return R_WL;
}

void turn_to_level_axes(const std::vector<BodyFrame>& frames, const Kinematics& kinematics,
                        Eigen::Ref<Eigen::MatrixXd> rows) {
  Eigen::Index row = 0;
  for (const BodyFrame& frame : frames) {
    const Matrix3 R_WH = kinematics.X_WB[frame.body].R * frame.X_BH.R;
    const Matrix3 R_LH = level_axes(R_WH).transpose() * R_WH;
    for (Eigen::Index column = 0; column < rows.cols(); ++column) {
      for (const Eigen::Index part : {row, row + 3}) {
        const Vector3 in_H = rows.block<3, 1>(part, column);
        rows.block<3, 1>(part, column) = R_LH * in_H;
      }
    }
    row += 6;
  }
}

void add_level_forces(const std::vector<BodyFrame>& frames, const Kinematics& kinematics,
                      ConstVectorRef force, std::vector<ForceVector>& F_Bo_W) {
  Eigen::Index row = 0;
  for (const BodyFrame& frame : frames) {
    const Pose& X_WB = kinematics.X_WB[frame.body];
    const Matrix3 R_WL = level_axes(X_WB.R * frame.X_BH.R);
    const ForceVector F_R_W{R_WL * force.segment<3>(row), R_WL * force.segment<3>(row + 3)};
    F_Bo_W[frame.body] += shift_to(F_R_W, X_WB.R * frame.X_BH.p);
    row += 6;
  }
}

}  // namespace blocklift::dynamics
