#include "structure/mesh/files/nastran/solid_faces.h"

#include <algorithm>
#include <vector>

#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Place of a vertex among a face's corners; as many as there are: it is not on it.
std::size_t place_on_face(const Solid& solid, const std::vector<int>& face, int vertex) {
  const auto found = std::find_if(face.begin(), face.end(),
                                  [&](int corner) { return solid.vertices[corner] == vertex; });
  return static_cast<std::size_t>(found - face.begin());
}

bool is_named(const Solid& solid, const std::vector<int>& face, const FaceGrids& grids) {
  const std::size_t corner = place_on_face(solid, face, grids.corner);
  if (corner == face.size()) return false;
  const bool is_triangle = face.size() == 3;
  if (!grids.second) return is_triangle && solid.shape == SolidShape::wedge;
  const std::size_t second = place_on_face(solid, face, *grids.second);
  const bool is_on_face = second < face.size();
  if (solid.shape == SolidShape::tetrahedron) return !is_on_face;
  if (!is_triangle) return is_on_face && second == (corner + 2) % 4;
  // The triangles of a pyramid end with its tip.
  return solid.shape == SolidShape::pyramid && corner < 2 && second < 2 && corner != second;
}

}  // namespace

int face_of(const Solid& solid, const FaceGrids& grids) {
  const auto& faces = topology_of(solid.shape).faces;
  int found = -1;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!is_named(solid, faces[f], grids)) continue;
    if (found >= 0) return -1;
    found = static_cast<int>(f);
  }
  return found;
}

FaceGrids grids_of_face(const Solid& solid, int face) {
  const SolidTopology& topology = topology_of(solid.shape);
  const std::vector<int>& corners = topology.faces[face];
  const auto vertex = [&](std::size_t i) { return solid.vertices[corners[i]]; };
  FaceGrids grids{vertex(0)};
  if (corners.size() == 4)
    grids.second = vertex(2);
  else if (solid.shape == SolidShape::pyramid)
    grids.second = vertex(1);
  else if (solid.shape == SolidShape::tetrahedron)
    for (int i = 0; i < topology.corners; ++i)
      if (std::find(corners.begin(), corners.end(), i) == corners.end())
        grids.second = solid.vertices[i];
  return grids;
}

}  // namespace blocklift::structure
