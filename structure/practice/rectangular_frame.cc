#include "structure/practice/rectangular_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace blocklift::structure {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double poisson_ratio = 0.3;

bool is_whole_member(const FrameMember& member) {
  const Column& c = member.column;
  return c.length > 0 && c.area > 0 && c.second_moments[0] > 0 && c.second_moments[1] > 0 &&
         member.torsion_constant > 0 && member.torsion_modulus > 0;
}

/// Places 3 i to 3 i + 2 of an end's six freedoms: displacements, then rotations.
constexpr Eigen::Index freedoms = 6;

/// Of a beam in its own axes; Przemieniecki 1968, equation 5.116, without shear deformation.
Eigen::Matrix<double, 12, 12> beam_stiffness(const FrameMember& member, double l) {
  const Column& c = member.column;
  const double E = c.elastic_modulus, G = E / (2 * (1 + poisson_ratio));
  Eigen::Matrix<double, 12, 12> k = Eigen::Matrix<double, 12, 12>::Zero();
  const auto pair = [&](Eigen::Index at, double value) {
    k(at, at) = k(at + 6, at + 6) = value;
    k(at, at + 6) = k(at + 6, at) = -value;
  };
  pair(0, E * c.area / l);
  pair(3, G * member.torsion_constant / l);
  // Of a displacement w and the rotation t that goes with it, dw/ds = sign t.
  const auto bend = [&](Eigen::Index w, Eigen::Index t, double sign, double EI) {
    pair(w, 12 * EI / (l * l * l));
    for (const Eigen::Index end : {Eigen::Index{0}, freedoms}) {
      k(w, t + end) = k(t + end, w) = sign * 6 * EI / (l * l);
      k(w + 6, t + end) = k(t + end, w + 6) = -sign * 6 * EI / (l * l);
      k(t + end, t + end) = 4 * EI / l;
    }
    k(t, t + 6) = k(t + 6, t) = 2 * EI / l;
  };
  bend(1, 5, 1, E * c.second_moments[1]);
  bend(2, 4, -1, E * c.second_moments[0]);
  return k;
}

/// Forces and moments at the ends that do what a load even + rising s does within the length l.
Eigen::Matrix<double, 12, 1> at_ends(const Vector3d& even, const Vector3d& rising, double l) {
  const Vector3d top = rising * l;  // at the last end, beyond the even part
  Eigen::Matrix<double, 12, 1> f = Eigen::Matrix<double, 12, 1>::Zero();
  f.segment<3>(0) = even * l / 2 + top * (3 * l / 20);
  f.segment<3>(6) = even * l / 2 + top * (7 * l / 20);
  f[0] = even.x() * l / 2 + top.x() * l / 6;
  f[6] = even.x() * l / 2 + top.x() * l / 3;
  const Vector3d first = even * (l * l / 12) + top * (l * l / 30);
  const Vector3d last = even * (l * l / 12) + top * (l * l / 20);
  f[5] = first.y();
  f[11] = -last.y();
  f[4] = -first.z();
  f[10] = last.z();
  return f;
}

}  // namespace

double member_utilisation(const FrameMember& member, const MemberForces& forces, double factor) {
  const double shear =
      factor * forces.torsion / (member.torsion_modulus * member.column.yield_stress);
  return std::hypot(column_utilisation(member.column, forces.column, factor),
                    std::sqrt(3.0) * shear);
}

std::array<Vector3d, 4> RectangularFrame::corners(double length, double width) {
  const double x = length / 2, y = width / 2;
  return {Vector3d(-x, -y, 0), Vector3d(x, -y, 0), Vector3d(x, y, 0), Vector3d(-x, y, 0)};
}

RectangularFrame::RectangularFrame(const FrameMember& along, const FrameMember& across,
                                   const std::vector<Vector3d>& points)
    : along_(along), across_(across) {
  if (!is_whole_member(along) || !is_whole_member(across))
    throw std::invalid_argument("a side of a frame has lengths, areas and moments beyond zero");
  add_nodes(points);
  add_stretches();
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(freedoms * count, freedoms * count);
  for (const Stretch& stretch : stretches_) {
    Matrix12 turn = Matrix12::Zero();
    for (Eigen::Index i = 0; i < 4; ++i) turn.block<3, 3>(3 * i, 3 * i) = stretch.R.transpose();
    const Matrix12 k = turn.transpose() * stretch.stiffness * turn;
    const std::array<Eigen::Index, 2> at{freedoms * static_cast<Eigen::Index>(stretch.first),
                                         freedoms * static_cast<Eigen::Index>(stretch.last)};
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t b = 0; b < 2; ++b)
        all.block<6, 6>(at[a], at[b]) += k.block<6, 6>(freedoms * static_cast<Eigen::Index>(a),
                                                       freedoms * static_cast<Eigen::Index>(b));
  }
  const Eigen::Index rest = freedoms * (count - 1);
  held_ = algebra::SymmetricFactors(all.bottomRightCorner(rest, rest));
}

