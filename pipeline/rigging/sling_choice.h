#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/checks/checks.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/lift_run.h"
#include "pipeline/rigging/leg_sharing.h"
#include "pipeline/rigging/stock.h"
#include "pipeline/standards/lift_facts.h"

namespace blocklift::pipeline {

/// What a run asks of a sling.
struct SlingDemand {
  std::string rope;
  std::string lug;       ///< that it ends at; empty for a sling to a spreader
  double at_rest = 0;    ///< largest tension of the equilibria, N
  double in_motion = 0;  ///< largest tension of the motion, N
  SharedHook hook = {};  ///< that it hangs from beside other slings
};

/// The checks by which slings are chosen.
class SlingChecks {
 public:
  /// @param facts of the run, where the case has a standard.
  SlingChecks(const LiftCase& lift_case, std::optional<LiftFacts> facts)
      : case_(lift_case), facts_(std::move(facts)) {}

  /// What keeps a sling out of the question whatever its strength: a material or termination that
  /// the rules do not know, or a bend that is too sharp. Empty: nothing.
  std::string obstacle(const SlingInStock& candidate, const SlingDemand& demand) const;

  /// The candidate in place of the rope's own, without an obstacle:
  /// - breaking load, as far as the rope's own bend leaves it, over the case's factor against the
  ///   largest tension, at rest or in motion;
  /// - the standard's chain, in both columns, where its rules have a factor for slings;
  /// - without such rules, the working load against the largest tension at rest, or what the legs
  ///   on its hook ask (demand_with_legs); and the angle of these, by a rule that counts legs.
  std::vector<Check> of(const SlingInStock& candidate, const SlingDemand& demand) const;

 private:
  /// What a rope of the case is bent round, m; none: nothing.
  std::optional<double> bend_diameter(const std::string& name) const;
  bool has_rules() const { return facts_ && case_.standard->rules.sling.has_value(); }

  const LiftCase& case_;
  std::optional<LiftFacts> facts_;
};

/// A working load by a rule against what demand_with_legs asks at rest.
Check check_working_load(double working_load, const std::string& rule, double at_rest,
                         const SharedHook& hook);

/// A sling that was chosen for a rope.
struct ChosenSling {
  std::size_t index = 0;      ///< in the stock
  std::vector<Check> checks;  ///< of the run that chose it
  bool pass() const { return all_pass(checks); }
};

/// The weakest of the stock that passes all checks; where none does, the one that comes nearest.
/// @throws InputError where every sling of the stock has an obstacle.
ChosenSling choose_sling(const Stock& stock, const SlingChecks& checks, const SlingDemand& demand);

/// Largest tensions of the ropes that end at lugs or spreaders and have no winch of their own.
std::vector<SlingDemand> sling_demands(const LiftCase& lift_case, const LiftRun& lift);

}  // namespace blocklift::pipeline
