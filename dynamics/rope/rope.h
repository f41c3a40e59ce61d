#pragma once

#include <limits>
#include <optional>
#include <span>

#include "dynamics/force/force_element.h"
#include "dynamics/force/one_sided.h"
#include "dynamics/rope/catenary.h"
#include "dynamics/rope/edge_wrap.h"
#include "dynamics/rope/tension_law.h"

namespace blocklift::dynamics {

/// That a path over edges may have; each edge counts as two.
inline constexpr std::size_t most_points_over_edges = 32;

/// A straight edge of a body, or a cylinder about it, that a rope may touch.
struct RopeEdge {
  std::string name;
  BodyIndex body = world_index;
  std::size_t after = 0;  ///< the rope meets it between this one of its points and the next
  Vector3 begin_B = Vector3::Constant(not_a_number);  ///< of its axis, m
  Vector3 end_B = Vector3::Constant(not_a_number);    ///< m
  /// Away from what it is an edge of; of any length, its part across the axis counts. The rope
  /// stays on that side.
  Vector3 outside_B = Vector3::Constant(not_a_number);
  double radius = 0.0;    ///< m; zero: sharp
  double friction = 0.0;  ///< mu between it and the rope (RopeSplit); zero: smooth

  /// As it lies in its body's frame.
  PlacedEdge in_body() const;
};

/// What a modeller says about a rope.
struct RopeDefinition {
  std::string name;
  std::vector<BodyPoint> points;  ///< from the winch's end through sheaves to the far end
  /// For each segment between two points: does the rope not run there? Empty: it runs along all.
  /// One rope that is reeved through two tackles has such a segment between their upper sheaves.
  std::vector<char> left_out = {};
  /// Two falls with half of the tension each, as the falls of a tackle at whose far end a block may
  /// turn: from the first point to the second, and from the third to the fourth. What lies between
  /// them is left out.
  bool twin_falls = false;
  double axial_stiffness = not_a_number;  ///< EA of all falls together, N
  /// In place of EA: tension over strain, of all falls together. Such a rope has neither weight nor
  /// friction.
  std::optional<TensionLaw> tension_law = {};
  /// Stiffness of what the rope hangs from, in series with it, N/m; infinite: rigid.
  double crane_stiffness = std::numeric_limits<double>::infinity();
  double damping_time = 0.0;  ///< Kelvin-Voigt: this time the stiffness is the damping, s
  double damping = 0.0;       ///< further damping that does not change with the length, N s/m
  double unstretched_length = not_a_number;  ///< at the start of the operation, m
  /// w, N/m: above zero the rope hangs as a catenary, and has two points; zero: it runs straight.
  double weight_per_length = 0.0;
  /// mu between the rope and each of its sheaves (RopeSplit); zero: its tension is one all along.
  double sheave_friction = 0.0;
  /// Edges that it may touch, in the order of its path.
  std::vector<RopeEdge> edges = {};
};

/// What the winch leaves out: unstretched length of the rope (m) and its rate (m/s).
struct RopeFeed {
  double unstretched_length = not_a_number;
  double rate = 0.0;
  bool parted = false;  ///< the rope has broken and pulls no more
};

/// Displacement of a rope's end within the body that carries it, and its rate (m, m/s, in B).
struct RopeEndShift {
  Vector3 displacement_B = Vector3::Zero();
  Vector3 rate_B = Vector3::Zero();
};
/// Of both ends of a rope.
struct RopeEndShifts {
  RopeEndShift first, last;
};

/// Where a rope runs at one instant. Made once for the longest rope, filled without allocating.
///
/// Its points are those of the rope, and between them those at which it comes to an edge that it
/// touches and leaves it; one alone where the edge has no radius.
struct RopePath {
  std::size_t count = 0;              ///< of its points at this instant
  std::vector<BodyIndex> body;        ///< for each point
  std::vector<int> edge;              ///< for each point, of the rope's edges; -1: none
  std::vector<Vector3> r_W;           ///< for each point, from its body's origin, in W, m
  std::vector<Vector3> direction_W;   ///< for each segment, unit, towards the next point; zero
                                      ///< where the rope does not run, or goes round an edge
  std::vector<EdgeTouch> touches;     ///< for each edge of the rope
  double length = not_a_number;       ///< m
  double length_rate = not_a_number;  ///< m/s
  double first_height = 0.0;          ///< of the first point over z = 0, m
};

/// What a rope with weight does at its ends, without its damping.
struct HangingForces {
  double level = 0.0;          ///< draws the ends together, level, N
  double first_lift = 0.0;     ///< on the body at the first point, upwards, N
  double last_lift = 0.0;      ///< on the body at the last point, upwards, N
  double damping = 0.0;        ///< c of the chord, N s/m
  double stored_energy = 0.0;  ///< elastic, and of the weight over z = 0, J
  double strain_energy = 0.0;  ///< the elastic part of it, J
  double feed_force = 0.0;     ///< d(stored_energy)/dL0 with the ends held, N
};

/// What a rope with friction at sheaves or edges does, where the friction acts (RopeSplit).
struct SplitLoad {
  bool acts = false;
  double first_tension = 0.0;     ///< of the length from the first point, N
  double last_tension = 0.0;      ///< of the length to the last point, N
  double stored_energy = 0.0;     ///< J
  double dissipated_power = 0.0;  ///< by damping and friction, W
  double feed_force = 0.0;        ///< what the winch takes in for each metre that it pays out, N
};

/// A rope's load at one instant.
struct RopeLoad {
  double length = not_a_number;              ///< L, m
  double length_rate = not_a_number;         ///< m/s
  double unstretched_length = not_a_number;  ///< L0, m
  double unstretched_rate = not_a_number;    ///< m/s
  double stiffness = not_a_number;           ///< k at this L0, with a tension law dT/dL, N/m
  double stiffness_slope = 0.0;              ///< dk/dL, of a tension law, N/m^2
  double elastic_force = not_a_number;       ///< k (L - L0), N; negative when slack
  double damping_force = not_a_number;       ///< c (Ldot - L0dot), N
  double tension = not_a_number;  ///< T, N; the largest of a rope with weight or friction
  bool taut = false;              ///< does the rope pull?
  /// Of a slack rope at an ElasticBody: the elastic force that it has yet to lose, N.
  double kept_force = 0.0;
  HangingForces hanging;  ///< of a rope with weight
  SplitLoad split;        ///< of a rope with friction

