// A box on one hook by two slings over its round deck edges, from files: statics by hand.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "pipeline/lift/block_preparation.h"
#include "pipeline/lift/lift_run.h"
#include "pipeline/lift/sling_ends.h"
#include "pipeline/measures/measure.h"
#include "pipeline/results/doubts.h"
#include "tests/pipeline/sling_over_edge_lift.h"

namespace blocklift::pipeline {
namespace {

using std::numbers::pi;
using test::sling_over_edge_lift;
using test::TemporaryFolder;
using test::with;

/// The lift of the files with its block in elements of degree 1.
struct OverEdges {
  explicit OverEdges(const test::SampleLift& files = sling_over_edge_lift()) {
    files.write(folder);
    lift_case = read_lift_case(".");
    lift_case.structure.element_degree = 1;
    Diagnostics diagnostics;
    model = make_block_model(*lift_case.load.model, "plate", lift_case.structure, diagnostics);
    const structure::MassProperties& mass = model->mass_properties();
    run.emplace(run_lift(
        lift_case, build_lift(lift_case, {mass.mass, mass.centre_of_mass_B, mass.inertia_BBcm_B}),
        nothing));
  }
  const dynamics::RopeHistory& rope(const dynamics::History& history, std::size_t place) const {
    return history.ropes[static_cast<std::size_t>(run->model.ropes[place].rope)];
  }

  static void nothing(const std::string&, double, const std::string&) {}
  TemporaryFolder folder;
  LiftCase lift_case;
  std::unique_ptr<structure::ElasticModel> model;
  std::optional<LiftRun> run;
};

const OverEdges& over_edges() {
  static const OverEdges lift;
  return lift;
}

/// The same in the plane, by hand: a hook at the height h above the axes of two rounds of the radius
/// R, 2 m off on either side, the slings plumb below their edges.
struct ByHand {
  static constexpr double EA = 200e6, L0 = 4, R = 0.15, below = 0.65, off = 2, weight = 10e3 * 9.81;

