#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/format.h"
#include "pipeline/files/structure/mesh_groups.h"
#include "structure/mesh/diagnosis/diagnosis.h"
#include "structure/mesh/files/deck/deck.h"

namespace blocklift::pipeline {

struct BlockModel;

/// A file that a block is read from, in place of plates: a deck of Nastran or Abaqus, a mesh of
/// Gmsh, or surfaces of CAD, which are meshed here.
struct MeshModel {
  Located<std::string> file;  ///< as the block's file names it
  Located<std::string> units;
  std::optional<double> yield_stress;               ///< of materials that have none there, Pa
  std::vector<MeshGroupModel> groups;               ///< that have no properties there
  std::vector<Named<Located<double>>> thicknesses;  ///< such groups with a thickness alone, m
  /// Of groups of stiffeners: from one tripping bracket to the next, m.
  std::vector<Named<Located<double>>> tripping_brackets;
  bool leave_solids_out = false;
  std::vector<Located<std::string>> leave_out;          ///< cards and keywords of a deck
  std::optional<Located<double>> element_size;          ///< of CAD surfaces, m
  std::optional<Located<double>> element_size_at_lugs;  ///< m
  Mark place;

  /// What was read, its mesh with the block's lugs; null if it could not be. It may be one that
  /// cannot be lifted: the diagnostics say so, and pictures show it.
  std::shared_ptr<const structure::Deck> deck = nullptr;
  std::shared_ptr<const structure::Diagnosis> diagnosis = nullptr;
  std::string content = {};  ///< fingerprint of the files that were read
};

Format<MeshModel> mesh_model_format();

/// Is the file one without properties of its own: a mesh of Gmsh or CAD surfaces?
bool is_bare(const MeshModel& mesh);

/// What a block's mesh is read for.
enum class MeshUse {
  lift,      ///< it hangs on its ropes: the deck's supports and springs to the ground do not hold
  own_cases  ///< the deck's supports and springs hold it in its own load cases
};

/// Reads the file of a block that names one, puts the block's lugs on it, and looks it over. All
/// that is wrong is said by the deck's own files and lines, or by the block's.
/// @param folder of the block's file.
/// @param of_case the folder of the case that names the block, in which the file may lie too.
void read_block_mesh(BlockModel& block, const std::filesystem::path& folder,
                     Diagnostics& diagnostics,
                     const std::optional<std::filesystem::path>& of_case = std::nullopt,
                     MeshUse use = MeshUse::lift);

/// The deck's cards that are not, or not all, in the block; its loads and supports are among them.
std::vector<structure::LedgerEntry> unused_cards(const MeshModel& mesh);

/// What is probably not meant in a mesh whose own load cases are solved, such as plates that lie on
/// one another, as sentences with the numbers of the first cells; those of lifts alone are left
/// out.
std::vector<std::string> warnings_of_own_cases(const MeshModel& mesh);

/// What was found in the deck and what became of it, as lines of text: cards that are not or not
/// all used, remarks of the reader, and what the look-over saw.
std::string describe_block_mesh(const MeshModel& mesh);

}  // namespace blocklift::pipeline
