#include "structure/formulation/beam.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <deal.II/base/quadrature_lib.h>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"
#include "structure/mesh/beams/beam_axes.h"
#include "structure/space/joints.h"

namespace blocklift::structure {

namespace {

Eigen::Matrix3d cross_matrix(const Vector3& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// Derivatives of the Lagrange polynomials of a degree on [0, 1] at x.
std::vector<double> lagrange_slopes(int degree, double x) {
  const std::vector<double> places = lagrange_places(degree);
  std::vector<double> slopes(places.size(), 0);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (k == i) continue;
      double product = 1 / (places[i] - places[k]);
      for (std::size_t j = 0; j < places.size(); ++j)
        if (j != i && j != k) product *= (x - places[j]) / (places[i] - places[j]);
      slopes[i] += product;
    }
  return slopes;
}

/// Axes 1, 2, 3 of a beam at a point, in rows: those of the beam, but that axis 1 is the tangent
/// where it runs along a curved edge.
Eigen::Matrix3d axes_along_tangent(const Mesh& mesh, const Beam& beam, const Vector3& tangent) {
  constexpr double straight = 1e-9;
  Eigen::Matrix3d axes = beam_axes(mesh, beam);
  const bool is_straight = tangent.cross(Vector3(axes.row(0))).norm() <= straight * tangent.norm();
  return is_straight ? axes : axes_along(tangent, axes.row(1));
}

/// Stiffness of a beam's cell as if both ends passed everything on.
Eigen::MatrixXd whole_stiffness(const Space& space, int cell) {
  const Eigen::Index size = 6 * (space.beams()[cell].degree + 1);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (const BeamGaussPoint& point : beam_gauss_points(space, cell))
    stiffness += point.weight * point.strain.transpose() * point.law * point.strain;
  return stiffness;
}

/// Of the point at a beam's end that a component's force acts on, from the centroid, m: bending and
/// what goes along the beam act on the centroid, shear and twist on the shear centre.
Vector3 centre_of(const Mesh& mesh, const Beam& beam, std::size_t end, int component) {
  if (component == 0 || component > 3) return Vector3::Zero();
  const Eigen::Vector2d centre = section_at(mesh, beam, static_cast<double>(end)).twist_centre();
  return beam_axes(mesh, beam).bottomRows<2>().transpose() * centre;
}

/// Motions of a cell's ends that its releases leave to themselves, a column each.
Eigen::MatrixXd released_motions(const Space& space, int cell) {
  const BeamCell& located = space.beams()[cell];
  const Beam& beam = space.mesh().beams[located.beam];
  const Eigen::Matrix3d axes = beam_axes(space.mesh(), beam);
  Eigen::MatrixXd directions(6 * (located.degree + 1), 0);
  for (std::size_t end = 0; end < 2; ++end) {
    const bool is_here =
        end == 0 ? located.origin < 1e-9 : located.origin + located.size > 1 - 1e-9;
    if (!is_here) continue;
    const Eigen::Index node = end == 0 ? 0 : 6 * located.degree;
    for (int c = 0; c < 6; ++c) {
      if (!beam.release[end][c]) continue;
      // About an offset end a rotation moves the node, too.
      Eigen::VectorXd direction = Eigen::VectorXd::Zero(directions.rows());
      direction.segment<3>(node + (c < 3 ? 0 : 3)) = axes.row(c % 3).transpose();
      if (c >= 3)
        direction.segment<3>(node) = (beam.offset[end] + centre_of(space.mesh(), beam, end, c))
                                         .cross(axes.row(c % 3).transpose());
      directions.conservativeResize(Eigen::NoChange, directions.cols() + 1);
      directions.rightCols<1>() = direction;
    }
  }
  return directions;
}

/// @throws ModelError if the releases of both ends leave the beam between them a rigid motion of
/// its own.
void require_held(const Mesh& mesh, const Beam& beam) {
  const Eigen::Matrix3d axes = beam_axes(mesh, beam);
  const Vector3 ends[2] = {mesh.vertices[beam.vertices[0]] + beam.offset[0],
                           mesh.vertices[beam.vertices[1]] + beam.offset[1]};
  const Vector3 middle = (ends[0] + ends[1]) / 2;
  const double length = (ends[1] - ends[0]).norm();
  // What held components of the ends do in the six rigid motions, rotations times half the length.
  Eigen::MatrixXd held(0, 6);
  for (std::size_t end = 0; end < 2; ++end)
    for (int c = 0; c < 6; ++c) {
      if (beam.release[end][c]) continue;
      const Vector3 axis = axes.row(c % 3).transpose();
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(6);
      if (c < 3)
        row << axis.transpose(),
            (ends[end] + centre_of(mesh, beam, end, c) - middle).cross(axis).transpose() /
                (length / 2);
      else
        row.tail<3>() = axis.transpose();
      held.conservativeResize(held.rows() + 1, Eigen::NoChange);
      held.bottomRows<1>() = row;
    }
  if (held.rows() < 6 || algebra::numerical_rank(held, 1e-9) < 6)
    throw ModelError(fmt::format("beam {}: its releases leave it loose", beam.label));
}

/// What released ends do of themselves for motions of the nodes: no force acts along their
/// directions D, D' K (u + D a) = 0.
Eigen::MatrixXd motion_with_releases(const Eigen::MatrixXd& stiffness,
                                     const Eigen::MatrixXd& directions, const Mesh& mesh,
                                     const Beam& beam) {
  Eigen::MatrixXd motion = Eigen::MatrixXd::Identity(stiffness.rows(), stiffness.cols());
  if (directions.cols() == 0) return motion;
  require_held(mesh, beam);
  const Eigen::MatrixXd forces = directions.transpose() * stiffness;
  motion -= directions * algebra::solve_positive_definite(forces * directions, forces);
  return motion;
}

}  // namespace

BeamPoint beam_point(const Space& space, int cell, double xi) {
  const BeamCell& located = space.beams()[cell];
  const Beam& beam = space.mesh().beams[located.beam];
  const auto values = lagrange_values(located.degree, xi);
  const auto slopes = lagrange_slopes(located.degree, xi);
  const double share = located.origin + located.size * xi;
  const Vector3 arm = (1 - share) * beam.offset[0] + share * beam.offset[1];
  const Vector3 arm_slope = located.size * (beam.offset[1] - beam.offset[0]);

  BeamPoint point;
  Vector3 tangent = arm_slope;
  point.place = arm;
  for (std::size_t i = 0; i < values.size(); ++i) {
    tangent += slopes[i] * space.nodes().col(located.nodes[i]);
    point.place += values[i] * space.nodes().col(located.nodes[i]);
  }
  const Eigen::Matrix3d axes = axes_along_tangent(space.mesh(), beam, tangent);
  const double stretch = tangent.norm();
  point.weight = stretch;
  point.strain.resize(6, 6 * static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    // u_c = u + theta x arm; d/ds of the product has the arm's change too.
    const Eigen::Matrix3d of_rotation =
        (-slopes[i] * cross_matrix(arm) - values[i] * cross_matrix(arm_slope) +
         values[i] * cross_matrix(tangent)) /
        stretch;
    const auto column = 6 * static_cast<Eigen::Index>(i);
    point.strain.block<3, 3>(0, column) = slopes[i] / stretch * axes;
    point.strain.block<3, 3>(0, column + 3) = axes * of_rotation;
    point.strain.block<3, 3>(3, column).setZero();
    point.strain.block<3, 3>(3, column + 3) = slopes[i] / stretch * axes;
  }
  return point;
}

Eigen::Matrix<double, 6, 6> beam_stiffness_law(const Material& material,
                                               const BeamSection& section) {
  const double e = material.youngs_modulus, g = material.shear_modulus();
  const auto shear_area = [&](double area) { return std::min(area, 1e4 * section.area); };
  Eigen::Matrix<double, 6, 6> law = Eigen::Matrix<double, 6, 6>::Zero();
  law.diagonal() << e * section.area, g * shear_area(section.shear_area_2),
      g * shear_area(section.shear_area_3), g * section.torsion, e * section.second_moment_2,
      e * section.second_moment_3;
  // x_3 curvature_2 - x_2 curvature_3 is the stretch at (x_2, x_3).
  law(4, 5) = law(5, 4) = -e * section.product_23;
  // The strains of shear that forces belong to are those at the shear centre.
  const Eigen::Vector2d centre = section.twist_centre();
  const double q_2 = -centre[1] * law(1, 1), q_3 = centre[0] * law(2, 2);  // for a twist of one
  law(3, 3) += -centre[1] * q_2 + centre[0] * q_3;
  law(1, 3) = law(3, 1) = q_2;
  law(2, 3) = law(3, 2) = q_3;
  return law;
}

std::vector<BeamGaussPoint> beam_gauss_points(const Space& space, int cell) {
  const BeamCell& located = space.beams()[cell];
  const Mesh& mesh = space.mesh();
  const Beam& beam = mesh.beams[located.beam];
  const dealii::QGauss<1> rule(static_cast<unsigned>(located.degree));
  std::vector<BeamGaussPoint> points;
  for (unsigned q = 0; q < rule.size(); ++q) {
    const double xi = rule.point(q)[0];
    const BeamSection section = section_at(mesh, beam, located.origin + located.size * xi);
    BeamPoint at_place = beam_point(space, cell, xi);
    BeamGaussPoint& point = points.emplace_back();
    point.xi = xi;
    point.weight = rule.weight(q) * at_place.weight;
    point.strain = std::move(at_place.strain);
    point.law = beam_stiffness_law(mesh.materials[section.material], section);
    if (!beam.is_rod) continue;
    point.law.diagonal().segment<2>(1).setZero();
    point.law.bottomRightCorner<2, 2>().setZero();
  }
  return points;
}

Eigen::MatrixXd beam_stiffness(const Space& space, int cell) {
  Eigen::MatrixXd whole = whole_stiffness(space, cell);
  const Eigen::MatrixXd directions = released_motions(space, cell);
  if (directions.cols() == 0) return whole;
  const Beam& beam = space.mesh().beams[space.beams()[cell].beam];
  const Eigen::MatrixXd motion = motion_with_releases(whole, directions, space.mesh(), beam);
  return motion.transpose() * whole * motion;
}

Eigen::MatrixXd beam_motion(const Space& space, int cell) {
  const Eigen::MatrixXd directions = released_motions(space, cell);
  if (directions.cols() == 0)
    return Eigen::MatrixXd::Identity(directions.rows(), directions.rows());
  const Beam& beam = space.mesh().beams[space.beams()[cell].beam];
  return motion_with_releases(whole_stiffness(space, cell), directions, space.mesh(), beam);
}

Eigen::MatrixXd beam_release_motion(const Space& space, int cell, const Eigen::MatrixXd& forces) {
  const Eigen::MatrixXd directions = released_motions(space, cell);
  if (directions.cols() == 0) return Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
  require_held(space.mesh(), space.mesh().beams[space.beams()[cell].beam]);
  return directions * algebra::solve_positive_definite(
                          directions.transpose() * whole_stiffness(space, cell) * directions,
                          directions.transpose() * forces);
}

}  // namespace blocklift::structure
