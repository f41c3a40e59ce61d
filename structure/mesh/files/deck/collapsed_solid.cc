#include "structure/mesh/files/deck/collapsed_solid.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "structure/index.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Vertices around a face, seen from outside.
using FaceAround = std::vector<int>;
using DirectedEdge = std::pair<int, int>;

/// The faces that are left of a solid's.
std::vector<FaceAround> faces_left(const Solid& solid) {
  std::vector<FaceAround> faces;
  for (const std::vector<int>& face : topology_of(solid.shape).faces) {
    FaceAround around;
    for (const int corner : face)
      if (around.empty() || around.back() != solid.vertices[corner])
        around.push_back(solid.vertices[corner]);
    while (around.size() > 1 && around.front() == around.back()) around.pop_back();
    if (around.size() > 2) faces.push_back(std::move(around));
  }
  return faces;
}

/// Does each edge belong to two faces, once in either direction, and no face meet itself?
bool are_closed(const std::vector<FaceAround>& faces) {
  std::set<DirectedEdge> edges;
  for (const FaceAround& face : faces) {
    if (std::set<int>(face.begin(), face.end()).size() != face.size()) return false;
    for (std::size_t i = 0; i < face.size(); ++i)
      if (!edges.insert({face[i], face[(i + 1) % face.size()]}).second) return false;
  }
  return std::all_of(edges.begin(), edges.end(), [&](const DirectedEdge& edge) {
    return edges.count({edge.second, edge.first}) > 0;
  });
}

/// The vertex that an edge leads to from one of a face's, off the face.
int beyond(const std::vector<FaceAround>& faces, const FaceAround& face, int vertex) {
  for (const FaceAround& other : faces)
    for (std::size_t i = 0; i < other.size(); ++i) {
      const int to = other[(i + 1) % other.size()];
      if (other[i] == vertex && std::find(face.begin(), face.end(), to) == face.end()) return to;
    }
  return -1;
}

/// Corners of a shape whose first face is a given one; the rest lies beyond its vertices.
std::vector<int> corners_on(SolidShape shape, const std::vector<FaceAround>& faces,
                            const FaceAround& base) {
  const SolidTopology& topology = topology_of(shape);
  std::vector<int> corners(at(topology.corners), -1);
  for (std::size_t i = 0; i < base.size(); ++i) corners[at(topology.faces[0][i])] = base[i];
  for (const auto& [a, b] : topology.edges)
    if (corners[at(a)] >= 0 && corners[at(b)] < 0)
      corners[at(b)] = beyond(faces, base, corners[at(a)]);
    else if (corners[at(b)] >= 0 && corners[at(a)] < 0)
      corners[at(a)] = beyond(faces, base, corners[at(b)]);
  return corners;
}

/// Gives a shape the middles that edges of the given one have; are they one for each edge?
bool take_middles(const Solid& given, Solid& solid) {
  const SolidTopology &from = topology_of(given.shape), &to = topology_of(solid.shape);
  std::map<DirectedEdge, int> middles;
  for (std::size_t e = 0; e < from.edges.size(); ++e) {
    const std::size_t node = at(from.corners) + e;
    if (node >= given.vertices.size() || given.vertices[node] < 0) continue;
    const int a = given.vertices[at(from.edges[e][0])], b = given.vertices[at(from.edges[e][1])];
    if (a == b) continue;
    const auto [known, is_new] = middles.try_emplace(std::minmax(a, b), given.vertices[node]);
    if (!is_new && known->second != given.vertices[node]) return false;
  }
  if (middles.empty()) return true;
  solid.vertices.resize(at(to.nodes()), -1);
  for (std::size_t e = 0; e < to.edges.size(); ++e) {
    const int a = solid.vertices[at(to.edges[e][0])], b = solid.vertices[at(to.edges[e][1])];
    const auto found = middles.find(std::minmax(a, b));
    if (found != middles.end()) solid.vertices[at(to.corners) + e] = found->second;
  }
  return true;
}

}  // namespace

bool has_repeated_corners(const Solid& solid) {
  const auto end = solid.vertices.begin() + topology_of(solid.shape).corners;
  const std::set<int> distinct(solid.vertices.begin(), end);
  return static_cast<int>(distinct.size()) < topology_of(solid.shape).corners;
}

std::optional<Solid> without_repeated_corners(const Solid& solid) {
  const std::vector<FaceAround> faces = faces_left(solid);
  const auto quadrangles = std::count_if(faces.begin(), faces.end(),
                                         [](const FaceAround& face) { return face.size() == 4; });
  const auto triangles = static_cast<long>(faces.size()) - quadrangles;
  if (!are_closed(faces)) return std::nullopt;
  Solid left = solid;
  if (quadrangles == 0 && triangles == 4)
    left.shape = SolidShape::tetrahedron;
  else if (quadrangles == 1 && triangles == 4)
    left.shape = SolidShape::pyramid;
  else if (quadrangles == 3 && triangles == 2)
    left.shape = SolidShape::wedge;
  else
    return std::nullopt;
  const std::size_t of_base = left.shape == SolidShape::pyramid ? 4 : 3;
  const auto base = std::find_if(faces.begin(), faces.end(),
                                 [&](const FaceAround& face) { return face.size() == of_base; });
  left.vertices = corners_on(left.shape, faces, *base);
  if (std::find(left.vertices.begin(), left.vertices.end(), -1) != left.vertices.end() ||
      has_repeated_corners(left) || !take_middles(solid, left))
    return std::nullopt;
  return left;
}

}  // namespace blocklift::structure
