#pragma once

#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

/// Groups of elements in a deck that has no sections at all: a mesh, to which thicknesses and
/// profiles are given from outside.
///
/// An element's group is the set of it that is given a thickness or a profile (DeckOptions). Plates
/// in none of these are of one group, "shells".
class BareGroups {
 public:
  explicit BareGroups(AbaqusModel& model);

  /// Region of a plate, by its place among the elements. One in several sets that are given a
  /// thickness is complained of.
  int region_of_plate(int element);
  /// Makes a bar, of two halves where its middle is on the edge of no plate, if a profile is given
  /// to a set of it. Other trusses are left out: preprocessors that write meshes alone have them
  /// along all edges of plates.
  /// @return false for a beam, which is there for a profile, without any.
  bool take_bar(int element);
  /// Complains of a bar that needs a section, for the deck has some.
  void miss_section_of_bar(int element);

 private:
  using Names = std::vector<std::string>;
  /// Names that are given, of each element in sets of theirs.
  std::map<int, Names> sets_among(const Names& given) const;
  int region(const std::string& name, Names& groups);
  bool is_middle_of_shell(int vertex);

  AbaqusModel& model_;
  std::map<int, Names> plates_, bars_;
  std::map<std::string, int> region_of_;
  std::unordered_set<int> middles_;  ///< of shells' edges, once a bar has asked
};

}  // namespace blocklift::structure
