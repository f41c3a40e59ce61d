#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "structure/mesh/files/deck/text.h"

namespace blocklift::structure {

/// A card with its continuations. Each line gives eight fields of data, the blank ones too: field k
/// of line l (manuals count the first of data as 2) is data[8 l + k - 2].
struct NastranCard {
  std::string name;  ///< in capitals, without the asterisk of large fields
  SourceLine line;   ///< of its first
  std::vector<std::string_view>::size_type first = 0, count = 0;  ///< in NastranBulk::data
};

/// A line of case control, without its comment.
struct CaseControlLine {
  SourceLine line;
  std::string_view text;
};

/// The cards of a deck, in their order.
struct NastranBulk {
  std::vector<NastranCard> cards;
  std::vector<std::string_view> data;
  std::vector<CaseControlLine> case_control;
  bool has_case_control = false;
  /// Names that preprocessors write in comments, by what they name and its number: {"PROP", 4}.
  std::map<std::pair<std::string, long>, std::string> names;
  std::deque<std::string> kept;  ///< lines with tabs, laid out
};

/// Splits a deck into cards: free, small and large fields, continuations that follow their card or
/// name it, INCLUDE. The executive section is passed over; without BEGIN BULK all is bulk data.
/// Complaints go into the log.
NastranBulk read_nastran_cards(DeckFiles& files, const std::filesystem::path& path, DeckLog& log);

}  // namespace blocklift::structure
