#include "dynamics/rope/edge_wrap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/LU>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

// Nearer than this to an edge without radius a point lies on it (m).
constexpr double on_the_edge = 1e-9;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// A point as it is seen along the axis of an edge.
struct Polar {
  double distance, angle, place;

  Polar(const PlacedEdge& edge, const Vector3& p_W) {
    const Vector3 r = p_W - edge.begin_W;
    const double x = edge.outside_W.dot(r);
    const double y = edge.across_W().dot(r);
    distance = std::hypot(x, y);
    angle = std::atan2(y, x);
    place = edge.along_W.dot(r);
  }
};

double tangent_length(const PlacedEdge& edge, const Polar& p) {
  return std::sqrt(std::max(0.0, p.distance * p.distance - edge.radius * edge.radius));
}

// The closed form of one edge between two points.
void lay(const PlacedEdge& edge, const Vector3& from_W, const Vector3& to_W, EdgeTouch& touch) {
  const Polar a(edge, from_W), b(edge, to_W);
  if (std::min(a.distance, b.distance) < edge.radius * (1.0 - 1e-9))
    throw ModelError("it begins, ends or comes from another edge within the round of this edge");
  touch.winding = b.angle >= a.angle ? 1.0 : -1.0;
  if (std::min(a.distance, b.distance) < std::max(on_the_edge, edge.radius * 1e-9)) {
    touch.touches = false;
    touch.wrap = -std::numbers::pi;
    return;
  }
  const double before = std::acos(std::min(1.0, edge.radius / a.distance));
  const double behind = std::acos(std::min(1.0, edge.radius / b.distance));
  touch.wrap = std::abs(b.angle - a.angle) - before - behind;
  touch.touches = touch.wrap > 0.0;
  touch.first_angle = a.angle + touch.winding * before;
  touch.last_angle = b.angle - touch.winding * behind;
  const double come = tangent_length(edge, a), leave = tangent_length(edge, b);
  const double arc = edge.radius * std::max(0.0, touch.wrap);
  const double pitch = (b.place - a.place) / std::max(come + arc + leave, on_the_edge);
  touch.first_place = a.place + pitch * come;
  touch.last_place = a.place + pitch * (come + arc);
}

// Where the line comes from and goes to, seen from one edge of a chain.
struct Neighbours {
  Vector3 before_W, behind_W;

  Neighbours(const Vector3& first_W, const Vector3& last_W, std::span<const PlacedEdge> edges,
             std::span<const EdgeTouch> touches, std::size_t i)
      : before_W(first_W), behind_W(last_W) {
    for (std::size_t k = i; k-- > 0;) {
      if (!touches[k].touches) continue;
      before_W = touches[k].last_W(edges[k]);
      break;
    }
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      if (!touches[k].touches) continue;
      behind_W = touches[k].first_W(edges[k]);
      break;
    }
  }
};

// Lays each edge between its neighbours in turn, until little moves; does the set of those that
// touch stay as it was found?
void lay_in_turn(const Vector3& first_W, const Vector3& last_W, std::span<const PlacedEdge> edges,
                 std::span<EdgeTouch> touches, double scale) {
  constexpr int most_sweeps = 60;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double moved = 0.0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const EdgeTouch old = touches[i];
      const Neighbours beside(first_W, last_W, edges, touches, i);
      lay(edges[i], beside.before_W, beside.behind_W, touches[i]);
      if (old.touches != touches[i].touches) {
        moved = scale;
      } else if (old.touches) {
        moved = std::max({moved, (old.first_W(edges[i]) - touches[i].first_W(edges[i])).norm(),
                          (old.last_W(edges[i]) - touches[i].last_W(edges[i])).norm()});
      }
    }
    if (moved < 1e-6 * scale) return;
  }
}

// Newton's method on the conditions of those that touch.
bool polish(const Vector3& first_W, const Vector3& last_W, std::span<const PlacedEdge> edges,
            std::span<EdgeTouch> touches, double scale) {
  constexpr int most_iterations = 20;
  for (int k = 0; k < most_iterations; ++k) {
    const EdgeConditions conditions(first_W, last_W, edges, touches);
    if (conditions.unknown_count() == 0) return true;
    const EdgeConditions::Vector step =
        -conditions.jacobian().partialPivLu().solve(conditions.residual());
    if (!step.allFinite()) return false;
    EdgeConditions::add_step(step, edges, touches);
    if (step.cwiseAbs().maxCoeff() < 1e-12 * scale) return true;
  }
  return false;
}

}  // namespace

Vector3 PlacedEdge::normal_W(double angle) const {
  return std::cos(angle) * outside_W + std::sin(angle) * across_W();
}

Vector3 PlacedEdge::tangent_W(double angle) const {
  return std::cos(angle) * across_W() - std::sin(angle) * outside_W;
}

Vector3 PlacedEdge::point_W(double angle, double place) const {
  const Vector3 on_axis = begin_W + place * along_W;
  return radius > 0.0 ? Vector3(on_axis + radius * normal_W(angle)) : on_axis;
}

double EdgeTouch::arc(const PlacedEdge& edge) const {
  return std::hypot(edge.radius * std::max(0.0, wrap), last_place - first_place);
}

