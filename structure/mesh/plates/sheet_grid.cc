#include "structure/mesh/plates/sheet_grid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"

namespace blocklift::structure {

namespace {

constexpr double most_points = 5e7;  // of the grid: 1 GB

}  // namespace

SheetGrid::SheetGrid(std::vector<Sheet> sheets) : sheets_(std::move(sheets)) {
  for (int axis = 0; axis < 3; ++axis) check_stations(axis);
  for (int axis = 0; axis < 3; ++axis) collect_planes(axis);
  collect_frames();
  double points = 1;
  for (int axis = 0; axis < 3; ++axis) points *= count(axis);
  if (points > most_points)
    throw ModelError(
        fmt::format("the edges of the block's plates make a grid of {:.2g} points, and "
                    "{:.2g} are allowed; align them, or leave some plates out",
                    points, most_points));
  fill();
  set_frames_apart();
  mark_stiffeners();
  for (int axis = 0; axis < 3; ++axis) {
    is_kept_[axis].assign(faces_[0].size(), 1);
    for (int plane = 1; plane + 1 < count(axis); ++plane) find_cuts(axis, plane);
  }
}

void SheetGrid::check_stations(int axis) const {
  std::vector<const Sheet*> order;
  for (const Sheet& sheet : sheets_)
    if (sheet.normal == axis) order.push_back(&sheet);
  std::stable_sort(order.begin(), order.end(),
                   [](const Sheet* a, const Sheet* b) { return a->position < b->position; });
  double before = 0, here = 0;  // greatest thickness in the plane before and in this one
  const Sheet *first_before = nullptr, *first = nullptr;
  for (const Sheet* sheet : order) {
    if (!first || sheet->position - first->position > 1e-6) {
      before = std::exchange(here, 0);
      first_before = std::exchange(first, sheet);
    }
    here = std::max(here, sheet->thickness);
    const double needed = (before + here) / 2;
    if (first_before && first->position - first_before->position < needed + same_place)
      throw ModelError(fmt::format(
          "{} and {} lie {:g} mm apart, but half their thicknesses make {:g} mm: they would run "
          "into one another; align them in one plane or set them further apart",
          first_before->name, first->name, (first->position - first_before->position) * 1e3,
          needed * 1e3));
  }
}

// Whether a sheet, thickened, lies where another one's edge may end on it.
bool SheetGrid::reaches(const Sheet& sheet, const Sheet& end, int axis) const {
  const double margin = end.thickness / 2 + same_place;
  for (int other = 0; other < 3; ++other) {
    if (other == axis) continue;
    const Interval& here = sheet.extent[other];
    const Interval there =
        other == end.normal ? Interval{end.position, end.position} : end.extent[other];
    if (there.upper < here.lower - margin || there.lower > here.upper + margin) return false;
  }
  return true;
}

// Plates draw all edges near them, whether they touch or not, so that edges that are meant to lie
// in one plane do; pads and lugs, which are thick, those that end on them.
double SheetGrid::snapped(int axis, double coordinate, const Sheet* end) const {
  const Sheet* nearest = nullptr;
  for (const Sheet& sheet : sheets_) {
    const double distance = std::abs(coordinate - sheet.position);
    if (sheet.normal != axis || distance > sheet.thickness / 2 + same_place) continue;
    if (sheet.rank != SheetRank::plate && !(end && reaches(sheet, *end, axis))) continue;
    if (!nearest || distance < std::abs(coordinate - nearest->position)) nearest = &sheet;
  }
  return nearest ? nearest->position : coordinate;
}

void SheetGrid::add_plane(int axis, double coordinate) {
  std::vector<double>& planes = planes_[axis];
  if (std::none_of(planes.begin(), planes.end(),
                   [&](double plane) { return std::abs(plane - coordinate) < same_place; }))
    planes.push_back(coordinate);
}

void SheetGrid::collect_planes(int axis) {
  const auto add = [&](double coordinate) { add_plane(axis, coordinate); };
  for (const Sheet& sheet : sheets_)
    if (sheet.normal == axis) add(sheet.position);
  for (const Sheet& sheet : sheets_) {
    if (sheet.normal == axis) continue;
    for (const double edge : {sheet.extent[axis].lower, sheet.extent[axis].upper})
      add(snapped(axis, edge, &sheet));
    for (const auto& hole : sheet.holes)
      for (const double edge : {hole[axis].lower, hole[axis].upper})
        add(snapped(axis, edge, nullptr));
    for (const StiffenerLine& line : sheet.stiffeners)
      if (line.along != axis) add(snapped(axis, line.position, nullptr));
  }
  std::sort(planes_[axis].begin(), planes_[axis].end());
}

int SheetGrid::plane_at(int axis, double coordinate) const {
  const std::vector<double>& planes = planes_[axis];
  const auto nearest = std::min_element(planes.begin(), planes.end(), [&](double a, double b) {
    return std::abs(a - coordinate) < std::abs(b - coordinate);
  });
  return static_cast<int>(nearest - planes.begin());
}

SheetPanel SheetGrid::box_of(const Sheet& sheet) const {
  SheetPanel box;
  box.normal = sheet.normal;
  for (int axis = 0; axis < 3; ++axis) {
    int &lower = box.lower[axis], &upper = box.upper[axis];
    if (axis == sheet.normal) {
      lower = upper = plane_at(axis, sheet.position);
      continue;
    }
    const Interval& extent = sheet.extent[axis];
    lower = plane_at(axis, snapped(axis, extent.lower, &sheet));
    upper = plane_at(axis, snapped(axis, extent.upper, &sheet));
    if (lower == upper)
      throw ModelError(
          fmt::format("{} extends from {:g} m to {:g} m along {}: it lies within the "
                      "thickness of a plate there; extend it or leave it out",
                      sheet.name, extent.lower, extent.upper, "xyz"[axis]));
  }
  return box;
}

SheetPanel SheetGrid::box_of_hole(const Sheet& sheet, const std::array<Interval, 3>& hole) const {
  SheetPanel box;
  box.normal = sheet.normal;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == sheet.normal) continue;
    box.lower[axis] = plane_at(axis, snapped(axis, hole[axis].lower, nullptr));
    box.upper[axis] = plane_at(axis, snapped(axis, hole[axis].upper, nullptr));
  }
  return box;
}

