#include "structure/mesh/diagnosis/touching_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "structure/index.h"
#include "structure/mesh/fields/shell_tree.h"
#include "structure/mesh/shell_shape.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

constexpr double close_by = 0.05;  // of a plate's size, as Abaqus has it for *TIE

/// Plates, and the outer faces of solids as plates, on the mesh's vertices.
Mesh faces_of(const Mesh& mesh) {
  Mesh faces;
  faces.vertices = mesh.vertices;
  faces.shells = mesh.shells;
  faces.curved_shells = mesh.curved_shells;
  for (const SolidFace& outer : outer_faces(mesh)) {
    const Solid& solid = mesh.solids[outer.solid];
    const auto corner = [&](std::size_t i) { return solid.vertices[at(outer.corners[i])]; };
    Shell face;
    const bool is_triangle = outer.corners.size() == 3;
    face.vertices = {corner(0), corner(1), corner(is_triangle ? 2 : 3), corner(2)};
    face.label = solid.label;
    faces.shells.push_back(face);
  }
  return faces;
}

/// Longest diagonal over sqrt(2): the side of a square.
double size_of_face(const Mesh& mesh, const Shell& shell) {
  const auto corner = [&](std::size_t i) { return mesh.vertices[shell.vertices[i]]; };
  return std::max((corner(3) - corner(0)).norm(), (corner(2) - corner(1)).norm()) / std::sqrt(2.0);
}

double distance_from(const Mesh& mesh, const Shell& shell, const Vector3& place) {
  const int parts = shell.curvature < 0 ? 1 : 8;
  double least = 1e300;
  const auto corner = [&](int i, int j) {
    return position(mesh, shell, Eigen::Vector2d(i, j) / parts);
  };
  for (int j = 0; j < parts; ++j)
    for (int i = 0; i < parts; ++i) {
      const Vector3 a = corner(i, j), b = corner(i + 1, j), c = corner(i, j + 1),
                    d = corner(i + 1, j + 1);
      least = std::min({least, squared_distance(place, a, b - a, c - a),
                        squared_distance(place, d, c - d, b - d)});
    }
  return std::sqrt(least);
}

}  // namespace

std::vector<TouchingParts> find_touching_parts(const Mesh& mesh, const std::vector<int>& part) {
  const Mesh faces = faces_of(mesh);
  std::vector<int> all(faces.shells.size());
  std::iota(all.begin(), all.end(), 0);
  const ShellTree tree(faces, all);
  double largest = 0;
  for (const Shell& shell : faces.shells) largest = std::max(largest, size_of_face(faces, shell));
  std::map<std::pair<int, int>, TouchingParts> pairs;
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    const int own = part[v];
    if (own < 0) continue;
    std::map<int, TouchingParts> near;  // by the other part
    tree.for_each_near(mesh.vertices[v], close_by * largest, [&](int s) {
      const Shell& shell = faces.shells[s];
      const int other = part[shell.vertices[0]];
      if (other < 0 || other == own) return;
      const double gap = distance_from(faces, shell, mesh.vertices[v]);
      if (gap > close_by * size_of_face(faces, shell)) return;
      const auto [known, is_new] = near.try_emplace(other, TouchingParts{v, shell.label, gap, 1});
      if (!is_new && gap < known->second.gap) known->second = {v, shell.label, gap, 1};
    });
    for (const auto& [other, found] : near) {
      const std::pair<int, int> key = std::minmax({own, other});
      const auto [known, is_new] = pairs.try_emplace(key, found);
      if (is_new) continue;
      const int vertices = known->second.vertices + 1;
      if (found.gap < known->second.gap) known->second = found;
      known->second.vertices = vertices;
    }
  }
  std::vector<TouchingParts> touching;
  for (const auto& [key, found] : pairs) touching.push_back(found);
  return touching;
}

}  // namespace blocklift::structure
