#include "pipeline/simulation/lift_simulation.h"

#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "parallel/blas_threads.h"
#include "pipeline/build/history_memory.h"
#include "pipeline/checks/loop_loads.h"
#include "pipeline/coupling/block_flexibility.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/preparation.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results/run_identity.h"
#include "pipeline/lift/block_preparation.h"
#include "pipeline/report/report.h"
#include "pipeline/results/files/lift_scene.h"
#include "pipeline/results/summaries/summary.h"
#include "pipeline/simulation/mechanism_results.h"
#include "structure/response/elastic_model.h"

namespace blocklift::pipeline {
namespace {

OutputSeries series_of(const std::string& name, const std::string& unit,
                       const Eigen::VectorXd& values) {
  return {name, "", {{"", unit}}, values};
}

/// Tensions, drive positions and loads of loops of the time integration.
std::vector<OutputSeries> table_of(const LiftSimulation& simulation) {
  const dynamics::History& history = simulation.run.dynamic_history();
  std::vector<OutputSeries> series;
  for (const dynamics::RopeHistory& rope : history.ropes) {
    series.push_back(series_of(rope.name + ".tension", "N", rope.tension));
  }
  const dynamics::Mechanism& mechanism = simulation.run.model.system.mechanism();
  const std::vector<int>& driven = mechanism.driven_velocities();
  for (std::size_t i = 0; i < history.drives.size(); ++i) {
    const bool turns = mechanism.angular()[driven[i]] != 0;
    series.push_back(series_of(history.drives[i].name + ".position", turns ? "rad" : "m",
                               history.drives[i].position));
  }
  for (std::size_t i = 0; i < history.loops.size(); ++i) {
    const dynamics::Loop& loop = mechanism.loops()[i];
    series.push_back(
        series_of(loop.name + ".load", loop_load_unit(loop), loop_load(loop, history.loops[i])));
  }
  return series;
}

}  // namespace

void require_motion(const LiftCase& lift_case) {
  if (!lift_case.load_table) return;
  Diagnostics diagnostics;
  diagnostics.error(lift_case.load_table->place,
                    "the case is a load table: it has nothing that moves",
                    {"blocklift assess computes the block's stress under these loads"});
  throw InputError(diagnostics);
}

void require_no_verdict(const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path summary = folder / layout::summary_file;
  if (!std::filesystem::is_regular_file(summary, ignored)) return;
  const auto old = nlohmann::json::parse(read_file(summary), nullptr, false);
  if (!old.is_object() || !old.contains("verdict")) return;
  Diagnostics diagnostics;
  diagnostics.error({std::make_shared<const std::string>(folder.string()), 0, 0},
                    "the folder holds the assessment of a lift, which a simulation would replace",
                    {"name another folder with --output, or remove this one"});
  throw InputError(diagnostics);
}

LiftSimulation simulate_lift(LiftCase lift_case, const Progress& progress, const RunExtent& extent,
                             const std::filesystem::path& cache) {
  if (!lift_case.has_structure()) {
    BuiltLift model =
        prepare_lift(lift_case, load_mass(lift_case.load.vessel->model), progress, nullptr, cache);
    require_memory(lift_case, model);
    LiftRun run = run_lift(lift_case, std::move(model), progress, extent);
    std::vector<structure::LiftingPoint> lugs = vessel_lugs(lift_case.load);
    return {std::move(lift_case), std::move(lugs), std::move(run)};
  }
  Diagnostics diagnostics;
  const auto block = make_block_model(*lift_case.load.model, lift_case.load.model_name.value,
                                      lift_case.structure, diagnostics);
  if (!block) throw InputError(diagnostics);
  std::optional<LoadFlexibility> flexibility;
  if (lift_case.dynamics.flexibility != Flexibility::rigid) {
    progress("block: stiffness, factorisation, unit responses", 0, "");
    const parallel::OneBlasThread whatever_the_threads;
    flexibility =
        make_flexibility(*make_unit_responses(*block, *lift_case.load.model), lift_case.dynamics);
  }
  return simulate_lift(
      std::move(lift_case),
      {load_mass(block->mass_properties()), block->mesh().lifting_points, std::move(flexibility)},
      progress, extent, cache);
}

LiftSimulation simulate_lift(LiftCase lift_case, KnownBlock block, const Progress& progress,
                             const RunExtent& extent, const std::filesystem::path& cache) {
  BuiltLift model = prepare_lift(lift_case, block.mass, progress,
                                 block.flexibility ? &*block.flexibility : nullptr, cache);
  require_memory(lift_case, model);
  LiftRun run = run_lift(lift_case, std::move(model), progress, extent);
  return {std::move(lift_case), std::move(block.lugs), std::move(run)};
}

void write_lift_simulation(const LiftSimulation& simulation, const std::filesystem::path& folder,
                           bool with_csv) {
  const LiftCase& lift_case = simulation.lift_case;
  const dynamics::LiftSystem& system = simulation.run.model.system;
  const Scene scene = make_scene(simulation.run.model, simulation.lugs);
  const std::vector<LiftMeasure> measures = find_measures(lift_case, simulation.run);
  Preparation preparation(folder);
  const std::filesystem::path& aside = preparation.folder();
  ResultsWriter file(aside / layout::results_file);
  const std::string run = new_run_identity();
  write_case(file, lift_case.name, lift_case.title, lift_case.yaml, run);
  write_models(file, lift_case.model_texts);
  write_operation(file, system.operation());
  write_history(file, layout::static_history, system, simulation.run.static_history, scene);
  write_history(file, layout::dynamic_history, system, simulation.run.dynamic_history(), scene);
  write_measures(file, measures);
  write_natural_modes(file, system.mechanism(), simulation.run.natural_modes);
  write_scene(file, system, simulation.run.dynamic_history(), scene);
  if (lift_case.compare) write_measured(file, *lift_case.compare);
  write_statistics(file, simulation.run.dynamic_result.statistics);
  file.finish();
  nlohmann::ordered_json summary = make_simulation_summary(lift_case, simulation.run, measures);
  summary[layout::run] = run;
  write_file(aside / layout::summary_file, summary.dump(2));
  write_report(aside);
  if (with_csv) {
    write_file(aside / layout::table_file,
               csv_text(simulation.run.dynamic_history().time, table_of(simulation)));
  }
  preparation.move_into_place({std::string(layout::table_file)});
}

}  // namespace blocklift::pipeline
