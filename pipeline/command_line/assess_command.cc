#include "pipeline/command_line/assess_command.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/command_line/expect_command.h"
#include "pipeline/command_line/freed_memory.h"
#include "pipeline/command_line/held_signals.h"
#include "pipeline/command_line/progress_line.h"
#include "pipeline/comparison/expected_figures.h"
#include "pipeline/declaration/asked_changes.h"
#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/files/lift_case/input_hash.h"
#include "pipeline/formats/content_hash.h"
#include "pipeline/formats/results/preparation.h"
#include "pipeline/formats/results/results_folder.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results/summary_file.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/processes/processor.h"
#include "pipeline/report/lift_frames.h"
#include "pipeline/report/report.h"
#include "pipeline/results/files/load_case_decks.h"
#include "pipeline/results/summaries/mesh_error.h"
#include "pipeline/results/summaries/standard_summary.h"
#include "pipeline/results/summaries/table_summary.h"
#include "pipeline/terminal/run_log.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {

namespace {

/// None for a rope that is slack at rest.
double ratio_of(double dynamic, double at_rest) {
  return at_rest > 0 ? dynamic / at_rest : std::numeric_limits<double>::quiet_NaN();
}

/// "1400 (+0.3 %)": a published load and how far ours is off.
std::string published_text(const std::optional<double>& published, double ours) {
  if (!published) return "-";
  return fmt::format("{} ({:+.1f} %)", format_figure(*published / newton_per_tonne, 3),
                     100 * (ours / *published - 1));
}

/// "+23.2"; "-0.0" would read as a sign of something.
std::string change_text(double percent) {
  return fmt::format("{:+.1f}", std::abs(percent) < 0.05 ? 0 : percent);
}

void print_loads(const LiftRun& lift, const LiftCase& lift_case) {
  const auto at_rest = dynamics::find_largest_tensions(lift.static_history);
  const auto in_motion = dynamics::find_largest_tensions(lift.dynamic_history());
  const auto published = [&](const std::string& rope) -> const PublishedLoads* {
    if (!lift_case.compare) return nullptr;
    for (const auto& row : lift_case.compare->ropes) {
      if (row.name.value == rope) return &row.value;
    }
    return nullptr;
  };
  std::vector<TableColumn> columns = {{"rope"}, {"static t", 4}, {"dynamic t", 4}, {"ratio", 4}};
  if (lift_case.compare) {
    columns.push_back({"published static t"});
    columns.push_back({"dynamic t"});
  }
  TextTable table(std::move(columns));
  for (const LiftRope& line : lift.model.ropes) {
    const auto rope = static_cast<std::size_t>(line.rope);
    const double still = at_rest[rope].tension, moving = in_motion[rope].tension;
    std::vector<TextTable::Cell> row = {line.name, still / newton_per_tonne,
                                        moving / newton_per_tonne, ratio_of(moving, still)};
    if (const PublishedLoads* figures = published(line.name)) {
      row.emplace_back(published_text(figures->static_load, still));
      row.emplace_back(published_text(figures->dynamic_load, moving));
    }
    table.add_row(std::move(row));
  }
  fmt::print("\n{}", table.text());
}

/// What errors in the lengths of slings do, and the lengths that hang the load level.
void print_sling_lengths(const SlingLengths& lengths) {
  if (!lengths.trouble.empty()) {
    print_wrapped("what the lengths of slings do was not found: " + lengths.trouble);
    return;
  }
  TextTable table({{"sling"},
                   {"length m"},
                   {"at rest t", 4},
                   {"one off t", 4},
                   {"worst set t", 4},
                   {"level by m"},
                   {"then t", 4}});
  for (Eigen::Index i = 0; i < lengths.lengths.size(); ++i) {
    double largest = 0;
    for (const SlingLengthError& error : lengths.errors)
      largest = std::max({largest, error.longer.tensions[i], error.shorter.tensions[i]});
    std::vector<TextTable::Cell> row = {
        lengths.slings[i], fmt::format("{:.3f}", lengths.lengths[i]),
        lengths.meant.tensions[i] / newton_per_tonne, largest / newton_per_tonne};
    row.emplace_back(lengths.worst_tensions.size() > 0
                         ? TextTable::Cell(lengths.worst_tensions[i] / newton_per_tonne)
                         : TextTable::Cell("-"));
    const bool has_level = lengths.level_lengths.size() > 0;
    row.emplace_back(has_level ? fmt::format("{:.3f}", lengths.level_lengths[i]) : "-");
    row.emplace_back(has_level ? TextTable::Cell(lengths.level.tensions[i] / newton_per_tonne)
                               : TextTable::Cell("-"));
    table.add_row(std::move(row));
  }
  fmt::print("\nslings at {:.1f} s, their lengths off by {:.2f} %\n{}", lengths.time,
             100 * lengths.tolerance, table.text());
}

/// The load's own slow motions at the start, and what the integration cost.
void print_motion(const LiftRun& lift) {
  if (!lift.natural_modes.empty()) {
    fmt::print("\n");
    print_wrapped(describe_natural_periods(lift.natural_modes.front()));
  }
  const dynamics::IntegrationStatistics& cost = lift.dynamic_result.statistics;
  fmt::print("time integration: {} steps, {} right-hand sides, {} Jacobians\n", cost.steps,
             cost.right_hand_sides, cost.jacobians);
}

/// The largest checked stress of each stage of the operation.
void print_stages(const std::vector<StageStress>& stages) {
  if (stages.size() < 2) return;
  TextTable table({{"stage"}, {"static MPa", 4}, {"dyn. MPa", 4}, {"%", 3}, {"at s", 4}, {"in"}});
  for (const StageStress& stage : stages)
    table.add_row({stage.stage, stage.at_rest.at.value / 1e6, stage.in_motion.at.value / 1e6,
                   stage.increase_percent ? change_text(*stage.increase_percent) : "-",
                   stage.in_motion.time, stage.in_motion.at.part});
  fmt::print(
      "\nchecked von Mises stress stage by stage, when and where it is largest in motion\n{}",
      table.text());
}

void print_block(const BlockRun& run) {
  const BlockAssessment& block = run.assessment;
  const HistoryAssessment* history = run.history ? &*run.history : nullptr;
  TextTable table({{"block"},
                   {"static MPa", 4},
                   {"dyn. MPa", 4},
                   {"%", 3},
                   {"static mm", 4},
                   {"dyn. mm", 4},
                   {"%", 3}});
  const auto add_way = [&](const char* name, const LoadComparison& way) {
    table.add_row({name, way.static_state.result.checked_von_mises.value / 1e6,
                   way.dynamic_state.result.checked_von_mises.value / 1e6,
                   change_text(way.stress_increase_percent()), 1e3 * way.static_displacement,
                   1e3 * way.dynamic_displacement,
                   change_text(way.deformation_increase_percent())});
  };
  if (block.simultaneous_by_rope.empty()) {
    add_way("loads of the table", block.simultaneous);
  } else {
    add_way("simultaneous", block.simultaneous);
    add_way("ropes at their maxima", block.per_rope_maxima);
  }
  if (history && !block.simultaneous_by_rope.empty()) {
    const HistoryState &at_rest = history->static_state, &in_motion = history->dynamic_state;
    table.add_row({"the whole lift", at_rest.checked_von_mises.at.value / 1e6,
                   in_motion.checked_von_mises.at.value / 1e6,
                   change_text(history->stress_increase_percent()),
                   1e3 * at_rest.displacement.at.value, 1e3 * in_motion.displacement.at.value,
                   change_text(history->deformation_increase_percent())});
  }
  fmt::print("\nchecked von Mises stress and displacement, at rest and in motion\n{}",
             table.text());
  if (history && !block.simultaneous_by_rope.empty())
    print_wrapped(
        fmt::format("every rope at its maximum gives {} % of the largest stress, {} % where it is "
                    "furthest off",
                    change_text(history->per_rope_maxima.largest_percent),
                    change_text(history->per_rope_maxima.worst_percent)));
}

void print_accuracy(const structure::CheckedAccuracy& accuracy) {
  if (accuracy.steps.size() < 2) {
    print_wrapped("checked stress of one mesh only: how far it moves with the mesh is not known");
    return;
  }
  print_wrapped(fmt::format(
      "the last of {} meshes moved the checked stress by {:.1f} % and its increase by {:.1f} "
      "points{}",
      accuracy.steps.size(), 100 * accuracy.stress_change(), 100 * accuracy.increase_change(),
      accuracy.is_reached ? "" : ": the accuracy that is asked for is not reached"));
}

void print_padeyes(const std::vector<PadeyeAssessment>& padeyes) {
  if (padeyes.empty()) return;
  TextTable table({{"padeye"},
                   {"plate MPa", 4},
                   {"cheeks MPa", 4},
                   {"worst use", 3},
                   {"by the formula"},
                   {"governing state"}});
  for (const PadeyeAssessment& padeye : padeyes) {
    const PadeyeState& state = padeye.governing_state();
    const structure::PadeyeFormula& worst = padeye.worst_formula().formula;
    table.add_row({padeye.lug, state.result.main_plate.checked_von_mises.value / 1e6,
                   state.result.cheeks.checked_von_mises.value / 1e6, worst.utilisation, worst.name,
                   state.name});
  }
  fmt::print("\n{}", table.text());
}

void print_mesh_error(const BlockRun& block) {
  if (block.error.worst_part.empty()) {
    print_wrapped(
        "the block is of bars alone, whose elements hold end loads and even loads exactly");
    return;
  }
  print_accuracy(block.accuracy);
  print_wrapped(fmt::format("checked stresses stand within {:.1f} % by the error of the mesh",
                            100 * checked_stress_band(block)));
  print_wrapped(fmt::format(
      "estimated error of the stress field {:.1f} % in the energy norm, most of it in {}",
      100 * block.error.relative, block.error.worst_part));
}

void print_details(const BlockRun& block) {
  print_mesh_error(block);
  if (!block.buckling.panels.empty()) {
    const BuckledPanel& worst = block.buckling.panels.front();
    print_wrapped(fmt::format("nearest to buckling of {} panels: {:.2f} (elastic {:.2f}) in {}",
                              block.buckling.panels.size(), worst.worst.utilisation.critical,
                              worst.worst.utilisation.elastic, worst.panel.plate));
  }
  if (!block.buckling.bars.empty()) {
    const BuckledBar& worst = block.buckling.bars.front();
    print_wrapped(
        fmt::format("bars and stiffeners as columns, {} spans: {:.2f} under {:g} times the "
                    "forces in {}",
                    block.buckling.bars.size(), worst.worst.utilisation, block.buckling.bar_factor,
                    worst.span.bar));
  }
  print_padeyes(block.padeyes.padeyes);
}

void print_checks(const Assessment& assessment) {
  fmt::print("\n");
  for (const std::string& reason : verdict_reasons(assessment.checks)) print_wrapped(reason);
  const std::string indicative = why_indicative(assessment);
  const std::string verdict = fmt::format("verdict: {}{}", assessment.pass() ? "pass" : "FAIL",
                                          indicative.empty() ? "" : ", indicative: " + indicative);
  print_wrapped(verdict);
  log_entry(verdict);
}

void print_decks(const std::vector<LoadCaseFile>& files, const std::filesystem::path& folder) {
  if (is_quiet()) return;
  if (files.empty()) fmt::print("no decks: the load has no block whose stress is asked\n");
  for (const LoadCaseFile& file : files)
    fmt::print("{}\n", file.refusal.empty()
                           ? "load cases: " + (folder / file.name).string()
                           : fmt::format("{} is not written: {}", file.name, file.refusal));
}

void print_results(const Assessment& assessment) {
  if (is_quiet()) return;
  fmt::print("{}\n", assessment.lift_case.title);
  if (const auto& block = assessment.lift_case.load.model; block && block->mesh)
    fmt::print("\n{}", describe_block_mesh(*block->mesh));
  if (assessment.lift) {
    print_loads(*assessment.lift, assessment.lift_case);
    if (assessment.sling_lengths) print_sling_lengths(*assessment.sling_lengths);
    print_motion(*assessment.lift);
  }
  if (const auto balances = find_table_balances(assessment)) {
    fmt::print("\n");
    print_wrapped(describe_balances(*balances));
  }
  if (assessment.block.model) {
    print_block(assessment.block);
    print_stages(assessment.block.stages);
    print_details(assessment.block);
  }
  if (assessment.standard) fmt::print("{}", standard_text(*assessment.standard));
}

std::vector<RunTrait> traits_of_run(const LiftCase& lift_case) {
  return {{"input", hash_of_input(lift_case)},
          {"program", hash_of_files({"/proc/self/exe"})},
          {"arithmetic of the processor", describe_arithmetic()}};
}

void say_what_is_gone_on_with(const UnfinishedRun& unfinished) {
  if (is_quiet()) return;
  if (!unfinished.differences().empty())
    fmt::print("a run that was stopped here is not gone on with: it had another {}\n",
               list_of_names(unfinished.differences()));
  if (const auto parts = unfinished.parts(); !parts.empty())
    fmt::print("going on with what a run that was stopped had done: {}\n", list_of_names(parts));
}

}  // namespace

