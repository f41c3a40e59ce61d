#include "dynamics/marine/loads/radiated_water.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "algebra/decompositions.h"
#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;

HydrodynamicSeries checked(const RadiatedWater::Definition& definition) {
  if (!definition.database && !definition.series) {
    throw ModelError("radiation without a hydrodynamic database");
  }
  HydrodynamicSeries series =
      definition.series ? *definition.series : HydrodynamicSeries{0, {0.0}, {*definition.database}};
  if (series.databases.empty()) throw ModelError("radiation without a hydrodynamic database");
  for (const HydrodynamicDatabase& database : series.databases) {
    if (database.body_count() == static_cast<int>(definition.frames.size()) &&
        database.infinite_added_mass.rows() == database.mode_count()) {
      continue;
    }
    throw ModelError("the hydrodynamic database holds " + std::to_string(database.body_count()) +
                     " bodies, and " + std::to_string(definition.frames.size()) +
                     " float in it; each needs its part");
  }
  const bool fitted =
      series.memories.empty() ||
      (series.memories.size() == series.databases.size() &&
       std::all_of(series.memories.begin(), series.memories.end(), [&](const auto& m) {
         return m.mode_count() == series.databases.front().mode_count();
       }));
  if (!fitted) throw ModelError("the memories of the water are not those of its databases");
  if (series.databases.size() > 1 && definition.mark.body <= world_index) {
    throw ModelError("databases of several draughts, and no body whose draught it is");
  }
  return series;
}

// Rows and columns in the order (angular; linear).
MatrixXd reordered(const MatrixXd& by_modes, bool rows, bool columns) {
  MatrixXd result(by_modes.rows(), by_modes.cols());
  for (Eigen::Index j = 0; j < by_modes.cols(); ++j) {
    for (Eigen::Index i = 0; i < by_modes.rows(); ++i) {
      result(rows ? place_of_mode(i) : i, columns ? place_of_mode(j) : j) = by_modes(i, j);
    }
  }
  return result;
}

MatrixXd reordered(const MatrixXd& by_modes) { return reordered(by_modes, true, true); }

// The positive semidefinite part of a symmetric matrix, its rows and columns measured by `scale`.
MatrixXd positive_part(const MatrixXd& matrix, const Eigen::VectorXd& scale) {
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  const auto eigen = algebra::symmetric_eigensystem<Eigen::Dynamic>(inverse.asDiagonal() * matrix *
                                                                    inverse.asDiagonal());
  const MatrixXd vectors = scale.asDiagonal() * eigen.vectors;
  return vectors * eigen.values.cwiseMax(0.0).asDiagonal() * vectors.transpose();
}

// Root of the diagonal, or 1 where there is nothing.
Eigen::VectorXd scale_of(const MatrixXd& matrix) {
  const Eigen::VectorXd diagonal = matrix.diagonal().cwiseMax(0.0);
  return (diagonal.array() > 0.0).select(diagonal.cwiseSqrt(), 1.0);
}

}  // namespace

RadiatedWater::RadiatedWater(const Definition& definition)
    : RadiatedWater(definition, checked(definition)) {}

RadiatedWater::RadiatedWater(const Definition& definition, const HydrodynamicSeries& series)
    : inertia_(definition.frames, reordered(series.databases.back().infinite_added_mass)),
      mark_(definition.mark),
      interpolation_(series.databases.size() > 1 ? DraughtInterpolation(series.draughts)
                                                 : DraughtInterpolation()),
      input_(0, inertia_.size()),
      output_(inertia_.size(), 0) {
  MatrixXd before;
  const Eigen::VectorXd scale = scale_of(inertia_.matrix());
  for (const HydrodynamicDatabase& database : series.databases) {
    const MatrixXd added =
        AddedInertia(definition.frames, reordered(database.infinite_added_mass)).matrix();
    if (before.size() == 0) {
      dry_ = added;
    } else {
      const MatrixXd change = added - before;
      const MatrixXd gained = positive_part(change, scale);
      steps_.push_back({change, gained, gained - change});
    }
    before = added;
  }
  if (series.memories.empty()) {
    for (const MemoryStateSpace& memory : fit_memories(series.databases, definition.fit)) {
      append(memory);
    }
    return;
  }
  for (const MemoryStateSpace& memory : series.memories) append(memory);
}

RadiatedWater::RadiatedWater(std::vector<BodyFrame> frames, const MatrixXd& infinite_added_mass)
    : inertia_(std::move(frames), reordered(infinite_added_mass)),
      dry_(inertia_.matrix()),
      input_(0, infinite_added_mass.rows()),
      output_(infinite_added_mass.rows(), 0) {}

void RadiatedWater::append(const MemoryStateSpace& memory) {
  const Section section{static_cast<Eigen::Index>(sections_.size()), decay_.size(),
                        memory.state_count()};
  const Eigen::Index states = section.first + section.count;
  memory_error_ = std::max(memory_error_, memory.error());
  decay_.conservativeResize(states);
  turn_.conservativeResize(states);
  input_.conservativeResize(states, Eigen::NoChange);
  output_.conservativeResize(Eigen::NoChange, states);
  decay_.tail(section.count) = memory.A().diagonal();
  turn_.tail(section.count).setZero();
  for (Eigen::Index i = 0; i + 1 < section.count; ++i) {
    turn_[section.first + i] = memory.A()(i, i + 1);
    if (memory.A()(i, i + 1) != 0.0) ++i;
  }
  input_.bottomRows(section.count) = reordered(memory.B(), false, true);
  output_.rightCols(section.count) = reordered(memory.C(), true, false);
  scale_states(section);
  sections_.push_back(section);
}

