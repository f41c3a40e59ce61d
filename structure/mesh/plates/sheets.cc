#include "structure/mesh/plates/sheets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/plates/stiffener_sheets.h"

namespace blocklift::structure {

std::string name_of(Axis axis) { return std::string(1, "xyz"[static_cast<int>(axis)]); }

bool overlap(const Interval& a, const Interval& b, double tolerance) {
  return std::min(a.upper, b.upper) - std::max(a.lower, b.lower) > tolerance;
}

bool overlap_in_plane(const Sheet& a, const Sheet& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (axis != a.normal && !overlap(a.extent[axis], b.extent[axis])) return false;
  return true;
}

namespace {

constexpr double most_stiffeners = 1e4;  // of a row on one plate

template <typename Items>
std::string names_of(const Items& items) {
  std::string list;
  for (const auto& item : items) list += (list.empty() ? "" : ", ") + item.name;
  return list.empty() ? "none" : list;
}

void check_names(const BlockDescription& block) {
  std::set<std::string> seen;
  const auto check = [&](const std::string& kind, const auto& items) {
    for (const auto& item : items) {
      if (item.name.empty()) throw ModelError("a " + kind + " has no name");
      if (!seen.insert(item.name).second)
        throw ModelError(kind + " \"" + item.name +
                         "\" bears a name that another part has; give each its own");
    }
  };
  check("plate", block.plates);
  check("plate", block.free_plates);
  check("pad", block.pads);
  check("lug", block.lugs);
  check("pad", block.free_pads);
  check("lug", block.free_lugs);
  check("row of stiffeners", block.stiffeners);
  check("row of stiffeners", block.free_stiffeners);
}

void check_rectangle(const std::string& what, Axis normal, const std::array<Interval, 3>& extent) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == static_cast<int>(normal)) continue;
    const Interval& range = extent[axis];
    if (!(std::isfinite(range.lower) && std::isfinite(range.upper) &&
          range.upper - range.lower > 1e-3))
      throw ModelError(
          fmt::format("{} extends from {:g} m to {:g} m along {}; the end must lie at least 1 mm "
                      "beyond the start",
                      what, range.lower, range.upper, "xyz"[axis]));
  }
}

void check_thickness(const std::string& what, double thickness) {
  if (!(std::isfinite(thickness) && thickness > 0))
    throw ModelError(
        fmt::format("{} has a thickness of {:g} m; it must be positive", what, thickness));
}

Sheet make_sheet(const std::string& name, int group, SheetRank rank, Axis normal, double position,
                 const std::array<Interval, 3>& extent, double thickness) {
  if (!std::isfinite(position)) throw ModelError(name + " has a position that is not a number");
  return {fmt::format("{} at {} = {:g} m", name, name_of(normal), position),
          group,
          rank,
          static_cast<int>(normal),
          position,
          extent,
          thickness,
          0,
          {},
          {},
          {}};
}

bool coplanar(const Sheet& a, const Sheet& b) {
  return a.normal == b.normal && std::abs(a.position - b.position) < 1e-6;
}

