#include "dynamics/marine/loads/draught_shares.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

constexpr double rounding = 0.1;  // of the lesser step beside a corner

}  // namespace

double DraughtMark::calc_draught(const Kinematics& kinematics) const {
  return calc_draught(kinematics.X_WB[body]);
}

double DraughtMark::calc_rate(const Kinematics& kinematics) const {
  const auto b = static_cast<std::size_t>(body);
  return -shift(kinematics.V_WB[b], kinematics.X_WB[b].R * p_BoK_B).linear.z();
}

DraughtInterpolation::DraughtInterpolation(const std::vector<double>& draughts) {
  if (draughts.size() < 2) return;
  if (draughts.size() > most_draughts) {
    throw ModelError("there are " + std::to_string(draughts.size() - 1) + " draughts; at most " +
                     std::to_string(most_draughts - 1) + " can be told apart");
  }
  const auto count = static_cast<Eigen::Index>(draughts.size());
  corner_.resize(count);
  half_width_.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    corner_[k] = draughts[k];
    if (k == 0 ? corner_[k] != 0.0 : !(corner_[k] > corner_[k - 1])) {
      throw ModelError("draughts must ascend from zero, where the body is dry; draught " +
                       std::to_string(k + 1) + " is " + std::to_string(corner_[k]) + " m");
    }
  }
  corner_[0] = half_width_[0] = 0.5 * rounding * corner_[1];
  for (Eigen::Index k = 1; k < count; ++k) {
    double step = corner_[k] - corner_[k - 1];
    if (k + 1 < count) step = std::min(step, corner_[k + 1] - corner_[k]);
    half_width_[k] = rounding * step;
  }
}

DraughtShares DraughtInterpolation::calc_shares(double draught) const {
  DraughtShares shares;
  const Eigen::Index count = corner_.size();
  if (count == 0) return shares;
  // Beyond each corner: its ramp max(0, draught - corner), rounded, and the ramp's slope.
  DraughtShares::Values ramp(count), slope(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double beyond = draught - corner_[k], half = half_width_[k];
    slope[k] = std::clamp((beyond + half) / (2.0 * half), 0.0, 1.0);
    ramp[k] = slope[k] < 1.0 ? half * slope[k] * slope[k] : beyond;
  }
  shares.passed.resize(count - 1);
  shares.slope.resize(count - 1);
  shares.weight.resize(count);
  shares.gain.resize(count);
  for (Eigen::Index k = 0; k + 1 < count; ++k) {
    const double step = corner_[k + 1] - corner_[k];
    shares.passed[k] = std::clamp((ramp[k] - ramp[k + 1]) / step, 0.0, 1.0);
    shares.slope[k] = (slope[k] - slope[k + 1]) / step;
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    const double reached = k == 0 ? 1.0 : shares.passed[k - 1];
    shares.weight[k] = std::max(0.0, reached - (k + 1 < count ? shares.passed[k] : 0.0));
    // What rounding leaves of nothing would make gains of 1e-8.
    if (shares.weight[k] < 1e-14) shares.weight[k] = 0.0;
    shares.gain[k] = std::sqrt(shares.weight[k]);
  }
  return shares;
}

}  // namespace blocklift::dynamics
