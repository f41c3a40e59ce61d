#include "structure/system/support.h"

#include <array>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SVD>

#include "structure/error.h"
#include "structure/index.h"

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

/// Unknown that a freedom is; -1 if it is a sum of others.
int own_unknown(const Space& space, int freedom) {
  const Space::Term *begin = space.begin_of(freedom), *end = space.end_of(freedom);
  return end - begin == 1 && begin->weight == 1 ? begin->unknown : -1;
}

/// Nodes whose displacements are unknowns.
std::vector<int> free_nodes(const Space& space) {
  std::vector<int> nodes;
  for (int node = 0; node < space.node_count(); ++node)
    if (own_unknown(space, 6 * node) >= 0 && own_unknown(space, 6 * node + 1) >= 0 &&
        own_unknown(space, 6 * node + 2) >= 0)
      nodes.push_back(node);
  return nodes;
}

}  // namespace

std::vector<FixedUnknown> statically_determinate_support(const Space& space) {
  const std::vector<int> candidates = free_nodes(space);
  if (candidates.size() < 3) throw ModelError("the mesh has too few nodes to be held");
  Eigen::Matrix3Xd nodes(3, static_cast<Eigen::Index>(candidates.size()));
  for (std::size_t i = 0; i < candidates.size(); ++i)
    nodes.col(static_cast<Eigen::Index>(i)) = space.nodes().col(candidates[i]);
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
  const auto hold = [&](Eigen::Index at_node, int axis) {
    support.push_back({own_unknown(space, 6 * candidates[at(at_node)] + axis), 0});
  };
  for (int axis = 0; axis < 3; ++axis) hold(node[0], axis);
  for (const int c : chosen) hold(node[c < 3 ? 1 : 2], c % 3);
  return support;
}

}  // namespace blocklift::structure