void find_shortest_line(const Vector3& first_W, const Vector3& last_W,
                        std::span<const PlacedEdge> edges, std::span<EdgeTouch> touches) {
  if (edges.size() == 1) {
    lay(edges[0], first_W, last_W, touches[0]);
    return;
  }
  const auto share = [&](std::size_t i) {
    return static_cast<double>(i + 1) / static_cast<double>(edges.size() + 1);
  };
  double scale = (last_W - first_W).norm();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const PlacedEdge& edge = edges[i];
    const Vector3 chord = first_W + share(i) * (last_W - first_W);
    EdgeTouch& touch = touches[i] = {};
    touch.touches = true;
    touch.first_place = touch.last_place = edge.along_W.dot(chord - edge.begin_W);
    scale = std::max(scale, (touch.first_W(edge) - first_W).norm());
  }
  constexpr int most_attempts = 4;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    lay_in_turn(first_W, last_W, edges, touches, scale);
    if (!polish(first_W, last_W, edges, touches, scale)) break;
    bool stays = true;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      // What touches by less than this does not bend: either way the line is the same.
      constexpr double least_wrap = 1e-9;
      if (touches[i].touches) {
        touches[i].wrap = touches[i].winding * (touches[i].last_angle - touches[i].first_angle);
        if (edges[i].radius == 0.0) {
          const Neighbours beside(first_W, last_W, edges, touches, i);
          EdgeTouch laid;
          lay(edges[i], beside.before_W, beside.behind_W, laid);
          touches[i].wrap = laid.wrap;
        }
        stays = stays && touches[i].wrap > -least_wrap;
        continue;
      }
      const Neighbours beside(first_W, last_W, edges, touches, i);
      lay(edges[i], beside.before_W, beside.behind_W, touches[i]);
      stays = stays && touches[i].wrap < least_wrap;
      touches[i].touches = false;
    }
    if (stays) return;
  }
  throw ModelError("no shortest line round its edges is found; do they stand in its order?");
}

EdgeConditions::EdgeConditions(const Vector3& first_W, const Vector3& last_W,
                               std::span<const PlacedEdge> edges,
                               std::span<const EdgeTouch> touches) {
  place_nodes(first_W, last_W, edges, touches);
  residual_.setZero(unknowns_);
  jacobian_.setZero(unknowns_, unknowns_);
  for (int i = 0; i < edges_; ++i) add_edge(edge_[at(i)]);
}

void EdgeConditions::place_nodes(const Vector3& first_W, const Vector3& last_W,
                                 std::span<const PlacedEdge> edges,
                                 std::span<const EdgeTouch> touches) {
  node_[at(nodes_++)].p_W = first_W;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const EdgeTouch& touch = touches[i];
    if (!touch.touches) continue;
    const bool round = edges[i].radius > 0.0;
    edge_[at(edges_++)] = {&edges[i], &touch, nodes_, round ? nodes_ + 1 : nodes_, unknowns_};
    const auto add = [&](double angle, double place) {
      Node& node = node_[at(nodes_++)];
      node = {};
      node.p_W = edges[i].point_W(angle, place);
      if (round) {
        node.angle = unknowns_++;
        node.by_angle = edges[i].radius * edges[i].tangent_W(angle);
      }
      node.place = unknowns_++;
      node.by_place = edges[i].along_W;
    };
    add(touch.first_angle, touch.first_place);
    if (round) add(touch.last_angle, touch.last_place);
  }
  node_[at(nodes_)] = {};
  node_[at(nodes_++)].p_W = last_W;
  for (int i = 0; i + 1 < nodes_; ++i) {
    const Vector3 span = node_[at(i + 1)].p_W - node_[at(i)].p_W;
    const double length = span.norm();
    if (!(length > 0.0)) continue;
    Part& part = part_[at(i)];
    part.u = span / length;
    part.turn = (Matrix3::Identity() - part.u * part.u.transpose()) / length;
  }
}

void EdgeConditions::add_direction(int row, const Vector3& w, int part, double sign) {
  const Vector3 by_end = sign * (part_[at(part)].turn * w);
  for (const int end : {0, 1}) {
    const Node& node = node_[at(part + end)];
    const double way = end == 1 ? 1.0 : -1.0;
    if (node.angle >= 0) jacobian_(row, node.angle) += way * by_end.dot(node.by_angle);
    if (node.place >= 0) jacobian_(row, node.place) += way * by_end.dot(node.by_place);
  }
}

void EdgeConditions::add_direction(int row, const Vector3& w, int part, double sign,
                                   ByMotion& by) const {
  const Vector3 by_end = sign * (part_[at(part)].turn * w);
  by.block<1, 3>(row, 6 * part + 3) -= by_end.transpose();
  by.block<1, 3>(row, 6 * (part + 1) + 3) += by_end.transpose();
}

