#pragma once

#include <filesystem>

namespace blocklift::pipeline {

/// What a sample result has.
struct SampleParts {
  bool motion = true;          ///< histories, stages, scene
  bool structure = true;       ///< surface, fields, figures
  double motion_step = 0.005;  ///< of the samples in motion, s
};

/// Writes results.h5 and summary.json of an invented small lift (one crane, two ropes, a box as
/// block) in the layout of pipeline/formats/results/results_layout.h. Rope R1's dynamic tension has
/// one single sample that stands out, 987654 N at 43.21 s.
void write_sample_result(const std::filesystem::path& folder, const SampleParts& parts = {});

}  // namespace blocklift::pipeline
