#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dynamics/multibody/motion_profile.h"
#include "dynamics/rope/rope.h"

namespace blocklift::dynamics {

/// A named part of the operation, from start to end (s).
struct Stage {
  std::string name;
  double start = not_a_number;
  double end = not_a_number;
};

/// A joint velocity that follows a motion: travel since the start of the operation (m or rad).
struct JointDrive {
  std::string name;
  BodyIndex body = -1;        ///< the body that the joint carries
  int velocity_index = -1;    ///< within v
  int coordinate_index = -1;  ///< within q
  ProfileSequence travel;
};

/// A rope whose unstretched length follows a motion: length paid out since the start (m).
struct Winch {
  std::string name;
  int rope = -1;
  ProfileSequence payout;
};

/// Who moves when: the stages of the lift and the motion of every drive and winch. Immutable.
class Operation {
 public:
  /// No drive moves; everything hangs for `duration` (s).
  static Operation at_rest(double duration);

  double duration() const { return duration_; }  ///< s, from 0
  const std::vector<Stage>& stages() const { return stages_; }
  const std::vector<JointDrive>& joint_drives() const { return joint_drives_; }
  const std::vector<Winch>& winches() const { return winches_; }
  /// Times (s) at which a stage changes or a motion is not smooth: ascending, each once, from 0 to
  /// the duration, both included. Integration steps end there.
  const std::vector<double>& breakpoints() const { return breakpoints_; }

 private:
  friend class OperationBuilder;
  std::vector<Stage> stages_;
  std::vector<JointDrive> joint_drives_;
  std::vector<Winch> winches_;
  std::vector<double> breakpoints_;
  double duration_ = 0.0;
};

/// Collects stages, drives and moves and makes an operation of them.
class OperationBuilder {
 public:
  OperationBuilder(const Mechanism& mechanism, const std::vector<Rope>& ropes)
      : mechanism_(mechanism), ropes_(ropes) {}

  /// @throws ModelError if the stage does not begin at or after the last one's end, or ends before
  /// it begins.
  void add_stage(std::string name, double start, double end);

  /// Drive of entry `degree_of_freedom` of the velocities of the joint that carries `body`.
  /// @throws ModelError if the name is taken, or that velocity is not one of the driven ones, or
  /// its joint has a quaternion (spherical, free), which no single travel describes.
  void add_joint_drive(std::string name, BodyIndex body, int degree_of_freedom = 0);

  /// Winch of a rope.
  /// @throws ModelError if the name is taken, the rope unknown, or it has a winch already.
  void add_winch(std::string name, std::string_view rope);

  /// A move of a drive or winch that begins at `start` (s).
  /// @throws ModelError if there is no such drive, the move begins before 0, or it overlaps
  /// another move of the same drive.
  void add_move(std::string_view drive, double start, const MotionProfile& move);

  /// @param duration when the operation ends, s; at least the end of the last stage and move.
  /// @throws ModelError if the duration is not positive or too short, or a winch would pull its
  /// rope in entirely.
  Operation build(double duration) const;

 private:
  struct Move {
    double start;
    double end;
  };
  struct Track {
    std::string name;
    bool is_winch;
    std::size_t index;
    std::vector<Move> moves;
  };
  Track& find_track(std::string_view drive);
  void add_track(const std::string& name, bool is_winch, std::size_t index);
  std::vector<double> collect_breakpoints(double duration) const;

  const Mechanism& mechanism_;
  const std::vector<Rope>& ropes_;
  Operation operation_;
  std::vector<Track> tracks_;
};

}  // namespace blocklift::dynamics
