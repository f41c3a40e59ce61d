#include "structure/mesh/plates/free_sheets.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/fields/plane_frame.h"
#include "structure/mesh/plates/line_pieces.h"

namespace blocklift::structure {

namespace {

using Point2 = Eigen::Vector2d;

constexpr double out_of_plane = 1e-3, same_line = 1e-6;  // m
constexpr double most_lines = 1e4;                       // of a row

template <class T>
int place_of_name(const std::vector<T>& items, const std::string& name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const T& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

void check_plane(const FreePlate& plate) {
  if (plate.corners.empty()) return;
  if (plate.corners.size() < 3 || !normal_of_polygon(plate.corners).allFinite())
    throw ModelError(fmt::format("plate \"{}\" has no area", plate.name));
  const PlaneFrame frame = frame_of_polygon(plate.corners);
  for (const Vector3& corner : plate.corners) {
    const double distance = std::abs(frame.coordinates(corner).z());
    if (distance > out_of_plane)
      throw ModelError(
          fmt::format("the corners of plate \"{}\" are not in one plane: one lies {:.3g} "
                      "mm off; a twisted plate is given by two edges",
                      plate.name, 1000 * distance));
  }
}

/// The plane free plate that something lies on.
const FreePlate& plane_plate(const BlockDescription& block, const std::string& what,
                             const std::string& name) {
  const int place = place_of_name(block.free_plates, name);
  if (place < 0)
    throw ModelError(
        fmt::format("{} lies on plate \"{}\", which is none given by its corners", what, name));
  const FreePlate& plate = block.free_plates[place];
  if (plate.corners.empty())
    throw ModelError(fmt::format(
        "{} lies on plate \"{}\", which is ruled between two edges and has no plane", what, name));
  return plate;
}

/// Corners of a rectangle normal to an axis of a plate's frame.
std::vector<Vector3> corners_of(const std::string& what, const PlaneFrame& frame, int normal,
                                double position, const std::array<Interval, 3>& extent) {
  const int first = (normal + 1) % 3, second = (normal + 2) % 3;
  const Interval &a = extent[first], &b = extent[second];
  if (!(a.upper - a.lower > out_of_plane && b.upper - b.lower > out_of_plane))
    throw ModelError(what + " has an extent that ends less than 1 mm beyond its start");
  std::vector<Vector3> corners;
  for (const auto& [i, j] : {std::pair(a.lower, b.lower), std::pair(a.upper, b.lower),
                             std::pair(a.upper, b.upper), std::pair(a.lower, b.upper)}) {
    Vector3 place = Vector3::Zero();
    place[normal] = position;
    place[first] = i;
    place[second] = j;
    corners.push_back(frame.point(place));
  }
  return corners;
}

void require_thickness(const std::string& what, double thickness) {
  if (!(std::isfinite(thickness) && thickness > 0))
    throw ModelError(
        fmt::format("{} has a thickness of {:g} m; it must be positive", what, thickness));
}

/// What a line v = place has within a polygon.
LinePieces within_polygon(const std::vector<Point2>& corners, double place) {
  std::vector<double> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((a.y() > place) == (b.y() > place)) continue;
    crossings.push_back(a.x() + (b.x() - a.x()) * (place - a.y()) / (b.y() - a.y()));
  }
  std::sort(crossings.begin(), crossings.end());
  LinePieces line;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    line.push_back({crossings[i], crossings[i + 1]});
  return line;
}

/// Leaves out the sides that lie on the line.
void leave_out_sides(const std::vector<Point2>& corners, double place, LinePieces& line) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if (std::abs(a.y() - place) < same_line && std::abs(b.y() - place) < same_line)
      leave_out(std::min(a.x(), b.x()), std::max(a.x(), b.x()), line);
  }
}

void leave_out_circle(const Point2& centre, double radius, double place, LinePieces& line) {
  const double half = radius * radius - std::pow(place - centre.y(), 2);
  if (half > 0) leave_out(centre.x() - std::sqrt(half), centre.x() + std::sqrt(half), line);
}

/// One row on its plate, seen in axes along and across the stiffeners.
class Row {
 public:
  Row(const BlockDescription& block, const FreePlate& plate, const Stiffeners& row)
      : block_(block), plate_(plate), row_(row), frame_(frame_of_polygon(plate.corners)) {
    for (const Vector3& corner : plate.corners) corners_.push_back(seen(corner));
  }

  void add_lines(int number, std::vector<BeamLine>& lines) const {
    for (const double across : places()) add_line(number, across, lines);
  }

