#include "pipeline/study/limits/study_table.h"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace blocklift::pipeline {

StudyTable::StudyTable(const std::filesystem::path& path)
    : name_(std::make_shared<const std::string>(path.string())) {
  try {
    file_ = read_series_file(path);
  } catch (const SeriesFileError& error) {
    Diagnostics diagnostics;
    diagnostics.error({name_, 0, 0}, error.what());
    throw InputError(diagnostics);
  }
}

bool StudyTable::has(const std::string& column) const {
  return std::ranges::find(file_.names, column) != file_.names.end();
}

void StudyTable::check_names(const std::vector<std::string>& known,
                             Diagnostics& diagnostics) const {
  std::set<std::string_view> seen;
  for (const std::string& column : file_.names) {
    if (std::ranges::find(known, column) == known.end())
      diagnostics.error(head(), fmt::format("a column is called \"{}\"", column),
                        {fmt::format("known are {}", fmt::join(known, ", "))});
    else if (!seen.insert(column).second)
      diagnostics.error(head(), fmt::format("the column \"{}\" is there twice", column));
  }
}

const std::vector<double>* StudyTable::find(const std::string& column,
                                            Diagnostics& diagnostics) const {
  const auto found = std::ranges::find(file_.names, column);
  if (found != file_.names.end()) return &file_.columns[found - file_.names.begin()];
  diagnostics.error(head(), fmt::format("there is no column {}", column));
  return nullptr;
}

Mark StudyTable::head() const { return {name_, std::max(1, file_.lines_before), 1}; }

}  // namespace blocklift::pipeline
