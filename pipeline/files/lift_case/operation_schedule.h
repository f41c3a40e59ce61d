#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/multibody/motion_profile.h"
#include "dynamics/simulation/operation.h"
#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// A drive of a crane's joint, or the winch of a hoist or of a rope: whatever an operation moves.
struct Mover {
  std::string name;       ///< "C1.travel", "C1.upper_1", "R7"
  bool is_winch = false;  ///< its coordinate is a rope length
  Dimension travel = Dimension::length;
  dynamics::MotionLimits limits{};
  double lowest = 0;   ///< coordinate, m or rad
  double highest = 0;  ///< coordinate, m or rad
  double start = 0;    ///< coordinate at the start of the operation
};

/// Adds a drive or winch, unless one of its numbers is missing or of a wrong kind.
/// @param start_value where it stands at the start of the operation.
void add_mover(std::vector<Mover>& movers, std::string name, bool is_winch,
               const DriveLimits& limits, const Quantity& start_value);

/// Drives and winches of the case, in the order of cranes (drives, then hoists) and ropes. Those
/// that lack a number are left out.
std::vector<Mover> movers_of(const LiftCase& lift_case);

/// A part of the operation in time, s.
struct ScheduledStage {
  /// When a condition came about, and how the stage's moves come to a stand then.
  struct Stop {
    double met = 0;       ///< s
    double time = 0;      ///< from which on they stop: later by the reaction, s
    double duration = 0;  ///< s
  };
  std::string name;
  double start = 0;
  double end = 0;
  std::optional<double> limit = {};  ///< until which it waits for its condition; none: it has none
  std::optional<Stop> stop = {};     ///< none: not known yet
};

/// A move from rest to rest; its times count from the start of the operation.
struct ScheduledMove {
  std::size_t mover = 0;
  std::size_t stage = 0;
  dynamics::RestToRestMove move;
  Mark mark;
};

/// A drive that follows another one's moves in one stage.
struct ScheduledFollower {
  std::size_t mover = 0;
  std::size_t leader = 0;
  std::size_t stage = 0;
  dynamics::NaturalSpline own_travel_over_leaders;
  Mark mark;
};

/// A drive that is steered after a wish in one stage.
struct ScheduledSteering {
  std::size_t mover = 0;
  std::size_t stage = 0;
  dynamics::Steering steering;  ///< but for its wish
  given::Keep keep;
  std::optional<dynamics::Course> course = {};  ///< none: not known yet
  Mark mark;
};

/// What of an operation is found by running it, in the order of the operation.
struct FoundMotion {
  std::vector<double> met;                ///< when conditions that end stages came about, s
  std::vector<dynamics::Course> courses;  ///< of drives that were steered
  /// Of the fault that comes at its worst instant, s; none: it does not come.
  std::optional<double> fault = {};
};

/// When everything happens.
struct Schedule {
  std::vector<Mover> movers;
  std::vector<ScheduledStage> stages;
  std::vector<ScheduledMove> moves;
  std::vector<ScheduledFollower> followers;
  std::vector<ScheduledSteering> steerings;
  double duration = 0;  ///< with the time to settle, s
  /// The first stage with a move to a place from where a course not known yet leads; none: none.
  std::optional<std::size_t> provisional_from = {};

  /// The first stage whose condition has not come about yet, or nothing.
  std::optional<std::size_t> waiting_stage() const;
  /// The first stage with a drive whose course is not known yet, or nothing.
  std::optional<std::size_t> steered_stage() const;
  /// The last stage up to which courses can be found in one run: all before it is known but for
  /// them.
  std::size_t last_known_stage() const;
};

/// What a schedule is made of.
struct OperationPlan {
  std::string owner;  ///< "the case": whose drives they are, for messages
  std::vector<Mover> movers;
  const std::vector<given::Stage>* stages = nullptr;
  double settle = 0;  ///< after the last move, s
  /// Is it a drive that exists, but could not be read?
  std::function<bool(const std::string&)> is_incomplete;
  FoundMotion found = {};  ///< of the first conditions and steered drives
};

/// Sets the stages one after another: each begins when the one before has ended and its own pause
/// is over, and ends with the last of its moves. One that ends by a condition ends when its moves
/// have come to a stand behind the instant of it; where that is not known yet, when its moves have
/// ended and its time is up.
///
/// A drive that keeps something is steered while the stage's other moves last, or for its duration,
/// and the stage lasts until it certainly stands. Where it is then is known once its course is.
///
/// Complains about drives that do not exist, moves beyond a drive's limits or range, ropes that
/// would be pulled through their sheave, drives that are moved twice at once, and followers that
/// cannot follow. What was complained about is left out of the schedule.
Schedule schedule_operation(OperationPlan plan, Diagnostics& diagnostics);
Schedule schedule_operation(const LiftCase& lift_case, Diagnostics& diagnostics,
                            const FoundMotion& found = {});

/// Adds a schedule's stages, moves and followers, and the courses that are known; the drives and
/// winches that it moves come first.
void add_schedule(const Schedule& schedule, dynamics::OperationBuilder& builder);

}  // namespace blocklift::pipeline
