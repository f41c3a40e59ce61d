#pragma once

#include <vector>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Mass beyond the plates' own on shells, kg/m^2, or beams, kg/m: cells that get it get sections of
/// their own, one for each that they had.
void add_mass_per_area(Mesh& mesh, const std::vector<int>& shells, double mass);
void add_mass_per_length(Mesh& mesh, const std::vector<int>& beams, double mass);
/// The same of solids, kg/m^3: they get materials of their own, of the density that they then have.
void add_mass_to_solids(Mesh& mesh, const std::vector<int>& solids, double mass);

double total_area(const Mesh& mesh, const std::vector<int>& shells);   ///< m^2
double total_length(const Mesh& mesh, const std::vector<int>& beams);  ///< m
/// m^3; of solids that have the middles of their edges.
double total_volume(const Mesh& mesh, const std::vector<int>& solids);

}  // namespace blocklift::structure
