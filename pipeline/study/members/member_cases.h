#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "pipeline/files/library/model_library.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/study/study_file.h"
#include "pipeline/study/members/block_masses.h"

namespace blocklift::pipeline {

/// The cases of a study's members. What of a case's files is the same in two members is read once.
class MemberCases {
 public:
  explicit MemberCases(const StudyFile& study)
      : study_(study), library_(ModelLibrary::of_installation()) {}

  /// From now on what a member's block states of its mass is held against its plates, too, as its
  /// run would. Members with the same block should follow one another.
  void hold_block_masses() { block_masses_.emplace(); }

  /// The case of a member: that of the study with the variables' values.
  /// @throws InputError with the values by which it is impossible, and below what is wrong by them:
  ///   each at its own place in the study if it alone makes the case impossible, else all of them
  ///   together. What is wrong with the case itself, whatever the values, is said alone.
  /// @param only the places of the variables whose values are taken; null: all are.
  LiftCase of(const Eigen::VectorXd& values, const std::vector<int>* only = nullptr);

 private:
  std::optional<LiftCase> read(const Eigen::VectorXd& values, const std::vector<int>* only,
                               Diagnostics& diagnostics);
  /// @throws InputError with what is wrong with the study's case as it stands, before any change.
  void check_unchanged_case();
  /// Complains, at its place, of each value that alone makes the case impossible, in a place that
  /// all values together make so.
  void blame_values(const Eigen::VectorXd& values, const Diagnostics& of_all, Diagnostics& blame);

  const StudyFile& study_;
  ModelLibrary library_;
  std::optional<BlockMasses> block_masses_;
};

}  // namespace blocklift::pipeline
