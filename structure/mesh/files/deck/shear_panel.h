#pragma once

#include <array>

#include "structure/material.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// A thin panel framed by bars that bears nothing but shear flow along its edges.
///
/// Its edges carry forces Q_i, i from corner i to corner i + 1, in the one ratio that is in
/// balance; each is shared evenly by its edge's corners. The mean flow q over the edges follows
/// from what it does work on,
///   q = stiffness * sum_i corner_forces_i . u_i.
/// Source: Garvey (1951), The quadrilateral shear panel, Aircraft Engineering 23, 134-135, for
/// parallelograms and trapezoids; its stress field is taken along the lines xi, eta of others.
struct ShearPanel {
  std::array<Vector3, 4> corner_forces;  ///< on the corners at a mean flow of 1 N/m, m
  double stiffness = 0;                  ///< N/m^2
  double area = 0;                       ///< m^2
  Vector3 normal = Vector3::Zero();      ///< of its mean plane
  Vector3 centre = Vector3::Zero();      ///< mean of the corners, m
};

/// @param corners in their turn, m. Those off the mean plane are taken as in it; the forces'
///   moments that this leaves are for the user of them to balance.
/// @throws ModelError if the corners are no convex quadrilateral, or lie off their plane by more
///   than 5 % of the mean edge.
ShearPanel make_shear_panel(const std::array<Vector3, 4>& corners, const Material& material,
                            double thickness);

}  // namespace blocklift::structure
