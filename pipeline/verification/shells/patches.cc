#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "pipeline/verification/shells/shell_cases.h"
#include "structure/formulation/shell.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

using Motion6 = Eigen::Matrix<double, 6, 1>;

constexpr double patch_thickness = 0.001;

bool on_patch_rim(const Vector3& x) {
  return x.x() < 1e-9 || x.x() > 0.24 - 1e-9 || x.y() < 1e-9 || x.y() > 0.12 - 1e-9;
}

// The published motions; their parts that stretch, bend and twist act at different heights of the
// plate, so that one solution shows them all.
Motion6 published_motion(const Vector3& p) {
  const double x = p.x(), y = p.y();
  Motion6 motion;
  motion << x + y / 2, y + x / 2, (x * x + x * y + y * y) / 2, y + x / 2, -x - y / 2, 0;
  return 1e-3 * motion;
}

// Largest deviation of the stress at a height from a state of plane stress, over all cells.
double stress_off(const Space& space, const Eigen::VectorXd& motion, double height,
                  const Vector3& expected) {
  double worst = 0;
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell)
    for (const Eigen::Vector2d& xi : {Eigen::Vector2d(0.3, 0.6), Eigen::Vector2d(0.9, 0.1)}) {
      const Eigen::Matrix3d middle = examples::shell_stress(space, cell, xi, 0, motion);
      const Eigen::Matrix3d there = examples::shell_stress(space, cell, xi, height, motion);
      const Eigen::Matrix3d stress = height == 0 ? middle : Eigen::Matrix3d(there - middle);
      worst =
          std::max(worst, (Vector3(stress(0, 0), stress(1, 1), stress(0, 1)) - expected).norm());
    }
  return worst / expected.norm();
}

// Largest deviation of the transverse shear from that of w = a x + b y without rotation.
double shear_off(const Space& space, double a, double b) {
  ShellOperator strains(space, square_rule(space.degree() + 1).topRows<2>());
  const Vector3 gradient(a, b, 0);
  double worst = 0;
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell) {
    Eigen::VectorXd own = Eigen::VectorXd::Zero(6 * space.nodes_per_shell());
    for (int i = 0; i < space.nodes_per_shell(); ++i)
      own[6 * i + 2] = gradient.dot(space.nodes().col(space.shell_nodes(cell)[i]));
    strains.reinit(cell);
    for (const ShellPoint& point : strains.points()) {
      const Eigen::Vector2d expected(gradient.dot(point.e_1), gradient.dot(point.e_2));
      // A plate's normal that points down turns the sign of w, not that of the strain's size.
      const Eigen::Vector2d found = (point.strain * own).segment<2>(shear_1);
      worst = std::max(worst, std::min((found - expected).norm(), (found + expected).norm()));
    }
  }
  return worst / gradient.norm();
}

// Elements of some centimetres lose two digits of their gradients, and the solution as many as its
// condition of some 1e6 takes.
constexpr double patch_rounding = 1e-7;

VerificationCase patch_test() {
  return {.name = "shell-patch-test",
          .stage = "structure",
          .source =
              "MacNeal and Harder (1985), Finite Elem. Anal. Des. 1, 3-20: 1333, 1333, 400 in the "
              "middle surface and 0.667, 0.667, 0.200 by bending and twist at the faces; exact "
              "at any degree",
          .compute = [] {
            std::vector<VerificationRow> rows;
            const auto shapes = {"quadrangles", "quadrangles and triangles", "triangles"};
            int kind = 0;
            for (const char* shape : shapes) {
              Mesh mesh = examples::macneal_patch(patch_thickness, {"patch", 1e6, 0.25, 0, 1});
              if (kind > 0) examples::divide_into_triangles(mesh, kind == 2);
              ++kind;
              for (int degree = 1; degree <= 4; ++degree) {
                const Space space(mesh, {degree, {}});
                std::vector<FixedUnknown> fixed;
                examples::hold_at(space, on_patch_rim, published_motion, {0, 1, 2, 3, 4, 5}, fixed);
                const Eigen::VectorXd motion =
                    examples::solve(space, Eigen::VectorXd::Zero(space.freedoms()), fixed);
                const auto row = [&](const char* what, double off) {
                  rows.push_back(bound(fmt::format("{}, {} of degree {}", what, shape, degree), "1",
                                       off, patch_rounding));
                };
                row("membrane stress, largest deviation",
                    stress_off(space, motion, 0, {4000.0 / 3, 4000.0 / 3, 400}));
                row("stress by bending and twist, largest deviation",
                    stress_off(space, motion, -patch_thickness / 2, {2.0 / 3, 2.0 / 3, 0.2}));
                row("transverse shear strain, largest deviation", shear_off(space, 1, 0.5));
              }
            }
            return rows;
          }};
}

}  // namespace

std::vector<VerificationCase> patch_cases() { return {patch_test()}; }

}  // namespace blocklift::pipeline
