#pragma once

#include <map>
#include <string>

#include "structure/mesh/mesh.h"

namespace blocklift::structure::testing {

/// Steel of a mesh's flat shells and beams, integrated by hand.
struct SteelMeasures {
  double area = 0;                   ///< of the shells, m^2
  double mass = 0;                   ///< kg
  Vector3 centre = Vector3::Zero();  ///< of mass, m
  std::map<std::string, double> area_of_group, area_of_region;
};
SteelMeasures measure(const Mesh& mesh);

/// Length of all edges at which shells of several regions, or more than two shells, meet, m.
double joint_length(const Mesh& mesh);

/// Expects a conforming mesh: rectangles that all point along their axis; along each line of a region
/// edges meet end to end, so that what is not shared by two of its shells is the region's outline; no
/// vertex lies within an edge, and no two lie at one place.
void expect_conforming(const Mesh& mesh);

}  // namespace blocklift::structure::testing