void add_plates(const BlockDescription& block, std::vector<Sheet>& sheets) {
  for (std::size_t i = 0; i < block.plates.size(); ++i) {
    const Plate& plate = block.plates[i];
    const std::string what = "plate \"" + plate.name + "\"";
    const int material = place_of_material(block, what, plate.material);
    check_rectangle(what, plate.normal, plate.extent);
    check_thickness(what, plate.thickness);
    if (plate.positions.empty()) throw ModelError(what + " has no position along its normal");
    for (const double position : plate.positions) {
      sheets.push_back(make_sheet(plate.name, static_cast<int>(i), SheetRank::plate, plate.normal,
                                  position, plate.extent, plate.thickness));
      sheets.back().material = material;
    }
  }
  for (std::size_t i = 0; i < sheets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (coplanar(sheets[i], sheets[j]) && overlap_in_plane(sheets[i], sheets[j]) &&
          std::abs(sheets[i].thickness - sheets[j].thickness) > 1e-9)
        throw ModelError(fmt::format(
            "plates {} ({:g} mm) and {} ({:g} mm) overlap in one plane with different thickness; "
            "shorten one of them, or make the thicker part a pad",
            sheets[j].name, sheets[j].thickness * 1e3, sheets[i].name, sheets[i].thickness * 1e3));
}

bool is_selected(const std::vector<double>& positions, const Sheet& sheet) {
  return positions.empty() || std::any_of(positions.begin(), positions.end(), [&](double p) {
           return std::abs(p - sheet.position) < 1e-6;
         });
}

/// Sheets of the plates that something is cut into or stands on, at the positions that it names.
std::vector<Sheet*> sheets_of(const BlockDescription& block, const std::string& what,
                              const std::string& plate, const std::vector<double>& positions,
                              std::vector<Sheet>& sheets) {
  if (std::none_of(block.plates.begin(), block.plates.end(),
                   [&](const Plate& known) { return known.name == plate; }))
    throw ModelError(what + " plate \"" + plate +
                     "\", which the block does not have; its plates are " + names_of(block.plates));
  std::vector<Sheet*> selected;
  for (Sheet& sheet : sheets)
    if (block.plates[sheet.group].name == plate && is_selected(positions, sheet))
      selected.push_back(&sheet);
  return selected;
}

HoleOutline outline_of(const Opening& opening, const std::string& what, int normal) {
  const auto u = static_cast<std::size_t>((normal + 1) % 3);
  const auto v = static_cast<std::size_t>((normal + 2) % 3);
  try {
    if (opening.corners.empty()) {
      check_rectangle(what, static_cast<Axis>(normal), opening.extent);
      const Interval &along_u = opening.extent[u], &along_v = opening.extent[v];
      return HoleOutline::rounded({along_u.lower, along_v.lower}, {along_u.upper, along_v.upper},
                                  opening.corner_radius);
    }
    if (opening.corner_radius != 0) throw ModelError("a polygon's corners are not rounded");
    std::vector<Eigen::Vector2d> corners;
    for (const Vector3& corner : opening.corners) corners.emplace_back(corner[u], corner[v]);
    return HoleOutline::polygon(std::move(corners));
  } catch (const ModelError& error) {
    const std::string said = error.what();
    throw ModelError(said.rfind(what, 0) == 0 ? said : what + ": " + said);
  }
}

void cut_openings(const BlockDescription& block, std::vector<Sheet>& sheets) {
  for (const Opening& opening : block.openings) {
    const std::string what = "opening \"" + opening.name + "\"";
    for (Sheet* sheet :
         sheets_of(block, what + " is cut into", opening.plate, opening.positions, sheets)) {
      if (!opening.corners.empty() || opening.corner_radius != 0) {
        sheet->cutouts.push_back({what, outline_of(opening, what, sheet->normal)});
        continue;
      }
      check_rectangle(what, static_cast<Axis>(sheet->normal), opening.extent);
      sheet->holes.push_back(opening.extent);
    }
  }
}

void add_stiffeners(const BlockDescription& block, std::vector<Sheet>& sheets) {
  for (std::size_t r = 0; r < block.stiffeners.size(); ++r) {
    const Stiffeners& row = block.stiffeners[r];
    const std::string what = "row of stiffeners \"" + row.name + "\"";
    check_stiffeners(row);
    if (!row.material.empty()) place_of_material(block, what, row.material);
    const int along = static_cast<int>(row.along);
    for (Sheet* sheet : sheets_of(block, what + " stands on", row.plate, row.positions, sheets)) {
      if (along == sheet->normal)
        throw ModelError(
            fmt::format("{} runs along the normal of {}; it runs along one of the two "
                        "other axes",
                        what, sheet->name));
      const Interval& across = sheet->extent[3 - along - sheet->normal];
      const double first = row.first.value_or(across.lower);
      // None on the plate's own edges.
      const double start = std::floor((across.lower - first) / row.spacing + 1e-6) + 1;
      const double end = std::ceil((across.upper - first) / row.spacing - 1e-6) - 1;
      if (end - start > most_stiffeners)
        throw ModelError(
            fmt::format("{}: a spacing of {:g} m makes {:.2g} stiffeners on {}, and "
                        "{:.2g} are allowed",
                        what, row.spacing, end - start + 1, sheet->name, most_stiffeners));
      for (double i = start; i <= end; ++i)
        sheet->stiffeners.push_back(
            {static_cast<int>(r), along, first + i * row.spacing, row.side});
    }
  }
}

// A pad thickens what lies in its plane: plates with the name given, or any. Returns their
// material.
int check_pad(const BlockDescription& block, const Pad& pad, const Sheet& sheet,
              const std::vector<Sheet>& plates) {
  if (!pad.plate.empty() &&
      std::none_of(block.plates.begin(), block.plates.end(),
                   [&](const Plate& plate) { return plate.name == pad.plate; }))
    throw ModelError("pad \"" + pad.name + "\" thickens plate \"" + pad.plate +
                     "\", which the block does not have; its plates are " + names_of(block.plates));
  int material = -1;
  for (const Sheet& plate : plates) {
    // The rank first: only a plate's group is a place in block.plates.
    if (plate.rank != SheetRank::plate || !coplanar(plate, sheet) ||
        !overlap_in_plane(plate, sheet))
      continue;
    if (!pad.plate.empty() && block.plates[plate.group].name != pad.plate) continue;
    if (material < 0) material = plate.material;
    if (pad.thickness < plate.thickness - 1e-9)
      throw ModelError(
          fmt::format("pad \"{}\" is {:g} mm thick in total, thinner than {} ({:g} mm)", pad.name,
                      pad.thickness * 1e3, plate.name, plate.thickness * 1e3));
  }
  if (material < 0)
    throw ModelError(fmt::format("pad \"{}\" at {} = {:g} m lies on no plate{}", pad.name,
                                 name_of(pad.normal), pad.position,
                                 pad.plate.empty() ? "" : " named \"" + pad.plate + "\""));
  return material;
}

void add_pads_and_lugs(const BlockDescription& block, std::vector<Sheet>& sheets) {
  const std::size_t first_pad = sheets.size();
  int group = static_cast<int>(block.plates.size());
  for (const Pad& pad : block.pads) {
    const std::string what = "pad \"" + pad.name + "\"";
    check_rectangle(what, pad.normal, pad.extent);
    check_thickness(what, pad.thickness);
    Sheet sheet = make_sheet(pad.name, group++, SheetRank::pad, pad.normal, pad.position,
                             pad.extent, pad.thickness);
    sheet.material = check_pad(block, pad, sheet, sheets);
    if (!pad.material.empty()) sheet.material = place_of_material(block, what, pad.material);
    sheets.push_back(sheet);
  }
  for (const Lug& lug : block.lugs) {
    const std::string what = "lug \"" + lug.name + "\"";
    const auto pad = std::find_if(block.pads.begin(), block.pads.end(),
                                  [&](const Pad& known) { return known.name == lug.pad; });
    if (pad == block.pads.end())
      throw ModelError(what + " stands on pad \"" + lug.pad +
                       "\", which the block does not have; its pads are " + names_of(block.pads));
    check_rectangle(what, lug.normal, lug.extent);
    check_thickness(what, lug.thickness);
    if (!lug.p_BPin.allFinite()) throw ModelError(what + " has a pin centre that is not a number");
    sheets.push_back(make_sheet(lug.name, group++, SheetRank::lug, lug.normal, lug.position,
                                lug.extent, lug.thickness));
    sheets.back().material =
        lug.material.empty()
            ? sheets[first_pad + static_cast<std::size_t>(pad - block.pads.begin())].material
            : place_of_material(block, what, lug.material);
  }
}

}  // namespace

