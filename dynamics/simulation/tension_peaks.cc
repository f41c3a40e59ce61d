#include "dynamics/simulation/tension_peaks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dynamics/errors.h"
#include "dynamics/simulation/integrator.h"

namespace blocklift::dynamics {

namespace {

// A peak that is not larger by more than this share is none: the steps' own errors are larger.
constexpr double share_worth_a_sample = 1e-6;

template <class Values>
void keep_rows(Values& values, const std::vector<Eigen::Index>& rows) {
  if (values.rows() > 0) values = values(rows, Eigen::all).eval();
}

void keep_rows_of_ropes(std::vector<RopeHistory>& ropes, const std::vector<Eigen::Index>& rows) {
  for (RopeHistory& rope : ropes) {
    for (auto* values :
         {&rope.tension, &rope.elongation, &rope.unstretched_length, &rope.unstretched_rate})
      keep_rows(*values, rows);
    keep_rows(rope.first_force, rows);
    keep_rows(rope.last_force, rows);
    for (EdgeHistory& edge : rope.edges) {
      keep_rows(edge.force, rows);
      for (auto* values : {&edge.wrap, &edge.first_angle, &edge.last_angle, &edge.first_place,
                           &edge.last_place, &edge.first_tension, &edge.last_tension})
        keep_rows(*values, rows);
    }
  }
}

// A quaternion has the sign of the sample before it.
void join_quaternions(BodyHistory::Rows7& pose) {
  for (Eigen::Index i = 1; i < pose.rows(); ++i) {
    if (pose.row(i).tail<4>().dot(pose.row(i - 1).tail<4>()) < 0.0) pose.row(i).tail<4>() *= -1.0;
  }
}

void keep_rows_of_bodies(std::vector<BodyHistory>& bodies, const std::vector<Eigen::Index>& rows) {
  for (BodyHistory& body : bodies) {
    keep_rows(body.pose, rows);
    join_quaternions(body.pose);
    for (auto* values : {&body.velocity, &body.acceleration, &body.load}) keep_rows(*values, rows);
  }
}

// Samples of the history, in this order.
void keep_samples(History& history, const std::vector<Eigen::Index>& samples) {
  keep_rows(history.time, samples);
  keep_rows_of_bodies(history.bodies, samples);
  keep_rows_of_ropes(history.ropes, samples);
  for (ElasticModeHistory& mode : history.elastic_modes)
    for (auto* values : {&mode.coordinate, &mode.rate, &mode.acceleration})
      keep_rows(*values, samples);
  for (DriveHistory& drive : history.drives)
    for (auto* values : {&drive.position, &drive.velocity, &drive.force})
      keep_rows(*values, samples);
  for (SupportHistory& pad : history.supports) keep_rows(pad.normal_force, samples);
  for (LoopHistory& loop : history.loops) {
    keep_rows(loop.force, samples);
    keep_rows(loop.multipliers, samples);
    keep_rows(loop.residual, samples);
  }
  EnergyHistory& energy = history.energy;
  for (auto* values : {&energy.kinetic, &energy.gravity, &energy.elastic, &energy.drive_work,
                       &energy.winch_work, &energy.outside_work, &energy.dissipated})
    keep_rows(*values, samples);
}

double pull_of(const RopeLoad& load) { return std::max(0.0, load.tension); }

}  // namespace

IntegrationResult integrate_with_peaks(const LiftSystem& system, const Eigen::VectorXd& q,
                                       const Eigen::VectorXd& v,
                                       const IntegrationSettings& settings) {
  if (settings.awaited)
    throw ModelError("a run that waits for a condition has no samples of largest loads");
  return Integrator(system, q, v, settings, true).run();
}

// By forward differences (Newton), u from 0 to 3.
std::pair<double, double> find_largest_within(const Vector4& values) {
  const double first = values[1] - values[0], second = values[2] - 2 * values[1] + values[0],
               third = values[3] - 3 * values[2] + 3 * values[1] - values[0];
  const double b = first - second / 2 + third / 3, c = (second - third) / 2, d = third / 6;
  std::pair<double, double> largest(values[0] < values[3] ? 1.0 : 0.0,
                                    std::max(values[0], values[3]));
  const double discriminant = c * c - 3 * b * d;
  if (!(discriminant >= 0)) return largest;
  // Roots of the derivative without cancellation. What is none is not a number, or infinite.
  const double q = -(c + std::copysign(std::sqrt(discriminant), c));
  for (const double u : {q / (3 * d), b / q}) {
    if (!(u > 0 && u < 3)) continue;
    const double value = values[0] + u * (b + u * (c + u * d));
    if (value > largest.second) largest = {u / 3, value};
  }
  return largest;
}

TensionPeaks::TensionPeaks(History& history)
    : history_(history),
      sample_count_(history.sample_count() - static_cast<Eigen::Index>(history.ropes.size())),
      has_peak_(history.ropes.size(), 0),
      tensions_(static_cast<Eigen::Index>(history.ropes.size()), 4) {
  largest_.setZero(tensions_.rows());
  last_.setConstant(tensions_.rows(), not_a_number);
  rate_ = last_;
  // A sample takes the sign of its quaternions after the one before it, which may not be yet.
  for (BodyHistory& body : history.bodies) body.pose.setZero();
}

double TensionPeaks::bar(std::size_t rope) const {
  return (1 + share_worth_a_sample) * largest_[rope];
}

void TensionPeaks::note_sample(Eigen::Index sample) {
  for (std::size_t i = 0; i < history_.ropes.size(); ++i) {
    double& largest = largest_[i];
    largest = std::max(largest, history_.ropes[i].tension[sample]);
  }
}

// Two steps whose mean rates differ bend the tension by their difference in about a step. It can
// pass its ends by an eighth of that, or by a fourth behind a step that is far shorter. It turns
// between them where the rates differ by more than the rate itself. Half of that is asked for, and
// four times as much is allowed for. Of the first two steps nothing is known.
bool TensionPeaks::is_worth_a_look(const Step& step) {
  const double duration = step.end - step.begin;
  bool is_worth = false;
  for (std::size_t i = 0; i < has_peak_.size(); ++i) {
    const auto rope = static_cast<Eigen::Index>(i);
    const double end = tensions_(rope, 3), rate = (end - last_[rope]) / duration;
    const double bend = std::abs(rate - rate_[rope]);
    const bool is_low = std::max(last_[rope], end) + bend * duration <= bar(i);
    const bool goes_straight = bend < 0.5 * std::abs(rate);
    is_worth |= !is_low && (!goes_straight || step.ends_at_corner);
    last_[rope] = end;
    rate_[rope] = rate;
  }
  return is_worth;
}

void TensionPeaks::seek(const Step& step, const Loads& loads, const Record& record) {
  const double duration = step.end - step.begin;
  const auto note = [&](double t, Eigen::Index column) {
    const std::vector<RopeLoad>& all = loads(t);
    for (std::size_t i = 0; i < all.size(); ++i)
      tensions_(static_cast<Eigen::Index>(i), column) = pull_of(all[i]);
  };
  note(step.end, 3);
  if (!is_worth_a_look(step)) return;
  for (Eigen::Index k = 0; k < 3; ++k) note(step.begin + static_cast<double>(k) * duration / 3, k);
  for (std::size_t i = 0; i < has_peak_.size(); ++i) {
    const auto rope = static_cast<Eigen::Index>(i);
    const auto [place, value] = find_largest_within(tensions_.row(rope).transpose());
    // What still rises at the end is followed into the next step.
    if (!(value > bar(i)) || (place == 1.0 && !step.ends_at_corner)) continue;
    const double t = place == 1.0 ? step.end : step.begin + place * duration;
    const double tension = pull_of(loads(t)[i]);
    if (!(tension > bar(i))) continue;
    record(t, sample_count_ + rope);
    largest_[rope] = tension;
    has_peak_[i] = 1;
  }
}

void TensionPeaks::arrange() {
  std::vector<Eigen::Index> samples(static_cast<std::size_t>(sample_count_));
  std::iota(samples.begin(), samples.end(), Eigen::Index{0});
  for (std::size_t i = 0; i < has_peak_.size(); ++i) {
    if (!has_peak_[i]) continue;
    const Eigen::VectorXd& tension = history_.ropes[i].tension;
    const auto is_less = [&](Eigen::Index a, Eigen::Index b) { return tension[a] < tension[b]; };
    const Eigen::Index peak = sample_count_ + static_cast<Eigen::Index>(i);
    // Peaks of other ropes may serve, for ropes that bear alike have theirs together.
    const Eigen::Index most = *std::max_element(samples.begin(), samples.end(), is_less);
    if (tension[peak] > (1 + share_worth_a_sample) * tension[most]) samples.push_back(peak);
  }
  std::stable_sort(samples.begin(), samples.end(), [&](Eigen::Index a, Eigen::Index b) {
    return history_.time[a] < history_.time[b];
  });
  keep_samples(history_, samples);
}

}  // namespace blocklift::dynamics