void SheetGrid::fill() {
  const std::size_t points = planes_[0].size() * planes_[1].size() * planes_[2].size();
  for (auto& faces : faces_) faces.assign(points, 0);
  signatures_ = {{}};
  owners_ = {-1};
  std::map<std::pair<int, int>, int> joined;  // (signature, sheet added) -> signature
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    const Sheet& sheet = sheets_[s];
    const int u = (sheet.normal + 1) % 3, v = (sheet.normal + 2) % 3;
    const SheetPanel box = box_of(sheet);
    std::vector<SheetPanel> holes;
    for (const auto& hole : sheet.holes) holes.push_back(box_of_hole(sheet, hole));
    Place place = box.lower;
    const auto is_in = [&](const SheetPanel& hole) {
      return place[u] >= hole.lower[u] && place[u] < hole.upper[u] && place[v] >= hole.lower[v] &&
             place[v] < hole.upper[v];
    };
    for (place[v] = box.lower[v]; place[v] < box.upper[v]; ++place[v])
      for (place[u] = box.lower[u]; place[u] < box.upper[u]; ++place[u]) {
        if (std::any_of(holes.begin(), holes.end(), is_in)) continue;
        int& face = faces_[sheet.normal][index(place)];
        const auto [entry, is_new] = joined.try_emplace(std::pair{face, static_cast<int>(s)},
                                                        static_cast<int>(signatures_.size()));
        if (is_new) {
          signatures_.push_back(signatures_[face]);
          signatures_.back().push_back(static_cast<int>(s));
          owners_.push_back(owner(sheets_, signatures_.back()));
        }
        face = entry->second;
      }
  }
}

