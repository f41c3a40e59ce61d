#pragma once

#include "dynamics/marine/radiation/distant_groups.h"

namespace blocklift::dynamics {

/// How the flow about hulls is found.
enum class PanelMethod {
  marched_surface,  ///< panels on hulls and surface, marched in time (compute_distant_groups)
  green_function    ///< panels on hulls alone, whose sources make waves (compute_hull_database)
};

/// Changes whenever compute_hull_database gives other figures for the same bodies, the
/// estimate of the panels' error among them.
inline constexpr int hull_method_version = 5;

/// The database of a model's bodies by a method.
/// @param groups of bodies far from each other, of which the Green function needs to know nothing.
/// @throws ModelError, SimulationError as the method.
HydrodynamicDatabase compute_by_method(PanelMethod method, const PanelModel& model,
                                       const std::vector<BodyGroup>& groups,
                                       const DatabaseSettings& settings);

/// Memory (bytes) that it takes at its peak, at most.
double bytes_by_method(PanelMethod method, const PanelModel& model,
                       const DatabaseSettings& settings);

}  // namespace blocklift::dynamics
