// Ropes that may touch edges, see rope.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "dynamics/errors.h"
#include "dynamics/rope/rope.h"

namespace blocklift::dynamics {

namespace {

// Shorter segments than this have no usable direction (m).
constexpr double shortest_straight_part = 1e-9;

using Matrix36 = Eigen::Matrix<double, 3, 6>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

std::size_t index(BodyIndex body) { return static_cast<std::size_t>(body); }

}  // namespace

PlacedEdge RopeEdge::in_body() const {
  const Vector3 along = (end_B - begin_B).normalized();
  const Vector3 outside = outside_B - outside_B.dot(along) * along;
  return {begin_B, along, outside.normalized(), radius};
}

void Rope::check_edges(const Mechanism& mechanism) const {
  const RopeDefinition& d = definition_;
  if (d.edges.empty()) return;
  if (hangs() || !d.left_out.empty())
    throw ModelError("rope \"" + d.name +
                     "\" may touch edges; it must run along its whole path, and without weight");
  if (most_path_points() > most_points_over_edges)
    throw ModelError("rope \"" + d.name +
                     "\" has too many points and edges: each point counts as one, "
                     "each edge as two, and " +
                     std::to_string(most_points_over_edges) + " are allowed");
  std::size_t previous = 0, in_chain = 0;
  for (const RopeEdge& edge : d.edges) {
    const auto refuse = [&](const std::string& what) {
      throw ModelError("rope \"" + d.name + "\": edge \"" + edge.name + "\" " + what);
    };
    if (edge.body < 0 || edge.body >= mechanism.body_count() || !edge.begin_B.allFinite() ||
        !edge.end_B.allFinite() || !edge.outside_B.allFinite())
      refuse("is not one of a body of the mechanism");
    if (edge.after + 1 >= d.points.size() || edge.after < previous)
      refuse("does not stand in the order of the rope's points");
    in_chain = edge.after == previous ? in_chain + 1 : 1;
    previous = edge.after;
    if (in_chain > most_edges_in_chain)
      refuse("is one of more than " + std::to_string(most_edges_in_chain) +
             " between two of its points");
    const Vector3 span = edge.end_B - edge.begin_B;
    if (!(span.norm() > shortest_straight_part)) refuse("has no length");
    if (!(edge.outside_B.cross(span).norm() > 1e-6 * edge.outside_B.norm() * span.norm()))
      refuse("has no side outside: the direction lies along it, or is zero");
    if (!(edge.radius >= 0.0) || !std::isfinite(edge.radius))
      refuse("has the radius " + std::to_string(edge.radius) + "; zero or more is due");
    if (!(edge.friction >= 0.0) || !std::isfinite(edge.friction))
      refuse("has the friction " + std::to_string(edge.friction) + "; zero or more is due");
  }
}

std::size_t Rope::place_chain(const Kinematics& kinematics, std::size_t after, std::size_t begin,
                              std::span<PlacedEdge> placed) const {
  std::size_t count = 0;
  for (; begin + count < edges().size() && edges()[begin + count].after == after; ++count) {
    const RopeEdge& edge = edges()[begin + count];
    const EdgeAxes& axes = edge_axes_[begin + count];
    const Pose& X_WB = kinematics.X_WB[index(edge.body)];
    placed[count] = {X_WB.p + X_WB.R * edge.begin_B, X_WB.R * axes.along_B, X_WB.R * axes.outside_B,
                     edge.radius};
  }
  return count;
}

void Rope::calc_path_over_edges(const Kinematics& kinematics, RopePath& path) const {
  const std::vector<BodyPoint>& points = definition_.points;
  path.count = 0;
  path.length = path.length_rate = 0.0;
  Vector3 p_previous = Vector3::Zero(), v_previous = Vector3::Zero();
  const auto add = [&](BodyIndex body, const Vector3& p_W, int edge, bool round) {
    const Vector3 r = p_W - kinematics.X_WB[index(body)].p;
    const MotionVector& V_WB = kinematics.V_WB[index(body)];
    const Vector3 v = V_WB.linear + V_WB.angular.cross(r);
    const std::size_t i = path.count++;
    path.body[i] = body;
    path.edge[i] = edge;
    path.r_W[i] = r;
    if (i > 0 && round) {
      path.direction_W[i - 1].setZero();
    } else if (i > 0) {
      const Vector3 span = p_W - p_previous;
      const double segment = span.norm();
      if (!(segment > shortest_straight_part))
        throw ModelError("rope \"" + definition_.name +
                         "\": two places of its path lie on one another, so the direction of its "
                         "pull is undefined; is it hoisted into its sheave or onto an edge?");
      path.direction_W[i - 1] = span / segment;
      path.length += segment;
      path.length_rate += path.direction_W[i - 1].dot(v - v_previous);
    }
    p_previous = p_W;
    v_previous = v;
  };
  const auto place = [&](std::size_t i) {
    return point_position(kinematics, points[i].body, points[i].p_BoQ_B);
  };
  std::array<PlacedEdge, most_edges_in_chain> placed;
  std::size_t begin = 0;
  add(points[0].body, place(0), -1, false);
  path.first_height = p_previous.z();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const std::size_t count = place_chain(kinematics, i, begin, placed);
    const Vector3 p_next = place(i + 1);
    if (count > 0) {
      const std::span<const PlacedEdge> chain(placed.data(), count);
      const std::span<EdgeTouch> touches(path.touches.data() + begin, count);
      try {
        find_shortest_line(p_previous, p_next, chain, touches);
      } catch (const ModelError& error) {
        throw ModelError("rope \"" + definition_.name + "\" at edge \"" + edges()[begin].name +
                         (count > 1 ? "\" and those behind it: " : "\": ") + error.what());
      }
      for (std::size_t k = 0; k < count; ++k) {
        if (!touches[k].touches) continue;
        const int edge = static_cast<int>(begin + k);
        add(edges()[begin + k].body, touches[k].first_W(chain[k]), edge, false);
        if (!(chain[k].radius > 0.0)) continue;
        path.length += touches[k].arc(chain[k]);
        add(edges()[begin + k].body, touches[k].last_W(chain[k]), edge, true);
      }
    }
    add(points[i + 1].body, p_next, -1, false);
    begin += count;
  }
}

