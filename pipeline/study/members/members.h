#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/study/study_file.h"
#include "pipeline/study/members/study_blocks.h"

namespace blocklift::pipeline {

/// Reads the cases of all members and holds what their blocks state of their mass against their
/// plates, so that nothing runs if one of them is impossible.
/// @throws InputError as MemberCases, of the first that is, a block after another.
void check_members(const StudyFile& study, const Eigen::MatrixXd& design,
                   const std::function<void(double fraction)>& progress);

/// A member that ran, or failed to.
struct Member {
  int number = 0;
  std::string failure;                                  ///< empty: it ran
  std::vector<std::pair<std::string, double>> figures;  ///< path in summary.json, value there
  std::vector<std::string> worse_when_smaller;          ///< those of the paths that are

  /// Units of figures whose paths do not tell them.
  std::vector<std::pair<std::string, std::string>> units = {};

  /// Figures that the study asks for and its summary does not have, with the one that may be meant;
  /// empty: none is near.
  std::vector<std::pair<std::string, std::string>> unknown = {};

  /// The figure at a path; not a number if there is none.
  double figure(const std::string& path) const;
  /// Its unit in the summary; empty for a pure number.
  std::string unit(const std::string& path) const;
};

/// A member as text, and back: what its file holds, and what a worker hands over.
std::string text_of_member(const Member& member);
Member member_of_text(int number, const std::string& text);

/// Computes a member: its motion, or stress and checks as well. What fails is told in it.
/// @param blocks of the study, which members of one process hand to one another.
/// @param full if given, all results are written into this folder, too; of stress those of an
/// assessment.
Member run_member(const StudyFile& study, const Eigen::VectorXd& values, int number,
                  StudyBlocks& blocks,
                  const std::optional<std::filesystem::path>& full = std::nullopt);

/// @throws InputError naming the figures of the study that a member which ran does not have.
void require_figures(const StudyFile& study, const Member& member);

/// Computes the first member of a search.
/// @throws InputError naming the figures of the search that the lift does not have.
Member run_first_member(const StudyFile& study, const Eigen::VectorXd& values, StudyBlocks& blocks);

/// The members that one machine of several computes: every so-many-th.
struct StudyPart {
  int index = 0;  ///< from 0
  int of = 1;

  bool has(int member) const { return member % of == index; }
  /// How many of the first `members` it has.
  int size(int members) const { return (members - index + of - 1) / of; }
};

/// The folder of a study's results while it runs: what is done is on the disk, a file a member.
class MemberStore {
 public:
  /// @param identity of study and case: members of another are not taken.
  /// @param part outside of which no member is taken or counted.
  /// @throws InputError if the folder holds members of another study.
  MemberStore(const std::filesystem::path& folder, const std::string& identity,
              StudyPart part = {});

  void write(const Member& member) const;
  /// @throws std::runtime_error if its file is damaged.
  std::optional<Member> read(int number) const;
  /// Of the first `members` those that are still to be computed, in order.
  std::vector<int> find_missing(int members) const;
  int count_done(int members) const {
    return count_all(members) - static_cast<int>(find_missing(members).size());
  }
  int count_all(int members) const { return part_.size(members); }
  /// Takes the members that another folder of the same study has and this one has not.
  /// @returns how many. @throws InputError if that folder has none, or those of another study.
  int take_over(const std::filesystem::path& folder) const;

 private:
  std::filesystem::path file_of(int number) const;

  std::filesystem::path folder_;
  std::string identity_;
  StudyPart part_;
};

/// Identity of all that the members' figures depend on: not of the study's limits, its title and
/// its comments.
std::string identity_of_study(const StudyFile& study);

}  // namespace blocklift::pipeline
