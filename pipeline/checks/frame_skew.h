#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pipeline/lift/lift_run.h"
#include "pipeline/measures/spreader_measures.h"
#include "pipeline/standards/lift_facts.h"
#include "pipeline/standards/rigging_balance.h"

namespace blocklift::pipeline {

/// By how much less a frame bears when its four slings from above share unevenly: the load below it
/// at which it fails as they are at rest, over that when the slings of either diagonal reach their
/// skew and the others give way (diagonal_changes), whichever is less. At its worst instant at
/// rest. Ropes below it follow their corner, as stiff ropes to a stiff load do, so that its sides
/// hang through no further. Rigid corners are bent in its plane: of a frame of the width W whose
/// sides of the length L bear the compression N, a share d more on one diagonal and less on the
/// other leaves N as it is and bends the corners by d N W / 2.
/// Source: GL Noble Denton 0027/ND rev. 11.2 (2016), 11.6.1, by which frames have the load cases of
/// the lifted structure, and 5.6.12.
/// @param skew_of the factor of a rope by its index in the system.
/// @returns none for bars, without four slings whose lines meet, and where nothing hangs at one of
///   their corners.
std::optional<double> frame_skew(const given::Spreader& in_case, const LiftSpreader& frame,
                                 const dynamics::History& at_rest,
                                 const std::function<double(int)>& skew_of);

/// The same with the tensions of each set of the slings' length tolerances, above the frame and
/// below it, the frame giving way to them in its plane and out of it: by stiffness of slings, frame
/// and load times the mismatch. The largest of all sets.
/// @param in_its_place of the frame, or of another of its size.
double frame_skew_by_tolerances(const given::Spreader& in_its_place, const LiftSpreader& frame,
                                const LiftCase& lift_case, const LiftRun& lift,
                                const TolerancedRigging& rigging, Eigen::Index sample);

/// Both of a frame, or of another of its size in its place, by the skew factor of the case's rules
/// and by the slings' tolerances of length, for the latter at the instant at which the frame of the
/// case bears most.
/// @param facts with its rigging.
void find_frame_skew(const given::Spreader& in_its_place, const LiftSpreader& frame,
                     const LiftCase& lift_case, const LiftRun& lift, SpreaderFacts& facts);

}  // namespace blocklift::pipeline
