#pragma once

#include <vector>

#include <Eigen/Core>

namespace blocklift::dynamics {

/// Damping B of all frequencies from what is known of it in a band, so that retardation functions
/// follow from it (Ogilvie 1964) and no energy ever comes out of the water: B is positive
/// semidefinite everywhere.
///
/// In the band B is linear between closely spaced frequencies; what rounding made negative of it is
/// nothing. Below, with a the lowest frequency, and above, with b the highest,
///
///   B(w) = R B(a) R,                      R = diag((w/a)^(q_m/2)),
///   B(w) = S B(b) S + diag(c_m) h(w/b),   S = diag((b/w)^(p_m/2)),   h(x) = (x - 1)^2/x^6.
///
/// q and p continue the slope of each mode's own damping, within [1, 12] and [2.5, 12]: in deep
/// water B falls as w^-3 beside a vertical wall and faster elsewhere. c, not negative, is what
/// radiates beyond: the added mass in the band tells it by Kramers' and Kronig's relation, whose
/// integral over B would otherwise fall short of it. Where it tells that there is less than the
/// slope says, p is larger.
class DampingBeyond {
 public:
  /// @param frequencies of the band, rad/s, ascending, positive, at least three.
  /// @param damping B, symmetric, one for each.
  /// @param at where the added mass is known, rad/s; what lies above 0.8 b tells nothing.
  /// @param added_mass A - A_inf there, the diagonal alone: modes x frequencies.
  DampingBeyond(std::vector<double> frequencies, std::vector<Eigen::MatrixXd> damping,
                const std::vector<double>& at, const Eigen::MatrixXd& added_mass);

  /// B from w = 0 to where next to nothing is left, linear between.
  const std::vector<double>& frequencies() const { return frequencies_; }  ///< rad/s
  const std::vector<Eigen::MatrixXd>& damping() const { return damping_; }
  const Eigen::VectorXd& falls() const { return falls_; }  ///< p
  const Eigen::VectorXd& rises() const { return rises_; }  ///< q

 private:
  void add_below();
  void find_tail(const std::vector<double>& at, const Eigen::MatrixXd& added_mass);
  void add_above();

  std::vector<double> frequencies_;
  std::vector<Eigen::MatrixXd> damping_;
  Eigen::VectorXd rises_, falls_, humps_;
};

}  // namespace blocklift::dynamics
