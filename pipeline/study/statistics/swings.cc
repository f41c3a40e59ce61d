#include "pipeline/study/statistics/swings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <openturns/OT.hxx>

#include "algebra/decompositions.h"
#include "pipeline/study/design/study_design.h"
#include "pipeline/study/statistics/spread.h"

namespace blocklift::pipeline {
namespace {

constexpr double not_found = std::numeric_limits<double>::quiet_NaN();

/// Inputs that take more than one value, each less its mean and over its deviation, a column each.
struct VaryingInputs {
  std::vector<std::size_t> places;  ///< among the study's variables
  Eigen::MatrixXd columns;
  Eigen::VectorXd deviations;
};

VaryingInputs varying_inputs(const Eigen::MatrixXd& design, const std::vector<int>& members) {
  const auto count = static_cast<Eigen::Index>(members.size());
  VaryingInputs inputs{{}, Eigen::MatrixXd(count, design.cols()), Eigen::VectorXd(design.cols())};
  Eigen::Index used = 0;
  for (Eigen::Index v = 0; v < design.cols(); ++v) {
    Eigen::VectorXd column(count);
    for (Eigen::Index row = 0; row < count; ++row) column[row] = design(members[row], v);
    if (!values_vary({column.begin(), column.end()})) continue;
    column.array() -= column.mean();
    inputs.deviations[used] = column.norm() / std::sqrt(static_cast<double>(count));
    inputs.columns.col(used) = column / inputs.deviations[used];
    inputs.places.push_back(static_cast<std::size_t>(v));
    ++used;
  }
  inputs.columns.conservativeResize(Eigen::NoChange, used);
  inputs.deviations.conservativeResize(used);
  return inputs;
}

bool are_told_apart(const VaryingInputs& inputs) {
  constexpr double rounding = 1e-7;
  const Eigen::Index count = inputs.columns.rows(), inputs_count = inputs.columns.cols();
  return count > inputs_count && algebra::numerical_rank(inputs.columns, rounding) == inputs_count;
}

/// How many standard errors an interval of 95 % reaches to each side.
double reach_of_interval(Eigen::Index freedoms) {
  return freedoms > 0 ? OT::DistFunc::qStudent(static_cast<double>(freedoms), 0.975) : not_found;
}

}  // namespace

std::vector<std::size_t> Swings::by_size() const {
  std::vector<std::size_t> order(of.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto size = [&](std::size_t v) {
    return std::isfinite(of[v].value) ? std::abs(of[v].value) : -1;
  };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  return order;
}

Swings find_swings(const StudyFile& study, const Eigen::MatrixXd& design,
                   const std::vector<double>& values, const std::vector<int>& members) {
  const VaryingInputs inputs = varying_inputs(design, members);
  Swings swings{{}, not_found};
  for (const StudyVariable& variable : study.variables) {
    const auto [from, to] = middle_range(variable);
    const double none = from < to ? not_found : 0;
    swings.of.push_back({from, to, none, none, none});
  }
  if (inputs.places.empty() || !are_told_apart(inputs)) return swings;

  const Eigen::Map<const Eigen::VectorXd> figure(values.data(),
                                                 static_cast<Eigen::Index>(values.size()));
  const Eigen::VectorXd deviations = figure.array() - figure.mean();
  const Eigen::MatrixXd inverse =
      algebra::inverse_of<Eigen::Dynamic>(inputs.columns.transpose() * inputs.columns);
  const Eigen::VectorXd slopes = inverse * (inputs.columns.transpose() * deviations);
  const double left = (deviations - inputs.columns * slopes).squaredNorm();
  swings.linear_share = values_vary(values) ? 1 - left / deviations.squaredNorm() : 1;
  const Eigen::Index freedoms = figure.size() - slopes.size() - 1;
  const double reach = reach_of_interval(freedoms);
  const double variance = left / static_cast<double>(freedoms);
  for (Eigen::Index k = 0; k < slopes.size(); ++k) {
    Swing& swing = swings.of[inputs.places[k]];
    const double range = (swing.to - swing.from) / inputs.deviations[k];
    const double error = reach * std::sqrt(variance * inverse(k, k)) * range;
    swing.value = slopes[k] * range;
    swing.low = swing.value - error;
    swing.high = swing.value + error;
  }
  return swings;
}

}  // namespace blocklift::pipeline
