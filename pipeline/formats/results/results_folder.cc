#include "pipeline/formats/results/results_folder.h"

#include <stdexcept>

#include "pipeline/formats/read_apart.h"
#include "pipeline/formats/results/results_check.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results/summary_check.h"
#include "pipeline/formats/results/summary_file.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// Readers say the file's name first.
std::string without_name(const std::string& message, const fs::path& file) {
  const std::string name = file.string() + ": ";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

std::vector<std::string> read_and_check_summary(const fs::path& file) {
  try {
    return complaints_about_summary(read_summary(file));
  } catch (const std::runtime_error& error) {
    return {error.what()};
  }
}

std::vector<std::string> read_and_check_results(const fs::path& file, const PlaceOfReading& next) {
  try {
    return complaints_about_results(ResultsReader(file), next);
  } catch (const ResultsError& error) {
    return {error.what()};
  }
}

}  // namespace

std::vector<FileComplaint> complaints_about_folder(const fs::path& folder) {
  std::vector<FileComplaint> complaints;
  const fs::path summary = folder / layout::summary_file, results = folder / layout::results_file;
  for (const std::string& message : read_and_check_summary(summary))
    complaints.push_back({summary, without_name(message, summary)});
  for (const std::string& message : complaints_of_reading(results, [&](const PlaceOfReading& next) {
         return read_and_check_results(results, next);
       }))
    complaints.push_back({results, without_name(message, results)});
  return complaints;
}

}  // namespace blocklift::pipeline
