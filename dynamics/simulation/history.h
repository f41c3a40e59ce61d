#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// What a history holds of each sample, besides the time, ropes' tensions, elongations and lengths,
/// and what pads bear. What is left out is not computed either, where nothing else needs it, and
/// its arrays are empty. The rest is the same bit for bit.
struct Recording {
  bool motion = true;         ///< poses and velocities: of bodies, elastic modes, driven joints
  bool rope_forces = true;    ///< of ropes on their ends and on edges
  bool accelerations = true;  ///< and forces: loads on bodies, of drives and loops
  bool energy = true;         ///< kinetic and stored

  /// Does it take accelerations and the loads of all force elements?
  bool takes_dynamics() const { return accelerations || energy; }
  /// Positions, velocities and what ropes and pads bear at them.
  static Recording tensions() { return {false, false, false, false}; }
};

/// What is known of a body at each sample; a row a sample.
struct BodyHistory {
  using Rows7 = Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>;
  using Rows6 = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
  std::string name;
  Rows7 pose;          ///< p_WBo (m), quaternion of R_WB (w, x, y, z), its sign without jumps
  Rows6 velocity;      ///< angular velocity (rad/s), velocity of Bo (m/s), in W
  Rows6 acceleration;  ///< angular acceleration (rad/s2), acceleration of Bo (m/s2), in W
  /// Of ropes, supports, force elements, loops and radiated water: moment about Bo (N m), force
  /// (N), in W; not what the water that moves along asks for.
  Rows6 load;

  Pose X_WB(Eigen::Index sample) const;
  MotionVector V_WB(Eigen::Index sample) const {
    return {velocity.row(sample).head<3>(), velocity.row(sample).tail<3>()};
  }
  MotionVector A_WB(Eigen::Index sample) const {
    return {acceleration.row(sample).head<3>(), acceleration.row(sample).tail<3>()};
  }
};

/// What a rope does at an edge of a body, at each sample.
struct EdgeHistory {
  using Rows3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  std::string name;      ///< of the edge
  Rows3 force;           ///< on the edge's body, in W, N
  Eigen::VectorXd wrap;  ///< by which the rope turns about the edge, rad; 0 where it does not touch
  /// Where it comes and leaves, not numbers where it does not touch: angles about the axis from the
  /// side outside (EdgeTouch), rad; places along the axis from its begin, m.
  Eigen::VectorXd first_angle, last_angle, first_place, last_place;
  /// Of the spans before and behind it, N: with friction at the edge they may differ. Zero where it
  /// does not touch.
  Eigen::VectorXd first_tension, last_tension;

  bool touches(Eigen::Index sample) const { return wrap[sample] > 0.0; }
};

/// What is known of an elastic mode at each sample.
struct ElasticModeHistory {
  std::string name;
  Eigen::VectorXd coordinate;    ///< eta, m
  Eigen::VectorXd rate;          ///< m/s
  Eigen::VectorXd acceleration;  ///< m/s2
};

/// What is known of a rope at each sample.
struct RopeHistory {
  using Rows3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  std::string name;
  Eigen::VectorXd tension;     ///< N; with friction the largest of its spans
  Eigen::VectorXd elongation;  ///< stretched less unstretched length, m; negative when slack
  Eigen::VectorXd unstretched_length;   ///< m
  Eigen::VectorXd unstretched_rate;     ///< m/s
  Rows3 first_force;                    ///< on the body at the rope's first point, in W, N
  Rows3 last_force;                     ///< on the body at the rope's last point, in W, N
  std::vector<EdgeHistory> edges = {};  ///< that it may touch, in the order of its definition
};

/// What is known of a driven joint velocity at each sample.
struct DriveHistory {
  std::string name;  ///< of the operation's drive, or of the joint where it has none
  Eigen::VectorXd
      position;  ///< coordinate of the joint, m or rad; NaN for joints with a quaternion
  Eigen::VectorXd velocity;  ///< m/s or rad/s
  Eigen::VectorXd force;     ///< that the drive must give, N or N m
};

/// What is known of a support pad at each sample.
struct SupportHistory {
  std::string name;
  Eigen::VectorXd normal_force;  ///< upwards on the body, N
};

