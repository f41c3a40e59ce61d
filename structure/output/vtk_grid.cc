#include "structure/output/vtk_grid.h"

#include <bit>
#include <fstream>

#include "structure/error.h"
#include "structure/output/vtk_array.h"

namespace blocklift::structure {

namespace {

void write_fields(std::ofstream& file, const std::string& kind,
                  const std::vector<VtkField>& fields) {
  file << "<" << kind << ">\n";
  for (const VtkField& field : fields) write_array(file, "Float32", field.name, 1, field.values);
  file << "</" << kind << ">\n";
}

}  // namespace

void VtkGrid::add_point(const Eigen::Vector3d& point) {
  for (const double coordinate : point) points.push_back(static_cast<float>(coordinate));
}

void VtkGrid::add_cell(VtkCell type, std::int32_t first, int count) {
  for (int i = 0; i < count; ++i) connectivity.push_back(first + i);
  offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
  types.push_back(static_cast<std::uint8_t>(type));
}

std::string vtk_head(const std::string& type) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" +
         (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian") +
         "\" header_type=\"UInt64\">\n";
}

void write_vtk_grid(const std::filesystem::path& path, const VtkGrid& grid) {
  std::ofstream file(path, std::ios::binary);
  file << vtk_head("UnstructuredGrid") << "<UnstructuredGrid>\n<FieldData>\n";
  for (const VtkGrid::Texts& texts : grid.texts) write_names(file, texts.name, texts.values);
  file << "</FieldData>\n<Piece NumberOfPoints=\"" << grid.point_count() << "\" NumberOfCells=\""
       << grid.types.size() << "\">\n<Points>\n";
  write_array(file, "Float32", "points", 3, grid.points);
  file << "</Points>\n<Cells>\n";
  write_array(file, "Int32", "connectivity", 1, grid.connectivity);
  write_array(file, "Int32", "offsets", 1, grid.offsets);
  write_array(file, "UInt8", "types", 1, grid.types);
  file << "</Cells>\n";
  write_fields(file, "PointData", grid.point_data);
  write_fields(file, "CellData", grid.cell_data);
  file << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  file.close();
  if (!file) throw ModelError("cannot write \"" + path.string() + "\"");
}

}  // namespace blocklift::structure