void check_stiffeners(const Stiffeners& row) {
  const std::string what = "row of stiffeners \"" + row.name + "\"";
  if (!(std::isfinite(row.spacing) && row.spacing > 0))
    throw ModelError(
        fmt::format("{} has a spacing of {:g} m; it must be positive", what, row.spacing));
  if (!(std::isfinite(row.section.area) && row.section.area > 0))
    throw ModelError(
        fmt::format("{} has a section of {:g} m^2; it must be positive", what, row.section.area));
  if (row.side != 1 && row.side != -1)
    throw ModelError(
        fmt::format("{} stands on side {} of its plate; +1 and -1 are the sides along its normal",
                    what, row.side));
  if (!row.plates) return;
  const double flange = row.plates->flange_reach[1] - row.plates->flange_reach[0];
  if (flange > row.spacing)
    throw ModelError(
        fmt::format("{} has flanges of {:g} mm at a spacing of {:g} mm: as plates they would "
                    "overlap",
                    what, 1e3 * flange, 1e3 * row.spacing));
}

int place_of_material(const BlockDescription& block, const std::string& what,
                      const std::string& material) {
  for (std::size_t i = 0; i < block.materials.size(); ++i)
    if (block.materials[i].name == material) return static_cast<int>(i);
  throw ModelError(what + " is made of \"" + material +
                   "\", which is not among the materials: " + names_of(block.materials));
}

int owner(const std::vector<Sheet>& sheets, const std::vector<int>& candidates) {
  return *std::max_element(candidates.begin(), candidates.end(), [&](int a, int b) {
    const Sheet &sa = sheets[a], &sb = sheets[b];
    if (sa.rank != sb.rank) return sa.rank < sb.rank;
    if (sa.thickness != sb.thickness) return sa.thickness < sb.thickness;
    return a > b;
  });
}

std::vector<Sheet> spread_into_sheets(const BlockDescription& block) {
  if (block.plates.empty() && block.free_plates.empty())
    throw ModelError("block \"" + block.name + "\" has no plates");
  check_names(block);
  for (const Material& material : block.materials) check_material(material);
  std::vector<Sheet> sheets;
  add_plates(block, sheets);
  cut_openings(block, sheets);
  add_stiffeners(block, sheets);
  make_stiffener_sheets(block, sheets);
  add_pads_and_lugs(block, sheets);
  return sheets;
}

}  // namespace blocklift::structure
