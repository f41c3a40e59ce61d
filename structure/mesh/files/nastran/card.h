#pragma once

#include <array>
#include <string>
#include <string_view>

#include "structure/mesh/files/nastran/bulk.h"

namespace blocklift::structure {

/// The fields of one card, by their place in its data: 0 is what manuals call field 2, 8 the first
/// of the second line.
///
/// @throws CardError from all that read a value, naming field, text and what is due.
class CardView {
 public:
  CardView(const NastranBulk& bulk, const NastranCard& card) : bulk_(&bulk), card_(&card) {}

  const std::string& name() const { return card_->name; }
  SourceLine line() const { return card_->line; }
  std::size_t size() const { return card_->count; }

  std::string_view text(std::size_t i) const {
    return i < card_->count ? bulk_->data[card_->first + i] : std::string_view();
  }
  bool has(std::size_t i) const { return !text(i).empty(); }
  bool is(std::size_t i, std::string_view word) const { return is_same(text(i), word); }
  bool is_integer(std::size_t i) const { return to_integer(text(i)).has_value(); }

  long integer(std::size_t i, const char* what) const;
  long integer(std::size_t i, const char* what, long otherwise) const;
  /// A number of a card, grid or element: positive.
  long label(std::size_t i, const char* what) const;
  long label(std::size_t i, const char* what, long otherwise) const;
  double real(std::size_t i, const char* what) const;
  double real(std::size_t i, const char* what, double otherwise) const;
  /// Digits 1 to 6, each once; blanks between them do not count.
  std::array<bool, 6> components(std::size_t i, const char* what) const;

 private:
  [[noreturn]] void refuse(std::size_t i, const char* what, const char* due) const;

  const NastranBulk* bulk_;
  const NastranCard* card_;
};

}  // namespace blocklift::structure
