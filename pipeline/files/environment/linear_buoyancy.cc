#include "pipeline/files/environment/linear_buoyancy.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "pipeline/files/environment/marine_parts.h"

namespace blocklift::pipeline {
namespace {

constexpr std::array<const char*, 6> freedoms = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

bool is_of_buoyancy(std::size_t freedom) { return freedom >= 2 && freedom <= 4; }

void check_matrix_of_buoyancy(const given::LinearBuoyancy& buoyancy, Reading& reading,
                              const Mark&) {
  if (!buoyancy.stiffness) {
    if (buoyancy.about) {
      reading.error(buoyancy.place, "about is given without the stiffness that it is meant for");
    }
    return;
  }
  check_matrix("stiffness", buoyancy.stiffness, stiffness_dimensions, reading);
  const given::FreedomMatrix& rows = buoyancy.stiffness->value;
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t column = 0; column < 6; ++column) {
      if ((is_of_buoyancy(row) && is_of_buoyancy(column)) || rows[row][column].value == 0.0) {
        continue;
      }
      reading.error(buoyancy.stiffness->mark,
                    fmt::format("the stiffness of buoyancy has {:.6g} in row {}, column {} (SI), "
                                "{} by {}; it acts in heave, roll and pitch alone",
                                rows[row][column].value, row + 1, column + 1, freedoms[row],
                                freedoms[column]),
                    {"what moorings do belongs into the vessel's restraint"});
      return;
    }
  }
  check_symmetric(*buoyancy.stiffness, "that of buoyancy and weight always is", reading);
}

/// What of a database's stiffness is more than buoyancy and weight do; empty: nothing.
std::string more_than_buoyancy(const Eigen::MatrixXd& stiffness, Eigen::Index body) {
  const Eigen::Index first = dynamics::modes_per_body * body;
  const Eigen::MatrixXd own = stiffness.block<6, 6>(first, first);
  // A thousandth of the heave's, or of the larger of roll's and pitch's.
  Eigen::Matrix<double, 6, 1> scale;
  const double straight = std::abs(own(2, 2));
  const double turning = std::max({std::abs(own(3, 3)), std::abs(own(4, 4)), straight});
  scale << Eigen::Vector3d::Constant(std::sqrt(straight)),
      Eigen::Vector3d::Constant(std::sqrt(turning));
  for (Eigen::Index row = 0; row < 6; ++row) {
    for (Eigen::Index column = 0; column < 6; ++column) {
      const double least = 1e-3 * scale[row] * scale[column];
      const auto r = static_cast<std::size_t>(row), c = static_cast<std::size_t>(column);
      if (is_of_buoyancy(r) && is_of_buoyancy(c)) {
        if (std::abs(own(row, column) - own(column, row)) <= 2.0 * least) continue;
        return fmt::format("is not symmetric in {} and {}", freedoms[r], freedoms[c]);
      }
      // Off the vertical through the reference point buoyancy and weight turn with the yaw.
      if (c == 5 && (r == 3 || r == 4)) continue;
      if (std::abs(own(row, column)) <= least) continue;
      return fmt::format("has {:.4g} (SI) in {} by {}, where buoyancy has none", own(row, column),
                         freedoms[r], freedoms[c]);
    }
  }
  for (Eigen::Index other = 0; other < stiffness.cols(); other += dynamics::modes_per_body) {
    if (other == first) continue;
    if (stiffness.block<6, 6>(first, other).cwiseAbs().maxCoeff() <= 1e-3 * turning) continue;
    return "couples it to another body";
  }
  return {};
}

void check_database(const given::Vessel& vessel, Diagnostics& diagnostics) {
  const given::LinearBuoyancy& buoyancy = *vessel.linear_buoyancy;
  if (buoyancy.stiffness || !vessel.hydrodynamics) return;
  const Eigen::MatrixXd& stiffness = vessel.hydrodynamics->hydrostatic_stiffness;
  const auto refuse = [&](const std::string& what) {
    diagnostics.error(buoyancy.place,
                      fmt::format("the buoyancy of vessel {} is to be linear, and its database {} "
                                  "{}",
                                  vessel.name.value, vessel.database->value, what),
                      {"give its stiffness here: linear_buoyancy: {stiffness: [...]}"});
  };
  if (stiffness.size() == 0) {
    refuse("has no hydrostatic stiffness");
    return;
  }
  const std::string more = more_than_buoyancy(stiffness, vessel.hydrodynamic_body);
  if (!more.empty()) refuse("holds a stiffness that " + more);
}

}  // namespace

Format<given::LinearBuoyancy> linear_buoyancy_format() {
  Table<given::LinearBuoyancy> table(
      "linear buoyancy",
      "Buoyancy that is linear in heave, roll and pitch about where the vessel floats at the "
      "start, with all of the waves' forces from a database, in place of the pressure on the hull "
      "as it lies at each instant. Weight, and that of what the vessel carries, acts as ever.");
  table
      .optional("stiffness", &given::LinearBuoyancy::stiffness,
                located(matrix_format(stiffness_dimensions)),
                "of buoyancy and weight together, as publications have it: 6 rows of 6 for surge, "
                "sway, heave, roll, pitch, yaw along the vessel's axes, where those of surge, sway "
                "and yaw are 0; the weight is that of the vessel's own mass at its centre of mass. "
                "That of its database if left out, or, computed, of its hull at the start")
      .optional("about", &given::LinearBuoyancy::about, position_format(),
                "point of the vessel's frame for which the stiffness is meant; its centre of mass "
                "if left out")
      .place(&given::LinearBuoyancy::place)
      .rule(check_matrix_of_buoyancy);
  return table.format();
}

void check_linear_buoyancy(const std::vector<given::Vessel>& vessels, bool in_waves,
                           Diagnostics& diagnostics) {
  for (const given::Vessel& vessel : vessels) {
    if (!vessel.linear_buoyancy) continue;
    const Mark& mark = vessel.linear_buoyancy->place;
    const std::string start =
        fmt::format("the buoyancy of vessel {} is to be linear, ", vessel.name.value);
    if (vessel.radiation.value != RadiationMethod::database && in_waves) {
      diagnostics.error(
          mark,
          start +
              fmt::format("and its radiation is {}",
                          vessel.radiation.value == RadiationMethod::direct ? "direct" : "none"),
          {"the waves' forces on it come from a database: radiation: database"});
    }
    if (vessel.draughts) {
      diagnostics.error(mark, start + "and it has draughts, between which it is not linear",
                        {"leave out one of linear_buoyancy and draughts"});
    }
    if (vessel.linear_buoyancy->stiffness && vessel.drift.value != DriftMethod::none &&
        !vessel.database) {
      diagnostics.error(mark,
                        start +
                            "with a stiffness of its own, and its mean drift is computed with "
                            "that of its hull",
                        {"leave out one of stiffness and drift, or name a database that holds "
                         "mean drift forces"});
    }
    check_database(vessel, diagnostics);
  }
}

}  // namespace blocklift::pipeline
