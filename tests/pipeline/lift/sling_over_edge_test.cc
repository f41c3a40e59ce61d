// A box on one hook by two slings over its deck edges, from files: statics by hand, loads of the
// block in balance with the motion, stress.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/checks/lift_checks.h"
#include "pipeline/coupling/edge_loads.h"
#include "pipeline/coupling/load_mapping.h"
#include "pipeline/lift/block_preparation.h"
#include "pipeline/lift/lift_run.h"
#include "pipeline/lift/sling_ends.h"
#include "pipeline/measures/measure.h"
#include "pipeline/results/doubts/doubts.h"
#include "pipeline/results/files/drawn_path.h"
#include "structure/response/line_loads.h"
#include "structure/stress/block_field.h"
#include "structure/system/matter.h"
#include "tests/pipeline/lift/over_edges.h"
#include "tests/pipeline/sling_over_edge_lift.h"

namespace blocklift::pipeline {
namespace {

using std::numbers::pi;
using test::OverEdges;
using test::sling_over_edge_lift;
using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

const OverEdges& over_edges() {
  static const OverEdges lift;
  return lift;
}

/// The same in the plane, by hand: a hook at the height h above the axes of two rounds of the
/// radius R, 2 m off on either side, the slings plumb below their edges.
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

// In motion, at every instant: the sum of pulls at the lug and forces on the edge is the pull of
// the span above, and the force of the block's ropes that of the history.
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

// In pictures it bends where it touches on average.
TEST(SlingOverEdge, IsDrawnOverItsEdge) {
  const OverEdges& lift = over_edges();
  const std::vector<dynamics::BodyPoint> path =
      drawn_path(lift.run->model.system, static_cast<std::size_t>(lift.run->model.ropes[1].rope),
                 lift.run->dynamic_history());
  ASSERT_EQ(path.size(), 4U);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(path[i].body, lift.run->model.load);
    const Vector3& place = path[i].p_BoQ_B;
    EXPECT_NEAR(std::hypot(place.x() - 4, place.z() - 1), 0.15, 1e-12);
    EXPECT_NEAR(place.y(), 0, 0.1);
  }
  EXPECT_LT(path[1].p_BoQ_B.x(), path[2].p_BoQ_B.x());
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

// A sling that comes to one edge twice has measures of each time.
TEST(SlingOverEdge, IsMeasuredEachTime) {
  test::SampleLift files = sling_over_edge_lift();
  const std::size_t first = files.lift_case.find("  R1:");
  const std::size_t behind = files.lift_case.find("operation:");
  files.lift_case =
      files.lift_case.substr(0, first) +
      "  R1: {from: L1, through: [C1.left], to: L2, model: ropes/tackle, length: 8 m, over: [aft, "
      "{edge: aft, span: 2}, {edge: fore, span: 2}], sheave_friction: 0.3}\n" +
      files.lift_case.substr(behind);
  const OverEdges lift(files);
  int found = 0;
  for (const LiftMeasure& measure : find_measures(lift.lift_case, *lift.run))
    found += measure.name() == "R1 over aft: edge force" ||
                     measure.name() == "R1 over aft (2): edge force"
                 ? 1
                 : 0;
  EXPECT_EQ(found, 2);
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

// Slings are drawn along the edges when the trolley moves. All but no friction lets them slide;
// friction would hold them, away from where the computation has them.
TEST(SlingOverEdge, IsDoubtedWhereItSlidesSideways) {
  const auto doubts_with = [](const std::string& friction) {
    test::SampleLift files = sling_over_edge_lift();
    files.block = with(files.block, "outside: [1, 0, 1], radius: 0.15 m",
                       "outside: [1, 0, 1], radius: 0.15 m, friction: " + friction);
    const OverEdges lift(files);
    std::string all;
    for (const std::string& doubt : list_doubts(lift.lift_case, *lift.run)) all += doubt + "\n";
    return all;
  };
  EXPECT_NE(doubts_with("0.0001").find("Rope R2 slides sideways along edge fore from"),
            std::string::npos);
  const std::string held = doubts_with("0.3");
  EXPECT_EQ(held.find("slides sideways"), std::string::npos) << held;
  EXPECT_NE(held.find("than friction would let it slide"), std::string::npos) << held;
}

// ---- Loads of the block.

/// What pulls at the block, with its edges.
struct Loads {
  explicit Loads(const OverEdges& lift)
      : basis(*find_edge_basis(*lift.model, lift.run->model, lift.run->static_history,
                               lift.run->dynamic_history())),
        attachment(attach_block(lift.run->model, lift.model->mesh().lifting_points)),
        in_motion(lift.run->dynamic_history(), basis.dynamic_factors) {
    attachment.added_resultants = basis.resultants;
    attachment.added_ropes = basis.ropes;
  }
  EdgeBasis basis;
  BlockAttachment attachment;
  BlockHistory in_motion;
};

test::SampleLift sharp_edges() {
  test::SampleLift files = sling_over_edge_lift();
  files.block = with(files.block, "outside: [-1, 0, 1], radius: 0.15 m", "outside: [-1, 0, 1]");
  files.block = with(files.block, "outside: [1, 0, 1], radius: 0.15 m", "outside: [1, 0, 1]");
  return files;
}

/// The aft edge across the sling: it comes and leaves 6 degrees off the right angle, on a helix.
test::SampleLift oblique_edge() {
  test::SampleLift files = sling_over_edge_lift();
  files.block = with(files.block, "aft: {from: [0 m, -1 m, 1 m], to: [0 m, 1 m, 1 m]",
                     "aft: {from: [-0.1 m, -1 m, 1 m], to: [0.1 m, 1 m, 1 m]");
  return files;
}

// Force and moment of what the block's stress is computed from are those under which the dynamics
// moved it, which pulls at the places where the rope comes and leaves. Nothing else acts here, so
// that nothing is left to be spread over the mass.
TEST(SlingOverEdge, LoadsHaveForceAndMomentOfTheDynamics) {
  for (const auto& files : {sling_over_edge_lift(), sharp_edges(), oblique_edge()}) {
    const OverEdges lift(files);
    const Loads loads(lift);
    const dynamics::History& history = lift.run->dynamic_history();
    const dynamics::BodyHistory& body = history.body("load");
    double advance = 0, largest = 0;
    for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
      const structure::LoadCase load =
          map_instant(loads.in_motion, i, loads.attachment, lift.model->mass_properties());
      Eigen::Matrix<double, 6, 1> sum = loads.basis.resultants * load.added;
      for (std::size_t lug = 0; lug < load.lug_forces_B.size(); ++lug) {
        sum.head<3>() += load.lug_forces_B[lug];
        sum.tail<3>() += loads.attachment.lugs[lug].p_BPin.cross(load.lug_forces_B[lug]);
      }
      const Eigen::Matrix3d R_BW = body.X_WB(i).R.transpose();
      const Vector3 force = R_BW * Vector3(body.load.row(i).tail<3>());
      const Vector3 moment = R_BW * Vector3(body.load.row(i).head<3>());
      EXPECT_LT((sum.head<3>() - force).norm(), 1e-11 * force.norm()) << i;
      EXPECT_LT((sum.tail<3>() - moment).norm(), 1e-11 * force.norm()) << i;
      const dynamics::EdgeHistory& aft = lift.rope(history, 0).edges[0];
      advance = std::max(advance, std::abs(aft.last_place[i] - aft.first_place[i]));
      largest = std::max(largest, load.added.cwiseAbs().maxCoeff());
    }
    EXPECT_GT(largest, 1e3);
    if (files.block == oblique_edge().block) {
      EXPECT_GT(advance, 3e-3);  // R wrap times the slope
    }
  }
}

// The part of a helix's pull that a cylinder bears is the sum of pressure towards its axis.
TEST(SlingOverEdge, PushesAddUpToTheForceOnTheEdge) {
  const OverEdges lift(oblique_edge());
  const dynamics::History& history = lift.run->dynamic_history();
  const int rope = lift.run->model.ropes[0].rope;
  for (Eigen::Index i = 0; i < history.sample_count(); i += 7) {
    Vector3 sum = Vector3::Zero();
    for (const EdgePush& push : edge_pushes(history, i, lift.run->model.system, rope, 0))
      sum += push.force_B;
    const Vector3 force = lift.rope(history, 0).edges[0].force.row(i);
    EXPECT_LT((history.body("load").X_WB(i).R * sum - force).norm(), 1e-12 * force.norm());
  }
}

// A unit force along a line enters the plates with its moment, wherever they are beside it, and no
// node farther than they are carries of it.
TEST(LineLoads, HaveTheResultantOfAForceThroughTheMiddle) {
  const OverEdges& lift = over_edges();
  const structure::Space& space = lift.model->space();
  const structure::LineLoads lines(space);
  structure::LineStretch stretch;
  stretch.along_B = Vector3(0, 1, 0.2).normalized();
  stretch.half_length = 0.2;
  for (const Vector3& middle : {Vector3(0, 0.1, 1), Vector3(0.1, -0.95, 0.9)})
    for (const Vector3& aside : {Vector3(0, 0, 0), Vector3(-0.1, 0, 0.1)}) {
      stretch.middle_B = middle;
      stretch.to_plates_B = aside;
      const Eigen::MatrixXd loads = lines.unit_forces(stretch);
      for (int axis = 0; axis < 3; ++axis) {
        const structure::Wrench sum = structure::resultant(space, loads.col(axis));
        EXPECT_LT((sum.force - Vector3::Unit(axis)).norm(), 1e-13);
        EXPECT_LT((sum.moment - middle.cross(Vector3::Unit(axis))).norm(), 1e-13);
      }
    }
  EXPECT_NEAR(*lines.find_distance({2, 0.3, 1.25}, 1), 0.25, 1e-12);
  EXPECT_NEAR(*lines.find_distance({-0.3, 1.4, 0.5}, 1), 0.5, 1e-12);
  EXPECT_FALSE(lines.find_distance({2, 0, 2.5}, 1));
  stretch.middle_B = {2, 0, 3};
  EXPECT_THROW(lines.unit_forces(stretch), structure::ModelError);
}

TEST(SlingOverEdge, IsComplainedOfFarFromPlates) {
  test::SampleLift files = sling_over_edge_lift();
  files.block =
      with(files.block, "fore: {from: [4 m, -1 m, 1 m]", "fore: {from: [4 m, -1 m, 2.2 m]");
  const TemporaryFolder folder;
  files.write(folder);
  const LiftCase lift_case = read_lift_case(".");
  Diagnostics diagnostics;
  EXPECT_EQ(make_block_model(*lift_case.load.model, "plate", lift_case.structure, diagnostics),
            nullptr);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("plate.yaml:"));
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("edge fore runs at (4.106, -1, 2.306) m, and no "
                                               "plate of the block is within 1 m"));
}

