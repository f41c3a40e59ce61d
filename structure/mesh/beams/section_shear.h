#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

// Shear stress in sections of beams, for SectionPoint. Sections of thin walls have theirs by
// ThinWalls.

/// Of a pipe or round bar: twelve points round it, so that bending about a slanting axis is at most
/// 3.4 % more than at one of them. Torsion is T r / J; a force's shear, VS / (I b) where it is
/// largest, falls along the edge with the sine from there, and is 4 / (3 A) of a bar and 2 / A of a
/// thin pipe. Those on the axes come first.
/// Source: Timoshenko (1955), sections 26 and 62.
std::vector<SectionPoint> shear_points_of_pipe(double outer_radius, double inner_radius);

/// Of a rectangle of `height` along axis 2 and `width` along axis 3: its corners, then the middles
/// of its sides. Torsion's largest stress, in the middle of the long side, also counts in the
/// corners, where there is none: not far from them it is almost all there. A force has 3 / (2 A) in
/// the middle of the sides along it.
/// Source: Timoshenko and Goodier (1970), section 109; Timoshenko (1955), section 26.
std::vector<SectionPoint> shear_points_of_rectangle(double height, double width,
                                                    double torsion_constant);

/// Of a solid convex polygon: its corners, which have torsion alone, and the middles of its sides.
///
/// Torsion has T c / J everywhere, c = D / (1 + k) (1 + 0.15 k), k = pi^2 D^4 / (16 A^2), D the
/// diameter of the largest circle within it, and a tenth more for an error of J. Against closed
/// forms that is 1 to 10 % more in a square, a triangle of equal sides and a regular hexagon. A
/// force has 3 / (2 A) across, over the cosine of a side's slope against it up to 45 degrees.
/// Source: Roark (1989), table 20, solid sections of any form.
/// @param corners from the centroid, in turn, m.
std::vector<SectionPoint> shear_points_of_polygon(const std::vector<Eigen::Vector2d>& corners,
                                                  double area, double torsion_constant);

/// Points (x_2, x_3) of a beam's section at which its stress along the beam is largest, m:
/// BeamSection::stress_points; of a section that has none the corners of the rectangle with its
/// area's radii of gyration, x_2 = +-sqrt(3 I_3 / A), x_3 = +-sqrt(3 I_2 / A).
std::vector<Eigen::Vector2d> stress_points(const BeamSection& section);

/// Points of a beam's section at which all of its stress is looked at: BeamSection::shear_points,
/// or, where its shape is not known, an estimate of the shear by its stress_points().
///
/// Torsion is T c / J, c the smaller of sqrt(6 J / A) and the section's reach from its centroid.
/// The first is more than there is in solid bars, in closed walls, and in open ones of which half
/// of the area is as thick as the thickest (J > A t^2 / 6). The second, exact of what is round,
/// is that of the farthest stress point, but no less than that of the pipe with this J and A; of a
/// rod without second moments 1.3 times the latter, which covers rectangles, and exactly it if J is
/// that of a round bar (to 2 %).
///
/// A force has 5 / (4 A_s) by its shear area, as a rectangle has. Where none is given or the area
/// itself stands for it, it has the largest of these, S / (I t) in the axis of bending, and at most
/// 10 / A:
/// - 2 / A, as a thin pipe;
/// - c^2 / (2 I), c the reach of the stress points along the force, which a wall of even thickness
///   that ends there has: a tee's web, the flanges of an I under a level force. I is the second
///   moment less I_23^2 over the other one, which covers angles (1.4 to 1.6 times);
/// - that of a web between two flanges as wide as the stress points reach. What the section lacks
///   of the rectangle about the points is then a rectangle itself, and A, I and the centroid give
///   its size: exact of an I, a box and a channel of rectangles. 6 % more count for fillets, and 60
///   % for flanges of two widths, where the centroid is off the middle.
/// Where the points do not tell height and width, J does if it is that of two thin flanges and a
/// web (J = (2 b t_f^3 + h t_w^3) / 3) that have A and both second moments, too; not of a box,
/// whose thin webs may then have 1.8 times as much as 2 / A; nor where J is more than half of the
/// lesser second moment, as that of solid bars is. A web has 0.15 of the area at least.
///
/// At the stress points themselves a force has none, for at the edge nothing flows across it; all
/// of it, with the signs of either force, counts at four fifths of their way from the centroid. So
/// slender bars keep the stress of their bending, as solid ones have it. Where the web of an I
/// ends, at 0.93 of its height with 0.9 of the largest shear, the sum may be 8 % more.
///
/// Between the ends of a taper figures run straight, and an estimate by them is coarse.
std::vector<SectionPoint> checked_points(const BeamSection& section);

/// Is the shear of checked_points() an estimate? Not of a section that has none: without torsion
/// constant and without second moments.
bool is_shear_estimated(const BeamSection& section);

}  // namespace blocklift::structure
