#pragma once

#include <complex>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace blocklift::dynamics {

/// Transfer functions that have all their poles in common, real in time,
///
///   f(i w) = sum over k of R_k/(i w - p_k),    sum of R_k = 0,
///
/// so that f fades at high frequencies as w^-2, as added mass and damping do:
/// A(w) - A_inf + B(w)/(i w) = f(i w). Between frequencies at which they are known they say what f
/// is; beyond, nothing holds them to it.
struct CommonPoles {
  /// 1/s: real ones, and of each pair that with the positive imaginary part. All decay.
  Eigen::VectorXcd poles;
  Eigen::MatrixXcd residues;  ///< values x poles

  Eigen::VectorXcd at(double frequency) const;  ///< f, rad/s
};

/// The function with the fewest poles that comes as close to samples as is asked, or, where half as
/// many support points as samples do not suffice, the closest that was met.
///
/// Poles by the set-valued AAA algorithm (Nakatsukasa, Sete and Trefethen 2018, SIAM J. Sci.
/// Comput. 40; for sets Lietaert, Meerbergen, Perez and Vandereycken 2022, IMA J. Numer. Anal. 42)
/// with conjugate support points and weights and a sample of nothing at infinity; a pole that grows
/// is reflected. Residues by least squares over all samples. Poles that make less than a hundredth
/// of the tolerance are left out.
/// @param frequencies rad/s, positive, each once. @param values a column for each frequency.
/// @param scales positive, what errors of each value are measured by.
/// @param error largest error at a sample over its scale, if asked for.
/// @throws ModelError if there are fewer than four frequencies, or sizes do not fit.
CommonPoles fit_common_poles(const std::vector<double>& frequencies, const Eigen::MatrixXcd& values,
                             const Eigen::VectorXd& scales, double tolerance,
                             double* error = nullptr);

/// How functions that are costly to compute are sought between two frequencies.
struct PoleSearch {
  double lowest, highest;          ///< rad/s
  double tolerance = 1e-3;         ///< of scales
  std::vector<double> first = {};  ///< computed in any case, rad/s
  int most = 100;                  ///< frequencies, those of `first` included
  /// What each value is measured by; without it its largest magnitude.
  std::function<Eigen::VectorXd(const Eigen::MatrixXcd&)> scales = {};
};
struct FoundPoles {
  CommonPoles function;
  std::vector<double> frequencies;  ///< computed, in this order
  Eigen::MatrixXcd values;          ///< a column for each
  /// Largest miss of the last three frequencies, each foretold without it; of scales.
  double miss = 0.0;
};

/// Computes frequencies one after another where the last two fits differ most, every third in the
/// middle of the widest gap, until three in a row were foretold to the tolerance, or `most` are
/// computed.
/// @throws ModelError unless 0 < lowest < highest and the first frequencies are within.
FoundPoles search_common_poles(const std::function<Eigen::VectorXcd(double)>& compute,
                               const PoleSearch& search);

}  // namespace blocklift::dynamics
