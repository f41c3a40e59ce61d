#pragma once

#include <filesystem>

#include "pipeline/study/results/study_results.h"

namespace blocklift::pipeline {

/// Writes study.csv and study.h5 (a member a row), study.json and study.html into a folder: all of
/// them or none.
void write_study(const StudyResults& results, const std::filesystem::path& folder);

}  // namespace blocklift::pipeline
