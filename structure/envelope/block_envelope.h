#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/envelope/envelope.h"
#include "structure/stress/stress.h"

namespace blocklift::structure {

/// Extreme of a field over places and instants.
struct TimedExtreme : Extreme {
  int instant = -1;
  /// 6 x unit loads: the stress at that place for each of them, Pa; empty for a displacement.
  Eigen::MatrixXd unit_stress;
};

/// Largest stresses of one group (plates of a name, a pad, a lug) over all instants.
struct GroupEnvelope {
  std::string group;
  std::string material;
  double yield_stress = 0;  ///< Pa
  /// Over squares of plating; of a group that has none (beams, solids) the peak. Lugs of solids: 0.
  TimedExtreme checked_von_mises;
  /// The largest over the squares of each site; without squares the peak as a field's. Instant -1:
  /// none.
  BySite<TimedExtreme> at_site;
  TimedExtreme peak_von_mises;
};

/// Largest stresses within a sphere about a lug's pin over all instants.
struct LugEnvelope {
  std::string lug;
  TimedExtreme checked_von_mises;
  BySite<TimedExtreme> at_site;  ///< see GroupEnvelope
};

/// What a whole history of loads does to a block, every instant taken.
struct BlockEnvelope {
  TimedExtreme checked_von_mises;   ///< largest membrane stress over squares, Pa
  TimedExtreme field_von_mises;     ///< largest over squares away from corners, Pa
  TimedExtreme peak_von_mises;      ///< largest nodal value within any cell, nothing averaged, Pa
  TimedExtreme largest_principal;   ///< at the same places as the peak, Pa
  TimedExtreme smallest_principal;  ///< at these places, Pa
  TimedExtreme displacement;        ///< relative to the mean rigid motion, m
  std::vector<GroupEnvelope> groups;
  std::vector<LugEnvelope> lugs;
  PointExtremes squares;  ///< von Mises of the membrane stress of each of CheckedStress::squares()
  int places = 0;         ///< squares, nodes of shells on both surfaces, ends of beams
  int instants = 0;
};

/// Finds the envelope of a block over instants.
/// @param factors of the unit responses (UnitResponses::coefficients), one column an instant.
BlockEnvelope find_block_envelope(const UnitResponses& responses, const StressRecovery& recovery,
                                  const Eigen::MatrixXd& factors, int threads = 0);

/// Weights for a LoadHistory: root mean square of each unit response's membrane stress, Pa.
Eigen::VectorXd response_weights(const CheckedStress& checked);

/// The same; of a block without squares the root mean square over its stress points.
Eigen::VectorXd response_weights(const UnitResponses& responses, const StressRecovery& recovery);

/// Unit responses of the membrane stress of a square as a stress (11, 22 and 12 where xx, yy and xy
/// stand, the rest zero), 6 x unit loads, Pa.
Eigen::MatrixXd unit_stress_of_square(const CheckedStress& checked, int square);

/// The same of all squares for unit coordinates of a history of the loads.
PointResponses stress_of_squares(const CheckedStress& checked, const LoadHistory& history);

/// How much each part of a load has in a stress: with s_i the deviator of part i's stress and s
/// that of the whole, (s_i : s) / (s : s), which sum to 1 over parts that make up the whole.
/// @param unit_stress 6 x unit loads; @param parts factors of the unit loads, a column a part;
/// @param whole factors of all loads together.
Eigen::VectorXd stress_shares(const Eigen::MatrixXd& unit_stress, const Eigen::MatrixXd& parts,
                              const Eigen::VectorXd& whole);

}  // namespace blocklift::structure
