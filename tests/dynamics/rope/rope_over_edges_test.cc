// Ropes over edges: closed forms, the helix, the least length, the power of the forces.
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "dynamics/rope/edge_wrap.h"
#include "dynamics/rope/rope.h"

namespace blocklift::dynamics {
namespace {

using std::numbers::pi;

double length_of(const Vector3& first, const Vector3& last, std::span<const PlacedEdge> edges,
                 std::span<const EdgeTouch> touches) {
  double length = 0.0;
  Vector3 p = first;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!touches[i].touches) continue;
    length += (touches[i].first_W(edges[i]) - p).norm() + touches[i].arc(edges[i]);
    p = touches[i].last_W(edges[i]);
  }
  return length + (last - p).norm();
}

// Unrolled, a line round one edge is straight: over the tangents and the arc across the axis, and
// over what lies along it.
TEST(EdgeWrap, UnrollsToAStraightLine) {
  for (const double radius : {0.0, 0.7}) {
    const PlacedEdge edge{.radius = radius};
    const Vector3 a(-3, -5, -2), b(9, 4, -1);
    EdgeTouch touch;
    find_shortest_line(a, b, {&edge, 1}, {&touch, 1});
    ASSERT_TRUE(touch.touches);
    const double d_a = std::hypot(5, 2), d_b = std::hypot(4, 1);
    const double swept = pi + std::atan2(2, 5) + std::atan2(1, 4);
    const double wrap = swept - std::acos(radius / d_a) - std::acos(radius / d_b);
    EXPECT_NEAR(touch.wrap, wrap, 1e-14);
    const double across = std::sqrt(d_a * d_a - radius * radius) + radius * wrap +
                          std::sqrt(d_b * d_b - radius * radius);
    EXPECT_NEAR(length_of(a, b, {&edge, 1}, {&touch, 1}), std::hypot(across, 12.0), 1e-13);
  }
}

// It begins to touch where the straight line meets it, and its length is continuous there with its
// slope.
TEST(EdgeWrap, BeginsToTouchWithoutAKink) {
  const PlacedEdge edge{.radius = 0.5};
  const auto length = [&](double height) {
    const Vector3 a(0, -4, height), b(3, 4, height);
    EdgeTouch touch;
    find_shortest_line(a, b, {&edge, 1}, {&touch, 1});
    EXPECT_EQ(touch.touches, height < 0.5);
    return length_of(a, b, {&edge, 1}, {&touch, 1});
  };
  constexpr double h = 1e-4;
  EXPECT_NEAR(length(0.5 - h), length(0.5 + h), 1e-7);
  EXPECT_NEAR((length(0.5 - h) - length(0.5)) / h, 0.0, 1e-3);
}

// Round two lines that are not parallel: no place on them gives a shorter one, and its angles with
// each are the same on both sides. Round two cylinders: the conditions of Newton's method.
TEST(EdgeWrap, IsTheShortestRoundTwo) {
  for (const double radius : {0.0, 0.3}) {
    std::array<PlacedEdge, 2> edges;
    edges[0] = {
        .begin_W = {0, -2, 0}, .along_W = Vector3(1, 0.2, 0.1).normalized(), .radius = radius};
    edges[1] = {
        .begin_W = {0, 2, 0}, .along_W = Vector3(1, -0.3, 0.2).normalized(), .radius = radius};
    for (PlacedEdge& edge : edges)
      edge.outside_W = (Vector3::UnitZ() - edge.along_W.z() * edge.along_W).normalized();
    const Vector3 a(-1, -4, -6), b(2, 5, -7);
    std::array<EdgeTouch, 2> touches;
    find_shortest_line(a, b, edges, touches);
    ASSERT_TRUE(touches[0].touches && touches[1].touches);
    EXPECT_LT(EdgeConditions(a, b, edges, touches).residual().norm(), 1e-12);
    const double shortest = length_of(a, b, edges, touches);
    for (std::size_t i = 0; i < 2; ++i) {
      for (const double by : {-1e-3, 1e-3}) {
        std::array<EdgeTouch, 2> moved = touches;
        moved[i].first_place += by;
        moved[i].last_place += by;
        EXPECT_GT(length_of(a, b, edges, moved), shortest);
      }
    }
  }
}

