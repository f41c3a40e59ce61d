#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// The memory of the water as a linear system with a few states, fitted to the retardation
/// functions:
///
///   x' = A x + B v,   F = -C x,      K(t) = C exp(A t) B,
///
/// an ordinary differential equation that any integrator takes with any step. The poles are common
/// to all modes that couple; each real pole has one state and each complex pair two, A being
/// block-diagonal. All poles decay. Found from the samples of K by the eigensystem realisation
/// algorithm: the block Hankel matrix of K(i + j), of all samples, is symmetric, its leading
/// eigenvectors are the states. Modes that do not couple, to a thousandth of their peaks, are
/// fitted apart, and so are two bodies that mirror each other, by what they do alike and against
/// each other. The number of states is the least that meets the tolerance. The integral of K, the
/// damping of a steady velocity, is that of the samples (their trapezoidal sum) where the tolerance
/// allows. Sources: Kung (1978); Kristiansen, Hjulstad and Egeland (2005), Ocean Engineering 32,
/// for Cummins' equation.
class MemoryStateSpace {
 public:
  /// `tolerance`: largest error of any K_ij over the root of the peaks of K_ii and K_jj, each taken
  /// as at least a thousandth of the strongest displacement's (or rotation's).
  /// `acceptable`: a larger error that is put up with where the states do not suffice for the
  /// tolerance.
  /// @throws ModelError if the database holds fewer than 16 samples, or no number of states up to
  /// `most_states` meets either: what was reached.
  explicit MemoryStateSpace(const HydrodynamicDatabase& database, double tolerance = 0.01,
                            int most_states = 400, double acceptable = 0.0);

  /// One that was fitted before, from what it is kept as.
  /// @param decay diagonal of A, 1/s.
  /// @param turn entry of A right of the diagonal, 1/s: zero but in the first row of a pair.
  /// @param B, C, error as below.
  /// @throws ModelError if the sizes do not fit each other, a number is not finite, a pole does not
  ///   decay, or pairs overlap.
  MemoryStateSpace(const Eigen::VectorXd& decay, const Eigen::VectorXd& turn, Eigen::MatrixXd B,
                   Eigen::MatrixXd C, double error);

  int state_count() const { return static_cast<int>(A_.rows()); }
  int mode_count() const { return static_cast<int>(B_.cols()); }
  /// What the fit came to, in the measure of the tolerance.
  double error() const { return error_; }

  const Eigen::MatrixXd& A() const { return A_; }  ///< 1/s
  Eigen::VectorXd decay() const { return A_.diagonal(); }
  Eigen::VectorXd turn() const;
  const Eigen::MatrixXd& B() const { return B_; }
  const Eigen::MatrixXd& C() const { return C_; }

  /// K at a time (s), as fitted.
  Eigen::MatrixXd calc_retardation(double time) const;
  /// x' from x and the velocities v (6N); does not allocate.
  void calc_rate(const Eigen::VectorXd& x, const Eigen::VectorXd& v, Eigen::VectorXd& rate) const;
  /// F from x; does not allocate.
  void calc_force(const Eigen::VectorXd& x, Eigen::VectorXd& force) const;

 private:
  Eigen::MatrixXd A_, B_, C_;
  double error_ = not_a_number;
};

/// How closely memories are to be fitted.
struct MemoryFit {
  double tolerance = 0.01;  ///< of MemoryStateSpace
  int most_states = 400;
  double acceptable_error = 0.0;
  /// Where a database does not meet the above: tried in their place; 0: not.
  double loose_tolerance = 0.0;
  int most_loose_states = 0;
};

/// Changes whenever fit_memories gives another fit of the same retardation functions.
inline constexpr int memory_fit_version = 2;

/// The memory of each of the databases, which are fitted side by side.
/// @throws ModelError as MemoryStateSpace.
std::vector<MemoryStateSpace> fit_memories(const std::vector<HydrodynamicDatabase>& databases,
                                           const MemoryFit& fit);

}  // namespace blocklift::dynamics
