#include "dynamics/marine/radiated_water.h"

#include <cmath>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

const HydrodynamicDatabase& checked(const RadiatedWater::Definition& definition) {
  if (!definition.database) throw ModelError("radiation without a hydrodynamic database");
  const HydrodynamicDatabase& database = *definition.database;
  if (database.body_count() != static_cast<int>(definition.frames.size()) ||
      database.infinite_added_mass.rows() != database.mode_count()) {
    throw ModelError("the hydrodynamic database holds " + std::to_string(database.body_count()) +
                     " bodies, and " + std::to_string(definition.frames.size()) +
                     " float in it; each needs its part");
  }
  return database;
}

// Rows and columns in the order (angular; linear).
Eigen::MatrixXd reordered(const Eigen::MatrixXd& by_modes, bool rows, bool columns) {
  Eigen::MatrixXd result(by_modes.rows(), by_modes.cols());
  for (Eigen::Index j = 0; j < by_modes.cols(); ++j) {
    for (Eigen::Index i = 0; i < by_modes.rows(); ++i) {
      result(rows ? place_of_mode(i) : i, columns ? place_of_mode(j) : j) = by_modes(i, j);
    }
  }
  return result;
}

}  // namespace

RadiatedWater::RadiatedWater(const Definition& definition)
    : RadiatedWater(definition, MemoryStateSpace(checked(definition), definition.memory_tolerance,
                                                 definition.most_states)) {}

RadiatedWater::RadiatedWater(const Definition& definition, const MemoryStateSpace& memory)
    : inertia_(definition.frames, reordered(definition.database->infinite_added_mass, true, true)),
      memory_error_(memory.error()),
      decay_(memory.A().diagonal()),
      turn_(Eigen::VectorXd::Zero(decay_.size())),
      input_(reordered(memory.B(), false, true)),
      output_(reordered(memory.C(), true, false)) {
  for (Eigen::Index i = 0; i + 1 < decay_.size(); ++i) {
    turn_[i] = memory.A()(i, i + 1);
    if (turn_[i] != 0.0) ++i;
  }
  scale_states();
}

RadiatedWater::RadiatedWater(std::vector<BodyFrame> frames,
                             const Eigen::MatrixXd& infinite_added_mass)
    : inertia_(std::move(frames), reordered(infinite_added_mass, true, true)),
      memory_error_(0.0),
      input_(0, infinite_added_mass.rows()),
      output_(infinite_added_mass.rows(), 0) {}

// A steady velocity of 1 (m/s or rad/s) brings no state, or pair, beyond 1.
void RadiatedWater::scale_states() {
  for (Eigen::Index i = 0; i < decay_.size(); ++i) {
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

void RadiatedWater::calc_rate(ConstVectorRef x, ConstVectorRef u, VectorRef rate) const {
  rate.noalias() = input_ * u;
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

void RadiatedWater::solve(double gamma, Eigen::Ref<Eigen::MatrixXd> x) const {
  for (Eigen::Index column = 0; column < x.cols(); ++column) {
    for (Eigen::Index i = 0; i < decay_.size(); ++i) {
      const double a = 1.0 - gamma * decay_[i];
      if (turn_[i] == 0.0) {
        x(i, column) /= a;
        continue;
      }
      const double b = gamma * turn_[i];
      const double determinant = a * a + b * b;
      const double upper = x(i, column), lower = x(i + 1, column);
      x(i, column) = (a * upper + b * lower) / determinant;
      x(i + 1, column) = (a * lower - b * upper) / determinant;
      ++i;
    }
  }
}

}  // namespace blocklift::dynamics
