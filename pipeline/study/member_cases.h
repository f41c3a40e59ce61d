#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "pipeline/files/library/model_library.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/study/study_file.h"

namespace blocklift::pipeline {

/// The cases of a study's members. What of a case's files is the same in two members is read once.
class MemberCases {
 public:
  explicit MemberCases(const StudyFile& study)
      : study_(study), library_(ModelLibrary::of_installation()) {}

  /// The case of a member: that of the study with the variables' values.
  /// @throws InputError with what is wrong, and the values by which it is: each at its own line of
  ///   the study if it alone makes the case impossible, else all of them together.
  /// @param only the places of the variables whose values are taken; null: all are.
  LiftCase of(const Eigen::VectorXd& values, const std::vector<int>* only = nullptr);

 private:
  /// The variables whose values alone make the case impossible.
  std::vector<std::size_t> find_impossible(const Eigen::VectorXd& values);

  const StudyFile& study_;
  ModelLibrary library_;
};

}  // namespace blocklift::pipeline
