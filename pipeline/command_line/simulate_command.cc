#include "pipeline/command_line/simulate_command.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/assessment/assess.h"
#include "pipeline/build/build_mechanism.h"
#include "pipeline/build/keel_clearance.h"
#include "pipeline/command_line/held_signals.h"
#include "pipeline/declaration/asked_changes.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/files/environment/sea_band.h"
#include "pipeline/files/environment/wave_headings.h"
#include "pipeline/files/file_kind.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results/summary_file.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/results/summaries/radiation_summary.h"
#include "pipeline/simulation/lift_simulation.h"
#include "pipeline/simulation/mechanism_results.h"
#include "pipeline/terminal/progress_bar.h"
#include "pipeline/terminal/run_log.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {

namespace {

namespace fs = std::filesystem;

/// The folder of the results, asked for before the run.
fs::path result_folder(const SimulateOptions& options, const std::string& name) {
  fs::path folder = options.output ? fs::path(*options.output) : fs::path("results") / name;
  require_writable(folder);
  require_no_verdict(folder);
  return folder;
}

void print_statistics(const dynamics::IntegrationStatistics& statistics, double seconds) {
  fmt::print("{} steps, {} right-hand sides, {} Jacobians, {:.3g} s\n", statistics.steps,
             statistics.right_hand_sides + statistics.difference_right_hand_sides,
             statistics.jacobians, seconds);
}

void print_files(const fs::path& folder, bool csv) {
  if (is_quiet()) return;
  fmt::print("results: {}\n", (folder / "results.h5").string());
  if (csv) fmt::print("table: {}\n", (folder / "results.csv").string());
  fmt::print("report: {}\n", (folder / "report.html").string());
}

void print_rope_use(const MechanismFile& file, const MechanismRun& run) {
  for (const OutputModel& output : file.outputs) {
    const given::Rope* rope = output.rope ? file.find_rope(output.rope->value) : nullptr;
    const bool tension = rope && (!output.quantity || output.quantity->value == "tension");
    if (!tension || !(rope->rope.breaking_load > 0)) continue;
    for (const OutputSeries& series : run.outputs) {
      if (series.name != output.name.value) continue;
      fmt::print("rope {}: at most {:.1f} % of its breaking load\n", rope->name.value,
                 100 * series.values.maxCoeff() / rope->rope.breaking_load);
    }
  }
}

void print_mechanism(const MechanismFile& file, const MechanismRun& run) {
  if (is_quiet()) return;
  for (const std::string& finding : run.findings) print_wrapped("loops: " + finding);
  fmt::print("{}\n\n{}\n", file.title.empty() ? file.name : file.title,
             extremes_table(run.time(), run.outputs));
  print_rope_use(file, run);
  if (const std::string sea = describe_sea(file, -file.gravity.z()); !sea.empty())
    print_wrapped(sea);
  if (!run.natural_modes.empty()) {
    print_wrapped(describe_natural_periods(run.natural_modes.front()));
  }
  fmt::print("{}", misplacement_notice(record_radiation(run.mechanism, run.result.history)));
  print_statistics(run.result.statistics, run.elapsed);
}

fs::path cache_of(const SimulateOptions& options) {
  return options.anew ? no_cache() : cache_folder();
}

int simulate_mechanism(const SimulateOptions& options) {
  ModelLibrary library = ModelLibrary::of_installation();
  library.set_changes(read_asked_changes(options.set));
  Diagnostics diagnostics;
  const auto file = read_mechanism(options.path, library, diagnostics);
  if (!file) throw InputError(diagnostics);
  const fs::path folder = result_folder(options, file->name);
  if (!is_quiet())
    for (const std::string& note : file->notes) print_wrapped("note: " + note);
  for (const std::string& doubt : file->doubts) say_warning(doubt);
  for (const std::string& doubt :
       {doubt_about_headings(*file), doubt_about_keels(radiation_problem(*file))}) {
    if (!doubt.empty()) say_warning(doubt);
  }
  auto bar = std::make_unique<ProgressBar>("time integration");
  const MechanismRun run = run_mechanism(
      *file,
      [&](double fraction, double time) { bar->show(fraction, fmt::format("t = {:.3g} s", time)); },
      cache_of(options));
  bar.reset();
  for (const std::string& doubt : run.doubts) say_warning(doubt);
  {
    const HeldSignals until_all_is_in_place;
    write_mechanism_results(*file, run, folder, options.csv);
  }
  print_mechanism(*file, run);
  print_files(folder, options.csv);
  return exit_code::done;
}

void print_lift(const LiftSimulation& simulation) {
  if (is_quiet()) return;
  fmt::print("{}\n\n", simulation.lift_case.title);
  const auto at_rest = dynamics::find_largest_tensions(simulation.run.static_history);
  const auto in_motion = dynamics::find_largest_tensions(simulation.run.dynamic_history());
  TextTable table({{"rope"}, {"static t", 4}, {"at s", 4}, {"dynamic t", 4}, {"at s", 4}});
  for (std::size_t i = 0; i < at_rest.size(); ++i)
    table.add_row({simulation.run.static_history.ropes[i].name,
                   at_rest[i].tension / newton_per_tonne, at_rest[i].time,
                   in_motion[i].tension / newton_per_tonne, in_motion[i].time});
  fmt::print("{}\n", table.text());
  if (const std::string sea = describe_sea(simulation.lift_case, simulation.lift_case.gravity);
      !sea.empty())
    print_wrapped(sea);
  if (!simulation.run.natural_modes.empty()) {
    print_wrapped(describe_natural_periods(simulation.run.natural_modes.front()));
  }
  print_statistics(simulation.run.dynamic_result.statistics, simulation.run.dynamic_s);
}

int simulate_lift_case(const SimulateOptions& options) {
  LiftCase lift_case = read_lift_case(options.path, read_asked_changes(options.set));
  require_motion(lift_case);
  const fs::path folder = result_folder(options, lift_case.name);
  std::unique_ptr<ProgressBar> bar;
  std::string shown;
  const LiftSimulation simulation = simulate_lift(
      std::move(lift_case),
      [&](const std::string& stage, double fraction, const std::string& detail) {
        if (stage != shown) {
          bar.reset();
          bar = std::make_unique<ProgressBar>(stage);
          shown = stage;
        }
        bar->show(fraction, detail);
      },
      {}, cache_of(options));
  bar.reset();
  {
    const HeldSignals until_all_is_in_place;
    write_lift_simulation(simulation, folder, options.csv);
  }
  const nlohmann::ordered_json summary = read_summary(folder / layout::summary_file);
  for (const auto& warning : summary.value("warnings", nlohmann::ordered_json::array()))
    say_warning(warning.get<std::string>());
  print_lift(simulation);
  print_files(folder, options.csv);
  return exit_code::done;
}

}  // namespace

int simulate_file(const SimulateOptions& options) {
  const FileKind kind = kind_of_file(options.path);
  if (kind == FileKind::robot) refuse_asked_changes(options.path, options.set);
  if (kind == FileKind::mechanism || kind == FileKind::robot) return simulate_mechanism(options);
  // The reader of cases says what a study is.
  if (kind == FileKind::lift_case || kind == FileKind::study) return simulate_lift_case(options);
  Diagnostics diagnostics;
  diagnostics.error({std::make_shared<const std::string>(options.path), 0, 0},
                    "this file describes a part, which does nothing by itself",
                    {"simulate takes a mechanism file, a robot description (URDF) or a lift case; "
                     "a crane moves in a lift case that names it"});
  throw InputError(diagnostics);
}

}  // namespace blocklift::pipeline
