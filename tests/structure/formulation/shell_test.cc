#include "structure/formulation/shell.h"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "tests/structure/formulation/rigid_motions.h"

namespace blocklift::structure {
namespace {

using std::numbers::pi;

// A doubly curved, skewed piece of shell.
Vector3 warped(double x, double y) {
  return {x + 0.2 * y * x, y - 0.1 * x * x, 0.3 * x * x - 0.2 * x * y + 0.1 * y * y * y};
}

Eigen::MatrixXd rigid_motions(const Space& space, int cell) {
  return test::rigid_motions(
      space, {space.shell_nodes(cell), static_cast<std::size_t>(space.nodes_per_shell())});
}

Mesh warped_mesh(int degree, double offset, bool triangles) {
  Mesh mesh = examples::sheet_mesh(warped, 2, 2, 0.05, examples::plain_steel(), degree);
  mesh.shell_sections[0].offset = offset;
  if (triangles) {
    for (Shell& shell : mesh.shells) shell.curvature = -1;
    examples::divide_into_triangles(mesh, true);
  }
  return mesh;
}

TEST(Shell, RigidMotionsStrainNothingAndNothingElseIsFree) {
  for (int degree = 1; degree <= 4; ++degree)
    for (const bool triangles : {false, true})
      for (const double offset : {0.0, 0.2}) {
        const Mesh mesh = warped_mesh(degree, offset, triangles);
        const Space space(mesh, {degree, {}});
        ShellStiffness stiffness(space);
        for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell) {
          const Eigen::MatrixXd k = stiffness(cell);
          EXPECT_LT((k * rigid_motions(space, cell)).cwiseAbs().maxCoeff(),
                    1e-10 * k.cwiseAbs().maxCoeff())
              << "degree " << degree;
          if (triangles) continue;  // the nodes of the edge that is a point are one later
          const Eigen::VectorXd values =
              Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly)
                  .eigenvalues();
          EXPECT_LT(values[5], 1e-10 * values.maxCoeff()) << "degree " << degree;
          EXPECT_GT(values[6], 1e-7 * values.maxCoeff()) << "degree " << degree;
        }
      }
}

// An offset mid-surface is the same plate elsewhere: a mesh through the mid-surface itself is its
// measure. Flat plates only: on curved ones the two mid-surfaces have different areas.
TEST(Shell, OffsetPlateIsThePlateThroughItsMidSurface) {
  const double offset = 0.3;
  const auto flat = [](double z) {
    return [z](double x, double y) { return Vector3(2 * x + 0.2 * x * y, y, z); };
  };
  for (int degree = 1; degree <= 4; ++degree) {
    Mesh moved = examples::sheet_mesh(flat(-offset), 2, 2, 0.05, examples::plain_steel());
    moved.shell_sections[0].offset = offset;
    const Mesh plain = examples::sheet_mesh(flat(0), 2, 2, 0.05, examples::plain_steel());
    const Space moved_space(moved, {degree, {}}), plain_space(plain, {degree, {}});
    ShellStiffness moved_stiffness(moved_space), plain_stiffness(plain_space);
    const Eigen::MatrixXd k = moved_stiffness(0), expected = plain_stiffness(0);
    // u = u_0 + theta x d takes the motion of the nodes to that of the mid-surface. Drilling is
    // measured where the nodes are, and a plate's bending makes no drilling.
    Eigen::MatrixXd taken = Eigen::MatrixXd::Identity(k.rows(), k.cols());
    for (Eigen::Index i = 0; i < k.rows(); i += 6) {
      taken(i, i + 4) = offset;
      taken(i + 1, i + 3) = -offset;
    }
    Eigen::MatrixXd difference = taken.transpose() * expected * taken - k;
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-10 * k.cwiseAbs().maxCoeff())
        << "degree " << degree;
  }
}

struct Errors {
  double displacement, stress;
};

using StressField = std::function<Eigen::Matrix3d(const Vector3&)>;

// L2 norms of the errors over those of the exact fields, at the height z.
Errors errors_of(const Space& space, const Eigen::VectorXd& motion,
                 const examples::ForceField& displacement, const StressField& stress, double z) {
  Eigen::Vector4d sums = Eigen::Vector4d::Zero();
  const Eigen::Matrix3Xd rule = square_rule(space.degree() + 2);
  ShellOperator strains(space, rule.topRows<2>());
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell) {
    strains.reinit(cell);
    for (Eigen::Index q = 0; q < rule.cols(); ++q) {
      const ShellPoint& point = strains.points()[q];
      const Eigen::VectorXd values = space.shell_values(rule.col(q).head<2>());
      Vector3 u = Vector3::Zero();
      for (int i = 0; i < space.nodes_per_shell(); ++i)
        u += values[i] * motion.segment<3>(6 * space.shell_nodes(cell)[i]);
      const double area = rule(2, q) * point.area;
      const Vector3 exact = displacement(point.place);
      sums[0] += area * (u - exact).squaredNorm();
      sums[1] += area * exact.squaredNorm();
      const Eigen::Matrix3d s = stress(point.place);
      sums[2] +=
          area *
          (examples::shell_stress(space, cell, rule.col(q).head<2>(), z, motion) - s).squaredNorm();
      sums[3] += area * s.squaredNorm();
    }
  }
  return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3])};
}