namespace {

using Row6 = Eigen::RowVector<double, 6>;

// A chain of a path linearised: how its directions and the places where it bends change with the
// motion (turn; displacement) of the body at each of its points.
class ChainChange {
 public:
  // From the point `from` of the path on.
  ChainChange(const Kinematics& kinematics, const RopePath& path, std::size_t from,
              const EdgeConditions& conditions)
      : count_(static_cast<std::size_t>(conditions.node_count())) {
    Vector3 p_previous = Vector3::Zero();
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t k = from + i;
      const MotionVector& V_WB = kinematics.V_WB[index(path.body[k])];
      const Vector3 p = kinematics.X_WB[index(path.body[k])].p + path.r_W[k];
      omega_[i] = V_WB.angular;
      velocity_[i] = V_WB.linear + V_WB.angular.cross(path.r_W[k]);
      if (i > 0) {
        const Vector3& u = u_[i - 1] = path.direction_W[k - 1];
        across_[i - 1].setZero();
        if (!u.isZero(0.0))
          across_[i - 1] = (Matrix3::Identity() - u * u.transpose()) / u.dot(p - p_previous);
      }
      p_previous = p;
    }
    const EdgeConditions::ByMotion by = conditions.calc_change();
    for (std::size_t i = 0; i < count_; ++i) {
      const EdgeConditions::NodeShift shift = conditions.shift_of(static_cast<int>(i));
      for (std::size_t j = 0; j < count_; ++j) slide_[i][j] = shift * by.middleCols<6>(6 * j);
    }
  }

  std::size_t count() const { return count_; }

  // Of the place i over its body, by the motion at j.
  const Matrix36& slide(std::size_t i, std::size_t j) const { return slide_[i][j]; }

  // Of the direction from the place i to the next.
  Matrix36 turn(std::size_t i, std::size_t j) const {
    Matrix36 apart = slide_[i + 1][j] - slide_[i][j];
    if (i + 1 == j) apart.rightCols<3>() += Matrix3::Identity();
    if (i == j) apart.rightCols<3>() -= Matrix3::Identity();
    return across_[i] * apart;
  }

  // Of the chain's dLdot, with the velocities of the bodies' points held. What slides over a body
  // has the velocity of the body's point there.
  Row6 rate(std::size_t j) const {
    Row6 sum = Row6::Zero();
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      sum += (velocity_[i + 1] - velocity_[i]).transpose() * turn(i, j);
      sum += u_[i].cross(omega_[i + 1]).transpose() * slide_[i + 1][j];
      sum -= u_[i].cross(omega_[i]).transpose() * slide_[i][j];
    }
    return sum;
  }

 private:
  static constexpr std::size_t most = EdgeConditions::most_nodes;
  std::size_t count_;
  std::array<Vector3, most> velocity_, omega_, u_;
  std::array<Matrix3, most> across_;
  std::array<std::array<Matrix36, most>, most> slide_;
};

