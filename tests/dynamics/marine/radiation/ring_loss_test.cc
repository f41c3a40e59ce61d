#include "dynamics/marine/radiation/ring_loss.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/panels/rankine_problem.h"
#include "dynamics/marine/radiation/free_surface.h"

namespace blocklift::dynamics {
namespace {

constexpr double gravity = 9.81;

/// Around a hemisphere of 1 m.
PanelModel make_model(const SurfaceMeshSettings& settings, const Symmetry& symmetry = {}) {
  const std::vector<WettedBody> bodies{
      {"sphere", make_half_ellipsoid({1, 1, 1}, {.meridians = 24, .parallels = 4}),
       Vector3::Zero()}};
  return {bodies,
          make_surface_mesh(find_water_lines(bodies), settings),
          {1000.0, gravity, std::numeric_limits<double>::infinity()},
          symmetry};
}

/// W^1/2 f(r) for each panel, r its distance from the middle.
template <class Function>
Eigen::VectorXd elevation(const PanelModel& model, const Function& function) {
  Eigen::VectorXd values = model.surface_areas().cwiseSqrt();
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const Panel& panel = model.surface_mesh().panels[k];
    values[k] *= function(panel.centroid.norm());
  }
  return values;
}

// What is even or changes evenly on the way out stays, whatever the widths of the rings, but for
// their bends near the body.
TEST(RingLoss, LeavesWhatChangesEvenly) {
  const PanelModel model = make_model({.first_ring = 0.1, .radius = 20.0});
  const RingDifferences R = make_ring_differences(model.surface(), gravity);
  ASSERT_GT(R.rows(), 0);
  const Eigen::VectorXd even = elevation(model, [](double) { return 1.0; });
  const Eigen::VectorXd cone = elevation(model, [](double r) { return r; });
  EXPECT_LT((R * even).norm(), 1e-12 * even.norm());
  EXPECT_LT((R * cone).norm(), 1e-6 * cone.norm());
}

/// A row's panels: the one in the middle has the largest entry.
struct RowOfThree {
  Eigen::Index middle = 0;
  double distance = 0.0;  ///< from ring to ring, m
};

RowOfThree read_row(const RingDifferences& R, Eigen::Index row, const PanelModel& model) {
  RowOfThree three;
  double largest = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (RingDifferences::InnerIterator entry(R, row); entry; ++entry) {
    const double radius = model.surface_mesh().panels[entry.col()].centroid.norm();
    least = std::min(least, radius);
    most = std::max(most, radius);
    if (std::abs(entry.value()) < largest) continue;
    largest = std::abs(entry.value());
    three.middle = entry.col();
  }
  three.distance = 0.5 * (most - least);
  return three;
}

// On even rings a wave of the number k loses 0.1 sqrt(g/d) (2 sin(k d/2))^4 of its elevation in a
// second: next to nothing of it if many rings go into a wave.
TEST(RingLoss, GrowsWithTheFourthPowerOfTheWaveNumber) {
  const double width = 0.05;
  // Rings of polygons: where they go out to the edge's sides they are a hundredth closer.
  const PanelModel model = make_model({.first_ring = width, .growth = 1.0, .radius = 3.25});
  const RingDifferences R = make_ring_differences(model.surface(), gravity);
  const Eigen::VectorXd crests = elevation(model, [](double) { return 1.0; });
  for (const double in_a_ring : {0.25, 0.5, 1.0, 2.0, 3.0}) {
    const double k = in_a_ring / width;
    const Eigen::VectorXd wave = elevation(model, [&](double r) { return std::cos(k * r); });
    const Eigen::VectorXd quarter_on = elevation(model, [&](double r) { return std::sin(k * r); });
    // cos^2 + sin^2 of the rings that have one on either side.
    double expected = 0.0;
    for (Eigen::Index row = 0; row < R.rows(); ++row) {
      const auto [middle, d] = read_row(R, row, model);
      expected += crests[middle] * crests[middle] * 0.1 * std::sqrt(gravity / d) *
                  std::pow(2.0 * std::sin(k * d / 2.0), 4);
    }
    const double lost = (R * wave).squaredNorm() + (R * quarter_on).squaredNorm();
    EXPECT_NEAR(lost, expected, 0.01 * expected) << in_a_ring;
  }
}

// Beside a long barge the rings run along its side: waves that run off from it lose within the
// circle that holds the barge what its rings do not carry, waves along it nothing.
TEST(RingLoss, ActsBesideALongBarge) {
  const std::vector<WettedBody> bodies{
      {"barge", make_box_hull(100, 10, 5, {40, 4, 2, 1.0}), Vector3::Zero()}};
  const PanelModel model(bodies,
                         make_surface_mesh(find_water_lines(bodies),
                                           {.first_ring = 1.0, .growth = 1.1, .radius = 200.0}),
                         {1000.0, gravity});
  const RingDifferences R = make_ring_differences(model.surface(), gravity);
  const auto loss_of = [&](const auto& wave) {
    Eigen::VectorXd values = model.surface_areas().cwiseSqrt();
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      const Vector3& p = model.surface_mesh().panels[k].centroid;
      const bool beside = std::abs(p.x()) < 30.0 && std::abs(p.y()) < 40.0;
      values[k] *= beside ? wave(p) : 0.0;
    }
    const Eigen::VectorXd differences = R * values;
    double lost = 0.0;
    for (Eigen::Index row = 0; row < R.rows(); ++row) {
      const Vector3& p = model.surface_mesh().panels[read_row(R, row, model).middle].centroid;
      if (std::abs(p.x()) < 15.0 && std::abs(p.y()) < 25.0) lost += std::pow(differences[row], 2);
    }
    return lost;
  };
  const double away = loss_of([](const Vector3& p) { return std::cos(p.y()); });
  const double along = loss_of([](const Vector3& p) { return std::cos(p.x()); });
  EXPECT_GT(away, 0.0);
  EXPECT_LT(along, 0.02 * away);
}

