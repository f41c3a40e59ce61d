#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "structure/mesh/files/deck/log.h"

namespace blocklift::structure {

std::string_view trimmed(std::string_view text);
std::string upper(std::string_view text);
/// Whether two texts are one but for their case.
bool is_same(std::string_view a, std::string_view b);

/// A whole number, with or without a sign; nothing else.
std::optional<long> to_integer(std::string_view text);
/// A number as Fortran writes it: "1.", ".5", "1.5-3", "1.D5", "2E-3"; nothing for what is no
/// number, not finite, or out of range.
std::optional<double> to_real(std::string_view text);

/// The files of a deck, kept in memory so that views of their lines last.
class DeckFiles {
 public:
  explicit DeckFiles(DeckLog& log) : log_(log) {}

  struct File {
    int number = 0;
    std::filesystem::path path;
    std::vector<std::string_view> lines;  ///< without their ends
    bool is_ended = true;                 ///< the last line has its end
  };
  /// @throws DeckError if the file cannot be read or is no text.
  const File& open(const std::filesystem::path& path);
  /// A file that another names: it must lie in the folder of the deck or below it, unless files
  /// outside are allowed.
  /// @throws CardError if it does not, does not exist, or is being read already.
  const File& open_included(const std::filesystem::path& path, const File& from);
  void close() { reading_.pop_back(); }
  /// All that were read, in the order of their opening.
  std::vector<std::filesystem::path> paths() const;

 private:
  const File& load(const std::filesystem::path& path, const std::filesystem::path& canonical);

  DeckLog& log_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> reading_;
  std::vector<std::unique_ptr<std::string>> texts_;
  std::vector<std::unique_ptr<File>> files_;
};

}  // namespace blocklift::structure
