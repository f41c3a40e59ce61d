#include "structure/mesh/files/nastran/card.h"

#include <fmt/format.h>

namespace blocklift::structure {

void CardView::refuse(std::size_t i, const char* what, const char* due) const {
  if (!has(i))
    throw CardError{fmt::format("the {} is missing (field {} of line {}); {} is due", what,
                                i % 8 + 2, i / 8 + 1, due)};
  throw CardError{fmt::format("\"{}\" as {} (field {} of line {}) is no {}", text(i), what,
                              i % 8 + 2, i / 8 + 1, due)};
}

long CardView::integer(std::size_t i, const char* what) const {
  const auto value = to_integer(text(i));
  if (!value) refuse(i, what, "whole number");
  return *value;
}

long CardView::integer(std::size_t i, const char* what, long otherwise) const {
  return has(i) ? integer(i, what) : otherwise;
}

long CardView::label(std::size_t i, const char* what) const {
  const auto value = to_integer(text(i));
  if (!value || *value < 1 || *value > 999999999) refuse(i, what, "number from 1 to 999999999");
  return *value;
}

long CardView::label(std::size_t i, const char* what, long otherwise) const {
  return has(i) ? label(i, what) : otherwise;
}

double CardView::real(std::size_t i, const char* what) const {
  const auto value = to_real(text(i));
  if (!value) refuse(i, what, "finite number");
  return *value;
}

double CardView::real(std::size_t i, const char* what, double otherwise) const {
  return has(i) ? real(i, what) : otherwise;
}

std::array<bool, 6> CardView::components(std::size_t i, const char* what) const {
  std::array<bool, 6> bound{};
  if (!has(i)) refuse(i, what, "list of components of 1 to 6");
  for (const char c : text(i)) {
    if (c == ' ') continue;  // in small fields: "12 456"
    if (c < '1' || c > '6' || bound[c - '1'])
      refuse(i, what, "list of components of 1 to 6, each once");
    bound[c - '1'] = true;
  }
  return bound;
}

}  // namespace blocklift::structure
