#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/force/force_element.h"
#include "dynamics/multibody/motion_profile.h"

namespace blocklift::dynamics {

/// By a winch: a point is to stay as high as another, or above it by a difference.
struct KeptHeight {
  BodyPoint point;
  BodyPoint reference;  ///< a point of the world: a height
  /// Of the point over the reference, m; none: as it is when the keeping begins.
  std::optional<double> difference;
};

/// By a joint's drive: the head of a crane is to stay plumb over a point, as near as that drive
/// alone can bring it.
struct KeptPlumb {
  BodyPoint head;
  BodyPoint target;
};

/// By the winch of a rope: its tension is to stay.
struct KeptTension {
  int rope = -1;
  double tension = not_a_number;  ///< N
  /// By how much the tension falls for each metre that is let out, N/m; none: the rope's own.
  std::optional<double> stiffness = {};
};

/// By the winch of a rope: its part of what it and others pull is to stay.
struct KeptShare {
  int rope = -1;
  std::vector<int> others;
  double share = not_a_number;  ///< T / (T + sum of the others' T)
  /// By how much T - share (T + sum of the others' T) falls a metre let out, N/m.
  std::optional<double> stiffness = {};
};

/// What a law from outside sees at a look: one figure each.
struct SeenHeight {
  BodyPoint point;
  BodyPoint reference;  ///< z_point - z_reference, m
};
/// The travel by which this drive alone would bring the head plumb over the target (KeptPlumb),
/// m or rad.
struct SeenPlumb {
  BodyPoint head;
  BodyPoint target;
};
struct SeenTension {
  int rope = -1;  ///< N
};
/// T / (T + sum of the others' T); 0 while none of them pulls.
struct SeenShare {
  int rope = -1;
  std::vector<int> others;
};
/// The drive's coordinate, or the winch's rope length left out: m or rad.
struct SeenCoordinate {};
/// Its rate, m/s or rad/s.
struct SeenRate {};
using Sight = std::variant<SeenHeight, SeenPlumb, SeenTension, SeenShare, SeenCoordinate, SeenRate>;

/// The speed (m/s or rad/s; of a winch positive where rope is let out) that a drive is asked for,
/// after the time (s) and what is seen then.
using SpeedLaw = std::function<double(double time, std::span<const double> seen)>;

/// By a law from outside, of anybody's making.
struct OwnLaw {
  std::string name;           ///< for messages
  std::vector<Sight> sights;  ///< what the law is given, in this order
  /// Makes the law anew for a run, so that none remembers another run. Both may throw whatever they
  /// like: it ends the integration and arrives unchanged.
  std::function<SpeedLaw()> begin;
};

using Wish = std::variant<KeptHeight, KeptPlumb, KeptTension, KeptShare, OwnLaw>;

/// A drive or winch that an operator steers after what he sees, in place of a motion known before.
///
/// At even instants he sees the travel e by which the drive alone would fulfil the wish. A reaction
/// time later he asks for the speed
///   u = (e - tolerance sign e) / correction_time where |e| > tolerance, else 0,   |u| <= speed,
/// and the drive goes over to it within its acceleration and jerk. So in the long run it lags
/// behind a wish that moves at the speed V by V correction_time + tolerance, and corrects what it
/// sees without overshooting while the correction time is longer than e (2.72) times the reaction.
/// At the end, or where the drive's range would be left, it brakes.
///
/// Travel of the wishes, for winches positive where rope is let out:
///   height   z_point - z_reference - difference
///   plumb    J.d / J.J, d the level vector from head to target, J the level velocity of the head
///            while the drive's is 1 (with what loops of the crane take along)
///   tension  (T - wanted) / k, k the stiffness against letting out: the rope's at its length,
///            which nothing exceeds, so that it never asks for too much
///   share    (T - share (T + sum T_others)) / k
/// A law from outside has no travel: it is asked at each look until the end and gives u itself,
/// which the drive is asked for a reaction time later, |u| <= speed.
struct Steering {
  std::string drive;
  Wish wish = KeptHeight{};
  double start = not_a_number;            ///< s
  double end = not_a_number;              ///< s: from then on it brakes
  double reaction = 0.0;                  ///< s
  double correction_time = not_a_number;  ///< s; of no meaning for a law from outside
  double tolerance = 0.0;         ///< in the wish's unit: m, N, 1; no law from outside has it
  double longest_interval = 0.2;  ///< between two looks, s
  MotionLimits limits{};
  double lowest = not_a_number;   ///< coordinate that the drive may not leave, m or rad
  double highest = not_a_number;  ///< the other end of its range

  // Set by OperationBuilder.
  bool is_winch = false;
  std::size_t index = 0;                              ///< of the drive or winch in the operation
  MotionProfile base = MotionProfile::constant(0.0);  ///< its coordinate without the steering
  std::optional<double> stop_time = {};               ///< from which on a stop overrules it, s
  double stop_duration = not_a_number;                ///< s

  /// Between two looks, s: the longest, or less, so that the reaction is a number of them.
  double interval() const;
  /// Looks that the reaction takes.
  int looks_behind() const;
  /// Looks from the start until it certainly stands.
  int look_count() const;
  /// Until when the drive certainly stands, s.
  double stand() const { return start + look_count() * interval(); }
};

/// Motion of a steered drive at one of its looks.
struct SteeredMotion {
  double travel = 0.0, speed = 0.0, acceleration = 0.0;
};

/// The acceleration an interval (s) later with which a drive goes over to the speed `wanted` in
/// shortest time, accelerations being straight between: jerk and acceleration stay within their
/// limits and the speed does not overshoot; near by it is there after two intervals.
double find_next_acceleration(const SteeredMotion& motion, double wanted, double interval,
                              const MotionLimits& limits);
/// The motion an interval later.
SteeredMotion advance(const SteeredMotion& motion, double next_acceleration, double interval);

}  // namespace blocklift::dynamics
