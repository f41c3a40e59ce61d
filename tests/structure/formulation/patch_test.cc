#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/formulation/shell.h"

namespace blocklift::structure {
namespace {

using Motion6 = Eigen::Matrix<double, 6, 1>;
using Strains = Eigen::Matrix<double, shell_strains, 1>;

// What is moved and turned: nothing may depend on the world's axes.
const Eigen::Matrix3d turned =
    Eigen::AngleAxisd(0.7, Vector3(1, 2, -0.5).normalized()).toRotationMatrix();

Mesh turn(Mesh mesh) {
  for (Vector3& vertex : mesh.vertices) vertex = turned * vertex;
  return mesh;
}

Motion6 turn(const Motion6& motion) {
  Motion6 result;
  result << turned * motion.head<3>(), turned * motion.tail<3>();
  return result;
}

// A state of constant strain: motion by place before the turn, and the strains along the axes x, y.
struct State {
  const char* name;
  examples::Motion motion;
  Strains strains;
};

Strains strain_of(ShellStrain which, double value) {
  Strains strains = Strains::Zero();
  strains[which] = value;
  return strains;
}

// In-plane gradients without rotation theta_z = (v,x - u,y) / 2; bending with theta = (w,y, -w,x).
std::vector<State> constant_states() {
  const auto membrane = [](double a, double b, double c) {
    return [=](const Vector3& x) -> Motion6 {
      return (Motion6() << a * x.x() + c * x.y() / 2, b * x.y() + c * x.x() / 2, 0, 0, 0, 0)
          .finished();
    };
  };
  // w = (a x^2 + b y^2 + c x y) / 2; theta x n = -grad w, so the curvatures are -a, -b, -c.
  const auto bending = [](double a, double b, double c) {
    return [=](const Vector3& p) -> Motion6 {
      const double x = p.x(), y = p.y();
      return (Motion6() << 0, 0, (a * x * x + b * y * y + c * x * y) / 2, b * y + c * x / 2,
              -a * x - c * y / 2, 0)
          .finished();
    };
  };
  const auto shear = [](double a, double b) {
    return [=](const Vector3& x) -> Motion6 {
      return (Motion6() << 0, 0, a * x.x() + b * x.y(), 0, 0, 0).finished();
    };
  };
  return {{"stretch along x", membrane(1, 0, 0), strain_of(membrane_11, 1)},
          {"stretch along y", membrane(0, 1, 0), strain_of(membrane_22, 1)},
          {"membrane shear", membrane(0, 0, 1), strain_of(membrane_12, 1)},
          {"bending along x", bending(1, 0, 0), strain_of(curvature_11, -1)},
          {"bending along y", bending(0, 1, 0), strain_of(curvature_22, -1)},
          {"twist", bending(0, 0, 1), strain_of(curvature_12, -1)},
          {"transverse shear x", shear(1, 0), strain_of(shear_1, 1)},
          {"transverse shear y", shear(0, 1), strain_of(shear_2, 1)}};
}

// Strains of a point turned from its tangents to the axes x, y of the patch.
Strains along_axes(const ShellPoint& point, const Strains& strains) {
  const Vector3 x = turned.col(0), y = turned.col(1);
  Eigen::Matrix2d p;
  p << x.dot(point.e_1), x.dot(point.e_2), y.dot(point.e_1), y.dot(point.e_2);
  const auto tensor = [&](int first) -> Vector3 {
    Eigen::Matrix2d e;
    e << strains[first], strains[first + 2] / 2, strains[first + 2] / 2, strains[first + 1];
    e = p * e * p.transpose();
    return {e(0, 0), e(1, 1), 2 * e(0, 1)};
  };
  Strains result;
  result << tensor(membrane_11), tensor(curvature_11), p * strains.segment<2>(shear_1),
      strains[drilling];
  return result;
}

double largest_deviation(const Space& space, const Eigen::VectorXd& motion,
                         const Strains& expected) {
  double worst = 0;
  ShellOperator strains(space, square_rule(space.degree() + 1).topRows<2>());
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell) {
    strains.reinit(cell);
    Eigen::VectorXd own(6 * space.nodes_per_shell());
    for (int i = 0; i < space.nodes_per_shell(); ++i)
      own.segment<6>(6 * i) = motion.segment<6>(6 * space.shell_nodes(cell)[i]);
    for (const ShellPoint& point : strains.points())
      worst =
          std::max(worst, (along_axes(point, point.strain * own) - expected).cwiseAbs().maxCoeff());
  }
  return worst;
}

Eigen::VectorXd impose(const Space& space, const examples::Motion& motion) {
  Eigen::VectorXd all(space.freedoms());
  for (int n = 0; n < space.node_count(); ++n)
    all.segment<6>(6 * n) = turn(motion(turned.transpose() * space.nodes().col(n)));
  return all;
}

bool on_rim(const Vector3& place) {
  const Vector3 x = turned.transpose() * place;
  return x.x() < 1e-9 || x.x() > 0.24 - 1e-9 || x.y() < 1e-9 || x.y() > 0.12 - 1e-9;
}

// Motion of the patch whose rim is moved as a state says.
Eigen::VectorXd move_rim(const Space& space, const examples::Motion& motion) {
  std::vector<FixedUnknown> fixed;
  examples::hold_at(
      space, on_rim, [&](const Vector3& x) { return turn(motion(turned.transpose() * x)); },
      {0, 1, 2, 3, 4, 5}, fixed);
  return examples::solve(space, Eigen::VectorXd::Zero(space.freedoms()), fixed);
}

// As it is, with two quads cut into triangles, and of triangles alone.
std::vector<Mesh> patches() {
  std::vector<Mesh> meshes;
  for (const int kind : {0, 1, 2}) {
    meshes.push_back(examples::macneal_patch(0.01, {"patch", 1e6, 0.25, 0, 1}));
    if (kind > 0) examples::divide_into_triangles(meshes.back(), kind == 2);
    meshes.back() = turn(meshes.back());
  }
  return meshes;
}

// Gradients of shape functions over elements of some centimetres lose two digits of 1e-16.
constexpr double rounding = 1e-11;

TEST(ShellPatch, ConstantStrainsAreFeltExactly) {
  for (const Mesh& mesh : patches())
    for (int degree = 1; degree <= 4; ++degree) {
      const Space space(mesh, {degree, {}});
      for (const State& state : constant_states())
        EXPECT_LT(largest_deviation(space, impose(space, state.motion), state.strains), rounding)
            << state.name << ", degree " << degree << ", " << mesh.shells.size() << " shells";
    }
}

// The rim moves, what is inside follows: the solution is the state itself, whatever the distortion.
// (Constant transverse shear is no equilibrium of a plate without moments.)
TEST(ShellPatch, MembraneAndBendingPatchesAreExact) {
  for (const Mesh& mesh : patches())
    for (int degree = 1; degree <= 4; ++degree) {
      const Space space(mesh, {degree, {}});
      for (const State& state : constant_states()) {
        if (state.strains.segment<2>(shear_1).norm() > 0) continue;
        // Gradients take 1e-16 / 1e-2 m, the solution the condition of some 1e6.
        EXPECT_LT(largest_deviation(space, move_rim(space, state.motion), state.strains), 1e-7)
            << state.name << ", degree " << degree << ", " << mesh.shells.size() << " shells";
      }
    }
}

// The published load: u = 1e-3 (x + y / 2), v = 1e-3 (y + x / 2) gives 1333, 1333 and 400;
// w = 1e-3 (x^2 + x y + y^2) / 2 gives moments of 1.111e-7, 1.111e-7 and 3.333e-8, that is 0.667,
// 0.667, 0.2 at the surfaces.
TEST(ShellPatch, PublishedStressesOfMacNealAndHarder) {
  const Mesh mesh = examples::macneal_patch(0.001, {"patch", 1e6, 0.25, 0, 1});
  for (int degree = 1; degree <= 4; ++degree) {
    const Space space(mesh, {degree, {}});
    const auto rim = [](const Vector3& x) {
      return x.x() < 1e-9 || x.x() > 0.24 - 1e-9 || x.y() < 1e-9 || x.y() > 0.12 - 1e-9;
    };
    std::vector<FixedUnknown> fixed;
    examples::hold_at(
        space, rim,
        [](const Vector3& p) -> Motion6 {
          const double x = p.x(), y = p.y();
          return 1e-3 * (Motion6() << x + y / 2, y + x / 2, (x * x + x * y + y * y) / 2, y + x / 2,
                         -x - y / 2, 0)
                            .finished();
        },
        {0, 1, 2, 3, 4, 5}, fixed);
    const Eigen::VectorXd motion =
        examples::solve(space, Eigen::VectorXd::Zero(space.freedoms()), fixed);
    for (int cell = 0; cell < 5; ++cell) {
      const Eigen::Matrix3d middle = examples::shell_stress(space, cell, {0.3, 0.6}, 0, motion);
      const Eigen::Matrix3d top = examples::shell_stress(space, cell, {0.3, 0.6}, 0.0005, motion);
      const Eigen::Matrix3d bending = middle - top;
      EXPECT_NEAR(middle(0, 0), 4000.0 / 3, 1e-5);
      EXPECT_NEAR(middle(1, 1), 4000.0 / 3, 1e-5);
      EXPECT_NEAR(middle(0, 1), 400, 1e-5);
      EXPECT_NEAR(bending(0, 0), 2.0 / 3, 1e-5);
      EXPECT_NEAR(bending(1, 1), 2.0 / 3, 1e-5);
      EXPECT_NEAR(bending(0, 1), 0.2, 1e-5);
    }
  }
}

// A part of the patch is finer: hanging nodes within and across the joints of its shells. Of degree
// 1 the deflection of a hanging node is the mean of its neighbours, which a parabola's is not.
TEST(ShellPatch, HangingNodesKeepThePatchExact) {
  for (const Mesh& mesh : patches())
    for (int degree = 1; degree <= 4; ++degree) {
      const Space space(mesh, {degree, [](const Vector3& place) {
                                 const Vector3 x = turned.transpose() * place;
                                 return x.x() + x.y() < 0.15 ? 0.03 : 0.3;
                               }});
      ASSERT_GT(space.shells().size(), 3 * mesh.shells.size());
      for (const State& state : constant_states()) {
        const bool bends = state.strains.segment<3>(curvature_11).norm() > 0;
        if (state.strains.segment<2>(shear_1).norm() > 0 || (degree == 1 && bends)) continue;
        EXPECT_LT(largest_deviation(space, move_rim(space, state.motion), state.strains), 1e-7)
            << state.name << ", degree " << degree << ", " << mesh.shells.size() << " shells";
      }
    }
}

}  // namespace
}  // namespace blocklift::structure
