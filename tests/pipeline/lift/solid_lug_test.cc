// Lugs of a block that are solids, from their keys to the figures of a lift.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/files/library/model_library.h"
#include "pipeline/lift/block_preparation.h"
#include "pipeline/results/summaries/assumptions.h"
#include "structure/mesh/files/nastran/writer.h"
#include "tests/pipeline/small_lift.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

struct SolidLugBlock {
  std::shared_ptr<const BlockModel> block;
  std::string complaints;  ///< of its file and, without any, of its mesh
};

/// @param deck what tee.bdf is, beside the block.
SolidLugBlock block_of(const std::string& text, const std::string& deck = "") {
  const test::TemporaryFolder folder;
  folder.write("block.yaml", text);
  folder.write("tee.bdf", deck);
  ModelLibrary library({});
  Diagnostics diagnostics;
  SolidLugBlock result;
  result.block = library.read_block("block.yaml", diagnostics);
  if (!diagnostics.has_errors()) check_block_model(*result.block, "block", diagnostics);
  result.complaints = diagnostics.to_text();
  return result;
}

/// @param largest_element m. @returns null, and fails the test, if the block cannot be meshed.
std::unique_ptr<structure::ElasticModel> coarse_model_of(const BlockModel& block,
                                                         double largest_element) {
  StructureSettings settings;
  settings.element_degree = 2;
  settings.largest_element = largest_element;
  Diagnostics diagnostics;
  auto model = make_block_model(block, "block", settings, diagnostics);
  EXPECT_TRUE(model) << diagnostics.to_text();
  return model;
}

