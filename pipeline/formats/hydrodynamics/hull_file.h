#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>

#include "dynamics/marine/hull/hull.h"

namespace blocklift::pipeline {

/// A hull file cannot be used; what() names the file, what was found and what is due.
class HullFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How a file becomes a hull.
struct HullReading {
  /// Vertices nearer than this to each other are one, over the size of the hull.
  double merge_tolerance = 1e-6;
  /// Close flat openings by lids (dynamics::with_lids): for meshes of the wetted surface alone.
  bool close_openings = false;
  /// Edge length for a geometry that still has to be meshed (`.geo`), m; none: as the file says.
  std::optional<double> panel_size = {};
};

/// Reads a hull, by the ending of the file's name:
///
///   .msh, .stl   surface elements that Gmsh reads: triangles and quadrangles, of any order by
///     their
///                corners; the order of the vertices is kept, so diagnose() tells inverted hulls;
///   .geo         a geometry in Gmsh's language: meshed here, panels turned outwards;
///   .gdf         WAMIT's panels: title; ULEN GRAV; ISX ISY; NPAN; four vertices a panel. Symmetry
///                planes are mirrored. GRAV tells metres (9.8) from feet (32.2).
///
/// Lengths are metres (a .gdf in feet is converted). The hull is not diagnosed here.
/// @throws HullFileError if the file cannot be read or holds no panels, with the line for a .gdf.
dynamics::Hull read_hull(const std::filesystem::path& path, const HullReading& reading = {});

/// WAMIT's format alone. @throws as read_hull.
dynamics::Hull read_gdf(const std::filesystem::path& path, double merge_tolerance = 1e-6);
/// Writes panels of three or four vertices in WAMIT's format (metres, no symmetry, 17 digits).
/// @throws HullFileError if a panel has more vertices or the file cannot be written.
void write_gdf(const dynamics::Hull& hull, const std::filesystem::path& path,
               double gravity = 9.80665);

}  // namespace blocklift::pipeline
