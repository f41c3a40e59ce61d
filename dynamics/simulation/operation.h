#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/multibody/motion_profile.h"
#include "dynamics/rope/rope.h"
#include "dynamics/simulation/steering.h"

namespace blocklift::dynamics {

/// A named part of the operation, from start to end (s).
struct Stage {
  std::string name;
  double start = not_a_number;
  double end = not_a_number;
};

/// A joint that follows a motion.
///
/// Where v is dq/dt, one coordinate: q = position(t). Spherical and free joints as a whole, along a
/// fixed direction n of v: q = q0 (+) s n, v = n ds/dt, s = position(t) (see integrate_joint).
struct JointDrive {
  std::string name;
  BodyIndex body = -1;        ///< the body that the joint carries
  int velocity_index = -1;    ///< within v; of the first for a joint driven as a whole
  int coordinate_index = -1;  ///< within q; of the first for a joint driven as a whole
  MotionProfile position = MotionProfile::constant(0.0);  ///< the coordinate, or s: m or rad
  Eigen::VectorXd direction = {};  ///< n, one for each v of the joint; empty for one coordinate
  Eigen::VectorXd start = {};      ///< q0; empty for one coordinate
};

/// A rope whose unstretched length follows a motion; several at one rope share its length.
struct Winch {
  std::string name;
  int rope = -1;
  MotionProfile length = MotionProfile::constant(0.0);  ///< unstretched length left out, m
};

/// A rope that breaks. Equilibria do not know of it: they are those of the whole rigging.
struct Parting {
  int rope = -1;
  double time = not_a_number;  ///< s
};

/// Who moves when: the stages of the lift and the motion of every drive and winch. Immutable.
class Operation {
 public:
  double duration() const { return duration_; }  ///< s, from 0
  const std::vector<Stage>& stages() const { return stages_; }
  const std::vector<JointDrive>& joint_drives() const { return joint_drives_; }
  const std::vector<Winch>& winches() const { return winches_; }
  const std::vector<Parting>& partings() const { return partings_; }
  /// Drives whose motion is found on the way, by a time integration. Elsewhere they stand.
  const std::vector<Steering>& steerings() const { return steerings_; }
  /// Times (s) at which a stage changes or a motion's jerk jumps: ascending, at least a microsecond
  /// apart, from 0 to the duration, both included; looks of steered drives, too. Integration steps
  /// end there.
  const std::vector<double>& breakpoints() const { return breakpoints_; }

 private:
  friend class OperationBuilder;
  std::vector<Stage> stages_;
  std::vector<JointDrive> joint_drives_;
  std::vector<Winch> winches_;
  std::vector<Parting> partings_;
  std::vector<Steering> steerings_;
  std::vector<double> breakpoints_;
  double duration_ = 0.0;
};

/// Collects stages, drives, winches and moves and makes an operation of them. Drives and winches
/// share one set of names: moves and followers name either.
class OperationBuilder {
 public:
  /// @throws ModelError if the stage begins before the last one's end, or ends before it begins.
  void add_stage(std::string name, double start, double end);

  /// Drive of one velocity of the joint that carries `body`; its coordinate starts at `start` (m or
  /// rad) and stays there until it is moved.
  /// @throws ModelError if the name is taken, or that velocity is not declared as driven, or its
  /// joint has a quaternion (spherical, free): see add_direction_drive.
  void add_joint_drive(const Mechanism& mechanism, std::string name, BodyIndex body, double start,
                       int degree_of_freedom = 0);

  /// Drive of a whole spherical or free joint along the direction n of its v (a turn about a fixed
  /// axis, a screw): q = q0 (+) s n, s starting at 0.
  /// @throws ModelError if the name is taken, the joint is of another kind or not driven, or the
  /// sizes of q0 and n are not those of the joint.
  void add_direction_drive(const Mechanism& mechanism, std::string name, BodyIndex body,
                           const Eigen::VectorXd& q0, const Eigen::VectorXd& direction);

  /// Winch of a rope (its index in the lift), which starts with `start` m of unstretched rope out.
  /// What several winches of one rope let out adds up.
  /// @throws ModelError if the name is taken.
  void add_winch(std::string name, int rope, double start);

  /// A move of a drive or winch.
  /// @throws ModelError if there is no such drive, the move begins before 0, or it overlaps another
  /// move of the same drive.
  void add_move(std::string_view drive, const RestToRestMove& move);

