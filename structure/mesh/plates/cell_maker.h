#pragma once

#include <array>
#include <map>
#include <tuple>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/mesh/plates/sheet_grid.h"

namespace blocklift::structure {

/// Division of what lies between two planes of a grid into equal parts, the same wherever it
/// occurs, so that neighbours conform.
class Divisions {
 public:
  /// @throws ModelError if the largest element is not positive.
  Divisions(const SheetGrid& grid, double largest_element);

  /// As many as the largest element asks for; a double, since there may be more than an int holds.
  double parts(int axis, int lower, int upper) const;
  void require(int axis, int lower, int upper, int parts);
  /// Number of the coordinate after some of the parts.
  int number(int axis, int lower, int upper, int part);
  double coordinate(int axis, int number) const { return coordinates_[axis][number]; }

 private:
  double largest_element_;
  std::array<std::vector<double>, 3> coordinates_;
  std::map<std::tuple<int, int, int>, int> required_;
  std::map<std::tuple<int, int, int, int>, int> numbers_;
};

/// Makes the shells of panels and of frames of openings and the beams of stiffeners on common
/// vertices, with labels that count from 1.
class CellMaker {
 public:
  /// @throws ModelError if the largest element is not positive, or makes more shells than any
  /// memory holds.
  CellMaker(const SheetGrid& grid, const std::vector<SheetPanel>& panels, double largest_element,
            Mesh& mesh);

  void add(const SheetPanel& panel, int section);
  /// Rings of quadrangles between the frame's outline and the opening, curved where that is.
  void add(const HoleFrame& frame, int section);
  /// @param pattern a beam with all but vertices and label.
  void add(const StiffenerSpan& span, const Beam& pattern);

 private:
  using Place = std::array<int, 3>;
  struct Ring;

  void divide_frame(const HoleFrame& frame);
  void check_size(const std::vector<SheetPanel>& panels, double largest_element) const;
  int parts(const Place& lower, const Place& upper, int axis) const;
  int vertex(const Place& place);
  int vertex_at(const Vector3& place);
  std::vector<int> vertices_around(const HoleFrame& frame);
  Ring ring_of(const HoleFrame& frame);
  void add_shell(Shell shell);

  const SheetGrid& grid_;
  double largest_element_;
  Divisions divisions_;
  Mesh& mesh_;
  std::map<Place, int> vertices_;  ///< by the numbers of their coordinates
};

}  // namespace blocklift::structure
