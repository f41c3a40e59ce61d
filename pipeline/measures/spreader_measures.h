#pragma once

#include <optional>
#include <vector>

#include "pipeline/files/rigging/spreader_strength.h"
#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// The factor on the forces in spreaders.
double spreader_factor(const CheckSettings& checks);

/// A spreader, or another of its size in its place, with the points at which ropes pull at it.
SpreaderStrength strength_in_place(const given::Spreader& in_its_place,
                                   const LiftSpreader& spreader);

/// What ropes do to a spreader at a sample, in its axes, in the order of its ends, N.
std::vector<structure::PointForce> forces_on_spreader(const LiftSpreader& spreader,
                                                      const dynamics::History& history,
                                                      Eigen::Index sample);

/// The factor on the forces at which a spreader bears no more; bisected, since its moments grow
/// faster than they.
double growth_to_failure(const SpreaderStrength& strength, const SpreaderForces& forces);

/// The sample of the largest share of the resistance; none where nothing is asked of it.
std::optional<Eigen::Index> worst_instant(const given::Spreader& in_its_place,
                                          const LiftSpreader& spreader,
                                          const dynamics::History& history);

/// The most that the ropes of a spreader ask of another of its size in its place at any instant, at
/// rest and in motion: SpreaderStrength::utilisation with that factor.
double largest_share(const given::Spreader& in_its_place, const LiftSpreader& spreader,
                     const LiftRun& lift, double factor);

/// The downward pull of all that hangs below a spreader, at each sample, N.
Eigen::VectorXd hung_load(const LiftSpreader& spreader, const dynamics::History& history);

/// The load below a spreader that another of its size bears in its place: what hangs there at the
/// instant of the largest share of the resistance, grown with all forces of the ropes until
/// SpreaderStrength::utilisation reaches 1, N. Zero where nothing hangs at that instant.
double borne_load(const given::Spreader& in_its_place, const LiftSpreader& spreader,
                  const dynamics::History& history);

/// For each spreader its compression, its bending moment, that of torsion in a frame, and what it
/// bears over what it may, by SpreaderStrength::utilisation.
void add_spreader_measures(const LiftCase& lift_case, const LiftRun& lift,
                           std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
