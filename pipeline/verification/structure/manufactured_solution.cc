#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "pipeline/verification/models/box_mesh.h"
#include "pipeline/verification/structure/structure_cases.h"
#include "structure/elasticity/load.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

// Sum of two plane waves, u = d sin(k . x): div sigma = -((lambda + mu) k (k . d) + mu |k|^2 d) sin.
struct PlaneWaves {
  Material material{"made up", 1.0, 0.3, 0, 1};
  std::array<Vector3, 2> direction{Vector3(1, -0.5, 0.3), Vector3(0.2, 0.7, -1)};
  std::array<Vector3, 2> number{Vector3(1.9, 1.1, -0.7), Vector3(-0.6, 2.1, 1.3)};

  Vector3 displacement(const Vector3& x) const {
    Vector3 u = Vector3::Zero();
    for (std::size_t w = 0; w < 2; ++w) u += direction[w] * std::sin(number[w].dot(x));
    return u;
  }
  Eigen::Matrix3d gradient(const Vector3& x) const {
    Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
    for (std::size_t w = 0; w < 2; ++w)
      g += direction[w] * number[w].transpose() * std::cos(number[w].dot(x));
    return g;
  }
  Vector3 body_force(const Vector3& x) const {
    const double lambda = material.lame_lambda(), mu = material.shear_modulus();
    Vector3 force = Vector3::Zero();
    for (std::size_t w = 0; w < 2; ++w)
      force += ((lambda + mu) * number[w] * number[w].dot(direction[w]) +
                mu * number[w].squaredNorm() * direction[w]) *
               std::sin(number[w].dot(x));
    return force;
  }
};

struct Errors {
  double l2 = 0;
  double h1 = 0;
};

Errors solve_plane_waves(int cells, int degree) {
  const PlaneWaves waves;
  // Smoothly distorted cube: its cells are general hexahedra.
  const BlockMesh mesh = testing::box_mesh(
      {cells, cells, cells}, Vector3::Ones(), waves.material, [](const Vector3& x) -> Vector3 {
        const double bulge =
            std::sin(M_PI * x.x()) * std::sin(M_PI * x.y()) * std::sin(M_PI * x.z());
        return x + 0.12 * bulge * Vector3(1, -0.7, 0.5);
      });
  const Discretisation space(mesh, degree);
  std::vector<FixedUnknown> fixed;
  testing::hold(
      space,
      [](const Vector3& x) { return (x.array() < 1e-9).any() || (x.array() > 1 - 1e-9).any(); },
      [&](const Vector3& x) { return waves.displacement(x); }, {true, true, true}, fixed);
  const Eigen::VectorXd u =
      testing::solve(mesh, space, fixed,
                     body_load(mesh, space, [&](const Vector3& x) { return waves.body_force(x); }));

  const auto line = gauss_points(degree + 3);
  const auto rule = tensor_rule(line, line, line);
  const Eigen::MatrixXd values = space.element.values(rule.topRows<3>());
  const Eigen::MatrixXd gradients = space.element.gradients(rule.topRows<3>());
  Errors errors;
  for (int cell = 0; cell < space.cell_count(); ++cell) {
    Eigen::MatrixX3d local(space.nodes_per_cell, 3);
    for (int i = 0; i < space.nodes_per_cell; ++i)
      local.row(i) = u.segment<3>(3 * space.node(cell, i)).transpose();
    for (Eigen::Index q = 0; q < rule.cols(); ++q) {
      const Vector3 xi = rule.col(q).head<3>(), x = position(mesh, cell, xi);
      const Eigen::Matrix3d edges = jacobian(mesh, cell, xi);
      const double weight = rule(3, q) * edges.determinant();
      const Vector3 value = (values.row(q) * local).transpose();
      const Eigen::Matrix3d slope =
          (gradients.middleRows<3>(3 * q) * local).transpose() * edges.inverse();
      errors.l2 += weight * (value - waves.displacement(x)).squaredNorm();
      errors.h1 += weight * (slope - waves.gradient(x)).squaredNorm();
    }
  }
  return {std::sqrt(errors.l2), std::sqrt(errors.h1)};
}

}  // namespace

// A priori estimates (Ciarlet 1978, theorem 3.2.2 with Nitsche's duality): |u - u_h| falls with
// h^(p+1) in L2 and h^p in H1. From n to 2 n cells the observed order lies within 0.25 of that.
VerificationCase manufactured_solution() {
  return {
      .name = "manufactured-solution",
      .stage = "structure",
      .source = "a priori estimates: p + 1 in L2, p in H1 (Ciarlet 1978, theorem 3.2.2)",
      .compute = [] {
        std::vector<VerificationRow> rows;
        for (const int degree : {1, 2, 3, 4}) {
          const int cells = degree == 1 ? 8 : (degree == 2 ? 4 : (degree == 3 ? 3 : 2));
          const Errors coarse = solve_plane_waves(cells, degree);
          const Errors fine = solve_plane_waves(2 * cells, degree);
          const std::string order =
              "degree " + std::to_string(degree) + ", order of convergence in ";
          rows.push_back(
              compare(order + "L2", "1", degree + 1, std::log2(coarse.l2 / fine.l2), 0.25));
          rows.push_back(compare(order + "H1", "1", degree, std::log2(coarse.h1 / fine.h1), 0.25));
        }
        return rows;
      }};
}

}  // namespace blocklift::pipeline
