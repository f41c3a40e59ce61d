#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/files/lift_case/standard_in_case.h"
#include "pipeline/standards/chain.h"
#include "pipeline/standards/lift_facts.h"

namespace blocklift::pipeline {

/// The factors on loads that hooks, slings, lugs and cranes have in common, as steps of a chain.
class LoadFactors {
 public:
  LoadFactors(const given::Standard& standard, const LiftFacts& facts);

  void add_contingency(ChainBuilder& chain) const;
  /// By the box of the centre where the case has one, else by the rules' factor.
  void add_centre(ChainBuilder& chain, const ComputedFactors& computed) const;
  /// @param simulated how the whole load on the hooks grew by the motion.
  void add_amplification(ChainBuilder& chain, std::optional<double> simulated,
                         double hoisting_speed) const;
  /// Of the thing's own share in motion: the simulation alone has it.
  static void add_resharing(ChainBuilder& chain, const LoadFacts& load);
  void add_tilt(ChainBuilder& chain, const ComputedFactors& computed) const;
  void add_yaw(ChainBuilder& chain, int slings_on_hook) const;
  void add_skew(ChainBuilder& chain, const ComputedFactors& computed) const;
  /// Of the structure's stress: the largest of the slings that pull at the lug at hand, and of all
  /// at the load for other places, so that the structure takes no less than the loads on it. Slings
  /// that bear less than a quarter of the most loaded one's load at rest do not count.
  void add_structure_centre(ChainBuilder& chain, const StressFacts& stress) const;
  /// The same of tilt and yaw.
  void add_structure_tilt(ChainBuilder& chain, const StressFacts& stress) const;
  /// Of a frame, when either diagonal of its four slings bears more; else as add_skew.
  void add_frame_skew(ChainBuilder& chain, const SpreaderFacts& frame) const;
  /// Of the structure's stress, when either diagonal of four slings bears more.
  void add_structure_skew(ChainBuilder& chain, const StressFacts& stress) const;

  /// Of the design of lift points and spreader bars; nothing where the rules have none.
  void add_lift_point_consequence(ChainBuilder& chain) const;

  /// All of them on the load of a sling, a shackle or a lug.
  /// @param in_motion false: without amplification, for what is held against the static load.
  void add_all(ChainBuilder& chain, const LoadFacts& load, const ComputedFactors& computed,
               int slings_on_hook, bool in_motion = true) const;

  /// The same but skew.
  void add_all_but_skew(ChainBuilder& chain, const LoadFacts& load, const ComputedFactors& computed,
                        int slings_on_hook, bool in_motion = true) const;

  /// All of them on what the slings at a lug bear together. Each sling has its own factors, and
  /// bears anything between its load and that times them: the sum of the forces is that of the
  /// worst of these sets.
  void add_all_at_lug(ChainBuilder& chain, const LugPull& pull, bool in_motion = true) const;

  /// Amplification of the rules; 1 without. @param hoisting_speed where it depends on that, m/s.
  double amplification(double hoisting_speed) const;
  /// Weight with contingency, by which the row of an amplification is chosen (the gross weight of
  /// 0027/ND, table 5-1), N.
  double design_weight() const;
  /// That and rigging, N.
  double static_hook_load() const;
  /// Fastest of the hoists, m/s.
  double hoisting_speed() const;

  const given::Standard& standard() const { return standard_; }
  const StandardRules& rules() const { return standard_.rules; }
  const LiftFacts& facts() const { return facts_; }
  const HoistingClass* hoisting_class() const;

 private:
  /// Step of a chain before it is added.
  struct Factor {
    std::string name;
    std::optional<double> standard, simulated;
    std::string clause, formula;
  };
  static void add(ChainBuilder& chain, std::optional<Factor> factor);
  std::optional<Factor> centre(const ComputedFactors& computed) const;
  std::optional<Factor> tilt(const ComputedFactors& computed) const;
  std::optional<Factor> yaw(int slings_on_hook) const;
  std::optional<Factor> skew(const ComputedFactors& computed) const;
  void add_load(ChainBuilder& chain, const LoadFacts& load) const;
  std::vector<const SlingFacts*> slings_that_load(const StressFacts& stress) const;
  void add_largest(ChainBuilder& chain, const StressFacts& stress,
                   const std::function<std::optional<Factor>(const SlingFacts&)>& factor_of) const;
  void add_diagonal_skew(ChainBuilder& chain, std::optional<double> by_rules,
                         std::optional<double> computed, const char* what) const;
  const NamedFactor* contingency() const;
  const AmplificationRow* amplification_row() const;

  const given::Standard& standard_;
  const LiftFacts& facts_;
};

/// "1,969 kN (200.7 t)".
std::string load_text(double newtons);

}  // namespace blocklift::pipeline
