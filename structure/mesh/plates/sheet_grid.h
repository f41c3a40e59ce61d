#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "structure/mesh/plates/sheets.h"

namespace blocklift::structure {

/// Rectangle between cuts that belongs to one sheet.
struct SheetPanel {
  int normal = 0;
  /// Places of its corners among the planes of each axis; alike along the normal.
  std::array<int, 3> lower{}, upper{};
  std::vector<int> sheets;  ///< that lie here
  int owner = 0;            ///< the one of them that it belongs to
  int frame = -1;           ///< place in SheetGrid::frames() if it is part of one
};

/// Piece of a stiffener between cuts.
struct StiffenerSpan {
  int row = 0;    ///< place in BlockDescription::stiffeners
  int sheet = 0;  ///< that carries it
  int along = 0;
  /// Places of its ends among the planes of each axis; alike across it.
  std::array<int, 3> lower{}, upper{};
  int side = 1;          ///< of the sheet, along its normal
  double thickness = 0;  ///< of what it stands on, m
};

/// Rectangle of one sheet about an opening that is no rectangle.
struct HoleFrame {
  int sheet = 0;
  std::array<Interval, 3> extent;  ///< m
  Cutout cutout;
};

/// Mid-planes of all sheets, cut into rectangles that meet along whole edges.
///
/// Along each axis lie planes through the mid-planes and the edges of sheets and openings, and
/// through stiffeners. An edge that ends within the thickness of another sheet is led to that
/// sheet's mid-plane. Of each plane's cuts stay those that something needs: a piece of steel that
/// is connected along the plane is cut throughout or not at all. About each opening that is no
/// rectangle a rectangle of the sheet is set apart, between planes that are there if some lie well.
class SheetGrid {
 public:
  /// @throws ModelError if two parallel planes of sheets are nearer to one another than their
  ///   thickness, a sheet lies within another's thickness, an opening that is no rectangle meets
  ///   anything else, or the grid would not fit into any memory.
  explicit SheetGrid(std::vector<Sheet> sheets);

  const std::vector<Sheet>& sheets() const { return sheets_; }
  /// Places of the planes along an axis, ascending, m.
  const std::vector<double>& planes(int axis) const { return planes_[axis]; }
  /// Conforming: two of them share a whole edge, a corner or nothing.
  std::vector<SheetPanel> panels() const;
  const std::vector<HoleFrame>& frames() const { return frames_; }
  /// Corners of panels on the outline of a frame, from the lower end of both axes anticlockwise
  /// about the sheet's normal.
  std::vector<std::array<int, 3>> points_around(const HoleFrame& frame) const;
  /// Each lies on an edge of panels and between two of its corners.
  std::vector<StiffenerSpan> stiffener_spans() const;

 private:
  static constexpr double same_place = 0.5e-3;  // m: cuts nearer than this are one

  using Place = std::array<int, 3>;
  using Area = std::array<Interval, 2>;

  int count(int axis) const { return static_cast<int>(planes(axis).size()); }
  std::size_t index(const Place& place) const {
    const auto row =
        static_cast<std::size_t>(place[2]) * planes_[1].size() + static_cast<std::size_t>(place[1]);
    return row * planes_[0].size() + static_cast<std::size_t>(place[0]);
  }
  /// Signature of the rectangle normal to an axis from a point of the grid upwards; 0: no steel.
  int face(int normal, const Place& place) const { return faces_[normal][index(place)]; }
  void check_stations(int axis) const;
  bool reaches(const Sheet& sheet, const Sheet& end, int axis) const;
  double snapped(int axis, double coordinate, const Sheet* end) const;
  void collect_planes(int axis);
  std::vector<Area> obstacles_of(const Sheet& sheet, const Cutout& cutout) const;
  std::array<Interval, 2> room_about(const Sheet& sheet, const Cutout& cutout, double most) const;
  Interval frame_side(int axis, const Interval& hole, const Interval& room, double size) const;
  void add_plane(int axis, double coordinate);
  void collect_frames();
  void set_frames_apart();
  int plane_at(int axis, double coordinate) const;
  SheetPanel box_of(const Sheet& sheet) const;
  SheetPanel box_of_hole(const Sheet& sheet, const std::array<Interval, 3>& hole) const;
  void fill();
  bool is_cut_at(int axis, const Place& point) const;
  bool has_sheet(int normal, const Place& place, int sheet) const;
  bool bears(int sheet, const StiffenerLine& line, const Place& place) const;
  double thickness_under(int sheet, const StiffenerLine& line, const Place& place) const;
  Place start_of(const SheetPanel& box, const StiffenerLine& line) const;
  void mark_stiffeners();
  void find_cuts(int axis, int plane);

  std::vector<Sheet> sheets_;
  std::vector<HoleFrame> frames_;
  std::array<std::vector<double>, 3> planes_;
  std::vector<std::vector<int>> signatures_;  ///< sets of sheets that occur
  std::vector<int> owners_;                ///< of each of them; -1: none, beyond the sheets: frames
  std::array<std::vector<int>, 3> faces_;  ///< by normal and point
  std::array<std::vector<char>, 3> is_kept_;   ///< by axis and point: lines along the axis end here
  std::array<std::vector<char>, 3> is_asked_;  ///< by axis and point: a stiffener asks for that
};

}  // namespace blocklift::structure
