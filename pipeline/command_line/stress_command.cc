#include "pipeline/command_line/stress_command.h"

#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/command_line/exit_code.h"
#include "pipeline/command_line/held_signals.h"
#include "pipeline/part/part_assessment.h"
#include "structure/stress_tensor.h"

namespace blocklift::pipeline {

namespace {

void print_probe(const std::string& name, const structure::PartProbe& probe) {
  if (!probe.inside) {
    fmt::print("{:<18}{:>9.4g}{:>9.4g}{:>9.4g}   outside\n", name, probe.point.x(), probe.point.y(),
               probe.point.z());
    return;
  }
  fmt::print("{:<18}{:>9.4g}{:>9.4g}{:>9.4g}", name, probe.point.x(), probe.point.y(),
             probe.point.z());
  for (int a = 0; a < 3; ++a) fmt::print("{:>10.4g}", 1e3 * probe.displacement[a]);
  for (int c = 0; c < 6; ++c) fmt::print("{:>10.4g}", probe.stress[c] / 1e6);
  fmt::print("{:>10.4g}\n", structure::von_mises(probe.stress) / 1e6);
}

void print_padeye(const PartPadeye& padeye) {
  const structure::Vector3& force = padeye.force_P;
  fmt::print("\npadeye under {:.6g}, {:.6g}, {:.6g} kN\n", force.x() / 1e3, force.y() / 1e3,
             force.z() / 1e3);
  fmt::print("{:<52}{:>12}{:>12}   {:<4}{:>10}   {}\n", "hand formula", "demand", "limit", "",
             "utilised", "source");
  for (const PadeyeFormulaAtWorst& at_worst : padeye.formulas) {
    const structure::PadeyeFormula& formula = at_worst.formula;
    const std::string unit = formula.unit;
    const double scale = unit == "Pa" ? 1e6 : unit == "N" ? 1e3 : unit == "m" ? 1e-3 : 1;
    fmt::print("{:<52}{:>12.4g}{:>12.4g}   {:<4}{:>10.3f}   {}\n", formula.name,
               formula.demand / scale, formula.limit / scale,
               unit == "Pa"  ? "MPa"
               : unit == "N" ? "kN"
               : unit == "m" ? "mm"
                             : "",
               formula.utilisation, formula.source);
  }
  fmt::print("{:<24}{:>24}{:>24}{:>20}\n", "finite elements", "checked von Mises MPa",
             "largest von Mises MPa", "of yield, checked");
  const auto print_plate = [&](const char* name, const structure::PadeyePlateStress& plate) {
    fmt::print("{:<24}{:>24.4g}{:>24.4g}{:>20.3f}\n", name, plate.checked_von_mises.value / 1e6,
               plate.peak_von_mises.value / 1e6,
               plate.checked_von_mises.value / padeye.input.material.yield_stress);
  };
  print_plate("main plate", padeye.stress.main_plate);
  if (padeye.input.geometry.has_cheeks()) print_plate("cheek plates", padeye.stress.cheeks);
}

void print_refinement(const PartAssessment& assessment) {
  if (!assessment.file.accuracy && !assessment.file.checked_stress) return;
  fmt::print("\n{:<12}{:>12}{:>12}{:>12}{:>15}{:>12}{:>12}\n", "elements", "order", "unknowns",
             "error %", "v. Mises MPa", "+- MPa", "checked %");
  for (const RefinementStep& step : assessment.refinement)
    fmt::print("{:<12}{:>12}{:>12}{:>12.3g}{:>15.5g}{:>12.3g}{:>12.3g}\n", step.elements,
               step.element_order, step.unknowns, 100 * step.estimated_error, step.von_mises / 1e6,
               step.von_mises_error / 1e6, 100 * step.checked_error);
}

void print_solution(const PartAssessment& assessment) {
  const structure::PartSolution& solution = assessment.solution;
  fmt::print("\n{:<18}{:>14}{:>14}   {}\n", "group", "von Mises MPa", "displaced mm",
             "at x, y, z, m");
  for (const structure::PartGroupResult& group : solution.groups)
    fmt::print("{:<18}{:>14.4g}{:>14.4g}   {:.4g}, {:.4g}, {:.4g}\n", group.group,
               group.von_mises / 1e6, 1e3 * group.displacement, group.point.x(), group.point.y(),
               group.point.z());
  if (!assessment.probes.empty())
    fmt::print(
        "\n{:<18}{:>9}{:>9}{:>9}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n",
        "probe", "x m", "y m", "z m", "u_x mm", "u_y mm", "u_z mm", "s_xx MPa", "s_yy", "s_zz",
        "s_xy", "s_yz", "s_zx", "v. Mises");
  for (const ProbeResult& probe : assessment.probes)
    for (const structure::PartProbe& point : probe.points) print_probe(probe.name, point);
  if (!assessment.hot_spots.empty())
    fmt::print("\n{:<18}{:>14}{:>14}{:>14}\n", "hot spot", "across MPa", "principal MPa",
               "governing MPa");
  for (const HotSpotResult& spot : assessment.hot_spots)
    fmt::print("{:<18}{:>14.5g}{:>14.5g}{:>14.5g}\n", spot.name, spot.stress.normal / 1e6,
               spot.stress.principal / 1e6, spot.stress.governing / 1e6);
  fmt::print("\n{:<18}{:>14}{:>14}{:>14}\n", "force on the part", "x N", "y N", "z N");
  const auto print_force = [](const std::string& name, const Eigen::Vector3d& force) {
    fmt::print("{:<18}{:>14.6g}{:>14.6g}{:>14.6g}\n", name, force.x(), force.y(), force.z());
  };
  print_force("loads", solution.applied.force);
  for (std::size_t s = 0; s < assessment.model.supports.size(); ++s)
    print_force(assessment.model.supports[s].name, solution.reactions[s].force);
  if (assessment.padeye) print_padeye(*assessment.padeye);
  print_refinement(assessment);
  const structure::SolverAccount& solver = solution.solver;
  fmt::print("\n{}{}{}{}\n", solver.name,
             solver.iterations > 0 ? fmt::format(", {} iterations", solver.iterations) : "",
             solver.processes > 1 ? fmt::format(", {} processes", solver.processes) : "",
             solver.iterations == 0 ? fmt::format(", {:.2g} GB", solver.factor_bytes / 1e9) : "");
  fmt::print(
      "estimated error of the stress field {:.1f} %, of the largest stress {:.4g} MPa; "
      "balance to {:.0e}\n",
      100 * solution.estimated_error, solution.all.von_mises_error / 1e6,
      std::max(solution.force_residual, solution.moment_residual));
}

void print_modes(const structure::NaturalModes& modes) {
  fmt::print("\n{:<18}{:>14}{:>14}\n", "natural mode", "frequency Hz", "period s");
  for (Eigen::Index m = 0; m < modes.frequencies.size(); ++m) {
    const double frequency = modes.frequencies[m];
    if (m < modes.rigid_motions)
      fmt::print("{:<18}{:>14}{:>14}   rigid motion\n", m + 1, 0, "-");
    else
      fmt::print("{:<18}{:>14.6g}{:>14.4g}\n", m + 1, frequency, 1 / frequency);
  }
}

void print_references(const PartAssessment& assessment, const PartReferences& references) {
  fmt::print("\n{:<28}{:>14}{:>14}{:>10}   {}\n", "reference", "published", "computed", "off",
             references.source);
  for (const PartReference& figure : references.figures) {
    const double computed = figure_of(assessment, figure), published = figure.value.value.value;
    fmt::print("{:<28}{:>14.6g}{:>14.6g}{:>8.2f} %\n", name_of(figure), published, computed,
               100 * (computed / published - 1));
  }
}

void print_table(const PartAssessment& assessment) {
  fmt::print("{}\n", assessment.file.title.empty() ? assessment.file.name : assessment.file.title);
  fmt::print("{} solid elements, {} unknowns, {:.6g} kg\n", assessment.model.mesh.solids.size(),
             3 * assessment.model.mesh.nodes.cols(), assessment.mass.mass);
  if (!assessment.file.loads.empty()) print_solution(assessment);
  if (assessment.modes) print_modes(*assessment.modes);
  if (assessment.file.references) print_references(assessment, *assessment.file.references);
}

}  // namespace

namespace {

int stress_of(const StressOptions& options, structure::PartTeam* team) {
  Diagnostics diagnostics;
  std::optional<PartFile> file = read_part_file(options.part, diagnostics);
  if (!file) throw InputError(diagnostics);
  const std::filesystem::path folder = options.output
                                           ? std::filesystem::path(*options.output)
                                           : std::filesystem::path("results") / file->name;
  require_writable(folder);
  const PartAssessment assessment = assess_part(std::move(*file), team);
  {
    const HeldSignals until_all_is_in_place;
    write_part_results(assessment, folder, options.calculix, team);
  }
  print_table(assessment);
  fmt::print("results: {}\n", folder.string());
  return exit_code::done;
}

}  // namespace

int stress(const StressOptions& options) {
  if (structure::ProcessGroup::launched() == 1) return stress_of(options, nullptr);
  const structure::ProcessGroup& group = structure::ProcessGroup::of_this_run();
  if (!group.leads()) {
    structure::follow_part_team(group);
    return exit_code::done;
  }
  structure::PartTeam team(group);
  return stress_of(options, &team);
}

}  // namespace blocklift::pipeline