// A steady velocity of 1 (m/s or rad/s) brings no state, or pair, beyond 1.
void RadiatedWater::scale_states(const Section& section) {
  for (Eigen::Index i = section.first; i < section.first + section.count; ++i) {
    const Eigen::Index count = turn_[i] != 0.0 ? 2 : 1;
    const double rate = std::hypot(decay_[i], turn_[i]);
    const double size = input_.middleRows(i, count).rowwise().norm().maxCoeff() / rate;
    if (size > 0.0) {
      input_.middleRows(i, count) /= size;
      output_.middleCols(i, count) *= size;
    }
    i += count - 1;
  }
}

DraughtShares RadiatedWater::find_shares(const Kinematics& kinematics) const {
  if (!varies()) return {};
  DraughtShares shares = interpolation_.calc_shares(mark_.calc_draught(kinematics));
  shares.rate = mark_.calc_rate(kinematics);
  return shares;
}

void RadiatedWater::calc_added_mass(const DraughtShares& shares, MatrixXd& matrix) const {
  matrix = dry_;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const double passed = shares.passed[k];
    if (passed != 0.0) matrix += passed * steps_[k].change;
  }
}

void RadiatedWater::add_entry_force(const DraughtShares& shares, ConstVectorRef u,
                                    VectorRef force) const {
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const double rate = shares.slope[k] * shares.rate;
    if (rate > 0.0) force.noalias() -= rate * (steps_[k].gained * u);
    if (rate < 0.0) force.noalias() += rate * (steps_[k].lost * u);
  }
}

double RadiatedWater::calc_entry_loss(const DraughtShares& shares, ConstVectorRef u) const {
  double loss = 0.0;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const double rate = std::abs(shares.slope[k] * shares.rate);
    if (rate == 0.0) continue;
    loss += 0.5 * rate * (u.dot(steps_[k].gained * u) + u.dot(steps_[k].lost * u));
  }
  return loss;
}

void RadiatedWater::calc_rate(const DraughtShares& shares, ConstVectorRef x, ConstVectorRef u,
                              VectorRef rate) const {
  for (const Section& section : sections_) {
    const double gain = shares.gain[section.draught];
    auto driven = rate.segment(section.first, section.count);
    if (gain == 0.0) {
      driven.setZero();
      continue;
    }
    driven.noalias() = input_.middleRows(section.first, section.count) * u;
    if (gain != 1.0) driven *= gain;
  }
  for (Eigen::Index i = 0; i < decay_.size(); ++i) {
    if (turn_[i] == 0.0) {
      rate[i] += decay_[i] * x[i];
      continue;
    }
    rate[i] += decay_[i] * x[i] + turn_[i] * x[i + 1];
    rate[i + 1] += decay_[i] * x[i + 1] - turn_[i] * x[i];
    ++i;
  }
}

void RadiatedWater::calc_force(const DraughtShares& shares, ConstVectorRef x,
                               VectorRef force) const {
  force.setZero();
  for (const Section& section : sections_) {
    const double gain = shares.gain[section.draught];
    if (gain == 0.0) continue;
    force.noalias() -= gain * (output_.middleCols(section.first, section.count) *
                               x.segment(section.first, section.count));
  }
}

void RadiatedWater::calc_input(const DraughtShares& shares, MatrixXd& input) const {
  input = input_;
  if (!varies()) return;
  for (const Section& section : sections_) {
    input.middleRows(section.first, section.count) *= shares.gain[section.draught];
  }
}

void RadiatedWater::calc_output(const DraughtShares& shares, MatrixXd& output) const {
  output = output_;
  if (!varies()) return;
  for (const Section& section : sections_) {
    output.middleCols(section.first, section.count) *= shares.gain[section.draught];
  }
}

void RadiatedWater::calc_resolvent(double gamma, Resolvent& resolvent) const {
  const auto a = 1.0 - gamma * decay_.array();
  const auto b = gamma * turn_.array();
  resolvent.straight = a / (a.square() + b.square());
  resolvent.across = b / (a.square() + b.square());
}

void RadiatedWater::apply(const Resolvent& resolvent, const Section& section,
                          Eigen::Ref<MatrixXd> x) const {
  const double* straight = resolvent.straight.data() + section.first;
  const double* across = resolvent.across.data() + section.first;
  for (Eigen::Index column = 0; column < x.cols(); ++column) {
    for (Eigen::Index i = 0; i < section.count; ++i) {
      const double upper = x(i, column);
      if (across[i] == 0.0) {
        x(i, column) = straight[i] * upper;
        continue;
      }
      const double lower = x(i + 1, column);
      x(i, column) = straight[i] * upper + across[i] * lower;
      x(i + 1, column) = straight[i] * lower - across[i] * upper;
      ++i;
    }
  }
}

}  // namespace blocklift::dynamics
