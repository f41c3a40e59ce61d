#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace blocklift::pipeline {

/// Columns of a terminal that every table keeps to.
inline constexpr std::size_t terminal_width = 80;

/// A number of so many significant digits: digits before the point are never dropped, powers of ten
/// stand only for what is below 1e-4 or from 1e7 on, and what is no number is "-".
std::string format_figure(double value, int digits = 4);

/// A column of a table.
struct TableColumn {
  std::string heading;
  /// 0: text, to the left. Otherwise numbers, to the right: the largest has so many significant
  /// digits, and all have its decimals, so that they can be compared at a glance.
  int digits = 0;
};

/// A table for a terminal of 80 columns. What is too wide goes on below, in further tables that
/// repeat the first column; long texts break at blanks.
class TextTable {
 public:
  using Cell = std::variant<std::string, double>;

  explicit TextTable(std::vector<TableColumn> columns) : columns_(std::move(columns)) {}

  /// Cells that are missing at the end stay empty. A text in a column of numbers stands as it is.
  void add_row(std::vector<Cell> cells);

  bool empty() const { return rows_.empty(); }
  /// Heading and rows, each ending with a line feed.
  std::string text() const;

 private:
  /// The largest magnitude in a column; 0 if it has no numbers.
  double largest_of(std::size_t column) const;
  std::vector<std::vector<std::string>> formatted() const;

  std::vector<TableColumn> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// A text broken at blanks into lines of at most `width` columns; a word longer than that has a
/// line of its own.
std::vector<std::string> wrap_text(const std::string& text, std::size_t width);

/// A sentence broken at the terminal's columns, its later lines indented, each ending with a line
/// feed.
std::string wrapped_sentence(const std::string& sentence);

/// The same on standard output.
void print_wrapped(const std::string& sentence);

}  // namespace blocklift::pipeline
