#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

namespace blocklift::structure {

/// Cell types of VTK.
enum class VtkCell : std::uint8_t {
  line = 3,
  polyline = 4,
  triangle = 5,
  quadrangle = 9,
  tetrahedron = 10,
  hexahedron = 12,
  wedge = 13,
  pyramid = 14,
  quadratic_tetrahedron = 24,
  quadratic_hexahedron = 25,
  quadratic_wedge = 26
};

/// Numbers at all points, or of all cells, of a grid.
struct VtkField {
  std::string name;
  std::variant<std::vector<float>, std::vector<std::int32_t>, std::vector<std::int64_t>> values;
  int components = 1;
};

/// Points and cells of any kinds with their numbers: what a `.vtu` file of ParaView holds.
struct VtkGrid {
  /// A name of field data with its texts.
  struct Texts {
    std::string name;
    std::vector<std::string> values;
  };

  std::vector<float> points;  ///< x y z of each, m
  std::vector<std::int32_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  std::vector<VtkField> point_data, cell_data;
  std::string scalars, vectors;  ///< the fields at points that are shown first; empty: any
  std::vector<Texts> texts;

  std::int32_t point_count() const { return static_cast<std::int32_t>(points.size() / 3); }
  void add_point(const Eigen::Vector3d& point);
  /// A cell of the points first, first + 1, ...
  void add_cell(VtkCell type, std::int32_t first, int count);
  /// A cell of the points that stand in `connectivity` since the last one.
  void end_cell(VtkCell type);
};

/// Writes a grid as `.vtu`. @throws ModelError if the file cannot be written.
void write_vtk_grid(const std::filesystem::path& path, const VtkGrid& grid);

/// Head of an XML file of VTK of a type ("UnstructuredGrid"), for the byte order of this machine.
std::string vtk_head(const std::string& type);

}  // namespace blocklift::structure
