#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include <Eigen/Core>

#include "pipeline/files/study/study_file.h"
#include "pipeline/study/members/members.h"
#include "pipeline/study/results/study_results.h"

namespace blocklift::pipeline {

/// Reads a study. @throws InputError with all that is wrong in it.
StudyFile read_study(const std::filesystem::path& path);

/// The members of a study, a row each, all of which are found possible: nothing runs if one is not.
/// Of a search: its first sample.
/// @param progress is told the fraction of the members whose cases were read.
/// @throws InputError also for its limits and the sea states that it names.
Eigen::MatrixXd plan_members(const StudyFile& study,
                             const std::function<void(double fraction)>& progress);

/// Who computes the members of a study, and how.
struct StudyCrew {
  /// Computes those of the design's members that a store lacks, in any sequence, and writes them.
  std::function<void(const StudyFile& study, const Eigen::MatrixXd& design,
                     const MemberStore& store)>
      compute_missing;
  /// Writes a member of a search, whose members are computed one after another.
  std::function<void(const MemberStore& store, const Member& member)> write;
  /// Is told of each member of a search before it is computed.
  std::function<void(int number)> begin_of_search_member;
  /// Is told what members of a search are at.
  Progress progress = [](const std::string&, double, const std::string&) {};
};

/// Has all members of a study computed that its store lacks, and finds what they say together.
/// @param folder of the study's results.
/// @throws InputError if the lift has not the figures of a search, of which nothing is left then;
///   std::runtime_error if no member ran.
StudyResults run_study(StudyFile study, Eigen::MatrixXd design, const std::filesystem::path& folder,
                       const MemberStore& store, const StudyCrew& crew);

/// Computes those of the design's members that a store lacks, one after another, in this process.
/// @param progress is told what members are at; what it throws ends the study.
void compute_one_by_one(const StudyFile& study, const Eigen::MatrixXd& design,
                        const std::filesystem::path& folder, const MemberStore& store,
                        const Progress& progress);

/// The member whose whole results are looked at, and the folder that they go into: the best of a
/// search, else the one with the worst leading figure.
struct ShownMember {
  int number = 0;
  std::filesystem::path folder;
};
/// @returns nothing if there is no leading figure.
std::optional<ShownMember> shown_member(const StudyResults& results,
                                        const std::filesystem::path& folder);

}  // namespace blocklift::pipeline