  void add_sheets(int number, const std::string& material, std::vector<FreeSheet>& sheets) const {
    for (const double across : places()) {
      LinePieces line = line_at(across);
      std::erase_if(line, [](const Interval& p) { return p.upper - p.lower < out_of_plane; });
      for (const Interval& piece : line) {
        std::string name = fmt::format("{} at {} = {:g} m", row_.name, "uv"[1 - along()], across);
        if (line.size() > 1)
          name += fmt::format(", {} = {:g} m to {:g} m", "uv"[along()], piece.lower, piece.upper);
        add_sheets({name, SheetRank::stiffener, 0, material, {}, -1, number}, across, piece,
                   sheets);
      }
    }
  }

 private:
  int along() const { return static_cast<int>(row_.along); }

  /// Where its stiffeners stand across.
  std::vector<double> places() const {
    const auto [lowest, highest] =
        std::minmax_element(corners_.begin(), corners_.end(),
                            [](const Point2& a, const Point2& b) { return a.y() < b.y(); });
    const double first = row_.first.value_or(lowest->y());
    // None on the plate's own edges.
    const double start = std::floor((lowest->y() - first) / row_.spacing + 1e-6) + 1;
    const double end = std::ceil((highest->y() - first) / row_.spacing - 1e-6) - 1;
    if (end - start > most_lines)
      throw ModelError(
          fmt::format("{}: a spacing of {:g} m makes {:.2g} stiffeners, and {:.2g} are "
                      "allowed",
                      row_.name, row_.spacing, end - start + 1, most_lines));
    std::vector<double> found;
    for (double i = start; i <= end; ++i) found.push_back(first + i * row_.spacing);
    return found;
  }

  Point2 seen(const Vector3& point) const {
    const Vector3 own = frame_.coordinates(point);
    return {own[along()], own[1 - along()]};
  }
  Vector3 point(double along_it, double across, double above = 0) const {
    Vector3 own(0, 0, row_.side * above);
    own[along()] = along_it;
    own[1 - along()] = across;
    return frame_.point(own);
  }

  /// What a line has of the plate.
  LinePieces line_at(double across) const {
    LinePieces line = within_polygon(corners_, across);
    leave_out_sides(corners_, across, line);
    for (const FreeOpening& opening : block_.free_openings)
      if (opening.plate == plate_.name) cut(opening, across, line);
    return line;
  }

  /// @param pattern a sheet with all but thickness, corners and the end of its name.
  void add_sheets(const FreeSheet& pattern, double across, const Interval& piece,
                  std::vector<FreeSheet>& sheets) const {
    const StiffenerPlates& shape = row_.plates.value();
    const double far = plate_.thickness / 2 + shape.web_height;
    const auto corner = [&](double along_it, double above, double aside) {
      return point(along_it, across + aside, above);
    };
    FreeSheet& web = sheets.emplace_back(pattern);
    web.name += ", web";
    web.thickness = shape.web_thickness;
    web.corners = {corner(piece.lower, 0, 0), corner(piece.upper, 0, 0),
                   corner(piece.upper, far, 0), corner(piece.lower, far, 0)};
    if (!(shape.flange_thickness > 0)) return;
    auto [from, to] = shape.flange_reach;
    // Axis 3 is (along) x (away from the plate): u x n is -v, v x n is u.
    if ((along() == 1 ? 1 : -1) * row_.side < 0) from = -std::exchange(to, -from);
    FreeSheet& flange = sheets.emplace_back(pattern);
    flange.name += ", flange";
    flange.thickness = shape.flange_thickness;
    flange.corners = {corner(piece.lower, far, from), corner(piece.upper, far, from),
                      corner(piece.upper, far, to), corner(piece.lower, far, to)};
  }

  void add_line(int number, double across, std::vector<BeamLine>& lines) const {
    const LinePieces line = line_at(across);
    LinePieces on_plate = line;
    for (const FreePad& pad : block_.free_pads) {
      if (pad.plate != plate_.name) continue;
      const Interval &reach = pad.extent[along()], &width = pad.extent[1 - along()];
      if (across < width.lower - same_line || across > width.upper + same_line) continue;
      LinePieces on_pad = line;
      leave_out(-1e9, reach.lower, on_pad);
      leave_out(reach.upper, 1e9, on_pad);
      leave_out(reach.lower, reach.upper, on_plate);
      add_beams(number, across, on_pad, pad.thickness, lines);
    }
    add_beams(number, across, on_plate, plate_.thickness, lines);
  }

  void cut(const FreeOpening& opening, double across, LinePieces& line) const {
    std::vector<Point2> corners;
    for (const Vector3& corner : opening.corners) corners.push_back(seen(corner));
    if (opening.corners.empty()) {
      const Point2 first = seen(opening.centres.front()), last = seen(opening.centres.back());
      leave_out_circle(first, opening.radius, across, line);
      leave_out_circle(last, opening.radius, across, line);
      if (opening.centres.size() > 1) {
        const Point2 slot = (last - first).normalized();
        const Point2 side = opening.radius * Point2(-slot.y(), slot.x());
        corners = {first - side, last - side, last + side, first + side};
      }
    }
    for (const Interval& open : within_polygon(corners, across))
      leave_out(open.lower, open.upper, line);
    leave_out_sides(corners, across, line);
  }

