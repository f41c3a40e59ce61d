#include "structure/system/held_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/IterativeLinearSolvers>
#include <fmt/format.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

using Entry = Eigen::Triplet<double, long>;

double size_of(const HeldSum& sum) {
  double size = 0;
  for (const auto& [unknown, coefficient] : sum.coefficients)
    size = std::max(size, std::abs(coefficient));
  return size;
}

/// Adds a multiple of one sum to another.
void add(HeldSum& to, const HeldSum& sum, double factor) {
  for (const auto& [unknown, coefficient] : sum.coefficients)
    to.coefficients[unknown] += factor * coefficient;
  to.value += factor * sum.value;
}

/// Replaces eliminated unknowns by what they follow, until none is left: an unknown follows none
/// that was eliminated before it.
void substitute(HeldSum& sum, const std::map<int, HeldSum>& eliminated) {
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    const std::map<int, double> before = sum.coefficients;
    for (const auto& [unknown, coefficient] : before) {
      const auto found = eliminated.find(unknown);
      if (found == eliminated.end()) continue;
      // Others may have added to it meanwhile.
      const double now = sum.coefficients.at(unknown);
      sum.coefficients.erase(unknown);
      add(sum, found->second, -now);
      is_changed = true;
    }
  }
}

}  // namespace

HeldSystem::HeldSystem(SparseLower stiffness, std::vector<HeldSum> sums) : sums_(std::move(sums)) {
  stiffness_.swap(stiffness);
  eliminate();
  make_map();
  std::vector<FixedUnknown> fixed;
  for (const auto& [unknown, sum] : eliminated_) fixed.push_back({unknown, 0});
  system_.emplace(reduced_stiffness(), std::move(fixed));
}

HeldSystem::~HeldSystem() = default;

void HeldSystem::eliminate() {
  constexpr double rounding = 1e-9;  // of a sum: what is left of one that says nothing new
  std::vector<int> order;
  for (const HeldSum& given : sums_) {
    HeldSum sum = given;
    const double size = size_of(sum);
    if (size == 0) continue;
    substitute(sum, eliminated_);
    const auto largest =
        std::max_element(sum.coefficients.begin(), sum.coefficients.end(),
                         [](auto& a, auto& b) { return std::abs(a.second) < std::abs(b.second); });
    if (largest == sum.coefficients.end() || std::abs(largest->second) < rounding * size) {
      if (std::abs(sum.value) > rounding * std::max(size, std::abs(given.value)))
        throw ModelError(fmt::format(
            "supports contradict each other: one asks for {:.6g} m (or rad) where others leave "
            "{:.6g}",
            given.value, given.value - sum.value));
      continue;
    }
    const int unknown = largest->first;
    const double pivot = largest->second;
    sum.coefficients.erase(largest);
    for (auto& [other, coefficient] : sum.coefficients) coefficient /= pivot;
    sum.value /= pivot;
    std::erase_if(sum.coefficients,
                  [](const auto& term) { return std::abs(term.second) < rounding; });
    eliminated_[unknown] = std::move(sum);
    order.push_back(unknown);
  }
  // Earlier ones may follow unknowns that were eliminated later.
  for (auto unknown = order.rbegin(); unknown != order.rend(); ++unknown)
    substitute(eliminated_.at(*unknown), eliminated_);
}

void HeldSystem::make_map() {
  std::vector<Entry> entries;
  offset_.setZero(stiffness_.rows());
  for (long unknown = 0; unknown < stiffness_.rows(); ++unknown) {
    const auto found = eliminated_.find(static_cast<int>(unknown));
    if (found == eliminated_.end()) {
      entries.emplace_back(unknown, unknown, 1);
      continue;
    }
    offset_[unknown] = found->second.value;
    for (const auto& [other, coefficient] : found->second.coefficients)
      entries.emplace_back(unknown, other, -coefficient);
  }
  map_.resize(stiffness_.rows(), stiffness_.cols());
  map_.setFromTriplets(entries.begin(), entries.end());
}

// Held unknowns keep their diagonal: the factorisation compares with it.
SparseLower HeldSystem::reduced_stiffness() const {
  const bool follows = std::any_of(eliminated_.begin(), eliminated_.end(), [](const auto& one) {
    return !one.second.coefficients.empty();
  });
  if (!follows) return stiffness_;
  const SparseLower whole = stiffness_.selfadjointView<Eigen::Lower>();
  const SparseLower reduced = map_.transpose() * (whole * map_);
  SparseLower lower = reduced.triangularView<Eigen::Lower>();
  for (const auto& [unknown, sum] : eliminated_)
    lower.coeffRef(unknown, unknown) = stiffness_.coeff(unknown, unknown);
  lower.makeCompressed();
  return lower;
}

void HeldSystem::factorise() { system_->factorise(); }

Eigen::MatrixXd HeldSystem::solve(const Eigen::MatrixXd& loads) const {
  Eigen::MatrixXd acting = loads;
  if (!offset_.isZero(0)) {
    const Eigen::VectorXd forces = stiffness_.selfadjointView<Eigen::Lower>() * offset_;
    acting.colwise() -= forces;
  }
  Eigen::MatrixXd solution = map_ * system_->solve(map_.transpose() * acting);
  solution.colwise() += offset_;
  return solution;
}

Eigen::MatrixXd HeldSystem::reactions(const Eigen::MatrixXd& solution,
                                      const Eigen::MatrixXd& loads) const {
  std::vector<Entry> entries;
  for (std::size_t sum = 0; sum < sums_.size(); ++sum)
    for (const auto& [unknown, coefficient] : sums_[sum].coefficients)
      entries.emplace_back(unknown, static_cast<long>(sum), coefficient);
  SparseLower transposed(stiffness_.rows(), static_cast<long>(sums_.size()));
  transposed.setFromTriplets(entries.begin(), entries.end());
  const Eigen::MatrixXd forces = stiffness_.selfadjointView<Eigen::Lower>() * solution - loads;
  // From zero and without preconditioning: those of least squares.
  Eigen::LeastSquaresConjugateGradient<SparseLower, Eigen::IdentityPreconditioner> multipliers;
  multipliers.setTolerance(1e-13);
  multipliers.compute(transposed);
  return multipliers.solve(forces);
}

double HeldSystem::energy(const Eigen::VectorXd& solution) const {
  return 0.5 * solution.dot(stiffness_.selfadjointView<Eigen::Lower>() * solution);
}

}  // namespace blocklift::structure