bool SheetGrid::has_sheet(int normal, const Place& place, int sheet) const {
  if (*std::min_element(place.begin(), place.end()) < 0) return false;
  const std::vector<int>& here = signatures_[face(normal, place)];
  return std::find(here.begin(), here.end(), sheet) != here.end();
}

// Whether a stiffener stands on the line from a point of the grid upwards: there is plate beside
// it, and no other plate on its side.
bool SheetGrid::bears(int sheet, const StiffenerLine& line, const Place& place) const {
  if (!(thickness_under(sheet, line, place) > 0)) return false;
  const int normal = sheets_[sheet].normal, across = 3 - line.along - normal;
  Place other = place;
  if (line.side < 0) --other[normal];
  return other[normal] < 0 || face(across, other) == 0;
}

// Thickness beside a stiffener: the plate's own, or that of what covers it on both sides; 0 where
// there is neither plate nor pad. Stiffeners end at the frames of openings.
double SheetGrid::thickness_under(int sheet, const StiffenerLine& line, const Place& place) const {
  const int normal = sheets_[sheet].normal, across = 3 - line.along - normal;
  double thinnest = 0;
  for (int step = 0; step < 2; ++step) {
    Place beside = place;
    beside[across] -= step;
    if (!has_sheet(normal, beside, sheet)) continue;
    const int top_sheet = owners_[face(normal, beside)];
    if (top_sheet >= static_cast<int>(sheets_.size())) continue;
    const Sheet& top = sheets_[top_sheet];
    if (top.rank == SheetRank::lug) continue;
    if (thinnest == 0 || top.thickness < thinnest) thinnest = top.thickness;
  }
  return thinnest;
}

SheetGrid::Place SheetGrid::start_of(const SheetPanel& box, const StiffenerLine& line) const {
  Place start = box.lower;
  const int across = 3 - line.along - box.normal;
  start[across] = plane_at(across, snapped(across, line.position, nullptr));
  return start;
}

void SheetGrid::mark_stiffeners() {
  for (auto& asked : is_asked_) asked.assign(faces_[0].size(), 0);
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    const SheetPanel box = box_of(sheets_[s]);
    for (const StiffenerLine& line : sheets_[s].stiffeners) {
      const int across = 3 - line.along - box.normal;
      const std::size_t along = at(line.along);
      bool bore = false;
      for (Place place = start_of(box, line); place[along] <= box.upper[along]; ++place[along]) {
        const bool is_borne =
            place[along] < box.upper[along] && bears(static_cast<int>(s), line, place);
        if (bore || is_borne) is_asked_[across][index(place)] = 1;
        if (bore != is_borne) is_asked_[along][index(place)] = 1;
        bore = is_borne;
      }
    }
  }
}

std::vector<StiffenerSpan> SheetGrid::stiffener_spans() const {
  std::vector<StiffenerSpan> spans;
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    const auto sheet = static_cast<int>(s);
    const SheetPanel box = box_of(sheets_[s]);
    for (const StiffenerLine& line : sheets_[s].stiffeners) {
      const std::size_t along = at(line.along);
      Place place = start_of(box, line);
      while (place[along] < box.upper[along]) {
        Place end = place;
        do ++end[along];
        while (end[along] < box.upper[along] && is_kept_[along][index(end)] == 0);
        if (bears(sheet, line, place))
          spans.push_back({line.row, sheet, line.along, place, end, line.side,
                           thickness_under(sheet, line, place)});
        place = end;
      }
    }
  }
  return spans;
}

