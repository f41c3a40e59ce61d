#include "structure/mesh/plates/cell_maker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

constexpr double most_shells = 5e6;
constexpr int arc_order = 3;       // of the polynomials that follow arcs
constexpr int fewest_on_side = 2;  // elements on each side of a frame: eighths of a circle

/// The axis along which two points of a grid lie.
int axis_between(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  for (int axis = 0; axis < 2; ++axis)
    if (a[axis] != b[axis]) return axis;
  return 2;
}

}  // namespace

Divisions::Divisions(const SheetGrid& grid, double largest_element)
    : largest_element_(largest_element) {
  if (!(largest_element > 0))
    throw ModelError(
        fmt::format("the largest element is {:g} m; it must be positive", largest_element));
  for (int axis = 0; axis < 3; ++axis) coordinates_[axis] = grid.planes(axis);
}

double Divisions::parts(int axis, int lower, int upper) const {
  const std::vector<double>& planes = coordinates_[axis];
  const double asked = std::ceil((planes[upper] - planes[lower]) / largest_element_ - 1e-9);
  const auto required = required_.find({axis, lower, upper});
  return std::max(asked, required == required_.end() ? 1.0 : required->second);
}

void Divisions::require(int axis, int lower, int upper, int parts) {
  int& required = required_[{axis, lower, upper}];
  required = std::max(required, parts);
}

int Divisions::number(int axis, int lower, int upper, int part) {
  const auto count = static_cast<int>(parts(axis, lower, upper));
  if (part == 0) return lower;
  if (part == count) return upper;
  std::vector<double>& coordinates = coordinates_[axis];
  const auto [entry, is_new] =
      numbers_.try_emplace({axis, lower, upper, part}, static_cast<int>(coordinates.size()));
  if (is_new)
    coordinates.push_back(coordinates[lower] +
                          (coordinates[upper] - coordinates[lower]) * part / count);
  return entry->second;
}

CellMaker::CellMaker(const SheetGrid& grid, const std::vector<SheetPanel>& panels,
                     double largest_element, Mesh& mesh)
    : grid_(grid),
      largest_element_(largest_element),
      divisions_(grid, largest_element),
      mesh_(mesh) {
  check_size(panels, largest_element);
  for (const HoleFrame& frame : grid_.frames()) divide_frame(frame);
}

// Before anything is made: what no machine holds is refused, not begun.
void CellMaker::check_size(const std::vector<SheetPanel>& panels, double largest_element) const {
  double shells = 0;
  for (const SheetPanel& panel : panels) {
    double here = 1;
    for (int axis = 0; axis < 3; ++axis)
      if (axis != panel.normal)
        here *= divisions_.parts(axis, panel.lower[axis], panel.upper[axis]);
    shells += here;
  }
  if (shells > most_shells)
    throw ModelError(
        fmt::format("elements of at most {:g} m make {:.2g} shells, and {:.2g} are "
                    "allowed; use larger elements",
                    largest_element, shells, most_shells));
}

// Each side of a frame gets parts enough for the opening's pieces: its longest part is divided once
// more, until there are.
void CellMaker::divide_frame(const HoleFrame& frame) {
  struct Side {
    int axis, lower, upper;
  };
  const int pieces = frame.cutout.outline.pieces();
  const int wanted = std::max(fewest_on_side, pieces > 4 ? (pieces + 3) / 4 + 1 : fewest_on_side);
  const std::vector<Place> points = grid_.points_around(frame);
  std::map<std::pair<int, bool>, std::vector<Side>> sides;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Place &a = points[i], &b = points[(i + 1) % points.size()];
    const int axis = axis_between(a, b);
    const auto [lower, upper] = std::minmax(a[axis], b[axis]);
    sides[{axis, a[axis] < b[axis]}].push_back({axis, lower, upper});
  }
  for (const auto& towards : sides) {
    const std::vector<Side>& side = towards.second;
    const auto parts = [&](const Side& s) { return divisions_.parts(s.axis, s.lower, s.upper); };
    const auto size = [&](const Side& s) {
      return (divisions_.coordinate(s.axis, s.upper) - divisions_.coordinate(s.axis, s.lower)) /
             parts(s);
    };
    const auto count = [&] {
      double sum = 0;
      for (const Side& s : side) sum += parts(s);
      return sum;
    };
    while (count() < wanted) {
      const Side& longest =
          *std::max_element(side.begin(), side.end(),
                            [&](const Side& a, const Side& b) { return size(a) < size(b); });
      divisions_.require(longest.axis, longest.lower, longest.upper,
                         static_cast<int>(parts(longest)) + 1);
    }
  }
}

