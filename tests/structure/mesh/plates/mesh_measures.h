#pragma once

#include <map>
#include <string>

#include "structure/mesh/mesh.h"

namespace blocklift::structure::test {

/// Steel of a mesh's shells and beams, integrated by hand.
struct SteelMeasures {
  double area = 0;                   ///< of the shells, m^2
  double mass = 0;                   ///< kg
  Vector3 centre = Vector3::Zero();  ///< of mass, m
  std::map<std::string, double> area_of_group, area_of_region;
};
SteelMeasures measure(const Mesh& mesh);

/// Length of all edges at which shells of several regions, or more than two shells, meet, m.
double joint_length(const Mesh& mesh);

/// Volume by which mid-planes exceed plates that are laid half on each side and led to the far face
/// of what they end on, where sheets normal to the axes meet, m^3. Of the square t_a x t_b of a
/// joint each plate that goes on both ways covers all and one that ends there half: a crossing
/// counts it twice, a T 1.5 times, a corner once.
double joint_overlap(const Mesh& mesh);

/// Expects a conforming mesh: shells of a region that all point along its axis; an edge is shared
/// by two of them at most, so that what is not shared is the region's outline; no vertex lies
/// within an edge, and no two lie at one place; beams lie on shells' edges.
void expect_conforming(const Mesh& mesh);

}  // namespace blocklift::structure::test
