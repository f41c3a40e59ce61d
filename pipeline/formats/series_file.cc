#include "pipeline/formats/series_file.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

namespace blocklift::pipeline {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t start = 0;
  while (true) {
    const std::size_t end = line.find_first_of(",;", start);
    cells.emplace_back(trimmed(std::string_view(line).substr(start, end - start)));
    if (end == std::string::npos) return cells;
    start = end + 1;
  }
}

std::optional<double> number(const std::string& cell) {
  double value = 0;
  const char* end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

SeriesFile read_series_file(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) throw SeriesFileError(path.string() + ": the file cannot be read");
  SeriesFile series;
  std::string line;
  for (int count = 1; std::getline(stream, line); ++count) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    const std::string place = path.string() + ":" + std::to_string(count) + ": ";
    if (series.columns.empty() && series.names.empty() && !number(cells.front())) {
      series.names = cells;
      continue;
    }
    if (series.columns.empty()) {
      series.lines_before = count - 1;
      series.columns.resize(cells.size());
    }
    const std::size_t due = series.names.empty() ? series.columns.size() : series.names.size();
    if (cells.size() != due) {
      throw SeriesFileError(place + std::to_string(cells.size()) + " values; " +
                            std::to_string(due) + " are due as in the lines before");
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::optional<double> value = number(cells[i]);
      if (!value) throw SeriesFileError(place + "\"" + cells[i] + "\" is not a finite number");
      series.columns[i].push_back(*value);
    }
  }
  if (series.row_count() == 0) throw SeriesFileError(path.string() + ": the file has no rows");
  return series;
}

}  // namespace blocklift::pipeline
