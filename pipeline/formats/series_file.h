#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// Columns of numbers from a CSV file.
struct SeriesFile {
  std::vector<std::string> names;  ///< of the columns, as the header has them; may be empty
  std::vector<std::vector<double>> columns;  ///< all of one length
  /// Number of lines of the file before the first row, for messages.
  int lines_before = 0;

  std::size_t row_count() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// A series file cannot be used; what() says what was found and where.
class SeriesFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads rows of numbers set apart by commas or semicolons; a first line that is no row of numbers
/// is the header. Empty lines and lines that begin with # are passed over.
/// @throws SeriesFileError if the file cannot be read, has no rows, rows of different length, or a
///   value that is not a finite number.
SeriesFile read_series_file(const std::filesystem::path& path);

}  // namespace blocklift::pipeline
