#include "structure/mesh/files/surfaces/surface_mesher.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

constexpr double most_elements = 2e6, elements_a_turn = 24, smallest_share = 0.125;

void require_sizes_that_fit(double size) {
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  double area = 0;
  for (const auto& [dimension, surface] : surfaces) {
    double own = 0;
    gmsh::model::occ::getMass(dimension, surface, own);
    area += own;
  }
  const double count = area / (size * size);
  if (count > most_elements)
    throw ModelError(
        fmt::format("elements of that size would be about {:.2g}, and {:.2g} are the most: is the "
                    "size or the file's unit mistaken?",
                    count, most_elements));
}

/// Sizes about places: constant within two elements, then growing by a fifth of the distance.
void grade(const SurfaceSizes& sizes, double length) {
  if (sizes.places.empty() || !(sizes.at_places < sizes.largest)) return;
  namespace field = gmsh::model::mesh::field;
  std::vector<double> balls;
  for (const Vector3& place : sizes.places) {
    const int ball = field::add("Ball");
    field::setNumber(ball, "XCenter", place.x() / length);
    field::setNumber(ball, "YCenter", place.y() / length);
    field::setNumber(ball, "ZCenter", place.z() / length);
    field::setNumber(ball, "Radius", 4 * sizes.at_places / length);
    field::setNumber(ball, "Thickness", 5 * (sizes.largest - sizes.at_places) / length);
    field::setNumber(ball, "VIn", sizes.at_places / length);
    field::setNumber(ball, "VOut", sizes.largest / length);
    balls.push_back(ball);
  }
  const int least = field::add("Min");
  field::setNumbers(least, "FieldsList", balls);
  field::setAsBackgroundMesh(least);
}

bool is_any_curved() {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  for (const auto& [dimension, tag] : entities) {
    if (dimension != 1 && dimension != 2) continue;
    std::string type;
    gmsh::model::getType(dimension, tag, type);
    if (type != "Line" && type != "Plane") return true;
  }
  return false;
}

}  // namespace

void mesh_surfaces(const SurfaceSizes& sizes, double length) {
  const double largest = sizes.largest / length;
  require_sizes_that_fit(largest);
  gmsh::option::setNumber("Mesh.MeshSizeMax", largest);
  gmsh::option::setNumber(
      "Mesh.MeshSizeMin",
      smallest_share * std::min(largest, sizes.at_places > 0 ? sizes.at_places / length : largest));
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", elements_a_turn);
  // Even where elements are as large as the block: a hole stays one.
  gmsh::option::setNumber("Mesh.MinimumCirclePoints", elements_a_turn);
  gmsh::option::setNumber("Mesh.Algorithm", 6);               // frontal Delaunay
  gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 1);  // blossom
  gmsh::option::setNumber("Mesh.RecombineAll", 1);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
  grade(sizes, length);
  gmsh::model::mesh::generate(2);
  if (is_any_curved()) gmsh::model::mesh::setOrder(2);
}

}  // namespace blocklift::structure
