#pragma once

#include "structure/formulation/shell.h"

namespace blocklift::structure {

/// The law of a cell's strains along e_1 and e_2 where it is `thickness` thick (shell_stiffness_law),
/// as its stiffness has it: with the drilling of facets of curved plating, and with the transverse
/// shear of triangles of degree 1. Theirs is taken times
///   t^2 / (t^2 + 0.2 h^2),
/// h^2 being twice the area, since a triangle of three nodes cannot bend without shear along all of
/// its sides at once: with all of their shear, thin plates hardly bend where diagonals run towards a
/// held corner. What this adds to the bending goes with h^2, as the error of the element does. With
/// the longest edge for h and 0.1, the same for a half square, long triangles are up to 14 % too
/// soft; as it is they are up to 14 % too stiff (a plate of 1:5, 8 x 8 x 2 in a quarter of it).
/// Source: Lyly, Stenberg and Vihinen (1993), Comput. Methods Appl. Mech. Eng. 110, 343-357.
Eigen::Matrix<double, shell_strains, shell_strains> law_of_cell(const Space& space, int cell,
                                                                const Vector3& e_1,
                                                                const Vector3& e_2,
                                                                double thickness);

}  // namespace blocklift::structure