  double elongation() const { return length - unstretched_length; }
  /// Positive where the rope pulls, negative where it is slack, continuous between: N.
  double slack_indicator() const { return one_sided_indicator(elastic_force, damping_force); }
};

/// Elastic rope that pulls but never pushes, led over sheaves.
///
/// The sheaves turn without friction, or with it as RopeSplit says; in what follows without. One
/// tension acts along the whole path p_W0 .. p_Wn (world positions, m), but for segments that are
/// left out:
///   L = sum |p_Wi+1 - p_Wi|,   1/k = L0/EA + 1/k_crane,   c = damping_time k + damping,
///   T = max(0, k (L - L0) + c (Ldot - L0dot)) where L > L0, else 0 (one_sided_force),
/// L0 being the unstretched length that the winch leaves out (m), k_crane the stiffness of what the
/// rope hangs from (N/m). The sheaves are points: the wrap around them is not part of the path.
///
/// Twin falls are one rope whose length is the mean of theirs, L = (L_1 + L_2) / 2, so that by the
/// first variation each pulls with T/2. Parallel and plumb at first, 2 b apart, they turn back what
/// hangs on them with T b^2 sin(theta) / L at a twist theta, L being their length by then, with
/// L^2 = h^2 + 2 b^2 (1 - cos(theta)) over a height h. Falls at several radii do the same with the
/// mean of their squares for b^2.
///
/// Energy while taut: stored 1/2 k (L - L0)^2; dissipated (T - k (L - L0)) (Ldot - L0dot); supplied
/// by the winch -L0dot (T + (k (L - L0))^2 / (2 EA)), whose second part is the strain energy of the
/// rope that runs onto the drum. A slack rope has none, but for one that keeps a force. Then the
/// power on the bodies, -T Ldot, is exactly supplied - dissipated - d(stored)/dt, and it equals the
/// power of the point forces. Source: first variation of the path length; SIMO theory manual for
/// stiffness in series.
///
/// With a tension law F in place of EA (tension_law.h) the strain e solves
///   L - L0 = e L0 + F(e)/k_crane,
/// F(e) stands for k (L - L0), and k is the tangent 1/(L0/F'(e) + 1/k_crane), by which it is damped
/// as well. Stored is L0 W(e) + F^2/(2 k_crane) with W = int F de, supplied -L0dot (T + e F - W).
///
/// Between two of its points the rope runs along the shortest line round the edges that it touches
/// (find_shortest_line), whose arcs belong to L. Edges without friction are smooth: since that line
/// is the shortest, the places where it touches may be held for the first variation, and an edge's
/// body bears the pulls of the two straight parts at the points where they come and leave. L and
/// its rate are continuous where it begins or ceases to touch, so that the tension is, without an
/// event; only the stiffness jumps. With friction it runs there, too, and the tensions differ
/// (RopeSplit).
///
/// A rope with weight w between two points is an elastic catenary at rest at each instant, with EA
/// = k L0 (catenary.h): it always pulls, its ends do not pull alike, and its weight is in what they
/// bear. Its inertia is left out. Damping acts along the chord on the part of its rate that
/// stretches the rope, with K the stiffness of the chord:
///   T_d = c (K/k)^2 (Ldot - L0dot), though no more than takes the pull away.
/// `elastic_force` is what it pulls along the chord beyond its own weight w L0, so that a rope
/// counts as slack where it hangs in a bight; `taut` tells that alone, and the law is one on both
/// sides. Energy: stored that of the catenary; supplied by the winch L0dot d(stored)/dL0 at held
/// ends,
///   d(stored)/dL0 = w z - T - T^2/(2 EA) + 1/(2 k_crane L0^2) int T^2 ds
/// of the first point, whose last term is what the spring in series keeps of the strain, less
/// T_d L0dot.
class Rope {
 public:
  /// @throws ModelError if there are fewer than two points, two neighbouring points are the same
  /// point of one body, segments are left out at an end or all or not told for each, twin falls
  /// have not four points or do not leave out what lies between them, a stiffness or length is not
  /// positive, a damping, the weight or the friction is negative, a rope with weight has more than
  /// two points, one with friction at sheaves has none or leaves segments out, or one with a
  /// tension law has a stiffness, a weight or friction besides; or if an edge is not one of a body
  /// of the mechanism, has no length, no side outside, a negative radius or friction, if the edges
  /// are not in order or too many between two points, or if a rope with edges has weight or leaves
  /// segments out.
  Rope(const Mechanism& mechanism, RopeDefinition definition);

