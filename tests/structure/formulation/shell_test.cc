#include "structure/formulation/shell.h"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/index.h"
#include "structure/system/assembly.h"

namespace blocklift::structure {
namespace {

using std::numbers::pi;

double clamped_plate(int degree, int divisions, double slenderness) {
  const double a = 1, t = a / slenderness;
  Material material = testing::plain_steel();
  const Mesh mesh =
      testing::sheet_mesh([&](double x, double y) { return Vector3(0.5 * a * x, 0.5 * a * y, 0); },
                          divisions, divisions, t, material);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  testing::hold(
      space, [&](const Vector3& p) { return p.x() > 0.5 * a - 1e-9 || p.y() > 0.5 * a - 1e-9; },
      {0, 1, 2, 3, 4, 5}, fixed);
  testing::hold(
      space, [&](const Vector3& p) { return p.x() < 1e-9; }, {0, 4, 5}, fixed);
  testing::hold(
      space, [&](const Vector3& p) { return p.y() < 1e-9; }, {1, 3, 5}, fixed);
  const Eigen::VectorXd u = testing::solve(
      space, testing::area_load(space, [](const Vector3&) { return Vector3(0, 0, 1); }), fixed);
  const double d = material.youngs_modulus * t * t * t / (12 * (1 - 0.09));
  return u[6 * testing::nearest_node(space, Vector3::Zero()) + 2] /
             (0.00126532 * a * a * a * a / d) -
         1;
}

TEST(Shell, ClampedPlate) {
  for (const double slenderness : {100.0, 2000.0, 10000.0})
    for (const auto& [degree, divisions] :
         {std::pair{1, 8}, {1, 16}, {2, 2}, {2, 4}, {2, 8}, {3, 2}, {3, 4}, {4, 1}, {4, 2}})
      fmt::print("a/t {} degree {} half-side {}: {:+.3f} %\n", slenderness, degree, divisions,
                 100 * clamped_plate(degree, divisions, slenderness));
}

double scordelis(int degree, int n) {
  Material material{"concrete", 4.32e8, 0, 0, 1};
  const double r = 25, l = 50, t = 0.25, phi = 40 * pi / 180;
  const Mesh mesh = testing::sheet_mesh(
      [&](double x, double y) {
        return Vector3(r * std::sin(phi * x), 0.5 * l * y, r * std::cos(phi * x));
      },
      n, n, t, material, degree);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  testing::hold(
      space, [&](const Vector3& p) { return p.x() < 1e-9; }, {0, 4, 5}, fixed);
  testing::hold(
      space, [&](const Vector3& p) { return p.y() < 1e-9; }, {1, 3, 5}, fixed);
  testing::hold(
      space, [&](const Vector3& p) { return p.y() > 0.5 * l - 1e-9; }, {0, 2}, fixed);
  const Eigen::VectorXd u = testing::solve(
      space, testing::area_load(space, [](const Vector3&) { return Vector3(0, 0, -90); }), fixed);
  return -u[6 * testing::nearest_node(space, Vector3(r * std::sin(phi), 0, r * std::cos(phi))) + 2];
}

TEST(Shell, ScordelisLoRoof) {
  for (const auto& [degree, n] : {std::pair{1, 4},
                                  {1, 8},
                                  {1, 16},
                                  {2, 2},
                                  {2, 4},
                                  {2, 8},
                                  {3, 2},
                                  {3, 4},
                                  {3, 8},
                                  {4, 2},
                                  {4, 4}})
    fmt::print("degree {} n {}: {:.4f}\n", degree, n, scordelis(degree, n));
}

double pinched(int degree, int n) {
  Material material{"x", 3e6, 0.3, 0, 1};
  const double r = 300, l = 600, t = 3;
  const Mesh mesh = testing::sheet_mesh(
      [&](double x, double y) {
        return Vector3(r * std::sin(pi / 2 * x), 0.5 * l * y, r * std::cos(pi / 2 * x));
      },
      n, n, t, material, degree);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  testing::hold(
      space, [&](const Vector3& p) { return p.x() < 1e-6; }, {0, 4, 5}, fixed);
  testing::hold(
      space, [&](const Vector3& p) { return p.z() < 1e-6; }, {2, 3, 4}, fixed);
  testing::hold(
      space, [&](const Vector3& p) { return p.y() < 1e-6; }, {1, 3, 5}, fixed);
  testing::hold(
      space, [&](const Vector3& p) { return p.y() > 0.5 * l - 1e-6; }, {0, 2}, fixed);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  const int node = testing::nearest_node(space, Vector3(0, 0, r));
  load[6 * node + 2] = -0.25;
  return -testing::solve(space, load, fixed)[6 * node + 2] / 1.8248e-5;
}

TEST(Shell, PinchedCylinder) {
  for (const auto& [degree, n] :
       {std::pair{1, 8}, {1, 16}, {1, 32}, {2, 4}, {2, 8}, {2, 16}, {3, 4}, {3, 8}, {4, 4}})
    fmt::print("degree {} n {}: {:.4f}\n", degree, n, pinched(degree, n));
}

TEST(Shell, RigidMotionsStrainNothing) {
  for (int degree = 1; degree <= 4; ++degree) {
    const Mesh mesh = testing::sheet_mesh(
        [&](double x, double y) {
          return Vector3(x + 0.2 * y * x, y - 0.1 * x * x,
                         0.3 * x * x - 0.2 * x * y + 0.1 * y * y * y);
        },
        2, 2, 0.05, testing::plain_steel(), degree);
    const Space space(mesh, {degree, {}});
    ShellStiffness stiffness(space);
    const Eigen::MatrixXd k = stiffness(0);
    Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(k.rows(), 6);
    for (int i = 0; i < space.nodes_per_shell(); ++i) {
      const Vector3 x = space.nodes().col(space.shell_nodes(0)[i]);
      for (int c = 0; c < 3; ++c) {
        rigid(6 * i + c, c) = 1;
        rigid.block<3, 1>(6 * i, 3 + c) = Vector3::Unit(c).cross(x);
        rigid(6 * i + 3 + c, 3 + c) = 1;
      }
    }
    EXPECT_LT((k * rigid).cwiseAbs().maxCoeff(), 1e-10 * k.cwiseAbs().maxCoeff()) << degree;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(k);
    int zero = 0;
    while (modes.eigenvalues()[zero] < 1e-9 * modes.eigenvalues().maxCoeff()) ++zero;
    fmt::print("degree {}: {} zero modes, next {:.2e}\n", degree, zero,
               modes.eigenvalues()[zero] / modes.eigenvalues().maxCoeff());
  }
}

}  // namespace
}  // namespace blocklift::structure
