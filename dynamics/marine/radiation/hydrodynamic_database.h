#pragma once

#include <complex>
#include <functional>

#include "dynamics/marine/radiation/far_field.h"
#include "dynamics/marine/radiation/free_surface.h"

namespace blocklift::dynamics {

/// Linear hydrodynamics of bodies floating at rest, computed once: immutable, SI throughout.
///
/// The 6N modes are those of DegreeOfFreedom, body after body, each about its body's reference
/// point and along the world's axes. A body's motion xi (m, rad) and the force F (N, N m) of the
/// water that answers it are related by (Cummins 1962, Ogilvie 1964)
///
///   F(t) = -A_inf xi'' - integral over tau from 0 of K(tau) xi'(t - tau),
///   A(w) = A_inf - (1/w) int K sin(w t) dt,    B(w) = int K cos(w t) dt.
///
/// A regular wave of amplitude a, eta = Re a exp(i (w t - k (x cos theta + y sin theta))), exerts
/// the force Re X(w, theta) a exp(i w t).
struct HydrodynamicDatabase {
  Water water;
  std::vector<std::string> body_names;
  std::vector<Vector3> reference_points;  ///< m, in W
  std::vector<double> displaced_volumes;  ///< m3
  /// What is known of the bodies besides the flow, of use to other programs; empty: unknown.
  std::vector<Vector3> centres_of_buoyancy;  ///< m, in W
  std::vector<Vector3> centres_of_mass;      ///< m, in W
  /// C: restoring force -C xi, buoyancy and weight, 6N x 6N; N/m, N, N m.
  Eigen::MatrixXd hydrostatic_stiffness;
  Eigen::MatrixXd infinite_added_mass;          ///< A_inf, 6N x 6N; kg, kg m, kg m2
  double time_step = not_a_number;              ///< of the retardation functions, s
  std::vector<Eigen::MatrixXd> retardation;     ///< K at 0, dt, 2 dt ...; kg/s2, kg m/s2, kg m2/s2
  std::vector<double> frequencies;              ///< rad/s, ascending
  std::vector<Eigen::MatrixXd> added_mass;      ///< A(w), one for each frequency
  std::vector<Eigen::MatrixXd> damping;         ///< B(w); kg/s, kg m/s, kg m2/s
  std::vector<double> headings;                 ///< theta, rad
  std::vector<Eigen::MatrixXcd> froude_krylov;  ///< for each frequency, 6N x headings; N/m, N
  std::vector<Eigen::MatrixXcd> diffraction;    ///< of the same shape and units
  /// For each mode, how much its radiation force on itself, B + i w A, changes at most over the
  /// frequencies, the infinite among them, from panels of twice the size to these, relative
  /// (calc_radiation_error); infinite: those have no solution; empty: unknown. At first order it is
  /// the panels' error itself, at second order three times it.
  Eigen::VectorXd change_from_coarser;
  /// For each mode, how much the force of waves on it changes from panels of twice the size to
  /// these, with its phase: the largest change over frequencies and headings as a share of the
  /// largest force that any of these waves exerts on the mode, or of its mean force over all
  /// headings if that is more (calc_mean_excitation); infinite and order as above; empty: unknown.
  /// Where Froude-Krylov and diffraction all but cancel, as in roll of some sections, it is a
  /// multiple of change_from_coarser.
  Eigen::VectorXd excitation_change_from_coarser;
  /// For each mode, how much of its radiation force on itself the end of the impulse runs cuts off
  /// at most over the frequencies, relative, by estimate (ImpulseRun::cut_off); empty: there were
  /// no runs, or it is unknown.
  Eigen::VectorXd cut_off_by_end;
  /// Mean forces of second order on each body as it floats, in regular waves of unit amplitude
  /// (calc_mean_drift): 6N x headings for each frequency; N/m2, N m/m2; empty: unknown.
  std::vector<Eigen::MatrixXd> mean_drift;
  FarField far_field;  ///< empty: unknown

