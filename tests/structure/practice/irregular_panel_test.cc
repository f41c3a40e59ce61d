// Equivalent rectangles of panels that are none.

#include "structure/practice/irregular_panel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace blocklift::structure {
namespace {

using Vector2 = Eigen::Vector2d;
using Places = std::vector<Vector2>;

/// A strip round a bend, its arcs of `pieces` chords.
Places bend(double inner, double outer, double angle, int pieces) {
  Places outline;
  const auto add = [&](double radius, int i) {
    const double at = angle * (static_cast<double>(i) / pieces - 0.5);
    outline.emplace_back(radius * std::cos(at), radius * std::sin(at));
  };
  for (int i = 0; i <= pieces; ++i) add(outer, i);
  for (int i = pieces; i >= 0; --i) add(inner, i);
  return outline;
}

// Between the middles of its ends a strip is 2 r sin(angle / 2) long, r being its mean radius; its
// area is r angle w, of chords sin(s) / s of that, s being the angle of one.
TEST(IrregularPanel, StripRoundABendIsAsLongAsItsMiddleChord) {
  const double width = 0.6;
  for (const double angle : {0.5, 1.0, std::numbers::pi / 2}) {
    constexpr int pieces = 10;
    const auto found = equivalent_rectangle(bend(1.2, 1.2 + width, angle, pieces));
    ASSERT_TRUE(found);
    const double length = 2 * 1.5 * std::sin(angle / 2), step = angle / pieces;
    const double area = 1.5 * angle * width * std::sin(step) / step;
    EXPECT_NEAR(found->length, length, 1e-12);
    EXPECT_NEAR(found->width, area / length, 1e-12);
    EXPECT_NEAR(std::abs(found->along.y()), 1, 1e-12);
    EXPECT_GE(found->width, width * std::sin(step) / step);
    EXPECT_LE(found->width, 1.12 * width);
  }
}

// A trapezium's parallel sides are its long ones: as long as their mean, as wide as it is high,
// whatever the slope of the other two within 45 degrees.
TEST(IrregularPanel, TrapeziumIsAsLongAsItsMeanSide) {
  const auto found = equivalent_rectangle({{0, 0}, {3, 0}, {2.6, 0.5}, {0, 0.5}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->length, 2.8, 1e-12);
  EXPECT_NEAR(found->width, 0.5, 1e-12);
  // One that tapers towards an end counts with its wider end.
  const auto taper = equivalent_rectangle({{0, -0.5}, {4, -0.2}, {4, 0.2}, {0, 0.5}});
  ASSERT_TRUE(taper);
  EXPECT_NEAR(taper->length, 4, 1e-12);
  EXPECT_NEAR(taper->width, 1, 1e-12);
}

// Where the outline begins, which way round it runs, where it stands and its mirror image say
// nothing; nor do places along straight edges.
TEST(IrregularPanel, IsTheSameOfTheSameShape) {
  const Places outline = bend(0.8, 1.5, 1.1, 7);
  const auto expected = equivalent_rectangle(outline);
  ASSERT_TRUE(expected);
  const auto expect_same = [&](const Places& other) {
    const auto found = equivalent_rectangle(other);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->length, expected->length, 1e-12);
    EXPECT_NEAR(found->width, expected->width, 1e-12);
  };
  for (std::size_t first = 0; first < outline.size(); ++first) {
    Places other = outline;
    std::rotate(other.begin(), other.begin() + static_cast<std::ptrdiff_t>(first), other.end());
    expect_same(other);
    std::reverse(other.begin(), other.end());
    expect_same(other);
  }
  Places mirrored, moved, finer;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2 place = outline[i], next = outline[(i + 1) % outline.size()];
    mirrored.emplace_back(-place.x(), place.y());
    moved.emplace_back(3 + 0.6 * place.x() - 0.8 * place.y(), 0.8 * place.x() + 0.6 * place.y());
    finer.push_back(place);
    finer.push_back((place + next) / 2);
  }
  expect_same(mirrored);
  expect_same(moved);
  expect_same(finer);
}

// Triangles, discs, and outlines with steps have no four corners.
TEST(IrregularPanel, WhatIsNoQuadrangleHasNone) {
  EXPECT_FALSE(equivalent_rectangle({}));
  EXPECT_FALSE(equivalent_rectangle({{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(equivalent_rectangle({{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 2}, {0, 2}}));
  Places disc;
  for (int i = 0; i < 24; ++i)
    disc.emplace_back(std::cos(std::numbers::pi * i / 12), std::sin(std::numbers::pi * i / 12));
  EXPECT_FALSE(equivalent_rectangle(disc));
}

}  // namespace
}  // namespace blocklift::structure
