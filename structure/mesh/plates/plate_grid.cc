#include "structure/mesh/plates/plate_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"

namespace blocklift::structure {

namespace {

constexpr double snap = 0.5e-3;  // m: cuts nearer than this are one
constexpr double slice_excess = 0.3;
constexpr double most_boxes = 5e7;  // of the grid before merging: 0.2 GB

}  // namespace

PlateGrid::PlateGrid(const BlockDescription& description, std::vector<Sheet> sheets)
    : sheets_(std::move(sheets)) {
  for (int axis = 0; axis < 3; ++axis) find_stations(axis);
  for (int axis = 0; axis < 3; ++axis) collect_planes(axis, description);
  check_size(description.largest_element);
  for (int axis = 0; axis < 3; ++axis) subdivide(axis, description.largest_element);
  fill(description);
}

// Before anything is made: a grid that no machine holds is refused, not begun.
void PlateGrid::check_size(double largest_element) const {
  if (!(largest_element > 0))
    throw ModelError(
        fmt::format("the largest element is {:g} m; it must be positive", largest_element));
  double boxes = 1;
  for (const std::vector<Plane>& planes : planes_) {
    double parts = 0;
    for (std::size_t i = 1; i < planes.size(); ++i)
      parts += std::max(
          1.0, std::ceil((planes[i].coordinate - planes[i - 1].coordinate) / largest_element));
    boxes *= std::max(1.0, parts);
  }
  if (boxes > most_boxes)
    throw ModelError(
        fmt::format("elements of at most {:g} m make a grid of {:.2g} boxes, and {:.2g} are "
                    "allowed; use larger "
                    "elements",
                    largest_element, boxes, most_boxes));
}

void PlateGrid::find_stations(int axis) {
  auto& stations = stations_[at(axis)];
  std::vector<int> order;
  for (std::size_t s = 0; s < sheets_.size(); ++s)
    if (sheets_[s].normal == axis) order.push_back(static_cast<int>(s));
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return sheets_[at(a)].position < sheets_[at(b)].position; });
  for (const int s : order) {
    const Sheet& sheet = sheets_[at(s)];
    if (stations.empty() || sheet.position - stations.back().position > 1e-6)
      stations.push_back({sheet.position, {}, {}, sheet.name});
    stations.back().sheets.push_back(s);
  }
  for (Station& station : stations) {
    double plates = 0;
    std::set<double> thicker;
    for (const int s : station.sheets)
      if (sheets_[at(s)].rank == SheetRank::plate)
        plates = std::max(plates, sheets_[at(s)].thickness);
    for (const int s : station.sheets)
      if (sheets_[at(s)].thickness > plates + 1e-4) thicker.insert(sheets_[at(s)].thickness);
    if (plates > 0) station.levels.push_back(plates);
    for (const double thickness : thicker)
      if (station.levels.empty() || thickness > station.levels.back() + 1e-4)
        station.levels.push_back(thickness);
  }
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const Station &a = stations[i - 1], &b = stations[i];
    const double needed = (a.levels.back() + b.levels.back()) / 2;
    if (b.position - a.position < needed + snap)
      throw ModelError(fmt::format(
          "{} and {} lie {:g} mm apart, but half their thicknesses make {:g} mm: they would run "
          "into one another; align them in one plane or set them further apart",
          a.first_sheet, b.first_sheet, (b.position - a.position) * 1e3, needed * 1e3));
  }
}

// An edge within a plate's thickness is led to a face of that plate: the far one for the end of a
// plate (outward = +1 at its upper end, -1 at its lower end), the near one for that of a hole.
double PlateGrid::snapped(int axis, double coordinate, int outward) const {
  for (const Station& station : stations_[at(axis)]) {
    const double half = station.levels.front() / 2;
    if (std::abs(coordinate - station.position) < half + snap)
      return station.position + outward * half;
  }
  return coordinate;
}

void PlateGrid::collect_planes(int axis, const BlockDescription& description) {
  auto& planes = planes_[at(axis)];
  for (std::size_t s = 0; s < stations_[at(axis)].size(); ++s) {
    const Station& station = stations_[at(axis)][s];
    for (std::size_t level = 0; level < station.levels.size(); ++level)
      for (const int side : {-1, 1})
        planes.push_back({station.position + side * station.levels[level] / 2,
                          level == 0 ? static_cast<int>(s) : -1, side});
  }
  std::vector<double> edges;
  const auto add = [&](int normal, const Interval& range, int outward) {
    if (normal == axis) return;
    edges.push_back(snapped(axis, range.lower, -outward));
    edges.push_back(snapped(axis, range.upper, outward));
  };
  for (const Sheet& sheet : sheets_) add(sheet.normal, sheet.extent[at(axis)], 1);
  for (const Opening& opening : description.openings)
    for (const Plate& plate : description.plates)
      if (plate.name == opening.plate)
        add(static_cast<int>(plate.normal), opening.extent[at(axis)], -1);
  for (const double edge : edges)
    if (std::none_of(planes.begin(), planes.end(),
                     [&](const Plane& plane) { return std::abs(plane.coordinate - edge) < snap; }))
      planes.push_back({edge, -1, 0});
  std::sort(planes.begin(), planes.end(),
            [](const Plane& a, const Plane& b) { return a.coordinate < b.coordinate; });
}

