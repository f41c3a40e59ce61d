#include "structure/mesh/thin_walls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "structure/error.h"

namespace blocklift::structure {

using Vector2 = Eigen::Vector2d;

ThinWalls::ThinWalls(std::vector<Vector2> nodes, const std::vector<Wall>& walls)
    : nodes_(std::move(nodes)), walls_(walls) {
  require_one_piece();
  double area = 0;
  Eigen::Matrix2d about_origin = Eigen::Matrix2d::Zero();
  for (const Wall& wall : walls_) {
    const Vector2 along = end(wall) - start(wall), middle = (start(wall) + end(wall)) / 2;
    // Walls as lines: their own second moment across is left out.
    const double part = along.norm() * wall.thickness;
    area += part;
    centroid_ += part * middle;
    about_origin += part * (middle * middle.transpose() + along * along.transpose() / 12);
  }
  centroid_ /= area;
  tensor_ = about_origin - area * centroid_ * centroid_.transpose();
  for (Vector2& node : nodes_) node -= centroid_;
}

double ThinWalls::torsion() const {
  double open = 0, closed = 0, largest = 0;
  const auto count = static_cast<Eigen::Index>(walls_.size());
  Eigen::VectorXd flow = Eigen::VectorXd::Zero(count);
  if (walls_.size() >= nodes_.size()) {
    Eigen::VectorXd sweeps(count);
    for (Eigen::Index i = 0; i < count; ++i) sweeps[i] = sweep(walls_[i]);
    // The flow whose moment is its own energy: J is both.
    flow = find_flows(-sweeps, Eigen::VectorXd::Zero(nodes_.size()));
    closed = flow.dot(sweeps);
    largest = flow.cwiseAbs().maxCoeff();
  }
  for (Eigen::Index i = 0; i < count; ++i)
    if (std::abs(flow[i]) <= 1e-9 * largest)
      open += length(walls_[i]) * std::pow(walls_[i].thickness, 3) / 3;
  return open + closed;
}

double ThinWalls::shear_area(int axis) const {
  if (!carries(axis)) return 0;
  double sum = 0;
  const std::vector<Flow> flows = calc_flows(axis);
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const auto& [a, m, b] = flows[i];
    // The square of a quadratic by its three values.
    const double mean = (2 * a * a + 8 * m * m + 2 * b * b + 2 * a * m + 2 * m * b - a * b) / 15;
    sum += mean * length(walls_[i]) / walls_[i].thickness;
  }
  return 1 / sum;
}

Vector2 ThinWalls::shear_centre() const {
  Vector2 centre = Vector2::Zero();
  if (carries(0)) centre[1] = -moment(0);
  if (carries(1)) centre[0] = moment(1);
  return centre + centroid_;
}

Vector2 ThinWalls::start(const Wall& wall) const { return nodes_[wall.from]; }
Vector2 ThinWalls::end(const Wall& wall) const { return nodes_[wall.to]; }
double ThinWalls::length(const Wall& wall) const { return (end(wall) - start(wall)).norm(); }
double ThinWalls::sweep(const Wall& wall) const {
  const Vector2 from = start(wall), to = end(wall);
  return from[0] * to[1] - from[1] * to[0];
}

bool ThinWalls::carries(int axis) const {
  return tensor_.determinant() > 1e-12 * tensor_.trace() * tensor_.trace() ||
         tensor_(axis, axis) > 1e-6 * tensor_.trace();
}

/// First moment that the force of one needs to grow by along the beam, at a point.
double ThinWalls::growth(int axis, const Vector2& point) const {
  const double determinant = tensor_.determinant();
  if (!(determinant > 1e-12 * tensor_.trace() * tensor_.trace()))
    return point[axis] / tensor_(axis, axis);
  const int other = 1 - axis;
  return (tensor_(other, other) * point[axis] - tensor_(0, 1) * point[other]) / determinant;
}

Eigen::VectorXd ThinWalls::find_flows(const Eigen::VectorXd& work,
                                      const Eigen::VectorXd& given) const {
  // Minimum of sum of l / t q^2 / 2 + work q, the sum into each node being none (Lagrange).
  const auto walls = static_cast<Eigen::Index>(walls_.size()),
             nodes = static_cast<Eigen::Index>(nodes_.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(walls + nodes, walls + nodes);
  for (Eigen::Index i = 0; i < walls; ++i) {
    const Wall& wall = walls_[i];
    matrix(i, i) = length(wall) / wall.thickness;
    matrix(walls + wall.to, i) += 1;
    matrix(walls + wall.from, i) -= 1;
  }
  matrix.topRightCorner(walls, nodes) = matrix.bottomLeftCorner(nodes, walls).transpose();
  Eigen::VectorXd right(walls + nodes);
  right << -work, -given;
  // One node's equation follows from the others'.
  return algebra::least_squares(matrix, right).col(0).head(walls);
}

std::vector<ThinWalls::Flow> ThinWalls::calc_flows(int axis) const {
  const auto walls = static_cast<Eigen::Index>(walls_.size());
  std::vector<Flow> flows(walls_.size());
  Eigen::VectorXd work(walls), given = Eigen::VectorXd::Zero(nodes_.size());
  for (Eigen::Index i = 0; i < walls; ++i) {
    const Wall& wall = walls_[i];
    const double grows = length(wall) * wall.thickness;
    const double at_start = growth(axis, start(wall)), at_end = growth(axis, end(wall));
    auto& [first, middle, last] = flows[i];
    first = 0;
    middle = -grows * (3 * at_start + at_end) / 8;
    last = -grows * (at_start + at_end) / 2;
    work[i] = (4 * middle + last) / 6 * length(wall) / wall.thickness;
    given[wall.to] += last;
  }
  const Eigen::VectorXd at_starts = find_flows(work, given);
  for (Eigen::Index i = 0; i < walls; ++i)
    for (double& value : flows[i]) value += at_starts[i];
  return flows;
}

/// Moment of the flow about the centroid, about axis 1.
double ThinWalls::moment(int axis) const {
  const std::vector<Flow> flows = calc_flows(axis);
  double sum = 0;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const auto& [a, m, b] = flows[i];
    sum += (a + 4 * m + b) / 6 * sweep(walls_[i]);
  }
  return sum;
}

void ThinWalls::require_one_piece() const {
  std::vector<char> is_reached(nodes_.size(), 0);
  is_reached.front() = 1;
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const Wall& wall : walls_)
      if (is_reached[wall.from] != is_reached[wall.to]) {
        is_reached[wall.from] = is_reached[wall.to] = 1;
        goes_on = true;
      }
  }
  if (std::find(is_reached.begin(), is_reached.end(), 0) != is_reached.end())
    throw ModelError("the walls of a profile hang together by no node");
}

}  // namespace blocklift::structure