int CellMaker::parts(const Place& lower, const Place& upper, int axis) const {
  return static_cast<int>(divisions_.parts(axis, lower[axis], upper[axis]));
}

int CellMaker::vertex_at(const Vector3& place) {
  mesh_.vertices.push_back(place);
  mesh_.vertex_labels.push_back(static_cast<long>(mesh_.vertices.size()));
  return static_cast<int>(mesh_.vertices.size()) - 1;
}

int CellMaker::vertex(const Place& place) {
  const auto [entry, is_new] = vertices_.try_emplace(place, 0);
  if (is_new)
    entry->second =
        vertex_at({divisions_.coordinate(0, place[0]), divisions_.coordinate(1, place[1]),
                   divisions_.coordinate(2, place[2])});
  return entry->second;
}

void CellMaker::add_shell(Shell shell) {
  shell.label = static_cast<long>(mesh_.shells.size()) + 1;
  mesh_.shells.push_back(shell);
}

void CellMaker::add(const SheetPanel& panel, int section) {
  const int u = (panel.normal + 1) % 3, v = (panel.normal + 2) % 3;
  for (int j = 0; j < parts(panel.lower, panel.upper, v); ++j)
    for (int i = 0; i < parts(panel.lower, panel.upper, u); ++i) {
      Shell shell;
      for (int corner = 0; corner < 4; ++corner) {
        Place place = panel.lower;
        for (const auto& [axis, part] : {std::pair{u, i + corner % 2}, {v, j + corner / 2}})
          place[axis] = divisions_.number(axis, panel.lower[axis], panel.upper[axis], part);
        shell.vertices[corner] = vertex(place);
      }
      shell.section = section;
      shell.region = panel.owner;
      add_shell(shell);
    }
}

std::vector<int> CellMaker::vertices_around(const HoleFrame& frame) {
  const std::vector<Place> points = grid_.points_around(frame);
  std::vector<int> vertices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Place &a = points[i], &b = points[(i + 1) % points.size()];
    const int axis = axis_between(a, b);
    const bool is_forward = a[axis] < b[axis];
    const Place &lower = is_forward ? a : b, &upper = is_forward ? b : a;
    const int count = parts(lower, upper, axis);
    for (int part = 0; part < count; ++part) {
      Place place = a;
      place[axis] =
          divisions_.number(axis, lower[axis], upper[axis], is_forward ? part : count - part);
      vertices.push_back(vertex(place));
    }
  }
  return vertices;
}

/// What lies between the outline of a frame and its opening: sectors one after another,
/// anticlockwise.
struct CellMaker::Ring {
  struct Sector {
    int piece = 0;  ///< of the outline
    double first_share = 0, last_share = 0;
    Eigen::Vector2d first, last;  ///< on the frame
  };

  const HoleOutline& outline;
  int normal;
  double position;
  std::vector<int> outer;       ///< vertices where sectors begin, on the frame
  std::vector<Sector> sectors;  ///< as many
  int layers = 1;

  /// @param along 0 to 1 round the hole in the sector.
  /// @param outward 0 on the hole, 1 on the frame.
  Vector3 place(const Sector& sector, double along, double outward) const {
    const Eigen::Vector2d on_hole = outline.point(
        sector.piece, sector.first_share + along * (sector.last_share - sector.first_share));
    const Eigen::Vector2d on_frame = sector.first + along * (sector.last - sector.first);
    const Eigen::Vector2d point = on_hole + outward * (on_frame - on_hole);
    Vector3 place;
    place[normal] = position;
    place[(normal + 1) % 3] = point.x();
    place[(normal + 2) % 3] = point.y();
    return place;
  }
};

