// Blocks that are read from decks.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/build/describe_block.h"
#include "pipeline/files/model_library.h"
#include "pipeline/lift/block_preparation.h"
#include "structure/index.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/mesh/plates/shell_generator.h"
#include "tests/pipeline/lug_stresses.h"
#include "tests/pipeline/small_lift.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using structure::at;
using testing::HasSubstr;
using testing::Not;

std::shared_ptr<const BlockModel> read_block(const fs::path& file, std::string& complaints) {
  ModelLibrary library({});
  Diagnostics diagnostics;
  auto block = library.read_block(file, diagnostics);
  complaints = diagnostics.to_text();
  return block;
}

// The box of the small lift by its plates, and as a deck of their shells: eleven digits of each
// coordinate go through the file.
TEST(BlockMesh, PlatesWrittenAsADeckAreTheSameBlock) {
  const test::TemporaryFolder folder;
  const LiftCase lift_case = test::read_small_lift();
  const BlockModel& plates = *lift_case.load.model;
  Diagnostics diagnostics;
  const auto of_plates = make_block_model(plates, "box", lift_case.structure, diagnostics);
  ASSERT_TRUE(of_plates) << diagnostics.to_text();

  structure::Deck deck;
  deck.units = structure::unit_system("mm-t-N");
  deck.mesh = of_plates->mesh();
  std::string lugs;
  long label = 100;
  for (const structure::LiftingPoint& lug : of_plates->mesh().lifting_points) {
    // Each lug a property, so that it is a group.
    for (structure::Shell& shell : deck.mesh.shells) {
      if (shell.region != lug.region) continue;
      if (deck.mesh.section_of(shell).label != label) {
        structure::ShellSection own = deck.mesh.section_of(shell);
        own.label = label;
        if (deck.mesh.shell_sections.back().label != label) deck.mesh.shell_sections.push_back(own);
      }
      shell.section = static_cast<int>(deck.mesh.shell_sections.size()) - 1;
    }
    ++label;
    lugs += fmt::format("  {}: {{set: {}, pin: [{} m, {} m, {} m]}}\n", lug.name, lug.name,
                        lug.p_BPin.x(), lug.p_BPin.y(), lug.p_BPin.z());
  }
  structure::write_nastran(deck, "box.bdf");
  folder.write("block.yaml",
               "kind: block\nmesh: {file: box.bdf, units: mm-t-N}\nmass: 8 t\n"
               "centre_of_mass: [2.05 m, 1.48 m, 0.75 m]\nlugs:\n" +
                   lugs);
  std::string complaints;
  const auto block = read_block("block.yaml", complaints);
  ASSERT_EQ(complaints, "");
  const auto of_deck = make_block_model(*block, "box", lift_case.structure, diagnostics);
  ASSERT_TRUE(of_deck) << diagnostics.to_text();
  EXPECT_NEAR(of_deck->mass_properties().steel_mass, of_plates->mass_properties().steel_mass,
              1e-9 * of_plates->mass_properties().steel_mass);
  EXPECT_LT(
      (of_deck->lug_loads().colwise().norm() - of_plates->lug_loads().colwise().norm()).norm(),
      1e-9);
  const Eigen::MatrixXd expected = test::lug_stresses(*of_plates),
                        found = test::lug_stresses(*of_deck);
  ASSERT_EQ(found.rows(), expected.rows());
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff());
}

TEST(BlockMesh, ALiftOfADeck) {
  const Assessment assessment = assess(read_lift_case(BLOCKLIFT_MESH_LIFT),
                                       [](const std::string&, double, const std::string&) {});
  const BlockRun& block = assessment.block;
  ASSERT_TRUE(block.model);
  EXPECT_NEAR(block.model->mass_properties().mass, 8000, 1e-6);
  // The plates by hand: areas times thickness, four bars of the T, half a tonne of pump.
  const double steel = 7850 * (12 * 0.020 + 16 * 0.015 + 18 * 0.012 + 0.25 * 0.035 +
                               4 * 4 * (0.1 * 0.012 + 0.188 * 0.008)) +
                       500;
  EXPECT_NEAR(block.model->mass_properties().steel_mass, steel, 1e-6 * steel);
  const BlockState& state = block.assessment.simultaneous.dynamic_state;
  EXPECT_LT(state.result.balance.reaction_over_weight, 1e-6);
  EXPECT_GT(state.result.checked_von_mises.value, 1e6);
  EXPECT_LT(state.result.checked_von_mises.value, 235e6);
  for (const auto& lug : state.result.lugs) EXPECT_GT(lug.checked_von_mises.value, 1e5) << lug.lug;
  EXPECT_FALSE(block.buckling.panels.empty());
  const std::string told = describe_block_mesh(*assessment.lift_case.load.model->mesh);
  for (const char* part : {"FORCE", "SPC1", "GRAV", "PLOTEL", "those of the lift"})
    EXPECT_THAT(told, HasSubstr(part));
  EXPECT_THAT(told, Not(HasSubstr("CQUAD4")));
}

