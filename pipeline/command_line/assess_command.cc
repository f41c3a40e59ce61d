#include "pipeline/command_line/assess_command.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/command_line/exit_code.h"
#include "pipeline/command_line/expect_command.h"
#include "pipeline/command_line/held_signals.h"
#include "pipeline/command_line/progress_bar.h"
#include "pipeline/comparison/expected_figures.h"
#include "pipeline/declaration/key_change.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/formats/results_layout.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/formats/summary_file.h"
#include "pipeline/report/report.h"
#include "pipeline/results/doubts.h"
#include "pipeline/results/load_case_decks.h"
#include "pipeline/results/mesh_error.h"
#include "pipeline/results/radiation_summary.h"
#include "pipeline/results/standard_summary.h"

namespace blocklift::pipeline {

namespace {

/// Shows each stage of a run in a bar of its own.
class ProgressLine {
 public:
  void show(const std::string& stage, double fraction, const std::string& detail) {
    if (stage != stage_) {
      bar_.reset();
      bar_ = std::make_unique<ProgressBar>(stage);
      stage_ = stage;
    }
    bar_->show(fraction, detail);
  }
  void finish() { bar_.reset(); }

 private:
  std::string stage_;
  std::unique_ptr<ProgressBar> bar_;
};

/// "-" for a rope that is slack at rest.
std::string ratio_text(double dynamic, double at_rest) {
  return at_rest > 0 ? fmt::format("{:.3f}", dynamic / at_rest) : "-";
}

/// Three digits of the largest load, tonnes, and tenths of a tonne at least.
int decimals_of_loads(double largest) {
  return largest > 0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(largest))), 1, 6) : 1;
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
  fmt::print("\n{:<8}{:>10}{:>10}{:>10}   {}\n", "rope", "static t", "dynamic t", "ratio",
             lift_case.compare ? "published static, dynamic t" : "");
  double largest = 0;
  for (const auto& rope : in_motion) largest = std::max(largest, rope.tension / newton_per_tonne);
  const int decimals = decimals_of_loads(largest);
  for (const LiftRope& line : lift.model.ropes) {
    const auto rope = static_cast<std::size_t>(line.rope);
    const std::string& name = line.name;
    fmt::print("{:<8}{:>10.{}f}{:>10.{}f}{:>10}", name, at_rest[rope].tension / newton_per_tonne,
               decimals, in_motion[rope].tension / newton_per_tonne, decimals,
               ratio_text(in_motion[rope].tension, at_rest[rope].tension));
    if (const PublishedLoads* figures = published(name);
        figures && figures->static_load && figures->dynamic_load) {
      fmt::print("   {:.0f} ({:+.1f} %), {:.0f} ({:+.1f} %)",
                 *figures->static_load / newton_per_tonne,
                 100 * (at_rest[rope].tension / *figures->static_load - 1),
                 *figures->dynamic_load / newton_per_tonne,
                 100 * (in_motion[rope].tension / *figures->dynamic_load - 1));
    }
    fmt::print("\n");
  }
}

/// The load's own slow motions at the start, and what the integration cost.
void print_motion(const LiftRun& lift) {
  if (!lift.natural_modes.empty()) {
    fmt::print("\n{}\n", describe_natural_periods(lift.natural_modes.front()));
  }
  const dynamics::IntegrationStatistics& cost = lift.dynamic_result.statistics;
  fmt::print("time integration: {} steps, {} right-hand sides, {} Jacobians\n", cost.steps,
             cost.right_hand_sides, cost.jacobians);
  fmt::print("{}", straying_notice(record_radiation(lift.model, lift.dynamic_history())));
}

void print_block(const BlockAssessment& block, const HistoryAssessment* history) {
  const auto print_way = [](const char* name, const LoadComparison& way) {
    fmt::print("{:<28}{:>8.1f}{:>8.1f} MPa ({:+.1f} %){:>8.1f}{:>8.1f} mm ({:+.1f} %)\n", name,
               way.static_state.result.checked_von_mises.value / 1e6,
               way.dynamic_state.result.checked_von_mises.value / 1e6,
               way.stress_increase_percent(), 1e3 * way.static_displacement,
               1e3 * way.dynamic_displacement, way.deformation_increase_percent());
  };
  fmt::print("\nblock, static and dynamic    checked von Mises            displacement\n");
  if (block.simultaneous_by_rope.empty()) {
    print_way("loads of the table", block.simultaneous);
    return;
  }
  print_way("simultaneous", block.simultaneous);
  print_way("every rope at its maximum", block.per_rope_maxima);
  if (!history) return;
  const HistoryState &at_rest = history->static_state, &in_motion = history->dynamic_state;
  fmt::print("{:<28}{:>8.1f}{:>8.1f} MPa ({:+.1f} %){:>8.1f}{:>8.1f} mm ({:+.1f} %)\n",
             "the whole lift", at_rest.checked_von_mises.at.value / 1e6,
             in_motion.checked_von_mises.at.value / 1e6, history->stress_increase_percent(),
             1e3 * at_rest.displacement.at.value, 1e3 * in_motion.displacement.at.value,
             history->deformation_increase_percent());
  fmt::print(
      "every rope at its maximum gives {:+.1f} % of the largest stress, {:+.1f} % where it is "
      "furthest off\n",
      history->per_rope_maxima.largest_percent, history->per_rope_maxima.worst_percent);
}

