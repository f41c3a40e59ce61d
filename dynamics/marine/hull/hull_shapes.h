#pragma once

#include "dynamics/marine/hull/hull.h"

namespace blocklift::dynamics {

/// Numbers of panels along a hull, and edge lengths to choose them by.
struct PanelDivision {
  int along = 20;   ///< panels over the length
  int across = 8;   ///< panels over the breadth of bottom, deck and ends
  int upright = 4;  ///< panels over the height of the sides, the bilge not counted
  int bilge = 3;    ///< panels round each bilge, where there is one

  /// Panels with edges of about `size` (m) on a hull of these dimensions.
  /// @throws ModelError if the size is not positive.
  static PanelDivision of_size(double size, double length, double breadth, double depth);
};

/// Pontoon with a flat bottom, flat sides and flat ends. Frame: origin on the base line amidships
/// in the centre plane, x forward, y to port, z up.
struct BargeShape {
  double length = not_a_number;   ///< over all, x from -length/2 to length/2, m
  double breadth = not_a_number;  ///< m
  double depth = not_a_number;    ///< base line to deck, m
  double bilge_radius = 0.0;      ///< of the round between bottom and sides, m
  double bow_rake_length = 0.0;   ///< over which the bottom rises at the bow, m
  double bow_rake_height = 0.0;   ///< by how much it rises, m; the rest of the bow is upright
  double stern_rake_length = 0.0;
  double stern_rake_height = 0.0;
  double corner_length = 0.0;   ///< chamfer of the four upright corners: extent along x, m
  double corner_breadth = 0.0;  ///< and along y, m
};

/// Closed hull of a barge, deck included.
/// @throws ModelError if a dimension is not positive or the rakes, bilges or corners do not fit;
///   the message says which and what the limit is.
Hull make_barge(const BargeShape& shape, const PanelDivision& division, std::string name = "barge");

/// Ship-shaped hull: a parallel middle body with flat sides between two ends that taper to a stem
/// and to a stem or transom, by closed formulas. With xi from 0 (end of the middle body) to 1 (end
/// of the ship) and zeta from 0 (base line) to 1 (draught):
///
///   half-breadth  y = B/2 w(xi) s(zeta),   w = 1 - (1 - t) xi^n,
///   section       s = (1 - (1 - zeta)^m)^(1/m) below the draught, 1 above it (flat of side),
///   fullness      m = m_midship + (m_end - m_midship) xi   (2: an ellipse, 10: nearly a
///     rectangle).
///
/// t is the breadth of the transom over B (0 at the bow). The frame is that of the barge.
struct ShipShape {
  double length = not_a_number;           ///< m
  double breadth = not_a_number;          ///< moulded, m
  double depth = not_a_number;            ///< base line to deck, m
  double draught = not_a_number;          ///< height at which the sections become upright, m
  double bow_length = not_a_number;       ///< of the tapering fore body, m
  double stern_length = not_a_number;     ///< of the tapering aft body, m
  double bow_exponent = 2.0;              ///< n forward: 1 a wedge, large: full
  double stern_exponent = 2.0;            ///< n aft
  double transom_breadth = 0.0;           ///< at the after end, m
  double midship_section_exponent = 8.0;  ///< m_midship
  double bow_section_exponent = 2.0;      ///< m_end forward
  double stern_section_exponent = 2.0;    ///< m_end aft
};

/// Closed hull of a ship, deck included; `division.bilge` panels lie in the lower third of the
/// draught on each side, where the sections turn.
/// @throws ModelError if a dimension or exponent cannot be; the message says which.
Hull make_ship(const ShipShape& shape, const PanelDivision& division, std::string name = "ship");

/// Wigley's parabolic hull, y = B/2 (1 - (2x/L)^2)(1 - (z/T)^2) with z from the water line, upright
/// above it up to the freeboard; origin in the water line amidships.
/// Source: W. C. S. Wigley (1934); volume below the water line 4/9 L B T.
/// @throws ModelError if a dimension is not positive.
Hull make_wigley(double length, double breadth, double draught, double freeboard,
                 const PanelDivision& division, std::string name = "Wigley hull");

/// Box with its origin in its middle.
Hull make_box(const Vector3& size, const PanelDivision& division, std::string name = "box");

}  // namespace blocklift::dynamics