  int body_count() const { return static_cast<int>(body_names.size()); }
  int mode_count() const { return modes_per_body * body_count(); }
  /// X = Froude-Krylov + diffraction for a frequency (index) and all headings.
  Eigen::MatrixXcd excitation(std::size_t frequency) const {
    return froude_krylov[frequency] + diffraction[frequency];
  }
};

/// Changes whenever compute_database, or the meshing of the water's surface, gives other figures
/// for the same bodies, or tells more of them: what was computed before is then not to be taken for
/// what would be now.
inline constexpr int panel_method_version = 16;

struct DatabaseSettings {
  std::vector<double> frequencies;  ///< rad/s, positive, ascending
  std::vector<double> headings;     ///< rad
  /// Of the impulse runs, s. 0: three periods of the lowest frequency, and up to four times as long
  /// where water swings longer than that, until their end cuts off no more than 3 % of any mode's
  /// force on itself. The last 40 % are tapered.
  double duration = 0.0;
  /// Of the impulse runs; 0: as long as the surface allows, at most 0.25 rad of the highest
  /// frequency, s.
  double time_step = 0.0;
  /// 0: of damping_zone() for the lowest frequency, rad/s.
  double damping_strength = 0.0;
  std::vector<DampingLid> lids;
  /// Compute HydrodynamicDatabase::change_from_coarser, and that of the excitation if there are
  /// headings, at up to two thirds of the cost again: of the surface only what lies near the hulls
  /// becomes coarser.
  bool with_coarser = false;
  /// Compute HydrodynamicDatabase::far_field: a dense complex system for each frequency and part.
  bool with_far_field = false;
  RankineSettings rankine;
  /// Called as the computation goes on, with the share done (0 to 1) and what is being done.
  std::function<void(double, const char*)> progress;
};

/// @throws ModelError unless at least three panels go into the wave of a frequency (rad/s) wherever
/// it reaches them, a quarter of its length down; the message has the widest panel's place and
/// size.
void require_panels_for_waves(const PanelModel& model, double frequency);

/// Memory (bytes) that compute_database takes at its peak, at most; with the coarser solution and
/// the far field where they are asked for.
double database_bytes(const PanelModel& model, const DatabaseSettings& settings);

/// @throws ModelError naming everything that makes the database unusable, a line each: a number
/// that is not finite (with body, mode and frequency), a size that does not fit the bodies,
/// frequencies, or headings, no frequencies or frequencies that do not ascend, no retardation
/// functions, bodies of the same name, a constant of the water out of range.
void require_sound(const HydrodynamicDatabase& database);

/// What a computation of a database came to.
struct DatabaseReport {
  int body_panels = 0, surface_panels = 0;  ///< computed with, after symmetry
  int parts = 0;                            ///< even and odd parts
  long steps = 0;                           ///< of the impulse runs, all parts
  double peak_bytes = 0.0;                  ///< database_bytes()
  double step_limit = not_a_number;         ///< smallest of the parts, s
  RankineTiming solution;                   ///< sums over the parts
  double march_s = 0.0;
  double excitation_s = 0.0;
  double reciprocity_error = 0.0;  ///< largest of RankinePart::reciprocity_error
  double asymmetry = 0.0;          ///< of A_inf before it is made symmetric, relative
};

/// Computes the database by the time-domain Rankine panel method: for each part one impulse run
/// with all its modes at once, K(t) = rho g q . eta(t), and its Fourier integrals. These take the
/// leapfrog march's own dispersion into account, w_d = (2/dt) asin(w dt/2), so that A, B and X
/// carry no error of the time step but in the damping zone. Diffraction by Haskind's relation from
/// the radiation potentials, so that any number of headings costs next to nothing.
/// @throws ModelError if a frequency is not positive, or its wave shorter than three panels;
/// SimulationError if the memory does not suffice.
HydrodynamicDatabase compute_database(const PanelModel& model, const DatabaseSettings& settings,
                                      DatabaseReport* report = nullptr);

/// Added mass and damping at a frequency (rad/s) from A_inf and K by the relations above, with the
/// retardation functions as they are (no correction for dispersion).
/// The trapezoidal rule with its end correction: fourth order in the step.
void calc_added_mass_and_damping(const HydrodynamicDatabase& database, double frequency,
                                 Eigen::MatrixXd& added_mass, Eigen::MatrixXd& damping);

}  // namespace blocklift::dynamics
