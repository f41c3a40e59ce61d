#pragma once

#include <vector>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Of axis 1 of a laminate from a shell's first side, about its normal, degrees.
double laminate_angle(const Mesh& mesh, const Shell& shell);

/// Thickness at a shell's corners in their order around it, m; empty where it is even.
std::vector<double> corner_thicknesses(const Mesh& mesh, const Shell& shell);

}  // namespace blocklift::structure
