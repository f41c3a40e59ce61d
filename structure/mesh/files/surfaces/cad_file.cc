#include "structure/mesh/files/surfaces/cad_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

/// The name that a designer gave, of a label such as "Shapes/hull/deck"; empty if a translator made
/// it up.
std::string own_name(const std::string& label) {
  const std::string name = label.substr(label.rfind('/') + 1);
  static const std::vector<std::string> made_up{"FACE", "SHELL",  "COMPOUND", "SOLID", "EDGE",
                                                "WIRE", "VERTEX", "Shapes",   "Curve", "Geometric"};
  const bool is_made_up = name.starts_with("Open CASCADE") ||
                          std::find(made_up.begin(), made_up.end(), name) != made_up.end() ||
                          std::all_of(name.begin(), name.end(), [](char c) {
                            return std::isdigit(static_cast<unsigned char>(c)) != 0;
                          });
  return is_made_up ? "" : name;
}

/// The group of a surface or a curve: its label, its colour, or its number.
std::string group_of_entity(const Entity& entity) {
  const auto& [dimension, tag] = entity;
  std::string label;
  gmsh::model::getEntityName(dimension, tag, label);
  std::string name = own_name(label);
  if (!name.empty()) return name;
  int red = 0, green = 0, blue = 0, alpha = 0;
  gmsh::model::getColor(dimension, tag, red, green, blue, alpha);
  if (alpha > 0) return fmt::format("colour #{:02x}{:02x}{:02x}", red, green, blue);
  return fmt::format("{} {}", dimension == 2 ? "surface" : "curve", tag);
}

/// Curves that bound no surface, by tag, with their groups.
std::map<int, std::string> free_curves() {
  std::map<int, std::string> groups;
  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  for (const Entity& curve : curves) {
    std::vector<int> surfaces, ends;
    gmsh::model::getAdjacencies(1, curve.second, surfaces, ends);
    if (surfaces.empty()) groups[curve.second] = group_of_entity(curve);
  }
  return groups;
}

int take_solids_away(bool allowed) {
  gmsh::vectorpair solids;
  gmsh::model::getEntities(solids, 3);
  if (solids.empty()) return 0;
  if (!allowed)
    throw ModelError(fmt::format(
        "the file has {} solid{}, and a block is lifted as plates: give its mid-surfaces, or "
        "leave_solids_out",
        solids.size(), solids.size() == 1 ? "" : "s"));
  gmsh::model::occ::remove(solids, true);
  gmsh::model::occ::synchronize();
  return static_cast<int>(solids.size());
}

}  // namespace

CadSurfaces open_cad_file(const std::string& path, double length, bool leave_solids_out) {
  CadSurfaces cad;
  const double declared = declared_length(path);
  if (declared > 0 && std::abs(declared - length) > 1e-6 * length)
    throw ModelError(fmt::format(
        "the file says that its lengths are in units of {:.4g} m, and the block that they are in "
        "units of {:.4g} m",
        declared, length));
  // OpenCASCADE turns what a file declares into millimetres; what it does not declare stays.
  cad.length = declared > 0 ? 1e-3 : length;
  gmsh::vectorpair shapes;
  try {
    gmsh::model::occ::importShapes(path, shapes, false);
    gmsh::model::occ::synchronize();
  } catch (const std::string& error) {
    throw ModelError("OpenCASCADE cannot read the file; is it damaged? " + error);
  }
  cad.solids_left_out = take_solids_away(leave_solids_out);
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const Entity& surface : surfaces) cad.groups[surface.second] = group_of_entity(surface);
  cad.curves = free_curves();
  if (surfaces.empty() && cad.curves.empty())
    throw ModelError("there are neither surfaces nor curves in the file, or it is damaged");
  return cad;
}

}  // namespace blocklift::structure
