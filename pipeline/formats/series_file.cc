#include "pipeline/formats/series_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
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

constexpr const char* first_row_hint =
    "; one line is the header, and others before the first row have to begin with #";

/// Does a logger say so that a value lacks?
bool says_nothing(const std::string& cell) {
  constexpr std::array<std::string_view, 9> words{"",     "nan", "na", "n/a", "#n/a",
                                                  "null", "-",   "--", "---"};
  return std::find(words.begin(), words.end(), structure::lower(cell)) != words.end();
}

/// Puts rows into columns, a line after another.
class SeriesReader {
 public:
  SeriesReader(std::string path, SeriesCells allowed) : path_(std::move(path)), allowed_(allowed) {}

  void take(std::string_view line, int count) {
    const std::string_view content = trimmed(line);
    if (content.empty()) return;
    const char separator = separator_of(line);
    std::vector<std::string> cells = cells_of(line, separator);
    // #N/A in the first cell makes no remark of a row.
    if (content.front() == '#' && !says_nothing(cells.front())) return;
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
    const std::string about_first = series_.lines.empty() ? first_row_hint : "";
    if (allowed_ == SeriesCells::numbers)
      throw SeriesFileError(place_ + "\"" + cell + "\" is not a finite number" + about_first);
    if (says_nothing(cell)) return std::numeric_limits<double>::quiet_NaN();
    const std::optional<ClockTime> instant = read_clock_time(cell);
    if (!instant)
      throw SeriesFileError(place_ + "\"" + cell +
                            "\" is neither a finite number nor an instant such as "
                            "2026-05-04T10:00:00.5Z or 10:00:00.5" +
                            about_first);
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

/// A character in UTF-8 (RFC 3629).
void append(char32_t character, std::string& text) {
  const auto add = [&](char32_t byte) { text += static_cast<char>(byte); };
  if (character < 0x80) return add(character);
  if (character < 0x800) {
    add(0xC0 | (character >> 6));
  } else if (character < 0x10000) {
    add(0xE0 | (character >> 12));
    add(0x80 | ((character >> 6) & 0x3F));
  } else {
    add(0xF0 | (character >> 18));
    add(0x80 | ((character >> 12) & 0x3F));
    add(0x80 | ((character >> 6) & 0x3F));
  }
  add(0x80 | (character & 0x3F));
}

/// UTF-16 in UTF-8; half of a pair is what does not exist, U+FFFD.
std::string from_utf16(std::string_view bytes, bool is_little_endian) {
  constexpr char32_t none = 0xFFFD;
  std::string text;
  const auto unit = [&](std::size_t i) -> char32_t {
    const auto first = static_cast<unsigned char>(bytes[i]),
               second = static_cast<unsigned char>(bytes[i + 1]);
    return is_little_endian ? first | char32_t{second} << 8 : second | char32_t{first} << 8;
  };
  const auto is_half = [](char32_t one, char32_t from) {
    return one >= from && one < from + 0x400;
  };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const char32_t one = unit(i);
    if (is_half(one, 0xD800) && i + 3 < bytes.size() && is_half(unit(i + 2), 0xDC00)) {
      append(0x10000 + ((one - 0xD800) << 10) + (unit(i + 2) - 0xDC00), text);
      i += 2;
    } else {
      append(is_half(one, 0xD800) || is_half(one, 0xDC00) ? none : one, text);
    }
  }
  return text;
}

/// The text of a file, by its byte order mark; without one, UTF-16 has a zero in its first
/// character, which numbers and names in Latin letters have.
std::string in_utf8(std::string bytes, const std::string& path) {
  using namespace std::string_view_literals;
  const std::string_view all = bytes;
  if (all.starts_with("\xEF\xBB\xBF"sv)) return bytes.substr(3);
  if (all.starts_with("\xFF\xFE"sv)) return from_utf16(all.substr(2), true);
  if (all.starts_with("\xFE\xFF"sv)) return from_utf16(all.substr(2), false);
  if (all.size() > 1 && (all[0] == 0) != (all[1] == 0)) return from_utf16(all, all[1] == 0);
  if (const std::size_t zero = all.find('\0'); zero != std::string_view::npos)
    throw SeriesFileError(
        path + ":" +
        std::to_string(1 + std::count(bytes.begin(),
                                      bytes.begin() + static_cast<std::ptrdiff_t>(zero), '\n')) +
        ": a zero byte, which no text has: the file may be damaged");
  return bytes;
}

}  // namespace

SeriesFile read_series_file(const std::filesystem::path& path, SeriesCells allowed) {
  // Of a folder the stream opens, and what reads it throws a word without its name.
  if (std::error_code error; std::filesystem::is_directory(path, error))
    throw SeriesFileError(path.string() + ": this is a folder; a file of rows of numbers is due");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw SeriesFileError(path.string() + ": the file cannot be read");
  const std::string text = in_utf8({std::istreambuf_iterator<char>(stream), {}}, path.string());
  SeriesReader reader(path.string(), allowed);
  int count = 1;
  for (std::size_t begin = 0; begin < text.size(); ++count) {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    reader.take(std::string_view(text).substr(begin, end - begin), count);
    begin = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
  }
  return reader.finish();
}

}  // namespace blocklift::pipeline
