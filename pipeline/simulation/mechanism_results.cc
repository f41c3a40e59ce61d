#include "pipeline/simulation/mechanism_results.h"

#include <span>

#include <nlohmann/json.hpp>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/preparation.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results/run_identity.h"
#include "pipeline/report/report.h"
#include "pipeline/results/summaries/radiation_summary.h"
#include "pipeline/results/summaries/summary.h"
#include "pipeline/simulation/mechanism_scene.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {
namespace {

void write_output(ResultsWriter& results, const OutputSeries& series) {
  const std::string path = layout::join(layout::outputs_group, series.name);
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

void write_results(const MechanismFile& file, const MechanismRun& run, const std::string& identity,
                   const std::filesystem::path& path) {
  const dynamics::LiftSystem& system = run.mechanism.system;
  const Scene scene = make_scene(file, run.mechanism);
  ResultsWriter results(path);
  write_case(results, file.name, file.title, file.yaml, identity);
  write_operation(results, system.operation());
  write_history(results, layout::dynamic_history, system, run.result.history, scene);
  results.write(
      layout::outputs_time,
      std::span<const double>(run.time().data(), static_cast<std::size_t>(run.time().size())),
      {"s", "time of each sample of the outputs"});
  for (const OutputSeries& series : run.outputs) write_output(results, series);
  write_natural_modes(results, system.mechanism(), run.natural_modes);
  write_scene(results, system, run.result.history, scene);
  write_statistics(results, run.result.statistics);
  results.finish();
}

nlohmann::ordered_json make_summary(const MechanismFile& file, const MechanismRun& run,
                                    const std::string& identity) {
  const double duration = run.mechanism.system.operation().duration();
  nlohmann::ordered_json summary{{"case", file.name},
                                 {"title", file.title},
                                 {"program_version", program_version},
                                 {"created", creation_time()},
                                 {std::string(layout::run), identity}};
  if (!run.natural_modes.empty()) {
    summary["natural_periods"] =
        natural_periods_json(run.mechanism.system.mechanism(), run.natural_modes);
  }
  summary["solver"] = solver_json(run.result.statistics, duration, run.elapsed);
  summary["timing"] = {{"dynamic_s", run.elapsed}, {"simulated_s", duration}};
  summary["warnings"] = file.notes;
  for (const std::string& doubt : file.doubts) summary["warnings"].push_back(doubt);
  for (const std::string& doubt : run.doubts) summary["warnings"].push_back(doubt);
  add_radiation(record_radiation(run.mechanism, run.result.history), summary);
  return summary;
}

}  // namespace

void write_statistics(ResultsWriter& file, const dynamics::IntegrationStatistics& s) {
  file.make_group(layout::statistics_group);
  const auto write = [&](const char* name, long value) {
    file.write_attribute(layout::statistics_group, name, static_cast<double>(value));
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
  Preparation preparation(folder);
  const std::filesystem::path& aside = preparation.folder();
  const std::string identity = new_run_identity();
  write_results(file, run, identity, aside / layout::results_file);
  write_file(aside / layout::summary_file, make_summary(file, run, identity).dump(2));
  write_report(aside);
  if (with_csv) write_file(aside / layout::table_file, csv_text(run.time(), run.outputs));
  preparation.move_into_place({std::string(layout::table_file)});
}

}  // namespace blocklift::pipeline
