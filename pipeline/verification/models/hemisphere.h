#pragma once

#include <array>
#include <vector>

#include "dynamics/marine/radiation/floating_motion.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics::examples {

/// Division of a hemisphere and of the surface around it, in radii.
struct HemisphereDivision {
  int meridians, parallels;
  double first_ring;
  double growth = 1.1;
  double outer_radius = 45.0;
};

/// A floating hemisphere as a problem, with its planes of symmetry.
struct Hemisphere {
  std::vector<WettedBody> bodies;
  PanelModel model;
  int unknowns;  ///< of the whole surface, without symmetry
};

/// `low` is the height of the reference point, m.
Hemisphere make_hemisphere(double radius, const HemisphereDivision& division, const Water& water,
                           double low = 0.0);

/// Added mass over the displaced mass and damping over that and the frequency.
struct HemisphereRow {
  double ka, heave_A, heave_B, surge_A, surge_B;
};
/// Heave: Hulme (1982), J. Fluid Mech. 121. Surge: multipole expansion about the centre, converged
/// to the digits given.
inline constexpr std::array<HemisphereRow, 6> hulme = {{{0.2, .7938, .2793, .5515, .0082},
                                                        {0.5, .5861, .3391, .6439, .0987},
                                                        {1.0, .4284, .2484, .5740, .3535},
                                                        {2.0, .3884, .1031, .2493, .3424},
                                                        {3.0, .4111, .0452, .1720, .2237},
                                                        {5.0, .4471, .0116, .1679, .1073}}};

/// The database of a hemisphere of unit radius, density and gravity at the frequencies of the
/// table, headings 0 and 60 degrees.
HydrodynamicDatabase compute_unit_database(const PanelModel& model);

/// IEA OES Task 10 (Wendt et al. 2019): sphere of 5 m radius, half immersed, 261.8 t, released 1 m
/// up.
LinearFloatation task_10();

}  // namespace blocklift::dynamics::examples
