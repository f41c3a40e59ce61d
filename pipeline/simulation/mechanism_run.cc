#include "pipeline/simulation/mechanism_run.h"

#include <algorithm>
#include <chrono>
#include <span>

#include <fmt/format.h>

#include "dynamics/multibody/loop_diagnosis.h"
#include "dynamics/simulation/equilibrium.h"
#include "pipeline/assessment/radiation_cache.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results_layout.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {
namespace {

constexpr auto mechanism_group = "/mechanism";
constexpr auto outputs_group = "/outputs";
constexpr auto statistics_group = "/statistics";

}  // namespace

MechanismRun run_mechanism(const MechanismFile& file,
                           const std::function<void(double, double)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  const auto database = find_radiation(radiation_problem(file), {});
  const BuiltMechanism mechanism = build_mechanism(file, database.get());
  const dynamics::LiftSystem& system = mechanism.system;
  MechanismRun run;
  Eigen::VectorXd q = system.q_start();
  if (file.simulate.start == Start::equilibrium) {
    dynamics::EquilibriumSolver(mechanism.at_rest()).solve(0, q);
  }
  if (!system.mechanism().loops().empty()) {
    run.findings = dynamics::diagnose_loops(system.mechanism(), q).sentences(system.mechanism());
  }
  dynamics::IntegrationSettings settings;
  settings.relative_tolerance = file.simulate.relative_tolerance;
  settings.sample_interval = file.sample_interval();
  settings.progress = progress;
  const Eigen::Index samples =
      dynamics::sample_times(system.operation().duration(), settings.sample_interval).size();
  OutputRecorder recorder(file, mechanism, samples);
  settings.observe = [&](Eigen::Index sample, double t, const dynamics::LiftWorkspace& w) {
    recorder.observe(sample, t, w);
  };
  const dynamics::IntegrationResult result =
      dynamics::integrate(system, q, system.v_start(), settings);
  run.time = result.history.time;
  run.outputs = recorder.finish(result.history);
  run.statistics = result.statistics;
  run.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

void write_statistics(ResultsWriter& file, const dynamics::IntegrationStatistics& s) {
  file.make_group(statistics_group);
  const auto write = [&](const char* name, long value) {
    file.write_attribute(statistics_group, name, static_cast<double>(value));
  };
  write("steps", s.steps);
  write("right_hand_sides", s.right_hand_sides);
  write("difference_right_hand_sides", s.difference_right_hand_sides);
  write("jacobians", s.jacobians);
  write("factorisations", s.factorisations);
  write("newton_iterations", s.newton_iterations);
  write("error_test_failures", s.error_test_failures);
  write("nonlinear_failures", s.nonlinear_failures);
  write("restarts", s.restarts);
  write("contact_changes", s.contact_changes);
}

void write_mechanism_results(const MechanismFile& file, const MechanismRun& run,
                             const std::filesystem::path& folder, bool with_csv) {
  ResultsWriter results(folder / layout::results_file);
  results.make_group(mechanism_group);
  results.write_attribute(mechanism_group, "name", file.name);
  results.write_attribute(mechanism_group, "title", file.title);
  results.write_attribute(mechanism_group, "program_version", program_version);
  results.write_text(std::string(mechanism_group) + "/yaml", file.yaml, "the mechanism file");
  results.write("/time",
                std::span<const double>(run.time.data(), static_cast<std::size_t>(run.time.size())),
                {"s", "time of each sample"});
  for (const OutputSeries& series : run.outputs) {
    const std::string path = layout::join(outputs_group, series.name);
    const Meaning meaning{series.units(), series.description};
    if (series.columns.size() == 1) {
      const Eigen::VectorXd values = series.values.col(0);
      results.write(path,
                    std::span<const double>(values.data(), static_cast<std::size_t>(values.size())),
                    meaning);
    } else {
      results.write_matrix(path, series.values, meaning);
    }
    std::string names;
    for (const OutputColumn& column : series.columns) {
      names += (names.empty() ? "" : ", ") + column.name;
    }
    if (!names.empty()) results.write_attribute(path, "columns", names);
  }
  write_statistics(results, run.statistics);
  results.finish();
  if (with_csv) write_file(folder / "results.csv", csv_text(run.time, run.outputs));
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
  std::size_t width = 6;
  for (const OutputSeries& series : outputs) {
    for (std::size_t i = 0; i < series.columns.size(); ++i) {
      width = std::max(width, series.column_name(i).size());
    }
  }
  std::string text = fmt::format("{:<{}}  {:<8}{:>14}{:>12}{:>14}{:>12}\n", "output", width, "unit",
                                 "smallest", "at s", "largest", "at s");
  for (const OutputSeries& series : outputs) {
    for (std::size_t i = 0; i < series.columns.size(); ++i) {
      const auto column = series.values.col(static_cast<Eigen::Index>(i));
      Eigen::Index low = 0, high = 0;
      const double smallest = column.minCoeff(&low);
      const double largest = column.maxCoeff(&high);
      text +=
          fmt::format("{:<{}}  {:<8}{:>14.6g}{:>12.6g}{:>14.6g}{:>12.6g}\n", series.column_name(i),
                      width, series.columns[i].unit, smallest, time[low], largest, time[high]);
    }
  }
  return text;
}

}  // namespace blocklift::pipeline
