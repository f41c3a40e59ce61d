#include "pipeline/command_line/stress_of_deck.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "pipeline/files/structure/block_mesh.h"
#include "pipeline/terminal/text_table.h"
#include "structure/process_group.h"

namespace blocklift::pipeline {

namespace {

using structure::Deck;
using structure::DeckCaseSolution;

std::string label_of(const Deck& deck, const DeckCaseSolution& solution) {
  return std::to_string(deck.load_cases[solution.load_case].label);
}

void print_titles(const DeckAssessment& assessment) {
  TextTable table({{"case"}, {"title"}});
  bool is_any = false;
  for (const DeckCaseSolution& solution : assessment.solution.cases) {
    const auto& one = assessment.deck().load_cases[solution.load_case];
    is_any = is_any || !one.title.empty();
    table.add_row({std::to_string(one.label), one.title});
  }
  if (is_any) fmt::print("\n{}", table.text());
}

void print_stresses(const DeckAssessment& assessment) {
  TextTable table({{"case"},
                   {"checked MPa", 4},
                   {"largest MPa", 4},
                   {"at x, y, z, m"},
                   {"displaced mm", 4},
                   {"error %", 2}});
  for (const DeckCaseSolution& solution : assessment.solution.cases) {
    const structure::LoadCaseResult& stress = solution.stress;
    table.add_row({label_of(assessment.deck(), solution), stress.checked_von_mises.value / 1e6,
                   stress.peak_von_mises.value / 1e6, place_text(stress.peak_von_mises.point_B),
                   1e3 * stress.displacement.value, 100 * solution.estimated_error});
  }
  fmt::print("\n{}", table.text());
}

/// Zero where a sum leaves nothing but rounding.
double above(double rounding, double value) { return std::abs(value) > rounding ? value : 0; }

void print_forces(const DeckAssessment& assessment) {
  TextTable table({{"case"}, {"forces"}, {"x N", 6}, {"y N", 6}, {"z N", 6}});
  double residual = 0;
  for (const DeckCaseSolution& solution : assessment.solution.cases) {
    const structure::Vector3 &applied = solution.applied.force,
                             &supported = solution.supported.force;
    const double rounding = 1e-9 * std::max(applied.norm(), supported.norm());
    const auto add = [&](const std::string& label, const char* what, const auto& force) {
      table.add_row({label, what, above(rounding, force.x()), above(rounding, force.y()),
                     above(rounding, force.z())});
    };
    add(label_of(assessment.deck(), solution), "loads", applied);
    add("", "supports", supported);
    residual = std::max({residual, solution.force_residual, solution.moment_residual});
  }
  fmt::print("\n{}balance to {:.0e}\n", table.text(), residual);
}

void print_groups(const DeckAssessment& assessment) {
  const auto& cases = assessment.solution.cases;
  const auto worst = std::max_element(cases.begin(), cases.end(), [](auto& a, auto& b) {
    return a.stress.checked_von_mises.value < b.stress.checked_von_mises.value;
  });
  TextTable table({{fmt::format("group, case {}", label_of(assessment.deck(), *worst))},
                   {"checked MPa", 4},
                   {"largest MPa", 4},
                   {"of yield", 3}});
  for (const structure::GroupStress& group : worst->stress.groups) {
    if (group.checked_von_mises.part.empty()) continue;
    TextTable::Cell use = "-";
    if (std::isfinite(group.yield_stress)) use = group.checked_von_mises.value / group.yield_stress;
    table.add_row(
        {group.group, group.checked_von_mises.value / 1e6, group.peak_von_mises.value / 1e6, use});
  }
  fmt::print("\n{}", table.text());
}

void print_remarks(const DeckAssessment& assessment) {
  const Deck& deck = assessment.deck();
  for (const structure::SkippedCase& skipped : assessment.solution.skipped)
    print_wrapped(fmt::format("{} is not solved: {}", name_of(deck.load_cases[skipped.load_case]),
                              skipped.is_held ? "no load acts" : "nothing holds it"));
  if (!assessment.solution.idle_supports.empty())
    print_wrapped(fmt::format("{} held nodes hold nothing: no element is joined to them",
                              assessment.solution.idle_supports.size()));
  for (const std::string& sentence : warnings_of_own_cases(*assessment.block->mesh))
    print_wrapped("warning: " + sentence);
  for (const std::string& sentence : remarks_on_torsion(assessment))
    print_wrapped("warning: " + sentence);
  for (const std::string& sentence : remarks_on_triangles(assessment))
    print_wrapped("warning: " + sentence);
  if (const auto& diagnosis = assessment.block->mesh->diagnosis)
    if (const structure::Finding* estimated = diagnosis->find("beams by figures"))
      print_wrapped("note: " + estimated->text);
  for (const std::string& sentence : left_out_of_cases(deck))
    print_wrapped("warning: these cases lack what the deck has: " + sentence);
  for (const structure::DeckRemark& remark : deck.remarks)
    print_wrapped(fmt::format("{}: {}", remark.place, remark.text));
}

}  // namespace

std::string place_text(const structure::Vector3& place) {
  // A sum with 0 makes 0 of -0.
  return fmt::format("{:.4g}, {:.4g}, {:.4g}", place.x() + 0.0, place.y() + 0.0, place.z() + 0.0);
}

void print_deck_cases(const DeckAssessment& assessment) {
  const structure::ElasticModel& model = *assessment.model;
  const Deck& deck = assessment.deck();
  const std::string& title = assessment.block->title;
  fmt::print("{}\n", title.empty() ? assessment.name : title);
  fmt::print("{} shells, {} beams, {} solids of {}; degree {}, {} unknowns, {:.6g} kg\n",
             deck.mesh.shells.size(), deck.mesh.beams.size(), deck.mesh.solids.size(),
             assessment.block->mesh->file.value, model.space().degree(), model.space().unknowns(),
             assessment.mass());
  if (const int processes = structure::ProcessGroup::launched(); processes > 1)
    fmt::print("factorised on {} processes\n", processes);
  print_titles(assessment);
  print_stresses(assessment);
  print_forces(assessment);
  print_groups(assessment);
  print_remarks(assessment);
}

}  // namespace blocklift::pipeline
