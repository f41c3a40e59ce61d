#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/formats/series_file.h"

namespace blocklift::pipeline {

/// A CSV file beside a study, its columns known by their names.
class StudyTable {
 public:
  /// @throws InputError if the file cannot be read (read_series_file).
  explicit StudyTable(const std::filesystem::path& path);

  std::size_t row_count() const { return file_.row_count(); }
  bool has(const std::string& column) const;
  /// Complains of columns that are none of these, or that are there twice.
  void check_names(const std::vector<std::string>& known, Diagnostics& diagnostics) const;
  /// A column's values; complains and is none if it is not there.
  const std::vector<double>* find(const std::string& column, Diagnostics& diagnostics) const;

  /// Where the names of columns stand, and where a row does.
  Mark head() const;
  Mark row(std::size_t row) const { return {name_, file_.lines[row], 1}; }

 private:
  std::shared_ptr<const std::string> name_;
  SeriesFile file_;
};

}  // namespace blocklift::pipeline
