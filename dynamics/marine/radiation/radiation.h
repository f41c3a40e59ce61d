#pragma once

#include <map>
#include <memory>
#include <optional>

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// Memory force of Cummins' equation by convolution with the velocity's own history:
///
///   F(t) = - integral over tau from 0 to t - t_start of K(tau) v(t - tau),    at rest before
///     t_start.
///
/// The history is interpolated by cubic Hermite polynomials between whatever instants were
/// recorded, K by cubic polynomials between its own; the integral is taken cell by cell of K
/// (Gauss, three points). The result therefore does not depend on the simulation's step but by the
/// fourth order of the interpolation. Source: Cummins (1962).
class MemoryConvolution {
 public:
  explicit MemoryConvolution(const HydrodynamicDatabase& database);

  int mode_count() const { return static_cast<int>(kernel_.rows()); }
  /// How far back the force looks, s.
  double memory() const { return memory_; }

  /// Forgets everything; motion starts with this velocity (6N) at this time (s).
  void start(double time, const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration);
  /// Adds an accepted instant behind the last one, and forgets what is out of memory.
  /// @throws ModelError if the time does not follow the last.
  void record(double time, const Eigen::VectorXd& velocity, const Eigen::VectorXd& acceleration);
  /// Force (6N; N, N m) at a time not before the last recorded, with the velocity there.
  void calc_force(double time, const Eigen::VectorXd& velocity, Eigen::VectorXd& force) const;

 private:
  struct Instant {
    double time;
    Eigen::VectorXd velocity, acceleration;
  };
  void add_cell(double time, double from, double to, const Eigen::VectorXd& velocity,
                std::size_t& instant, Eigen::VectorXd& force) const;
  void interpolate(double time, double now, const Eigen::VectorXd& velocity_now,
                   std::size_t& instant) const;
  void interpolate_kernel(double lag) const;

  double step_, memory_;
  std::vector<Eigen::MatrixXd> samples_;
  std::vector<Eigen::MatrixXd> gauss_;  ///< K at three points of each cell, in order
  std::vector<Instant> history_;
  mutable Eigen::MatrixXd kernel_;  ///< workspace
  mutable Eigen::VectorXd value_;   ///< workspace
};

/// A regular wave with its amplitude: eta = Re a exp(i (w t - k.x)).
struct RegularWave {
  double frequency = not_a_number;         ///< rad/s
  double heading = 0.0;                    ///< rad
  std::complex<double> amplitude = {1.0};  ///< m
};

/// Radiation and diffraction without a database: the free surface is marched with the bodies, as
/// the paper does (its equations 20-30). Steps of one fixed length; at each instant the force
/// follows from the surface, the acceleration from the force (added mass on the left), and the
/// velocity half a step on drives the surface.
///
/// Waves are met where the bodies lie and as they are turned (carry): what they scatter is computed
/// for turns of a fine grid, each when it is first come to, and is linear between two of them.
class DirectRadiation {
 public:
  struct Settings {
    double damping_strength = not_a_number;  ///< nu at the edge of the surface, rad/s
    std::vector<DampingLid> lids;
    std::vector<RegularWave> waves;  ///< that the bodies diffract
    bool with_froude_krylov = true;  ///< exert their own pressure as well
    /// How the waves grow; none: over the first two periods of the longest.
    std::optional<WaveRamp> ramp;
    /// Of the panels' world in that of the mechanism, which has the same axes, m. The waves' phases
    /// are taken at it.
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();
    RankineSettings rankine;
  };
  DirectRadiation(const PanelModel& model, const Settings& settings);

  /// A_inf, 6N x 6N, symmetric.
  const Eigen::MatrixXd& infinite_added_mass() const { return infinite_added_mass_; }
  double step_limit() const;

  /// Calm water at the time 0, to be marched by this step (s).
  void start(double step);
  double time() const { return time_; }
  /// Force (6N) on the bodies now but for -A_inf times their acceleration: memory of the surface,
  /// and with waves diffraction and, if asked, Froude-Krylov.
  Eigen::VectorXd calc_force() const;
  /// One step, with the bodies' velocity (6N) at its middle.
  void advance(const Eigen::VectorXd& velocity);
  /// The bodies, and the surface with them, lie elsewhere now: the mean of their reference points
  /// at `place` (m, in the mechanism's world), all of them turned by `turn` (rad, from +x towards
  /// +y) against the panels. They meet the waves there. Velocities and forces are those in axes
  /// that are turned with the bodies.
  void carry(const Eigen::Vector2d& place, double turn);

 private:
  /// What waves do to a part at one turn of the bodies: a column for each wave, of unit amplitude
  /// and no phase at the mean of the reference points.
  struct WaveColumns {
    Eigen::MatrixXcd supply;     ///< W^1/2 q of the wave's normal velocity
    Eigen::MatrixXcd force;      ///< Froude-Krylov
    Eigen::MatrixXcd potential;  ///< rho n W Phi of the scattered wave: its force needs d/dt
  };
  struct Part {
    RankinePart rankine;
    FreeSurfaceMarch march;
    double force_factor;               ///< rho g times the number of images
    std::map<int, WaveColumns> waves;  ///< by turn of the grid
  };
  /// The turn as a place between two of the grid.
  struct Turn {
    int before = 0, after = 0;
    double share = 0.0;  ///< of the one after
  };
  void prepare_grid(const PanelModel& model);
  WaveColumns make_columns(const RankinePart& part, int turn) const;
  /// Computes the columns of both turns, and forgets those that lie furthest if there are many.
  void keep_columns();
  /// Re of the columns between the turns times the values.
  Eigen::VectorXd sum(const Part& part, Eigen::MatrixXcd WaveColumns::*columns,
                      const Eigen::VectorXcd& values) const;
  /// Amplitudes of the waves at a time, ramp included, and their rates.
  Eigen::VectorXcd amplitudes(double time) const;
  Eigen::VectorXcd amplitude_rates(double time) const;

  std::vector<Part> parts_;
  std::vector<RegularWave> waves_;
  std::vector<Eigen::Vector2d> wave_vector_;  ///< rad/m
  WaveRamp ramp_;
  bool with_froude_krylov_ = true;
  std::shared_ptr<const PanelModel> model_;  ///< where there are waves
  Eigen::Vector2d origin_;
  Vector3 mean_reference_ = Vector3::Zero();       ///< of the bodies, level, among the panels, m
  Eigen::Vector2d way_ = Eigen::Vector2d::Zero();  ///< to where it lies, from the origin, m
  int turn_count_ = 1;                             ///< of the grid, in a whole turn
  Turn turn_;
  Eigen::MatrixXd infinite_added_mass_;
  double step_ = not_a_number, time_ = 0.0;
};

}  // namespace blocklift::dynamics
