#include "structure/mesh/plates/free_plates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmsh.h>

#include "structure/child_process.h"
#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/fields/plane_frame.h"
#include "structure/mesh/files/gmsh_session.h"
#include "structure/mesh/files/surfaces/cell_collector.h"
#include "structure/mesh/files/surfaces/deck_packet.h"
#include "structure/mesh/files/surfaces/fragments.h"
#include "structure/mesh/files/surfaces/surface_mesher.h"
#include "structure/mesh/plates/free_sheets.h"

namespace blocklift::structure {

namespace {

namespace occ = gmsh::model::occ;

constexpr double joint_tolerance = 1e-4;  // m
constexpr double share_at_lugs = 1.0 / 3;
constexpr double seconds_to_mesh = 1800, most_memory = 8e9;  // s, bytes

Vector3 centre_of_arc(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 u = b - a, v = c - a, n = u.cross(v);
  if (n.norm() < 1e-9 * u.norm() * v.norm())
    throw ModelError("the three points of an arc lie on one line");
  return a + (v.squaredNorm() * n.cross(u) + u.squaredNorm() * v.cross(n)) / (2 * n.squaredNorm());
}

/// Draws points, lines and surfaces; those that lie in one place are one.
class Drawing {
 public:
  int point(const Vector3& place) {
    std::array<long, 3> key{};
    for (int i = 0; i < 3; ++i) key[i] = std::lround(place[i] / joint_tolerance);
    const auto [known, is_new] = points_.try_emplace(key, 0);
    if (is_new) known->second = occ::addPoint(place.x(), place.y(), place.z());
    return known->second;
  }

  int line(const Vector3& from, const Vector3& to) {
    const int a = point(from), b = point(to);
    const auto [known, is_new] = lines_.try_emplace(std::minmax({a, b}), 0);
    if (is_new) known->second = occ::addLine(a, b);
    return known->second;
  }

  /// In two halves: each is less than half a turn.
  void arc(const Vector3& from, const Vector3& through, const Vector3& to,
           std::vector<int>& curves) {
    const Vector3 centre = centre_of_arc(from, through, to);
    const int middle = occ::addPoint(centre.x(), centre.y(), centre.z());
    curves.push_back(occ::addCircleArc(point(from), middle, point(through)));
    curves.push_back(occ::addCircleArc(point(through), middle, point(to)));
  }

  std::vector<int> polygon(const std::vector<Vector3>& corners) {
    std::vector<int> curves;
    for (std::size_t i = 0; i < corners.size(); ++i)
      curves.push_back(line(corners[i], corners[(i + 1) % corners.size()]));
    return curves;
  }

  /// @param loops the outer one first.
  static int plane(const std::vector<std::vector<int>>& loops) {
    std::vector<int> tags;
    for (const auto& curves : loops) tags.push_back(occ::addCurveLoop(curves));
    return occ::addPlaneSurface(tags);
  }

  int wire(const PlateEdge& edge) {
    std::vector<int> curves;
    if (edge.is_arc)
      arc(edge.points[0], edge.points[1], edge.points[2], curves);
    else
      for (std::size_t i = 0; i + 1 < edge.points.size(); ++i)
        curves.push_back(line(edge.points[i], edge.points[i + 1]));
    return occ::addWire(curves);
  }

 private:
  std::map<std::array<long, 3>, int> points_;
  std::map<std::pair<int, int>, int> lines_;
};

class BlockDrawing {
 public:
  BlockDrawing(const BlockDescription& block, const SheetGrid& grid,
               const std::vector<SheetPanel>& panels, const std::vector<FreeSheet>& free_sheets,
               const std::vector<BeamLine>& beams)
      : block_(block), grid_(grid), panels_(panels), free_sheets_(free_sheets), beams_(beams) {}

