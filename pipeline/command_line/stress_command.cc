#include "pipeline/command_line/stress_command.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/command_line/held_signals.h"
#include "pipeline/command_line/stress_of_deck.h"
#include "pipeline/files/file_kind.h"
#include "pipeline/files/library/model_library.h"
#include "pipeline/part/deck_assessment.h"
#include "pipeline/part/part_assessment.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/processes/lost_processes.h"
#include "pipeline/terminal/run_log.h"
#include "pipeline/terminal/text_table.h"
#include "structure/stress_tensor.h"
#include "structure/system/shared_factor.h"

namespace blocklift::pipeline {

namespace fs = std::filesystem;

namespace {

void print_probes(const std::vector<ProbeResult>& probes) {
  if (probes.empty()) return;
  TextTable table({{"probe"},
                   {"at x, y, z, m"},
                   {"u_x mm", 4},
                   {"u_y mm", 4},
                   {"u_z mm", 4},
                   {"s_xx MPa", 4},
                   {"s_yy", 4},
                   {"s_zz", 4},
                   {"s_xy", 4},
                   {"s_yz", 4},
                   {"s_zx", 4},
                   {"v. Mises", 4}});
  for (const ProbeResult& probe : probes) {
    for (const structure::PartProbe& point : probe.points) {
      std::vector<TextTable::Cell> row = {probe.name, place_text(point.point)};
      if (!point.inside) {
        row.emplace_back("outside");
      } else {
        for (int a = 0; a < 3; ++a) row.emplace_back(1e3 * point.displacement[a]);
        for (int c = 0; c < 6; ++c) row.emplace_back(point.stress[c] / 1e6);
        row.emplace_back(structure::von_mises(point.stress) / 1e6);
      }
      table.add_row(std::move(row));
    }
  }
  fmt::print("\n{}", table.text());
}

void print_formulas(const std::vector<PadeyeFormulaAtWorst>& formulas) {
  TextTable table({{"hand formula"}, {"demand", 1}, {"limit", 1}, {""}, {"use", 3}, {"source"}});
  for (const PadeyeFormulaAtWorst& at_worst : formulas) {
    const structure::PadeyeFormula& formula = at_worst.formula;
    const std::string unit = formula.unit;
    const double scale = unit == "Pa" ? 1e6 : unit == "N" ? 1e3 : unit == "m" ? 1e-3 : 1;
    const char* shown = unit == "Pa" ? "MPa" : unit == "N" ? "kN" : unit == "m" ? "mm" : "";
    table.add_row({formula.name, format_figure(formula.demand / scale),
                   format_figure(formula.limit / scale), shown, formula.utilisation,
                   formula.source});
  }
  fmt::print("{}", table.text());
}

void print_padeye(const PartPadeye& padeye) {
  const structure::Vector3& force = padeye.force_P;
  fmt::print("\npadeye under {:.6g}, {:.6g}, {:.6g} kN\n", force.x() / 1e3, force.y() / 1e3,
             force.z() / 1e3);
  print_formulas(padeye.formulas);
  // The table of groups has the stress averaged where solids meet.
  TextTable table(
      {{"von Mises MPa"}, {"checked", 4}, {"largest, not averaged", 4}, {"checked of yield", 3}});
  const auto add_plate = [&](const char* name, const structure::PadeyePlateStress& plate) {
    table.add_row({name, plate.checked_von_mises.value / 1e6, plate.peak_von_mises.value / 1e6,
                   plate.checked_von_mises.value / padeye.input.material.yield_stress});
  };
  add_plate("main plate", padeye.stress.main_plate);
  if (padeye.input.geometry.has_cheeks()) add_plate("cheek plates", padeye.stress.cheeks);
  fmt::print("\n{}", table.text());
}

void print_refinement(const PartAssessment& assessment) {
  if (!assessment.file.accuracy && !assessment.file.checked_stress) return;
  TextTable table({{"elements", 12},
                   {"order", 1},
                   {"unknowns", 12},
                   {"error %", 3},
                   {"v. Mises MPa", 5},
                   {"+- MPa", 3},
                   {"checked %", 3}});
  for (const RefinementStep& step : assessment.refinement)
    table.add_row({std::to_string(step.elements), std::to_string(step.element_order),
                   std::to_string(step.unknowns), 100 * step.estimated_error, step.von_mises / 1e6,
                   step.von_mises_error / 1e6, 100 * step.checked_error});
  fmt::print("\n{}", table.text());
}

void print_groups(const structure::PartSolution& solution) {
  TextTable table({{"group"}, {"von Mises MPa", 4}, {"displaced mm", 4}, {"at x, y, z, m"}});
  for (const structure::PartGroupResult& group : solution.groups)
    table.add_row(
        {group.group, group.von_mises / 1e6, 1e3 * group.displacement, place_text(group.point)});
  fmt::print("\n{}", table.text());
}

void print_hot_spots(const std::vector<HotSpotResult>& hot_spots) {
  if (hot_spots.empty()) return;
  TextTable table({{"hot spot"}, {"across MPa", 5}, {"principal MPa", 5}, {"governing MPa", 5}});
  for (const HotSpotResult& spot : hot_spots)
    table.add_row({spot.name, spot.stress.normal / 1e6, spot.stress.principal / 1e6,
                   spot.stress.governing / 1e6});
  fmt::print("\n{}", table.text());
}

/// Force, N, of loads and supports.
void print_forces(const PartAssessment& assessment) {
  TextTable table({{"force on the part"}, {"x N", 6}, {"y N", 6}, {"z N", 6}});
  const auto add_force = [&](const std::string& name, const Eigen::Vector3d& force) {
    table.add_row({name, force.x(), force.y(), force.z()});
  };
  add_force("loads", assessment.solution.applied.force);
  for (std::size_t s = 0; s < assessment.model.supports.size(); ++s)
    add_force(assessment.model.supports[s].name, assessment.solution.reactions[s].force);
  fmt::print("\n{}", table.text());
}

void print_solution(const PartAssessment& assessment) {
  const structure::PartSolution& solution = assessment.solution;
  print_groups(solution);
  print_probes(assessment.probes);
  print_hot_spots(assessment.hot_spots);
  print_forces(assessment);
  if (assessment.padeye) print_padeye(*assessment.padeye);
  print_refinement(assessment);
  const structure::SolverAccount& solver = solution.solver;
  fmt::print("\n{}{}{}{}\n", solver.name,
             solver.iterations > 0 ? fmt::format(", {} iterations", solver.iterations) : "",
             solver.processes > 1 ? fmt::format(", {} processes", solver.processes) : "",
             solver.iterations == 0 ? fmt::format(", {:.2g} GB", solver.factor_bytes / 1e9) : "");
  print_wrapped(fmt::format(
      "estimated error of the stress field {:.1f} %, of the largest stress {} MPa; balance to "
      "{:.0e}",
      100 * solution.estimated_error, format_figure(solution.all.von_mises_error / 1e6),
      std::max(solution.force_residual, solution.moment_residual)));
}

void print_modes(const structure::NaturalModes& modes) {
  TextTable table({{"natural mode"}, {"frequency Hz", 1}, {"period s", 1}, {""}});
  for (Eigen::Index m = 0; m < modes.frequencies.size(); ++m) {
    const double frequency = modes.frequencies[m];
    if (m < modes.rigid_motions)
      table.add_row({std::to_string(m + 1), "0", "-", "rigid motion"});
    else
      table.add_row(
          {std::to_string(m + 1), format_figure(frequency, 6), format_figure(1 / frequency)});
  }
  fmt::print("\n{}", table.text());
}

void print_references(const PartAssessment& assessment, const PartReferences& references) {
  TextTable table({{"reference"}, {"published", 1}, {"computed", 1}, {"off %", 3}});
  for (const PartReference& figure : references.figures) {
    const double computed = figure_of(assessment, figure), published = figure.value.value.value;
    table.add_row({name_of(figure), format_figure(published, 6), format_figure(computed, 6),
                   fmt::format("{:.2f}", 100 * (computed / published - 1))});
  }
  fmt::print("\n{}", table.text());
  print_wrapped("published: " + references.source);
}

void print_table(const PartAssessment& assessment) {
  if (is_quiet()) return;
  fmt::print("{}\n", assessment.file.title.empty() ? assessment.file.name : assessment.file.title);
  fmt::print("{} solid elements, {} unknowns, {:.6g} kg\n", assessment.model.mesh.solids.size(),
             3 * assessment.model.mesh.nodes.cols() -
                 static_cast<Eigen::Index>(assessment.model.joints.ties.size()),
             assessment.mass.mass);
  for (const structure::PartMeeting& meeting : assessment.model.joints.meetings)
    if (meeting.tied_nodes > 0) print_wrapped(describe(meeting));
  if (!assessment.file.loads.empty()) print_solution(assessment);
  if (assessment.modes) print_modes(*assessment.modes);
  if (assessment.file.references) print_references(assessment, *assessment.file.references);
}

}  // namespace

namespace {

fs::path folder_of(const StressOptions& options, const std::string& name) {
  return options.output ? fs::path(*options.output) : fs::path("results") / name;
}

void refuse_option(const StressOptions& options, const std::string& message,
                   const std::string& hint) {
  Diagnostics diagnostics;
  diagnostics.error({std::make_shared<const std::string>(options.part)}, message, {hint});
  throw InputError(diagnostics);
}

int stress_of_deck(const StressOptions& options) {
  if (options.calculix)
    refuse_option(options, "--calculix is for parts", "a block's deck is such an input itself");
  Diagnostics diagnostics;
  ModelLibrary library = ModelLibrary::of_installation();
  const fs::path file = input_file(options.part);
  const auto block = library.read_block_of_own_cases(file, diagnostics);
  if (!block || diagnostics.has_errors()) throw InputError(diagnostics);
  const std::string name = name_of_input(file);
  const fs::path folder = folder_of(options, name);
  require_writable(folder);
  const DeckAssessment assessment = assess_deck(block, name, options.degree);
  {
    const HeldSignals until_all_is_in_place;
    write_deck_results(assessment, folder);
  }
  if (!is_quiet()) {
    print_deck_cases(assessment);
    fmt::print("results: {}\n", folder.string());
  }
  return exit_code::done;
}

int stress_of_part(const StressOptions& options) {
  if (options.degree)
    refuse_option(options, "--degree is for blocks with a deck",
                  "a part's file has the key element_order");
  Diagnostics diagnostics;
  if (complain_about_untold_kind(options.part, diagnostics)) throw InputError(diagnostics);
  std::optional<PartFile> file = read_part_file(options.part, diagnostics);
  if (!file) throw InputError(diagnostics);
  const fs::path folder = folder_of(options, file->name);
  require_writable(folder);
  const PartAssessment assessment = assess_part(std::move(*file));
  {
    const HeldSignals until_all_is_in_place;
    write_part_results(assessment, folder, options.calculix);
  }
  print_table(assessment);
  for (const std::string& doubt : list_doubts(assessment.model)) say_warning(doubt);
  if (!is_quiet()) fmt::print("results: {}\n", folder.string());
  return exit_code::done;
}

}  // namespace

int stress(const StressOptions& options) {
  const auto run = [&] {
    return kind_of_file(options.part) == FileKind::block ? stress_of_deck(options)
                                                         : stress_of_part(options);
  };
  if (structure::ProcessGroup::launched() == 1) return run();
  const structure::ProcessGroup& group = join_launched_processes();
  if (!group.leads()) {
    structure::follow_factor_team(group);
    return exit_code::done;
  }
  const structure::FactorTeam team(group);
  return run();
}

}  // namespace blocklift::pipeline