  const std::string& name() const { return definition_.name; }
  const RopeDefinition& definition() const { return definition_; }
  const std::vector<BodyPoint>& points() const { return definition_.points; }

  /// Does the rope run along the segment from point i to the next?
  bool runs(std::size_t segment) const {
    return definition_.left_out.empty() || definition_.left_out[segment] == 0;
  }

  /// What a segment counts in the path's length, and so its share of the tension.
  double share() const { return share_; }

  const std::vector<RopeEdge>& edges() const { return definition_.edges; }
  /// Of an edge's axis, unit.
  Vector3 edge_along_W(const Kinematics& kinematics, std::size_t edge) const {
    return kinematics.X_WB[edges()[edge].body].R * edge_axes_[edge].along_B;
  }
  /// The most points that its path has.
  std::size_t most_path_points() const {
    return definition_.points.size() + 2 * definition_.edges.size();
  }

  /// Does it hang by its weight? Else it runs straight.
  bool hangs() const { return definition_.weight_per_length > 0.0; }

  /// k at an unstretched length (m), N/m; with a tension law the tangent at a tension (N).
  double stiffness(double unstretched_length, double tension = 0.0) const;

  /// Kelvin-Voigt and further damping c at a stiffness (N/m), N s/m.
  double damping(double stiffness) const {
    return definition_.damping_time * stiffness + definition_.damping;
  }

  /// Geometry and its rate.
  /// @param shifts of the ends within their bodies; null: none.
  /// @throws ModelError if a point lies on its neighbour (the direction of the pull is undefined),
  /// or within the round of an edge.
  void calc_path(const Kinematics& kinematics, RopePath& path,
                 const RopeEndShifts* shifts = nullptr) const;

  /// Rates of the directions of a path's segments, 1/s, zero for those without a direction. Where
  /// the path turns about an edge the places of its touch move over the edge.
  /// @param turning one for each segment. Does not allocate.
  void calc_turning(const Kinematics& kinematics, const RopePath& path,
                    std::span<Vector3> turning) const;

  /// Load by the law above; of a parted rope as if its ends had met.
  /// @throws ModelError if the winch has pulled the whole rope in (L0 <= 0).
  RopeLoad calc_load(const RopePath& path, const RopeFeed& feed) const;