/// The block of the small lift after a change of its file.
std::string small_box_with(const std::string& old_text, const std::string& new_text) {
  std::ifstream file(fs::path(BLOCKLIFT_SMALL_LIFT) / "block.yaml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto place = text.find(old_text);
  EXPECT_NE(place, std::string::npos) << old_text;
  return text.replace(place, old_text.size(), new_text);
}

const char* const padeye_of_first = "padeye: small}";

std::string small_box_with_solid(const std::string& more = {}) {
  return small_box_with(padeye_of_first, "padeye: small, as: solid}") + more;
}

TEST(SolidLug, IsAskedForByAKey) {
  const SolidLugBlock read = block_of(small_box_with_solid());
  ASSERT_EQ(read.complaints, "");
  EXPECT_TRUE(read.block->lugs[0].is_solid.value);
  EXPECT_FALSE(read.block->lugs[1].is_solid.value);
  Diagnostics diagnostics;
  const auto model =
      make_block_model(*read.block, "box", test::read_small_lift().structure, diagnostics);
  ASSERT_TRUE(model) << diagnostics.to_text();
  const structure::Mesh& mesh = model->mesh();
  EXPECT_FALSE(mesh.solids.empty());
  EXPECT_GE(mesh.lifting_points[0].vertex, 0);
  EXPECT_EQ(mesh.lifting_points[1].vertex, -1);
  EXPECT_TRUE(std::all_of(mesh.solids.begin(), mesh.solids.end(), [&](const auto& solid) {
    return solid.region == mesh.lifting_points[0].region;
  }));
  EXPECT_NEAR(model->mass_properties().mass, 8000, 1e-6);
  const SolidLugBlock shells =
      block_of(small_box_with(padeye_of_first, "padeye: small, as: shells}"));
  EXPECT_EQ(shells.complaints, "");
  EXPECT_FALSE(shells.block->lugs[0].is_solid.value);
}

TEST(SolidLug, IsCopiedAndMirrored) {
  const std::string half =
      "kind: block\n"
      "materials: {S: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3, "
      "yield_stress: 355 MPa}}\n"
      "plates:\n"
      "  deck: {normal: z, at: 2 m, x: [0 m, 4 m], y: [-3 m, 3 m], thickness: 12 mm}\n"
      "  web: {normal: x, at: 1 m, y: [0 m, 3 m], z: [0 m, 2 m], thickness: 12 mm}\n"
      "pads: {P: {plate: web, normal: x, at: 1 m, y: [1 m, 3 m], z: [1 m, 2 m], thickness: 35 "
      "mm}}\n"
      "padeyes: {small: {radius: 120 mm, thickness: 30 mm, hole: 60 mm, pin: 57 mm}}\n"
      "lugs: {L: {pad: P, normal: x, at: 1 m, y: [2 m, 2.7 m], z: [2 m, 2.4 m], thickness: 35 mm, "
      "pin: [1 m, 2.3 m, 2.25 m], padeye: small, as: solid}}\n"
      "repeat:\n  - {parts: [web, P, L], count: 1, step: [2 m, 0 m, 0 m]}\n"
      "mirror:\n  - {parts: [web, P, L], normal: y, at: 0 m}\n";
  const SolidLugBlock read = block_of(half);
  ASSERT_EQ(read.complaints, "");
  const auto model = coarse_model_of(*read.block, 1);
  ASSERT_TRUE(model);
  ASSERT_EQ(model->lug_count(), 4);
  EXPECT_EQ(model->mesh().distributing_links.size(), 4U);
  for (const structure::LiftingPoint& point : model->mesh().lifting_points)
    EXPECT_LT((model->mesh().vertices[point.vertex] - point.p_BPin).norm(), 1e-12);
  // Mirror images move alike under forces across the deck.
  const structure::UnitResponses responses(*model);
  std::vector<double> moved;
  for (int lug = 0; lug < 4; ++lug)
    moved.push_back(
        model->lug_loads()
            .col(3 * lug + 2)
            .dot(responses.without_rigid_motion(responses.displacements().col(3 * lug + 2))));
  std::sort(moved.begin(), moved.end());
  EXPECT_NEAR(moved[1], moved[0], 1e-3 * moved[0]);
  EXPECT_NEAR(moved[3], moved[2], 1e-3 * moved[2]);
}

/// A plate by its corners, 2 m along u and 1.5 m along v, with a lug in its own plane.
std::string slope_with_lug(const std::string& pad, const std::string& lug) {
  return "kind: block\n"
         "materials: {S: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3, "
         "yield_stress: 355 MPa}}\n"
         "plates:\n"
         "  slope: {corners: [[0 m, 0 m, 0 m], [2 m, 0 m, 0 m], [2 m, 1.2 m, 0.9 m], "
         "[0 m, 1.2 m, 0.9 m]], thickness: 12 mm}\n"
         "  floor: {normal: z, at: 0 m, x: [0 m, 2 m], y: [0 m, 1.2 m], thickness: 12 mm}\n"
         "pads: {P: {plate: slope, u: [0.6 m, 1.4 m], v: " +
         pad +
         ", thickness: 30 mm}}\n"
         "padeyes: {small: {radius: 120 mm, thickness: 30 mm, hole: 60 mm, pin: 57 mm}}\n"
         "lugs: {L1: {pad: P, normal: n, at: 0 m, u: [0.7 m, 1.3 m], v: " +
         lug + ", padeye: small, as: solid}}\n";
}

TEST(SolidLug, StandsOnPlatesOfAnyOrientation) {
  const SolidLugBlock read = block_of(slope_with_lug(
      "[0.9 m, 1.5 m]", "[1.5 m, 1.9 m], thickness: 30 mm, pin: [1 m, 1.75 m, 0 m]"));
  ASSERT_EQ(read.complaints, "");
  const auto model = coarse_model_of(*read.block, 0.5);
  ASSERT_TRUE(model);
  const structure::LiftingPoint& point = model->mesh().lifting_points[0];
  const Vector3 pin(1, 1.75 * 0.8, 1.75 * 0.6);
  EXPECT_LT((point.p_BPin - pin).norm(), 1e-9);
  EXPECT_LT((model->mesh().vertices[point.vertex] - pin).norm(), 1e-9);
  const structure::UnitResponses responses(*model);
  structure::LoadCase load;
  load.lug_forces_B = {Vector3(1, 2, 3)};
  load.field = structure::balancing_field(model->mass_properties(),
                                          {load.lug_forces_B[0], pin.cross(load.lug_forces_B[0])});
  EXPECT_LT(responses.balance(load).reaction_over_weight, 1e-8);
}

TEST(SolidLug, WhatCannotBeOneIsSaidWithFileLineAndKey) {
  const auto say = [](const std::string& text, const std::string& wanted) {
    const std::string complaints = block_of(text).complaints;
    EXPECT_THAT(complaints, ::testing::StartsWith("block.yaml:"));
    EXPECT_THAT(complaints, HasSubstr(wanted));
  };
  say(small_box_with("pin: [3.6 m, 0 m, 2.25 m]}", "pin: [3.6 m, 0 m, 2.25 m], as: solid}"),
      "error: lug L2 is to be a solid and names no padeye");
  say(small_box_with(padeye_of_first, "padeye: small, as: solids}"), "did you mean \"solid\"?");
  say(small_box_with(padeye_of_first, "padeye: large, as: solid}"),
      "lug L1 names padeye \"large\", which the block does not have");
  say(small_box_with("z: [2 m, 2.4 m], thickness: 35 mm, pin: [0.4 m, 0 m, 2.25 m], padeye: small",
                     "z: [1.5 m, 1.9 m], thickness: 35 mm, pin: [0.4 m, 0 m, 1.7 m], padeye: "
                     "small, as: solid"),
      "lug L1 cannot be made as padeye small: it lies within its pad pad_1");
  const std::string braced = small_box_with(
      "plates:\n",
      "plates:\n  bracket: {normal: x, at: 0.4 m, y: [0 m, 0.4 m], z: [2 m, 2.3 m], thickness: 12 "
      "mm}\n");
  const auto with_key = [](std::string text) {
    const std::string old_text = padeye_of_first;
    return text.replace(text.find(old_text), old_text.size(), "padeye: small, as: solid}");
  };
  EXPECT_EQ(block_of(braced).complaints, "");
  say(with_key(braced), "error: lug L1 cannot be a solid: bracket at x = 0.4 m");
  say(with_key(braced), "as: shells takes any lug");
  // In the midst of its plate a lug is no padeye.
  say(slope_with_lug("[0.5 m, 0.9 m]", "[0.9 m, 1.3 m], thickness: 30 mm, pin: [1 m, 1.15 m, 0 m]"),
      "lug L1 cannot be a solid: slope is joined to its plate");
}

/// A floor with a web across its middle as a deck of squares of 0.2 m, mm-t-N.
std::string tee_deck() {
  std::string text = "SOL 101\nCEND\nBEGIN BULK\n";
  int grids = 0, elements = 0;
  std::map<std::array<int, 3>, int> grid_at;
  const auto grid = [&](int x, int y, int z) {
    const auto [found, is_new] = grid_at.try_emplace({x, y, z}, grids + 1);
    if (is_new) text += fmt::format("GRID,{},,{}.,{}.,{}.\n", ++grids, 200 * x, 200 * y, 200 * z);
    return found->second;
  };
  std::string cells;
  for (int x = 0; x < 10; ++x) {
    for (int y = 0; y < 6; ++y)
      cells += fmt::format("CQUAD4,{},1,{},{},{},{}\n", ++elements, grid(x, y, 0),
                           grid(x + 1, y, 0), grid(x + 1, y + 1, 0), grid(x, y + 1, 0));
    for (int z = 0; z < 5; ++z)
      cells += fmt::format("CQUAD4,{},2,{},{},{},{}\n", ++elements, grid(x, 3, z),
                           grid(x + 1, 3, z), grid(x + 1, 3, z + 1), grid(x, 3, z + 1));
  }
  return text + cells +
         "PSHELL,1,1,20.,1,,1\nPSHELL,2,1,30.,1,,1\n"
         "MAT1,1,206000.,,0.3,7.85-9,,,,\n,355.\nENDDATA\n";
}

SolidLugBlock mesh_block_of(const std::string& lugs, const std::string& deck = tee_deck()) {
  return block_of(
      "kind: block\nmesh: {file: tee.bdf, units: mm-t-N, yield_stress: 355 MPa}\n"
      "padeyes: {small: {radius: 120 mm, thickness: 40 mm, hole: 60 mm, pin: 57 mm}}\n"
      "lugs:\n" +
          lugs,
      deck);
}

/// A lug of a deck with how its padeye stands, and more of its keys.
std::string lug_of_deck(const std::string& name, const std::string& pin,
                        const std::string& more = ", as: solid") {
  return "  " + name + ": {pin: " + pin +
         ", padeye: {design: small, axis: [0, 1, 0], up: [0, 0, 1], height: 250 mm, base: [300 mm, "
         "300 mm]}" +
         more + "}\n";
}

const char* const pin_over_web = "[1 m, 0.6 m, 1.25 m]";
const char* const pin_over_floor = "[1.1 m, 0.3 m, 0.25 m]";

// On the edge of a web thinner than the padeye, and on a floor with nothing in its own plane below,
// between the grids of the deck.
TEST(SolidLug, StandsOnAMesh) {
  const SolidLugBlock read = mesh_block_of(lug_of_deck("L1", pin_over_web) +
                                           lug_of_deck("L2", pin_over_floor) + "  L3: {node: 5}\n");
  ASSERT_EQ(read.complaints, "");
  const auto model = coarse_model_of(*read.block, 0.3);
  ASSERT_TRUE(model);
  const structure::Mesh& mesh = model->mesh();
  ASSERT_EQ(mesh.lifting_points.size(), 3U);
  // Area of base, tangents and arc less the hole, which sixteen divisions have to 0.2 %.
  const double to_corner = std::hypot(0.3, 0.25), radius = 0.12;
  const double tangent = std::sqrt(to_corner * to_corner - radius * radius);
  const double arc =
      2 * std::numbers::pi - 2 * std::atan2(0.3, 0.25) - 2 * std::acos(radius / to_corner);
  const double padeye =
      7850 * 0.04 *
      (0.3 * 0.25 + tangent * radius + arc * radius * radius / 2 - std::numbers::pi * 0.03 * 0.03);
  const double plates = 7850 * 2 * (1.2 * 0.02 + 1 * 0.03);
  EXPECT_NEAR(model->mass_properties().mass, plates + 2 * padeye, 0.004 * padeye);
  EXPECT_EQ(mesh.groups.size(), 4U);
  EXPECT_EQ(mesh.groups[2].name, "L1");
  EXPECT_EQ(mesh.groups[3].name, "L2");
  std::set<long> labels;
  for (const auto& shell : mesh.shells) labels.insert(shell.label);
  for (const auto& solid : mesh.solids) labels.insert(solid.label);
  EXPECT_EQ(labels.size(), mesh.shells.size() + mesh.solids.size());
  EXPECT_EQ(*labels.rbegin(), static_cast<long>(labels.size()));
  const structure::UnitResponses responses(*model);
  structure::LoadCase load;
  load.lug_forces_B = {Vector3(1, 2, 3), Vector3(-2, 0.5, 1), Vector3::Zero()};
  structure::Wrench wrench{};
  for (int lug = 0; lug < 2; ++lug) {
    const Vector3& pin = mesh.lifting_points[lug].p_BPin;
    EXPECT_LT((mesh.vertices[mesh.lifting_points[lug].vertex] - pin).norm(), 1e-12);
    wrench.force += load.lug_forces_B[lug];
    wrench.moment += pin.cross(load.lug_forces_B[lug]);
  }
  load.field = structure::balancing_field(model->mass_properties(), wrench);
  EXPECT_LT(responses.balance(load).reaction_over_weight, 1e-8);
  // Across the floor the plate gives way, over the web the padeye stands on its edge.
  const auto moved = [&](int lug, int axis) {
    const Eigen::VectorXd unit =
        responses.without_rigid_motion(responses.displacements().col(3 * lug + axis));
    return model->lug_loads().col(3 * lug + axis).dot(unit);
  };
  EXPECT_GT(moved(1, 2), 5 * moved(0, 2));
}

/// The same floor and web as plates, with a padeye of solids on the web's edge.
const char* const tee_of_plates =
    "kind: block\n"
    "materials: {S: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3, "
    "yield_stress: 355 MPa}}\n"
    "plates:\n"
    "  floor: {normal: z, at: 0 m, x: [0 m, 2 m], y: [0 m, 1.2 m], thickness: 20 mm}\n"
    "  web: {normal: y, at: 0.6 m, x: [0 m, 2 m], z: [0 m, 1 m], thickness: 30 mm}\n"
    "pads: {P: {plate: web, normal: y, at: 0.6 m, x: [0.5 m, 1.5 m], z: [0.5 m, 1 m], thickness: "
    "45 mm}}\n"
    "padeyes: {small: {radius: 120 mm, thickness: 40 mm, hole: 60 mm, pin: 57 mm}}\n"
    "lugs: {L1: {pad: P, normal: y, at: 0.6 m, x: [0.7 m, 1.3 m], z: [1 m, 1.4 m], thickness: 45 "
    "mm, pin: [1 m, 0.6 m, 1.25 m], padeye: small, as: solid}}\n";

/// How the pin moves under unit forces there, without the motion as a whole, m/N.
Eigen::Matrix3d give_of_pin(const structure::ElasticModel& model) {
  const structure::UnitResponses responses(model);
  Eigen::Matrix3d give;
  for (int axis = 0; axis < 3; ++axis)
    give.col(axis) = model.lug_loads().leftCols<3>().transpose() *
                     responses.without_rigid_motion(responses.displacements().col(axis));
  return give;
}

// The plates of a block as a deck bear the same padeye in the same way.
TEST(SolidLug, OnAMeshIsThatOnPlates) {
  const SolidLugBlock plates = block_of(tee_of_plates);
  ASSERT_EQ(plates.complaints, "");
  const auto on_plates = coarse_model_of(*plates.block, 0.3);
  ASSERT_TRUE(on_plates);
  structure::Deck deck;
  deck.units = structure::unit_system("mm-t-N");
  deck.mesh = on_plates->mesh();
  deck.mesh.solids.clear();
  deck.mesh.surface_points.clear();
  deck.mesh.rigid_links.clear();
  deck.mesh.distributing_links.clear();
  deck.mesh.equations.clear();
  deck.mesh.lifting_points.clear();
  const SolidLugBlock read =
      mesh_block_of(lug_of_deck("L1", pin_over_web), structure::to_nastran(deck));
  ASSERT_EQ(read.complaints, "");
  const auto on_mesh = coarse_model_of(*read.block, 10);
  ASSERT_TRUE(on_mesh);
  EXPECT_EQ(on_mesh->mesh().shells.size(), on_plates->mesh().shells.size());
  EXPECT_EQ(on_mesh->mesh().solids.size(), on_plates->mesh().solids.size());
  // Eleven digits of a card.
  const Eigen::Matrix3d expected = give_of_pin(*on_plates), found = give_of_pin(*on_mesh);
  EXPECT_GT(expected.norm(), 0);
  EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm()) << found << "\nfor\n" << expected;
}

