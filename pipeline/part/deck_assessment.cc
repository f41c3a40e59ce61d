#include "pipeline/part/deck_assessment.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "pipeline/lift/stopwatch.h"
#include "structure/error.h"
#include "structure/load_cases/deck_heat.h"
#include "structure/mesh/shell_shape.h"
#include "structure/stress/open_sections.h"

namespace blocklift::pipeline {

namespace {

[[noreturn]] void refuse(const Mark& mark, const std::string& message,
                         const std::vector<std::string>& hints = {}) {
  Diagnostics diagnostics;
  diagnostics.error(mark, message, hints);
  throw InputError(diagnostics);
}

std::string why_none(const structure::Deck& deck, const structure::DeckSolution& solution) {
  if (solution.skipped.empty()) return "it has no subcase or step with static loads";
  std::string text;
  for (const structure::SkippedCase& skipped : solution.skipped) {
    if (!text.empty()) text += "; ";
    text += fmt::format("{} {}", skipped.is_held ? "no load acts in" : "nothing holds",
                        name_of(deck.load_cases[skipped.load_case]));
  }
  return text;
}

/// What of a kind of cards is not in the model, and why; empty: all is, or it says no more than
/// what a solver is to print.
std::string left_out_of(const structure::LedgerEntry& entry) {
  if (entry.left_out.empty() || entry.is_wish) return {};
  const std::string how_many = entry.used < entry.read
                                   ? fmt::format("{} of {} used", entry.used, entry.read)
                                   : "used in part";
  return fmt::format("{}: {}; left out: {}", entry.name, how_many, entry.left_out);
}

/// How there may be a case: where no load acts, by what the deck has and is left out.
std::vector<std::string> ways_to_a_case(const structure::Deck& deck,
                                        const structure::DeckSolution& solution) {
  std::vector<std::string> hints;
  const bool is_unloaded =
      std::any_of(solution.skipped.begin(), solution.skipped.end(),
                  [](const structure::SkippedCase& skipped) { return skipped.is_held; });
  for (const structure::LedgerEntry& entry : deck.ledger)
    if (const std::string text = left_out_of(entry); is_unloaded && !text.empty())
      hints.push_back(fmt::format("{}: {}", entry.place, text));
  hints.emplace_back(
      "a case needs supports and loads: SPC and LOAD in Nastran's case control, *BOUNDARY and "
      "*CLOAD, *DLOAD or *DSLOAD in Abaqus' step");
  hints.emplace_back("a block without them is loaded by a case: blocklift assess");
  return hints;
}

/// The deck's mesh; one without mass, to which no weight belongs, is given some, since a model has
/// a centre of mass.
structure::Mesh mesh_of(const structure::Deck& deck, bool is_massless, const Mark& mark) {
  structure::Mesh mesh = deck.mesh;
  if (!is_massless) return mesh;
  for (const structure::LoadSet& set : deck.load_sets)
    if (set.is_on_masses())
      refuse(mark,
             "the deck's materials have no density, and gravity or rotation acts in its cases",
             {"give its materials a density (RHO of MAT1, *DENSITY)"});
  for (structure::Material& material : mesh.materials) material.density = 1;
  return mesh;
}

/// Of a degree that the deck's own elements do not have.
void check_degree(const structure::Mesh& mesh, int degree, const Mark& mark) {
  if (degree != 1) return;
  const std::vector<int> off = structure::fastened_off_straight_shells(mesh);
  if (off.empty()) return;
  refuse(mark,
         fmt::format("elements of degree 1 are straight, and {} nodes that are loaded, held or "
                     "joined, {} the first, lie off them, in middles of curved edges: what acts "
                     "there would lose its moment",
                     off.size(), mesh.vertex_labels[off.front()]),
         {"--degree 2, which the deck itself has, to 4"});
}

}  // namespace

DeckAssessment assess_deck(std::shared_ptr<const BlockModel> block, const std::string& name,
                           std::optional<int> degree) {
  if (!block->mesh || !block->mesh->deck)
    refuse(block->place,
           fmt::format("block {} is of plates by keys, which have no load cases", name),
           {"load cases come from a deck of Nastran or Abaqus: mesh: {file: ...}",
            "a block of plates is loaded by a case: blocklift assess"});
  const Mark& mark = block->mesh->file.mark;
  DeckAssessment assessment;
  assessment.block = std::move(block);
  assessment.name = name;
  const structure::Deck& deck = assessment.deck();
  const int of_elements = degree.value_or(own_degree(deck));
  check_degree(deck.mesh, of_elements, mark);
  Stopwatch watch;
  try {
    assessment.is_massless = !(assessment.block->mesh->diagnosis->mass.mass > 0);
    assessment.model = std::make_unique<structure::ElasticModel>(
        mesh_of(deck, assessment.is_massless, mark), structure::Resolution{of_elements, {}});
    assessment.mesh_s = watch.lap();
    assessment.solution = structure::solve_deck(*assessment.model, deck);
  } catch (const structure::ModelError& error) {
    refuse(mark, error.what());
  }
  if (assessment.solution.cases.empty())
    refuse(mark,
           fmt::format("\"{}\" has no load case of its own that could be solved: {}",
                       assessment.block->mesh->file.value, why_none(deck, assessment.solution)),
           ways_to_a_case(deck, assessment.solution));
  return assessment;
}

std::vector<std::string> remarks_on_torsion(const DeckAssessment& assessment) {
  std::vector<std::string> sentences;
  const structure::Deck& deck = assessment.deck();
  if (assessment.model->space().beams().empty()) return sentences;
  for (const structure::DeckCaseSolution& solution : assessment.solution.cases) {
    const auto heat = structure::heat_of(*assessment.model, deck, {solution.load_case});
    for (const structure::TwistedBars& bars : structure::find_twisted_open_bars(
             assessment.model->space(), solution.motion, heat ? &*heat : nullptr))
      sentences.push_back(fmt::format(
          "case {}: torsion makes {:.0f} of {:.0f} MPa in the open section of {} at ({:.4g}, "
          "{:.4g}, {:.4g}) m; that such a section resists warping is not computed",
          deck.load_cases[solution.load_case].label, bars.torsion / 1e6, bars.von_mises / 1e6,
          bars.group, bars.place.x(), bars.place.y(), bars.place.z()));
  }
  return sentences;
}

std::vector<std::string> left_out_of_cases(const structure::Deck& deck) {
  std::vector<std::string> sentences;
  for (const structure::LedgerEntry& entry : deck.ledger)
    if (std::string text = left_out_of(entry); !text.empty()) sentences.push_back(std::move(text));
  return sentences;
}

std::vector<std::string> remarks_on_triangles(const DeckAssessment& assessment) {
  const int degree = assessment.model->space().degree();
  const structure::Mesh& mesh = assessment.deck().mesh;
  const std::vector<int> found = structure::find_locking_triangles(mesh, degree);
  if (found.empty()) return {};
  int enough = degree + 1;
  while (!structure::find_locking_triangles(mesh, enough).empty()) ++enough;
  return {fmt::format(
      "{} curved triangle{} over the plane of the corners by more than the thickness, element {} "
      "the most: in degree {} such triangles are far too stiff in bending and show too little of "
      "its stress; --degree {}, quadrangles or smaller triangles are not",
      found.size(), found.size() == 1 ? " rises" : "s rise", mesh.shells[found.front()].label,
      degree, enough)};
}

}  // namespace blocklift::pipeline
