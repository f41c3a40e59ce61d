#pragma once

#include "dynamics/marine/panels/panel_integrals.h"

namespace blocklift::dynamics::examples {

/// A flat quadrangle in a plane that is turned against all axes.
Panel skew_quadrangle();

/// Both integrals of a panel at a point by Gauss quadrature (5 points each way) on n x n pieces.
PanelPotentials by_quadrature(const Panel& panel, const Vector3& point, int n);

}  // namespace blocklift::dynamics::examples