CellMaker::Ring CellMaker::ring_of(const HoleFrame& frame) {
  const Sheet& sheet = grid_.sheets()[frame.sheet];
  Ring ring{frame.cutout.outline, sheet.normal, 0, vertices_around(frame), {}, 1};
  ring.position = mesh_.vertices[ring.outer.front()][ring.normal];
  std::vector<Eigen::Vector2d> around;
  for (const int v : ring.outer) {
    const Vector3& place = mesh_.vertices[v];
    around.emplace_back(place[(ring.normal + 1) % 3], place[(ring.normal + 2) % 3]);
  }
  const std::vector<int> corners = match_corners(ring.outline, around);
  const auto count = static_cast<int>(around.size());
  ring.sectors.resize(around.size());
  double widths = 0, lengths = 0, widest = 0;
  for (std::size_t piece = 0; piece < corners.size(); ++piece) {
    const int next = corners[(piece + 1) % corners.size()];
    const int sectors = (next - corners[piece] + count) % count;
    for (int i = 0; i < sectors; ++i) {
      const int start = (corners[piece] + i) % count;
      const Ring::Sector sector{static_cast<int>(piece), static_cast<double>(i) / sectors,
                                static_cast<double>(i + 1) / sectors, around[start],
                                around[(start + 1) % count]};
      const double width = (ring.place(sector, 0, 1) - ring.place(sector, 0, 0)).norm();
      widest = std::max(widest, width);
      widths += width;
      lengths += (ring.place(sector, 1, 0.5) - ring.place(sector, 0, 0.5)).norm();
      ring.sectors[start] = sector;
    }
  }
  ring.layers = static_cast<int>(
      std::max({1.0, std::ceil(widest / largest_element_ - 1e-9), std::round(widths / lengths)}));
  return ring;
}

void CellMaker::add(const HoleFrame& frame, int section) {
  const Ring ring = ring_of(frame);
  const std::size_t count = ring.sectors.size();
  const auto share = [&](int layer) { return static_cast<double>(layer) / ring.layers; };
  std::vector<int> inner(count), outer(count);
  for (std::size_t i = 0; i < count; ++i) inner[i] = vertex_at(ring.place(ring.sectors[i], 0, 0));
  for (int layer = 0; layer < ring.layers; ++layer) {
    for (std::size_t i = 0; i < count; ++i)
      outer[i] = layer + 1 == ring.layers
                     ? ring.outer[i]
                     : vertex_at(ring.place(ring.sectors[i], 0, share(layer + 1)));
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t next = (i + 1) % count;
      Shell shell;
      shell.vertices = {inner[i], outer[i], inner[next], outer[next]};
      shell.section = section;
      shell.region = frame.sheet;
      if (!ring.outline.is_straight(ring.sectors[i].piece)) {
        shell.curvature = static_cast<int>(mesh_.curved_shells.size());
        Eigen::Matrix3Xd points(3, (arc_order + 1) * (arc_order + 1));
        for (int b = 0; b <= arc_order; ++b)
          for (int a = 0; a <= arc_order; ++a)
            points.col(b * (arc_order + 1) + a) =
                ring.place(ring.sectors[i], static_cast<double>(b) / arc_order,
                           share(layer) + static_cast<double>(a) / arc_order / ring.layers);
        mesh_.curved_shells.push_back(std::move(points));
      }
      add_shell(shell);
    }
    std::swap(inner, outer);
  }
}

void CellMaker::add(const StiffenerSpan& span, const Beam& pattern) {
  const int axis = span.along;
  for (int i = 0; i < parts(span.lower, span.upper, axis); ++i) {
    Beam beam = pattern;
    for (int end = 0; end < 2; ++end) {
      Place place = span.lower;
      place[axis] = divisions_.number(axis, span.lower[axis], span.upper[axis], i + end);
      beam.vertices[end] = vertex(place);
    }
    beam.label = static_cast<long>(mesh_.shells.size() + mesh_.beams.size()) + 1;
    mesh_.beams.push_back(beam);
  }
}

}  // namespace blocklift::structure
