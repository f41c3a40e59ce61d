#pragma once

#include <string>
#include <vector>

#include "structure/mesh/files/surfaces/cell_collector.h"

namespace blocklift::structure {

/// Names of groups that are given properties from outside the file.
struct GivenGroups {
  std::vector<std::string> plates;  ///< with a thickness
  std::vector<std::string> bars;    ///< with a section

  bool has_plate(const std::string& name) const;
  bool has_bar(const std::string& name) const;
};

/// Regions of an entity by the name of its group, which is made with the first.
int add_region(Mesh& mesh, const std::string& group, const std::string& region);

/// Which entities of Gmsh's current model are plates and bars by their physical groups.
///
/// A surface belongs to its only group, "surface group 3" if that has a number alone, or to that of
/// several which is given a thickness; a surface without a group is one of its own, "surface 7".
/// Curves are bars if a group of theirs is given a section; others are noted as left out.
/// Surfaces that belong to several groups are complained about.
EntityRegions find_groups(const GivenGroups& given, Deck& deck,
                          std::vector<std::string>& complaints);

}  // namespace blocklift::structure
