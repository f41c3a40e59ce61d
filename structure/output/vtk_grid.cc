#include "structure/output/vtk_grid.h"

#include <bit>
#include <cstring>
#include <fstream>

#include "structure/error.h"
#include "structure/output/base64.h"

namespace blocklift::structure {

namespace {

const char* type_of(float) { return "Float32"; }
const char* type_of(std::uint8_t) { return "UInt8"; }
const char* type_of(std::int32_t) { return "Int32"; }
const char* type_of(std::int64_t) { return "Int64"; }

/// Binary within base64.
template <typename Number>
void write_numbers(std::ofstream& file, const std::string& name, int components,
                   const std::vector<Number>& values) {
  const std::uint64_t bytes = values.size() * sizeof(Number);
  std::vector<unsigned char> data(sizeof(bytes) + bytes);
  std::memcpy(data.data(), &bytes, sizeof(bytes));
  if (bytes > 0) std::memcpy(data.data() + sizeof(bytes), values.data(), bytes);
  file << "<DataArray type=\"" << type_of(Number()) << "\" Name=\"" << name
       << "\" NumberOfComponents=\"" << components << "\" format=\"binary\">" << base64(data)
       << "</DataArray>\n";
}

void write_texts(std::ofstream& file, const VtkGrid::Texts& texts) {
  file << "<DataArray type=\"String\" Name=\"" << texts.name << "\" NumberOfTuples=\""
       << texts.values.size() << "\" format=\"ascii\">";
  for (const std::string& value : texts.values) {
    for (const char c : value) file << static_cast<int>(static_cast<unsigned char>(c)) << ' ';
    file << "0 ";
  }
  file << "</DataArray>\n";
}

void write_fields(std::ofstream& file, const std::vector<VtkField>& fields) {
  for (const VtkField& field : fields)
    std::visit(
        [&](const auto& values) { write_numbers(file, field.name, field.components, values); },
        field.values);
}

}  // namespace

void VtkGrid::add_point(const Eigen::Vector3d& point) {
  for (const double coordinate : point) points.push_back(static_cast<float>(coordinate));
}

void VtkGrid::add_cell(VtkCell type, std::int32_t first, int count) {
  for (int i = 0; i < count; ++i) connectivity.push_back(first + i);
  end_cell(type);
}

void VtkGrid::end_cell(VtkCell type) {
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
  for (const VtkGrid::Texts& texts : grid.texts) write_texts(file, texts);
  file << "</FieldData>\n<Piece NumberOfPoints=\"" << grid.point_count() << "\" NumberOfCells=\""
       << grid.types.size() << "\">\n<Points>\n";
  write_numbers(file, "points", 3, grid.points);
  file << "</Points>\n<Cells>\n";
  write_numbers(file, "connectivity", 1, grid.connectivity);
  write_numbers(file, "offsets", 1, grid.offsets);
  write_numbers(file, "types", 1, grid.types);
  file << "</Cells>\n<PointData";
  if (!grid.scalars.empty()) file << " Scalars=\"" << grid.scalars << '"';
  if (!grid.vectors.empty()) file << " Vectors=\"" << grid.vectors << '"';
  file << ">\n";
  write_fields(file, grid.point_data);
  file << "</PointData>\n<CellData>\n";
  write_fields(file, grid.cell_data);
  file << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  file.close();
  if (!file) throw ModelError("cannot write \"" + path.string() + "\"");
}

}  // namespace blocklift::structure