  Mesh mesh() {
    const GmshSession session;
    for (const SheetPanel& panel : panels_)
      if (panel.frame < 0) owners_[{2, draw(panel)}] = panel.owner;
    for (const HoleFrame& frame : grid_.frames()) owners_[{2, draw(frame)}] = frame.sheet;
    for (std::size_t i = 0; i < block_.free_plates.size(); ++i)
      draw(block_.free_plates[i], first_free() + static_cast<int>(i));
    for (std::size_t i = block_.free_plates.size(); i < free_sheets_.size(); ++i)
      owners_[{2, Drawing::plane({drawing_.polygon(free_sheets_[i].corners)})}] =
          first_free() + static_cast<int>(i);
    // Beams have numbers of their own kind.
    for (std::size_t b = 0; b < beams_.size(); ++b) {
      const Entity line{1, drawing_.line(beams_[b].from, beams_[b].to)};
      const auto [drawn, is_new] = owners_.try_emplace(line, static_cast<int>(b));
      if (!is_new) refuse_two({drawn->second, static_cast<int>(b)});
    }
    const EntityRegions regions = cut();
    SurfaceSizes sizes;
    sizes.largest = block_.largest_element;
    sizes.at_places = share_at_lugs * sizes.largest;
    for (const Lug& lug : block_.lugs) sizes.places.push_back(lug.p_BPin);
    for (const FreeLug& lug : block_.free_lugs) sizes.places.push_back(lug.p_BPin);
    mesh_surfaces(sizes, 1);
    Deck deck;
    collect_cells(regions, 1, deck);
    return std::move(deck.mesh);
  }

 private:
  int first_free() const { return static_cast<int>(grid_.sheets().size()); }

  std::string name_of_owner(int owner) const {
    return owner < first_free() ? grid_.sheets()[owner].name
                                : free_sheets_[owner - first_free()].name;
  }

  Vector3 place(const std::array<int, 3>& planes) const {
    return {grid_.planes(0)[planes[0]], grid_.planes(1)[planes[1]], grid_.planes(2)[planes[2]]};
  }

  int draw(const SheetPanel& panel) {
    const std::size_t u = at((panel.normal + 1) % 3);
    auto right = panel.lower, left = panel.upper;
    right[u] = panel.upper[u];
    left[u] = panel.lower[u];
    return Drawing::plane(
        {drawing_.polygon({place(panel.lower), place(right), place(panel.upper), place(left)})});
  }

  int draw(const HoleFrame& frame) {
    const Sheet& sheet = grid_.sheets()[frame.sheet];
    std::vector<Vector3> around;
    for (const auto& planes : grid_.points_around(frame)) around.push_back(place(planes));
    const HoleOutline& outline = frame.cutout.outline;
    const auto on_sheet = [&](int piece, double share) {
      const Eigen::Vector2d point = outline.point(piece, share);
      Vector3 there = Vector3::Zero();
      there[sheet.normal] = sheet.position;
      there[(sheet.normal + 1) % 3] = point[0];
      there[(sheet.normal + 2) % 3] = point[1];
      return there;
    };
    std::vector<int> hole;
    for (int i = 0; i < outline.pieces(); ++i) {
      if (outline.is_straight(i))
        hole.push_back(drawing_.line(on_sheet(i, 0), on_sheet(i, 1)));
      else
        drawing_.arc(on_sheet(i, 0), on_sheet(i, 0.5), on_sheet(i, 1), hole);
    }
    return Drawing::plane({drawing_.polygon(around), hole});
  }

  void draw(const FreePlate& plate, int owner) {
    try {
      if (!plate.corners.empty()) {
        std::vector<std::vector<int>> loops{drawing_.polygon(plate.corners)};
        for (const FreeOpening& opening : block_.free_openings)
          if (opening.plate == plate.name) loops.push_back(draw(opening, plate));
        owners_[{2, Drawing::plane(loops)}] = owner;
        return;
      }
      gmsh::vectorpair made;
      const std::vector<int> wires{drawing_.wire(plate.edges[0]), drawing_.wire(plate.edges[1])};
      occ::addThruSections(wires, made, -1, false, true);
      for (const auto& [dimension, tag] : made)
        if (dimension == 2) owners_[{2, tag}] = owner;
    } catch (const std::string& error) {
      throw ModelError(fmt::format("plate \"{}\" cannot be made: {}", plate.name, error));
    } catch (const ModelError& error) {
      throw ModelError(fmt::format("plate \"{}\": {}", plate.name, error.what()));
    }
  }

