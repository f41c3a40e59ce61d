#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "structure/mesh/files/abaqus_file.h"
#include "structure/mesh/part_mesh.h"

namespace blocklift::structure {

/// The outer faces that lie in a box become a group of faces.
struct FaceChoice {
  std::string name;
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  ///< smallest and largest corner, m
};

/// The node nearest to a place becomes a group of one point; an empty one if it is farther away
/// than a hundredth of the part's diagonal.
struct PointChoice {
  std::string name;
  Vector3 at = Vector3::Zero();  ///< m
};

/// Sizes that a geometry's elements shall have, linear in each of some tetrahedra that fill the
/// part.
struct SizeField {
  Eigen::Matrix3Xd places;  ///< four corners a tetrahedron, m
  Eigen::VectorXd sizes;    ///< edges wanted there, m
};

/// How a file becomes a mesh.
struct PartReading {
  /// Of the file's coordinates, m; 0: that which a STEP or IGES file declares, 1 of other files.
  double length_unit = 0;
  /// Polynomial order that the elements are raised to, 1 or 2; elements of a higher order stay.
  int element_order = 2;
  double element_size = 0;  ///< largest edge where the file is a geometry, m; 0: as the file says
  int refinements = 0;      ///< halvings of all elements along their edges
  double memory = 0;        ///< that the stiffness may take at most, bytes; 0: not looked at
  /// Of the processor, that opening the file may take at most, before it is meshed, s.
  double seconds_to_open = 60;
  /// Thicknesses of plates, m, by groups of surfaces: where there are any, the file holds
  /// mid-surfaces, which are thickened (see thicken).
  std::map<std::string, double> plates;
  std::optional<SizeField> sizes;  ///< of a geometry's elements; a file's own mesh stays as it is
  std::vector<FaceChoice> faces;
  std::vector<PointChoice> points;
};

/// Reads whatever Gmsh opens (.msh, .geo, .step, .brep, ...), Abaqus' .inp by read_abaqus, the
/// solids of Nastran's .bdf by read_nastran and .unv by open_universal_file: a mesh as it is, a
/// geometry after meshing it.
///
/// Groups are the physical groups by their names, or "volume group 3" and so on where they have
/// none; besides them each geometric entity is a group of its own: "volume 1", "surface 4", "curve
/// 2", "point 7". All of it is done in a child process: damaged files crash the libraries that read
/// them, or keep them busy for ever.
/// @throws ModelError if the file declares another unit of length than the one that is said, cannot
///   be read or meshed, asks for so many elements that their
///   stiffness would exceed the memory (before they are made), or holds no solid elements, or kinds
///   other than hexahedra, tetrahedra and wedges (pyramids among them), or if the child process
///   dies; the message names the file.
PartMesh read_part_mesh(const std::string& path, const PartReading& reading);

/// The same of a mesh that is made here; coordinates in m, elements as they are. Element::tag is
/// the mesh's own. @throws ModelError as above.
PartMesh make_part_mesh(const AbaqusMesh& mesh);

}  // namespace blocklift::structure
