// The structural stage at the size of a shipped block; against references it is held by the
// verification suite.
#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/stress/stress.h"
#include "tests/structure/block_models.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

// The shipped size: balanced lift, reactions that vanish.
TEST(HullBlock, LiftAtFullSize) {
  const BlockDescription block = test::hull_block();
  const ElasticModel model = test::make_elastic_model(block, 3);
  EXPECT_GT(model.space().unknowns(), 50000);
  const UnitResponses responses(model);
  LoadCase load_case{"lift", {}, {}};
  Wrench pull;
  for (const LiftingPoint& lug : model.mesh().lifting_points) {
    const Vector3 force(0, 0, model.mass_properties().mass * 9.80665 / 6);
    load_case.lug_forces_B.push_back(force);
    pull.force += force;
    pull.moment += lug.p_BPin.cross(force);
  }
  load_case.field = balancing_field(model.mass_properties(), pull);
  const LoadCaseResult result = StressRecovery(responses).evaluate(load_case);
  EXPECT_LT(result.balance.force_residual, 1e-8);
  EXPECT_LT(result.balance.moment_residual, 1e-8);
  EXPECT_LT(result.balance.reaction_over_weight, 1e-6);
  // Between the mean stress of the lugs' roots and yield: a sanity bracket, not a reference.
  EXPECT_GT(result.checked_von_mises.value, 860e3 * 9.8 / 6 / (2.0 * 0.05));
  EXPECT_LT(result.checked_von_mises.value, 355e6);
  const Eigen::VectorXd direct =
      responses.without_rigid_motion(responses.solve_directly(load_case));
  const Eigen::VectorXd superposed =
      responses.without_rigid_motion(responses.displacement(load_case));
  EXPECT_LT((superposed - direct).norm(), 1e-9 * direct.norm());
}

}  // namespace
}  // namespace blocklift::structure
