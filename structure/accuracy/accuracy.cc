#include "structure/accuracy/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "structure/envelope/block_envelope.h"
#include "structure/envelope/leading_stress.h"
#include "structure/stress/squares.h"

namespace blocklift::structure {

namespace {

constexpr double looked_at = 0.6;   // of the largest stress: squares that later steps look at
constexpr double refined_at = 0.8;  // of the largest: about which cells are divided
// A first mesh shows little of what gathers in a corner: there squares of less stress are followed
// too.
constexpr double looked_at_in_corners = 0.4;
constexpr double growth = 0.8;      // of cells with the distance from a square
constexpr double first_edge = 0.1;  // m
constexpr std::size_t most_steps = 6;
constexpr std::size_t most_centres = 60;
// Shares that differ by less are one: squares of a symmetric block differ by rounding alone, which
// another number of threads changes, and their order decides which cells are divided.
constexpr double equal_shares = 1e-6;

/// A stress that one of the squares comes to: the largest at the instant of the largest loads.
double stress_at_largest_loads(const CheckedStress& checked, const Eigen::MatrixXd& factors,
                               const Eigen::VectorXd& weights) {
  const Eigen::MatrixXd weighed = weights.asDiagonal() * factors;
  Eigen::Index instant = 0;
  weighed.colwise().squaredNorm().maxCoeff(&instant);
  return checked.von_mises(factors.col(instant)).maxCoeff();
}

/// Largest stress of each square over all instants, zero where it is too little to be looked at.
Eigen::VectorXd largest_of(const CheckedStress& checked, const Eigen::MatrixXd& factors) {
  constexpr double least_share = 0.99 * looked_at_in_corners;
  const Eigen::VectorXd weights = response_weights(checked);
  const LoadHistory history(factors, weights);
  return find_leading_von_mises(history, static_cast<int>(checked.squares().size()),
                                stress_of_squares(checked, history), least_share,
                                stress_at_largest_loads(checked, factors, weights));
}

/// Looks at squares of a model anew.
void look_at(const CheckedStress& checked, const LoadFactors& factors, RefinementState& state) {
  state.squares = checked.squares();
  state.at_rest = largest_of(checked, factors.at_rest);
  state.in_motion = largest_of(checked, factors.in_motion);
}

/// Of the largest stress, at rest or in motion, whichever is more.
Eigen::VectorXd share_of(const RefinementState& state) {
  return (state.at_rest / state.at_rest.maxCoeff())
      .cwiseMax(state.in_motion / state.in_motion.maxCoeff());
}

double smallest_edge_of(const ElasticModel& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ShellCell& cell : model.space().shells())
    smallest =
        std::min(smallest, cell.size * longest_edge(model.mesh(), model.mesh().shells[cell.shell]));
  return smallest;
}

AccuracyStep step_of(const ElasticModel& model, const RefinementState& found) {
  return {model.space().unknowns(), static_cast<int>(model.space().shells().size()),
          smallest_edge_of(model), found.at_rest.maxCoeff(), found.in_motion.maxCoeff()};
}

/// Squares that may come to govern.
std::vector<Square> candidates(const RefinementState& found) {
  const Eigen::VectorXd share = share_of(found);
  std::vector<Square> result;
  for (std::size_t s = 0; s < found.squares.size(); ++s)
    if (share[s] >= (found.squares[s].is_near_singularity ? looked_at_in_corners : looked_at))
      result.push_back(found.squares[s]);
  return result;
}

/// Places about which cells are divided: the squares of the largest stress, the largest first, one
/// of those that lie together.
/// @param corners the share of the largest stress from which on those in corners are taken.
std::vector<Vector3> centres_of(const RefinementState& found, double corners) {
  const Eigen::VectorXd share = share_of(found);
  std::vector<int> order(found.squares.size());
  std::iota(order.begin(), order.end(), 0);
  const Eigen::VectorXd rank = (share / equal_shares).array().round();
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank[a] > rank[b]; });
  std::vector<Vector3> centres;
  for (const int s : order) {
    if (share[s] < corners || centres.size() >= most_centres) break;
    const Square& square = found.squares[s];
    if (share[s] < refined_at && !square.is_near_singularity) continue;
    const auto is_near = [&](const Vector3& centre) {
      return (centre - square.centre_B).norm() < 2 * square.size;
    };
    if (std::none_of(centres.begin(), centres.end(), is_near)) centres.push_back(square.centre_B);
  }
  return centres;
}

