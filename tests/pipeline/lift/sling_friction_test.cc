// The lift of slings over edges with friction: spans within the cone, forces and loads of the
// block.
#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/checks/lift_checks.h"
#include "pipeline/coupling/edge_loads.h"
#include "pipeline/coupling/load_mapping.h"
#include "pipeline/measures/measure.h"
#include "tests/pipeline/lift/over_edges.h"

namespace blocklift::pipeline {
namespace {

using test::OverEdges;

// By so little the round edges are left slipping; the sharp ones hold the slings.
constexpr double mu(bool sharp) { return sharp ? 0.2 : 0.01; }

test::SampleLift rubbing_lift(bool sharp) {
  test::SampleLift files = test::sling_over_edge_lift();
  const std::string aft = "outside: [-1, 0, 1], radius: 0.15 m";
  const std::string fore = "outside: [1, 0, 1], radius: 0.15 m";
  const std::string rubs = sharp ? "friction: 0.2" : "radius: 0.15 m, friction: 0.01";
  files.block = test::with(files.block, aft, "outside: [-1, 0, 1], " + rubs);
  files.block = test::with(files.block, fore, "outside: [1, 0, 1], " + rubs);
  return files;
}

const OverEdges& rubbing(bool sharp) {
  static const OverEdges round(rubbing_lift(false)), line(rubbing_lift(true));
  return sharp ? line : round;
}

// At rest one tension; in motion both spans differ, within the cone, and the larger counts.
TEST(SlingWithFriction, HasTwoTensions) {
  for (const bool sharp : {false, true}) {
    const OverEdges& lift = rubbing(sharp);
    EXPECT_EQ(lift.run->dynamic_result.statistics.bend_changes > 1, !sharp);
    double apart = 0;
    for (const std::size_t sling : {0U, 1U}) {
      const dynamics::EdgeHistory& still = lift.rope(lift.run->static_history, sling).edges[0];
      EXPECT_TRUE((still.first_tension.array() == still.last_tension.array()).all());
      const dynamics::RopeHistory& rope = lift.rope(lift.run->dynamic_history(), sling);
      const dynamics::EdgeHistory& edge = rope.edges[0];
      for (Eigen::Index i = 0; i < rope.tension.size(); ++i) {
        const double ratio = std::log(edge.first_tension[i] / edge.last_tension[i]);
        // Where it sticks each span is damped by itself.
        EXPECT_LT(std::abs(ratio), mu(sharp) * edge.wrap[i] + 2e-3);
        EXPECT_DOUBLE_EQ(rope.tension[i], std::max(edge.first_tension[i], edge.last_tension[i]));
        EXPECT_NEAR(edge.first_tension[i], rope.first_force.row(i).norm(), 1e-9 * rope.tension[i]);
        EXPECT_NEAR(edge.last_tension[i], rope.last_force.row(i).norm(), 1e-9 * rope.tension[i]);
        apart = std::max(apart, std::abs(ratio));
      }
    }
    EXPECT_GT(apart, sharp ? 0.01 : 0.005);
  }
}

// What the block's stress is computed from has the force of the dynamics, and its moment but for
// that of friction about the axis of a round edge, which goes to the mass.
TEST(SlingWithFriction, LoadsHaveTheForceOfTheDynamics) {
  for (const bool sharp : {false, true}) {
    const OverEdges& lift = rubbing(sharp);
    const dynamics::History& history = lift.run->dynamic_history();
    const EdgeBasis basis =
        *find_edge_basis(*lift.model, lift.run->model, lift.run->static_history, history);
    BlockAttachment attachment = attach_block(lift.run->model, lift.model->mesh().lifting_points);
    attachment.added_resultants = basis.resultants;
    attachment.added_ropes = basis.ropes;
    const BlockHistory in_motion(history, basis.dynamic_factors);
    const dynamics::BodyHistory& body = history.body("load");
    for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
      const structure::LoadCase load =
          map_instant(in_motion, i, attachment, lift.model->mass_properties());
      Eigen::Matrix<double, 6, 1> sum = basis.resultants * load.added;
      for (std::size_t lug = 0; lug < load.lug_forces_B.size(); ++lug) {
        sum.head<3>() += load.lug_forces_B[lug];
        sum.tail<3>() += attachment.lugs[lug].p_BPin.cross(load.lug_forces_B[lug]);
      }
      const Eigen::Matrix3d R_BW = body.X_WB(i).R.transpose();
      const Vector3 force = R_BW * Vector3(body.load.row(i).tail<3>());
      const Vector3 moment = R_BW * Vector3(body.load.row(i).head<3>());
      EXPECT_LT((sum.head<3>() - force).norm(), 1e-11 * force.norm()) << i;
      double most = 0;
      for (const std::size_t sling : {0U, 1U}) {
        const dynamics::EdgeHistory& edge = lift.rope(history, sling).edges[0];
        most += 0.15 * std::abs(edge.last_tension[i] - edge.first_tension[i]);
      }
      EXPECT_LT((sum.tail<3>() - moment).norm(), (sharp ? 0 : most) + 1e-11 * force.norm()) << i;
    }
  }
}

TEST(SlingWithFriction, IsMeasuredCheckedAndSaid) {
  const OverEdges& lift = rubbing(false);
  const dynamics::RopeHistory& rope = lift.rope(lift.run->dynamic_history(), 1);
  const std::vector<LiftMeasure> measures = find_measures(lift.lift_case, *lift.run);
  for (const char* kind : {"tension before", "tension behind"}) {
    const auto found = std::find_if(measures.begin(), measures.end(), [&](const LiftMeasure& one) {
      return one.name() == std::string("R2 over fore: ") + kind;
    });
    ASSERT_NE(found, measures.end()) << kind;
    EXPECT_EQ(found->in_motion, std::string(kind) == "tension before" ? rope.edges[0].first_tension
                                                                      : rope.edges[0].last_tension);
  }
  bool is_checked = false;
  for (const Check& check : check_lift(lift.lift_case, *lift.run)) {
    if (!check.name.starts_with("rope R2")) continue;
    is_checked = true;
    EXPECT_NEAR(check.demand,
                std::max(rope.tension.maxCoeff(),
                         lift.rope(lift.run->static_history, 1).tension.maxCoeff()),
                1e-6);
  }
  EXPECT_TRUE(is_checked);
}

}  // namespace
}  // namespace blocklift::pipeline
