#pragma once

#include <functional>

#include "dynamics/marine/radiation/radiation.h"
#include "dynamics/simulation/history.h"

namespace blocklift::dynamics {

/// What an integration may wait for, and end at.
struct AwaitedCondition {
  enum class Kind {
    slack,           ///< the rope pulls no more
    taut,            ///< it pulls
    ropes_at_least,  ///< ropes bear this much of the body: their force upwards
    ropes_at_most,   ///< or no more than this
    pads_at_least    ///< pads bear this much of it
  };
  Kind kind = Kind::slack;
  int rope = -1;
  BodyIndex body = -1;
  double force = not_a_number;  ///< N
  double from = 0.0;            ///< s, a breakpoint of the operation: not before
  double until = not_a_number;  ///< s: nor after

  /// Positive where it is met, negative where it is not, continuous between, kN; of the instant
  /// that calc_contact_loads has just evaluated.
  double indicator(const LiftSystem& system, const LiftWorkspace& w) const;
};

/// An instant of a run from which another may go on.
struct Departure {
  double time = 0.0;                     ///< s
  Eigen::VectorXd q, v;                  ///< nq, nv
  Eigen::VectorXd memory;                ///< of the radiated water
  std::vector<Vector3> standing_places;  ///< of each pad, m
  std::vector<RopeSplit> splits;         ///< of each rope

  /// Of the instant that a workspace holds, at a sample.
  static Departure of(double time, const LiftWorkspace& w) {
    return {time, w.q, w.v, w.memory, w.standing_places, w.splits};
  }
};

struct IntegrationSettings {
  /// Local error allowed over one step, relative to 1 m for displacements, 1 rad for angles, and to
  /// the larger of 1 m/s (1 rad/s) and the value for velocities: it does not depend on where the
  /// world's origin lies. Root mean square over the unknowns of the mechanism, however many the
  /// water's memory adds.
  double relative_tolerance = 1e-6;
  double sample_interval = 0.05;  ///< s
  bool works = true;              ///< accumulate the works of drives, winches, wind and dissipation
  /// Of each sample. The works go with the energies, and are left out with them.
  Recording recording = {};
  /// Nor may a hundredth of them bring it less than a hundredth of the way.
  long largest_step_count = 50'000'000;
  /// Are the forces of a sea of many waves found ahead (WaveForecast), or at each state?
  bool forecast_waves = true;
  /// The water's surface to be marched beside (MarchedSurface), from calm; null: none. The system's
  /// water then has its added mass and no states.
  DirectRadiation* surface = nullptr;
  double surface_step = not_a_number;  ///< s
  /// The run ends when this is met, or when it may not be met any more.
  std::optional<AwaitedCondition> awaited = {};
  /// The run, and its samples, begin there in place of time 0; null: they do not. No surface is
  /// marched then, and no drive steered.
  const Departure* departure = nullptr;
  /// The run, and its samples, end here, at a breakpoint of the operation, s, or with the first
  /// step beyond; none: with the operation.
  std::optional<double> end = {};
  /// Called now and then with the fraction done and the time (s); may be empty.
  std::function<void(double, double)> progress = {};
  /// Called at each sample with its number and time (s) and the workspace of that instant:
  /// positions, velocities, loads of contacts, and, where the recording takes dynamics, all
  /// loads, accelerations and multipliers are those of the sample. May be empty.
  std::function<void(Eigen::Index, double, const LiftWorkspace&)> observe = {};
};

/// What the integration cost.
struct IntegrationStatistics {
  long steps = 0;
  long right_hand_sides = 0;             ///< of the equations, for the method's own steps
  long difference_right_hand_sides = 0;  ///< besides, for Jacobians by finite differences
  long jacobians = 0;       ///< analytical, each at the price of a few right-hand sides
  long factorisations = 0;  ///< of the matrix of Newton's method
  long newton_iterations = 0;
  long error_test_failures = 0;
  long nonlinear_failures = 0;
  long restarts = 0;         ///< at events and jumps of a motion
  long contact_changes = 0;  ///< ropes and lines that went slack or taut, pads loaded or lifted off
  long bend_changes = 0;     ///< bends with friction at which a rope began to slip or to stick
};

/// A rope, pad or tugger line that began or ceased to act.
struct ContactEvent {
  double time = not_a_number;  ///< s
  int contact = -1;            ///< among Contacts
  bool acts = false;
};

/// A rope that parted, with the energy that was stored and was set free.
struct PartedRope {
  int rope = -1;
  double time = not_a_number;     ///< s
  double tension = not_a_number;  ///< before, N
  double energy = not_a_number;   ///< J
};

struct IntegrationResult {
  History history;
  IntegrationStatistics statistics;
  std::vector<ContactEvent> events;  ///< in order of time
  Eigen::VectorXd q_end, v_end;      ///< state at the end, nq and nv
  std::vector<PartedRope> parted = {};
  std::optional<double> met = {};    ///< when the awaited condition was, s; samples end there
  std::vector<Course> courses = {};  ///< of the operation's steered drives, in their order
};

/// Integrates the operation from (q, v) (nq and nv; driven entries are replaced by the drives')
/// over its whole duration.
///
/// BDF with Newton's method (CVODES), quaternions projected back to unit length at every step.
/// Steps end at stage changes and wherever a motion is not smooth, and at each instant at which a
/// rope or tugger line goes slack or taut or a pad is loaded or lifts off: which of them act is
/// fixed during a step, so that no step crosses a change, and the integration starts anew behind
/// it. Samples come from the method's own interpolation; tensions and, where they are recorded,
/// accelerations and drive forces are computed anew from the interpolated state, so that each
/// sample is consistent in itself. Largest loads are those of the samples. The motion is the same
/// bit for bit, whatever is recorded.
///
/// Ropes with friction at sheaves or edges begin with one tension all along, as in equilibrium, and
/// stick. Where one begins to slip, or ceases to, is an event too (RopeSplit).
///
/// A condition that is awaited is one more event: its instant is found as those of contacts
/// are.
///
/// Drives that are steered look at what is, and go on accordingly, at instants at which steps end
/// (Steersman); their motion is smooth there, and the integration goes on without starting anew.
///
/// A rope that parts pulls no more from then on; the energy that it had stored counts as
/// dissipated.
///
/// A mechanism with loops is assembled first: the closest configuration and velocities that its
/// loops allow. Every step ends with positions and velocities projected back onto the loops (and
/// the error estimate along them); which equations are independent is judged there anew, so that
/// loops may repeat one another. Samples lie on the loops, their multipliers are the least that
/// balance them.
///
/// @throws SimulationError if the loops cannot be closed at the start, or when a step fails: time,
/// ropes, bodies, and what to try.
IntegrationResult integrate(const LiftSystem& system, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& v, const IntegrationSettings& settings = {});

}  // namespace blocklift::dynamics