/// What is said about the case's block after changes of its files.
std::string complaints_after(const std::string& block, const std::string& old_text,
                             const std::string& new_text) {
  const test::TemporaryFolder folder;
  const fs::path source = fs::path(BLOCKLIFT_MESH_LIFT);
  std::ifstream deck_file(source / "box.bdf");
  std::string deck{std::istreambuf_iterator<char>(deck_file), {}};
  if (!old_text.empty()) deck.replace(deck.find(old_text), old_text.size(), new_text);
  folder.write("box.bdf", deck);
  folder.write("block.yaml", "kind: block\n" + block);
  std::string complaints;
  const auto model = read_block("block.yaml", complaints);
  if (complaints.empty()) {
    Diagnostics diagnostics;
    check_block_model(*model, "box", diagnostics);
    complaints = diagnostics.to_text();
  }
  return complaints;
}

TEST(BlockMesh, WhatIsWrongIsSaidWithFileAndLine) {
  const std::string mesh = "mesh: {file: box.bdf, units: mm-t-N, yield_stress: 355 MPa}\n";
  EXPECT_EQ(complaints_after(mesh + "lugs: {L1: {node: 9001}}\n", "", ""), "");
  const auto say = [&](const std::string& block, const std::string& old_text,
                       const std::string& new_text, const std::string& wanted) {
    EXPECT_THAT(complaints_after(block, old_text, new_text), HasSubstr(wanted));
  };
  say(mesh, "CQUAD4,1,1,1,2,3,4", "CQUAD4,1,1,1,7777,3,4",
      ": error: CQUAD4: CQUAD4 1 names grid 7777");
  say(mesh, "PLOTEL,", "WRONG,", ": error: the card WRONG is not known here");
  EXPECT_THAT(complaints_after(mesh, "PLOTEL,", "WRONG,"), testing::StartsWith("box.bdf:"));
  const auto without = [](const std::string& cards) {
    return "mesh: {file: box.bdf, units: mm-t-N, yield_stress: 355 MPa, leave_out: [" + cards +
           "]}\nlugs: {L1: {node: 9001}}\n";
  };
  EXPECT_EQ(complaints_after(without("wrong"), "PLOTEL,", "WRONG,"), "");
  say(without("WRONG, CGAP"), "PLOTEL,", "WRONG,",
      "leave_out names CGAP, which the deck does not have");
  say(mesh + "lugs: {L1: {node: 12345}}\n", "", "",
      "block.yaml:3:19: error: lug L1 is at node 12345, of which the deck has none");
  say(mesh + "lugs: {L1: {set: lug plat}}\n", "", "", "did you mean \"lug plate\"?");
  say(mesh + "lugs: {L1: {pin: [9 m, 0 m, 0 m]}}\n", "", "", "is 5 m away; give a radius");
  say("mesh: {file: box.bdf, units: mm-t-N}\n", "", "", "the deck gives no yield stress of");
  say("mesh: {file: box.bdf, units: m-kg-N, yield_stress: 355 MPa}\n", "", "",
      "Is the deck in other units?");
  say("mesh: {file: box.stl, units: m-kg-N}\n", "", "", "is no file that is known by its ending");
  say("mesh: {file: none.bdf, units: m-kg-N}\n", "", "", "there is no file \"none.bdf\"");
  say(mesh +
          "lugs: {L1: {pad: p, normal: z, at: 0 m, x: [0 m, 1 m], y: [0 m, 1 m], thickness: "
          "20 mm, pin: [0 m, 0 m, 0 m]}}\n",
      "", "", "lug L1 stands on a pad, and the block is a mesh");
  say(mesh, "PLOTEL,9900,1,2",
      "GRID,8001,,9000.,0.,0.\nGRID,8002,,9500.,0.,0.\nGRID,8003,,9500.,500.,0.\n"
      "CTRIA3,8000,1,8001,8002,8003",
      "hang together with nothing else");
  // A mass whose link holds another node: it is left out, and the lift goes on.
  EXPECT_EQ(complaints_after(mesh, "RBE3,9102,,9002", "RBE3,9102,,9001"), "");
}

}  // namespace
}  // namespace blocklift::pipeline
