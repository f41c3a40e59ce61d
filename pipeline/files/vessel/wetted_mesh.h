#pragma once

#include <string>
#include <vector>

#include "dynamics/marine/hull/hull.h"

namespace blocklift::pipeline {

/// A hull that ends at z = 0 goes on upright above it, by as much as it is deep, and is closed
/// there; panels in z = 0 (lids) are left out. A hull that reaches higher stays as it is.
/// @throws dynamics::ModelError, with the edge and what to do, if the mesh is open below z = 0:
///   what is closed there without a word would be another hull; or if panels come twice, or are
///   turned round against their neighbours.
dynamics::Hull with_freeboard(const dynamics::Hull& wetted);

/// What to do about a mesh that is open or twisted, where its figures tell: that it is the half of
/// a hull beside x = 0 or y = 0, and which panels are turned round against all their neighbours.
std::vector<std::string> hints_on_mesh(const dynamics::Hull& hull);

/// A sentence for a hull longer than 2 km, which no ship is: its file mostly has millimetres; else
/// empty.
/// @param who "vessel barge".
std::string doubt_about_size(const std::string& who, const dynamics::Hull& hull);

/// A sentence for a vessel that displaces less than a two-hundredth of what its hull encloses,
/// which no vessel is as light as: its mass may be in kg where t is meant; else empty.
/// @param mass kg. @param water_density kg/m3.
std::string doubt_about_lightness(const std::string& who, const dynamics::Hull& hull, double mass,
                                  double water_density);

}  // namespace blocklift::pipeline
