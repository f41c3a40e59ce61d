#include "pipeline/lift/sling_lengths.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/decompositions.h"
#include "dynamics/errors.h"
#include "pipeline/build/held_heading.h"
#include "pipeline/lift/sling_ends.h"

namespace blocklift::pipeline {
namespace {

/// The first sample at rest at which slings bear the load's weight, all of it.
std::optional<Eigen::Index> first_hanging(const LiftCase& lift_case, const LiftRun& lift) {
  constexpr double close = 1e-3;
  const double weight =
      lift.model.system.mechanism().body(lift.model.load).inertia.mass * lift_case.gravity;
  const dynamics::History& history = lift.static_history;
  const Eigen::VectorXd borne = load_on_slings(lift.model, history);
  for (Eigen::Index i = 0; i < borne.size(); ++i)
    if (std::abs(borne[i] - weight) < close * weight) return i;
  return std::nullopt;
}

/// Equilibria of one lift at one instant with slings of any lengths.
class SlingStates {
 public:
  SlingStates(const LiftCase& lift_case, const LoadMass& load, const LoadFlexibility* flexibility,
              std::vector<std::string> slings)
      : case_(lift_case), load_(load), flexibility_(flexibility), slings_(std::move(slings)) {
    // What hangs on one hook turns like a weathervane, which says nothing of its slings.
    case_.wind.reset();
  }

  /// Brings the lift as it is to an instant by the equilibria before it.
  void go_to(double time) {
    const BuiltLift model = build_lift(case_, load_, nullptr, flexibility_);
    q_ = model.at_rest().q_start();
    time_ = time;
    dynamics::EquilibriumSolver solver = solver_at_rest(model);
    solver.solve(0, q_);
    double now = 0;
    while (now < time) {
      const double next = std::min(time, now + case_.dynamics.static_interval);
      solver.follow(now, next, q_);
      now = next;
    }
  }

  /// The equilibrium with other lengths, sought from that of those meant.
  SlingState with_lengths(const Eigen::VectorXd& lengths) {
    for (std::size_t i = 0; i < slings_.size(); ++i)
      for (given::Rope& rope : case_.ropes)
        if (rope.name.value == slings_[i]) rope.length.value = lengths[i];
    const BuiltLift model = build_lift(case_, load_, nullptr, flexibility_);
    dynamics::EquilibriumSolver solver = solver_at_rest(model);
    Eigen::VectorXd q = q_;
    solver.solve(time_, q);
    return state_of(model, solver.workspace());
  }

 private:
  SlingState state_of(const BuiltLift& model, const dynamics::LiftWorkspace& w) const {
    SlingState state;
    state.tensions.resize(slings_.size());
    for (const LiftRope& rope : model.ropes) {
      const auto place = std::find(slings_.begin(), slings_.end(), rope.name);
      if (place != slings_.end())
        state.tensions[place - slings_.begin()] = w.rope_loads[rope.rope].tension;
    }
    const Eigen::Matrix3d R = w.kinematics.X_WB[model.load].R;
    state.tilt = std::atan2(R.col(2).head<2>().norm(), R(2, 2));
    state.trim = std::asin(std::clamp(R(2, 0), -1.0, 1.0));
    state.list = std::asin(std::clamp(R(2, 1), -1.0, 1.0));
    return state;
  }

  LiftCase case_;
  const LoadMass& load_;
  const LoadFlexibility* flexibility_;
  std::vector<std::string> slings_;
  Eigen::VectorXd q_;
  double time_ = 0;
};

void find_errors(SlingStates& states, SlingLengths& result) {
  for (Eigen::Index i = 0; i < result.lengths.size(); ++i) {
    Eigen::VectorXd longer = result.lengths, shorter = result.lengths;
    longer[i] *= 1 + result.tolerance;
    shorter[i] *= 1 - result.tolerance;
    result.errors.push_back({states.with_lengths(longer), states.with_lengths(shorter)});
  }
}

void find_worst(SlingStates& states, SlingLengths& result) {
  const std::size_t count = result.slings.size();
  if (count > SlingLengths::most_in_sets) return;
  result.worst_tensions = result.meant.tensions;
  result.worst_tilt = result.meant.tilt;
  for (unsigned set = 0; set < 1U << count; ++set) {
    Eigen::VectorXd lengths = result.lengths;
    for (std::size_t i = 0; i < count; ++i)
      lengths[i] *= (set >> i & 1U) != 0 ? 1 + result.tolerance : 1 - result.tolerance;
    const SlingState state = states.with_lengths(lengths);
    result.worst_tensions = result.worst_tensions.cwiseMax(state.tensions);
    result.worst_tilt = std::max(result.worst_tilt, state.tilt);
  }
}

/// Slopes of trim and list by the lengths.
Eigen::Matrix2Xd slopes_of(SlingStates& states, const Eigen::VectorXd& lengths,
                           const SlingState& here) {
  constexpr double step = 1e-3;  // m, well above what equilibria are found to
  Eigen::Matrix2Xd slopes(2, lengths.size());
  for (Eigen::Index i = 0; i < lengths.size(); ++i) {
    Eigen::VectorXd longer = lengths;
    longer[i] += step;
    const SlingState there = states.with_lengths(longer);
    slopes.col(i) << (there.trim - here.trim) / step, (there.list - here.list) / step;
  }
  return slopes;
}

/// Lengths of a level load; none where Newton's method does not get there within a tenth of them.
void find_level(SlingStates& states, SlingLengths& result) {
  constexpr double level_enough = 1e-6;  // rad
  constexpr int most_steps = 8;
  Eigen::VectorXd lengths = result.lengths;
  SlingState state = result.meant;
  for (int step = 0; step < most_steps; ++step) {
    if (std::hypot(state.trim, state.list) < level_enough) {
      result.level_lengths = lengths;
      result.level = state;
      return;
    }
    const Eigen::Matrix2Xd slopes = slopes_of(states, lengths, state);
    const Eigen::VectorXd change =
        -algebra::least_squares(slopes, Eigen::Vector2d(state.trim, state.list));
    lengths += change;
    if (((lengths - result.lengths).array().abs() > 0.1 * result.lengths.array()).any()) return;
    state = states.with_lengths(lengths);
  }
}

}  // namespace

std::optional<SlingLengths> find_sling_lengths(const LiftCase& lift_case, const LoadMass& load,
                                               const LoadFlexibility* flexibility,
                                               const LiftRun& lift) {
  SlingLengths result;
  std::vector<double> lengths;
  for (const given::Rope& rope : lift_case.ropes) {
    if (!rope.is_sling() || rope.winch) continue;
    result.slings.push_back(rope.name.value);
    lengths.push_back(rope.length.value);
  }
  const std::optional<Eigen::Index> sample = first_hanging(lift_case, lift);
  if (lift_case.sling_tolerance == 0 || result.slings.empty() || !sample) return std::nullopt;
  result.lengths =
      Eigen::Map<Eigen::VectorXd>(lengths.data(), static_cast<Eigen::Index>(lengths.size()));
  result.tolerance = lift_case.sling_tolerance;
  result.time = lift.static_history.time[*sample];
  SlingStates states(lift_case, load, flexibility, result.slings);
  try {
    states.go_to(result.time);
    result.meant = states.with_lengths(result.lengths);
    find_errors(states, result);
    find_worst(states, result);
    find_level(states, result);
  } catch (const dynamics::SimulationError& error) {
    // The lift itself has its equilibria: what is only shown beside it does not end the run.
    result.trouble = error.what();
  }
  return result;
}

}  // namespace blocklift::pipeline
