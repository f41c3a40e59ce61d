#pragma once

#include <array>

#include "dynamics/marine/radiation/radiation.h"
#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// Marches the water's surface (DirectRadiation) beside the integration of a lift, by steps of one
/// length, whatever steps the integration takes.
///
/// During a step from t_n to t_n+1 the bodies feel a force that is known beforehand: the cubic that
/// goes on from the value and slope at which the last one ended, to the value and slope at t_n+1 of
/// the parabola through the forces at t_n, t_n-1, t_n-2. At its end the surface advances with the
/// mean of the velocities at both ends, and the true force there joins the parabola. The force is
/// smooth in time, its error of third order in the step, that of the surface of second order. Added
/// mass is no part of it: that acts at once, on the left-hand side, so that the way round is stable
/// however large it is.
///
/// Velocities and forces are those of small motions about the rest, each body's in the level axes
/// of its own frame H of RadiatedWater (level_axes.h): the surface is carried along and turned with
/// the bodies, its waves with it, which is right where they go and turn slowly against the waves'
/// own way. Where their headings differ they influence each other as if they did not, as with a
/// database. The sea's waves are met at the mean place of the frames under the mean of their
/// headings.
class MarchedSurface {
 public:
  /// Starts at the time 0, in calm water, with the workspace's state.
  /// @throws ModelError if the system's water does not fit the surface, or the step is too long for
  /// it.
  MarchedSurface(DirectRadiation& radiation, double step, const LiftSystem& system,
                 LiftWorkspace& w);

  /// End of the present step, s.
  double next() const { return static_cast<double>(steps_ + 1) * step_; }
  /// Ends the step with the state of the workspace, whose kinematics are those of its end, and
  /// writes the force of the next one into it.
  void advance(LiftWorkspace& w);

 private:
  Eigen::VectorXd velocity_of(LiftWorkspace& w) const;
  /// Takes the surface to the mean place and heading of the frames.
  void carry(const LiftWorkspace& w);
  Eigen::VectorXd force() const;
  void prepare_force(LiftWorkspace& w) const;

  DirectRadiation& radiation_;
  const RadiatedWater& water_;
  double step_;
  long steps_ = 0;
  Eigen::VectorXd velocity_;  ///< 6N, in the order of the modes
  std::array<Eigen::VectorXd, 3>
      past_;  ///< forces at t_n, t_n-1, t_n-2, in the order (moment; force)
};

/// The step by which a surface is marched for waves of frequencies up to `highest` (rad/s): a
/// twenty-fifth of their period, or nine tenths of what the panels allow if that is less, s.
double marching_step(const DirectRadiation& radiation, double highest);

}  // namespace blocklift::dynamics
