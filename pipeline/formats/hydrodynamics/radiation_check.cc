#include "pipeline/formats/hydrodynamics/radiation_check.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::modes_per_body;

constexpr std::array<const char*, modes_per_body> mode_names = {"surge", "sway",  "heave",
                                                                "roll",  "pitch", "yaw"};

std::size_t kind_of(Eigen::Index mode) { return mode % modes_per_body < 3 ? 0 : 1; }

std::string name_of(const HydrodynamicDatabase& database, Eigen::Index mode) {
  return fmt::format("{} {}", database.body_names[mode / modes_per_body],
                     mode_names[mode % modes_per_body]);
}

void require_damping(const HydrodynamicDatabase& database) {
  constexpr double noise = 0.01, noise_of_kind = 1e-3;
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(database.mode_count());
  for (const Eigen::MatrixXd& B : database.damping) largest = largest.cwiseMax(B.diagonal());
  std::array<double, 2> of_kind{};
  for (Eigen::Index m = 0; m < largest.size(); ++m)
    of_kind[kind_of(m)] = std::max(of_kind[kind_of(m)], largest[m]);
  for (Eigen::Index m = 0; m < largest.size(); ++m) {
    const double least = -std::max(noise * largest[m], noise_of_kind * of_kind[kind_of(m)]);
    for (std::size_t k = 0; k < database.damping.size(); ++k) {
      const double damping = database.damping[k](m, m);
      if (damping >= least) continue;
      throw dynamics::ModelError(fmt::format(
          "the damping of {} on itself is {:.4g} at {:.4g} rad/s, and {:.4g} at most: below zero, "
          "waves would bring energy",
          name_of(database, m), damping, database.frequencies[k], largest[m]));
    }
  }
}

void require_mass(const HydrodynamicDatabase& database) {
  constexpr double noise = 0.01;
  const auto mass = database.infinite_added_mass.diagonal();
  double largest = 0;
  for (Eigen::Index m = 0; m < mass.size(); ++m)
    if (kind_of(m) == 0) largest = std::max(largest, mass[m]);
  for (Eigen::Index m = 0; m < mass.size(); ++m) {
    if (kind_of(m) != 0 || mass[m] >= -noise * largest) continue;
    throw dynamics::ModelError(fmt::format(
        "the added mass of {} at infinite frequency is {:.4g} kg: below zero, which no body has",
        name_of(database, m), mass[m]));
  }
}

}  // namespace

void require_passive(const HydrodynamicDatabase& database) {
  require_damping(database);
  require_mass(database);
}

std::string doubt_about_memory(const HydrodynamicDatabase& database) {
  constexpr double acceptable = 0.1;
  if (database.added_mass.empty() || database.retardation.empty()) return {};
  const double error = dynamics::calc_memory_error(database);
  if (error <= acceptable) return {};
  return fmt::format(
      "the retardation functions miss added mass and damping by {:.0f} % of the waves' largest "
      "share: mostly the damping has not faded at the last frequency, {:.4g} rad/s, or the "
      "frequencies are far apart; motions are damped otherwise than the database says",
      100 * error, database.frequencies.back());
}

}  // namespace blocklift::pipeline
