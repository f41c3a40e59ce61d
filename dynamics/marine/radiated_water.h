#pragma once

#include <memory>
#include <vector>

#include "dynamics/marine/memory_state_space.h"
#include "dynamics/multibody/added_inertia.h"

namespace blocklift::dynamics {

/// The water that the motion of floating bodies radiates, as part of a mechanism: Cummins' equation
///
///   F = -A_inf du/dt - int K(tau) u(t - tau) d tau,
///
/// u being the spatial velocities of the frames H in their own axes (AddedInertia). H coincides, when
/// its body lies as the database has it, with the reference point and the axes of the database's
/// world, and moves with the body: what the database holds for small motions about a rest is so carried
/// along by a vessel that is towed or turned. Bodies of one database influence each other as if their
/// distance had not changed.
///
/// A_inf acts implicitly, on the left-hand side; the memory is a linear system of states x with
/// F = -C x and x' = A x + B u (MemoryStateSpace), its states scaled so that each is of the order of
/// the velocity that drives it. It needs no history and takes any step. Immutable.
class RadiatedWater {
 public:
  struct Definition {
    /// One for each body of the database, in its order.
    std::vector<BodyFrame> frames;
    std::shared_ptr<const HydrodynamicDatabase> database;
    double memory_tolerance = 0.01;  ///< of MemoryStateSpace
    int most_states = 400;
  };

  /// @throws ModelError if the bodies are not as many as the database's, or as AddedInertia and
  ///   MemoryStateSpace.
  explicit RadiatedWater(const Definition& definition);

  /// Water whose memory is marched beside the integration (IntegrationSettings::surface): no states.
  /// `infinite_added_mass` is 6N x 6N in the order of the modes (DegreeOfFreedom).
  /// @throws ModelError as AddedInertia.
  RadiatedWater(std::vector<BodyFrame> frames, const Eigen::MatrixXd& infinite_added_mass);

  const AddedInertia& inertia() const { return inertia_; }
  const std::vector<BodyFrame>& frames() const { return inertia_.frames(); }
  /// Number of states x.
  Eigen::Index state_count() const { return decay_.size(); }
  /// Error of the fitted memory, in the measure of MemoryStateSpace.
  double memory_error() const { return memory_error_; }

  const Eigen::MatrixXd& input() const { return input_; }    ///< B
  const Eigen::MatrixXd& output() const { return output_; }  ///< C

  /// x' from x and u. Does not allocate.
  void calc_rate(ConstVectorRef x, ConstVectorRef u, VectorRef rate) const;
  /// Memory force on the frames (moment; force; 6N) from x. Does not allocate.
  void calc_force(ConstVectorRef x, VectorRef force) const { force.noalias() = -(output_ * x); }
  /// x <- (1 - gamma A)^-1 x, column by column. Does not allocate.
  void solve(double gamma, Eigen::Ref<Eigen::MatrixXd> x) const;

 private:
  RadiatedWater(const Definition& definition, const MemoryStateSpace& memory);
  void scale_states();

  AddedInertia inertia_;
  double memory_error_;
  // A is block-diagonal: [decay], or [decay, turn; -turn, decay] where turn is not zero.
  Eigen::VectorXd decay_, turn_;
  Eigen::MatrixXd input_, output_;
};

/// Index within (angular; linear), body after body, of a mode of the database (DegreeOfFreedom).
inline Eigen::Index place_of_mode(Eigen::Index mode) {
  return modes_per_body * (mode / modes_per_body) + (mode % modes_per_body + 3) % modes_per_body;
}

}  // namespace blocklift::dynamics
