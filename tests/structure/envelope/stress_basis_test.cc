// One factorisation and one basis serve blocks of any mass.
#include "structure/envelope/stress_basis.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/system/matter.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

/// A lift of the small block with spin, balanced for its mass.
LoadCase spun_lift(const ElasticModel& model) {
  LoadCase load_case{"lift", {}, {}};
  const InertiaField spin =
      InertiaField::moving(Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), {0.1, -0.05, 0.2});
  Eigen::VectorXd pull = model.inertia_loads() * spin.coefficients();
  for (int lug = 0; lug < 4; ++lug) {
    const Vector3 force(500.0 * lug, -800, 19000 + 1000.0 * lug);
    load_case.lug_forces_B.push_back(force);
    pull += model.lug_loads().middleCols<3>(3 * lug) * force;
  }
  load_case.field = balancing_field(model.mass_properties(), resultant(model.space(), pull));
  load_case.field.angular_velocity_products = spin.angular_velocity_products;
  return load_case;
}

class OtherMass : public ::testing::Test {
 protected:
  OtherMass()
      : block_(test::small_block()),
        model_(generate_shell_mesh(block_), {2, {}}, block_.total_mass, block_.centre_of_mass_B),
        responses_(model_),
        other_mass_(1.07 * model_.mass_properties().mass),
        other_centre_(model_.mass_properties().centre_of_mass_B + Vector3(0.05, -0.03, 0.02)),
        other_(model_.with_mass(other_mass_, other_centre_)),
        alone_(generate_shell_mesh(block_), {2, {}}, other_mass_, other_centre_),
        alone_responses_(alone_) {}

  const BlockDescription block_;
  const ElasticModel model_;
  const UnitResponses responses_;
  const double other_mass_;
  const Vector3 other_centre_;
  const std::unique_ptr<ElasticModel> other_;
  const ElasticModel alone_;
  const UnitResponses alone_responses_;
};

TEST_F(OtherMass, SharesTheFactorBitForBit) {
  const UnitResponses shared(*other_, responses_);
  EXPECT_EQ(shared.displacements(), alone_responses_.displacements());
  const LoadCase lift = spun_lift(alone_);
  EXPECT_EQ(shared.displacement(lift), alone_responses_.displacement(lift));
  EXPECT_THROW(UnitResponses(alone_, responses_), ModelError);
}

TEST_F(OtherMass, HasTheStressOfItsOwnSolution) {
  const CheckedStress checked(alone_, alone_responses_.displacements());
  const LoadCase lift = spun_lift(alone_);
  const Eigen::VectorXd own = checked.von_mises(alone_responses_.coefficients(lift));
  const StressBasis basis = make_stress_basis(responses_, checked.squares());
  const StressOfBlock other(basis, other_->mass_properties(), lift.lug_forces_B.size());
  const LargestValue largest = find_largest_checked(other, other.factors(lift));
  Eigen::Index place = 0;
  EXPECT_NEAR(largest.value, own.maxCoeff(&place), 1e-9 * own.maxCoeff());
  EXPECT_EQ(largest.point, place);
  EXPECT_EQ(largest.instant, 0);
  // The mass matters: with the first block's density the stress is another.
  const StressOfBlock first(basis, model_.mass_properties(), lift.lug_forces_B.size());
  const double of_first_density = find_largest_checked(first, first.factors(lift)).value;
  EXPECT_GT(std::abs(of_first_density / own.maxCoeff() - 1), 1e-4);
}

TEST_F(OtherMass, IsOfAsManyLugsAsItsBasis) {
  const CheckedStress checked(alone_, alone_responses_.displacements());
  const StressBasis basis = make_stress_basis(responses_, checked.squares());
  EXPECT_THROW(StressOfBlock(basis, other_->mass_properties(), 5), ModelError);
  const StressOfBlock other(basis, other_->mass_properties(), 4);
  const std::vector<Vector3> three(3, Vector3::Zero());
  EXPECT_THROW(other.factors({"three lugs", three, {}}), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
