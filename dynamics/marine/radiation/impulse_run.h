#pragma once

#include <functional>
#include <vector>

#include "dynamics/marine/radiation/free_surface.h"

namespace blocklift::dynamics {

/// What the water answers to an impulse of each mode of one part: its surface marched from the
/// elevation that the impulse leaves, and the Fourier integrals of that.
///
/// The last 40 % of the run are tapered. The integrals take the march's own dispersion into
/// account, w_d = (2/dt) asin(w dt/2), so that they carry no error of the time step but in the
/// damping zone. The part must outlive the run.
class ImpulseRun {
 public:
  /// @param frequencies rad/s.
  ImpulseRun(const RankinePart& part, const SurfaceDamping& damping, const Water& water,
             std::vector<double> frequencies);

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
  /// After run(): integral of W^1/2 eta e^{-i w t} for a frequency (index), panels x modes.
  Eigen::MatrixXcd elevation(std::size_t frequency) const;

 private:
  void accumulate(double time, double weight);
  /// The Fourier integral's factor that the leapfrog march asks for.
  double scale(std::size_t frequency) const;

  const RankinePart& part_;
  double density_, gravity_;
  std::vector<double> frequencies_;
  FreeSurfaceMarch march_;
  double step_ = not_a_number;
  std::vector<Eigen::MatrixXd> cosine_, sine_;
};

}  // namespace blocklift::dynamics
