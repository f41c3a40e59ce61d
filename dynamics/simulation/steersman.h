#pragma once

#include <optional>
#include <vector>

#include "dynamics/multibody/loop_projection.h"
#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// Steers the drives of an operation that follow a wish (Steering), during one time integration.
/// Laws from outside begin with it.
/// Between two looks their motion is a known function of the time (w.steered), so that nothing of
/// it is in the right-hand side.
class Steersman {
 public:
  explicit Steersman(const LiftSystem& system);

  /// Does any drive have a look at time t (s)?
  bool looks_at(double t) const;

  /// The looks at time t: what is seen in the workspace, whose drives, positions and ropes' loads
  /// are those of t (calc_contact_loads), and how the drives go on until the next.
  /// @throws SimulationError if a law from outside gives no finite speed; whatever the law throws.
  void look(double t, LiftWorkspace& w);

  /// How each steered drive went, in the order of the operation.
  std::vector<Course> courses() const;

 private:
  struct Helm {
    Course course;
    std::size_t look_count = 0;
    SteeredMotion motion;
    std::vector<double> asked;  ///< speed that follows from what was seen, at each look
    double difference = 0.0;    ///< of KeptHeight
    SpeedLaw law;               ///< of OwnLaw
  };
  bool is_due(const Steering& steering, const Helm& helm, double t) const;
  double find_speed(const Steering& steering, Helm& helm, double t, const LiftWorkspace& w);
  double find_travel(const Steering& steering, Helm& helm, const LiftWorkspace& w);
  double find_plumb_travel(const Steering& steering, const KeptPlumb& wish, const LiftWorkspace& w);
  double find_seen(const Steering& steering, const Helm& helm, const Sight& sight, double t,
                   const LiftWorkspace& w);
  void steer(const Steering& steering, Helm& helm, double t, MotionProfile& profile,
             const LiftWorkspace& w);

  const LiftSystem& system_;
  std::vector<Helm> helms_;
  std::optional<LoopProjector> projector_;
  Kinematics kinematics_;
  Eigen::VectorXd v_;
  std::vector<double> seen_;  ///< by a law from outside
};

}  // namespace blocklift::dynamics
