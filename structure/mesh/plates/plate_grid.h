#pragma once

#include <array>
#include <vector>

#include "structure/mesh/plates/sheets.h"

namespace blocklift::structure {

/// Box of grid planes [lower, upper) along x, y, z.
struct GridBox {
  std::array<int, 3> lower{};
  std::array<int, 3> upper{};
};

/// Cut planes through all sheets, and which sheets fill each of the boxes between them.
///
/// Along each axis lie: for each plane of plates ("station") its two faces, and two more for each
/// pad or lug that is thicker; the edges of plates and openings; and as many planes between them
/// as the largest element asks for. Plates of different thickness at one station share the two
/// planes, whose vertices are set to the thickness that is there (`coordinate`).
class PlateGrid {
 public:
  /// @throws ModelError if two stations are nearer to one another than their thickness, or the
  ///   largest element is so small that the grid would not fit into any memory.
  PlateGrid(const BlockDescription& description, std::vector<Sheet> sheets);

  const std::vector<Sheet>& sheets() const { return sheets_; }
  /// Number of boxes along an axis.
  int count(int axis) const {
    return static_cast<int>(planes_[static_cast<std::size_t>(axis)].size()) - 1;
  }
  /// Sheets that fill a box; empty where there is no steel.
  const std::vector<int>& sheets_in(int i, int j, int k) const {
    return signatures_[static_cast<std::size_t>(signature(i, j, k))];
  }
  /// Boxes of steel after leaving out the cuts that nothing needs: conforming with one another.
  std::vector<GridBox> merged_boxes(double largest_element) const;
  /// Place of a grid vertex, m.
  Vector3 vertex(int i, int j, int k) const;

 private:
  struct Plane {
    double coordinate;
    int station;  ///< whose innermost faces it is one of; -1: none
    int side;     ///< -1 lower face, +1 upper face
  };
  struct Station {
    double position;
    std::vector<double> levels;  ///< thicknesses, ascending; the first is that of the plates
    std::vector<int> sheets;     ///< normal to the axis, here
    std::string first_sheet;     ///< for messages
  };

  int signature(int i, int j, int k) const { return cell_signature_[index(i, j, k)]; }
  std::size_t index(int i, int j, int k) const {
    const auto row = static_cast<std::size_t>(k) * static_cast<std::size_t>(count(1)) +
                     static_cast<std::size_t>(j);
    return row * static_cast<std::size_t>(count(0)) + static_cast<std::size_t>(i);
  }
  void find_stations(int axis);
  void collect_planes(int axis, const BlockDescription& description);
  void check_size(double largest_element) const;
  void subdivide(int axis, double largest_element);
  void fill(const BlockDescription& description);
  int plane_at(int axis, double coordinate) const;
  double snapped(int axis, double coordinate, int outward) const;
  GridBox box_of(const Sheet& sheet) const;
  GridBox hole_of(const Opening& opening, int normal) const;
  std::size_t level_of(const Station& station, const Sheet& sheet) const;
  double local_thickness(const Station& station, int i, int j, int k) const;
  void merge_plane(int axis, int plane, double largest_element,
                   std::array<std::vector<char>, 3>& merged) const;

  std::vector<Sheet> sheets_;
  std::array<std::vector<Plane>, 3> planes_;
  std::array<std::vector<Station>, 3> stations_;
  std::vector<std::vector<int>> signatures_;  ///< sets of sheets that occur
  std::vector<int> cell_signature_;           ///< of each box, place in signatures_
};

}  // namespace blocklift::structure
