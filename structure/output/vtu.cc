#include "structure/output/vtu.h"

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/output/vtk_array.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

// Division of a cell into parts[0] x parts[1] x parts[2] boxes.
struct Division {
  std::array<int, 3> parts;
  Eigen::Matrix3Xd points;                  // on the unit cube, x fastest
  std::vector<std::array<int, 8>> corners;  // VTK's order of a hexahedron
};

Division divide(const std::array<int, 3>& parts) {
  Division division{parts, {}, {}};
  const int nx = parts[0] + 1, ny = parts[1] + 1, nz = parts[2] + 1;
  division.points.resize(3, nx * ny * nz);
  const auto point = [&](int i, int j, int k) { return (k * ny + j) * nx + i; };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        division.points.col(point(i, j, k)) << static_cast<double>(i) / parts[0],
            static_cast<double>(j) / parts[1], static_cast<double>(k) / parts[2];
  for (int k = 0; k < parts[2]; ++k)
    for (int j = 0; j < parts[1]; ++j)
      for (int i = 0; i < parts[0]; ++i)
        division.corners.push_back({point(i, j, k), point(i + 1, j, k), point(i + 1, j + 1, k),
                                    point(i, j + 1, k), point(i, j, k + 1), point(i + 1, j, k + 1),
                                    point(i + 1, j + 1, k + 1), point(i, j + 1, k + 1)});
  return division;
}

// Long edges are divided as often as the degree; the thickness is not.
std::array<int, 3> parts_of(const HexMesh& mesh, int cell, int degree) {
  const Eigen::Matrix3d edges = jacobian(mesh, cell, Vector3::Constant(0.5));
  const Eigen::RowVector3d length = edges.colwise().norm();
  std::array<int, 3> parts{};
  for (int a = 0; a < 3; ++a) parts[at(a)] = length[a] > 3 * length.minCoeff() ? degree : 1;
  if (length.maxCoeff() <= 3 * length.minCoeff()) parts.fill(length.maxCoeff() > 0.2 ? degree : 1);
  return parts;
}

struct Content {
  std::vector<float> points, displacement, von_mises;
  std::vector<std::int32_t> connectivity, offsets, group, material, plate;
  std::vector<std::uint8_t> types;
};

Content collect(const UnitResponses& responses, const LoadCase& load_case) {
  const ElasticModel& model = responses.model();
  const BlockMesh& mesh = model.mesh();
  const Discretisation& space = model.space();
  const Eigen::VectorXd displacement =
      responses.without_rigid_motion(responses.displacement(load_case));
  struct Sampler {
    Division division;
    CellStress stress;
    Eigen::MatrixXd shapes;
  };
  std::map<std::array<int, 3>, Sampler> samplers;
  Content content;
  for (int cell = 0; cell < space.cell_count(); ++cell) {
    const auto parts = parts_of(mesh, cell, space.element.degree());
    auto found = samplers.find(parts);
    if (found == samplers.end()) {
      const Division division = divide(parts);
      found = samplers
                  .emplace(parts, Sampler{division, CellStress(mesh, space, division.points),
                                          space.element.values(division.points)})
                  .first;
    }
    const Sampler& sampler = found->second;
    const auto first = static_cast<std::int32_t>(content.von_mises.size());
    Eigen::MatrixX3d local(space.nodes_per_cell, 3);
    for (int i = 0; i < space.nodes_per_cell; ++i)
      local.row(i) = displacement.segment<3>(3 * space.node(cell, i)).transpose();
    const Eigen::MatrixX3d moved = sampler.shapes * local;
    const Eigen::VectorXd stress = sampler.stress.von_mises(cell, displacement);
    for (Eigen::Index q = 0; q < stress.size(); ++q) {
      const Vector3 place = position(mesh, cell, sampler.division.points.col(q));
      for (int a = 0; a < 3; ++a) {
        content.points.push_back(static_cast<float>(place[a]));
        content.displacement.push_back(static_cast<float>(moved(q, a)));
      }
      content.von_mises.push_back(static_cast<float>(stress[q]));
    }
    for (const auto& corners : sampler.division.corners) {
      for (const int corner : corners) content.connectivity.push_back(first + corner);
      content.offsets.push_back(static_cast<std::int32_t>(content.connectivity.size()));
      content.types.push_back(12);  // VTK_HEXAHEDRON
      content.group.push_back(mesh.cell_group[at(cell)]);
      content.material.push_back(mesh.groups[at(mesh.cell_group[at(cell)])].material);
      content.plate.push_back(mesh.cell_sheet[at(cell)]);
    }
  }
  return content;
}

}  // namespace

void write_vtu(const std::string& path, const UnitResponses& responses, const LoadCase& load_case) {
  const Content content = collect(responses, load_case);
  const BlockMesh& mesh = responses.model().mesh();
  std::vector<std::string> groups, materials;
  for (const CellGroup& group : mesh.groups) groups.push_back(group.name);
  for (const Material& material : mesh.materials) materials.push_back(material.name);
  std::ofstream file(path, std::ios::binary);
  file
      << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""
      << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
      << "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n";
  write_names(file, "load_case", {load_case.name});
  write_names(file, "group_names", groups);
  write_names(file, "material_names", materials);
  file << "</FieldData>\n<Piece NumberOfPoints=\"" << content.von_mises.size()
       << "\" NumberOfCells=\"" << content.types.size() << "\">\n<Points>\n";
  write_array(file, "Float32", "points", 3, content.points);
  file << "</Points>\n<Cells>\n";
  write_array(file, "Int32", "connectivity", 1, content.connectivity);
  write_array(file, "Int32", "offsets", 1, content.offsets);
  write_array(file, "UInt8", "types", 1, content.types);
  file << "</Cells>\n<PointData Scalars=\"von_mises\" Vectors=\"displacement\">\n";
  write_array(file, "Float32", "displacement", 3, content.displacement);
  write_array(file, "Float32", "von_mises", 1, content.von_mises);
  file << "</PointData>\n<CellData>\n";
  write_array(file, "Int32", "group", 1, content.group);
  write_array(file, "Int32", "material", 1, content.material);
  write_array(file, "Int32", "plate", 1, content.plate);
  file << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  file.close();
  if (!file) throw ModelError("cannot write \"" + path + "\"");
}

}  // namespace blocklift::structure
