#include "pipeline/assessment/assess.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "parallel/blas_threads.h"
#include "parallel/threads.h"
#include "pipeline/build/history_memory.h"
#include "pipeline/checks/lift_checks.h"
#include "pipeline/checks/measure_checks.h"
#include "pipeline/checks/standard_checks.h"
#include "pipeline/coupling/block_flexibility.h"
#include "pipeline/coupling/block_loads.h"
#include "pipeline/formats/results/preparation.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results/run_identity.h"
#include "pipeline/lift/block_preparation.h"
#include "pipeline/lift/kept_stages.h"
#include "pipeline/lift/stopwatch.h"
#include "pipeline/lift/table_balance.h"
#include "pipeline/report/report.h"
#include "pipeline/results/documents/calculation_package.h"
#include "pipeline/results/documents/mesh_page.h"
#include "pipeline/results/documents/word_document.h"
#include "pipeline/results/files/history_file.h"
#include "pipeline/results/files/lift_scene.h"
#include "pipeline/results/files/result_file.h"
#include "pipeline/results/summaries/mesh_error.h"
#include "pipeline/results/summaries/padeye_summary.h"
#include "pipeline/results/summaries/summary.h"
#include "structure/output/part_files.h"
#include "structure/output/vtu.h"

namespace blocklift::pipeline {

namespace {

namespace fs = std::filesystem;

/// Regions of the shell, each of which takes the water's pressure as one, over the block's length.
constexpr double regions_along_the_shell = 20;

HistorySettings history_settings(const StructureSettings& settings) {
  HistorySettings result;
  for (const Named<Vector3>& point : settings.stress_points)
    result.points.push_back({point.name.value, point.value});
  result.fatigue_curve = settings.fatigue.curve;
  result.stress_concentration = settings.fatigue.stress_concentration;
  result.lifts = settings.fatigue.lifts;
  result.hot_spot_curve = settings.fatigue.hot_spot_curve;
  for (const given::HotSpot& spot : settings.hot_spots)
    result.hot_spots.push_back({spot.name.value, {spot.toe, spot.direction, spot.thickness}});
  return result;
}

std::vector<structure::LiftingPoint> lugs_of(const Assessment& assessment) {
  return assessment.block.model ? assessment.block.model->mesh().lifting_points
                                : vessel_lugs(assessment.lift_case.load);
}

void write_result_file(const Assessment& assessment, const std::string& run, const fs::path& path) {
  ResultsWriter file(path);
  write_case(file, assessment.lift_case.name, assessment.lift_case.title, assessment.lift_case.yaml,
             run);
  write_models(file, assessment.lift_case.model_texts);
  if (assessment.lift) {
    const dynamics::LiftSystem& system = assessment.lift->model.system;
    const Scene scene = make_scene(assessment.lift->model, lugs_of(assessment));
    write_operation(file, system.operation());
    write_history(file, layout::static_history, system, assessment.lift->static_history, scene);
    write_history(file, layout::dynamic_history, system, assessment.lift->dynamic_history(), scene);
    write_measures(file, assessment.measures);
    write_natural_modes(file, system.mechanism(), assessment.lift->natural_modes);
    write_scene(file, system, assessment.lift->dynamic_history(), scene);
    if (assessment.lift_case.compare) write_measured(file, *assessment.lift_case.compare);
  }
  if (assessment.block.model) {
    const structure::Surface surface(*assessment.block.model);
    write_block(file, surface, *assessment.block.responses, assessment.block.assessment);
    if (assessment.block.history)
      write_block_history(file, surface, *assessment.block.responses, *assessment.block.history);
    write_buckling(file, assessment.block.buckling);
    write_padeyes(file, assessment.block.padeyes);
  }
  file.finish();
}

/// Water that presses on the block's shell joins its loads.
void find_pressure(const LiftRun& lift, const structure::ElasticModel& model,
                   structure::UnitResponses& responses, std::optional<PressureBasis>& pressure) {
  const dynamics::HullForce* in_motion = find_hull(lift.model.system, lift.model.load);
  const dynamics::HullForce* at_rest = find_hull(lift.model.at_rest(), lift.model.load);
  if (!in_motion || !at_rest) return;
  const Eigen::Matrix3Xd& nodes = model.space().nodes();
  PressureSettings settings;
  settings.region_size = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).maxCoeff() /
                         regions_along_the_shell;
  pressure = find_pressure_basis(model, *at_rest, lift.static_history, *in_motion,
                                 lift.dynamic_history(), settings);
  if (pressure) responses.add_loads(pressure->loads);
}

/// Ropes that press on the block's edges join its loads.
void find_edges(const LiftRun& lift, const structure::ElasticModel& model,
                structure::UnitResponses& responses, std::optional<EdgeBasis>& edges) {
  edges = find_edge_basis(model, lift.model, lift.static_history, lift.dynamic_history());
  if (edges) responses.add_loads(edges->loads);
}

/// What pulls and presses on a lifted block, at rest and in motion.
BlockLoads loads_on(const LiftRun& lift, const BlockRun& block,
                    const structure::ElasticModel& model) {
  BlockLoads loads(lift.model, lift.static_history, lift.dynamic_history(),
                   model.mesh().lifting_points);
  // In the order in which they joined the unit responses.
  if (block.pressure)
    loads.add(*block.pressure,
              std::vector<int>(static_cast<std::size_t>(block.pressure->count()), -1));
  if (block.edges) loads.add(*block.edges, block.edges->ropes);
  return loads;
}

// Names of what a run that is stopped leaves behind.
constexpr const char* flexibility_part = "flexibility of the block";
constexpr const char* motion_part = "motion";
constexpr const char* refinement_part = "mesh of the block";

void respond(const LiftCase& the_case, const Progress& progress, BlockRun& block) {
  std::optional<parallel::OneBlasThread> whatever_the_threads;
  if (the_case.dynamics.flexibility != Flexibility::rigid) whatever_the_threads.emplace();
  progress("block: stiffness, factorisation, unit responses", 0, "");
  block.responses = make_unit_responses(*block.model, *the_case.load.model);
}

/// How the block gives way; none if it is taken as rigid.
std::optional<LoadFlexibility> find_flexibility(const LiftCase& the_case, const Progress& progress,
                                                UnfinishedRun* unfinished, BlockRun& block) {
  // A rigid block moves without its stiffness: what is wrong with the lift is said sooner.
  if (the_case.dynamics.flexibility == Flexibility::rigid) return std::nullopt;
  if (unfinished)
    if (const auto kept = unfinished->find(flexibility_part)) return flexibility_of(*kept);
  respond(the_case, progress, block);
  const parallel::OneBlasThread whatever_the_threads;
  std::optional<LoadFlexibility> flexibility =
      make_flexibility(*block.responses, the_case.dynamics);
  if (flexibility && unfinished && unfinished->is_due())
    unfinished->keep(flexibility_part, bytes_of_flexibility(*flexibility));
  return flexibility;
}

LiftRun find_motion(const LiftCase& the_case, BuiltLift model, const Progress& progress,
                    UnfinishedRun* unfinished) {
  if (unfinished)
    if (const auto kept = unfinished->find(motion_part)) return motion_of(*kept, std::move(model));
  require_memory(the_case, model);
  LiftRun run = run_lift(the_case, std::move(model), progress);
  if (unfinished && unfinished->is_due()) unfinished->keep(motion_part, bytes_of_motion(run));
  return run;
}

std::optional<KeptRefinement> find_refinement(const UnfinishedRun* unfinished) {
  if (unfinished)
    if (const auto kept = unfinished->find(refinement_part)) return refinement_of(*kept);
  return std::nullopt;
}

/// What is known of the block on the mesh that is begun with, as far as it is needed: its responses
/// and its first elastic period.
void begin_block(const LiftCase& the_case, const std::optional<KeptRefinement>& earlier,
                 const Progress& progress, BlockRun& block) {
  const bool is_first_mesh = !earlier || earlier->state.steps.size() == 1;
  if (is_first_mesh && !block.responses) respond(the_case, progress, block);
  block.first_elastic_period =
      earlier ? earlier->first_elastic_period : find_first_elastic_period(*block.responses);
}

/// Divides elements of a block that was begun until the checked stress stands.
void refine(const LiftCase& the_case,
            const std::function<structure::LoadFactors(const structure::ElasticModel&,
                                                       structure::UnitResponses&)>& factors_of,
            const std::optional<KeptRefinement>& earlier, const Progress& progress,
            UnfinishedRun* unfinished, BlockRun& block) {
  structure::RefinementRecord record;
  if (earlier) record.earlier = &earlier->state;
  if (unfinished) {
    record.after_step = [&](const structure::RefinementState& state) {
      if (unfinished->is_due())
        unfinished->keep(refinement_part, bytes_of_refinement({block.first_elastic_period, state}));
    };
  }
  progress("block: division of elements", 0.4, "");
  structure::RefinedBlock refined = structure::refine_checked_stress(
      std::move(block.model), std::move(block.responses), factors_of,
      {the_case.structure.accuracy, the_case.structure.most_unknowns}, record);
  block.model = std::move(refined.model);
  block.responses = std::move(refined.responses);
  block.accuracy = std::move(refined.accuracy);
}

/// Stresses of a block that was lifted.
void assess_lifted_block(const LiftCase& the_case, const LiftRun& lift,
                         const std::optional<KeptRefinement>& earlier, const Progress& progress,
                         UnfinishedRun* unfinished, BlockRun& block) {
  // The shell's regions, and with them the fields of pressure, follow the mesh; so do edges.
  const auto factors = [&](const structure::ElasticModel& model,
                           structure::UnitResponses& responses) -> structure::LoadFactors {
    find_pressure(lift, model, responses, block.pressure);
    find_edges(lift, model, responses, block.edges);
    const BlockLoads loads = loads_on(lift, block, model);
    return {factors_of(responses, loads.attachment, loads.at_rest),
            factors_of(responses, loads.attachment, loads.in_motion)};
  };
  refine(the_case, factors, earlier, progress, unfinished, block);
  progress("block: stresses", 0.5, "");
  const BlockLoads loads = loads_on(lift, block, *block.model);
  const auto& [attachment, at_rest, in_motion] = loads;
  const structure::StressRecovery recovery(*block.responses);
  block.assessment = assess_block(*block.responses, recovery, attachment, at_rest, in_motion);
  progress("block: every instant", 0.7, "");
  block.history = assess_history(*block.responses, recovery, attachment, at_rest, in_motion,
                                 block.assessment, history_settings(the_case.structure));
  block.stages =
      find_stage_stresses(find_stage_spans(lift), *block.responses, recovery, *block.history);
  progress("block: panels", 0.85, "");
  block.buckling = assess_buckling(the_case, *block.responses, *block.history);
  progress("block: padeyes", 0.9, "");
  block.padeyes = assess_padeyes(the_case, *block.responses, attachment, at_rest, in_motion);
}

/// Refuses a table whose loads at rest cannot hold the block up.
/// @throws InputError at the table.
void require_that_table_lifts(const LiftCase& the_case, const structure::ElasticModel& model) {
  const LoadTable& table = *the_case.load_table;
  Diagnostics diagnostics;
  check_that_table_lifts(
      table, find_table_balance(table, table.static_loads, model, the_case.gravity), diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
}

/// Stresses under a table of loads.
void assess_table(const LiftCase& the_case, const std::optional<KeptRefinement>& earlier,
                  const Progress& progress, UnfinishedRun* unfinished, BlockRun& block) {
  const LoadTable& table = *the_case.load_table;
  const std::vector<structure::LiftingPoint> lugs = block.model->mesh().lifting_points;
  const auto static_forces = table_forces(table, table.static_loads, lugs);
  const auto dynamic_forces = table_forces(table, table.dynamic_loads, lugs);
  const auto factors = [&](const structure::ElasticModel& model,
                           structure::UnitResponses& responses) -> structure::LoadFactors {
    const structure::MassProperties& mass = model.mass_properties();
    return {responses.coefficients(map_load_table(static_forces, lugs, mass)),
            responses.coefficients(map_load_table(dynamic_forces, lugs, mass))};
  };
  refine(the_case, factors, earlier, progress, unfinished, block);
  progress("block: stresses", 0.5, "");
  const structure::StressRecovery recovery(*block.responses);
  block.assessment = assess_load_table(*block.responses, recovery, static_forces, dynamic_forces);
}

/// What errors in the lengths of slings do.
void find_lengths(const LoadMass& load, const LoadFlexibility* flexibility,
                  const Progress& progress, Assessment& assessment) {
  progress("lengths of slings", 0, "");
  assessment.sling_lengths =
      find_sling_lengths(assessment.lift_case, load, flexibility, *assessment.lift);
}

/// Checks of what the motion alone says.
void check_motion(const Progress& progress, Assessment& assessment) {
  const LiftRun& lift = *assessment.lift;
  assessment.checks = check_lift(assessment.lift_case, lift);
  progress("angles, radii, clearances", 0, "");
  assessment.measures = find_measures(assessment.lift_case, lift);
  for (Check& check : check_measures(assessment.lift_case, lift, assessment.measures))
    assessment.checks.push_back(std::move(check));
}

/// The motion of a lift with what follows from it alone, and the block on the mesh that is begun
/// with. Neither needs the other if the block moves as a rigid body: they go side by side.
void lift_and_begin_block(const std::optional<KeptRefinement>& earlier, const Progress& progress,
                          UnfinishedRun* unfinished, const fs::path& cache,
                          Assessment& assessment) {
  const LiftCase& the_case = assessment.lift_case;
  BlockRun& block = assessment.block;
  const std::optional<LoadFlexibility> flexibility =
      find_flexibility(the_case, progress, unfinished, block);
  const LoadFlexibility* const gives_way = flexibility ? &*flexibility : nullptr;
  const LoadMass mass = load_mass(block.model->mass_properties());
  BuiltLift model = prepare_lift(the_case, mass, progress, gives_way, cache);
  const auto lift = [&] {
    assessment.lift = find_motion(the_case, std::move(model), progress, unfinished);
    check_motion(progress, assessment);
    find_lengths(mass, gives_way, progress, assessment);
  };
  // Only one of the two says how far it is.
  const auto begin = [&] {
    begin_block(
        the_case, earlier, [](auto&&...) {}, block);
  };
  parallel::side_by_side(lift, begin);
}

}  // namespace

Assessment assess(LiftCase lift_case, const Progress& progress, UnfinishedRun* unfinished,
                  const fs::path& cache) {
  Stopwatch total;
  Assessment assessment{std::move(lift_case), {}, {}, {}, {}, {}, 0};
  const LiftCase& the_case = assessment.lift_case;

  if (!the_case.has_structure()) {
    assessment.lift = find_motion(
        the_case,
        prepare_lift(the_case, load_mass(the_case.load.vessel->model), progress, nullptr, cache),
        progress, unfinished);
    check_motion(progress, assessment);
    find_lengths(load_mass(the_case.load.vessel->model), nullptr, progress, assessment);
    check_by_standard(assessment);
    assessment.total_s = total.lap();
    return assessment;
  }
  Stopwatch watch;
  BlockRun& block = assessment.block;
  Diagnostics diagnostics;
  block.model = make_block_model(*the_case.load.model, the_case.load.model_name.value,
                                 the_case.structure, diagnostics);
  if (!block.model) throw InputError(diagnostics);
  block.mesh_s = watch.lap();
  if (the_case.load_table) require_that_table_lifts(the_case, *block.model);

  const std::optional<KeptRefinement> earlier = find_refinement(unfinished);
  if (!the_case.load_table) {
    lift_and_begin_block(earlier, progress, unfinished, cache, assessment);
    assess_lifted_block(the_case, *assessment.lift, earlier, progress, unfinished, block);
  } else {
    begin_block(the_case, earlier, progress, block);
    assess_table(the_case, earlier, progress, unfinished, block);
    block.buckling = assess_buckling(the_case, *block.responses, block.assessment);
    block.padeyes = assess_padeyes(the_case, *block.responses, block.assessment);
  }
  block.error = structure::estimate_block_error(
      *block.model, block.responses->displacement(
                        block.history ? block.history->dynamic_state.governing
                                      : block.assessment.simultaneous.dynamic_state.load));
  for (Check& check :
       check_block(the_case, block.assessment, block.history ? &*block.history : nullptr))
    assessment.checks.push_back(std::move(check));
  for (Check& check : check_buckling(the_case, block.buckling))
    assessment.checks.push_back(std::move(check));
  for (Check& check : check_padeyes(the_case, block.padeyes))
    assessment.checks.push_back(std::move(check));
  for (Check& check : assessment.checks)
    if (check.is_by_mesh) note_band(checked_stress_band(block), check);
  check_by_standard(assessment);
  assessment.total_s = total.lap();
  return assessment;
}

void require_writable(const fs::path& folder) {
  const auto refuse = [&](std::string message) {
    Diagnostics diagnostics;
    diagnostics.error({std::make_shared<const std::string>(folder.string()), 0, 0},
                      "results cannot be written here: " + std::move(message),
                      {"name another folder with --output"});
    throw InputError(diagnostics);
  };
  if (folder.empty()) refuse("the name of the folder is empty");
  std::error_code error;
  fs::path existing = fs::absolute(folder, error).lexically_normal();
  while (fs::status(existing, error).type() != fs::file_type::directory) {
    if (fs::exists(existing, error)) refuse(existing.string() + " is no folder");
    const fs::path parent = existing.parent_path();
    if (parent == existing) refuse("it lies nowhere");
    existing = parent;
  }
  if (::access(existing.c_str(), W_OK | X_OK) != 0) {
    refuse(existing.string() + ": " + std::generic_category().message(errno));
  }
  try {
    // Some places forbid what their access rights allow: names too long, file systems of the
    // kernel.
    const Preparation attempt(folder);
  } catch (const fs::filesystem_error& failure) {
    refuse(failure.code().message());
  }
}

namespace {

/// The block's and the padeyes' fields for ParaView.
void write_pictures(const BlockRun& block, const fs::path& folder) {
  if (!block.model) return;
  const LoadComparison& pictured = block.assessment.simultaneous;
  structure::write_vtu(folder / "block-static.vtu", *block.responses, pictured.static_state.load);
  structure::write_vtu(folder / "block-dynamic.vtu", *block.responses, pictured.dynamic_state.load);
  for (const PadeyeAssessment& padeye : block.padeyes.padeyes)
    structure::write_part_vtu(folder / padeye_file(padeye), padeye.model->part(),
                              padeye.model->as_part(padeye.governing_state().result));
}

/// What a run may leave that not every run has: nobody is to sign an earlier run's calculation.
std::vector<std::string> files_of_earlier_runs(const fs::path& folder) {
  std::vector<std::string> names = {
      package_file,       package_word_file,   mesh_page_file,
      abaqus_load_cases,  nastran_load_cases,  load_case_displacements,
      "block-static.vtu", "block-dynamic.vtu", std::string(layout::table_file)};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("lug-") && name.ends_with(".vtu")) names.push_back(name);
  }
  return names;
}

