#pragma once

#include <functional>
#include <vector>

#include "dynamics/marine/radiation/free_surface.h"

namespace blocklift::dynamics {

/// Memory (bytes) that an ImpulseRun takes with_elevation, for numbers of unknowns (surface panels
/// times modes) and frequencies.
double elevation_bytes(double unknowns, std::size_t frequencies);

/// What the water answers to an impulse of each mode of one part: its surface marched from the
/// elevation that the impulse leaves, and the Fourier integrals of that.
///
/// The last 40 % of the run are tapered. The integrals take the march's own dispersion into
/// account, w_d = (2/dt) asin(w dt/2), so that they carry no error of the time step but in the
/// damping zone. The part must outlive the run.
class ImpulseRun {
 public:
  /// @param frequencies rad/s. @param with_elevation for elevation(), at the cost of much memory.
  ImpulseRun(const RankinePart& part, const SurfaceDamping& damping, const Water& water,
             std::vector<double> frequencies, bool with_elevation);

  /// Largest stable step, s.
  double step_limit() const { return march_.step_limit(); }

  /// Marches. `receive` is called with each step's number and the retardation functions K of the
  /// part's modes then (modes() square, images included, made symmetric).
  using Receiver = std::function<void(long step, const Eigen::MatrixXd& retardation)>;
  /// @param step s. @param steps their number.
  void run(double step, long steps, const Receiver& receive);

  /// After run(), for a frequency (index): B of the part's modes (modes() square, images
  /// included), and its share of A - A_inf.
  Eigen::MatrixXd damping(std::size_t frequency) const;
  Eigen::MatrixXd added_mass(std::size_t frequency) const;
  /// After run(), with_elevation: integral of W^1/2 eta e^{-i w t} for a frequency (index), panels
  /// x modes.
  Eigen::MatrixXcd elevation(std::size_t frequency) const;

 private:
  /// Adds an instant to the integrals.
  /// @param force what the elevation presses on the modes with, without image_count().
  void accumulate(long step, double weight, const Eigen::MatrixXd& force);
  /// Adds the instants that wait to the integrals of the elevation.
  void add_instants();
  /// The Fourier integral's factor that the leapfrog march asks for.
  double scale(std::size_t frequency) const;

  const RankinePart& part_;
  double density_, gravity_;
  std::vector<double> frequencies_;
  FreeSurfaceMarch march_;
  double step_ = not_a_number;
  std::vector<Eigen::MatrixXcd> force_;  ///< integral of the force e^{-i w t}
  /// Real parts of the integrals of the elevation for all frequencies, then imaginary ones: a
  /// column each, panels of the first mode first. Empty without elevation.
  Eigen::MatrixXd elevation_;
  /// The elevation at instants that wait, a column each, and what each is to be added with, a row
  /// each: added together they read and write elevation_ once.
  Eigen::MatrixXd instants_, weights_;
  Eigen::Index waiting_ = 0;
};

}  // namespace blocklift::dynamics
