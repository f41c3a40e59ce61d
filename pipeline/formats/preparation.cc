#include "pipeline/formats/preparation.h"

#include <system_error>

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
  for (const fs::directory_entry& entry : fs::directory_iterator(aside_))
    fs::rename(entry.path(), folder_ / entry.path().filename());
}

}  // namespace blocklift::pipeline
