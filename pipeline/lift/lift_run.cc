#include "pipeline/lift/lift_run.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/simulation/linearisation.h"
#include "dynamics/simulation/tension_peaks.h"
#include "pipeline/build/held_heading.h"
#include "pipeline/hydrodynamics/radiation_cache.h"
#include "pipeline/lift/parallel_baskets.h"
#include "pipeline/lift/sling_ends.h"
#include "pipeline/lift/stage_end.h"
#include "pipeline/lift/stopwatch.h"
#include "pipeline/lift/worst_instant.h"

namespace blocklift::pipeline {

namespace {

const std::string& lug_of(const BuiltLift& model, int rope) {
  const auto found = std::find_if(model.ropes.begin(), model.ropes.end(),
                                  [&](const LiftRope& other) { return other.rope == rope; });
  return found->lug;
}

// The load is the one elastic body of a lift.
void keep_larger(const BuiltLift& model, double time, const dynamics::LiftWorkspace& w,
                 std::optional<LugDisplacement>& largest) {
  const auto& ends = model.system.elastic_bodies().front().definition().ends;
  for (std::size_t end = 0; end < ends.size(); ++end) {
    const double size = dynamics::ElasticBody::displacement(w.elastic.front(), end).norm();
    if (largest && size <= largest->size) continue;
    largest = {lug_of(model, ends[end].rope), size, time};
  }
}

/// What a search for equilibria or a time integration finds. Where it fails, at whatever instant,
/// what the case says against equilibria, or else `otherwise`, goes with the message.
template <typename Find>
auto find_or_say_why(const LiftCase& lift_case, const Find& find,
                     const std::string& otherwise = {}) {
  try {
    return find();
  } catch (const dynamics::SimulationError& error) {
    std::string why = doubt_about_baskets(lift_case);
    if (why.empty()) why = otherwise;
    if (why.empty()) throw;
    throw dynamics::SimulationError(fmt::format("{}. {}", error.what(), why));
  }
}

/// The first equilibrium in which the load hangs and nothing holds it: a motion from there may lead
/// anywhere. Empty if there is none.
std::string tipping_equilibrium(const LiftCase& lift_case, const BuiltLift& model,
                                const dynamics::History& at_rest,
                                const Eigen::VectorXd& righting_height) {
  constexpr double neutral = 1e-3;  // m
  if (!lift_case.supports.empty() || lift_case.ground_contact) return {};
  const double weight = model.system.mechanism().body(model.load).inertia.mass * lift_case.gravity;
  const Eigen::VectorXd borne = load_on_slings(model, at_rest);
  for (Eigen::Index k = 0; k < righting_height.size(); ++k) {
    if (!(righting_height[k] < -neutral) || borne[k] < 0.9 * weight) continue;
    std::string slack;
    for (const LiftRope& rope : model.ropes)
      if (!(at_rest.ropes[rope.rope].tension[k] > 0))
        slack += (slack.empty() ? "; slack there: " : ", ") + rope.name;
    return fmt::format(
        "Nothing holds the load in the equilibrium of {:g} s{}: it tips over or "
        "slides out of its slings once it moves",
        at_rest.time[k], slack);
  }
  return {};
}

}  // namespace

RunExtent operator|(const RunExtent& a, const RunExtent& b) {
  return {a.at_rest || b.at_rest,
          a.natural_modes || b.natural_modes,
          a.energy || b.energy,
          a.righting_height || b.righting_height,
          a.motion || b.motion,
          a.rope_forces || b.rope_forces,
          a.accelerations || b.accelerations};
}

LiftRun run_lift(const LiftCase& lift_case, BuiltLift model, const Progress& progress,
                 const RunExtent& extent) {
  const auto report = [&](const char* stage) {
    return [&progress, stage](double fraction, double time) {
      progress(stage, fraction, fmt::format("t = {:.0f} s", time));
    };
  };
  if (!extent.at_rest && (extent.natural_modes || extent.righting_height))
    throw std::invalid_argument("natural modes and righting heights are found on a sweep at rest");
  const dynamics::LiftSystem& system = model.system;
  const dynamics::LiftSystem& at_rest = model.at_rest();
  Stopwatch watch;
  Eigen::VectorXd times;
  if (extent.at_rest)
    times =
        dynamics::sample_times(system.operation().duration(), lift_case.dynamics.static_interval);
  // Both histories begin at the same equilibrium.
  Eigen::VectorXd q = system.q_start();
  find_or_say_why(lift_case, [&] { solver_at_rest(model).solve(0, q); });
  Eigen::VectorXd righting_height =
      Eigen::VectorXd::Constant(times.size(), std::numeric_limits<double>::quiet_NaN());
  std::function<void(Eigen::Index, double, dynamics::LiftWorkspace&)> observe;
  dynamics::TangentMatrices tangent(at_rest);
  if (extent.righting_height)
    observe = [&](Eigen::Index sample, double time, dynamics::LiftWorkspace& w) {
      righting_height[sample] = dynamics::calc_righting_height(
          at_rest, time, w, model.load, tangent, model.held_heading.has_value());
    };
  dynamics::History static_history = find_or_say_why(lift_case, [&] {
    return dynamics::static_sweep(at_rest, times, q, settings_at_rest(model),
                                  report("static sweep"), observe, extent.recording());
  });
  std::vector<NaturalModes> natural_modes;
  if (extent.natural_modes)
    natural_modes =
        find_natural_modes(model, static_history, q, lift_case.dynamics.static_interval);
  const double static_s = watch.lap();

  dynamics::IntegrationSettings settings;
  settings.relative_tolerance = lift_case.dynamics.relative_tolerance;
  settings.sample_interval = lift_case.dynamics.sample_interval;
  settings.works = extent.energy;
  settings.recording = extent.recording();
  settings.progress = report("time integration");
  std::optional<LugDisplacement> elastic;
  if (!system.elastic_bodies().empty()) {
    settings.observe = [&](Eigen::Index, double time, const dynamics::LiftWorkspace& w) {
      keep_larger(model, time, w, elastic);
    };
  }
  settings.surface = model.marched.radiation.get();
  settings.surface_step = model.marched.step;
  dynamics::IntegrationResult dynamic_result = find_or_say_why(
      lift_case,
      [&] {
        return dynamics::integrate_with_peaks(
            system, q, Eigen::VectorXd::Zero(system.mechanism().nv()), settings);
      },
      extent.righting_height && extent.rope_forces
          ? tipping_equilibrium(lift_case, model, static_history, righting_height)
          : std::string());
  const double dynamic_s = watch.lap();
  return {std::move(model),
          std::move(static_history),
          std::move(dynamic_result),
          static_s,
          dynamic_s,
          std::move(natural_modes),
          std::move(elastic),
          std::move(righting_height)};
}

BuiltLift prepare_lift(const LiftCase& lift_case, const LoadMass& load, const Progress& progress,
                       const LoadFlexibility* flexibility, const std::filesystem::path& cache) {
  const RadiationProblem problem = radiation_problem(lift_case);
  double radiation_share = 0;
  const auto tell = [&](const std::string& what) {
    progress("radiation of vessels", radiation_share, what);
  };
  const auto tell_share = [&](double share, const std::string& what) {
    radiation_share = share;
    tell(what);
  };
  const FoundRadiation radiation = find_radiation(problem, tell, tell_share, cache);
  FoundMotion found;
  const auto build = [&](std::optional<double> fault) {
    found.fault = fault;
    BuiltLift model = build_lift(lift_case, load, radiation.series.get(), flexibility,
                                 find_marched_water(problem), found);
    model.doubts_of_water = radiation.doubts;
    return model;
  };
  for (;;) {
    BuiltLift model = build(std::nullopt);
    const std::optional<std::size_t> waiting = model.schedule.waiting_stage();
    const std::optional<std::size_t> steered = model.schedule.steered_stage();
    if (!waiting && !steered) {
      if (!fault_at_worst(lift_case)) return model;
      const WorstInstant worst = find_or_say_why(
          lift_case, [&] { return find_worst_instant(lift_case, build, progress); });
      BuiltLift disturbed = build(worst.worst.time);
      disturbed.worst = worst;
      return disturbed;
    }
    if (steered && (!waiting || *steered < *waiting)) {
      for (dynamics::Course& course :
           find_or_say_why(lift_case, [&] { return find_courses(lift_case, model, progress); }))
        found.courses.push_back(std::move(course));
    } else {
      found.met.push_back(find_or_say_why(
          lift_case, [&] { return find_stage_end(lift_case, model, *waiting, progress); }));
    }
  }
}

Eigen::VectorXd crane_load(const BuiltLift& model, const dynamics::History& history,
                           std::size_t crane) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(history.sample_count());
  for (const LiftHoist& hoist : model.hoists) {
    if (hoist.crane == crane) load += history.ropes[hoist.rope].tension;
  }
  return load;
}

}  // namespace blocklift::pipeline
