#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/lift_run.h"
#include "pipeline/standards/lift_facts.h"
#include "pipeline/standards/rigging_balance.h"

namespace blocklift::pipeline {

/// The rigging of a lift at samples of its history at rest: what standards ask to be computed.
class RiggingFacts {
 public:
  /// @param compliance of the block at its lugs, 3 rows a lug in the order of `lugs`, m/N; empty:
  /// the
  ///   load is rigid.
  RiggingFacts(const LiftCase& lift_case, const LiftRun& lift, Eigen::MatrixXd compliance,
               std::vector<std::string> lugs);

  /// Ropes of the case that end at a lug.
  const std::vector<LiftRope>& slings() const { return slings_; }
  /// Slings to spreaders.
  const std::vector<LiftRope>& slings_to_bars() const { return to_bars_; }
  /// Slings round edges of the load that end at no lug.
  const std::vector<LiftRope>& baskets() const { return baskets_; }
  /// The name of a sling's hook; empty if it begins elsewhere.
  const std::string& hook_of(std::size_t sling) const { return slings_[sling].hoist; }
  /// Vertical part of all slings' forces on the load, at each sample, N.
  Eigen::VectorXd hook_load(const dynamics::History& history) const;
  /// Weight of a sling by its model's mass, N; none without.
  std::optional<double> weight_of(const LiftRope& sling) const;

  /// Factors at a sample at rest, for slings and for hooks.
  /// @param sling one of slings() or slings_to_bars().
  ComputedFactors of_sling(const LiftRope& sling, Eigen::Index sample) const;
  /// Those of hooks and cranes are of what hangs below the hook blocks, whose weight the box of the
  /// centre of mass leaves as it is.
  ComputedFactors of_hook(std::size_t hoist, Eigen::Index sample) const;
  ComputedFactors of_crane(std::size_t crane, Eigen::Index sample) const;
  /// What skews it at a sample at rest; none without a tolerance, with more ropes of one than
  /// RiggingBalance takes, and where the balance of single ropes has no say.
  std::shared_ptr<const TolerancedRigging> with_tolerances(Eigen::Index sample) const;

 private:
  struct State;
  const State& at(Eigen::Index sample) const;
  RiggingRope rigging_rope(int rope, const Eigen::Vector3d& pull_up, Eigen::Index sample) const;
  RiggingEnd end_at(const ResolvedPoint& point, Eigen::Index sample) const;
  TolerancedRigging rigging_at(Eigen::Index sample) const;
  bool is_balanced() const;
  std::vector<Eigen::Vector3d> corners_of_box() const;
  Eigen::MatrixXd compliance_of(const std::vector<RiggingRope>& ropes, Eigen::Index sample) const;
  dynamics::Pose pose_of(dynamics::BodyIndex body, Eigen::Index sample) const;
  double hook_block_weight(std::size_t hoist) const;  ///< N
  bool shares_the_load(std::size_t crane) const;      ///< Does another crane bear some of it?
  /// Do all ropes that hold the load or its spreaders lead to hooks of this name, or of this crane,
  /// and does nothing else bear any of it at a sample at rest?
  bool bears_all(const std::string& hook_or_crane, Eigen::Index sample) const;
  std::size_t first_tackle() const { return slings_.size() + to_bars_.size(); }
  bool leads_straight_to_hook(const LiftRope& sling) const;
  std::optional<TwoHooks> two_hooks(const std::string& hook, Eigen::Index sample) const;
  std::string crane_of(const std::string& hook) const { return hook.substr(0, hook.find('.')); }

  const LiftCase& case_;
  const LiftRun& lift_;
  Eigen::MatrixXd compliance_;
  std::vector<std::string> lugs_;
  std::vector<LiftRope> slings_, to_bars_, baskets_;
  Eigen::Vector3d p_BoBcm_;
  double weight_ = 0;  ///< of the load, N
  mutable std::vector<std::pair<Eigen::Index, std::shared_ptr<const State>>> states_;
};

}  // namespace blocklift::pipeline
