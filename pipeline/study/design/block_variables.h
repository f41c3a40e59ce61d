#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/files/study/study_file.h"

namespace blocklift::pipeline {

/// The variables of a study that change more of a block than its mass and centre of mass: their
/// places among the study's.
/// @param block as the case names it.
std::vector<int> find_block_variables(const StudyFile& study, const std::string& block);

/// The values of such variables as text: members that have the same have the same block, but for
/// its mass and centre of mass.
/// @param only places of the variables whose values are taken; null: all are.
std::string block_key(const StudyFile& study, const std::vector<int>& block_variables,
                      const Eigen::VectorXd& values, const std::vector<int>* only = nullptr);

}  // namespace blocklift::pipeline