  /// A joint's drive goes along a profile throughout: a table over time, a constant speed. Its
  /// start is the profile's.
  /// @throws ModelError if there is no such drive, it is a winch, or it is moved otherwise.
  void set_motion(std::string_view drive, MotionProfile motion);

  /// Integration steps end at these times (s), too: loads change their slope there.
  void add_breakpoints(const std::vector<double>& times);

  /// From `start` to `end` (s) the drive follows another: its own travel is a smooth function of
  /// the leader's travel since `start` (both zero there), like a cam. Leader's moves come first.
  /// @throws ModelError if there is no such drive or leader, the leader follows another drive
  /// itself or does not move in that time, its travel leaves the spline's range, or the drive moves
  /// otherwise in that time.
  void add_follower(std::string_view drive, std::string_view leader, double start, double end,
                    const NaturalSpline& own_travel_over_leaders);

  /// The drive is steered after a wish, from the steering's start until it stands again. What the
  /// builder sets of the steering need not be given.
  /// @throws ModelError if there is no such drive, it goes along a direction or moves otherwise in
  /// that time, the wish is not one for it (a winch keeps heights and tensions, of its own rope; a
  /// joint's drive a plumb), or a number of the steering is not sound.
  void add_steering(std::string_view drive, Steering steering);

  /// The drive goes along a course, as it was found for a steering, until it stands at `stand` (s).
  /// Moves that are stopped (stop_moves) must have been before.
  /// @throws ModelError if there is no such drive, or it moves otherwise in that time.
  void add_course(std::string_view drive, Course course, double stand);

  /// Whatever the drive does, from `time` (s) on it comes to a stand within `duration` (s) and
  /// stays there: an emergency stop, or a drive that sticks (MotionProfile::stopped).
  /// @throws ModelError if there is no such drive, it is stopped already, the time is negative or
  /// the duration not positive.
  void add_stop(std::string_view drive, double time, double duration);

  /// A winch runs away: its own motion comes to a stand within `ramp` (s) from `time` (s) on, and
  /// it pays out at `speed` (m/s) instead, which it reaches in `ramp`, until it is caught after
  /// `duration` (s) and stands within `ramp`. There it stays.
  /// @throws ModelError if there is no such winch, it is stopped already, the time is negative or
  /// another number not positive.
  void add_runaway(std::string_view winch, double time, double duration, double speed, double ramp);

  /// Moves and followers that begin at `from` (s) or later, of those added so far, come to a stand
  /// between `time` (s) and `duration` (s) later (MotionProfile::stopped): all by one clock, so
  /// that followers keep to their leaders. What would begin after that does not. Moves that are
  /// added afterwards go on from there.
  /// @throws ModelError if the duration is not positive.
  void stop_moves(double from, double time, double duration);

  /// A rope (its index in the lift) parts at a time (s).
  /// @throws ModelError if the time is negative or the rope parts already.
  void add_parting(int rope, double time);

  /// When the last stage or move ends, s.
  double end() const;

  /// @param duration when the operation ends, s; at least end().
  /// @throws ModelError if the duration is not positive or too short, or a winch would pull its
  /// rope in entirely.
  Operation build(double duration) const;

 private:
  struct Interval {
    double start;
    double end;
  };
  struct Follower {
    MotionProfile travel;
    Interval interval;
  };
  /// One drive or winch on its way to a profile.
  struct Track {
    std::string name;
    bool is_winch;
    std::size_t index;
    double start_value;
    std::vector<RestToRestMove> moves;
    std::vector<Follower> followers;
    std::optional<MotionProfile> motion;         ///< in place of start, moves and followers
    std::optional<Interval> stop = {};           ///< within which all that comes to a stand
    std::optional<RestToRestMove> runaway = {};  ///< besides, from the stop on
    std::vector<Follower> stopped = {};  ///< moves and followers that were stopped on their way
  };
  Track& find_track(std::string_view drive);
  void add_track(const std::string& name, bool is_winch, std::size_t index, double start);
  void check_free(const Track& track, Interval wanted) const;
  MotionProfile make_profile(const Track& track) const;
  static MotionProfile make_undisturbed_profile(const Track& track);
  std::vector<double> collect_breakpoints(const Operation& operation) const;

  Operation operation_;
  std::vector<Track> tracks_;
  std::vector<double> more_breakpoints_;
};

}  // namespace blocklift::dynamics
