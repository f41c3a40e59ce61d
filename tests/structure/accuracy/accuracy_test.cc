// The checked stress belongs to places and a size, not to a mesh, and is refined until it stands.
#include "structure/accuracy/accuracy.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/stress/squares.h"
#include "structure/system/matter.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

// A plate of 3 x 2 m in cells of any number, moved by quadratic displacements: its strains are
// linear in place, so that the mean over a square is the value in its middle.
struct MovedPlate {
  MovedPlate(int m, int n)
      : model(examples::sheet_mesh(
                  [](double x, double y) -> Vector3 {
                    return {3 * x, 2 * y, 0};
                  },
                  m, n, 0.02, examples::plain_steel()),
              {2, {}}),
        motion(Eigen::VectorXd::Zero(model.freedoms())) {
    for (int node = 0; node < model.space().node_count(); ++node) {
      const Vector3 p = model.space().nodes().col(node);
      motion.segment<2>(6 * node) << 1e-4 * p.x() * p.y(), 5e-5 * p.y() * p.y();
    }
  }
  static double von_mises_at(const Vector3& p) {
    const Material material = examples::plain_steel();
    const double e_11 = 1e-4 * p.y(), e_22 = 1e-4 * p.y(), g_12 = 1e-4 * p.x(),
                 nu = material.poisson_ratio, plane = material.youngs_modulus / (1 - nu * nu),
                 s_11 = plane * (e_11 + nu * e_22), s_22 = plane * (e_22 + nu * e_11),
                 s_12 = material.shear_modulus() * g_12;
    return std::sqrt(s_11 * s_11 - s_11 * s_22 + s_22 * s_22 + 3 * s_12 * s_12);
  }
  ElasticModel model;
  Eigen::VectorXd motion;
};

TEST(CheckedStress, BelongsToPlacesNotToCells) {
  const MovedPlate coarse(2, 1), fine(5, 3);
  const CheckedStress of_coarse(coarse.model, coarse.motion), of_fine(fine.model, fine.motion);
  ASSERT_EQ(of_coarse.squares().size(), of_fine.squares().size());
  ASSERT_GT(of_coarse.squares().size(), 50U);
  const Eigen::VectorXd one = of_coarse.von_mises(Eigen::VectorXd::Ones(1)),
                        other = of_fine.von_mises(Eigen::VectorXd::Ones(1));
  for (std::size_t s = 0; s < of_coarse.squares().size(); ++s) {
    const Vector3& centre = of_coarse.squares()[s].centre_B;
    EXPECT_LT((centre - of_fine.squares()[s].centre_B).norm(), 1e-9);
    const double exact = MovedPlate::von_mises_at(centre);
    const auto i = static_cast<Eigen::Index>(s);
    EXPECT_NEAR(one[i], exact, 1e-7 * exact) << centre.transpose();
    EXPECT_NEAR(other[i], exact, 1e-7 * exact) << centre.transpose();
  }
}

// The small block on four unequal forces, and on forces a fifth larger at two lugs.
LoadFactors pulls(const ElasticModel& model, UnitResponses& responses) {
  const auto factors = [&](double more) -> Eigen::MatrixXd {
    LoadCase load_case{"lift", {}, {}};
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(model.freedoms());
    for (int lug = 0; lug < 4; ++lug) {
      const Vector3 force(500.0 * lug, -800, (19000 + 1000.0 * lug) * (lug < 2 ? 1 : more));
      load_case.lug_forces_B.push_back(force);
      pull += model.lug_loads().middleCols<3>(3 * lug) * force;
    }
    load_case.field = balancing_field(model.mass_properties(), resultant(model.space(), pull));
    return responses.coefficients(load_case);
  };
  return {factors(1), factors(1.2)};
}

std::unique_ptr<ElasticModel> model_of(const BlockDescription& block, int degree) {
  return std::make_unique<ElasticModel>(generate_shell_mesh(block), Resolution{degree, {}},
                                        block.total_mass, block.centre_of_mass_B);
}

CheckedAccuracy refined(double largest_element, double change) {
  BlockDescription block = test::small_block();
  block.largest_element = largest_element;
  auto model = model_of(block, 3);
  auto responses = std::make_unique<UnitResponses>(*model);
  return refine_checked_stress(std::move(model), std::move(responses), pulls,
                               {change, 300000, 0.05})
      .accuracy;
}

TEST(CheckedAccuracy, EndsAtTheSameStressFromAnyMesh) {
  const CheckedAccuracy coarse = refined(2, 0.02), fine = refined(0.45, 0.02);
  ASSERT_TRUE(coarse.is_reached);
  ASSERT_TRUE(fine.is_reached);
  EXPECT_GT(coarse.steps.size(), 1U);
  const AccuracyStep &one = coarse.steps.back(), &other = fine.steps.back();
  // Each has moved by up to 2 % in its last step, and moves less from there on.
  EXPECT_NEAR(one.in_motion, other.in_motion, 0.02 * other.in_motion);
  EXPECT_NEAR(one.at_rest, other.at_rest, 0.02 * other.at_rest);
  EXPECT_NEAR(one.increase(), other.increase(), 0.02);
}

TEST(CheckedAccuracy, EndsAtTheCostThatIsAllowed) {
  BlockDescription block = test::small_block();
  auto model = model_of(block, 2);
  auto responses = std::make_unique<UnitResponses>(*model);
  const RefinedBlock result =
      refine_checked_stress(std::move(model), std::move(responses), pulls, {1e-9, 1, 0.05});
  EXPECT_FALSE(result.accuracy.is_reached);
  EXPECT_EQ(result.accuracy.steps.size(), 1U);
  EXPECT_EQ(result.accuracy.stress_change(), 0);
  EXPECT_NE(result.model, nullptr);
}

}  // namespace
}  // namespace blocklift::structure
