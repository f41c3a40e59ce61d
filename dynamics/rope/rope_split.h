#pragma once

#include "dynamics/rope/rope.h"

namespace blocklift::dynamics {

/// What a rope does at one of its bends: a sheave or an edge at which it rubs.
enum class BendMotion : signed char {
  to_first = -1,  ///< it slips towards its first point
  sticks = 0,
  to_last = 1  ///< it slips towards its last point
};

/// How a rope with friction at its bends is divided among the lengths between them.
///
/// Bends are the sheaves of a rope with friction there, and each edge with friction that it may
/// touch, in the order of its path. Each length i between two of them, L_i long, has an unstretched
/// length l_i and a tension of its own:
///   X_i = (L_i - l_i) / C_i,   C_i = l_i / EA, for the first one + 1/k_crane,   sum l_i = L0.
/// At the bend between the lengths a and b, with the wrap theta of that instant and the friction
/// mu, the rope sticks (nothing passes) while
///   exp(-mu theta) < X_a / X_b < exp(mu theta),
/// and slips towards the greater tension at that ratio (Euler 1769, Eytelwein 1808). What it does
/// is fixed between two events, as it is for ropes that are taut or slack: where it slips, the
/// ratio divides the rope whatever was before, one equation for all lengths joined by slipping
/// bends; where it sticks, `l_i` of the lengths beyond is what was held there. Both laws are
/// smooth.
///
/// Of a sheave theta is the angle between the directions beside it. Of an edge it is the curvature
/// of the helix along its arc, (angle about the axis) cos(a), with a the slope of the rope against
/// the plane across the axis; a sharp edge is a round one without radius. Friction acts along the
/// rope, so that a rope that slips still runs on the geodesic: the edge's body bears T_b u_b where
/// it leaves, and -T_a u_a where it comes. An edge that is not touched divides nothing.
///
/// At an edge the places of touch move over the surface where nothing slips: a rope rolls on a
/// cylinder that turns under it. Lengths are therefore measured to a place G beyond the middle of
/// the arc, G being the way by which that middle has gone over the surface along the rope, since
/// friction began to act:
///   L_a -> L_a - G,   L_b -> L_b + G,
/// whose rates are those by the bodies' motion alone, without that of the places of touch. In the
/// plane G is R (angle of the middle) exactly; where the rope also moves sideways over an oblique
/// edge it is a sum over the steps of the integration (carry), by trapezoids.
///
/// Lengths joined by slipping bends, or one between bends at which the rope sticks, are damped
/// together, as their tensions are to one another, so that the ratios stay and nothing pushes:
///   T_i = X_i + rho_i D,   rho_i = X_i / X,   X = sum C_i X_i / sum C_i,
///   D = max(c R / (k sum C_i), -X),   R = sum rho_i (dL_i/dt - dl_i/dt),
/// c and k being those of the rope without friction (Rope). The rope is taut or slack as it is
/// without friction.
///
/// Energy: stored sum C_i X_i^2 / 2; dissipated sum D R, and
///   s ((T_b + X_b^2/2EA) - (T_a + X_a^2/2EA))
/// at a bend over which the rope runs from a to b at the rate s (unstretched, against the surface,
/// m/s); supplied -dL0/dt (T_1 + X_1^2/2EA). Made once, then used without allocating.
///
/// Source: the ratio from the balance of an element of rope on the surface, for a geodesic by its
/// normal curvature; the energy follows from the law above by differentiation.
class RopeSplit {
 public:
  /// Does not act yet: the rope has one tension.
  explicit RopeSplit(const Rope& rope);

  /// Has the rope bends with friction?
  bool rubs() const { return !bends_.empty(); }
  /// Has it edges with friction?
  bool rubs_at_edges() const { return rubs_at_edges_; }
  /// Does the friction act?
  bool acts() const { return acts_; }
  std::size_t bend_count() const { return bends_.size(); }
  BendMotion motion(std::size_t bend) const { return bends_[bend].motion; }
  /// What the rope does there from now on; lengths are held as they are.
  void set_motion(std::size_t bend, BendMotion motion);

  /// From now on friction acts: the rope is divided as without it, at one tension, and sticks, or,
  /// where it carries nothing, begins to do what the rates of its lengths ask for.
  /// @param load of the rope without friction, at this instant.
  void begin(const Rope& rope, const Kinematics& kinematics, const RopePath& path,
             const RopeLoad& load);

  /// Tensions of the lengths; `load` of the rope without friction, which is taut, becomes that with
  /// it.
  /// @throws ModelError if a length has run wholly over its bend.
  void divide(const Rope& rope, const Kinematics& kinematics, const RopePath& path, RopeLoad& load);

  /// At the end of a step of the integration: how the places of touch have moved over the edges is
  /// counted from here on. Tensions stay.
  void carry(const Rope& rope, const Kinematics& kinematics, const RopePath& path);

