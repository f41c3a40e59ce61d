#pragma once

#include "dynamics/marine/radiation/wave_interaction.h"

namespace blocklift::dynamics {

/// Changes whenever bodies far apart get other figures for the same panels.
inline constexpr int distant_groups_version = 1;

/// Groups of bodies between which the mesh of the surface loses the shortest wave
/// (find_coupling_reaches), and whose circles lie apart: those that couple_by_waves can do better.
/// Bodies that lie closer, or within each other's circles, share a group.
/// @param highest_frequency rad/s.
/// @returns a single group of all bodies where nothing is gained.
std::vector<BodyGroup> find_distant_groups(const PanelModel& model, double highest_frequency);

/// A single group is computed as it is (compute_database). Of several each is computed on a surface
/// of its own, and coupled to the others by the waves that go from one to the other. Symmetry is
/// each group's own then.
/// @param model of all bodies; of its surface nothing is used by several groups.
/// @param settings as for compute_database; of several groups `time_step` and `duration` hold for
///   each, and there is no far field of all.
/// @param report figures of all groups together.
/// @throws ModelError, SimulationError as compute_database.
HydrodynamicDatabase compute_distant_groups(const PanelModel& model,
                                            const std::vector<BodyGroup>& groups,
                                            const DatabaseSettings& settings,
                                            DatabaseReport* report = nullptr);

}  // namespace blocklift::dynamics