void print_accuracy(const structure::CheckedAccuracy& accuracy) {
  if (accuracy.steps.size() < 2) {
    fmt::print("checked stress of one mesh only: how far it moves with the mesh is not known\n");
    return;
  }
  fmt::print(
      "the last of {} meshes moved the checked stress by {:.1f} % and its increase by {:.1f} "
      "points{}\n",
      accuracy.steps.size(), 100 * accuracy.stress_change(), 100 * accuracy.increase_change(),
      accuracy.is_reached ? "" : ": the accuracy that is asked for is not reached");
}

void print_details(const BlockRun& block) {
  print_accuracy(block.accuracy);
  fmt::print("estimated error of the stress field {:.1f} % in the energy norm, most of it in {}\n",
             100 * block.error.relative, block.error.worst_part);
  if (!block.buckling.panels.empty()) {
    const BuckledPanel& worst = block.buckling.panels.front();
    fmt::print("nearest to buckling of {} panels: {:.2f} (elastic {:.2f}) in {}\n",
               block.buckling.panels.size(), worst.worst.utilisation.critical,
               worst.worst.utilisation.elastic, worst.panel.plate);
  }
  for (const PadeyeAssessment& padeye : block.padeyes.padeyes) {
    const PadeyeState& state = padeye.governing_state();
    fmt::print(
        "padeye {:<6}{:>8.1f} MPa in the main plate,{:>7.1f} in the cheek plates ({}); worst "
        "formula {:.2f}, {}\n",
        padeye.lug, state.result.main_plate.checked_von_mises.value / 1e6,
        state.result.cheeks.checked_von_mises.value / 1e6, state.name,
        padeye.worst_formula().formula.utilisation, padeye.worst_formula().formula.name);
  }
}

void print_checks(const Assessment& assessment) {
  fmt::print("\n");
  for (const std::string& reason : verdict_reasons(assessment.checks)) fmt::print("{}\n", reason);
  const std::string indicative = why_indicative(assessment);
  fmt::print("verdict: {}{}\n", assessment.pass() ? "pass" : "FAIL",
             indicative.empty() ? "" : ", indicative: " + indicative);
}

void print_decks(const std::vector<LoadCaseFile>& files, const std::filesystem::path& folder) {
  if (files.empty()) fmt::print("no decks: the load has no block whose stress is asked\n");
  for (const LoadCaseFile& file : files)
    fmt::print("{}\n", file.refusal.empty()
                           ? "load cases: " + (folder / file.name).string()
                           : fmt::format("{} is not written: {}", file.name, file.refusal));
}

/// @throws InputError with all that is no change.
std::vector<KeyChange> read_changes(const std::vector<std::string>& texts) {
  Diagnostics diagnostics;
  const Mark mark{std::make_shared<const std::string>("--set"), 0, 0};
  std::vector<KeyChange> changes;
  for (const std::string& text : texts)
    if (auto change = parse_key_change(text, mark, diagnostics)) changes.push_back(*change);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return changes;
}

}  // namespace

int assess_case(const std::string& path, const std::optional<std::string>& output, bool decks,
                const std::optional<std::string>& expect, const std::vector<std::string>& set) {
  std::vector<ExpectedFigure> expected;
  if (expect) expected = read_expected_figures(*expect);
  LiftCase lift_case = read_lift_case(path, read_changes(set));
  const std::filesystem::path folder =
      output ? std::filesystem::path(*output) : std::filesystem::path("results") / lift_case.name;
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder)) {
    fmt::print(
        stderr,
        "blocklift: error: the results cannot go into \"{}\": it is a file; --output takes a "
        "folder\n",
        folder.string());
    return exit_code::wrong_input;
  }
  require_writable(folder);
  ProgressLine line;
  const Assessment assessment = assess(
      std::move(lift_case), [&](const std::string& stage, double fraction,
                                const std::string& detail) { line.show(stage, fraction, detail); });
  line.show("writing results", 0, "");
  std::vector<LoadCaseFile> files;
  if (decks) files = load_case_files(assessment);
  const std::filesystem::path report = [&] {
    const HeldSignals until_all_is_in_place;
    return write_results(assessment, folder, files);
  }();
  line.finish();

  fmt::print("{}\n", assessment.lift_case.title);
  if (const auto& block = assessment.lift_case.load.model; block && block->mesh)
    fmt::print("\n{}", describe_block_mesh(*block->mesh));
  if (assessment.lift) {
    print_loads(*assessment.lift, assessment.lift_case);
    print_motion(*assessment.lift);
  }
  if (assessment.block.model) {
    print_block(assessment.block.assessment,
                assessment.block.history ? &*assessment.block.history : nullptr);
    print_details(assessment.block);
  }
  if (assessment.lift) {
    for (const std::string& doubt : list_doubts(assessment.lift_case, *assessment.lift))
      fmt::print("warning: {}\n", doubt);
  }
  if (assessment.standard) fmt::print("{}", standard_text(*assessment.standard));
  print_checks(assessment);
  if (decks) print_decks(files, folder);
  const bool as_expected =
      !expect || figures_are_held(expected, read_summary(folder / layout::summary_file));
  fmt::print("report: {}\n", report.string());
  return assessment.pass() && as_expected ? exit_code::done : exit_code::lift_fails;
}

int report_results(const std::string& folder) {
  try {
    fmt::print("report: {}\n", write_report(folder).string());
  } catch (const ResultsError& error) {
    fmt::print(stderr, "blocklift: error: {}\n", error.what());
    return exit_code::wrong_input;
  }
  return exit_code::done;
}

}  // namespace blocklift::pipeline
