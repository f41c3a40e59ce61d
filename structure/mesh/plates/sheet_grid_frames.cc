// Frames of openings that are no rectangles in the grid of sheets.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/plates/sheet_grid.h"

namespace blocklift::structure {

namespace {

double gap(const Interval& a, const Interval& b) {
  return std::max({0.0, a.lower - b.upper, b.lower - a.upper});
}

std::array<Interval, 2> area_of(const HoleOutline& outline) {
  return {{{outline.lower().x(), outline.upper().x()}, {outline.lower().y(), outline.upper().y()}}};
}

}  // namespace

// What a frame of an opening must not enter, as rectangles in the two axes that follow the sheet's
// normal: lines where other sheets stand on this one, edges of all that lies in its plane, other
// openings with half the way to them.
std::vector<SheetGrid::Area> SheetGrid::obstacles_of(const Sheet& sheet,
                                                     const Cutout& cutout) const {
  const int u = (sheet.normal + 1) % 3, v = (sheet.normal + 2) % 3;
  const double margin = sheet.thickness / 2 + same_place;
  std::vector<Area> obstacles;
  const auto add_edges = [&](const std::array<Interval, 3>& extent, const Sheet* end) {
    const auto edge = [&](int axis, double place) { return snapped(axis, place, end); };
    const Interval along_u{edge(u, extent[u].lower), edge(u, extent[u].upper)};
    const Interval along_v{edge(v, extent[v].lower), edge(v, extent[v].upper)};
    for (const double place : {along_u.lower, along_u.upper})
      obstacles.push_back({{{place, place}, along_v}});
    for (const double place : {along_v.lower, along_v.upper})
      obstacles.push_back({{along_u, {place, place}}});
  };
  for (const Sheet& other : sheets_) {
    const Interval& reach = other.extent[sheet.normal];
    if (other.normal != sheet.normal) {
      if (reach.lower > sheet.position + margin || reach.upper < sheet.position - margin) continue;
      const Interval line{other.position, other.position};
      if (other.normal == u)
        obstacles.push_back({{line, other.extent[v]}});
      else
        obstacles.push_back({{other.extent[u], line}});
    } else if (std::abs(other.position - sheet.position) < 1e-6) {
      add_edges(other.extent, &other);
    }
  }
  for (const auto& hole : sheet.holes) add_edges(hole, nullptr);
  const Area own = area_of(cutout.outline);
  for (const Cutout& other : sheet.cutouts) {
    if (&other == &cutout) continue;
    Area there = area_of(other.outline);
    const double half = std::max(gap(own[0], there[0]), gap(own[1], there[1])) / 2;
    for (Interval& side : there) side = {side.lower - half, side.upper + half};
    obstacles.push_back(there);
  }
  return obstacles;
}

// How far a frame may go from the opening on its sides, of all that allow the most in the direction
// in which an obstacle is farther off: (lower, upper) along either axis.
std::array<Interval, 2> SheetGrid::room_about(const Sheet& sheet, const Cutout& cutout,
                                              double most) const {
  std::array<Interval, 2> room{{{most, most}, {most, most}}};
  const Area hole = area_of(cutout.outline);
  for (const Area& obstacle : obstacles_of(sheet, cutout)) {
    const double gaps[2] = {gap(hole[0], obstacle[0]), gap(hole[1], obstacle[1])};
    const std::size_t axis = gaps[0] > gaps[1] ? 0 : 1;
    if (gaps[axis] < same_place)
      throw ModelError(
          fmt::format("{} of {} meets another plate, pad, opening or edge; a hole that is no "
                      "rectangle lies between them",
                      cutout.name, sheet.name));
    double& side = obstacle[axis].upper < hole[axis].lower ? room[axis].lower : room[axis].upper;
    // What lies beside the frame's end along the other axis is no matter.
    const std::size_t other = 1 - axis;
    const double beside =
        obstacle[other].upper < hole[other].lower ? room[other].lower : room[other].upper;
    if (gaps[other] < beside) side = std::min(side, gaps[axis]);
  }
  return room;
}

// The frame's sides lie a third of the opening's shorter side away from it, or in planes that are
// there anyway between an eighth and five eighths of that side.
Interval SheetGrid::frame_side(int axis, const Interval& hole, const Interval& room,
                               double size) const {
  const auto distance_to = [&](double edge, int outward, double limit) {
    double found = limit;
    bool is_found = false;
    for (const double plane : planes_[axis]) {
      const double distance = outward * (plane - edge);
      if (distance < size / 8 || distance > found + same_place) continue;
      found = std::min(found, distance);
      is_found = true;
    }
    return is_found ? found : std::min(limit, size / 3);
  };
  return {hole.lower - distance_to(hole.lower, -1, room.lower),
          hole.upper + distance_to(hole.upper, 1, room.upper)};
}

void SheetGrid::collect_frames() {
  for (std::size_t s = 0; s < sheets_.size(); ++s)
    for (const Cutout& cutout : sheets_[s].cutouts) {
      HoleFrame frame{static_cast<int>(s), {}, cutout};
      const double size = (cutout.outline.upper() - cutout.outline.lower()).minCoeff();
      const Area hole = area_of(cutout.outline);
      const std::array<Interval, 2> room = room_about(sheets_[s], cutout, 5 * size / 8);
      for (int i = 0; i < 2; ++i) {
        const int axis = (sheets_[s].normal + 1 + i) % 3;
        const Interval extent = frame_side(axis, hole[i], room[i], size);
        frame.extent[axis] = extent;
        add_plane(axis, extent.lower);
        add_plane(axis, extent.upper);
      }
      frames_.push_back(std::move(frame));
    }
  for (auto& planes : planes_) std::sort(planes.begin(), planes.end());
}

// A frame is a sheet of its own to its surroundings.
void SheetGrid::set_frames_apart() {
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const HoleFrame& frame = frames_[f];
    const Sheet& sheet = sheets_[frame.sheet];
    const int u = (sheet.normal + 1) % 3, v = (sheet.normal + 2) % 3;
    const SheetPanel box = box_of_hole(sheet, frame.extent);
    std::map<int, int> framed;  // signatures, without and with the frame
    Place place = box.lower;
    place[sheet.normal] = plane_at(sheet.normal, sheet.position);
    for (place[v] = box.lower[v]; place[v] < box.upper[v]; ++place[v])
      for (place[u] = box.lower[u]; place[u] < box.upper[u]; ++place[u]) {
        int& face = faces_[sheet.normal][index(place)];
        if (owners_[face] != frame.sheet)
          throw ModelError(fmt::format("{} of {} lies in a pad, a lug or another opening",
                                       frame.cutout.name, sheet.name));
        const auto [entry, is_new] = framed.try_emplace(face, static_cast<int>(signatures_.size()));
        if (is_new) {
          signatures_.push_back(std::vector<int>(signatures_[face]));
          owners_.push_back(static_cast<int>(sheets_.size() + f));
        }
        face = entry->second;
      }
  }
}

std::vector<SheetGrid::Place> SheetGrid::points_around(const HoleFrame& frame) const {
  const Sheet& sheet = sheets_[frame.sheet];
  const int u = (sheet.normal + 1) % 3, v = (sheet.normal + 2) % 3;
  SheetPanel box = box_of_hole(sheet, frame.extent);
  box.lower[sheet.normal] = plane_at(sheet.normal, sheet.position);
  std::vector<Place> points;
  Place place = box.lower;
  const auto walk = [&](int axis, int end) {
    const int step = end > place[axis] ? 1 : -1;
    while (place[axis] != end) {
      if (is_kept_[axis][index(place)] != 0) points.push_back(place);
      place[axis] += step;
    }
  };
  walk(u, box.upper[u]);
  walk(v, box.upper[v]);
  walk(u, box.lower[u]);
  walk(v, box.lower[v]);
  return points;
}

}  // namespace blocklift::structure