void RectangularFrame::add_nodes(const std::vector<Vector3d>& points) {
  constexpr double same = 1e-6;  // m
  const std::array<Vector3d, 4> corner = corners(along_.column.length, across_.column.length);
  struct Place {
    std::size_t side;
    double along;  // from the side's corner, m
  };
  std::vector<Place> wanted, places;
  for (const Vector3d& point : points) {
    Place nearest{0, 0};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t side = 0; side < 4; ++side) {
      const double length = member(side).column.length;
      const Vector3d axis = (corner[(side + 1) % 4] - corner[side]) / length;
      const double along = std::clamp(axis.dot(point - corner[side]), 0.0, length);
      const double away = (point - corner[side] - along * axis).norm();
      if (away >= least - same) continue;
      least = away;
      nearest =
          along > length - same ? Place{(side + 1) % 4, 0} : Place{side, along < same ? 0 : along};
    }
    wanted.push_back(nearest);
  }
  places = wanted;
  for (std::size_t side = 0; side < 4; ++side) places.push_back({side, 0});
  const auto comes_before = [](const Place& a, const Place& b) {
    return a.side != b.side ? a.side < b.side : a.along < b.along;
  };
  const auto is_same = [](const Place& a, const Place& b) {
    return a.side == b.side && std::abs(a.along - b.along) < same;
  };
  std::ranges::sort(places, comes_before);
  places.erase(std::unique(places.begin(), places.end(), is_same), places.end());
  for (const Place& place : places) {
    const double length = member(place.side).column.length;
    const Vector3d axis = (corner[(place.side + 1) % 4] - corner[place.side]) / length;
    nodes_.push_back(corner[place.side] + place.along * axis);
    side_of_.push_back(place.side);
  }
  for (const Place& one : wanted)
    node_of_.push_back(static_cast<std::size_t>(
        std::ranges::find_if(places, [&](const Place& place) { return is_same(place, one); }) -
        places.begin()));
}

void RectangularFrame::add_stretches() {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Stretch stretch;
    stretch.side = side_of_[i];
    stretch.first = i;
    stretch.last = (i + 1) % nodes_.size();
    const Vector3d axis = nodes_[stretch.last] - nodes_[i];
    stretch.length = axis.norm();
    stretch.R.col(0) = axis / stretch.length;
    stretch.R.col(2) = Vector3d::UnitZ();
    stretch.R.col(1) = stretch.R.col(2).cross(stretch.R.col(0));
    stretch.stiffness = beam_stiffness(member(stretch.side), stretch.length);
    stretches_.push_back(stretch);
  }
}

RectangularFrame::Balance RectangularFrame::balance(const std::vector<PointForce>& forces) const {
  Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
  for (const PointForce& force : forces) {
    sum += force.f;
    moment += force.p.cross(force.f);
  }
  // "Mass" is the volume of the sides; the middle is its centre.
  const double L = along_.column.length, W = across_.column.length;
  const double a = 2 * along_.column.area * L, b = 2 * across_.column.area * W;
  const double about_x = a * W * W / 4 + b * W * W / 12;
  const double about_y = a * L * L / 12 + b * L * L / 4;
  return {sum / (a + b), moment.cwiseQuotient(Vector3d(about_x, about_y, about_x + about_y))};
}

RectangularFrame::LineLoad RectangularFrame::line_load(const Stretch& stretch,
                                                       const Balance& balance) const {
  const double area = member(stretch.side).column.area;
  const Vector3d start = balance.linear + balance.angular.cross(nodes_[stretch.first]);
  const Vector3d slope = balance.angular.cross(stretch.R.col(0));
  return {-area * (stretch.R.transpose() * start), -area * (stretch.R.transpose() * slope)};
}

RectangularFrame::Vector12 RectangularFrame::displacements(const Stretch& stretch,
                                                           const Eigen::VectorXd& all) const {
  Vector12 u;
  const auto first = freedoms * static_cast<Eigen::Index>(stretch.first);
  const auto last = freedoms * static_cast<Eigen::Index>(stretch.last);
  const Matrix3d R_own = stretch.R.transpose();
  u << R_own * all.segment<3>(first), R_own * all.segment<3>(first + 3),
      R_own * all.segment<3>(last), R_own * all.segment<3>(last + 3);
  return u;
}

