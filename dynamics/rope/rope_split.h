#pragma once

#include "dynamics/rope/rope.h"

namespace blocklift::dynamics {

/// What a rope does at one of its sheaves.
enum class SheaveMotion : signed char {
  to_first = -1,  ///< it slips towards its first point
  sticks = 0,
  to_last = 1  ///< it slips towards its last point
};

/// How a rope with friction at its sheaves is divided among the lengths between them.
///
/// Each length i between two points of the path, L_i long, has an unstretched length l_i and a
/// tension of its own:
///   X_i = (L_i - l_i) / C_i,   C_i = l_i / EA, for the first one + 1/k_crane,   sum l_i = L0.
/// At the sheave between the lengths a and b, with the wrap theta (angle between their directions,
/// of that instant) and the friction mu, the rope sticks (nothing passes) while
///   exp(-mu theta) < X_a / X_b < exp(mu theta),
/// and slips towards the greater tension at that ratio (Euler 1769, Eytelwein 1808). What it does
/// is fixed between two events, as it is for ropes that are taut or slack: where it slips, the
/// ratio divides the rope whatever was before, one equation for all lengths joined by slipping
/// sheaves; where it sticks, `l_i` of the lengths beyond is what was held there. Both laws are
/// smooth.
///
/// Lengths joined by slipping sheaves, or one between sheaves at which the rope sticks, are damped
/// together, as their tensions are to one another, so that the ratios stay and nothing pushes:
///   T_i = X_i + rho_i D,   rho_i = X_i / X,   X = sum C_i X_i / sum C_i,
///   D = max(c R / (k sum C_i), -X),   R = sum rho_i (dL_i/dt - dl_i/dt),
/// c and k being those of the rope without friction (Rope). The rope is taut or slack as it is
/// without friction.
///
/// Energy: stored sum C_i X_i^2 / 2; dissipated sum D R, and
///   s ((T_b + X_b^2/2EA) - (T_a + X_a^2/2EA))
/// at a sheave over which the rope runs from a to b at the rate s (unstretched, m/s); supplied
/// -dL0/dt (T_1 + X_1^2/2EA). Made once, then used without allocating.
///
/// Source: the ratio from the balance of an element of rope on the sheave; the energy follows from
/// the law above by differentiation.
class RopeSplit {
 public:
  /// Does not act yet: the rope has one tension.
  explicit RopeSplit(const Rope& rope);

  /// Has the rope sheaves with friction?
  bool rubs() const { return rubs_; }
  /// Does the friction act?
  bool acts() const { return acts_; }
  std::size_t sheave_count() const { return motion_.size(); }
  SheaveMotion motion(std::size_t sheave) const { return motion_[sheave]; }
  /// What the rope does there from now on; lengths are held as they are.
  void set_motion(std::size_t sheave, SheaveMotion motion);

  /// From now on friction acts: the rope is divided as without it, at one tension, and sticks, or,
  /// where it carries nothing, begins to do what the rates of its lengths ask for.
  /// @param load of the rope without friction, at this instant.
  void begin(const Rope& rope, const Kinematics& kinematics, const RopePath& path,
             const RopeLoad& load);

  /// Tensions of the lengths; `load` of the rope without friction, which is taut, becomes that with
  /// it.
  /// @throws ModelError if a length has run wholly over its sheave.
  void divide(const Rope& rope, const Kinematics& kinematics, const RopePath& path, RopeLoad& load);

  // Of the instant that `divide` has just evaluated:
  /// T_i, N.
  double tension(std::size_t length) const { return lengths_[length].tension; }
  /// l_i, m.
  double unstretched_length(std::size_t length) const { return lengths_[length].unstretched; }
  /// theta, rad.
  double wrap(std::size_t sheave) const { return wraps_[sheave].angle; }
  /// s, unstretched, towards the last point, m/s.
  double slip_rate(std::size_t sheave) const { return wraps_[sheave].slip_rate; }
  /// Positive while the rope goes on as it does at the sheave, negative where it begins to slip, or
  /// ceases to, continuous between: kN by which it sticks, or rate of tension that slips, kN/s.
  double indicator(std::size_t sheave) const;
  /// Where it begins to slip to.
  SheaveMotion tendency(std::size_t sheave) const;

  /// Adds the pull of the lengths to the bodies along the path.
  void add_forces(const Rope& rope, const RopePath& path, std::vector<ForceVector>& F_Bo_W) const;
  /// Derivatives of that, but for those of the wraps and of rho: small beside the stiffness by the
  /// strain of the rope, they only cost an iteration.
  void add_derivatives(const Rope& rope, const RopePath& path, ForceDerivatives& derivatives) const;

 private:
  struct Length {
    double length = 0.0, rate = 0.0;       // L_i, m and m/s
    double held = not_a_number;            // l_i where the sheave before it sticks, m
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
    Vector3 velocity_W = Vector3::Zero();  // of its end against its beginning, m/s
  };
  struct Wrap {
    double angle = 0.0, rate = 0.0;  // rad, rad/s
    double slip_rate = 0.0;          // m/s
  };

  void measure(const Rope& rope, const Kinematics& kinematics, const RopePath& path);
  std::size_t end_of_group(std::size_t first) const;
  void divide_group(std::size_t first, std::size_t last, double unstretched, double rate);
  double find_tension(std::size_t first, std::size_t last, double unstretched) const;
  void require_lengths(const Rope& rope, std::size_t first, std::size_t last) const;
  double damp_group(std::size_t first, std::size_t last, double damping_over_stiffness,
                    double fed_rate);

  bool rubs_ = false, acts_ = false;
  double axial_stiffness_;  // EA, N
  double friction_;         // mu
  std::vector<Length> lengths_;
  std::vector<Wrap> wraps_;
  std::vector<SheaveMotion> motion_;
};

/// One for each rope.
std::vector<RopeSplit> make_rope_splits(const std::vector<Rope>& ropes);

}  // namespace blocklift::dynamics
