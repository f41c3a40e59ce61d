#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/coupling/load_mapping.h"
#include "structure/output/surface.h"
#include "structure/stress/stress.h"

namespace blocklift::pipeline {

/// The two histories of a lift that are set beside each other.
enum class MotionState { static_state, dynamic_state };

/// How far a value lies above a reference, per cent of it; 0 where the reference is not positive.
inline double percent_above(double value, double reference) {
  return reference > 0 ? 100 * (value / reference - 1) : 0;
}

/// A load case of the block with what it does to it.
struct BlockState {
  structure::LoadCase load;
  structure::LoadCaseResult result;
  std::string rope;            ///< whose largest load chose the instant; empty: all ropes' maxima
  std::optional<double> time;  ///< of the instant, s
};

/// Static and dynamic load cases of one way of combining the rope loads.
struct LoadComparison {
  BlockState static_state;
  BlockState dynamic_state;
  /// Largest value of each kind among the states compared (they may come from different instants).
  double static_displacement = 0;   ///< m
  double dynamic_displacement = 0;  ///< m

  /// Of the largest checked von Mises stress, per cent of the static one.
  double stress_increase_percent() const;
  /// Of the largest displacement relative to the rigid motion, per cent of the static one.
  double deformation_increase_percent() const;
};

/// What the lift does to the block.
struct BlockAssessment {
  LoadComparison per_rope_maxima;  ///< every rope at its own largest load, all at once
  std::vector<LoadComparison> simultaneous_by_rope;  ///< the instant of each rope's largest load
  LoadComparison simultaneous;                       ///< the larger over the instants of all ropes
  double evaluation_s = 0;                           ///< wall-clock time
};

/// Largest residuals that a balanced load case may have.
inline constexpr double largest_balance_residual = 1e-8;
/// Largest reaction of the 3-2-1 support, over the block's weight.
inline constexpr double largest_reaction = 1e-6;

/// Of the free block, s: to about a hundredth, for it tells fast loads from slow ones. A period
/// belongs to the whole block and is nearly that of finer meshes.
double find_first_elastic_period(const structure::UnitResponses& responses);

/// Evaluates the load cases of a lift.
/// @throws std::runtime_error if a load case is not in balance to largest_balance_residual or a
///   support that should carry nothing reacts with more than largest_reaction: then the two stages
///   contradict each other and no stress can be trusted.
BlockAssessment assess_block(const structure::UnitResponses& responses,
                             const structure::StressRecovery& recovery,
                             const BlockAttachment& attachment, const BlockHistory& static_history,
                             const BlockHistory& dynamic_history);

/// The same for a load table: one static and one dynamic set of forces (N, in B, one a lug) that
/// act at once, balanced by inertia. All ways of combining them are this one.
BlockAssessment assess_load_table(const structure::UnitResponses& responses,
                                  const structure::StressRecovery& recovery,
                                  const std::vector<structure::Vector3>& static_forces_B,
                                  const std::vector<structure::Vector3>& dynamic_forces_B);

}  // namespace blocklift::pipeline
