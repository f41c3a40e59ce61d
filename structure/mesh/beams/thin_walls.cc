#include "structure/mesh/beams/thin_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

double ThinWalls::torsion() const { return torsion_of(calc_torsion_flows()); }

/// The flow whose moment is its own energy: J is both.
Eigen::VectorXd ThinWalls::calc_torsion_flows() const {
  const auto count = static_cast<Eigen::Index>(walls_.size());
  if (walls_.size() < nodes_.size()) return Eigen::VectorXd::Zero(count);
  Eigen::VectorXd sweeps(count);
  for (Eigen::Index i = 0; i < count; ++i) sweeps[i] = sweep(walls_[i]);
  return find_flows(-sweeps, Eigen::VectorXd::Zero(nodes_.size()));
}

bool ThinWalls::is_open(const Eigen::VectorXd& torsion_flows, std::size_t wall) const {
  return std::abs(torsion_flows[wall]) <= 1e-9 * torsion_flows.cwiseAbs().maxCoeff();
}

double ThinWalls::torsion_of(const Eigen::VectorXd& torsion_flows) const {
  double sum = 0;
  for (std::size_t i = 0; i < walls_.size(); ++i)
    sum += is_open(torsion_flows, i) ? length(walls_[i]) * std::pow(walls_[i].thickness, 3) / 3
                                     : torsion_flows[i] * sweep(walls_[i]);
  return sum;
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

ThinWalls::Flows ThinWalls::calc_all_flows() const {
  Flows flows;
  flows.torsion = calc_torsion_flows();
  flows.torsion_constant = torsion_of(flows.torsion);
  for (const int axis : {0, 1})
    flows.force[axis] = carries(axis) ? calc_flows(axis) : std::vector<Flow>(walls_.size(), Flow{});
  return flows;
}

/// Shares of a wall's length: its ends, and between them where the flow of a force turns.
std::vector<double> ThinWalls::places_on(const Wall& wall) const {
  constexpr double apart = 0.02;
  std::vector<double> places{0, 1};
  for (const int axis : {0, 1}) {
    if (!carries(axis)) continue;
    const double at_start = growth(axis, start(wall)), at_end = growth(axis, end(wall));
    if (!(at_start * at_end < 0)) continue;
    const double share = at_start / (at_start - at_end);
    if (std::all_of(places.begin(), places.end(),
                    [&](double known) { return std::abs(share - known) > apart; }))
      places.push_back(share);
  }
  return places;
}

SectionPoint ThinWalls::point_on(const Flows& flows, std::size_t wall, double share,
                                 int side) const {
  const Wall& of = walls_[wall];
  const Vector2 along = (end(of) - start(of)).normalized(), left(-along[1], along[0]);
  const double longer = share == 0 ? -of.longer_at_from : share == 1 ? of.longer_at_to : 0;
  SectionPoint point;
  point.place = start(of) + (share * length(of) + longer) * along + side * of.thickness / 2 * left +
                centroid_;
  const double twist =
      is_open(flows.torsion, wall) ? -side * of.thickness : flows.torsion[wall] / of.thickness;
  point.of_torsion = twist / flows.torsion_constant;
  for (const int axis : {0, 1}) {
    const auto& [first, middle, last] = flows.force[axis][wall];
    const double x = 2 * share - 1;  // the quadratic through its three values
    const double flow = middle + x * (last - first) / 2 + x * x * ((first + last) / 2 - middle);
    point.of_force[axis] = flow / of.thickness;
  }
  return point;
}

std::vector<SectionPoint> ThinWalls::points() const {
  const Flows flows = calc_all_flows();
  std::vector<SectionPoint> points;
  for (std::size_t i = 0; i < walls_.size(); ++i)
    for (const double share : places_on(walls_[i]))
      for (const int side : {1, -1}) {
        // A flow that turns from axis 2 towards 3 has its cell on the left.
        const bool is_inside = !is_open(flows.torsion, i) && side * flows.torsion[i] > 0;
        if (!is_inside) points.push_back(point_on(flows, i, share, side));
      }
  return points;
}

SectionPoint ThinWalls::point_at(const Vector2& place) const {
  const Vector2 own = place - centroid_;
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity(), share = 0;
  int side = 1;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Vector2 along = end(walls_[i]) - start(walls_[i]), from = own - start(walls_[i]);
    const double here = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
    // Beyond a face, so that of two walls the one counts in which the place lies.
    const double distance = (from - here * along).norm() - walls_[i].thickness / 2;
    if (!(distance < least - 1e-12)) continue;
    least = distance;
    nearest = i;
    share = here;
    side = along[0] * from[1] - along[1] * from[0] >= 0 ? 1 : -1;
  }
  SectionPoint point = point_on(calc_all_flows(), nearest, share, side);
  point.place = place;
  return point;
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
