#include "pipeline/build/history_memory.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/panels/rankine_problem.h"
#include "structure/limits.h"

namespace blocklift::pipeline {

double sample_count(const HistoryToCome& history) {
  const double peaks =
      history.with_peaks ? static_cast<double>(history.system->ropes().size()) : 0.0;
  return std::floor(history.system->operation().duration() / history.interval - 1e-3) + 2 + peaks;
}

double bytes_of_sample(const dynamics::LiftSystem& system, bool with_works) {
  const dynamics::Mechanism& mechanism = system.mechanism();
  const auto bodies = static_cast<std::size_t>(mechanism.body_count() - 1);  // all but the world
  // Times, kept twice; pose, velocity, acceleration, load; four values and two forces of a rope;
  // position, velocity, force of a drive; the force of a pad. Of an edge its force and seven
  // values. Three values of an elastic mode.
  std::size_t values = 2 + 25 * bodies + 3 * mechanism.elastic_modes().size() +
                       10 * system.ropes().size() + 3 * mechanism.driven_velocities().size() +
                       system.supports().size();
  for (const dynamics::Rope& rope : system.ropes()) values += 10 * rope.edges().size();
  for (const dynamics::Loop& loop : mechanism.loops())
    values += 7 + static_cast<std::size_t>(loop.row_count);
  values += with_works ? 8 : 4;
  return static_cast<double>(sizeof(double) * values);
}

void require_memory(const std::vector<HistoryToCome>& histories) {
  double needed = 0;
  std::string samples, keys;
  for (const HistoryToCome& history : histories) {
    const double count = sample_count(history);
    needed += count * bytes_of_sample(*history.system, history.with_works);
    samples += fmt::format("{}{:.0f} samples every {:g} s", samples.empty() ? "" : " and ", count,
                           history.interval);
    keys += fmt::format("{}`{}`", keys.empty() ? "" : " or ", history.key);
  }
  const double usable = std::min(structure::memory_within_limit(), dynamics::usable_memory());
  if (needed <= usable) return;
  throw dynamics::SimulationError(fmt::format(
      "the histories of {:g} s, {}, need {:.3g} GB of memory, but {:.3g} GB may be used: sample "
      "less often by {}",
      histories.front().system->operation().duration(), samples, needed / 1e9, usable / 1e9, keys));
}

void require_memory(const LiftCase& lift_case, const BuiltLift& model) {
  require_memory(
      {{&model.at_rest(), lift_case.dynamics.static_interval, "dynamics.static_interval"},
       {&model.system, lift_case.dynamics.sample_interval, "dynamics.sample_interval", true,
        true}});
}

}  // namespace blocklift::pipeline
