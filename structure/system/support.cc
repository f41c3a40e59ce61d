#include "structure/system/support.h"

#include <array>
#include <vector>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "structure/error.h"
#include "structure/system/held_points.h"

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

/// Points on one line: what lies across it is held at the other end, and the turn about it here.
std::vector<HeldComponent> hold_line(int here, int there, const Vector3& along) {
  int axis = 0;  // that lies most nearly along the line
  along.cwiseAbs().maxCoeff(&axis);
  return {{here, 0},       {here, 1}, {here, 2}, {there, (axis + 1) % 3}, {there, (axis + 2) % 3},
          {here, 3 + axis}};
}

}  // namespace

std::vector<int> free_nodes(const Space& space) {
  std::vector<int> nodes;
  for (int node = 0; node < space.node_count(); ++node)
    if (own_unknown(space, 6 * node) >= 0 && own_unknown(space, 6 * node + 1) >= 0 &&
        own_unknown(space, 6 * node + 2) >= 0)
      nodes.push_back(node);
  return nodes;
}

std::vector<HeldComponent> hold_points(const Eigen::Matrix3Xd& points) {
  if (points.cols() < 3) throw ModelError("the mesh has too few nodes to be held");
  constexpr double on_line = 1e-6;  // of the length: nine digits of a deck leave 1e-8
  const Vector3 middle = points.rowwise().mean();
  std::array<Eigen::Index, 3> point{};
  (points.colwise() - middle).colwise().squaredNorm().maxCoeff(&point[0]);
  const Vector3 a = points.col(point[0]);
  const double length =
      std::sqrt((points.colwise() - a).colwise().squaredNorm().maxCoeff(&point[1]));
  const Vector3 along = (points.col(point[1]) - a).normalized();
  const double distance =
      ((points.colwise() - a) - along * (along.transpose() * (points.colwise() - a)))
          .colwise()
          .norm()
          .maxCoeff(&point[2]);
  if (!(distance > on_line * length))
    return hold_line(static_cast<int>(point[0]), static_cast<int>(point[1]), along);

  Eigen::Matrix<double, 6, 6> rows;
  for (int axis = 0; axis < 3; ++axis) rows.row(axis) = rigid_row(Vector3::Zero(), axis, length);
  const auto candidate = [&](int c) {
    return rigid_row(points.col(point[c < 3 ? 1 : 2]) - a, c % 3, length);
  };
  double best = -1;
  std::array<int, 3> chosen{};
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j)
      for (int k = j + 1; k < 6; ++k) {
        rows.row(3) = candidate(i);
        rows.row(4) = candidate(j);
        rows.row(5) = candidate(k);
        const double smallest = algebra::smallest_singular_value(rows);
        if (smallest <= best) continue;
        best = smallest;
        chosen = {i, j, k};
      }
  std::vector<HeldComponent> support;
  for (int axis = 0; axis < 3; ++axis) support.push_back({static_cast<int>(point[0]), axis});
  for (const int c : chosen) support.push_back({static_cast<int>(point[c < 3 ? 1 : 2]), c % 3});
  return support;
}

std::vector<FixedUnknown> statically_determinate_support(const Space& space) {
  const std::vector<int> candidates = free_nodes(space);
  Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(candidates.size()));
  for (std::size_t i = 0; i < candidates.size(); ++i)
    places.col(i) = space.nodes().col(candidates[i]);
  std::vector<FixedUnknown> support;
  for (const HeldComponent& held : hold_points(places)) {
    const int unknown = own_unknown(space, 6 * candidates[held.point] + held.axis);
    if (unknown < 0)
      throw ModelError(
          "all nodes of the mesh lie on one line, and nothing resists a turn about it");
    support.push_back({unknown, 0});
  }
  return support;
}

}  // namespace blocklift::structure