// A quarter of the surface loses what the whole does: rows go outwards and cross no plane of
// symmetry.
TEST(RingLoss, CrossesNoPlaneOfSymmetry) {
  const SurfaceMeshSettings settings{.first_ring = 0.1, .radius = 10.0};
  const PanelModel whole = make_model(settings), quarter = make_model(settings, {true, true});
  const RingDifferences R = make_ring_differences(whole.surface(), gravity);
  const RingDifferences R_quarter = make_ring_differences(quarter.surface(), gravity);
  EXPECT_EQ(R.rows(), 4 * R_quarter.rows());
  const auto wave = [](double r) { return std::cos(3.0 * r); };
  const double lost = (R * elevation(whole, wave)).squaredNorm();
  EXPECT_NEAR(4.0 * (R_quarter * elevation(quarter, wave)).squaredNorm(), lost, 1e-9 * lost);
}

TEST(RingLoss, SkipsPanelsThatAreTakenTogether) {
  const PanelModel model = make_model({.first_ring = 0.1, .radius = 10.0});
  PanelClusters single;
  single.count = model.surface_mesh().size();
  single.of_panel.resize(single.count);
  std::iota(single.of_panel.begin(), single.of_panel.end(), 0);
  const RingDifferences R = make_ring_differences(model.surface(), gravity);
  EXPECT_EQ((R - make_ring_differences(model.surface(), gravity, &single)).norm(), 0.0);
  const PanelClusters some = cluster_panels(model.surface_mesh(), 0.5);
  ASSERT_LT(some.count, single.count);
  const RingDifferences fewer = make_ring_differences(model.surface(), gravity, &some);
  EXPECT_EQ(fewer.cols(), some.count);
  EXPECT_GT(fewer.rows(), 0);
  EXPECT_LT(fewer.rows(), R.rows());
}

// A loss that is strong enough has a say in the step; within that the march takes energy out alone.
TEST(RingLoss, IsStableUpToTheStepLimit) {
  const PanelModel model =
      make_model({.first_ring = 0.2, .growth = 1.25, .radius = 15.0}, {true, true});
  const RankinePart part(model, {1, 1});
  SurfaceDamping damping = DampingZone{0.0}.damping(model.surface(), gravity);
  const double without = FreeSurfaceMarch(part, {damping.rates}, gravity, 1).step_limit();
  damping.rings *= 5.0;
  FreeSurfaceMarch march(part, damping, gravity, 1);
  EXPECT_LT(march.step_limit(), without);
  march.start(part.surface_columns().col(0), march.step_limit());
  const double before = march.elevation().norm();
  for (int k = 0; k < 2000; ++k) march.advance();
  EXPECT_LT(march.elevation().norm(), before);
}

}  // namespace
}  // namespace blocklift::dynamics
