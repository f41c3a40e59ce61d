#include "pipeline/simulation/mechanism_run.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dynamics/multibody/loop_diagnosis.h"
#include "dynamics/simulation/equilibrium.h"
#include "pipeline/build/history_memory.h"
#include "pipeline/hydrodynamics/radiation_cache.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {

namespace {

/// Where the motion begins.
Eigen::VectorXd start_of(const MechanismFile& file, const BuiltMechanism& mechanism) {
  Eigen::VectorXd q = mechanism.system.q_start();
  if (file.simulate.start == Start::equilibrium)
    dynamics::EquilibriumSolver(mechanism.at_rest()).solve(0, q);
  return q;
}

dynamics::IntegrationSettings settings_of(const MechanismFile& file,
                                          const BuiltMechanism& mechanism) {
  dynamics::IntegrationSettings settings;
  settings.relative_tolerance = file.simulate.relative_tolerance;
  settings.sample_interval = file.sample_interval();
  settings.surface = mechanism.marched.radiation.get();
  settings.surface_step = mechanism.marched.step;
  return settings;
}

/// How steered drives went until a move that leads on from there to a place of its own, whose way
/// is not known before.
std::vector<dynamics::Course> find_courses(const MechanismFile& file,
                                           const BuiltMechanism& mechanism) {
  const Schedule& schedule = mechanism.schedule;
  const std::size_t last = schedule.last_known_stage();
  dynamics::IntegrationSettings settings = settings_of(file, mechanism);
  settings.end = schedule.stages[last].end;
  dynamics::IntegrationResult result = dynamics::integrate(
      mechanism.system, start_of(file, mechanism), mechanism.system.v_start(), settings);
  const auto known = [&](const ScheduledSteering& one) { return !one.course && one.stage <= last; };
  result.courses.resize(std::ranges::count_if(schedule.steerings, known));
  return std::move(result.courses);
}

}  // namespace

MechanismRun run_mechanism(const MechanismFile& file,
                           const std::function<void(double, double)>& progress,
                           const std::filesystem::path& cache) {
  const auto start = std::chrono::steady_clock::now();
  const RadiationProblem problem = radiation_problem(file);
  FoundRadiation radiation = find_radiation(problem, {}, {}, cache);
  const auto build = [&](const FoundMotion& found) {
    return build_mechanism(file, radiation.series.get(), find_marched_water(problem), found);
  };
  FoundMotion found;
  BuiltMechanism mechanism = build(found);
  while (mechanism.schedule.provisional_from) {
    for (dynamics::Course& course : find_courses(file, mechanism))
      found.courses.push_back(std::move(course));
    mechanism = build(found);
  }
  std::vector<NaturalModes> natural_modes;
  std::vector<std::string> findings;
  const dynamics::LiftSystem& system = mechanism.system;
  require_memory({{&system, file.sample_interval(), "simulate.sample_interval", true}});
  Eigen::VectorXd q = system.q_start();
  if (file.simulate.start == Start::equilibrium) {
    dynamics::EquilibriumSolver solver(mechanism.at_rest());
    solver.solve(0, q);
    natural_modes.push_back(
        {"start", dynamics::linearise(mechanism.at_rest(), 0, solver.workspace())});
  }
  if (!system.mechanism().loops().empty()) {
    findings = dynamics::diagnose_loops(system.mechanism(), q).sentences(system.mechanism());
  }
  dynamics::IntegrationSettings settings = settings_of(file, mechanism);
  settings.progress = progress;
  const Eigen::Index samples =
      dynamics::sample_times(system.operation().duration(), settings.sample_interval).size();
  OutputRecorder recorder(file, mechanism, samples);
  settings.observe = [&](Eigen::Index sample, double t, const dynamics::LiftWorkspace& w) {
    recorder.observe(sample, t, w);
  };
  dynamics::IntegrationResult result = dynamics::integrate(system, q, system.v_start(), settings);
  std::vector<OutputSeries> outputs = recorder.finish(result.history);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {std::move(mechanism),     std::move(result),   std::move(outputs),
          std::move(natural_modes), std::move(findings), std::move(radiation.doubts),
          elapsed.count()};
}

std::string csv_text(const Eigen::VectorXd& time, const std::vector<OutputSeries>& outputs) {
  // A name with a comma (a direction in a loop's row) is quoted, as RFC 4180 has it.
  const auto cell = [](const std::string& text) {
    return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
  };
  std::string text = "time [s]";
  for (const OutputSeries& series : outputs) {
    for (std::size_t i = 0; i < series.columns.size(); ++i) {
      text += "," + cell(fmt::format("{} [{}]", series.column_name(i), series.columns[i].unit));
    }
  }
  text += "\n";
  for (Eigen::Index k = 0; k < time.size(); ++k) {
    text += fmt::format("{}", time[k]);
    for (const OutputSeries& series : outputs) {
      for (Eigen::Index i = 0; i < series.values.cols(); ++i) {
        text += fmt::format(",{}", series.values(k, i));
      }
    }
    text += "\n";
  }
  return text;
}

std::string extremes_table(const Eigen::VectorXd& time, const std::vector<OutputSeries>& outputs) {
  TextTable table(
      {{"output"}, {"unit"}, {"smallest", 1}, {"at s", 5}, {"largest", 1}, {"at s", 5}});
  for (const OutputSeries& series : outputs) {
    for (std::size_t i = 0; i < series.columns.size(); ++i) {
      const auto column = series.values.col(i);
      Eigen::Index low = 0, high = 0;
      const double smallest = column.minCoeff(&low);
      const double largest = column.maxCoeff(&high);
      // Rows have units of their own, so that no decimals serve them all.
      table.add_row({series.column_name(i), series.columns[i].unit, format_figure(smallest, 6),
                     time[low], format_figure(largest, 6), time[high]});
    }
  }
  return table.text();
}

}  // namespace blocklift::pipeline