/// What is known of a loop at each sample.
struct LoopHistory {
  std::string name;
  BodyHistory::Rows6
      force;  ///< on the second body at its loop frame: moment (N m), force (N), in W
  Eigen::MatrixXd multipliers;  ///< samples x rows of the loop, N or N m (see LoopState)
  Eigen::VectorXd residual;     ///< largest among its rows, m or rad
};

/// Energies at each sample. The works are sums since the start and exist for time integrations
/// only; then  E(t) - E(0) = drive_work + winch_work + outside_work - dissipated,
/// E = kinetic + gravity + elastic (J).
struct EnergyHistory {
  Eigen::VectorXd kinetic, gravity, elastic;
  Eigen::VectorXd drive_work, winch_work;
  Eigen::VectorXd outside_work;  ///< of wind, waves and radiated waves
  Eigen::VectorXd dissipated;
};

/// Record of an operation at samples in time: static (a sweep of equilibria, rates zero) or
/// dynamic (a time integration). Bodies, elastic modes, ropes, drives and pads in the order of the
/// system; the world is body 0 in the system and is left out here, so that bodies[i - 1] is body i.
class History {
 public:
  /// @param with_works of a time integration; only with the energies of `recording`.
  History(const LiftSystem& system, Eigen::Index sample_count, bool with_works,
          const Recording& recording = {});

  Eigen::Index sample_count() const { return time.size(); }

  Eigen::VectorXd time;  ///< s
  std::vector<BodyHistory> bodies;
  std::vector<ElasticModeHistory> elastic_modes;
  std::vector<RopeHistory> ropes;
  std::vector<DriveHistory> drives;
  std::vector<SupportHistory> supports;
  std::vector<LoopHistory> loops;
  EnergyHistory energy;

  /// For set-up and evaluation afterwards.
  /// @throws ModelError if there is none of that name; the message lists those that exist.
  const BodyHistory& body(std::string_view name) const;
  const ElasticModeHistory& elastic_mode(std::string_view name) const;
  const RopeHistory& rope(std::string_view name) const;
  const LoopHistory& loop(std::string_view name) const;

  const Recording& recording() const { return recording_; }

  /// Records the instant that the workspace holds: kinematics, loads of ropes and pads, and, where
  /// the recording takes them, all loads and accelerations (w.vdot).
  void record(const LiftSystem& system, Eigen::Index sample, double t, LiftWorkspace& w);
  /// Energies done since the start, J, in the order of EnergyRates, at a sample that has been
  /// recorded.
  void record_works(Eigen::Index sample, const Eigen::Vector4d& works);

 private:
  void add_water_inertia(const RadiatedWater& water, const LiftWorkspace& w);
  void record_motion(const LiftSystem& system, Eigen::Index sample, const LiftWorkspace& w);
  void record_ropes(Eigen::Index sample, const LiftWorkspace& w);
  void record_rope_forces(const LiftSystem& system, Eigen::Index sample, LiftWorkspace& w);
  void record_accelerations(const LiftSystem& system, Eigen::Index sample, const LiftWorkspace& w);
  void record_energy(const LiftSystem& system, Eigen::Index sample, double t,
                     const LiftWorkspace& w);
  static void record_edges(const RopePath& path, const RopeLoad& load, const RopeSplit& split,
                           Eigen::Index sample, RopeHistory& rope);
  void record_loops(const LiftSystem& system, Eigen::Index sample, const LiftWorkspace& w);

  Recording recording_;
  Eigen::VectorXd buoyancy_in_waves_;  ///< of StoredEnergy, at each sample, J

  // Workspaces.
  std::vector<MotionVector> A_WB_;
  std::vector<ForceVector> F_Bo_W_;
  Eigen::VectorXd tau_;
  Eigen::VectorXd water_momentum_, water_force_;
};

/// A rope's largest load with every other rope's load at that instant (linked statistics).
struct LinkedMaximum {
  int rope = -1;
  double tension = not_a_number;  ///< N
  double time = not_a_number;     ///< s
  Eigen::Index sample = -1;
  Eigen::VectorXd tensions;  ///< of all ropes at that instant, N
};

/// For each rope its largest tension among the samples.
std::vector<LinkedMaximum> find_largest_tensions(const History& history);

}  // namespace blocklift::dynamics