  explicit ByHand(double h) {
    const double beta = std::atan2(h, off), d = std::hypot(h, off);
    wrap = pi - beta - std::acos(R / d);
    length = std::sqrt(d * d - R * R) + R * wrap + below;
    tension = EA / L0 * (length - L0);
  }
  /// By the height of the hook at which the vertical parts bear the weight. The sling leaves the
  /// edge by `wrap` off the plumb.
  static ByHand at_rest() {
    double low = 2, high = 3.5;
    for (int k = 0; k < 80; ++k) {
      const double middle = 0.5 * (low + high);
      const ByHand one(middle);
      (2 * one.tension * std::cos(one.wrap) < weight ? low : high) = middle;
    }
    return ByHand(low);
  }
  double wrap, length, tension;
};

TEST(SlingOverEdge, HangsAsByHand) {
  const ByHand hand = ByHand::at_rest();
  EXPECT_GT(hand.wrap, 0.5);  // the sling turns by some 39 degrees
  const OverEdges& lift = over_edges();
  const dynamics::History& history = lift.run->static_history;
  for (const std::size_t sling : {0U, 1U}) {
    const dynamics::RopeHistory& rope = lift.rope(history, sling);
    const dynamics::EdgeHistory& edge = rope.edges.at(0);
    EXPECT_EQ(edge.name, sling == 0 ? "aft" : "fore");
    EXPECT_NEAR(rope.tension[0], hand.tension, 1e-6 * hand.tension);
    EXPECT_NEAR(rope.elongation[0], hand.length - ByHand::L0, 1e-8);
    EXPECT_NEAR(edge.wrap[0], hand.wrap, 1e-7);
    // In the middle of an edge of 2 m.
    EXPECT_NEAR(edge.first_place[0], 1, 1e-6);
    EXPECT_NEAR(edge.last_place[0], 1, 1e-6);
    // The vector sum of both pulls: at the lug the sling is plumb.
    const double inwards = sling == 0 ? 1 : -1;
    const Vector3 sum =
        hand.tension *
        (Vector3(inwards * std::sin(hand.wrap), 0, std::cos(hand.wrap)) - Vector3::UnitZ());
    EXPECT_LT((Vector3(edge.force.row(0)) - sum).norm(), 1e-5 * hand.tension);
    EXPECT_LT((Vector3(rope.last_force.row(0)) - hand.tension * Vector3::UnitZ()).norm(),
              1e-5 * hand.tension);
    EXPECT_NEAR(rope.first_force.row(0).norm(), rope.last_force.row(0).norm(), 1e-6 * hand.tension);
  }
  // Lugs and edges together bear the weight: the lugs alone more than it.
  EXPECT_NEAR(load_on_slings(lift.run->model, history)[0], ByHand::weight, 1e-6 * ByHand::weight);
}

// In motion, at every instant: the sum of pulls at the lug and forces on the edge is the pull of the
// span above, and moment and force of the block's ropes are those of the history.
TEST(SlingOverEdge, ForceIsTheSumOfBothPullsInMotion) {
  const OverEdges& lift = over_edges();
  const dynamics::History& history = lift.run->dynamic_history();
  const dynamics::BodyHistory& load = history.body("load");
  double least = 10, most = 0;
  for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
    Vector3 sum = Vector3::Zero();
    for (const std::size_t sling : {0U, 1U}) {
      const dynamics::RopeHistory& rope = lift.rope(history, sling);
      const dynamics::EdgeHistory& edge = rope.edges[0];
      const Vector3 above = rope.first_force.row(i), force = edge.force.row(i);
      EXPECT_LT((Vector3(rope.last_force.row(i)) + force + above).norm(), 1e-9 * rope.tension[i]);
      sum += Vector3(rope.last_force.row(i)) + force;
      least = std::min(least, edge.first_place[i]);
      most = std::max(most, edge.first_place[i]);
    }
    EXPECT_LT((Vector3(load.load.row(i).tail<3>()) - sum).norm(), 1e-9 * sum.norm());
  }
  EXPECT_GT(most - least, 0.005);  // the slings wander along their edges as the load swings
}

TEST(SlingOverEdge, IsMeasured) {
  const OverEdges& lift = over_edges();
  const ByHand hand = ByHand::at_rest();
  const std::vector<LiftMeasure> measures = find_measures(lift.lift_case, *lift.run);
  const auto at_rest = [&](const std::string& name) {
    for (const LiftMeasure& measure : measures)
      if (measure.name() == name) return measure.at_rest[0];
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_NEAR(at_rest("R2 over fore: edge force"), 2 * hand.tension * std::sin(hand.wrap / 2),
              1e-5 * hand.tension);
  EXPECT_NEAR(at_rest("R2 over fore: angle of wrap"), hand.wrap, 1e-7);
  EXPECT_NEAR(at_rest("R2 over fore: place on edge"), 1, 1e-6);
  EXPECT_NEAR(at_rest("R2 over fore: distance from edge end"), 1, 1e-6);
  EXPECT_NEAR(at_rest("R2: sling angle"), pi / 2, 1e-6);
  for (const std::string& doubt : list_doubts(lift.lift_case, *lift.run))
    EXPECT_EQ(doubt.find("run off"), std::string::npos) << doubt;
}

// An edge that ends before the sling touches it.
TEST(SlingOverEdge, IsDoubtedWhereItRunsOff) {
  test::SampleLift files = sling_over_edge_lift();
  files.block =
      with(files.block, "fore: {from: [4 m, -1 m, 1 m]", "fore: {from: [4 m, 0.5 m, 1 m]");
  const OverEdges lift(files);
  bool said = false;
  for (const std::string& doubt : list_doubts(lift.lift_case, *lift.run))
    said = said || doubt.find("Rope R2 touches edge fore up to 0.5") != std::string::npos;
  EXPECT_TRUE(said);
}

}  // namespace
}  // namespace blocklift::pipeline