// A block on a sling round its two lower edges, from one hook: 2 T cos(angle) = m g, and each edge
// bears T (u_out - u_in). Its rope over them has a load of both kinds of bend.
struct Cradle {
  double radius = 0.0;
  double hook_at = 0.0;  // m
  Mechanism mechanism = [] {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -9.80665});
    builder.add_body({.name = "load",
                      .joint = {.kind = JointKind::free},
                      .mass = 10e3,
                      .I_BBcm_B = Vector3(4e4, 5e4, 6e4).asDiagonal()});
    return builder.build();
  }();
  RopeDefinition rope(double unstretched) const {
    const Vector3 hook(hook_at, 0, 10);
    return {.name = "sling",
            .points = {{world_index, hook}, {world_index, hook}},
            .axial_stiffness = 20e6,
            .damping_time = 0.02,
            .unstretched_length = unstretched,
            .edges = {{.name = "port",
                       .body = 1,
                       .begin_B = {-3, -2, -1},
                       .end_B = {3, -2, -1},
                       .outside_B = {0, -1, -1},
                       .radius = radius},
                      {.name = "starboard",
                       .body = 1,
                       .begin_B = {-3, 2, -1},
                       .end_B = {3, 2, -1},
                       .outside_B = {0, 1, -1},
                       .radius = radius}}};
  }
};

TEST(RopeOverEdges, CradlesABlockByHand) {
  const Cradle cradle;
  const std::vector<Rope> ropes{Rope(cradle.mechanism, cradle.rope(26.0))};
  RopePath path = make_rope_path(ropes);
  Kinematics kinematics(cradle.mechanism);
  const Eigen::VectorXd q = cradle.mechanism.zero_configuration();
  const Eigen::VectorXd v = Eigen::VectorXd::Zero(6);
  compute_kinematics(cradle.mechanism, q, v, kinematics);
  ropes[0].calc_path(kinematics, path);
  EXPECT_NEAR(path.length, 2.0 * std::hypot(2, 11) + 4.0, 1e-12);
  std::vector<ForceVector> F(2, ForceVector::zero());
  ropes[0].add_forces(path, 1000.0, F);
  EXPECT_NEAR(F[1].force.z(), 2000.0 * 11.0 / std::hypot(2, 11), 1e-9);
  EXPECT_NEAR(F[1].force.head<2>().norm() + F[1].moment.norm(), 0.0, 1e-9);
}

// The forces spend -T dL/dt, and dL/dt is the slope of the length, at oblique and turning bodies.
TEST(RopeOverEdges, SpendsThePowerOfItsLength) {
  for (const double radius : {0.0, 0.4}) {
    const Cradle cradle{.radius = radius, .hook_at = 1.5};
    const std::vector<Rope> ropes{Rope(cradle.mechanism, cradle.rope(26.0))};
    RopePath path = make_rope_path(ropes);
    Kinematics kinematics(cradle.mechanism);
    Eigen::VectorXd v(6), q(7);
    v << 0.3, -0.2, 0.1, 0.5, -0.4, 0.2;
    cradle.mechanism.integrate(cradle.mechanism.zero_configuration(), v, 0.3, q);
    const auto length = [&](double time) {
      Eigen::VectorXd moved(7);
      cradle.mechanism.integrate(q, v, time, moved);
      compute_kinematics(cradle.mechanism, moved, v, kinematics);
      ropes[0].calc_path(kinematics, path);
      return path.length;
    };
    constexpr double h = 1e-5;
    const double slope = (length(h) - length(-h)) / (2.0 * h);
    length(0.0);
    ASSERT_TRUE(path.touches[0].touches && path.touches[1].touches);
    EXPECT_NEAR(path.length_rate, slope, 1e-7);
    std::vector<ForceVector> F(2, ForceVector::zero());
    ropes[0].add_forces(path, 3.0, F);
    EXPECT_NEAR(dot(F[1], kinematics.V_WB[1]), -3.0 * path.length_rate, 1e-10);
  }
}

}  // namespace
}  // namespace blocklift::dynamics