/// The lift assessed in coarse elements.
Assessment assessed(const test::SampleLift& files, const TemporaryFolder& folder) {
  files.write(folder);
  LiftCase lift_case = read_lift_case(".");
  lift_case.structure.element_degree = 2;
  lift_case.structure.accuracy = 1;
  return assess(std::move(lift_case), OverEdges::nothing);
}

/// Force along x that the plates pass on between the pads and the middle web, N: a mean over
/// sections, by midpoints along each plate.
double force_through(const BlockRun& block, const structure::LoadCase& load) {
  const structure::SteelFinder finder(block.model->space());
  const Eigen::VectorXd motion = block.responses->displacement(load);
  double force = 0;
  const auto add = [&](const Vector3& from, const Vector3& to, double area) {
    constexpr int points = 20;
    const Vector3 normal = (to - from).cross(Vector3::UnitX()).normalized();
    for (int i = 0; i < points; ++i) {
      const Vector3 place = from + (i + 0.5) / points * (to - from);
      force += structure::stresses_at(*block.model, motion, finder.find(place, normal))(0, 0) *
               area / points;
    }
  };
  constexpr int sections = 15;
  for (int k = 0; k < sections; ++k) {
    const double x = 0.5 + (k + 0.5) / sections * 1.5;
    add({x, -1, 0}, {x, 1, 0}, 2 * 0.02 / sections);
    add({x, -1, 1}, {x, 1, 1}, 2 * 0.02 / sections);
    add({x, 0, 0}, {x, 0, 1}, 0.015 / sections);
  }
  return force;
}

