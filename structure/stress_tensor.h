#pragma once

#include <Eigen/Core>

#include "structure/material.h"

namespace blocklift::structure {

using Vector3 = Eigen::Vector3d;

/// Stress as (xx, yy, zz, xy, yz, zx), Pa.
using Stress = Eigen::Matrix<double, 6, 1>;

/// Von Mises stress, Pa: sqrt(((sx-sy)^2 + (sy-sz)^2 + (sz-sx)^2) / 2 + 3 (sxy^2 + syz^2 + szx^2)).
double von_mises(const Stress& stress);

/// Hooke's law in a plane without stress across it, of (e_11, e_22, 2 e_12), Pa.
Eigen::Matrix3d plane_stress_law(const Material& material);

}  // namespace blocklift::structure
