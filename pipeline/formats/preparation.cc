#include "pipeline/formats/preparation.h"

#include <system_error>
#include <vector>

#include "pipeline/formats/results_layout.h"

namespace blocklift::pipeline {

namespace fs = std::filesystem;

Preparation::Preparation(const fs::path& folder)
    : folder_(folder), aside_(folder / ".in-preparation") {
  for (fs::path above = fs::absolute(folder_).lexically_normal(); !fs::exists(above);
       above = above.parent_path()) {
    // "a/b/" has an empty name after its last slash
    if (above.has_filename()) made_.push_back(above);
  }
  fs::create_directories(folder_);
  fs::remove_all(aside_);
  fs::create_directory(aside_);
}

Preparation::~Preparation() {
  std::error_code ignored;
  fs::remove_all(aside_, ignored);
  // Only folders that are empty can be removed so.
  for (const fs::path& made : made_) fs::remove(made, ignored);
}

void Preparation::move_into_place() const {
  // Whoever is stopped between two files leaves no summary: never one beside another run's results.
  const fs::path summary = aside_ / layout::summary_file;
  std::error_code ignored;
  if (fs::exists(summary, ignored)) fs::remove(folder_ / layout::summary_file, ignored);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(aside_)) {
    if (entry.path() != summary) files.push_back(entry.path());
  }
  if (fs::exists(summary, ignored)) files.push_back(summary);
  for (const fs::path& file : files) fs::rename(file, folder_ / file.filename());
}

}  // namespace blocklift::pipeline
