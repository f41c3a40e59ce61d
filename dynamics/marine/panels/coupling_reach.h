#pragma once

#include <optional>
#include <vector>

#include "dynamics/marine/panels/panel_model.h"

namespace blocklift::dynamics {

/// How far waves carry from one body to another on the mesh of the surface.
struct CouplingReach {
  int first = 0, second = 0;       ///< the bodies
  double gap = not_a_number;       ///< between their water lines, m
  double shortest = not_a_number;  ///< wave that still couples them, m; at most the gap
};

/// Rings widen outwards, and with them the panels between bodies. Waves shorter than eight of the
/// widest panel there are lost on their way: two floating hemispheres, radius a, 16 a apart keep
/// nine tenths of their coupling's damping with 8.5 panels in a wave, half of it with 4.8 and a
/// third with 3.1 (against B12/B11 = J0(k d), the far field without what is scattered back). Bodies
/// less than a wave length apart are coupled by the water between them, not by travelling waves.
/// @returns all pairs of bodies that reach the surface.
std::vector<CouplingReach> find_coupling_reaches(const PanelModel& model);

/// @returns the pair whose shortest wave is the longest; none for a single body.
std::optional<CouplingReach> find_coupling_reach(const PanelModel& model);

}  // namespace blocklift::dynamics
