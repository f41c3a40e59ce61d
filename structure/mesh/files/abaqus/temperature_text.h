#pragma once

#include <string>
#include <vector>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// Lines of an Abaqus input file that say a deck's temperatures, by nodes: initial ones of 0, and
/// in each step by how much all nodes are warmer. All are empty where no case has temperatures.
///
/// @throws ModelError from all for what these lines cannot say: temperatures of elements, materials
///   that expand from different references or by the direction, and those that CellHeat refuses.
class AbaqusTemperatureText {
 public:
  /// @param deck with the vertices that the file has; it must outlive this object.
  explicit AbaqusTemperatureText(const Deck& deck);

  /// *EXPANSION of a place in Mesh::materials.
  std::string of_material(int material) const;
  /// The same behind the moduli of a *BEAM GENERAL SECTION, which names no material.
  std::string of_general_section(int material) const;
  /// @param set of all nodes.
  std::string initial(const std::string& set) const;
  /// @param labels of the vertices. @param middles of each shell's edges, in the order around it.
  std::string of_step(const DeckLoadCase& load_case, const std::vector<long>& labels,
                      const std::vector<std::vector<int>>& middles) const;
  bool is_empty() const { return !is_any_; }

 private:
  double coefficient_of(int material) const;
  double reference_of(const TemperatureField& field) const;

  const Deck& deck_;
  bool is_any_;
};

}  // namespace blocklift::structure
