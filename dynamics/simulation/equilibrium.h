#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "dynamics/simulation/held_heading.h"
#include "dynamics/simulation/history.h"

namespace blocklift::dynamics {

struct EquilibriumSettings {
  /// Largest residual force over the weight that it stands against (see EquilibriumSolver).
  double tolerance = 1e-10;
  int largest_iterations = 60;     ///< of Newton's method (KINSOL) for one set of taut ropes
  int largest_relaxations = 2000;  ///< steps of the descent from a rough guess
  int largest_subdivisions = 10;   ///< halvings of the way between two points of a sweep
  std::optional<HeldHeading> held_heading = {};  ///< none: all moments balance
};

/// Finds where a lift hangs at rest with drives and winches held as they are at a time, mean wind
/// blowing and no motion.
///
/// Unknowns are increments of the free degrees of freedom on the manifold of poses; the equations
/// are their generalised forces. Newton's method with line search (KINSOL) runs with a fixed set of
/// taut ropes, tugger lines and loaded pads, where the equations are smooth; it is then corrected
/// and the solution repeated until it agrees with itself. Neutral directions stay about where they
/// are; a heading that nothing but wind turns is to be held (EquilibriumSettings::held_heading).
/// From a rough guess, where ropes may hang slack, a descent over the mass
/// matrix comes first:  (K + M/h^2) du = f  with growing h. Where loops tie joints together the
/// unknowns are the motions that they leave free, q being brought onto the loops at each trial;
/// what the loops bear goes into their multipliers, the least that balance. Forces are scaled by
/// weight: m g for a displacement, m g times the radius of gyration for a turn.
class EquilibriumSolver {
 public:
  explicit EquilibriumSolver(const LiftSystem& system, EquilibriumSettings settings = {});
  ~EquilibriumSolver();
  EquilibriumSolver(EquilibriumSolver&&) noexcept;

  /// Equilibrium at a time from a rough guess (q, nq). Result in q.
  /// @throws SimulationError when none is found: time, slack and most loaded ropes, bodies with the
  /// largest residual, and what to try.
  void solve(double t, Eigen::VectorXd& q);

  /// Equilibrium at a time near that of `t_from`, where q is one: no relaxation; the way is halved
  /// where it is too long.
  void follow(double t_from, double t, Eigen::VectorXd& q);

  /// Workspace with the last solution's kinematics, loads and zero accelerations.
  LiftWorkspace& workspace();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The operation as a sequence of equilibria at the given ascending times (s).
/// @param q_start a guess (nq) for the first; see EquilibriumSolver.
/// @param progress called with the fraction done and the time, may be empty.
/// @param observe called with each sample's number, its time and the solver's workspace of that
/// instant, may be empty.
/// @param recording of each equilibrium.
History static_sweep(const LiftSystem& system, const Eigen::VectorXd& times,
                     const Eigen::VectorXd& q_start, const EquilibriumSettings& settings = {},
                     const std::function<void(double, double)>& progress = {},
                     const std::function<void(Eigen::Index, double, LiftWorkspace&)>& observe = {},
                     const Recording& recording = {});

/// Times 0, interval, 2 interval ... duration, the duration itself always last.
Eigen::VectorXd sample_times(double duration, double interval);

}  // namespace blocklift::dynamics
