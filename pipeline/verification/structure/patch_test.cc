#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "pipeline/verification/models/box_mesh.h"
#include "pipeline/verification/structure/structure_cases.h"
#include "structure/response/cell_stress.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

struct PatchErrors {
  double displacement = 0;  ///< largest, over the largest displacement
  double stress = 0;        ///< largest, over the stress
};

// A linear displacement given on the boundary of 3 x 3 x 3 hexahedra whose inner vertices lie anywhere.
PatchErrors patch(int degree) {
  const Material material{"steel", 206e9, 0.3, 7850, 235e6};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> by(-0.06, 0.06);
  const BlockMesh mesh =
      testing::box_mesh({3, 3, 3}, Vector3::Ones(), material, [&](const Vector3& x) -> Vector3 {
        if (x.minCoeff() < 1e-9 || x.maxCoeff() > 1 - 1e-9) return x;
        return x + Vector3(by(random), by(random), by(random));
      });
  const Discretisation space(mesh, degree);
  Eigen::Matrix3d gradient;
  gradient << 1e-3, 2e-4, -3e-4, 5e-4, -7e-4, 1e-4, -2e-4, 4e-4, 6e-4;
  const auto exact = [&](const Vector3& x) -> Vector3 {
    return gradient * x + Vector3(1e-4, -2e-4, 3e-4);
  };
  std::vector<FixedUnknown> fixed;
  testing::hold(
      space, [](const Vector3& x) { return x.minCoeff() < 1e-9 || x.maxCoeff() > 1 - 1e-9; }, exact,
      {true, true, true}, fixed);
  const Eigen::VectorXd u =
      testing::solve(mesh, space, fixed, Eigen::VectorXd::Zero(space.unknowns()));
  PatchErrors errors;
  for (int n = 0; n < space.node_count(); ++n)
    errors.displacement =
        std::max(errors.displacement, (u.segment<3>(3 * n) - exact(space.nodes.col(n))).norm() /
                                          u.cwiseAbs().maxCoeff());
  const Stress wanted = stress_of_gradient(material, gradient);
  const CellStress stress(mesh, space, space.element.nodes());
  for (int cell = 0; cell < space.cell_count(); ++cell)
    errors.stress = std::max(
        errors.stress, (stress(cell, u).colwise() - wanted).cwiseAbs().maxCoeff() / wanted.norm());
  return errors;
}

}  // namespace

// Stresses are differences of displacements over an element: they have lost a digit more.
VerificationCase patch_test() {
  return {.name = "patch-test",
          .stage = "structure",
          .source =
              "Irons's patch test: a linear field is exact on any mesh (Zienkiewicz, Taylor, "
              "Zhu 2013, chapter 9)",
          .compute = [] {
            std::vector<VerificationRow> rows;
            for (const int degree : {1, 2, 3, 4}) {
              const PatchErrors errors = patch(degree);
              const std::string of = ", degree " + std::to_string(degree);
              rows.push_back(
                  bound("displacement off the linear field" + of, "1", errors.displacement, 1e-12));
              rows.push_back(bound("stress off the constant" + of, "1", errors.stress, 1e-11));
            }
            return rows;
          }};
}

}  // namespace blocklift::pipeline
