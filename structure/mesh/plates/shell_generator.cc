#include "structure/mesh/plates/shell_generator.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/plates/bars.h"
#include "structure/mesh/plates/cell_maker.h"
#include "structure/mesh/plates/free_plates.h"
#include "structure/mesh/plates/free_sheets.h"
#include "structure/mesh/plates/sheet_grid.h"
#include "structure/mesh/plates/sheets.h"

namespace blocklift::structure {

namespace {

using Place = std::array<int, 3>;
using PanelEdge = std::pair<Place, Place>;

std::array<PanelEdge, 4> edges_of(const SheetPanel& panel) {
  const std::size_t u = at((panel.normal + 1) % 3);
  Place right = panel.lower, left = panel.upper;
  right[u] = panel.upper[u];
  left[u] = panel.lower[u];
  return {{{panel.lower, right}, {left, panel.upper}, {panel.lower, left}, {right, panel.upper}}};
}

/// Groups: plates, pads, lugs, rows of stiffeners, then the free plates, pads, lugs and rows; bars
/// follow. Regions: the grid's sheets, then the free ones; webs and flanges belong to their rows.
void add_groups_and_regions(const BlockDescription& block, const std::vector<Sheet>& sheets,
                            const std::vector<FreeSheet>& free_sheets, Mesh& mesh) {
  mesh.materials = block.materials;
  for (const auto& plate : block.plates) mesh.groups.push_back({plate.name, 0});
  for (const auto& pad : block.pads) mesh.groups.push_back({pad.name, 0});
  for (const auto& lug : block.lugs) mesh.groups.push_back({lug.name, 0});
  for (const auto& row : block.stiffeners)
    mesh.groups.push_back({row.name, 0, row.tripping_brackets});
  for (const Sheet& sheet : sheets) {
    mesh.groups[sheet.group].material = sheet.material;
    mesh.regions.push_back({sheet.name, sheet.group, sheet.rank == SheetRank::lug});
  }
  const auto first_row =
      static_cast<int>(mesh.groups.size()) +
      static_cast<int>(std::count_if(free_sheets.begin(), free_sheets.end(),
                                     [](const FreeSheet& sheet) { return sheet.row < 0; }));
  for (const FreeSheet& sheet : free_sheets) {
    if (sheet.row >= 0) {
      mesh.regions.push_back({sheet.name, first_row + sheet.row, false});
      continue;
    }
    mesh.regions.push_back(
        {sheet.name, static_cast<int>(mesh.groups.size()), sheet.rank == SheetRank::lug});
    mesh.groups.push_back({sheet.name, place_of_material(block, sheet.name, sheet.material)});
  }
  for (const auto& row : block.free_stiffeners)
    mesh.groups.push_back({row.name, 0, row.tripping_brackets});
}

/// Place of a thickness and material among the mesh's sections.
int section_of(double thickness, int material, Mesh& mesh) {
  const auto known = std::find_if(
      mesh.shell_sections.begin(), mesh.shell_sections.end(), [&](const ShellSection& section) {
        return section.thickness == thickness && section.material == material;
      });
  const auto place = static_cast<int>(known - mesh.shell_sections.begin());
  if (known == mesh.shell_sections.end()) mesh.shell_sections.push_back({thickness, material, 0});
  return place;
}

int section_of(const Sheet& sheet, Mesh& mesh) {
  return section_of(sheet.thickness, sheet.material, mesh);
}

struct PatternedSpan {
  StiffenerSpan span;
  Beam pattern;  ///< all but vertices and label
};

/// The beams of the stiffeners, with a region for each row on each sheet.
std::vector<PatternedSpan> beams_of(const BlockDescription& block, const SheetGrid& grid,
                                    Mesh& mesh) {
  std::vector<PatternedSpan> beams;
  const auto first_group =
      static_cast<int>(block.plates.size() + block.pads.size() + block.lugs.size());
  std::map<std::pair<int, int>, int> regions;   // (row, sheet)
  std::map<std::pair<int, int>, int> sections;  // (row, material)
  for (const StiffenerSpan& span : grid.stiffener_spans()) {
    const Stiffeners& row = block.stiffeners[span.row];
    const Sheet& sheet = grid.sheets()[span.sheet];
    const int material =
        row.material.empty() ? sheet.material : place_of_material(block, row.name, row.material);
    const auto [section, is_new_section] =
        sections.try_emplace({span.row, material}, static_cast<int>(mesh.beam_sections.size()));
    if (is_new_section) {
      mesh.beam_sections.push_back(row.section);
      mesh.beam_sections.back().material = material;
    }
    const auto [region, is_new_region] =
        regions.try_emplace({span.row, span.sheet}, static_cast<int>(mesh.regions.size()));
    if (is_new_region) {
      const int group = first_group + span.row;
      mesh.groups[group].material = material;
      mesh.regions.push_back(
          {fmt::format("{} at {} = {:g} m", row.name, "xyz"[sheet.normal], sheet.position), group,
           false});
    }
    Beam beam;
    beam.section = section->second;
    beam.region = region->second;
    beam.axis_2 = span.side * Vector3::Unit(sheet.normal);
    const Vector3 axis_3 = Vector3::Unit(span.along).cross(beam.axis_2);
    const Vector3 offset =
        (span.thickness / 2 + row.centroid[0]) * beam.axis_2 + row.centroid[1] * axis_3;
    beam.offset = {offset, offset};
    beams.push_back({span, beam});
  }
  return beams;
}

/// Numbers of the parts that hang together along edges, a panel each.
std::vector<int> joined_parts(const std::vector<SheetPanel>& panels) {
  std::map<PanelEdge, std::vector<int>> meeting;
  for (std::size_t p = 0; p < panels.size(); ++p)
    for (const PanelEdge& edge : edges_of(panels[p])) meeting[edge].push_back(static_cast<int>(p));
  std::vector<int> part(panels.size(), -1);
  int parts = 0;
  std::vector<int> front;
  for (std::size_t start = 0; start < panels.size(); ++start) {
    if (part[start] >= 0) continue;
    front.assign(1, static_cast<int>(start));
    part[start] = parts;
    while (!front.empty()) {
      const SheetPanel& panel = panels[front.back()];
      front.pop_back();
      for (const PanelEdge& edge : edges_of(panel))
        for (const int next : meeting[edge])
          if (std::exchange(part[next], parts) < 0) front.push_back(next);
    }
    ++parts;
  }
  return part;
}

double area_of(const SheetGrid& grid, const SheetPanel& panel) {
  double area = 1;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != panel.normal)
      area *= grid.planes(axis)[panel.upper[axis]] - grid.planes(axis)[panel.lower[axis]];
  return area;
}

void check_joined(const SheetGrid& grid, const std::vector<SheetPanel>& panels) {
  const std::vector<int> part = joined_parts(panels);
  const int parts = *std::max_element(part.begin(), part.end()) + 1;
  if (parts == 1) return;
  std::vector<double> area(at(parts), 0);
  std::vector<std::set<std::string>> names(at(parts));
  for (std::size_t p = 0; p < panels.size(); ++p) {
    area[part[p]] += area_of(grid, panels[p]);
    for (const int s : panels[p].sheets) names[part[p]].insert(grid.sheets()[s].name);
  }
  const auto largest = std::max_element(area.begin(), area.end()) - area.begin();
  std::string list;
  int named = 0;
  for (int p = 0; p < parts; ++p) {
    if (p == largest) continue;
    for (const std::string& name : names[p])
      if (named++ < 8) list += (list.empty() ? "" : ", ") + name;
  }
  if (named > 8) list += fmt::format(" and {} more", named - 8);
  throw ModelError("not joined to the rest of the block: " + list +
                   "; extend them until they reach another plate");
}

std::string not_on_pad(const std::string& lug, const std::string& pad) {
  return "lug \"" + lug + "\" does not touch its pad \"" + pad +
         "\"; let its plate end on the pad's edge or lie in it";
}

// A lug stands on its pad when they share a panel, or panels of theirs share an edge.
void check_lug_on_pad(const std::vector<SheetPanel>& panels, const Lug& lug, int lug_sheet,
                      int pad_sheet) {
  const auto has = [](const SheetPanel& panel, int sheet) {
    return std::find(panel.sheets.begin(), panel.sheets.end(), sheet) != panel.sheets.end();
  };
  std::set<PanelEdge> lug_edges;
  for (const SheetPanel& panel : panels) {
    if (!has(panel, lug_sheet)) continue;
    if (has(panel, pad_sheet)) return;
    for (const PanelEdge& edge : edges_of(panel)) lug_edges.insert(edge);
  }
  for (const SheetPanel& panel : panels)
    if (has(panel, pad_sheet))
      for (const PanelEdge& edge : edges_of(panel))
        if (lug_edges.count(edge) != 0) return;
  throw ModelError(not_on_pad(lug.name, lug.pad));
}

void add_lifting_point(const std::string& name, const Vector3& p_BPin, int lug_sheet, int pad_sheet,
                       Mesh& mesh) {
  LiftingPoint point{name, p_BPin, lug_sheet, pad_sheet, 0};
  double size = 0, reach = 1e300;
  for (const Shell& shell : mesh.shells) {
    if (shell.region != lug_sheet && shell.region != pad_sheet) continue;
    const Vector3& first = mesh.vertices[shell.vertices[0]];
    for (const int v : shell.vertices) {
      const double distance = (mesh.vertices[v] - p_BPin).norm();
      point.radius = std::max(point.radius, distance);
      if (shell.region != lug_sheet) continue;
      reach = std::min(reach, distance);
      size = std::max(size, (mesh.vertices[v] - first).norm());
    }
  }
  if (reach > 2 * size + 0.5)
    throw ModelError(
        fmt::format("the pin of lug \"{}\" lies {:g} m away from the lug's plate", name, reach));
  mesh.lifting_points.push_back(point);
}

void add_lifting_points(const BlockDescription& block, const SheetGrid& grid,
                        const std::vector<SheetPanel>& panels, Mesh& mesh) {
  const auto first_lug = static_cast<int>(grid.sheets().size() - block.lugs.size());
  const int first_pad = first_lug - static_cast<int>(block.pads.size());
  for (std::size_t i = 0; i < block.lugs.size(); ++i) {
    const Lug& lug = block.lugs[i];
    const auto pad = std::find_if(block.pads.begin(), block.pads.end(),
                                  [&](const Pad& known) { return known.name == lug.pad; });
    const int lug_sheet = first_lug + static_cast<int>(i);
    const int pad_sheet = first_pad + static_cast<int>(pad - block.pads.begin());
    check_lug_on_pad(panels, lug, lug_sheet, pad_sheet);
    add_lifting_point(lug.name, lug.p_BPin, lug_sheet, pad_sheet, mesh);
  }
}

Vector3 place_in(const SheetGrid& grid, const Place& planes) {
  return {grid.planes(0)[planes[0]], grid.planes(1)[planes[1]], grid.planes(2)[planes[2]]};
}

/// The lugs on free pads, whose regions follow the regions of the grid's sheets.
void add_free_lifting_points(const BlockDescription& block,
                             const std::vector<FreeSheet>& free_sheets, int first_free,
                             Mesh& mesh) {
  const int first_lug = first_free + static_cast<int>(free_sheets.size() - block.free_lugs.size());
  for (std::size_t i = 0; i < block.free_lugs.size(); ++i) {
    const FreeLug& lug = block.free_lugs[i];
    const int lug_region = first_lug + static_cast<int>(i);
    const int pad_region = first_free + free_sheets[lug_region - first_free].base;
    std::set<int> of_lug, shared;
    for (const Shell& shell : mesh.shells)
      if (shell.region == lug_region) of_lug.insert(shell.vertices.begin(), shell.vertices.end());
    for (const Shell& shell : mesh.shells)
      if (shell.region == pad_region)
        for (const int vertex : shell.vertices)
          if (of_lug.count(vertex) != 0) shared.insert(vertex);
    if (shared.size() < 2) throw ModelError(not_on_pad(lug.name, lug.pad));
    add_lifting_point(lug.name, lug.p_BPin, lug_region, pad_region, mesh);
  }
}

/// Rows on free plates, those that are beams with a region and a section of their own.
void add_free_stiffeners(const BlockDescription& block, const std::vector<FreeSheet>& free_sheets,
                         Mesh& mesh, std::vector<BeamLine>& lines) {
  const auto first_group = mesh.groups.size() - block.free_stiffeners.size();
  std::vector<int> sections(block.free_stiffeners.size()), regions(sections.size());
  for (std::size_t i = 0; i < block.free_stiffeners.size(); ++i) {
    const Stiffeners& row = block.free_stiffeners[i];
    const auto plate =
        std::find_if(free_sheets.begin(), free_sheets.end(),
                     [&](const FreeSheet& sheet) { return sheet.name == row.plate; });
    const std::string& material =
        row.material.empty() && plate != free_sheets.end() ? plate->material : row.material;
    const auto group = static_cast<int>(first_group + i);
    mesh.groups[group].material = place_of_material(block, row.name, material);
    if (row.plates) continue;
    sections[i] = static_cast<int>(mesh.beam_sections.size());
    regions[i] = static_cast<int>(mesh.regions.size());
    mesh.beam_sections.push_back(row.section);
    mesh.beam_sections.back().material = mesh.groups[group].material;
    mesh.regions.push_back({row.name, group, false});
  }
  for (BeamLine& line : free_stiffener_lines(block)) {
    const int row = line.pattern.section;
    line.pattern.section = sections[row];
    line.pattern.region = regions[row];
    lines.push_back(line);
  }
}

/// With plates of any orientation or bars: cut and meshed together with the grid's panels.
Mesh generate_with_free_plates(const BlockDescription& block, const SheetGrid& grid,
                               const std::vector<SheetPanel>& panels) {
  Mesh parts;
  const std::vector<FreeSheet> free_sheets = spread_free_sheets(block);
  add_groups_and_regions(block, grid.sheets(), free_sheets, parts);
  std::vector<BeamLine> lines;
  for (const PatternedSpan& beam : beams_of(block, grid, parts))
    lines.push_back(
        {place_in(grid, beam.span.lower), place_in(grid, beam.span.upper), beam.pattern});
  add_free_stiffeners(block, free_sheets, parts, lines);
  for (BeamLine& line : add_bars(block, parts)) lines.push_back(std::move(line));
  Mesh mesh = mesh_with_free_plates(block, grid, panels, free_sheets, lines);
  mesh.materials = std::move(parts.materials);
  mesh.groups = std::move(parts.groups);
  mesh.regions = std::move(parts.regions);
  mesh.beam_sections = std::move(parts.beam_sections);
  const auto sheets = static_cast<int>(grid.sheets().size());
  for (Shell& shell : mesh.shells) {
    if (shell.region < sheets) {
      shell.section = section_of(grid.sheets()[shell.region], mesh);
      continue;
    }
    const FreeSheet& sheet = free_sheets[shell.region - sheets];
    shell.section = section_of(sheet.thickness, mesh.group_of_region(shell.region).material, mesh);
  }
  finish_bars(block, mesh);
  require_one_part(mesh);
  add_lifting_points(block, grid, panels, mesh);
  add_free_lifting_points(block, free_sheets, sheets, mesh);
  return mesh;
}

}  // namespace

Mesh generate_shell_mesh(const BlockDescription& block) {
  const SheetGrid grid(spread_into_sheets(block));
  const std::vector<SheetPanel> panels = grid.panels();
  if (!block.free_plates.empty() || !block.bars.empty())
    return generate_with_free_plates(block, grid, panels);
  check_joined(grid, panels);
  Mesh mesh;
  add_groups_and_regions(block, grid.sheets(), {}, mesh);
  CellMaker maker(grid, panels, block.largest_element, mesh);
  for (const SheetPanel& panel : panels)
    if (panel.frame < 0) maker.add(panel, section_of(grid.sheets()[panel.owner], mesh));
  for (const HoleFrame& frame : grid.frames())
    maker.add(frame, section_of(grid.sheets()[frame.sheet], mesh));
  for (const PatternedSpan& beam : beams_of(block, grid, mesh)) maker.add(beam.span, beam.pattern);
  add_lifting_points(block, grid, panels, mesh);
  return mesh;
}

}  // namespace blocklift::structure