  /// Load where the rope is known to be taut or slack: the same law without its kink, so that it
  /// is smooth across the instant at which the rope changes. For integrators that locate it.
  RopeLoad calc_load(const RopePath& path, const RopeFeed& feed, bool taut) const;

  /// Adds the pull of a load to the bodies along the path.
  void add_forces(const RopePath& path, const RopeLoad& load,
                  std::vector<ForceVector>& F_Bo_W) const;
  /// Adds the pull of a tension (N) on a rope without weight to the bodies along the path.
  void add_forces(const RopePath& path, double tension, std::vector<ForceVector>& F_Bo_W) const;

  /// Derivatives of the pull of a load that is taut, nothing otherwise: the tension's own,
  ///   dT = k sum g_i.dp_i + c sum (h_i.dp_i + g_i.dv_i),  g_i = dL/dp_i,  h_i = dLdot/dp_i,
  /// and the turning of each segment under it. The feed is held.
  void add_derivatives(const Kinematics& kinematics, const RopePath& path, const RopeLoad& load,
                       ForceDerivatives& derivatives) const;

  /// The part of it that comes of directions and places of touch alone, of a path over edges, with
  /// a tension (N) for each segment.
  void add_turning_over_edges(const Kinematics& kinematics, const RopePath& path,
                              std::span<const double> tensions,
                              ForceDerivatives& derivatives) const;

  /// Energy account of a load, see above.
  EnergyAccount calc_energy(const RopeLoad& load) const;

  /// Force on the body at the first or last point, in W, N; of twin falls that of both.
  Vector3 first_force(const RopePath& path, const RopeLoad& load) const;
  Vector3 last_force(const RopePath& path, const RopeLoad& load) const;
  /// The same of a rope without weight.
  Vector3 first_force(const RopePath& path, double tension) const {
    if (definition_.twin_falls) return tension * mean_direction(path);
    return tension * path.direction_W.front();
  }
  Vector3 last_force(const RopePath& path, double tension) const {
    if (definition_.twin_falls) return -tension * mean_direction(path);
    return -tension * path.direction_W[path.count - 2];
  }

 private:
  static Vector3 mean_direction(const RopePath& path) {
    return 0.5 * (path.direction_W[0] + path.direction_W[2]);
  }
  void check_edges(const Mechanism& mechanism) const;
  std::size_t place_chain(const Kinematics& kinematics, std::size_t after, std::size_t begin,
                          std::span<PlacedEdge> placed) const;
  void calc_path_over_edges(const Kinematics& kinematics, RopePath& path) const;
  // What calc_turning owes to places of touch that move over the edges.
  void add_sliding(const Kinematics& kinematics, const RopePath& path,
                   std::span<Vector3> turning) const;
  // Calls `function` with each chain of a path over edges: the place where it begins in the path,
  // and its conditions.
  template <class Function>
  void for_each_chain(const Kinematics& kinematics, const RopePath& path,
                      const Function& function) const;
  void add_derivatives_over_edges(const Kinematics& kinematics, const RopePath& path,
                                  const RopeLoad& load, ForceDerivatives& derivatives) const;
  RopeLoad calc_elastic_and_damping(const RopePath& path, const RopeFeed& feed) const;
  void require_sound_law() const;
  void stretch_by_law(RopeLoad& load) const;
  double calc_tension_slope(const RopeLoad& load) const;
  double calc_stored(double elastic_force, double unstretched_length, double stiffness) const;
  double calc_complementary(double elastic_force) const;
  void hang(const RopePath& path, const RopeFeed& feed, RopeLoad& load) const;
  Catenary calc_catenary_of(const RopePath& path, double unstretched_length) const;
  void add_hanging_derivatives(const Kinematics& kinematics, const RopePath& path,
                               const RopeLoad& load, ForceDerivatives& derivatives) const;

  RopeDefinition definition_;
  double crane_compliance_;  ///< 1/k_crane, m/N
  double share_;
  /// Of each edge: its frame's axes (along, outside) in its body.
  struct EdgeAxes {
    Vector3 along_B, outside_B;
  };
  std::vector<EdgeAxes> edge_axes_;
};

/// Path workspace large enough for each of the ropes.
RopePath make_rope_path(const std::vector<Rope>& ropes);

}  // namespace blocklift::dynamics
