#pragma once

#include <span>

#include "dynamics/marine/panels/panel_mesh.h"

namespace blocklift::dynamics {

/// How the calm water around floating bodies is divided into panels.
struct SurfaceMeshSettings {
  double first_ring = not_a_number;  ///< width of the panels at the water line, m
  double growth = 1.1;               ///< each ring is this much wider than the one inside it
  double radius = not_a_number;      ///< of the outer edge, about the middle of the bodies, m
  /// Rings at a body begin with this share of the mean edge of its water line, if that is less than
  /// first_ring, and widen by edge_growth until they have reached it; 0: they begin with it.
  double edge_share = 0.0;
  double edge_growth = 1.4;
};

/// Settings for waves between two lengths (m): waves are resolved by a first ring of a fifteenth of
/// the shortest (but at least 0.06 of the smallest water line's radius), and by an edge 1.4 of the
/// longest away, which the damping zone needs to take it in. At a hull whose side moves to and fro
/// the vertical velocity of the surface is infinite as a logarithm: there the rings begin with a
/// quarter of the water line's edges, so that they follow the hull's own panels.
SurfaceMeshSettings surface_settings(std::span<const WaterLine> water_lines, double shortest_wave,
                                     double longest_wave);

/// The calm surface between the water lines and a circle.
struct SurfaceMesh {
  PanelMesh mesh;                      ///< normals down, into the water
  Vector3 centre = Vector3::Zero();    ///< of the outer edge, m
  double inner_radius = not_a_number;  ///< about the centre, encloses the bodies, m
  double outer_radius = not_a_number;  ///< m
};

/// Quadrangles in rings around each water line, with their vertices on its vertices, growing
/// outwards. Each body has its region: the plane is divided half way between neighbouring bodies,
/// or, of three and more around which circles do not meet, by the radical axes of these circles.
/// Beyond the circle that holds all bodies the rings are common. A body's rays run square off its
/// water line first, then straight, fanned out evenly, to the edge of its region. Panels of one
/// region need not meet those of the next at their corners: the potential is constant on a panel.
/// Water that a body embraces, a moonpool or the gap to one body that floats in it, has rings of
/// its own (mesh_enclosed_surface).
/// Without water lines there is no surface: an empty mesh.
/// @throws ModelError if water lines intersect, one is not star-shaped enough for the rays, the
/// regions of three or more bodies do not fill the plane, or a setting is out of range.
SurfaceMesh make_surface_mesh(std::span<const WaterLine> water_lines,
                              const SurfaceMeshSettings& settings);

}  // namespace blocklift::dynamics