// The pull T_i u_i - T_i-1 u_i-1 of a chain's own segments at its places, as these turn and slide:
// forces on the bodies, and their moments about the bodies' points that were there.
void add_turning(const RopePath& path, std::size_t from, const ChainChange& chain,
                 std::span<const double> tensions, ForceDerivatives& derivatives) {
  for (std::size_t i = 0; i < chain.count(); ++i) {
    const std::size_t k = from + i;
    Vector3 pull = Vector3::Zero();
    if (i > 0) pull -= tensions[k - 1] * path.direction_W[k - 1];
    if (i + 1 < chain.count()) pull += tensions[k] * path.direction_W[k];
    derivatives.add_held_force(k, pull);
    for (std::size_t j = 0; j < chain.count(); ++j) {
      Matrix6 by_motion = Matrix6::Zero();
      by_motion.topRows<3>() = -skew(pull) * chain.slide(i, j);
      if (i > 0) by_motion.bottomRows<3>() -= tensions[k - 1] * chain.turn(i - 1, j);
      if (i + 1 < chain.count()) by_motion.bottomRows<3>() += tensions[k] * chain.turn(i, j);
      derivatives.add_wrench_block(k, from + j, by_motion, Matrix6::Zero());
    }
  }
}

}  // namespace

template <class Function>
void Rope::for_each_chain(const Kinematics& kinematics, const RopePath& path,
                          const Function& function) const {
  std::array<PlacedEdge, most_edges_in_chain> placed;
  const auto position = [&](std::size_t k) -> Vector3 {
    return kinematics.X_WB[index(path.body[k])].p + path.r_W[k];
  };
  std::size_t begin = 0, from = 0;
  for (std::size_t i = 0; i + 1 < points().size(); ++i) {
    const std::size_t count = place_chain(kinematics, i, begin, placed);
    std::size_t to = from + 1;
    while (path.edge[to] >= 0) ++to;
    function(from, EdgeConditions(position(from), position(to), {placed.data(), count},
                                  {path.touches.data() + begin, count}));
    begin += count;
    from = to;
  }
}

void Rope::add_sliding(const Kinematics& kinematics, const RopePath& path,
                       std::span<Vector3> turning) const {
  for_each_chain(kinematics, path, [&](std::size_t from, const EdgeConditions& conditions) {
    if (conditions.unknown_count() == 0) return;
    const auto count = static_cast<std::size_t>(conditions.node_count());
    std::array<MotionVector, EdgeConditions::most_nodes> velocities;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = from + i;
      velocities[i] = shift(kinematics.V_WB[index(path.body[k])], path.r_W[k]);
    }
    const EdgeConditions::Vector rate = conditions.calc_rate({velocities.data(), count});
    const auto position = [&](std::size_t k) -> Vector3 {
      return kinematics.X_WB[index(path.body[k])].p + path.r_W[k];
    };
    Vector3 previous = conditions.shift_of(0) * rate;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const std::size_t k = from + i;
      const Vector3 next = conditions.shift_of(static_cast<int>(i + 1)) * rate;
      const Vector3& u = path.direction_W[k];
      const Vector3 apart = next - previous;
      if (!u.isZero(0.0))
        turning[k] += (apart - u.dot(apart) * u) / u.dot(position(k + 1) - position(k));
      previous = next;
    }
  });
}

void Rope::add_turning_over_edges(const Kinematics& kinematics, const RopePath& path,
                                  std::span<const double> tensions,
                                  ForceDerivatives& derivatives) const {
  for_each_chain(kinematics, path, [&](std::size_t from, const EdgeConditions& conditions) {
    add_turning(path, from, ChainChange(kinematics, path, from, conditions), tensions, derivatives);
  });
}

void Rope::add_derivatives_over_edges(const Kinematics& kinematics, const RopePath& path,
                                      const RopeLoad& load, ForceDerivatives& derivatives) const {
  for (std::size_t i = 0; i < path.count; ++i) derivatives.locate(i, path.body[i], path.r_W[i]);
  std::array<Row6, most_points_over_edges> rate;
  for (std::size_t i = 0; i < path.count; ++i) rate[i].setZero();
  std::array<double, most_points_over_edges> tensions;
  tensions.fill(load.tension);
  for_each_chain(kinematics, path, [&](std::size_t from, const EdgeConditions& conditions) {
    const ChainChange chain(kinematics, path, from, conditions);
    add_turning(path, from, chain, tensions, derivatives);
    for (std::size_t j = 0; j < chain.count(); ++j) rate[from + j] += chain.rate(j);
  });
  const double k = calc_tension_slope(load), c = damping(load.stiffness);
  const auto gradient = [&](std::size_t i) {
    Vector3 g = Vector3::Zero();
    if (i > 0) g += path.direction_W[i - 1];
    if (i + 1 < path.count) g -= path.direction_W[i];
    return g;
  };
  for (std::size_t i = 0; i < path.count; ++i) {
    const Vector3 pull = -gradient(i);
    for (std::size_t j = 0; j < path.count; ++j) {
      const Vector3 g = gradient(j);
      derivatives.add_block(i, j, k * pull * g.transpose(), c * pull * g.transpose());
      Matrix6 damped = Matrix6::Zero();
      damped.bottomRows<3>() = c * pull * rate[j];
      derivatives.add_wrench_block(i, j, damped, Matrix6::Zero());
    }
  }
}

}  // namespace blocklift::dynamics
