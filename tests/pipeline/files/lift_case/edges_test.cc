// Edges of a load that ropes may touch: what their keys mean, and what is said of mistakes in them.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/files/lift_case/lift_case.h"
#include "tests/pipeline/sling_over_edge_lift.h"

namespace blocklift::pipeline {
namespace {

using test::SampleLift;
using test::sling_over_edge_lift;
using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string complaints_about_edges(const SampleLift& lift) {
  const TemporaryFolder folder;
  lift.write(folder);
  Diagnostics diagnostics;
  ModelLibrary library({});
  const auto lift_case = read_lift_case("case.yaml", library, diagnostics);
  EXPECT_EQ(lift_case.has_value(), !diagnostics.has_errors());
  return diagnostics.to_text();
}

std::string about_block(const std::string& old_passage, const std::string& new_passage) {
  SampleLift lift = sling_over_edge_lift();
  lift.block = with(lift.block, old_passage, new_passage);
  return complaints_about_edges(lift);
}

std::string about_case(const std::string& old_passage, const std::string& new_passage) {
  SampleLift lift = sling_over_edge_lift();
  lift.lift_case = with(lift.lift_case, old_passage, new_passage);
  return complaints_about_edges(lift);
}

TEST(EdgesOfALoad, AreReadFromTheBlockAndNamedByRopes) {
  const TemporaryFolder folder;
  sling_over_edge_lift().write(folder);
  const LiftCase lift = read_lift_case(".");
  ASSERT_EQ(lift.ropes[1].edges.size(), 1U);
  const LoadEdge& edge = lift.ropes[1].edges[0];
  EXPECT_EQ(edge.name.value, "fore");
  EXPECT_DOUBLE_EQ(edge.length(), 2);
  EXPECT_DOUBLE_EQ(edge.radius, 0.15);
  EXPECT_DOUBLE_EQ(edge.contact_length, 0.3);
  EXPECT_NEAR(edge.outside.x(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(edge.distance_from_axis({4, 7, 3}), 2, 1e-15);
  EXPECT_EQ(lift.ropes[1].over[0].span.value, 1);
}

TEST(EdgesOfALoad, MayStandInAnySpanOfASlingFromLugToLug) {
  EXPECT_THAT(
      about_case("  R1: {from: C1.left, to: L1, over: [aft], model: ropes/tackle, length: "
                 "4 m}\n",
                 "  R1: {from: L1, through: [C1.left], to: L2, model: ropes/tackle, length: "
                 "8 m, over: [aft, {edge: fore, span: 2}]}\n"),
      IsEmpty());
}

TEST(EdgesOfALoad, UnknownName) {
  const std::string text = about_case("over: [fore]", "over: [for]");
  EXPECT_THAT(text, HasSubstr("case.yaml:"));
  EXPECT_THAT(text, HasSubstr("rope R2 runs over edge \"for\", which block plate does not have"));
  EXPECT_THAT(text, HasSubstr("its edges are aft, fore; did you mean \"fore\"?"));
  SampleLift lift = sling_over_edge_lift();
  lift.block = lift.block.substr(0, lift.block.find("edges:"));
  EXPECT_THAT(complaints_about_edges(lift),
              HasSubstr("it has no edges: declare them in its model file"));
}

TEST(EdgesOfALoad, WithoutLengthOrSide) {
  EXPECT_THAT(about_block("to: [0 m, 1 m, 1 m]", "to: [0 m, -1 m, 1 m]"),
              HasSubstr("has no length"));
  EXPECT_THAT(about_block("outside: [-1, 0, 1]", "outside: [0, 1, 0]"),
              HasSubstr("lies along the edge"));
  EXPECT_THAT(about_block("outside: [1, 0, 1], radius: 0.15 m", "outside: [1, 0, 1], radius: -1 m"),
              HasSubstr("radius"));
}

TEST(EdgesOfALoad, OfABlockStandInItsFile) {
  EXPECT_THAT(
      about_case("load: {model: plate,",
                 "load: {model: plate, edges: {rail: {from: [0 m, 0 m, 0 m], to: [1 m, 0 m, "
                 "0 m], outside: [0, 0, 1]}},"),
      HasSubstr("a block's edges stand in its model file"));
}

TEST(EdgesOfALoad, RoundALug) {
  const std::string text =
      about_block("outside: [-1, 0, 1], radius: 0.15 m", "outside: [-1, 0, 1], radius: 0.7 m");
  EXPECT_THAT(text, HasSubstr("lug L1 of rope R1 lies within the round of edge aft"));
}

TEST(EdgesOfALoad, SpansAndOrder) {
  EXPECT_THAT(about_case("over: [fore]", "over: [{edge: fore, span: 2}]"),
              HasSubstr("rope R2 runs over edge fore in span 2, and has one span"));
  EXPECT_THAT(about_case("over: [fore]", "over: [fore, fore]"), HasSubstr("twice in succession"));
  EXPECT_THAT(about_case("over: [fore]", "over: [fore, aft, fore, aft, fore, aft, fore]"),
              HasSubstr("more than 6 edges between two of its points"));
}

TEST(EdgesOfALoad, MayRub) {
  SampleLift lift = sling_over_edge_lift();
  lift.block = with(lift.block, "outside: [1, 0, 1],", "outside: [1, 0, 1], friction: 0.2,");
  lift.lift_case =
      with(lift.lift_case, "from: C1.left, to: L2, over: [fore]",
           "from: L1, through: [C1.left], to: L2, sheave_friction: 0.1, over: [aft, {edge: fore, "
           "span: 2}]");
  const TemporaryFolder folder;
  lift.write(folder);
  const LiftCase lift_case = read_lift_case(".");
  EXPECT_EQ(lift_case.ropes[0].edges[0].friction, 0.0);
  EXPECT_EQ(lift_case.ropes[1].edges[1].friction, 0.2);
  lift.rope = with(lift.rope, "axial_stiffness: 200 MN",
                   "tension_curve: [[0 %, 0 kN], [1 %, 500 kN], [2 %, 1500 kN]]");
  EXPECT_THAT(complaints_about_edges(lift),
              HasSubstr("rope R2 rubs on edge fore, and has a tension_curve"));
  EXPECT_THAT(about_block("outside: [1, 0, 1],", "outside: [1, 0, 1], friction: 2,"),
              HasSubstr("friction"));
}

// A sling from hook to hook holds the load without a lug.
TEST(EdgesOfALoad, MayBeAllThatHoldsIt) {
  SampleLift lift = test::basket_lift();
  EXPECT_THAT(complaints_about_edges(lift), IsEmpty());
  const TemporaryFolder folder;
  lift.write(folder);
  const LiftCase lift_case = read_lift_case(".");
  EXPECT_TRUE(lift_case.ropes[0].is_basket() && lift_case.ropes[0].is_sling());
  EXPECT_EQ(lift_case.hook_above(lift_case.ropes[0]), "C1.left");
  lift.lift_case =
      with(lift.lift_case, "R1: {from: C1.left, to: C1.left", "R1: {from: C1.left, to: C1.right");
  folder.write("case.yaml", lift.lift_case);
  const LiftCase apart = read_lift_case(".");
  EXPECT_EQ(apart.hook_above(apart.ropes[0]), "");
}

TEST(EdgesOfALoad, WhatDoesNotGoWithThem) {
  EXPECT_THAT(about_case("from: C1.left, to: L2", "from: C1.left, to: C1.left"),
              HasSubstr("rope R2 goes round edge fore alone, from a point and back to it"));
  EXPECT_THAT(about_case("settle: 5 s", "settle: 5 s\ndynamics: {flexibility: static}"),
              HasSubstr("runs over edges of the load, and the block is flexible"));
  SampleLift lift = sling_over_edge_lift();
  lift.rope += "diameter: 400 mm\n";
  EXPECT_THAT(complaints_about_edges(lift),
              HasSubstr("rope R1 of 0.4 m runs over edge aft, whose round is 0.3 m across"));
}

}  // namespace
}  // namespace blocklift::pipeline
