#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/coupling/load_mapping.h"
#include "pipeline/lift/block_assessment.h"
#include "structure/envelope/block_envelope.h"
#include "structure/practice/fatigue.h"
#include "structure/practice/hot_spot.h"

namespace blocklift::pipeline {

/// Largest value over places and instants, with the rope that governs it.
struct HistoryExtreme {
  structure::TimedExtreme at;
  double time = 0;   ///< s
  std::string rope;  ///< with the largest share in the stress there and then; empty: none
  double share = 0;  ///< of that rope (structure::stress_shares), 1 is all of the stress
};

/// Largest checked stress of a group of plates, a pad or a lug, or about a lug.
struct HistoryGroup {
  std::string name;
  std::string material;     ///< of a group
  double yield_stress = 0;  ///< of a group, Pa
  HistoryExtreme checked_von_mises;
  structure::BySite<HistoryExtreme> at_site;  ///< over the squares of each site; instant
                                              ///< -1: none
};

/// What one history of the lift, every sample of it, does to the block.
struct HistoryState {
  Eigen::MatrixXd factors;  ///< of the unit responses, a column a sample
  Eigen::VectorXd time;     ///< s
  HistoryExtreme checked_von_mises, field_von_mises, peak_von_mises, largest_principal,
      smallest_principal, displacement;
  std::vector<HistoryGroup> groups, lugs;
  Eigen::VectorXd square_von_mises;    ///< largest of each square of the checked stress, Pa
  Eigen::VectorXd square_time;         ///< when, s
  Eigen::VectorXi square_rope;         ///< governing, place in names_of_ropes; -1: none
  structure::LoadCase governing;       ///< the instant of the largest checked stress
  double largest_force_residual = 0;   ///< of all samples, over the load (LoadBalance)
  double largest_moment_residual = 0;  ///< of all samples (LoadBalance)
  int places = 0;                      ///< squares and stress points that were searched
};

/// What a simpler practice gives in place of the envelope. Per cent; negative is unsafe.
struct PracticeComparison {
  double largest_percent = 0;  ///< its largest checked stress against the envelope's
  /// Its checked stress against the envelope's at the same square, where it falls short most, among
  /// squares whose envelope is at least half of the largest.
  double worst_percent = 0;
  structure::Extreme worst;  ///< the envelope there, Pa
  double squares_short = 0;  ///< share of those squares where it falls short by more than 1 %
};

/// Stress in time at one place, and what it wears out.
struct StressHistory {
  std::string name;
  structure::Vector3 point_B = structure::Vector3::Zero();  ///< the square's centre, m
  std::string part;
  Eigen::VectorXd static_von_mises, dynamic_von_mises;  ///< of the membrane stress, Pa
  /// Normal stress across the plane of the largest principal stress (in magnitude) at the instant
  /// of the largest dynamic von Mises stress, Pa. It is what cycles are counted of.
  Eigen::VectorXd static_normal, dynamic_normal;
  /// Of the dynamic history, repeated lift after lift, the block being unloaded in between.
  std::vector<structure::Cycles> cycles;
  double damage_per_lift = 0;  ///< Miner's sum
};

/// The block over the whole lift: every sample of both histories, none chosen.
struct HistoryAssessment {
  HistoryState static_state, dynamic_state;
  std::vector<structure::Square> squares;  ///< that the states' square values belong to
  std::vector<std::string> regions;        ///< names of single plates, by Square::region
  Eigen::VectorXd weights;                 ///< of the factors, for a LoadHistory
  std::vector<std::string> ropes;          ///< names_of_ropes
  PracticeComparison per_rope_maxima;      ///< every rope at its own largest dynamic load, at once
  PracticeComparison rope_instants;  ///< only the instants of each rope's largest dynamic load
  std::vector<StressHistory> points;
  structure::FatigueCurve curve;
  /// Structural stress at weld toes (structure::hot_spot_stress): von Mises of it, and the part of
  /// it across the weld as normal stress; damage by their own curve.
  std::vector<StressHistory> hot_spots;
  structure::FatigueCurve hot_spot_curve;
  double stress_concentration = 1;
  double lifts = 1;         ///< that the block sees
  double evaluation_s = 0;  ///< wall-clock time

  double stress_increase_percent() const;
  double deformation_increase_percent() const;
};

/// A place whose stress is followed in time, as the mean over a square about it (square_about), or
/// that of the nearest square of the checked stress where none fits.
struct FollowedPoint {
  std::string name;
  structure::Vector3 point_B = structure::Vector3::Zero();  ///< m
};

/// A weld toe whose structural stress is followed.
struct FollowedHotSpot {
  std::string name;
  structure::HotSpot spot;  ///< in B
};

/// What is asked of a history.
struct HistorySettings {
  std::vector<FollowedPoint> points;  ///< none: the hot spot of the envelope and that of each lug
  std::string fatigue_curve = "F";
  double stress_concentration = 1;  ///< by which the range is multiplied before the curve is read
  double lifts = 1;
  std::vector<FollowedHotSpot> hot_spots;
  std::string hot_spot_curve = "D";
};

/// Factors of the unit responses, a column a sample.
Eigen::MatrixXd factors_of(const structure::UnitResponses& responses,
                           const BlockAttachment& attachment, const BlockHistory& history);

/// Superposes every sample of both histories.
/// @throws std::runtime_error if a sample is not in balance to largest_balance_residual;
///   structure::ModelError if the block has no material where a hot spot is read.
HistoryAssessment assess_history(const structure::UnitResponses& responses,
                                 const structure::StressRecovery& recovery,
                                 const BlockAttachment& attachment,
                                 const BlockHistory& static_history,
                                 const BlockHistory& dynamic_history, const BlockAssessment& block,
                                 const HistorySettings& settings);

}  // namespace blocklift::pipeline