// The box is a strut: at rest it is pressed by the level part of the slings' pull above, H = T
// sin(wrap), which comes by the edges: at the lugs the slings are plumb, or nearly so. All load
// cases are in balance, and the block's support bears nothing.
TEST(SlingOverEdge, PressesTheBlock) {
  for (const bool sharp : {false, true}) {
    const TemporaryFolder folder;
    const Assessment assessment = assessed(sharp ? sharp_edges() : sling_over_edge_lift(), folder);
    const BlockRun& block = assessment.block;
    ASSERT_TRUE(block.edges);
    EXPECT_LT(block.history->static_state.largest_force_residual, 1e-10);
    EXPECT_LT(block.history->dynamic_state.largest_moment_residual, 1e-10);
    for (const LoadComparison& loads : block.assessment.simultaneous_by_rope)
      EXPECT_LT(loads.dynamic_state.result.balance.reaction_over_weight, 1e-7);
    const LoadComparison& maxima = block.assessment.per_rope_maxima;
    EXPECT_LT(maxima.dynamic_state.result.balance.reaction_over_weight, 1e-7);
    EXPECT_GT(maxima.dynamic_state.load.added.norm(), 1e3);

    const dynamics::RopeHistory& sling = assessment.lift->static_history.rope("R1");
    const LoadComparison& most = block.assessment.simultaneous_by_rope[0];
    const Eigen::Index sample = Eigen::Index(std::find(assessment.lift->static_history.time.begin(),
                                                       assessment.lift->static_history.time.end(),
                                                       *most.static_state.time) -
                                             assessment.lift->static_history.time.begin());
    // Of a sharp edge the lug's pull has a small level part, too: together they are the pull above.
    const double pressed = std::abs(sling.first_force(sample, 0));
    EXPECT_GT(pressed, 2e4);
    EXPECT_NEAR(-force_through(block, most.static_state.load), pressed, 0.02 * pressed);
  }
}

// Round edges of 0.3 m across leave 1 - 0.5 / sqrt(4) = 3/4 of the breaking load of a wire rope of
// 75 mm, as long as it touches them.
TEST(SlingOverEdge, BendsTheRope) {
  test::SampleLift files = sling_over_edge_lift();
  files.rope += "diameter: 75 mm\n";
  const OverEdges lift(files);
  const std::vector<Check> checks = check_lift(lift.lift_case, *lift.run);
  const auto of = [&](const std::string& name) {
    for (const Check& check : checks)
      if (check.name.starts_with(name)) return check;
    throw std::logic_error(name);
  };
  EXPECT_NEAR(of("rope R1").limit, 0.75 * 1e6 / 5, 1e-6);
  EXPECT_THAT(of("rope R2").note,
              HasSubstr("bent round D/d 4.00 of edge fore: 75.0 % of the breaking load is left"));
  const std::vector<Check> without = check_lift(over_edges().lift_case, *over_edges().run);
  EXPECT_NEAR(without[0].limit, 1e6 / 5, 1e-6);
  EXPECT_THAT(without[0].note, HasSubstr("no loss by bending is counted"));
}

}  // namespace
}  // namespace blocklift::pipeline
