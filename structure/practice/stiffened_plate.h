#pragma once

#include <array>

#include "structure/material.h"
#include "structure/practice/column.h"

namespace blocklift::structure {

/// Plate on one side of a stiffener, as wide as half of the panel there.
struct PlateStrip {
  double width = 0;      ///< m
  double thickness = 0;  ///< m
  double height = 0;     ///< of its mid-surface, along the plate's normal, m
};

/// Section of a stiffener, seen along the normal of its plate.
struct StiffenerSection {
  double area = 0;           ///< m^2
  double height = 0;         ///< of its centroid, m
  double second_moment = 0;  ///< int (z - height)^2 dA, m^4
  double lowest = 0, highest = 0;
};

/// Area, centroid and second moment of a stiffener with the plate that works with it.
struct StiffenedSection {
  double area = 0;           ///< m^2
  double height = 0;         ///< of the centroid, m
  double second_moment = 0;  ///< about the centroid, m^4
};

StiffenedSection join_sections(const StiffenerSection& stiffener,
                               const std::array<PlateStrip, 2>& plates);

/// Share of a plate held along both edges that bears even compression at yield:
/// (lambda - 0.22) / lambda^2 from lambda = 0.673 on, lambda = sqrt(f_y / sigma_E), sigma_E that of
/// a long plate: EN 1993-1-5, 4.4(2), equation 4.2.
/// @param width between the edges, m.
double effective_width_share(const Material& material, double thickness, double width);

/// A stiffener and its plates as a column that bends out of the plate; the plate holds it sideways.
/// EN 1993-1-5, 4.5.3: Euler's load of the gross section, effective area with plates reduced by
/// 4.4(2), imperfection alpha + 0.09 e / i with alpha = 0.49 of open sections, i the gross radius
/// of gyration and e the larger distance of stiffener and plates from the common centroid. The
/// section modulus is that of the effective section.
/// @param length between the supports, m.
Column stiffener_column(const Material& material, const StiffenerSection& stiffener,
                        const std::array<PlateStrip, 2>& plates, double length);

}  // namespace blocklift::structure