  std::vector<int> draw(const FreeOpening& opening, const FreePlate& plate) {
    if (!opening.corners.empty()) return drawing_.polygon(opening.corners);
    const Vector3 normal = normal_of_polygon(plate.corners);
    const Vector3& first = opening.centres.front();
    const Vector3& last = opening.centres.back();
    Vector3 along = last - first;
    if (opening.centres.size() == 1) along = normal.unitOrthogonal();
    along.normalize();
    const Vector3 side = opening.radius * normal.cross(along), end = opening.radius * along;
    std::vector<int> curves;
    drawing_.arc(last - side, last + end, last + side, curves);
    if (opening.centres.size() > 1) curves.push_back(drawing_.line(last + side, first + side));
    drawing_.arc(first + side, first - end, first - side, curves);
    if (opening.centres.size() > 1) curves.push_back(drawing_.line(first - side, last - side));
    return curves;
  }

  EntityRegions cut() {
    EntityRegions regions;
    for (const auto& [piece, owners] : cut_at_joints(owners_, joint_tolerance)) {
      if (piece.first == 1) {
        refuse_two(owners);
        regions.curves[piece.second] = owners.front();
        continue;
      }
      regions.surfaces[piece.second] = owner_of_piece(owners);
    }
    return regions;
  }

  /// Where two bars, or a bar and a stiffener, lie upon one another, one of them would be lost.
  void refuse_two(const std::vector<int>& lines) const {
    std::set<std::string> names;
    for (const int line : lines) names.insert(beams_[line].bar);
    if (lines.size() < 2 || (names.size() == 1 && names.begin()->empty())) return;
    const std::string bar = *names.rbegin(), other = *names.begin();
    throw ModelError(fmt::format("bar \"{}\" lies upon {}", bar,
                                 other.empty()  ? "a stiffener"
                                 : other == bar ? "itself"
                                                : "bar \"" + other + "\""));
  }

  SheetRank rank(int owner) const {
    if (owner >= first_free()) return free_sheets_[owner - first_free()].rank;
    return std::min(grid_.sheets()[owner].rank, SheetRank::plate);
  }

  /// Of a free lug, its pad and its plate, the first that is there; nothing else lies upon another
  /// but stiffeners, which give way to plates.
  int owner_of_piece(const std::vector<int>& owners) const {
    const int top = *std::max_element(owners.begin(), owners.end(),
                                      [&](int a, int b) { return rank(a) < rank(b); });
    std::set<int> below{top};
    for (int next = base_of(top); next >= 0; next = base_of(next)) below.insert(next);
    for (const int owner : owners)
      if (below.count(owner) == 0 && rank(owner) != SheetRank::stiffener)
        throw ModelError(
            fmt::format("plate \"{}\" lies upon {}; where a plate is thicker, divide it",
                        name_of_owner(std::max(owner, top)), name_of_owner(std::min(owner, top))));
    if (rank(top) == SheetRank::pad && owners.size() == 1)
      throw ModelError(fmt::format("pad \"{}\" reaches beyond its plate \"{}\" or over an opening",
                                   name_of_owner(top), name_of_owner(base_of(top))));
    return top;
  }

  /// What a free sheet lies on; -1: nothing.
  int base_of(int owner) const {
    if (owner < first_free()) return -1;
    const int base = free_sheets_[owner - first_free()].base;
    return base < 0 ? -1 : first_free() + base;
  }

