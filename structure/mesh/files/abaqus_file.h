#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace blocklift::structure {

/// Solid elements of Abaqus and CalculiX that are known, by their numbers of nodes: C3D4, C3D6,
/// C3D8, C3D10, C3D15, C3D20, also with the endings R, I, H, M, S and T, which name formulations,
/// not shapes.
struct AbaqusElement {
  std::size_t tag = 0;
  std::vector<std::size_t> nodes;  ///< tags, in Abaqus' order
};

/// Face of an element: the element's tag and the face's number from 1 (Abaqus' S1, S2, ...).
struct AbaqusFace {
  std::size_t element = 0;
  int face = 0;
};

/// What a `.inp` file says of its mesh; coordinates in the file's unit.
struct AbaqusMesh {
  std::map<std::size_t, std::array<double, 3>> nodes;  ///< by tag
  std::vector<AbaqusElement> elements;                 ///< solids, in the file's order
  /// Triangles and quadrangles, linear and quadratic: faces of solids, or mid-surfaces of plates.
  std::vector<AbaqusElement> plates = {};
  std::map<std::string, std::vector<std::size_t>> node_sets, element_sets;
  std::map<std::string, std::vector<std::size_t>> plate_sets = {};  ///< of plates
  std::map<std::string, std::vector<AbaqusFace>> surfaces;
};

/// Reads the mesh of an input file of Abaqus or CalculiX: *NODE, *ELEMENT, *NSET and *ELSET (with
/// GENERATE, with names of other sets), *SURFACE of element faces or nodes, *INCLUDE of
/// files in the folder of the first or below it, unless files outside are allowed. Elements CPS, S
/// and STRI are plates, which Gmsh writes beside the solids that they bound; lines (T3D) are passed
/// over, and other keywords with their lines. Names are as they are written first; as in Abaqus,
/// capitals do not matter for finding them again.
/// @throws ModelError with file and line: what is no number, element types that are not known,
///   nodes, elements and sets that do not exist, tags that are used twice, more than one part or an
///   instance that is moved.
AbaqusMesh read_abaqus(const std::string& path);

/// Corner numbers (from 0) of an element's faces in Abaqus' order, by the element's number of
/// nodes.
const std::vector<std::vector<int>>& abaqus_faces(std::size_t nodes);

/// The nodes of a face: its corners in turn, then, of a quadratic element, the middles of the edges
/// between them.
std::vector<std::size_t> face_nodes(const AbaqusElement& element, int face);

/// Number of corners of an element with so many nodes.
int abaqus_corners(std::size_t nodes);

}  // namespace blocklift::structure