/// Forces within, cut after a length s: those at the start and the load up to there.
void RectangularFrame::take_largest(const Stretch& stretch, const LineLoad& load,
                                    const Vector12& ends, MemberForces& largest) const {
  constexpr int pieces = 12;
  const Vector3d force = ends.segment<3>(0), moment = ends.segment<3>(3);
  for (int i = 0; i <= pieces; ++i) {
    const double s = stretch.length * i / pieces;
    const Vector3d sum = force + load.even * s + load.rising * (s * s / 2);
    const Vector3d lever = -force * s - load.even * (s * s / 2) - load.rising * (s * s * s / 6);
    const Vector3d m = moment + Vector3d::UnitX().cross(lever);
    // A side that is pressed anywhere counts as pressed, one that is not by its largest pull.
    const double compression = sum.x();
    double& most = largest.column.compression;
    if (compression > 0 || most > 0)
      most = std::max(most, compression);
    else
      most = std::min(most, compression);
    largest.column.moments[0] = std::max(largest.column.moments[0], std::abs(m.y()));
    largest.column.moments[1] = std::max(largest.column.moments[1], std::abs(m.z()));
    largest.torsion = std::max(largest.torsion, std::abs(m.x()));
  }
}

std::array<MemberForces, 4> RectangularFrame::largest_forces(
    const std::vector<PointForce>& forces) const {
  if (forces.size() != node_of_.size())
    throw std::invalid_argument("a frame takes one force for each of its points");
  const Balance balanced = balance(forces);
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(freedoms * count);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const auto at = freedoms * static_cast<Eigen::Index>(node_of_[i]);
    loads.segment<3>(at) += forces[i].f;
    loads.segment<3>(at + 3) += (forces[i].p - nodes_[node_of_[i]]).cross(forces[i].f);
  }
  std::vector<LineLoad> along;
  for (const Stretch& stretch : stretches_) {
    along.push_back(line_load(stretch, balanced));
    const Vector12 own = at_ends(along.back().even, along.back().rising, stretch.length);
    for (Eigen::Index i = 0; i < 4; ++i) {
      const auto node = static_cast<Eigen::Index>(i < 2 ? stretch.first : stretch.last);
      loads.segment<3>(freedoms * node + 3 * (i % 2)) += stretch.R * own.segment<3>(3 * i);
    }
  }
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(loads.size());
  moved.tail(loads.size() - freedoms) = held_.solve(loads.tail(loads.size() - freedoms));
  std::array<MemberForces, 4> largest;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    const Stretch& stretch = stretches_[i];
    const Vector12 ends = stretch.stiffness * displacements(stretch, moved) -
                          at_ends(along[i].even, along[i].rising, stretch.length);
    take_largest(stretch, along[i], ends, largest[stretch.side]);
  }
  return largest;
}

Eigen::MatrixXd RectangularFrame::flexibility(const std::vector<Vector3d>& points) const {
  if (points.size() != node_of_.size())
    throw std::invalid_argument("a frame's flexibility is that of its points");
  const auto columns = 3 * static_cast<Eigen::Index>(points.size());
  const Eigen::Index size = freedoms * static_cast<Eigen::Index>(nodes_.size());
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(size, columns);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto at = freedoms * static_cast<Eigen::Index>(node_of_[i]);
    const Vector3d arm = points[i] - nodes_[node_of_[i]];
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Eigen::Index column = 3 * static_cast<Eigen::Index>(i) + axis;
      loads(at + axis, column) = 1;
      loads.col(column).segment<3>(at + 3) = arm.cross(Vector3d::Unit(axis));
    }
  }
  loads -= at_corners_alike(loads);
  Eigen::MatrixXd moved(size - freedoms, columns);
  for (Eigen::Index column = 0; column < columns; ++column)
    moved.col(column) = held_.solve(loads.col(column).tail(size - freedoms));
  // What is in balance does no work on the rigid motion by which the first corner stays in place.
  return loads.bottomRows(size - freedoms).transpose() * moved;
}

/// Forces at the corners, as of equal masses that a rigid motion accelerates, with the resultants
/// of loads at the nodes.
Eigen::MatrixXd RectangularFrame::at_corners_alike(const Eigen::MatrixXd& loads) const {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(loads.rows(), 6);
  Eigen::MatrixXd of_masses = rigid;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto at = freedoms * static_cast<Eigen::Index>(i);
    rigid.block<6, 6>(at, 0).setIdentity();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      rigid.col(3 + axis).segment<3>(at) = Vector3d::Unit(axis).cross(nodes_[i]);
    const bool is_corner = i == 0 || side_of_[i] != side_of_[i - 1];
    if (is_corner) of_masses.middleRows<3>(at) = rigid.middleRows<3>(at);
  }
  // By the middle of the frame, its principal axes: the masses' own matrix is diagonal.
  const Eigen::VectorXd mass = (rigid.transpose() * of_masses).diagonal();
  return of_masses * mass.cwiseInverse().asDiagonal() * (rigid.transpose() * loads);
}

}  // namespace blocklift::structure
