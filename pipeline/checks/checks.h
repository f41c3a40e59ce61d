#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace blocklift::pipeline {

/// One line of the verdict: what the lift asks (demand) against what may be (limit).
struct Check {
  std::string name;             ///< "rope R3: tension against breaking load / 5"
  double demand = 0;            ///< in `unit`
  double limit = 0;             ///< in `unit`
  std::string unit;             ///< SI: "N", "Pa", "rad"
  double utilisation = 0;       ///< 1 is the limit; above it the check fails
  bool pass = false;            ///< false too where the demand is not a number
  std::optional<double> time;   ///< when the demand occurs, s
  std::string note;             ///< where it occurs, or the source of the limit
  bool is_by_mesh = false;      ///< the demand is a stress that the block's mesh gave
  bool is_of_standard = false;  ///< a chain of a standard's factors asks it
  /// Half the width of the band in which the error of that mesh leaves the demand, as a share of
  /// it; none where it does not follow from the mesh.
  std::optional<double> band = {};

  /// The utilisation at the band's lower and upper end. @pre there is a band.
  std::pair<double, double> utilisation_band() const;
};

/// Demand may not exceed the limit: utilisation = demand / limit.
Check check_at_most(std::string name, double demand, double limit, std::string unit);

/// Demand may not fall below the limit (smallest rope tension): utilisation = limit / demand, and
/// beyond any limit where the demand is zero or negative. With a limit of
/// zero the check asks that the demand be positive: a rope that just goes slack fails.
Check check_at_least(std::string name, double demand, double limit, std::string unit);

/// The verdict passes when every check does.
bool all_pass(const std::vector<Check>& checks);

/// The check with the largest utilisation; null without checks.
const Check* governing_check(const std::vector<Check>& checks);

/// One sentence a failed check, or one that names the governing check when all pass.
std::vector<std::string> verdict_reasons(const std::vector<Check>& checks);

}  // namespace blocklift::pipeline
