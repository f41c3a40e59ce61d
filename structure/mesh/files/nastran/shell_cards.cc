#include "structure/mesh/files/nastran/shell_cards.h"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "structure/mesh/files/deck/shell_geometry.h"

namespace blocklift::structure {

double laminate_angle(const Mesh& mesh, const Shell& shell) {
  const Vector3 normal = unit_normal(mesh, shell);
  const Vector3 side = mesh.vertices[shell.vertices[1]] - mesh.vertices[shell.vertices[0]];
  const Vector3 axis = shell.laminate_axis - shell.laminate_axis.dot(normal) * normal;
  return std::atan2(normal.dot(side.cross(axis)), side.dot(axis)) * 180 / std::numbers::pi;
}

std::vector<double> corner_thicknesses(const Mesh& mesh, const Shell& shell) {
  if (shell.taper < 0) return {};
  const std::array<double, 4>& corners = mesh.shell_tapers[shell.taper];
  std::vector<double> around{corners[0], corners[1], corners[3]};
  if (!shell.is_triangle()) around.push_back(corners[2]);
  return around;
}

}  // namespace blocklift::structure
