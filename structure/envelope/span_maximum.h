#pragma once

#include <Eigen/Core>

#include "structure/envelope/block_envelope.h"

namespace blocklift::structure {

/// The largest checked stress of a block over some of the instants of its history, found with what
/// is known of the whole of it.
///
/// No square has more in a part of the history than in the whole. So squares are looked at in the
/// order of their largest stress of all instants, and the search ends at the first square that had
/// less than what has been found: it is exact, and few squares are looked at. A block without
/// squares is searched at all of its stress points.
///
/// @param factors of the unit responses, one column an instant, of these instants alone; at least
/// one.
/// @param bounds of each square, no less than its largest stress over these instants
///   (PointExtremes::value of BlockEnvelope::squares), Pa.
/// @returns the extreme; its instant counts from the first of these instants; -1: no stress at all.
TimedExtreme find_largest_in_span(const UnitResponses& responses, const StressRecovery& recovery,
                                  const Eigen::MatrixXd& factors, const Eigen::VectorXd& bounds,
                                  int threads = 0);

}  // namespace blocklift::structure
