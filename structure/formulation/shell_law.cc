#include "structure/formulation/shell_law.h"

#include <cmath>

#include "structure/space/space.h"

namespace blocklift::structure {

namespace {

/// Of G t, but for facets of curved plating. All of it makes a box with two cells a side 2 % too
/// stiff in torsion, a hundredth 0.1 %.
constexpr double drilling_share = 0.01;

/// How many times the drilling stiffness of other plates facets of curved plating have. All of G t
/// makes a hemisphere of 16 x 16 bilinear facets 3 % too stiff.
double drilling_of_facets(int degree) { return (degree == 1 ? 0.1 : 1) / drilling_share; }

/// The share of its transverse shear stiffness that a cell of degree 1 has (law_of_cell). Where a
/// triangle is divided, the cells away from its point are none.
double shear_of_cell(const Mesh& mesh, const ShellCell& cell, double thickness) {
  constexpr double alpha = 0.2;
  const Shell& shell = mesh.shells[cell.shell];
  if (!shell.is_triangle() || cell.origin.y() + cell.size < 1 - 1e-9) return 1;
  const Vector3& corner = mesh.vertices[shell.vertices[0]];
  const double twice_area = cell.size * cell.size *
                            (mesh.vertices[shell.vertices[1]] - corner)
                                .cross(mesh.vertices[shell.vertices[2]] - corner)
                                .norm();
  const double square = thickness * thickness;
  return square / (square + alpha * twice_area);
}

}  // namespace

Eigen::Matrix<double, shell_strains, shell_strains> shell_stiffness_law(const Material& material,
                                                                        double thickness) {
  const double e = material.youngs_modulus, nu = material.poisson_ratio, t = thickness,
               g = material.shear_modulus();
  Eigen::Matrix3d plane;
  plane << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  plane *= e / (1 - nu * nu);
  Eigen::Matrix<double, shell_strains, shell_strains> law;
  law.setZero();
  law.block<3, 3>(membrane_11, membrane_11) = t * plane;
  law.block<3, 3>(curvature_11, curvature_11) = t * t * t / 12 * plane;
  law(shear_1, shear_1) = law(shear_2, shear_2) = 5.0 / 6 * g * t;
  law(drilling, drilling) = drilling_share * g * t;
  return law;
}

Eigen::Matrix<double, shell_strains, shell_strains> shell_stiffness_law(const Mesh& mesh,
                                                                        const Shell& shell,
                                                                        const Vector3& e_1,
                                                                        const Vector3& e_2,
                                                                        double thickness) {
  const ShellSection& section = mesh.section_of(shell);
  Eigen::Matrix<double, shell_strains, shell_strains> law =
      shell_stiffness_law(mesh.material_of(shell), thickness);
  if (section.laminate < 0) return law;
  const Laminate& laminate = mesh.laminates[section.laminate];
  law.block<3, 3>(membrane_11, membrane_11) = laminate.membrane;
  law.block<3, 3>(membrane_11, curvature_11) = law.block<3, 3>(curvature_11, membrane_11) =
      laminate.coupling;
  law.block<3, 3>(curvature_11, curvature_11) = laminate.bending;
  law.block<2, 2>(shear_1, shear_1) = laminate.shear;
  // Strains along the laminate's axes from those along e_1 and e_2.
  const double angle = std::atan2(shell.laminate_axis.dot(e_2), shell.laminate_axis.dot(e_1));
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix<double, shell_strains, shell_strains> turn;
  turn.setIdentity();
  for (const int first : {static_cast<int>(membrane_11), static_cast<int>(curvature_11)})
    turn.block<3, 3>(first, first) << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s,
        2 * c * s, c * c - s * s;
  turn.block<2, 2>(shear_1, shear_1) << c, s, -s, c;
  return turn.transpose() * law * turn;
}

Eigen::Matrix<double, shell_strains, shell_strains> law_of_cell(const Space& space, int cell,
                                                                const Vector3& e_1,
                                                                const Vector3& e_2,
                                                                double thickness) {
  const ShellCell& place = space.shells()[cell];
  const Mesh& mesh = space.mesh();
  Eigen::Matrix<double, shell_strains, shell_strains> law =
      shell_stiffness_law(mesh, mesh.shells[place.shell], e_1, e_2, thickness);
  if (space.is_facet(place.shell)) law(drilling, drilling) *= drilling_of_facets(space.degree());
  if (space.degree() == 1)
    law.block<2, 2>(shear_1, shear_1) *= shear_of_cell(mesh, place, thickness);
  return law;
}

}  // namespace blocklift::structure
