#include "structure/response/support.h"

#include <array>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SVD>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

using Vector3 = Eigen::Vector3d;

// Row of the matrix that takes a rigid motion (translation; rotation times length) to component
// `axis` of the displacement at x.
Eigen::Matrix<double, 1, 6> rigid_row(const Vector3& x, int axis, double length) {
  Eigen::Matrix<double, 1, 6> row;
  row << Vector3::Unit(axis).transpose(), x.cross(Vector3::Unit(axis)).transpose() / length;
  return row;
}

}  // namespace

std::vector<FixedUnknown> statically_determinate_support(const Eigen::Matrix3Xd& nodes) {
  const Vector3 middle = nodes.rowwise().mean();
  std::array<Eigen::Index, 3> node{};
  (nodes.colwise() - middle).colwise().squaredNorm().maxCoeff(&node[0]);
  const Vector3 a = nodes.col(node[0]);
  const double length = std::sqrt((nodes.colwise() - a).colwise().squaredNorm().maxCoeff(&node[1]));
  const Vector3 along = (nodes.col(node[1]) - a).normalized();
  const double distance =
      ((nodes.colwise() - a) - along * (along.transpose() * (nodes.colwise() - a)))
          .colwise()
          .norm()
          .maxCoeff(&node[2]);
  if (!(distance > 1e-9 * length)) throw ModelError("all nodes of the mesh lie on one line");

  Eigen::Matrix<double, 6, 6> rows;
  for (int axis = 0; axis < 3; ++axis) rows.row(axis) = rigid_row(Vector3::Zero(), axis, length);
  const auto candidate = [&](int c) {
    return rigid_row(nodes.col(node[c < 3 ? 1 : 2]) - a, c % 3, length);
  };
  double best = -1;
  std::array<int, 3> chosen{};
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j)
      for (int k = j + 1; k < 6; ++k) {
        rows.row(3) = candidate(i);
        rows.row(4) = candidate(j);
        rows.row(5) = candidate(k);
        const double smallest =
            Eigen::JacobiSVD<Eigen::Matrix<double, 6, 6>>(rows).singularValues()[5];
        if (smallest <= best) continue;
        best = smallest;
        chosen = {i, j, k};
      }
  std::vector<FixedUnknown> support;
  for (int axis = 0; axis < 3; ++axis) support.push_back({static_cast<int>(3 * node[0]) + axis, 0});
  for (const int c : chosen)
    support.push_back({static_cast<int>(3 * node[c < 3 ? 1 : 2]) + c % 3, 0});
  return support;
}

}  // namespace blocklift::structure