Resolution graded(const Resolution& base, std::vector<Vector3> centres, double edge) {
  Resolution resolution = base;
  resolution.largest_edge = [base = base.largest_edge, centres = std::move(centres),
                             edge](const Vector3& place) {
    double size = base ? base(place) : std::numeric_limits<double>::infinity();
    for (const Vector3& centre : centres)
      size = std::min(size, std::max(edge, growth * (place - centre).norm()));
    return size;
  };
  return resolution;
}

double share_of_change(double now, double before) {
  return before > 0 ? std::abs(now / before - 1) : 0;
}

/// Smallest edge of the cells that a step makes, m; the block as it comes is step 0.
double edge_of_step(std::size_t step) { return std::ldexp(first_edge, 1 - static_cast<int>(step)); }

/// The first step: the block as it comes.
void begin(const std::function<LoadFactors(const ElasticModel&, UnitResponses&)>& factors_of,
           const AccuracyGoal& goal, RefinedBlock& block, RefinementState& state) {
  if (!block.responses) block.responses = std::make_unique<UnitResponses>(*block.model);
  const LoadFactors factors = factors_of(*block.model, *block.responses);
  look_at(CheckedStress(*block.model, block.responses->displacements(), goal.square_size), factors,
          state);
  state.steps.push_back(step_of(*block.model, state));
}

/// Makes the last mesh of an earlier refinement again.
void take_up(const RefinementState& state, const Resolution& base, RefinedBlock& block) {
  const std::size_t last = state.steps.size() - 1;
  if (last > 0) {
    block.responses.reset();
    block.model = block.model->with(graded(base, state.centres, edge_of_step(last)));
  }
  if (!block.responses) block.responses = std::make_unique<UnitResponses>(*block.model);
}

CheckedAccuracy judged(const RefinementState& state, const AccuracyGoal& goal) {
  CheckedAccuracy accuracy{state.steps, false};
  accuracy.is_reached = state.steps.size() > 1 && accuracy.stress_change() <= goal.change &&
                        accuracy.increase_change() <= goal.change;
  return accuracy;
}

}  // namespace

double CheckedAccuracy::stress_change() const {
  if (steps.size() < 2) return 0;
  const AccuracyStep &now = steps.back(), &before = steps[steps.size() - 2];
  return std::max(share_of_change(now.at_rest, before.at_rest),
                  share_of_change(now.in_motion, before.in_motion));
}

double CheckedAccuracy::increase_change() const {
  if (steps.size() < 2) return 0;
  return std::abs(steps.back().increase() - steps[steps.size() - 2].increase());
}

RefinedBlock refine_checked_stress(
    std::unique_ptr<ElasticModel> model, std::unique_ptr<UnitResponses> responses,
    const std::function<LoadFactors(const ElasticModel&, UnitResponses&)>& factors_of,
    const AccuracyGoal& goal, const RefinementRecord& record) {
  const Resolution base = model->resolution();
  RefinedBlock block{std::move(model), std::move(responses), {}};
  RefinementState state;
  if (block.model->mesh().shells.empty()) {
    if (!block.responses) block.responses = std::make_unique<UnitResponses>(*block.model);
    factors_of(*block.model, *block.responses);
    return block;
  }
  if (record.earlier) {
    state = *record.earlier;
    take_up(state, base, block);
    factors_of(*block.model, *block.responses);
  } else {
    begin(factors_of, goal, block, state);
    if (record.after_step) record.after_step(state);
  }
  block.accuracy = judged(state, goal);
  while (!block.accuracy.is_reached && state.steps.size() < most_steps) {
    const double corners = state.steps.size() == 1 ? looked_at_in_corners : refined_at;
    for (const Vector3& centre : centres_of(state, corners)) state.centres.push_back(centre);
    auto finer = block.model->with(graded(base, state.centres, edge_of_step(state.steps.size())));
    if (finer->space().unknowns() > goal.most_unknowns) break;
    // The coarser mesh's factor and responses go before the finer one's come.
    block.responses.reset();
    block.model = std::move(finer);
    block.responses = std::make_unique<UnitResponses>(*block.model);
    const LoadFactors factors = factors_of(*block.model, *block.responses);
    look_at(CheckedStress(*block.model, block.responses->displacements(), candidates(state)),
            factors, state);
    state.steps.push_back(step_of(*block.model, state));
    block.accuracy = judged(state, goal);
    if (record.after_step) record.after_step(state);
  }
  return block;
}

}  // namespace blocklift::structure
