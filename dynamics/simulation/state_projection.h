#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/multibody/loop_projection.h"
#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// Brings the states of a lift back to where they belong: quaternions to unit length, and where the
/// mechanism has loops, positions and velocities onto them; and takes out of the error of a step
/// what leads away from there. Which equations of the loops are independent is judged at each state
/// anew (w.loop_rows). Workspaces are made once.
class StateProjection {
 public:
  /// Where there are loops, assembles q and v of the workspace first, driven as at time t (s).
  /// @throws SimulationError if the loops cannot be closed.
  StateProjection(const LiftSystem& system, LiftWorkspace& w, double t = 0.0);

  /// Is there anything to be projected?
  bool is_needed() const { return projector_.has_value() || !quaternions_.empty(); }
  /// First entries of the quaternions within a state.
  const std::vector<Eigen::Index>& quaternions() const { return quaternions_; }
  /// Do loops and drives leave nothing free, at the last projection?
  bool leaves_nothing_free() const;

  /// The state (state_size) back to where it belongs at time t, in place.
  /// @throws SimulationError if the loops cannot be closed near by: what they miss.
  void project(double t, VectorRef y, LiftWorkspace& w);
  /// What `project` would add to the state. False: a quaternion is none.
  /// @throws SimulationError as project.
  bool calc_correction(double t, ConstVectorRef y, VectorRef correction, LiftWorkspace& w);
  /// Takes out of an error of the state y what calc_correction would take away again, at its last
  /// call.
  void project_error(ConstVectorRef y, VectorRef error, const LiftWorkspace& w);

 private:
  void find_quaternions();
  void project_onto_loops(double t, ConstVectorRef y, VectorRef projected, LiftWorkspace& w);
  void remove_what_opens_loops(VectorRef error, const LiftWorkspace& w);
  std::string describe_failure() const;

  const LiftSystem& system_;
  std::vector<Eigen::Index> quaternions_;
  // Where the mechanism has loops.
  std::optional<LoopProjector> projector_;
  Eigen::VectorXd projected_;                      ///< state
  Eigen::VectorXd error_q_, error_v_, increment_;  ///< nq, nv, nv
};

}  // namespace blocklift::dynamics
