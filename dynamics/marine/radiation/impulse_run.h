#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "dynamics/marine/radiation/free_surface.h"

namespace blocklift::dynamics {

/// Memory (bytes) that an ImpulseRun takes with_elevation, for numbers of unknowns (surface panels
/// times modes) and frequencies.
double elevation_bytes(double unknowns, std::size_t frequencies);

/// How long an ImpulseRun lasts: `steps`, or twice, three times ... `most` times as many: the first
/// number at which its end cuts off (ImpulseRun::cut_off) no more than `share` of any mode's force
/// on itself, B + i w A, at any frequency.
struct RunLength {
  long steps = 0;
  int most = 1;
  double share = 0.03;
};

/// What the water answers to an impulse of each mode of one part: its surface marched from the
/// elevation that the impulse leaves, and the Fourier integrals of that.
///
/// The last 40 % of the run are tapered; of one that went on more than once, what it went on by the
/// last time. The integrals take the march's own dispersion into
/// account, w_d = (2/dt) asin(w dt/2), so that they carry no error of the time step but in the
/// damping zone. The part must outlive the run.
class ImpulseRun {
 public:
  /// @param frequencies rad/s. @param with_elevation for elevation(), at the cost of much memory.
  ImpulseRun(const RankinePart& part, const SurfaceDamping& damping, const Water& water,
             std::vector<double> frequencies, bool with_elevation);

  /// Largest stable step, s.
  double step_limit() const { return march_.step_limit(); }

  /// Marches. `progress`, if any, is called with each step's number and how many there will be as
  /// far as is known.
  /// @param step s. @param beside another run that is marched side by side with this one and is as
  ///   long, to less than a step, by longer steps where these are stable and at most half a radian
  ///   of the highest frequency; null: none. @returns the number of steps of this one.
  long run(double step, const RunLength& length, ImpulseRun* beside,
           const std::function<void(long step, long steps)>& progress = {});

  /// After run(): retardation functions K of the part's modes at each step (modes() square, images
  /// included, made symmetric).
  Eigen::MatrixXd retardation(long step) const;
  /// After run(), for a frequency (index): B of the part's modes (modes() square, images
  /// included), and its share of A - A_inf.
  Eigen::MatrixXd damping(std::size_t frequency) const;
  Eigen::MatrixXd added_mass(std::size_t frequency) const;
  /// After run(), with_elevation: integral of W^1/2 eta e^{-i w t} for a frequency (index), panels
  /// x modes.
  Eigen::MatrixXcd elevation(std::size_t frequency) const;
  /// After run(), by estimate: what its end cuts off of each mode's force on itself, as |B + i w
  /// A|; modes x frequencies, images included. Runs that ended after three fifths of the steps, and
  /// after three fifths of those, would differ by D and d from this one, at most over the
  /// frequencies. What fades as exp(-r t) leaves an error of the same kind, so that (D/d)^(5/3) = q
  /// is what this run's error is of the first's; it is D q/(1 - q), and no more than D.
  const Eigen::MatrixXd& cut_off() const { return cut_off_; }

 private:
  /// The step of this run beside one that takes this step, s: no shorter.
  double step_beside(double step) const;
  void start(double step, long steps);
  /// Takes what the surface is at a step into force and integrals.
  void take_instant(long step, bool may_go_on);
  /// Integrates the force over all steps, of which there are now so many, and estimates the cut.
  void integrate_force(long steps);
  /// Keeps the force at a step.
  void keep_force();
  /// Adds an instant to the integrals of the elevation.
  void accumulate(long step);
  /// Adds the instants that wait to the integrals of the elevation.
  void add_instants();
  /// Keeps the integrals of the elevation as they are without a taper from here on; once.
  void keep_whole();
  /// Is longer by so many steps, from the integrals that were kept.
  void go_on(long steps);
  /// Nothing is kept for a longer run.
  void end();
  /// e^{-i w t} at a step, by the march's dispersion.
  std::complex<double> wave(std::size_t frequency, long step) const;
  /// Of an instant in the integrals without a taper, by the trapezoidal rule, s.
  double weight(long step) const;
  /// By how much a step counts in the taper of the whole run.
  double fade(long step) const;
  /// The force's integrals, one for each frequency, of a run that ends after so many of the steps.
  std::vector<Eigen::MatrixXcd> integrate(long steps,
                                          const std::function<double(long)>& taper_of) const;
  /// What the integrals change by from a shorter run's, as cut_off().
  Eigen::MatrixXd change_from(long steps) const;
  void estimate_cut();
  /// That amounts, as cut_off(), are of each mode's force on itself, over the frequencies.
  Eigen::VectorXd largest_shares(const Eigen::MatrixXd& amounts) const;
  /// The Fourier integral's factor that the leapfrog march asks for.
  double scale(std::size_t frequency) const;

  const RankinePart& part_;
  double density_, gravity_;
  std::vector<double> frequencies_;
  FreeSurfaceMarch march_;
  Eigen::MatrixXd force_rows_;  ///< the part's surface columns, a row each
  double step_ = not_a_number;
  long steps_ = 0;
  long gone_ = 0;  ///< steps of the run that was to be the whole before it went on
  std::vector<Eigen::MatrixXd> forces_;  ///< at each step, without taper and images
  std::vector<Eigen::MatrixXcd> force_;  ///< their integrals times e^{-i w t}, over steps_
  Eigen::MatrixXd cut_off_;
  /// Real parts of the integrals of the elevation for all frequencies, then imaginary ones: a
  /// column each, panels of the first mode first. Empty without elevation.
  Eigen::MatrixXd elevation_;
  /// The same without a taper, while the run may become longer; else empty.
  Eigen::MatrixXd whole_elevation_;
  /// The elevation at instants that wait, a column each, and what each is to be added with, a row
  /// each, with and without taper: added together they read and write the integrals once.
  Eigen::MatrixXd instants_, weights_, whole_weights_;
  Eigen::Index waiting_ = 0;
};

}  // namespace blocklift::dynamics
