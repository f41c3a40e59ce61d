#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/files/structure/block_model.h"
#include "structure/load_cases/deck_solution.h"
#include "structure/response/elastic_model.h"

namespace blocklift::pipeline {

/// A block's deck with its own load cases solved.
struct DeckAssessment {
  std::shared_ptr<const BlockModel> block;
  std::string name;  ///< of the block's file
  std::unique_ptr<structure::ElasticModel> model;
  structure::DeckSolution solution;
  /// The deck has no mass, as those for forces alone; the model's is none.
  bool is_massless = false;
  double mesh_s = 0;  ///< of the model, wall-clock time

  const structure::Deck& deck() const { return *block->mesh->deck; }
  /// Of the deck, kg.
  double mass() const { return is_massless ? 0 : model->mass_properties().mass; }
};

/// Solves the load cases that a block's deck has, with the deck's supports, loads and masses: the
/// block as its maker knows it, before it is lifted. Outfitting, lugs and ropes of the block's file
/// do not count.
/// @param degree of the elements, 1 to 4; none: that of the deck's own.
/// @throws InputError if the block has no deck, the deck no load case that is held and loaded, or
///   the supports leave it free to move.
DeckAssessment assess_deck(std::shared_ptr<const BlockModel> block, const std::string& name,
                           std::optional<int> degree);

/// Cards of the deck that are not in its cases though they would be, as sentences; contact, say.
std::vector<std::string> left_out_of_cases(const structure::Deck& deck);

/// Bars of open section in whose largest stress torsion governs, a sentence each case and group:
/// that they resist warping is not computed (find_twisted_open_bars).
std::vector<std::string> remarks_on_torsion(const DeckAssessment& assessment);

/// That curved triangles lock, in a sentence; none where none does (find_locking_triangles).
std::vector<std::string> remarks_on_triangles(const DeckAssessment& assessment);

/// Writes summary.json, nodes.csv (motions of the deck's nodes), reactions.csv and a picture
/// case-LABEL.vtu a case into a folder; all of them appear when all are written.
void write_deck_results(const DeckAssessment& assessment, const std::filesystem::path& folder);

}  // namespace blocklift::pipeline