fs::path prepare_results(const Assessment& assessment, const fs::path& folder,
                         const std::vector<LoadCaseFile>& decks) {
  Preparation preparation(folder);
  Stopwatch watch;
  const std::string run = new_run_identity();
  parallel::side_by_side(
      [&] { write_result_file(assessment, run, preparation.folder() / layout::results_file); },
      [&] { write_pictures(assessment.block, preparation.folder()); });

  nlohmann::ordered_json summary = make_summary(assessment);
  summary[layout::run] = run;
  const bool has_mesh = assessment.lift_case.load.model && assessment.lift_case.load.model->mesh;
  if (has_mesh) summary["mesh_page"] = mesh_page_file;  // the report links to it
  const fs::path summary_path = preparation.folder() / layout::summary_file;
  write_file(summary_path, summary.dump(2));
  if (assessment.standard) {
    const TextDocument package = calculation_package(assessment);
    write_file(preparation.folder() / package_file, markdown_of(package));
    write_file(preparation.folder() / package_word_file,
               word_document_of(package, calculation_foot(assessment)));
  }
  if (has_mesh)
    write_file(preparation.folder() / mesh_page_file,
               mesh_page(*assessment.lift_case.load.model->mesh, assessment.lift_case.title));
  for (const LoadCaseFile& deck : decks)
    if (!deck.text.empty()) write_file(preparation.folder() / deck.name, deck.text);
  write_report(preparation.folder());
  summary["timing"]["report_s"] = watch.lap();
  write_file(summary_path, summary.dump(2));
  preparation.move_into_place(files_of_earlier_runs(folder));
  return folder / layout::report_file;
}

}  // namespace

fs::path write_results(const Assessment& assessment, const fs::path& folder,
                       const std::vector<LoadCaseFile>& decks) {
  try {
    return prepare_results(assessment, folder, decks);
  } catch (const fs::filesystem_error& error) {
    throw std::runtime_error(
        fmt::format("{}: cannot write results here: {}", folder.string(), error.code().message()));
  }
}

}  // namespace blocklift::pipeline