// A pin far from all nodes of a coarse deck is carried by what lies below its base.
TEST(SolidLug, StandsBetweenNodesThatAreFarApart) {
  const std::string deck =
      "SOL 101\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,4000.,0.,0.\nGRID,3,,4000.,3000.,0.\n"
      "GRID,4,,0.,3000.,0.\nCQUAD4,1,1,1,2,3,4\nPSHELL,1,1,20.,1,,1\n"
      "MAT1,1,206000.,,0.3,7.85-9,,,,\n,355.\nENDDATA\n";
  const SolidLugBlock read = mesh_block_of(lug_of_deck("L1", "[2 m, 1.5 m, 0.25 m]"), deck);
  ASSERT_EQ(read.complaints, "");
  EXPECT_TRUE(coarse_model_of(*read.block, 0.5));
}

TEST(SolidLug, WhatCannotStandOnAMeshIsSaid) {
  const auto say = [](const std::string& lugs, const std::string& wanted) {
    const std::string complaints = mesh_block_of(lugs).complaints;
    EXPECT_THAT(complaints, ::testing::StartsWith("block.yaml:5:"));
    EXPECT_THAT(complaints, HasSubstr(wanted));
  };
  say(lug_of_deck("L1", pin_over_web, ", node: 5, as: solid"), "lug L1, a solid, names a node");
  say(lug_of_deck("L1", pin_over_web, ", set: P, as: solid"), "lug L1, a solid, names a set");
  say(lug_of_deck("L1", pin_over_web, ", radius: 1 m, as: solid"), "lug L1, a solid, has a radius");
  say("  L1: {node: 5, as: solid}\n", "lug L1 is to be a solid and names no padeye");
  say(lug_of_deck("L1", pin_over_web, ", as: shell"), "did you mean \"shells\"?");
  say(lug_of_deck("L1", "[0.2 m, 0.6 m, 1.25 m]"), "where the block has no plate");
  // Down in the web.
  say(lug_of_deck("L1", "[1 m, 0.6 m, 0.25 m]"),
      "lug L1 cannot be a solid: the mesh has property 2 at (1, 0.6, 0.125) m already");
}

