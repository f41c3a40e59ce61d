#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

#include "dynamics/spatial/pose.h"
#include "dynamics/spatial/spatial_vector.h"

namespace blocklift::dynamics {

/// An edge as it lies in the world at one instant: a straight line, or a cylinder about it.
struct PlacedEdge {
  Vector3 begin_W = Vector3::Zero();     ///< on its axis, m
  Vector3 along_W = Vector3::UnitX();    ///< of the axis, unit
  Vector3 outside_W = Vector3::UnitZ();  ///< unit, across the axis, away from what it is an edge of
  double radius = 0.0;                   ///< m; zero: a line

  Vector3 across_W() const { return along_W.cross(outside_W); }
  /// Unit, from the axis, at an angle (rad) that is counted from `outside_W` about `along_W`.
  Vector3 normal_W(double angle) const;
  /// Change of that normal with the angle.
  Vector3 tangent_W(double angle) const;
  /// On the surface, at an angle and a place along the axis (m).
  Vector3 point_W(double angle, double place) const;
};

/// How a line runs round one edge: it comes straight to the surface, goes round it on a helix,
/// which is its geodesic, and leaves straight along the tangent.
struct EdgeTouch {
  bool touches = false;
  /// theta, rad: by which the line turns about the edge; where it does not touch, negative: by as
  /// much it would have to turn further until it did.
  double wrap = 0.0;
  double winding = 1.0;  ///< +1 or -1: it turns about `along_W`, or against it
  double first_angle = 0.0, last_angle = 0.0;  ///< where it comes and leaves, rad
  double first_place = 0.0, last_place = 0.0;  ///< the same two along the axis, m

  Vector3 first_W(const PlacedEdge& edge) const { return edge.point_W(first_angle, first_place); }
  Vector3 last_W(const PlacedEdge& edge) const { return edge.point_W(last_angle, last_place); }
  /// Of the helix, m.
  double arc(const PlacedEdge& edge) const;
};

/// More edges than these in one stretch of a rope are not taken.
inline constexpr int most_edges_in_chain = 6;

/// Shortest line from one point to another round a chain of edges, in this order.
///
/// Seen along the axis of an edge of the radius R, with the ends of the two straight parts at d_A
/// and d_B from it, and Delta the angle that the line sweeps about it on the outside,
///   theta = |Delta| - arccos(R / d_A) - arccos(R / d_B),
/// and the line touches where theta > 0. Unrolled, it is straight: over
///   sqrt(d_A^2 - R^2) + R theta + sqrt(d_B^2 - R^2)
/// across the axis and what lies between the ends along it. So one edge has a closed form. Of
/// several each is laid by that form between its neighbours, in turn, which finds those that touch;
/// then Newton's method fulfils the conditions of all (EdgeConditions) to rounding. Length and
/// direction are continuous where an edge begins to be touched, since it begins with theta = 0. An
/// edge has no ends here: its line goes on. The ends of the line may lie anywhere but within a
/// cylinder, or right behind an edge, where the side on which it passes would change.
/// @param touches one for each edge; what is in it does not matter. Does not allocate.
/// @throws ModelError if an end lies within a cylinder, or no line is found.
/// Source: do Carmo (1976), 4-4 (geodesics of the cylinder); Scholz et al. (2016), A fast multi-
/// obstacle muscle wrapping method, for the conditions at the tangent points.
void find_shortest_line(const Vector3& first_W, const Vector3& last_W,
                        std::span<const PlacedEdge> edges, std::span<EdgeTouch> touches);

/// What makes a line round edges the shortest, linearised: how the places of its touch move with
/// the bodies.
///
/// Of each touched edge the unknowns z are (angle, place) where the line comes and (angle, place)
/// where it leaves, or the place alone of an edge without radius. With u the directions of the
/// straight parts, n the normals and a = u_in . along, their conditions F(z) = 0 are
///   u_in . n_in = 0,   u_out . n_out = 0,   (u_in - u_out) . along = 0,
///   (s_out - s_in) sqrt(1 - a^2) - R theta a = 0,
/// or the third alone. A node is a place where the line bends: its first end, each touched edge's
/// one or two places, its last end.
class EdgeConditions {
 public:
  static constexpr int most_nodes = 2 * most_edges_in_chain + 2;
  static constexpr int most_unknowns = 4 * most_edges_in_chain;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                               most_unknowns, most_unknowns>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_unknowns, 1>;
  /// Changes of z by the motion (turn; displacement) of each node's body there: 6 columns a node.
  using ByMotion = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                 most_unknowns, 6 * most_nodes>;
  /// Displacement of a node within its body by z.
  using NodeShift = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, most_unknowns>;

  EdgeConditions(const Vector3& first_W, const Vector3& last_W, std::span<const PlacedEdge> edges,
                 std::span<const EdgeTouch> touches);

  int unknown_count() const { return unknowns_; }
  int node_count() const { return nodes_; }
  const Vector& residual() const { return residual_; }
  const Matrix& jacobian() const { return jacobian_; }
  /// dz by the motion of the nodes' bodies, so that the conditions stay fulfilled.
  ByMotion calc_change() const;
  /// dz/dt by the velocities of the nodes' bodies there, one a node.
  Vector calc_rate(std::span<const MotionVector> velocities) const;
  NodeShift shift_of(int node) const;

  /// Adds a step of z to the touches.
  static void add_step(const Vector& step, std::span<const PlacedEdge> edges,
                       std::span<EdgeTouch> touches);

 private:
  struct Node {
    Vector3 p_W = Vector3::Zero();
    Vector3 by_angle = Vector3::Zero(), by_place = Vector3::Zero();
    int angle = -1, place = -1;  // columns of z; -1: none
  };
  // A straight part, from a node to the next.
  struct Part {
    Vector3 u = Vector3::Zero();
    Matrix3 turn = Matrix3::Zero();  // du by the displacement of its end
  };
  struct Edge {
    const PlacedEdge* placed = nullptr;
    const EdgeTouch* touch = nullptr;
    int first_node = 0, last_node = 0, row = 0;
  };

  void place_nodes(const Vector3& first_W, const Vector3& last_W, std::span<const PlacedEdge> edges,
                   std::span<const EdgeTouch> touches);
  // row += w . (change of the direction of a part) by z.
  void add_direction(int row, const Vector3& w, int part, double sign = 1.0);
  void add_direction(int row, const Vector3& w, int part, double sign, ByMotion& by) const;
  void add_edge(const Edge& edge);
  // dF by the motion of the nodes' bodies at a held z.
  ByMotion calc_by_motion() const;

  int unknowns_ = 0, nodes_ = 0, edges_ = 0;
  std::array<Node, most_nodes> node_;
  std::array<Part, most_nodes> part_;  // by its first node; none along an arc
  std::array<Edge, most_edges_in_chain> edge_;
  Vector residual_;
  Matrix jacobian_;
};

}  // namespace blocklift::dynamics
