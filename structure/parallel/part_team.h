#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/parallel/distributed_system.h"
#include "structure/parallel/part_share.h"
#include "structure/process_group.h"

namespace blocklift::structure {

/// The leader's side of a part that several processes solve: it holds the whole mesh, deals it out,
/// and gathers the displacement. The other processes follow (follow_part_team) until it is gone.
class PartTeam {
 public:
  explicit PartTeam(const ProcessGroup& group);
  ~PartTeam();
  PartTeam(const PartTeam&) = delete;
  PartTeam& operator=(const PartTeam&) = delete;

  /// @throws ModelError as solve_share, or if there are more processes than solids.
  PartDisplacement solve(const PartModel& model, const std::vector<FixedUnknown>& fixed,
                         const Eigen::VectorXd& load, const SolverChoice& choice);

  /// Each process writes the solids of its share with the last solution, `STEM_0.vtu` and so on;
  /// the leader writes STEM.pvtu, which ParaView opens. @throws ModelError if a file cannot be
  /// written.
  void write_pieces(const std::string& stem) const;

 private:
  const ProcessGroup& group_;
  std::optional<PartShare> share_;
  Eigen::VectorXd displacement_;  ///< of the own share
};

/// Does what the leader of the group asks for, until it ends.
void follow_part_team(const ProcessGroup& group);

}  // namespace blocklift::structure