  void add_beams(int number, double across, const LinePieces& line, double thickness,
                 std::vector<BeamLine>& lines) const {
    for (const Interval& part : line) {
      if (part.upper - part.lower < out_of_plane) continue;
      BeamLine beam{point(part.lower, across), point(part.upper, across), {}};
      beam.pattern.section = beam.pattern.region = number;
      beam.pattern.axis_2 = row_.side * frame_.axes.col(2);
      const Vector3 axis_3 = frame_.axes.col(along()).cross(beam.pattern.axis_2);
      const Vector3 offset =
          (thickness / 2 + row_.centroid[0]) * beam.pattern.axis_2 + row_.centroid[1] * axis_3;
      beam.pattern.offset = {offset, offset};
      lines.push_back(beam);
    }
  }

  const BlockDescription& block_;
  const FreePlate& plate_;
  const Stiffeners& row_;
  PlaneFrame frame_;
  std::vector<Point2> corners_;
};

/// The plate of a sound row.
const FreePlate& plate_of_row(const BlockDescription& block, const Stiffeners& row) {
  const std::string what = "row of stiffeners \"" + row.name + "\"";
  check_stiffeners(row);
  if (row.along == Axis::z)
    throw ModelError(what + " runs along the normal of its plate; it runs along u or v");
  return plane_plate(block, what, row.plate);
}

}  // namespace

std::vector<FreeSheet> spread_free_sheets(const BlockDescription& block) {
  std::vector<FreeSheet> sheets;
  for (const FreePlate& plate : block.free_plates) {
    check_plane(plate);
    sheets.push_back(
        {plate.name, SheetRank::plate, plate.thickness, plate.material, plate.corners, -1});
  }
  for (std::size_t i = 0; i < block.free_stiffeners.size(); ++i) {
    const Stiffeners& row = block.free_stiffeners[i];
    if (!row.plates) continue;
    const FreePlate& plate = plate_of_row(block, row);
    Row(block, plate, row)
        .add_sheets(static_cast<int>(i), row.material.empty() ? plate.material : row.material,
                    sheets);
  }
  const int first_pad = static_cast<int>(sheets.size());
  for (const FreePad& pad : block.free_pads) {
    const std::string what = "pad \"" + pad.name + "\"";
    const FreePlate& plate = plane_plate(block, what, pad.plate);
    require_thickness(what, pad.thickness);
    if (pad.thickness < plate.thickness - 1e-9)
      throw ModelError(
          fmt::format("{} is {:g} mm thick in total, thinner than plate \"{}\" ({:g} mm)", what,
                      pad.thickness * 1e3, plate.name, plate.thickness * 1e3));
    sheets.push_back({pad.name, SheetRank::pad, pad.thickness,
                      pad.material.empty() ? plate.material : pad.material,
                      corners_of(what, frame_of_polygon(plate.corners), 2, 0,
                                 {pad.extent[0], pad.extent[1], {}}),
                      place_of_name(block.free_plates, plate.name)});
  }
  for (const FreeLug& lug : block.free_lugs) {
    const std::string what = "lug \"" + lug.name + "\"";
    const int place = place_of_name(block.free_pads, lug.pad);
    if (place < 0)
      throw ModelError(fmt::format(
          "{} stands on pad \"{}\", which no plate given by its corners has", what, lug.pad));
    require_thickness(what, lug.thickness);
    if (!lug.p_BPin.allFinite()) throw ModelError(what + " has a pin centre that is not a number");
    const FreePlate& plate = plane_plate(block, what, block.free_pads[place].plate);
    sheets.push_back({lug.name, SheetRank::lug, lug.thickness,
                      lug.material.empty() ? sheets[first_pad + place].material : lug.material,
                      corners_of(what, frame_of_polygon(plate.corners),
                                 static_cast<int>(lug.normal), lug.position, lug.extent),
                      first_pad + place});
  }
  return sheets;
}

std::vector<BeamLine> free_stiffener_lines(const BlockDescription& block) {
  std::vector<BeamLine> lines;
  for (std::size_t i = 0; i < block.free_stiffeners.size(); ++i) {
    const Stiffeners& row = block.free_stiffeners[i];
    if (!row.plates)
      Row(block, plate_of_row(block, row), row).add_lines(static_cast<int>(i), lines);
  }
  return lines;
}

}  // namespace blocklift::structure