void EdgeConditions::add_edge(const Edge& edge) {
  const PlacedEdge& placed = *edge.placed;
  const EdgeTouch& touch = *edge.touch;
  const Vector3& along = placed.along_W;
  const int come = edge.first_node - 1, leave = edge.last_node;
  const Vector3& u_in = part_[at(come)].u;
  const Vector3& u_out = part_[at(leave)].u;
  const bool round = edge.first_node != edge.last_node;
  int row = edge.row;
  residual_[row] = (u_in - u_out).dot(along);
  add_direction(row, along, come);
  add_direction(row, along, leave, -1.0);
  if (!round) return;
  for (const bool first : {true, false}) {
    ++row;
    const double angle = first ? touch.first_angle : touch.last_angle;
    const int part = first ? come : leave;
    const Vector3 normal = placed.normal_W(angle);
    const Vector3& u = part_[at(part)].u;
    residual_[row] = u.dot(normal);
    add_direction(row, normal, part);
    jacobian_(row, node_[at(first ? edge.first_node : edge.last_node)].angle) +=
        u.dot(placed.tangent_W(angle));
  }
  ++row;
  const double a = u_in.dot(along);
  const double c = std::sqrt(std::max(1e-12, 1.0 - a * a));
  const double advance = touch.last_place - touch.first_place;
  const double turned = touch.winding * (touch.last_angle - touch.first_angle);
  residual_[row] = advance * c - placed.radius * turned * a;
  add_direction(row, along, come, -(advance * a / c + placed.radius * turned));
  jacobian_(row, node_[at(edge.last_node)].place) += c;
  jacobian_(row, node_[at(edge.first_node)].place) -= c;
  const double by_turn = placed.radius * touch.winding * a;
  jacobian_(row, node_[at(edge.last_node)].angle) -= by_turn;
  jacobian_(row, node_[at(edge.first_node)].angle) += by_turn;
}

EdgeConditions::ByMotion EdgeConditions::calc_by_motion() const {
  ByMotion by = ByMotion::Zero(unknowns_, 6 * nodes_);
  for (int i = 0; i < edges_; ++i) {
    const Edge& edge = edge_[at(i)];
    const PlacedEdge& placed = *edge.placed;
    const EdgeTouch& touch = *edge.touch;
    const Vector3& along = placed.along_W;
    const int come = edge.first_node - 1, leave = edge.last_node;
    const Vector3& u_in = part_[at(come)].u;
    const Vector3& u_out = part_[at(leave)].u;
    // A direction w of the edge's body turns with it: u . (theta x w) = theta . (w x u).
    const auto turn = [&](int row, const Vector3& w, const Vector3& u, double sign) {
      by.block<1, 3>(row, 6 * edge.first_node) += sign * w.cross(u).transpose();
    };
    int row = edge.row;
    add_direction(row, along, come, 1.0, by);
    add_direction(row, along, leave, -1.0, by);
    turn(row, along, u_in - u_out, 1.0);
    if (edge.first_node == edge.last_node) continue;
    for (const bool first : {true, false}) {
      ++row;
      const Vector3 normal = placed.normal_W(first ? touch.first_angle : touch.last_angle);
      add_direction(row, normal, first ? come : leave, 1.0, by);
      turn(row, normal, first ? u_in : u_out, 1.0);
    }
    ++row;
    const double a = u_in.dot(along);
    const double c = std::sqrt(std::max(1e-12, 1.0 - a * a));
    const double turned = touch.winding * (touch.last_angle - touch.first_angle);
    const double weight =
        -((touch.last_place - touch.first_place) * a / c + placed.radius * turned);
    add_direction(row, along, come, weight, by);
    turn(row, along, u_in, weight);
  }
  return by;
}

EdgeConditions::ByMotion EdgeConditions::calc_change() const {
  return -jacobian_.partialPivLu().solve(calc_by_motion());
}

EdgeConditions::Vector EdgeConditions::calc_rate(std::span<const MotionVector> velocities) const {
  const ByMotion by = calc_by_motion();
  Vector rate = Vector::Zero(unknowns_);
  for (int i = 0; i < nodes_; ++i) {
    const MotionVector& V = velocities[at(i)];
    rate += by.middleCols<3>(Eigen::Index{6} * i) * V.angular;
    rate += by.middleCols<3>(Eigen::Index{6} * i + 3) * V.linear;
  }
  return -jacobian_.partialPivLu().solve(rate);
}

EdgeConditions::NodeShift EdgeConditions::shift_of(int node) const {
  NodeShift shift = NodeShift::Zero(3, unknowns_);
  const Node& one = node_[at(node)];
  if (one.angle >= 0) shift.col(one.angle) = one.by_angle;
  if (one.place >= 0) shift.col(one.place) = one.by_place;
  return shift;
}

void EdgeConditions::add_step(const Vector& step, std::span<const PlacedEdge> edges,
                              std::span<EdgeTouch> touches) {
  Eigen::Index k = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EdgeTouch& touch = touches[i];
    if (!touch.touches) continue;
    if (edges[i].radius > 0.0) touch.first_angle += step[k++];
    touch.first_place += step[k++];
    if (edges[i].radius > 0.0) {
      touch.last_angle += step[k++];
      touch.last_place += step[k++];
    } else {
      touch.last_place = touch.first_place;
    }
  }
}

}  // namespace blocklift::dynamics