void PlateGrid::subdivide(int axis, double largest_element) {
  std::vector<Plane> divided;
  for (const Plane& plane : planes_[at(axis)]) {
    if (!divided.empty()) {
      const double start = divided.back().coordinate, gap = plane.coordinate - start;
      const int parts = std::max(1, static_cast<int>(std::ceil(gap / largest_element - 1e-9)));
      for (int i = 1; i < parts; ++i) divided.push_back({start + gap * i / parts, -1, 0});
    }
    divided.push_back(plane);
  }
  planes_[at(axis)] = std::move(divided);
}

int PlateGrid::plane_at(int axis, double coordinate) const {
  const auto& planes = planes_[at(axis)];
  std::size_t best = 0;
  for (std::size_t i = 1; i < planes.size(); ++i)
    if (std::abs(planes[i].coordinate - coordinate) <
        std::abs(planes[best].coordinate - coordinate))
      best = i;
  return static_cast<int>(best);
}

std::size_t PlateGrid::level_of(const Station& station, const Sheet& sheet) const {
  for (std::size_t level = station.levels.size(); level-- > 1;)
    if (sheet.thickness > (station.levels[level - 1] + 1e-4)) return level;
  return 0;
}

GridBox PlateGrid::box_of(const Sheet& sheet) const {
  GridBox box;
  for (int axis = 0; axis < 3; ++axis) {
    double lower = 0, upper = 0;
    if (axis == sheet.normal) {
      for (const Station& station : stations_[at(axis)])
        if (std::abs(station.position - sheet.position) < 1e-6) {
          const double half = station.levels[level_of(station, sheet)] / 2;
          lower = station.position - half;
          upper = station.position + half;
        }
    } else {
      lower = snapped(axis, sheet.extent[at(axis)].lower, -1);
      upper = snapped(axis, sheet.extent[at(axis)].upper, 1);
    }
    box.lower[at(axis)] = plane_at(axis, lower);
    box.upper[at(axis)] = plane_at(axis, upper);
  }
  return box;
}

GridBox PlateGrid::hole_of(const Opening& opening, int normal) const {
  GridBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.upper[at(axis)] = count(axis);
    if (axis == normal) continue;
    box.lower[at(axis)] = plane_at(axis, snapped(axis, opening.extent[at(axis)].lower, 1));
    box.upper[at(axis)] = plane_at(axis, snapped(axis, opening.extent[at(axis)].upper, -1));
  }
  return box;
}

void PlateGrid::fill(const BlockDescription& description) {
  cell_signature_.assign(at(count(0)) * at(count(1)) * at(count(2)), 0);
  signatures_ = {{}};
  std::map<std::pair<int, int>, int> joined;  // (signature, sheet added) -> signature
  const auto contains = [](const GridBox& box, int i, int j, int k) {
    const int at_cell[3] = {i, j, k};
    for (int axis = 0; axis < 3; ++axis)
      if (at_cell[axis] < box.lower[at(axis)] || at_cell[axis] >= box.upper[at(axis)]) return false;
    return true;
  };
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    const Sheet& sheet = sheets_[s];
    std::vector<GridBox> holes;
    if (sheet.rank == SheetRank::plate)
      for (const Opening& opening : description.openings)
        if (opening.plate == description.plates[at(sheet.group)].name &&
            (opening.positions.empty() ||
             std::any_of(opening.positions.begin(), opening.positions.end(),
                         [&](double p) { return std::abs(p - sheet.position) < 1e-6; })))
          holes.push_back(hole_of(opening, sheet.normal));
    const GridBox box = box_of(sheet);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i) {
          if (std::any_of(holes.begin(), holes.end(),
                          [&](const GridBox& hole) { return contains(hole, i, j, k); }))
            continue;
          int& cell = cell_signature_[index(i, j, k)];
          const auto [entry, is_new] = joined.try_emplace(std::pair{cell, static_cast<int>(s)},
                                                          static_cast<int>(signatures_.size()));
          if (is_new) {
            signatures_.push_back(signatures_[at(cell)]);
            signatures_.back().push_back(static_cast<int>(s));
          }
          cell = entry->second;
        }
  }
}

