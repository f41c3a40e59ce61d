#pragma once

#include <cctype>
#include <string>

namespace blocklift::structure {

/// The text in capitals: decks name their cards and sets in either.
inline std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace blocklift::structure
