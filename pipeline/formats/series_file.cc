#include "pipeline/formats/series_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "pipeline/formats/clock_time.h"
#include "structure/letter_case.h"

namespace blocklift::pipeline {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

/// What sets the cells of a line apart. A tabulator behind a comma is only white space.
char separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  const auto tabulator = line.find('\t', std::min(line.size(), line.find_first_not_of(" \t")));
  if (tabulator == std::string_view::npos || tabulator == 0) return ',';
  const auto before = line.find_last_not_of(" \t", tabulator);
  return before != std::string_view::npos && line[before] == ',' ? ',' : '\t';
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  std::size_t start = 0;
  while (true) {
    const std::size_t end = line.find(separator, start);
    cells.emplace_back(trimmed(line.substr(start, end - start)));
    if (end == std::string::npos) return cells;
    start = end + 1;
  }
}

std::optional<double> number(std::string cell, char separator) {
  if (separator != ',') std::replace(cell.begin(), cell.end(), ',', '.');
  double value = 0;
  const char* begin = cell.data();
  const char* end = begin + cell.size();
  if (cell.size() > 1 && *begin == '+' && cell[1] != '-') ++begin;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Does a logger say so that a value lacks?
bool says_nothing(const std::string& cell) {
  constexpr std::array<std::string_view, 6> words{"", "nan", "na", "n/a", "null", "-"};
  return std::find(words.begin(), words.end(), structure::lower(cell)) != words.end();
}

/// Puts rows into columns, a line after another.
class SeriesReader {
 public:
  SeriesReader(std::string path, SeriesCells allowed) : path_(std::move(path)), allowed_(allowed) {}

  void take(std::string_view line, int count) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') return;
    const char separator = separator_of(line);
    std::vector<std::string> cells = cells_of(line, separator);
    if (series_.columns.empty() && series_.names.empty() && !number(cells.front(), separator)) {
      series_.names = std::move(cells);
      return;
    }
    place_ = path_ + ":" + std::to_string(count) + ": ";
    if (series_.columns.empty()) {
      series_.lines_before = count - 1;
      series_.columns.resize(cells.size());
      kinds_.resize(cells.size());
      if (!series_.names.empty()) require_count(cells.size(), series_.names.size());
    }
    require_count(cells.size(), series_.columns.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
      series_.columns[i].push_back(value_of(cells[i], separator, i));
    series_.lines.push_back(count);
  }

  SeriesFile finish() {
    if (series_.row_count() == 0) throw SeriesFileError(path_ + ": the file has no rows");
    for (const auto& kind : kinds_) series_.is_clock.push_back(kind.has_value());
    drop_empty_end();
    return std::move(series_);
  }

 private:
  void require_count(std::size_t found, std::size_t due) const {
    if (found == due) return;
    throw SeriesFileError(place_ + std::to_string(found) + " values; " + std::to_string(due) +
                          " are due as in the lines before");
  }

  double value_of(const std::string& cell, char separator, std::size_t column) {
    std::optional<ClockTime>& kind = kinds_[column];
    if (const std::optional<double> value = number(cell, separator)) {
      if (kind)
        throw SeriesFileError(place_ + "\"" + cell +
                              "\" is a number where lines before have instants");
      return *value;
    }
    if (allowed_ == SeriesCells::numbers)
      throw SeriesFileError(place_ + "\"" + cell + "\" is not a finite number");
    if (says_nothing(cell)) return std::numeric_limits<double>::quiet_NaN();
    const std::optional<ClockTime> instant = read_clock_time(cell);
    if (!instant)
      throw SeriesFileError(place_ + "\"" + cell +
                            "\" is neither a finite number nor an instant such as "
                            "2026-05-04T10:00:00.5Z or 10:00:00.5");
    const std::vector<double>& before = series_.columns[column];
    if (!kind && std::any_of(before.begin(), before.end(), [](double v) { return !std::isnan(v); }))
      throw SeriesFileError(place_ + "\"" + cell +
                            "\" is an instant where lines before have numbers");
    if (!kind) kind = instant;
    if (kind->has_date != instant->has_date || kind->has_zone != instant->has_zone)
      throw SeriesFileError(
          place_ + "\"" + cell +
          "\" has a date or a zone where the lines before have none, or lacks it");
    series_.has_dates = series_.has_dates || instant->has_date;
    return instant->seconds;
  }

  /// Loggers end lines with a separator: a last column without a name and without a value is none.
  void drop_empty_end() {
    const auto lacks = [](double value) { return std::isnan(value); };
    if (series_.names.empty() || !series_.names.back().empty() ||
        !std::all_of(series_.columns.back().begin(), series_.columns.back().end(), lacks))
      return;
    series_.names.pop_back();
    series_.columns.pop_back();
    series_.is_clock.pop_back();
  }

  std::string path_;
  SeriesCells allowed_;
  SeriesFile series_;
  std::vector<std::optional<ClockTime>> kinds_;  ///< of each column: its first instant of a clock
  std::string place_;
};

}  // namespace

SeriesFile read_series_file(const std::filesystem::path& path, SeriesCells allowed) {
  std::ifstream stream(path);
  if (!stream) throw SeriesFileError(path.string() + ": the file cannot be read");
  SeriesReader reader(path.string(), allowed);
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::string line;
  for (int count = 1; std::getline(stream, line); ++count) {
    if (count == 1 && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
    reader.take(line, count);
  }
  return reader.finish();
}

}  // namespace blocklift::pipeline