// Leaves out the cut `plane` in each connected piece of steel along it where both sides are the
// same everywhere and the joined boxes stay small enough. Pieces touch by faces or edges, so the
// neighbours of a joined box are joined alike and the mesh stays conforming.
void PlateGrid::merge_plane(int axis, int plane, double largest_element,
                            std::array<std::vector<char>, 3>& merged) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int nu = count(u), nv = count(v);
  const auto cell = [&](int along, int a, int b) {
    std::array<int, 3> c{};
    c[at(axis)] = along;
    c[at(u)] = a;
    c[at(v)] = b;
    return index(c[0], c[1], c[2]);
  };
  const auto& planes = planes_[at(axis)];
  const auto joined_length = [&](int a, int b) {
    int first = plane - 1, last = plane + 1;
    while (first > 0 && merged[at(axis)][cell(first, a, b)]) --first;
    while (last < count(axis) && merged[at(axis)][cell(last, a, b)]) ++last;
    return planes[at(last)].coordinate - planes[at(first)].coordinate;
  };
  // A thin slice may make its neighbour a little longer than asked for, rather than stay.
  const double thin = std::min(planes[at(plane)].coordinate - planes[at(plane - 1)].coordinate,
                               planes[at(plane + 1)].coordinate - planes[at(plane)].coordinate);
  const double longest =
      (thin < slice_excess * largest_element ? 1 + slice_excess : 1 + 1e-9) * largest_element;
  std::vector<char> seen(at(nu) * at(nv), 0);
  std::vector<std::pair<int, int>> piece;
  for (int b0 = 0; b0 < nv; ++b0)
    for (int a0 = 0; a0 < nu; ++a0) {
      const auto steel = [&](int a, int b) {
        return cell_signature_[cell(plane - 1, a, b)] != 0 ||
               cell_signature_[cell(plane, a, b)] != 0;
      };
      if (seen[at(b0) * at(nu) + at(a0)] || !steel(a0, b0)) continue;
      piece.assign(1, {a0, b0});
      seen[at(b0) * at(nu) + at(a0)] = 1;
      bool same = true;
      for (std::size_t n = 0; n < piece.size(); ++n) {
        const auto [a, b] = piece[n];
        same = same &&
               cell_signature_[cell(plane - 1, a, b)] == cell_signature_[cell(plane, a, b)] &&
               joined_length(a, b) <= longest;
        for (int db = -1; db <= 1; ++db)
          for (int da = -1; da <= 1; ++da) {
            const int na = a + da, nb = b + db;
            if (na < 0 || nb < 0 || na >= nu || nb >= nv || !steel(na, nb)) continue;
            char& mark = seen[at(nb) * at(nu) + at(na)];
            if (!mark) piece.emplace_back(na, nb);
            mark = 1;
          }
      }
      if (!same) continue;
      for (const auto& [a, b] : piece) merged[at(axis)][cell(plane, a, b)] = 1;
    }
}

std::vector<GridBox> PlateGrid::merged_boxes(double largest_element) const {
  // merged[axis][cell]: the cut between the cell and the one before it along the axis is left out.
  std::array<std::vector<char>, 3> merged;
  for (int axis = 0; axis < 3; ++axis) {
    merged[at(axis)].assign(cell_signature_.size(), 0);
    const auto& planes = planes_[at(axis)];
    std::vector<int> order(planes.size() > 2 ? planes.size() - 2 : 0);
    std::iota(order.begin(), order.end(), 1);
    const auto sliver = [&](int p) {
      return std::min(planes[at(p)].coordinate - planes[at(p - 1)].coordinate,
                      planes[at(p + 1)].coordinate - planes[at(p)].coordinate);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return sliver(a) < sliver(b); });
    for (const int plane : order) merge_plane(axis, plane, largest_element, merged);
  }
  std::vector<GridBox> boxes;
  for (int k = 0; k < count(2); ++k)
    for (int j = 0; j < count(1); ++j)
      for (int i = 0; i < count(0); ++i) {
        const std::size_t first = index(i, j, k);
        if (cell_signature_[first] == 0 || merged[0][first] || merged[1][first] || merged[2][first])
          continue;
        GridBox box{{i, j, k}, {i + 1, j + 1, k + 1}};
        while (box.upper[0] < count(0) && merged[0][index(box.upper[0], j, k)]) ++box.upper[0];
        while (box.upper[1] < count(1) && merged[1][index(i, box.upper[1], k)]) ++box.upper[1];
        while (box.upper[2] < count(2) && merged[2][index(i, j, box.upper[2])]) ++box.upper[2];
        boxes.push_back(box);
      }
  return boxes;
}

double PlateGrid::local_thickness(const Station& station, int i, int j, int k) const {
  std::set<int> found;
  for (int c = std::max(0, k - 1); c < std::min(count(2), k + 1); ++c)
    for (int b = std::max(0, j - 1); b < std::min(count(1), j + 1); ++b)
      for (int a = std::max(0, i - 1); a < std::min(count(0), i + 1); ++a)
        for (const int s : sheets_in(a, b, c))
          if (std::find(station.sheets.begin(), station.sheets.end(), s) != station.sheets.end() &&
              level_of(station, sheets_[at(s)]) == 0)
            found.insert(s);
  if (found.empty()) return station.levels.front();
  double sum = 0;
  for (const int s : found) sum += sheets_[at(s)].thickness;
  return sum / static_cast<double>(found.size());
}

Vector3 PlateGrid::vertex(int i, int j, int k) const {
  const int grid[3] = {i, j, k};
  Vector3 place;
  for (int axis = 0; axis < 3; ++axis) {
    const Plane& plane = planes_[at(axis)][at(grid[axis])];
    place[axis] = plane.coordinate;
    if (plane.station < 0) continue;
    const Station& station = stations_[at(axis)][at(plane.station)];
    place[axis] = station.position + plane.side * local_thickness(station, i, j, k) / 2;
  }
  return place;
}

}  // namespace blocklift::structure
