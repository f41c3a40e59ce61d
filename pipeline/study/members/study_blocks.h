#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/files/study/study_file.h"
#include "pipeline/lift/lift_run.h"
#include "pipeline/simulation/lift_simulation.h"
#include "pipeline/study/members/member_cases.h"
#include "structure/accuracy/accuracy.h"
#include "structure/envelope/stress_basis.h"

namespace blocklift::pipeline {

/// Largest checked stress of a block at rest and in motion, over every instant of a lift.
struct LargestChecked {
  double at_rest = 0, in_motion = 0;                  ///< Pa
  double time_at_rest = 0, time_in_motion = 0;        ///< s
  structure::Vector3 place_at_rest, place_in_motion;  ///< in B, m
  double increase_percent() const;
};

/// The blocks of a study's members. Mesh, factor and unit stresses of a block serve all members
/// whose block differs in mass and centre of mass alone.
class StudyBlocks {
 public:
  /// @param folder where unit stresses are kept for all processes of the study.
  /// @param progress is told of what members are at, and may end it by what it throws.
  StudyBlocks(
      const StudyFile& study, std::filesystem::path folder,
      Progress progress = [](const std::string&, double, const std::string&) {});
  ~StudyBlocks();
  StudyBlocks(const StudyBlocks&) = delete;
  StudyBlocks& operator=(const StudyBlocks&) = delete;

  const Progress& progress() const { return progress_; }
  MemberCases& cases() { return cases_; }

  /// What the motion of a member takes from its block.
  /// @param values of the study's variables.
  KnownBlock of(const LiftCase& lift_case, const Eigen::VectorXd& values);

  /// The largest checked stress of a member that ran, over all squares of the block's plating. The
  /// mesh is that on which the stress of the case as it is written stands, with the values by which
  /// this block differs from it: its finest cells are where that stress is largest.
  LargestChecked find_stress(const LiftCase& lift_case, const LiftRun& run,
                             const Eigen::VectorXd& values);

  /// Finds the unit stresses of the design's blocks that are not kept yet; of several processes
  /// each takes every so-many-th. Blocks with ropes on their edges are left to their members: where
  /// those press follows from the motion, and needs the block's factor.
  void prepare(const Eigen::MatrixXd& design, int process, int processes);

 private:
  struct Kept;
  Kept& kept(const LiftCase& lift_case, const Eigen::VectorXd& values);
  /// The values by which a member's block differs from the case's in more than its mass.
  std::string key_of(const Eigen::VectorXd& values) const;
  std::filesystem::path file_of(const std::string& key) const;
  structure::RefinedBlock refine(const Eigen::VectorXd& values);
  static structure::StressBasis basis_of(const structure::RefinedBlock& block);
  void find_basis(Kept& block, bool over_edges, const Eigen::VectorXd& values);

  const StudyFile& study_;
  MemberCases cases_;
  std::filesystem::path folder_;
  Progress progress_;
  std::vector<int> changing_;  ///< variables that change more of the block than its mass
  std::vector<std::unique_ptr<Kept>> kept_;  ///< the latest last
};

}  // namespace blocklift::pipeline