  // Of the instant that `divide` has just evaluated:
  /// T_i, N.
  double tension(std::size_t length) const { return lengths_[length].tension; }
  /// T of a segment of the path, N.
  double tension_of_segment(std::size_t segment) const {
    return lengths_[segments_[segment].first_length].tension;
  }
  /// l_i, m.
  double unstretched_length(std::size_t length) const { return lengths_[length].unstretched; }
  /// theta, rad; zero at an edge that is not touched.
  double wrap(std::size_t bend) const { return bends_[bend].angle; }
  /// s, unstretched, towards the last point, m/s.
  double slip_rate(std::size_t bend) const { return bends_[bend].slip_rate; }
  /// Positive while the rope goes on as it does at the bend, negative where it begins to slip, or
  /// ceases to, continuous between: kN by which it sticks, or rate of tension that slips, kN/s. At
  /// an edge that is not touched nothing changes, but that the rope ceases to stick.
  double indicator(std::size_t bend) const;
  /// Where it begins to slip to.
  BendMotion tendency(std::size_t bend) const;

  /// Adds the pull of the lengths to the bodies along the path.
  void add_forces(const RopePath& path, std::vector<ForceVector>& F_Bo_W) const;
  /// Derivatives of that, but for those of the wraps and of rho, and with edges of what their
  /// sliding does to damping: small beside the stiffness by the strain of the rope, they only cost
  /// an iteration.
  void add_derivatives(const Rope& rope, const Kinematics& kinematics, const RopePath& path,
                       ForceDerivatives& derivatives) const;

 private:
  struct Length {
    double length = 0.0, rate = 0.0;       // L_i, m and m/s
    double held = not_a_number;            // l_i where the bend before it sticks, m
    double unstretched = not_a_number;     // l_i, m
    double unstretched_rate = 0.0;         // m/s
    double series = 0.0;                   // compliance of what it hangs from, m/N
    double compliance = 0.0;               // C_i, m/N
    double ratio = 1.0, ratio_rate = 0.0;  // X_i over that of the first of its group
    double elastic = 0.0;                  // X_i, N
    double tension = 0.0;                  // T_i, N
    double share = 1.0;                    // rho_i
    double damping = 0.0;                  // c / (k sum C_i), N s/m
    double yield = 0.0;                    // dl_i/dL_i at a held X_i
  };
  // Middle of an arc on its edge: way round the axis and along it, in the rope's sense (m), and the
  // sine of the rope's slope there.
  struct Middle {
    double round = 0.0, place = 0.0, slope = 0.0;
  };
  struct Bend {
    int edge = -1;          // of the rope; -1: a sheave
    std::size_t point = 0;  // of the rope: the sheave, or the one before the edge
    double friction = 0.0;
    BendMotion motion = BendMotion::sticks;
    bool touches = true;
    double angle = 0.0, rate = 0.0;  // rad, rad/s
    double slip_rate = 0.0;          // m/s
    // Of the instant, and of the end of the last step.
    Middle middle = {}, carried_middle = {};
    bool is_carried = false;  // was it touched then?
    double carried = 0.0;     // G then, m

    bool sticks() const { return touches && motion == BendMotion::sticks; }
    double shift() const;  // G, m
  };
  // A straight part of the path.
  struct Segment {
    std::size_t first_length = 0, last_length = 0;  // between them edges that it does not touch
    double length = 0.0, rate = 0.0;                // m, m/s
    Vector3 velocity_W = Vector3::Zero();           // of its end against its beginning, m/s
  };

  // How far along a path it is measured.
  struct Cursor {
    std::size_t bend = 0;   // the next one, and the length before it
    std::size_t point = 0;  // the rope's own that was passed last
    Vector3 p_W = Vector3::Zero(), v_W = Vector3::Zero();
  };

  void measure(const Rope& rope, const Kinematics& kinematics, const RopePath& path);
  void take_segment(const RopePath& path, std::size_t segment, const Vector3& p_W,
                    const Vector3& v_W, int edge, Cursor& at);
  void take_edge(const Rope& rope, const Kinematics& kinematics, const RopePath& path,
                 std::size_t point, Cursor& at);
  void wrap_sheave(Bend& bend, const RopePath& path, std::size_t point) const;
  void wrap_edge(Bend& bend, const Rope& rope, const Kinematics& kinematics, const RopePath& path,
                 std::size_t point) const;
  std::size_t end_of_group(std::size_t first) const;
  void divide_group(std::size_t first, std::size_t last, double unstretched, double rate);
  double find_tension(std::size_t first, std::size_t last, double unstretched) const;
  void require_lengths(const Rope& rope, std::size_t first, std::size_t last) const;
  double damp_group(std::size_t first, std::size_t last, double damping_over_stiffness,
                    double fed_rate);

  bool rubs_at_edges_ = false, acts_ = false;
  double axial_stiffness_;  // EA, N
  std::vector<Bend> bends_;
  std::vector<Length> lengths_;
  std::vector<Segment> segments_;  // of the path
  std::size_t segment_count_ = 0;
  std::vector<Vector3> turning_;  // rate of each segment's direction, 1/s
};

/// One for each rope.
std::vector<RopeSplit> make_rope_splits(const std::vector<Rope>& ropes);

}  // namespace blocklift::dynamics
