#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/material.h"

namespace blocklift::structure {

using Vector3 = Eigen::Vector3d;

/// Named set of cells. Its Gmsh physical number is its place in HexMesh::groups plus one.
struct CellGroup {
  std::string name;
  int material = 0;  ///< place in HexMesh::materials
};

/// Conforming mesh of hexahedra with eight vertices each.
///
/// Vertices of a cell are in lexicographic order (x fastest, z slowest in the cell's own axes); its
/// Jacobian is positive.
struct HexMesh {
  std::vector<Vector3> vertices;          ///< m
  std::vector<std::array<int, 8>> cells;  ///< places in vertices
  std::vector<int> cell_group;            ///< place in groups, a cell
  std::vector<CellGroup> groups;
  std::vector<Material> materials;
  /// Points of quadratic cells at the 3 x 3 x 3 places (0, 1/2, 1)^3, x fastest, a cell each; empty
  /// if the cells are trilinear between their vertices.
  std::vector<std::array<Vector3, 27>> curved_cells;

  const Material& material_of_cell(int cell) const {
    const auto group = static_cast<std::size_t>(cell_group[static_cast<std::size_t>(cell)]);
    return materials[static_cast<std::size_t>(groups[group].material)];
  }
};

/// Lug of a block mesh.
struct LugRegion {
  std::string name;
  Vector3 p_BPin = Vector3::Zero();  ///< m
  int group = 0;                     ///< cells that carry the rope's force
  int pad_group = 0;                 ///< cells of its pad
  double pad_radius = 0;             ///< of the sphere about the pin that holds pad and lug, m
};

/// Mesh of a stiffened block: what each cell is in terms of plates.
struct BlockMesh : HexMesh {
  /// Axis (0, 1, 2) normal to the plate of a cell; -1 in the column where plates cross.
  std::vector<int> cell_normal;
  /// Number of the single plate (one position) that a cell belongs to; cells of a sheet that lie
  /// over one another make up its thickness.
  std::vector<int> cell_sheet;
  std::vector<std::string> sheet_names;  ///< such as "web_frames at x = 4 m"
  std::vector<double> sheet_thickness;   ///< as described (elements taper where plates meet), m
  std::vector<LugRegion> lugs;
};

/// Vertices of the six faces of a cell, in the order x-, x+, y-, y+, z-, z+, each running round the
/// face so that its normal points outwards.
extern const std::array<std::array<int, 4>, 6> cell_faces;

/// Faces that belong to one cell only, as (cell, face) pairs in order of the cells.
/// @throws ModelError if more than two cells share a face (the mesh is not conforming).
std::vector<std::array<int, 2>> boundary_faces(const HexMesh& mesh);

/// Number of the connected part (through shared faces) that each cell belongs to, from 0.
std::vector<int> connected_parts(const HexMesh& mesh);

/// Place of a unit point xi (in [0, 1]^3) of a cell, m.
Vector3 position(const HexMesh& mesh, int cell, const Vector3& xi);

/// Jacobian dx/dxi of a cell at a unit point, m.
Eigen::Matrix3d jacobian(const HexMesh& mesh, int cell, const Vector3& xi);

/// Sum of the cells' volumes by 3 x 3 x 3 Gauss points (exact for trilinear cells), m^3.
double volume(const HexMesh& mesh);

}  // namespace blocklift::structure