/// The small lift with its first lug as a solid or as shells.
Assessment lift_of(const std::string& block, Flexibility flexibility) {
  LiftCase lift_case = test::read_small_lift();
  const SolidLugBlock read = block_of(block);
  EXPECT_EQ(read.complaints, "");
  lift_case.load.model = read.block;
  lift_case.dynamics.flexibility = flexibility;
  return assess(std::move(lift_case), [](const std::string&, double, const std::string&) {});
}

double largest_of_padeye(const Assessment& assessment) {
  const PadeyeState& state = assessment.block.padeyes.padeyes.at(0).governing_state();
  return std::max(state.result.main_plate.checked_von_mises.value,
                  state.result.cheeks.checked_von_mises.value);
}

// A rigid block moves as with shells, since mass and centre are stated but for the inertia of the
// outfitting that makes up for the lug: its figures are close, and so are those of the fine padeye
// that the block drives along the same base.
TEST(SolidLug, ALiftHasNearlyTheFiguresThatShellsGive) {
  const Assessment solid = lift_of(small_box_with_solid(), Flexibility::rigid),
                   shells = lift_of(small_box_with(padeye_of_first, padeye_of_first),
                                    Flexibility::rigid);
  const auto& ours = solid.block.history->dynamic_state;
  const auto& theirs = shells.block.history->dynamic_state;
  EXPECT_NEAR(ours.checked_von_mises.at.value, theirs.checked_von_mises.at.value,
              0.05 * theirs.checked_von_mises.at.value);
  EXPECT_NEAR(largest_of_padeye(solid), largest_of_padeye(shells),
              0.05 * largest_of_padeye(shells));
  EXPECT_LT(ours.largest_force_residual, largest_balance_residual);
  EXPECT_EQ(solid.checks.size(), shells.checks.size());
  EXPECT_GT(solid.block.accuracy.steps.size(), 1U);  // shells were divided with the tie in place
  EXPECT_GT(solid.block.error.relative, 0);
  EXPECT_LT(solid.block.error.relative, 1);
  EXPECT_THAT(list_assumptions(solid),
              Contains(HasSubstr("Solids in the block are the padeyes of L1: they stand")));
  EXPECT_THAT(list_assumptions(shells), Not(Contains(HasSubstr("Solids in the block"))));
}

TEST(SolidLug, RopesFeelItGiveWay) {
  for (const Flexibility flexibility : {Flexibility::static_, Flexibility::modal}) {
    const Assessment lift = lift_of(small_box_with_solid(), flexibility);
    ASSERT_TRUE(lift.lift->elastic_displacement);
    EXPECT_GT(lift.lift->elastic_displacement->size, 0);
    EXPECT_LT(lift.lift->elastic_displacement->size, 0.05);
    EXPECT_LT(lift.block.history->dynamic_state.largest_force_residual, largest_balance_residual);
  }
}

}  // namespace
}  // namespace blocklift::pipeline
