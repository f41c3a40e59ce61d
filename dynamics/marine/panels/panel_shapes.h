#pragma once

#include "dynamics/marine/panels/panel_mesh.h"

namespace blocklift::dynamics {

/// How finely a round body is divided.
struct RoundDivision {
  int meridians = 32;  ///< panels around; a multiple of 4 where planes of symmetry are to be used
  int parallels = 8;   ///< panels from the lowest point to the water line (or to the equator)
  /// The lowest panel is this much longer than the one at the water line.
  double grading = 3.0;
  /// A closed cylinder's panels are as fine at its lower edge as at the water line, on its side and
  /// on its bottom: the velocity is singular there.
  bool graded_edge = false;
  /// Scale the inscribed surface so that it keeps out the volume of the round body.
  bool exact_volume = true;
};

/// Lower half of an ellipsoid with the semi-axes a, b, c (m) along x, y, z, its centre at the
/// world's origin: a hemisphere for a = b = c. The volume is 2/3 pi a b c.
PanelMesh make_half_ellipsoid(const Vector3& semi_axes, const RoundDivision& division = {});

/// The whole ellipsoid about a centre (m) below the surface.
PanelMesh make_ellipsoid(const Vector3& semi_axes, const Vector3& centre,
                         const RoundDivision& division = {});

/// Side of a vertical circular cylinder about the z axis from z = -draught (m) to 0; closed by a
/// flat bottom unless it stands on the sea bed.
PanelMesh make_vertical_cylinder(double radius, double draught, bool closed,
                                 const RoundDivision& division = {});

/// Wetted surface of a floating ring of rectangular section about the z axis, open in the middle:
/// radii and draught in m. Its sides and its bottom are finer towards the edges and the water line.
PanelMesh make_ring(double outer_radius, double inner_radius, double draught,
                    const RoundDivision& division = {});

/// How finely a box is divided; panels are finer towards the edges and the water line.
struct BoxDivision {
  int length = 16;
  int breadth = 8;
  int draught = 4;
  /// The middle panel of a side is this much longer than the one at the edge.
  double grading = 3.0;
};

/// Wetted surface of a barge: length (m) along x, breadth along y, draught, about the world's
/// origin.
PanelMesh make_box_hull(double length, double breadth, double draught,
                        const BoxDivision& division = {});

/// The mesh displaced by p (m).
PanelMesh translate(const PanelMesh& mesh, const Vector3& p_W);

}  // namespace blocklift::dynamics
