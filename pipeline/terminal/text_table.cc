#include "pipeline/terminal/text_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

constexpr std::size_t between_columns = 2;
constexpr std::size_t widest_text = 38;
constexpr int most_decimals = 9;

/// Characters, not bytes: continuation bytes of UTF-8 take no column.
std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::size_t longest_word(const std::string& text) {
  std::size_t longest = 0;
  for (const std::string& word : wrap_text(text, 1)) longest = std::max(longest, columns_of(word));
  return longest;
}

/// Decimals with which a value has so many significant digits.
int decimals_for(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return 0;
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0,
                    most_decimals);
}

bool needs_power_of_ten(double value) {
  return value != 0 && (std::abs(value) < 1e-4 || std::abs(value) >= 1e7);
}

/// "-0.0" would read as a sign of something.
std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos)
    text.erase(text.begin());
  return text;
}

std::string padded(const std::string& text, std::size_t width, bool to_the_right) {
  const std::size_t used = columns_of(text);
  const std::string blanks(width > used ? width - used : 0, ' ');
  return to_the_right ? blanks + text : text + blanks;
}

std::string without_blanks_at_end(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

/// One row of the table, of several lines where a text is broken.
std::string lines_of_row(const std::vector<std::string>& cells,
                         const std::vector<std::size_t>& chosen,
                         const std::vector<std::size_t>& widths,
                         const std::vector<TableColumn>& columns) {
  std::vector<std::vector<std::string>> broken;
  std::size_t height = 1;
  for (const std::size_t c : chosen) {
    broken.push_back(wrap_text(cells[c], widths[c]));
    height = std::max(height, broken.back().size());
  }
  std::string text;
  for (std::size_t line = 0; line < height; ++line) {
    std::string one;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const std::size_t c = chosen[i];
      if (i > 0) one += std::string(between_columns, ' ');
      one +=
          padded(line < broken[i].size() ? broken[i][line] : "", widths[c], columns[c].digits > 0);
    }
    text += without_blanks_at_end(std::move(one)) + "\n";
  }
  return text;
}

/// Columns of each part of a table whose lines keep to the terminal; the first is in all.
std::vector<std::vector<std::size_t>> fold(const std::vector<std::size_t>& widths) {
  std::vector<std::vector<std::size_t>> parts;
  std::size_t used = 0;
  for (std::size_t c = 1; c < widths.size(); ++c) {
    if (parts.empty() || used + between_columns + widths[c] > terminal_width) {
      parts.push_back({0});
      used = widths[0];
    }
    parts.back().push_back(c);
    used += between_columns + widths[c];
  }
  if (parts.empty()) parts.push_back({0});
  return parts;
}

}  // namespace

std::string format_figure(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (needs_power_of_ten(value)) return fmt::format("{:.{}e}", value, digits - 1);
  return fixed(value, decimals_for(value, digits));
}

std::vector<std::string> wrap_text(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.empty() && columns_of(lines.back()) + 1 + columns_of(word) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  if (lines.empty()) lines.emplace_back();
  return lines;
}

std::string wrapped_sentence(const std::string& sentence) {
  const std::string indent = "    ";
  std::string text, before;
  for (const std::string& line : wrap_text(sentence, terminal_width - indent.size())) {
    text += before + line + "\n";
    before = indent;
  }
  return text;
}

void print_wrapped(const std::string& sentence) { fmt::print("{}", wrapped_sentence(sentence)); }

void TextTable::add_row(std::vector<Cell> cells) {
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

double TextTable::largest_of(std::size_t column) const {
  double largest = 0;
  for (const std::vector<Cell>& row : rows_) {
    const double* number = std::get_if<double>(&row[column]);
    if (number && std::isfinite(*number)) largest = std::max(largest, std::abs(*number));
  }
  return largest;
}

std::vector<std::vector<std::string>> TextTable::formatted() const {
  std::vector<std::vector<std::string>> cells(rows_.size(),
                                              std::vector<std::string>(columns_.size()));
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const double largest = largest_of(c);
    const int digits = columns_[c].digits, decimals = decimals_for(largest, digits);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (const auto* text = std::get_if<std::string>(&rows_[r][c])) {
        cells[r][c] = *text;
        continue;
      }
      const double number = std::get<double>(rows_[r][c]);
      cells[r][c] = !std::isfinite(number)        ? "-"
                    : needs_power_of_ten(largest) ? format_figure(number, digits)
                                                  : fixed(number, decimals);
    }
  }
  return cells;
}

std::string TextTable::text() const {
  const std::vector<std::vector<std::string>> cells = formatted();
  std::vector<std::string> headings;
  std::vector<std::size_t> whole, broken;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const std::string& heading = headings.emplace_back(columns_[c].heading);
    std::size_t widest = 0, longest = longest_word(heading);
    for (const std::vector<std::string>& row : cells) {
      widest = std::max(widest, columns_of(row[c]));
      longest = std::max(longest, longest_word(row[c]));
    }
    if (columns_[c].digits == 0) widest = std::min(widest, std::max(widest_text, longest));
    broken.push_back(std::max(widest, longest_word(heading)));
    whole.push_back(std::max(widest, std::min(columns_of(heading), widest_text)));
  }
  // Headings break only where the table would not fit otherwise.
  const std::size_t gaps = between_columns * (columns_.size() - 1);
  const std::size_t total = std::accumulate(whole.begin(), whole.end(), gaps);
  const std::vector<std::size_t>& widths = total <= terminal_width ? whole : broken;
  std::string text;
  for (const std::vector<std::size_t>& part : fold(widths)) {
    if (!text.empty()) text += "\n";
    text += lines_of_row(headings, part, widths, columns_);
    for (const std::vector<std::string>& row : cells)
      text += lines_of_row(row, part, widths, columns_);
  }
  return text;
}

}  // namespace blocklift::pipeline
