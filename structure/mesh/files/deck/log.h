#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// Line of one of a deck's files.
struct SourceLine {
  int file = 0;  ///< place in the list of files
  int line = 0;  ///< from 1
};

/// What a reader notes of a deck as it goes: its files, the ledger, remarks, and everything that is
/// wrong, so that all of it can be said at once.
class DeckLog {
 public:
  int add_file(const std::string& path);
  std::string place(SourceLine line) const;

  /// What keeps the deck from being read. Said once where the text is the same, with their count.
  void complain(SourceLine line, const std::string& text);
  /// What the user should know. Said once where the text is the same, with their count.
  void remark(SourceLine line, const std::string& text);

  /// Counts a card that was read.
  void read(std::string_view name, SourceLine line);
  void use(std::string_view name, int count = 1) { entry(name).used += count; }
  /// Why a card, or a part of it, is not in the model; the first reason stays.
  void leave_out(std::string_view name, const std::string& reason);
  /// Leaves out what asks a solver to print, or to go about its work in some way.
  void leave_out_wish(std::string_view name, const std::string& reason);

  /// Does the deck's user ask to do without what has this name? It is noted that the deck has it.
  bool leaves_out(const std::string& name, const DeckOptions& options);
  /// Leaves out cards that are not known, where the deck's user asks for it, and complains of each
  /// other one.
  /// @param known names that a reader knows, among which the one that was meant may be.
  /// @param instead how to say otherwise what the card says; empty: there may be no such card.
  void miss(SourceLine line, const std::string& name, const DeckOptions& options,
            const std::vector<std::string>& known, std::string_view instead = {});
  /// Complains of names in the options that no card was missed by.
  void check_left_out(const DeckOptions& options);

  bool has_complaints() const { return !complaints_.empty(); }
  /// @throws DeckError if there were complaints.
  void check() const;
  /// Moves ledger and remarks into the deck.
  void hand_over(Deck& deck);

 private:
  struct Complaint {
    SourceLine line;
    std::string text;
    int count = 1;
  };
  LedgerEntry& entry(std::string_view name);

  std::vector<std::string> files_;
  std::vector<Complaint> complaints_, remarks_;
  std::unordered_map<std::string, std::size_t> complaint_of_, remark_of_;
  std::map<std::string, LedgerEntry, std::less<>> ledger_;
  std::set<std::string, std::less<>> missed_;  ///< as was asked for
  /// Other names that are not known, with what was meant by each: ": did you mean X?", or nothing.
  std::map<std::string, std::string, std::less<>> unknown_;
};

/// One card or keyword is wrong; the reader adds file and line.
struct CardError {
  std::string text;
};

}  // namespace blocklift::structure