int assess_case(const AssessOptions& options) {
  std::vector<ExpectedFigure> expected;
  if (options.expect) expected = read_expected_figures(*options.expect);
  LiftCase lift_case = read_lift_case(options.path, read_asked_changes(options.set));
  const std::filesystem::path folder = options.output
                                           ? std::filesystem::path(*options.output)
                                           : std::filesystem::path("results") / lift_case.name;
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder)) {
    fmt::print(
        stderr,
        "blocklift: error: the results cannot go into \"{}\": it is a file; --output takes a "
        "folder\n",
        folder.string());
    return exit_code::wrong_input;
  }
  require_writable(folder);
  keep_freed_memory();
  UnfinishedRun unfinished(folder, traits_of_run(lift_case));
  say_what_is_gone_on_with(unfinished);
  ProgressLine line;
  const Assessment assessment = assess(
      std::move(lift_case),
      [&](const std::string& stage, double fraction, const std::string& detail) {
        line.show(stage, fraction, detail);
      },
      &unfinished, options.anew ? no_cache() : cache_folder());
  line.show("writing results", 0, "");
  std::vector<LoadCaseFile> files;
  if (options.decks) files = load_case_files(assessment);
  const std::filesystem::path report = [&] {
    const HeldSignals until_all_is_in_place;
    std::filesystem::path page = write_results(assessment, folder, files);
    unfinished.forget();
    return page;
  }();
  line.finish();

  print_results(assessment);
  const nlohmann::ordered_json summary = read_summary(folder / layout::summary_file);
  for (const auto& warning : summary.value("warnings", nlohmann::ordered_json::array()))
    say_warning(warning.get<std::string>());
  print_checks(assessment);
  if (options.decks) print_decks(files, folder);
  const bool as_expected = !options.expect || figures_are_held(expected, summary);
  if (!is_quiet()) fmt::print("report: {}\n", report.string());
  return assessment.pass() && as_expected ? exit_code::done : exit_code::lift_fails;
}

int report_results(const std::string& folder, const std::optional<int>& frames) {
  complete_stopped_move(folder);
  Diagnostics diagnostics;
  for (const FileComplaint& complaint : complaints_about_folder(folder))
    diagnostics.error({std::make_shared<const std::string>(complaint.file.string()), 0, 0},
                      complaint.message);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  try {
    // Nothing is written if one of the two cannot be made.
    if (frames) require_frames(folder);
    const std::filesystem::path report = write_report(folder);
    if (!is_quiet()) fmt::print("report: {}\n", report.string());
    if (frames) {
      const std::filesystem::path lift = write_lift_frames(folder, *frames);
      if (!is_quiet()) fmt::print("ParaView: {}\n", lift.string());
    }
  } catch (const ResultsError& error) {
    fmt::print(stderr, "blocklift: error: {}\n", error.what());
    return exit_code::wrong_input;
  }
  return exit_code::done;
}

}  // namespace blocklift::pipeline
