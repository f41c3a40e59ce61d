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
  std::vector<int> lines;      ///< of each row, for messages
  std::vector<bool> is_clock;  ///< of each column: its values were instants of a clock, now in s
  bool has_dates = false;      ///< such instants had dates: they count from the year 1970 on

  std::size_t row_count() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// A series file cannot be used; what() says what was found and where.
class SeriesFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a cell may hold besides a number.
enum class SeriesCells {
  numbers,  ///< nothing
  /// What loggers write: nothing or NaN where a value lacks (a quiet NaN then), and instants of a
  /// clock (read_clock_time).
  of_loggers
};

/// Reads rows of numbers set apart by commas, semicolons or tabulators; a first line that is no row
/// of numbers is the header. Between semicolons or tabulators a comma may stand for the decimal
/// point. Empty lines and lines that begin with # are passed over, and so is a byte order mark.
/// Text is UTF-8, any that ASCII is part of, or UTF-16; lines end by \n, \r\n or \r.
/// @throws SeriesFileError if the file cannot be read, has no rows, rows of different length, or a
///   value that is not a finite number, nor what else cells may hold.
SeriesFile read_series_file(const std::filesystem::path& path,
                            SeriesCells allowed = SeriesCells::numbers);

}  // namespace blocklift::pipeline
