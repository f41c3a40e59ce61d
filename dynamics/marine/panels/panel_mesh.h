#pragma once

#include <array>
#include <span>
#include <vector>

#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// A flat piece of a surface that bounds the water: a triangle or a quadrangle.
struct Panel {
  std::array<Vector3, 4> vertices;  ///< counter-clockwise seen from the water, in W, m
  int vertex_count = 0;             ///< 3 or 4; the fourth vertex of a triangle repeats the third
  Vector3 normal = Vector3::Constant(not_a_number);    ///< unit, into the water, in W
  Vector3 centroid = Vector3::Constant(not_a_number);  ///< in W, m
  double area = not_a_number;                          ///< m2

  /// Longest edge or diagonal, m.
  double diameter() const;
};

/// Panel through three or four points (m), counter-clockwise seen from the water. A quadrangle that
/// is not flat is replaced by its projection on the plane through the midpoints of its edges, as
/// Hess and Smith (1964) do.
/// @throws ModelError if the number of points is neither 3 nor 4, a coordinate is not finite, or
/// the points enclose no area.
Panel make_panel(std::span<const Vector3> points);

/// Vertical planes of symmetry of everything in the water: x = 0 and y = 0 of the world.
struct Symmetry {
  bool x = false;  ///< the other half is the image in the plane x = 0
  bool y = false;  ///< the other half is the image in the plane y = 0

  /// The surface itself and its images: 1, 2 or 4.
  int image_count() const { return (x ? 2 : 1) * (y ? 2 : 1); }
  /// Image of a point or a direction, 0 <= image < image_count(); image 0 is the identity.
  Vector3 reflect(int image, const Vector3& p_W) const;

  bool operator==(const Symmetry&) const = default;
};

/// A surface of panels. With symmetry only the part x >= 0 and/or y >= 0 is held; the rest is
/// understood.
struct PanelMesh {
  std::vector<Panel> panels;
  Symmetry symmetry;

  int size() const { return static_cast<int>(panels.size()); }
  /// Area of the panels and their images, m2.
  double total_area() const;
  /// Volume (m3) of the water that a hull keeps out, between its panels with their images and the
  /// plane z = 0: sum of z n_z A.
  double displaced_volume() const;
};

/// Mesh of a list of panels.
PanelMesh make_panel_mesh(std::vector<Panel> panels, const Symmetry& symmetry = {});

/// The part of a whole mesh in x >= 0 and/or y >= 0.
/// @throws ModelError if a panel crosses a plane of symmetry, or the parts on its two sides differ
/// in area or volume: the surface is not symmetric; the panel's or the parts' figures are named.
PanelMesh restrict_to_symmetry(const PanelMesh& whole, const Symmetry& symmetry);

/// The whole mesh, images as panels of their own.
PanelMesh expand_symmetry(const PanelMesh& part);

/// Closed polygon in the plane z = 0, m: counter-clockwise seen from above where the water is
/// outside, clockwise around an opening of the body.
using WaterLine = std::vector<Vector3>;

/// The lines along which a hull's panels end at z = 0. Symmetric parts are expanded first.
/// @throws ModelError if the edges at z = 0 do not close: where the gap is.
std::vector<WaterLine> find_water_lines(const PanelMesh& hull);

/// Area enclosed by a water line, m2; negative for an opening: those of a body add up to its water
/// plane.
double enclosed_area(const WaterLine& water_line);

}  // namespace blocklift::dynamics