  const BlockDescription& block_;
  const SheetGrid& grid_;
  const std::vector<SheetPanel>& panels_;
  const std::vector<FreeSheet>& free_sheets_;
  const std::vector<BeamLine>& beams_;
  Drawing drawing_;
  std::map<Entity, int> owners_;
};

/// Turns a shell over: its normal points the other way.
void turn_over(Shell& shell, Mesh& mesh) {
  std::swap(shell.vertices[0], shell.vertices[1]);
  if (shell.vertices[2] != shell.vertices[3]) std::swap(shell.vertices[2], shell.vertices[3]);
  if (shell.curvature < 0) return;
  Eigen::Matrix3Xd& points = mesh.curved_shells[shell.curvature];
  for (Eigen::Index row = 0; row < 3; ++row) points.col(3 * row).swap(points.col(3 * row + 2));
}

void order_normals(const SheetGrid& grid, Mesh& mesh) {
  const auto sheets = static_cast<int>(grid.sheets().size());
  for (Shell& shell : mesh.shells) {
    if (shell.region >= sheets) continue;
    const auto corner = [&](std::size_t i) { return mesh.vertices[shell.vertices[i]]; };
    const Vector3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    if (normal[grid.sheets()[shell.region].normal] < 0) turn_over(shell, mesh);
  }
}

/// From 1, as of blocks without free plates.
void number(Mesh& mesh) {
  long label = 0;
  for (Shell& shell : mesh.shells) shell.label = ++label;
  for (Beam& beam : mesh.beams) beam.label = ++label;
  mesh.vertex_labels.clear();
}

/// OpenCASCADE crashes where a flange ends on another plate or crosses it within its outline.
std::string what_may_crash(const BlockDescription& block) {
  std::string plates;
  for (const Stiffeners& row : block.free_stiffeners)
    if (row.plates && row.plates->flange_thickness > 0)
      plates += fmt::format("{}\"{}\"", plates.empty() ? "" : ", ", row.plate);
  if (plates.empty()) return plates;
  return fmt::format(
      "; it cannot cut flanges of stiffeners that end on another plate or cross it within its "
      "outline: if those on {} do, make them beams or flat bars",
      plates);
}

}  // namespace

Mesh mesh_with_free_plates(const BlockDescription& block, const SheetGrid& grid,
                           const std::vector<SheetPanel>& panels,
                           const std::vector<FreeSheet>& free_sheets,
                           const std::vector<BeamLine>& beams) {
  try {
    Packet packet = in_child_process(
        [&] {
          Packet result;
          try {
            Deck deck;
            deck.mesh = BlockDrawing(block, grid, panels, free_sheets, beams).mesh();
            put_surfaces(deck, result);
          } catch (const std::string& error) {
            throw ModelError("the block's plates cannot be meshed: " + error);
          }
          return result;
        },
        {seconds_to_mesh, most_memory});
    Mesh mesh = take_surfaces(packet).mesh;
    for (Beam& beam : mesh.beams) {
      std::array<int, 2> vertices = beam.vertices;
      const BeamLine& line = beams[beam.region];
      const auto place = [&](std::size_t end) { return mesh.vertices[vertices[end]]; };
      // Which way a curve runs once it was cut is OpenCASCADE's; the profile's axis 3 follows it.
      if ((place(1) - place(0)).dot(line.to - line.from) < 0) std::swap(vertices[0], vertices[1]);
      beam = line.pattern;
      beam.vertices = vertices;
    }
    order_normals(grid, mesh);
    number(mesh);
    return mesh;
  } catch (const ChildDied& death) {
    throw ModelError(fmt::format("the program that cuts the block's plates at their joints {}{}",
                                 death.what(), what_may_crash(block)));
  }
}

void require_one_part(const Mesh& mesh) {
  const std::vector<int> part = connected_parts(mesh);
  std::map<int, double> areas;
  std::map<int, std::set<std::string>> names;
  for (const Shell& shell : mesh.shells) {
    const int of_shell = part[shell.vertices[0]];
    areas[of_shell] += std::pow(longest_edge(mesh, shell), 2);
    names[of_shell].insert(mesh.regions[shell.region].name);
  }
  for (const Beam& beam : mesh.beams) {
    const int of_beam = part[beam.vertices[0]];
    areas.try_emplace(of_beam, 0);
    names[of_beam].insert(mesh.regions[beam.region].name);
  }
  if (areas.size() < 2) return;
  const auto largest = std::max_element(
      areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::set<std::string> loose;
  for (const auto& [number, of_part] : names)
    if (number != largest->first) loose.insert(of_part.begin(), of_part.end());
  throw ModelError(fmt::format(
      "not joined to the rest of the block: {}; extend them until they reach the middle plane of "
      "another plate",
      fmt::join(loose, ", ")));
}

}  // namespace blocklift::structure
