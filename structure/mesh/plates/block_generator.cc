#include "structure/mesh/plates/block_generator.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/plates/plate_grid.h"
#include "structure/mesh/plates/sheets.h"

namespace blocklift::structure {

namespace {

int material_index(const BlockDescription& block, const std::string& name) {
  for (std::size_t i = 0; i < block.materials.size(); ++i)
    if (block.materials[i].name == name) return static_cast<int>(i);
  throw ModelError("material \"" + name + "\" is not among the block's materials");
}

// Material of the plate under a pad, when the pad does not name its own.
std::string pad_material(const BlockDescription& block, const Pad& pad) {
  if (!pad.material.empty()) return pad.material;
  for (const Plate& plate : block.plates) {
    if (!pad.plate.empty() && plate.name != pad.plate) continue;
    if (plate.normal != pad.normal) continue;
    for (const double position : plate.positions)
      if (std::abs(position - pad.position) < 1e-6) return plate.material;
  }
  return block.plates.front().material;
}

void add_groups(const BlockDescription& block, BlockMesh& mesh) {
  mesh.materials = block.materials;
  for (const Plate& plate : block.plates)
    mesh.groups.push_back({plate.name, material_index(block, plate.material)});
  for (const Pad& pad : block.pads)
    mesh.groups.push_back({pad.name, material_index(block, pad_material(block, pad))});
  for (const Lug& lug : block.lugs) {
    std::string material = lug.material;
    for (const Pad& pad : block.pads)
      if (material.empty() && pad.name == lug.pad) material = pad_material(block, pad);
    mesh.groups.push_back({lug.name, material_index(block, material)});
  }
}

void add_cells(const PlateGrid& grid, const std::vector<GridBox>& boxes, BlockMesh& mesh) {
  std::unordered_map<std::int64_t, int> vertex_number;
  const auto vertex = [&](int i, int j, int k) {
    const std::int64_t key =
        (static_cast<std::int64_t>(k) * (grid.count(1) + 1) + j) * (grid.count(0) + 1) + i;
    const auto [entry, is_new] =
        vertex_number.try_emplace(key, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(grid.vertex(i, j, k));
    return entry->second;
  };
  const std::vector<Sheet>& sheets = grid.sheets();
  for (const GridBox& box : boxes) {
    std::array<int, 8> cell{};
    for (int v = 0; v < 8; ++v)
      cell[at(v)] =
          vertex((v & 1) ? box.upper[0] : box.lower[0], (v & 2) ? box.upper[1] : box.lower[1],
                 (v & 4) ? box.upper[2] : box.lower[2]);
    const auto& here = grid.sheets_in(box.lower[0], box.lower[1], box.lower[2]);
    const int sheet = owner(sheets, here);
    const bool crossing = std::any_of(here.begin(), here.end(), [&](int s) {
      return sheets[at(s)].normal != sheets[at(sheet)].normal;
    });
    mesh.cells.push_back(cell);
    mesh.cell_group.push_back(sheets[at(sheet)].group);
    mesh.cell_sheet.push_back(sheet);
    mesh.cell_normal.push_back(crossing ? -1 : sheets[at(sheet)].normal);
  }
  for (const Sheet& sheet : sheets) {
    mesh.sheet_names.push_back(sheet.name);
    mesh.sheet_thickness.push_back(sheet.thickness);
  }
}

void check_joined(const PlateGrid& grid, const std::vector<GridBox>& boxes, const BlockMesh& mesh) {
  const std::vector<int> part = connected_parts(mesh);
  const int parts = *std::max_element(part.begin(), part.end()) + 1;
  if (parts == 1) return;
  std::vector<int> cells(at(parts), 0);
  std::vector<std::set<std::string>> names(at(parts));
  for (std::size_t cell = 0; cell < part.size(); ++cell) {
    ++cells[at(part[cell])];
    const GridBox& box = boxes[cell];
    for (const int s : grid.sheets_in(box.lower[0], box.lower[1], box.lower[2]))
      names[at(part[cell])].insert(grid.sheets()[at(s)].name);
  }
  const auto largest = std::max_element(cells.begin(), cells.end()) - cells.begin();
  std::string list;
  int named = 0;
  for (int p = 0; p < parts; ++p) {
    if (p == largest) continue;
    for (const std::string& name : names[at(p)])
      if (named++ < 8) list += (list.empty() ? "" : ", ") + name;
  }
  if (named > 8) list += fmt::format(" and {} more", named - 8);
  throw ModelError("not joined to the rest of the block: " + list +
                   "; extend them until they reach another plate");
}

// A lug stands on its pad when they share a box, or boxes of theirs share a face.
void check_lug_on_pad(const PlateGrid& grid, const std::vector<GridBox>& boxes,
                      const BlockMesh& mesh, const Lug& lug, int lug_group, int pad_group) {
  std::set<int> lug_vertices;
  std::vector<std::array<int, 8>> pad_cells;
  for (std::size_t cell = 0; cell < boxes.size(); ++cell) {
    const GridBox& box = boxes[cell];
    bool in_lug = false, in_pad = false;
    for (const int s : grid.sheets_in(box.lower[0], box.lower[1], box.lower[2])) {
      in_lug = in_lug || grid.sheets()[at(s)].group == lug_group;
      in_pad = in_pad || grid.sheets()[at(s)].group == pad_group;
    }
    if (in_lug && in_pad) return;
    if (in_lug) lug_vertices.insert(mesh.cells[cell].begin(), mesh.cells[cell].end());
    if (in_pad) pad_cells.push_back(mesh.cells[cell]);
  }
  for (const auto& cell : pad_cells)
    if (std::count_if(cell.begin(), cell.end(),
                      [&](int v) { return lug_vertices.count(v) != 0; }) >= 4)
      return;
  throw ModelError("lug \"" + lug.name + "\" does not touch its pad \"" + lug.pad +
                   "\"; let its plate end on the pad's edge or lie in it");
}

void add_lugs(const BlockDescription& block, const PlateGrid& grid,
              const std::vector<GridBox>& boxes, BlockMesh& mesh) {
  const int first_pad = static_cast<int>(block.plates.size());
  const int first_lug = first_pad + static_cast<int>(block.pads.size());
  for (std::size_t i = 0; i < block.lugs.size(); ++i) {
    const Lug& lug = block.lugs[i];
    LugRegion region{lug.name, lug.p_BPin, first_lug + static_cast<int>(i), first_pad, 0};
    for (std::size_t p = 0; p < block.pads.size(); ++p)
      if (block.pads[p].name == lug.pad) region.pad_group = first_pad + static_cast<int>(p);
    check_lug_on_pad(grid, boxes, mesh, lug, region.group, region.pad_group);
    double size = 0, reach = 1e300;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
      const int group = mesh.cell_group[cell];
      if (group != region.group && group != region.pad_group) continue;
      for (const int v : mesh.cells[cell]) {
        const double distance = (mesh.vertices[at(v)] - lug.p_BPin).norm();
        region.pad_radius = std::max(region.pad_radius, distance);
        if (group != region.group) continue;
        reach = std::min(reach, distance);
        size =
            std::max(size, (mesh.vertices[at(v)] - mesh.vertices[at(mesh.cells[cell][0])]).norm());
      }
    }
    if (reach > 2 * size + 0.5)
      throw ModelError(fmt::format("the pin of lug \"{}\" lies {:g} m away from the lug's plate",
                                   lug.name, reach));
    mesh.lugs.push_back(region);
  }
}

}  // namespace

BlockMesh generate_block_mesh(const BlockDescription& block) {
  const PlateGrid grid(block, spread_into_sheets(block));
  const std::vector<GridBox> boxes = grid.merged_boxes(block.largest_element);
  BlockMesh mesh;
  add_groups(block, mesh);
  add_cells(grid, boxes, mesh);
  check_joined(grid, boxes, mesh);
  add_lugs(block, grid, boxes, mesh);
  return mesh;
}

}  // namespace blocklift::structure
