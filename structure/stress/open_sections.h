#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/formulation/cell_heat.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// Are a section's walls open, by its figures? Saint-Venant's torsion constant of solid bars and
/// closed walls is 1.5 to 4 times the lesser second moment, of rolled beams, channels, angles and
/// tees 0.17 times at most (measured on tables; see section_shear.cc).
bool is_open_section(const BeamSection& section);

/// Bars of open section in whose largest stress torsion has the larger share.
struct TwistedBars {
  std::string group;
  double von_mises = 0;  ///< the group's largest, Pa
  double torsion = 0;    ///< sqrt(3) times the shear stress of Saint-Venant's torsion there, Pa
  Vector3 place = Vector3::Zero();  ///< where, on the line of centroids, m
};

/// Looks for groups of bars whose largest von Mises stress is that of torsion for half or more and
/// whose section is open: these resist warping, too, which is not computed, so that their twist is
/// too large where an end is clamped, and the stress along them by warping is missing.
/// @param motion of the space's freedoms, m and rad. @param heat of that one case; null: none.
std::vector<TwistedBars> find_twisted_open_bars(const Space& space, const Eigen::VectorXd& motion,
                                                const CellHeat* heat = nullptr);

}  // namespace blocklift::structure