// Whether a sheet across the axis touches the point.
bool SheetGrid::is_cut_at(int axis, const Place& point) const {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  for (int db = 0; db < 2; ++db)
    for (int dc = 0; dc < 2; ++dc) {
      Place corner = point;
      corner[b] -= db;
      corner[c] -= dc;
      if (corner[b] >= 0 && corner[c] >= 0 && face(axis, corner) != 0) return true;
    }
  return false;
}

// In each piece of steel that is connected along the plane, the cut is left out if both sides are
// the same everywhere and no sheet lies in the plane. Pieces touch by points of the section, so a
// rectangle that grows has neighbours that grow alike.
void SheetGrid::find_cuts(int axis, int plane) {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  std::vector<char> is_seen(at(count(b)) * at(count(c)), 0);
  std::vector<Place> piece;
  const auto visit = [&](const Place& point) {
    char& mark = is_seen[at(point[c]) * at(count(b)) + at(point[b])];
    if (mark == 0) piece.push_back(point);
    mark = 1;
  };
  for (int pc = 0; pc < count(c); ++pc)
    for (int pb = 0; pb < count(b); ++pb) {
      Place start{};
      start[axis] = plane;
      start[b] = pb;
      start[c] = pc;
      piece.clear();
      visit(start);
      bool is_needed = false;
      for (std::size_t n = 0; n < piece.size(); ++n) {
        const Place point = piece[n];
        is_needed = is_needed || is_asked_[axis][index(point)] != 0 || is_cut_at(axis, point);
        for (const int along : {b, c})
          for (int step = -1; step < 2; step += 2) {
            Place end = point, above = point;
            end[along] += step;
            if (end[along] < 0 || end[along] >= count(along)) continue;
            if (step < 0) above = end;
            Place below = above;
            below[axis] -= 1;
            // The section's line from here along b belongs to a sheet across c, and the other way
            // round.
            const int normal = b + c - along;
            const int upper = face(normal, above), lower = face(normal, below);
            if (upper == 0 && lower == 0) continue;
            is_needed = is_needed || owners_[upper] != owners_[lower];
            visit(end);
          }
      }
      if (!is_needed)
        for (const Place& point : piece) is_kept_[axis][index(point)] = 0;
    }
}

std::vector<SheetPanel> SheetGrid::panels() const {
  std::vector<SheetPanel> panels;
  for (int normal = 0; normal < 3; ++normal) {
    const int u = (normal + 1) % 3, v = (normal + 2) % 3;
    const auto is_kept = [&](int axis, const Place& point) {
      return is_kept_[axis][index(point)] != 0;
    };
    Place place{};
    for (place[normal] = 0; place[normal] < count(normal); ++place[normal])
      for (place[v] = 0; place[v] < count(v); ++place[v])
        for (place[u] = 0; place[u] < count(u); ++place[u]) {
          const int signature = face(normal, place);
          if (signature == 0 || !is_kept(u, place) || !is_kept(v, place)) continue;
          SheetPanel panel{normal, place, place, {}, owners_[signature], -1};
          if (panel.owner >= static_cast<int>(sheets_.size())) {
            panel.frame = panel.owner - static_cast<int>(sheets_.size());
            panel.owner = frames_[panel.frame].sheet;
          }
          for (const int axis : {u, v}) {
            Place end = place;
            do ++end[axis];
            while (!is_kept(axis, end));
            panel.upper[axis] = end[axis];
          }
          std::set<int> found;
          Place part = place;
          for (part[v] = place[v]; part[v] < panel.upper[v]; ++part[v])
            for (part[u] = place[u]; part[u] < panel.upper[u]; ++part[u]) {
              const std::vector<int>& here = signatures_[face(normal, part)];
              found.insert(here.begin(), here.end());
            }
          panel.sheets.assign(found.begin(), found.end());
          panels.push_back(std::move(panel));
        }
  }
  std::stable_sort(panels.begin(), panels.end(),
                   [](const SheetPanel& a, const SheetPanel& b) { return a.owner < b.owner; });
  return panels;
}

}  // namespace blocklift::structure
