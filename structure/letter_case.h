#pragma once

#include <cctype>
#include <filesystem>
#include <string>

namespace blocklift::structure {

/// The text in capitals: decks name their cards and sets in either.
inline std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// The text in small letters.
inline std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// How a file's name ends, with the dot and in small letters; empty without an ending.
inline std::string ending_of(const std::filesystem::path& file) {
  return lower(file.extension().string());
}

}  // namespace blocklift::structure
