#pragma once

#include <filesystem>
#include <string>

#include <Eigen/Core>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure::test {

/// A folder that goes when the test ends.
class DeckFolder {
 public:
  DeckFolder();
  ~DeckFolder();
  DeckFolder(const DeckFolder&) = delete;
  DeckFolder& operator=(const DeckFolder&) = delete;
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Reads a deck of this text.
Deck nastran(const std::string& text, const std::string& units = "m-kg-N",
             const DeckOptions& options = {});
Deck abaqus(const std::string& text, const std::string& units = "m-kg-N",
            const DeckOptions& options = {});
/// What a reader says of a deck that it refuses; empty if it reads it.
std::string complaints_of_nastran(const std::string& text, const std::string& units = "m-kg-N");
std::string complaints_of_abaqus(const std::string& text, const std::string& units = "m-kg-N");

/// What the ledger says of a card.
const LedgerEntry& entry(const Deck& deck, const std::string& name);

/// Compares two matrices by the norm of their difference.
void expect_near(const Eigen::MatrixXd& value, const Eigen::MatrixXd& expected, double tolerance);

/// Compares a deck's mass (kg) and its first moment (kg m) with sums by hand.
void expect_mass(const Deck& deck, double mass, const Vector3& moment);

/// Compares what two decks say: places, cells, sections, links, supports and loads, in their order.
/// @param tolerance relative
void expect_same(const Deck& a, const Deck& b, double tolerance);

}  // namespace blocklift::structure::test
