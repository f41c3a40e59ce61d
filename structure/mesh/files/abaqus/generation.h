#pragma once

#include <string>
#include <utility>
#include <vector>

#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

/// Nodes that a keyword makes from others.
struct MadeNodes {
  std::string set;                               ///< that they are to be in; empty: none
  std::vector<std::pair<long, Vector3>> places;  ///< by their numbers, m
  std::vector<int> others;                       ///< vertices that belong to the set besides
};

/// Of *NGEN (straight lines and arcs), *NFILL (evenly spaced) and *NCOPY (SHIFT). Source: Abaqus
/// Keywords Reference Guide.
/// @param labels of all vertices.
/// @throws CardError for what they may say and is not known, and nodes that do not exist.
MadeNodes make_nodes(const AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& block,
                     const std::vector<long>& labels);

/// An element like another, whose nodes' numbers are raised.
struct MadeElement {
  int like = 0;  ///< place in AbaqusModel::elements
  long label = 0, shift_of_nodes = 0;
};

struct MadeElements {
  std::string set;  ///< that they are to be in; empty: none
  std::vector<MadeElement> elements;
  std::vector<int> others;  ///< elements that belong to the set besides
};

/// Of *ELGEN and *ELCOPY.
/// @throws CardError as make_nodes().
MadeElements make_elements(const AbaqusModel& model, const AbaqusScope& scope,
                           const AbaqusBlock& block);

}  // namespace blocklift::structure
