#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "structure/mesh/files/deck/text.h"

namespace blocklift::structure {

/// One line of data.
struct AbaqusLine {
  SourceLine line;
  std::string_view text;

  /// Its fields, without blanks about them; a comma at the end adds none.
  std::vector<std::string_view> fields() const;
};

/// A keyword with its parameters and the lines of data below it.
struct AbaqusBlock {
  std::string name;  ///< in capitals, with one blank between words: "SHELL SECTION"
  SourceLine line;
  struct Parameter {
    std::string name;   ///< in capitals
    std::string value;  ///< in capitals unless quoted
    std::string as_given;
  };
  std::vector<Parameter> parameters;
  std::vector<AbaqusLine> data;

  bool has(std::string_view parameter) const { return find(parameter) != nullptr; }
  /// Blanks within its name do not count.
  const Parameter* find(std::string_view parameter) const;
  /// Its value; empty if it is not given.
  std::string value(std::string_view parameter) const;
  /// Its value in capitals, or as it stands in the deck. @throws CardError if it is missing.
  std::string required(std::string_view parameter) const;
  std::string required_as_given(std::string_view parameter) const;
};

/// Blanks within names of keywords and parameters are free.
std::string without_blanks(std::string_view name);

/// Whether something holds for the keyword of a name, in capitals, without its asterisk.
using KeywordFilter = std::function<bool(const std::string&)>;

/// Splits a deck into keywords, with the files that it includes and those that have the lines of
/// data of a keyword (INPUT = file). Complaints go into the log.
/// @param is_read keywords whose lines of data are wanted.
std::vector<AbaqusBlock> read_abaqus_keywords(DeckFiles& files, const std::filesystem::path& path,
                                              DeckLog& log, const KeywordFilter& is_read);

/// The number in a field. @throws CardError if there is none.
long abaqus_label(std::string_view text, const char* what);
/// Any whole number.
long abaqus_integer(std::string_view text, const char* what);
double abaqus_real(const std::vector<std::string_view>& fields, std::size_t i, const char* what);
/// 0 or another value where the field is empty.
double abaqus_real(const std::vector<std::string_view>& fields, std::size_t i, const char* what,
                   double otherwise);

}  // namespace blocklift::structure
