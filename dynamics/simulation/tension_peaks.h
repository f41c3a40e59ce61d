#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "dynamics/simulation/time_integration.h"

namespace blocklift::dynamics {

/// As integrate, and where a rope bears more between the samples than at any of them, the instant
/// of its largest tension is a sample, too: at most one a rope, in the order of time among the
/// others. All of such a sample is recorded as of the others; it is not observed.
///
/// The largest tension is that of the method's own interpolation within each step (TensionPeaks):
/// how far it is off is how far the motion is, and does not depend on the samples. It is missed by
/// at most a millionth of it.
///
/// @throws ModelError if a condition is awaited, whose samples end before those that were asked
/// for; else as integrate.
IntegrationResult integrate_with_peaks(const LiftSystem& system, const Eigen::VectorXd& q,
                                       const Eigen::VectorXd& v,
                                       const IntegrationSettings& settings = {});

/// Where a value that is known at four evenly spaced places is largest between the first (0) and
/// the last (1), and that value, by the polynomial of third degree through them.
std::pair<double, double> find_largest_within(const Vector4& values);

/// Seeks the largest tension of each rope in the steps of a time integration, and keeps it in a
/// sample of the history.
///
/// Of the tensions at the ends of steps it follows which steps are worth a closer look: where a
/// rope's may have turned from rising to falling above all that it bore so far. There two more are
/// found between, and the largest of the polynomial through all four.
class TensionPeaks {
 public:
  /// Of the integration, s.
  struct Step {
    double begin, end;
    /// May tensions turn, or jump, at its end without having bent before?
    bool ends_at_corner;
  };
  /// Loads of all ropes at a time (s) of the step.
  using Loads = std::function<const std::vector<RopeLoad>&(double)>;
  /// Enters a time (s) of the step in the history, as the sample of that number.
  using Record = std::function<void(double, Eigen::Index)>;

  /// @param history outlives this. The last samples of it, one a rope, are those of peaks.
  explicit TensionPeaks(History& history);

  /// Another sample than those of peaks has been recorded.
  void note_sample(Eigen::Index sample);
  /// Looks for peaks in a step, one after another, and records them.
  void seek(const Step& step, const Loads& loads, const Record& record);
  /// Behind the last step: puts samples of peaks among the others and drops those that were not
  /// needed.
  void arrange();

 private:
  bool is_worth_a_look(const Step& step);
  /// More than this a peak must be to be a sample, N.
  double bar(std::size_t rope) const;

  History& history_;
  const Eigen::Index sample_count_;  ///< without those of peaks
  std::vector<char> has_peak_;       ///< for each rope
  Eigen::VectorXd largest_;          ///< of each rope, in samples and in its peak, N
  Eigen::VectorXd last_, rate_;      ///< of each rope: at the last step's end, N; over it, N/s
  /// Of each rope, at the step's begin, a third and two thirds of it and its end, N.
  Eigen::Matrix<double, Eigen::Dynamic, 4> tensions_;
};

}  // namespace blocklift::dynamics