// The unit square with smoothly uneven cells, its rim and corners in place.
examples::Chart uneven() {
  return [](double x, double y) {
    const double push = 0.08 * std::sin(2 * pi * x) * std::sin(pi * y);
    return Vector3(x + push, y + 0.7 * push, 0);
  };
}

// Simply supported (hard) plate under q sin(pi x) sin(pi y), Reissner and Mindlin: with k^2 = 2
// pi^2, w = q / (D k^4) (1 + D k^2 / S) sin sin, rotations beta = q / (D k^4) grad(sin sin).
Errors plate_errors(int degree, int cells) {
  const Material material = examples::plain_steel();
  const double t = 0.05, nu = material.poisson_ratio, e = material.youngs_modulus;
  const double d = e * t * t * t / (12 * (1 - nu * nu)), s = 5.0 / 6 * material.shear_modulus() * t;
  const double k2 = 2 * pi * pi, bent = 1 / (d * k2 * k2), whole = bent * (1 + d * k2 / s);
  const Mesh mesh = examples::sheet_mesh(uneven(), cells, cells, t, material);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  const auto on = [](double v) { return v < 1e-9 || v > 1 - 1e-9; };
  examples::hold(
      space, [&](const Vector3& x) { return on(x.x()); }, {0, 1, 2, 3, 5}, fixed);
  examples::hold(
      space, [&](const Vector3& x) { return on(x.y()); }, {0, 1, 2, 4, 5}, fixed);
  const auto wave = [](const Vector3& x) { return std::sin(pi * x.x()) * std::sin(pi * x.y()); };
  const Eigen::VectorXd motion =
      examples::solve(space,
                      examples::area_load(space,
                                          [&](const Vector3& x) -> Vector3 {
                                            return {0, 0, wave(x)};
                                          }),
                      fixed);
  return errors_of(
      space, motion,
      [&](const Vector3& x) -> Vector3 {
        return {0, 0, whole * wave(x)};
      },
      [&](const Vector3& x) {
        const double plain = e / (1 - nu * nu) * t / 2 * bent * pi * pi * wave(x);
        Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
        stress(0, 0) = stress(1, 1) = (1 + nu) * plain;
        stress(0, 1) = stress(1, 0) = -material.shear_modulus() * t * bent * pi * pi *
                                      std::cos(pi * x.x()) * std::cos(pi * x.y());
        return stress;
      },
      t / 2);
}

// u_x = sin(pi x) sin(pi y) in plane stress, with the body force that it takes.
Errors membrane_errors(int degree, int cells) {
  const Material material{"unit", 1, 0.3, 0, 1};
  const double nu = 0.3, c = 1 / (1 - nu * nu), g = material.shear_modulus(), t = 0.1;
  const Mesh mesh = examples::sheet_mesh(uneven(), cells, cells, t, material);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  const auto on = [](double v) { return v < 1e-9 || v > 1 - 1e-9; };
  examples::hold(
      space, [&](const Vector3& x) { return on(x.x()) || on(x.y()); }, {0, 1, 2, 3, 4}, fixed);
  examples::hold(
      space, [](const Vector3&) { return true; }, {2, 3, 4}, fixed);
  const auto load = [&](const Vector3& x) -> Vector3 {
    const double a = pi * x.x(), b = pi * x.y();
    return t * pi * pi *
           Vector3((c + g) * std::sin(a) * std::sin(b), -(c * nu + g) * std::cos(a) * std::cos(b),
                   0);
  };
  const Eigen::VectorXd motion = examples::solve(space, examples::area_load(space, load), fixed);
  return errors_of(
      space, motion,
      [](const Vector3& x) -> Vector3 {
        return {std::sin(pi * x.x()) * std::sin(pi * x.y()), 0, 0};
      },
      [&](const Vector3& x) {
        const double a = pi * x.x(), b = pi * x.y();
        Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
        stress(0, 0) = c * pi * std::cos(a) * std::sin(b);
        stress(1, 1) = nu * stress(0, 0);
        stress(0, 1) = stress(1, 0) = g * pi * std::sin(a) * std::cos(b);
        return stress;
      },
      0);
}

// Halving the cells divides the error of the displacement by 2^(p + 1), that of the stress by 2^p.
// Meshes as coarse as these are not in the limit yet: a quarter of an order is left for that.
void expect_orders(Errors (*errors)(int, int)) {
  for (const auto& [degree, cells] : {std::pair{1, 16}, {2, 8}, {3, 8}, {4, 8}}) {
    const Errors coarse = errors(degree, cells), fine = errors(degree, 2 * cells);
    EXPECT_GT(std::log2(coarse.displacement / fine.displacement), degree + 0.75)
        << "degree " << degree << ": " << coarse.displacement << ", " << fine.displacement;
    EXPECT_GT(std::log2(coarse.stress / fine.stress), degree - 0.25)
        << "degree " << degree << ": " << coarse.stress << ", " << fine.stress;
  }
}

TEST(Shell, OrdersOfConvergenceInBending) { expect_orders(plate_errors); }

TEST(Shell, OrdersOfConvergenceInTheMembrane) { expect_orders(membrane_errors); }

}  // namespace
}  // namespace blocklift::structure
