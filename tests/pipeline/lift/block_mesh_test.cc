// Blocks that are read from decks.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/build/describe_block.h"
#include "pipeline/checks/padeye_assessment.h"
#include "pipeline/files/library/model_library.h"
#include "pipeline/lift/block_preparation.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/mesh/plates/shell_generator.h"
#include "tests/pipeline/lug_stresses.h"
#include "tests/pipeline/small_lift.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::shared_ptr<const BlockModel> read_block(const fs::path& file, std::string& complaints) {
  ModelLibrary library({});
  Diagnostics diagnostics;
  auto block = library.read_block(file, diagnostics);
  complaints = diagnostics.to_text();
  return block;
}

/// Writes shells as box.bdf, each lug a property of its own, and block.yaml beside it.
/// @param of_first what the first lug has besides its set and pin.
void write_as_deck(const test::TemporaryFolder& folder, const structure::Mesh& mesh,
                   const std::string& of_first = {}, const std::string& more = {}) {
  structure::Deck deck;
  deck.units = structure::unit_system("mm-t-N");
  deck.mesh = mesh;
  std::string lugs;
  long label = 100;
  for (const structure::LiftingPoint& lug : mesh.lifting_points) {
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
    lugs +=
        fmt::format("  {}: {{set: {}, pin: [{} m, {} m, {} m]{}}}\n", lug.name, lug.name,
                    lug.p_BPin.x(), lug.p_BPin.y(), lug.p_BPin.z(), label == 101 ? of_first : "");
  }
  structure::write_nastran(deck, "box.bdf");
  folder.write("block.yaml",
               "kind: block\nmesh: {file: box.bdf, units: mm-t-N}\nmass: 8 t\n"
               "centre_of_mass: [2.05 m, 1.48 m, 0.75 m]\nlugs:\n" +
                   lugs + more);
}

// The box of the small lift by its plates, and as a deck of their shells: eleven digits of each
// coordinate go through the file.
void expect_same_as_deck(const BlockModel& plates, const LiftCase& lift_case) {
  const test::TemporaryFolder folder;
  Diagnostics diagnostics;
  const auto of_plates = make_block_model(plates, "box", lift_case.structure, diagnostics);
  ASSERT_TRUE(of_plates) << diagnostics.to_text();
  write_as_deck(folder, of_plates->mesh());
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

TEST(BlockMesh, PlatesWrittenAsADeckAreTheSameBlock) {
  const LiftCase lift_case = test::read_small_lift();
  expect_same_as_deck(*lift_case.load.model, lift_case);
}

TEST(BlockMesh, SoAreStiffenersAsPlates) {
  const LiftCase lift_case = test::read_small_lift();
  BlockModel block = *lift_case.load.model;
  StiffenersModel row;
  row.spacing = 1;
  row.profile = structure::angle_bar(0.2, 0.01, 0.09, 0.012);
  row.are_plates = true;
  block.plates.front().stiffeners = row;
  expect_same_as_deck(block, lift_case);
}

const char* const small_padeye =
    "padeyes:\n  small: {radius: 120 mm, thickness: 30 mm, hole: 60 mm, pin: 57 mm, cheek_radius: "
    "90 mm, cheek_thickness: 10 mm, cheek_weld: 8 mm, tensile_strength: 490 MPa, divisions: 16}\n";

/// All padeyes of a case under vertical forces at its lugs.
PadeyesAssessment padeyes_under_a_table(const LiftCase& lift_case,
                                        const structure::ElasticModel& model) {
  const structure::UnitResponses responses(model);
  const structure::StressRecovery recovery(responses);
  const std::vector<Vector3> at_rest(4, Vector3(500, 300, 20e3));
  std::vector<Vector3> in_motion;
  for (const Vector3& force : at_rest) in_motion.push_back(1.1 * force);
  return assess_padeyes(lift_case, responses,
                        assess_load_table(responses, recovery, at_rest, in_motion));
}

// A padeye on a deck has the formulae and the fine mesh that the same one has on plates.
TEST(BlockMesh, APadeyeOnADeckIsThatOnPlates) {
  const test::TemporaryFolder folder;
  LiftCase lift_case = test::read_small_lift();
  Diagnostics diagnostics;
  const auto of_plates =
      make_block_model(*lift_case.load.model, "box", lift_case.structure, diagnostics);
  ASSERT_TRUE(of_plates) << diagnostics.to_text();
  const PadeyesAssessment expected = padeyes_under_a_table(lift_case, *of_plates);
  write_as_deck(folder, of_plates->mesh(),
                ", padeye: {design: small, axis: [0, 1, 0], up: [0, 0, 1], height: 250 mm, base: "
                "[400 mm, 400 mm]}",
                small_padeye);
  std::string complaints;
  lift_case.load.model = read_block("block.yaml", complaints);
  ASSERT_EQ(complaints, "");
  const auto of_deck =
      make_block_model(*lift_case.load.model, "box", lift_case.structure, diagnostics);
  ASSERT_TRUE(of_deck) << diagnostics.to_text();
  const PadeyesAssessment found = padeyes_under_a_table(lift_case, *of_deck);
  ASSERT_EQ(expected.padeyes.size(), 1u);
  ASSERT_EQ(found.padeyes.size(), 1u);
  const PadeyeAssessment &one = found.padeyes[0], &other = expected.padeyes[0];
  EXPECT_EQ(one.lug, "L1");
  EXPECT_EQ(one.input.material.yield_stress, other.input.material.yield_stress);
  ASSERT_EQ(one.formulas.size(), other.formulas.size());
  for (std::size_t i = 0; i < one.formulas.size(); ++i)
    EXPECT_NEAR(one.formulas[i].formula.utilisation, other.formulas[i].formula.utilisation, 1e-6);
  ASSERT_EQ(one.states.size(), other.states.size());
  for (std::size_t i = 0; i < one.states.size(); ++i) {
    const double stress = other.states[i].result.main_plate.checked_von_mises.value;
    EXPECT_NEAR(one.states[i].result.main_plate.checked_von_mises.value, stress, 1e-5 * stress);
    EXPECT_LT(one.states[i].result.force_residual, 1e-8);
  }
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

// What the deck's supports held, which a lift leaves out: the complaint says so.
TEST(BlockMesh, SupportsOfTheDeckThatHeldWhatIsLooseAreNamed) {
  const std::string mesh =
      "mesh: {file: box.bdf, units: mm-t-N, yield_stress: 355 MPa}\nlugs: {L1: {node: 9001}}\n";
  // A rod that only its support keeps from swinging.
  const std::string rod =
      "PLOTEL,9900,1,2\nGRID,8001,,-500.,0.,0.\nCONROD,8000,1,8001,7,500.\nSPC1,3,23,8001\n";
  const std::string swings = complaints_after(mesh, "PLOTEL,9900,1,2\n", rod);
  EXPECT_THAT(swings, HasSubstr("1 vertices can move in a direction that nothing there resists"));
  EXPECT_THAT(swings,
              HasSubstr("the deck's own supports hold node 8001 of it (constraint set 3); a "
                        "lift leaves them out"));
  // The same without a support: nothing is said of any.
  EXPECT_THAT(complaints_after(mesh, "PLOTEL,9900,1,2\n", rod.substr(0, rod.find("SPC1"))),
              Not(HasSubstr("own supports")));
  // A plate of its own, which stands on supports at two of its corners.
  EXPECT_THAT(complaints_after(mesh, "PLOTEL,9900,1,2\n",
                               "GRID,8001,,9000.,0.,0.\nGRID,8002,,9500.,0.,0.\nGRID,8003,,9500.,"
                               "500.,0.\nCTRIA3,8000,1,8001,8002,8003\nSPC1,3,123,8002,8003\n"),
              HasSubstr("the deck's own supports hold 2 nodes, such as 8002, of it (constraint "));
}

// Straight elements on curved ones are refused where something is fastened to a middle off the
// straight edge, and taken at degree 2.
TEST(BlockMesh, WhatIsFastenedToCurvedEdgesIsNotOfDegreeOne) {
  const test::TemporaryFolder folder;
  for (const bool is_fastened : {true, false}) {
    folder.write("plate.bdf",
                 std::string("BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\n"
                             "GRID,4,,0.,1.,0.\nGRID,5,,1.,0.,0.1\nGRID,6,,2.,.5,0.\n"
                             "GRID,7,,1.,1.,0.1\nGRID,8,,0.,.5,0.\nCQUAD8,1,1,1,2,3,4,5,6\n,7,8\n"
                             "PSHELL,1,1,.01,1,,1\nMAT1,1,2.1+11,,.3,7850.\n") +
                     (is_fastened ? "CONM2,9,6,,1.\nCONM2,10,5,,1.\n" : "CONM2,9,6,,1.\n") +
                     "ENDDATA\n");
    folder.write("block.yaml",
                 "kind: block\nmesh: {file: plate.bdf, units: m-kg-N, yield_stress: 355 MPa}\n"
                 "lugs: {L1: {node: 1}}\n");
    std::string complaints;
    const auto block = read_block("block.yaml", complaints);
    ASSERT_EQ(complaints, "");
    for (const int degree : {1, 2}) {
      Diagnostics diagnostics;
      StructureSettings settings;
      settings.element_degree = degree;
      settings.largest_element = 10;
      const bool is_refused = degree == 1 && is_fastened;
      EXPECT_EQ(make_block_model(*block, "plate", settings, diagnostics) == nullptr, is_refused);
      if (is_refused) {
        EXPECT_THAT(diagnostics.to_text(), HasSubstr("1 nodes to which something is fastened, 5 "));
        EXPECT_THAT(diagnostics.to_text(), HasSubstr("element_degree: 1"));
      } else {
        EXPECT_EQ(diagnostics.to_text(), "");
      }
    }
    Diagnostics diagnostics;  // the cheap check has no degree of its own
    check_block_model(*block, "plate", diagnostics);
    EXPECT_EQ(diagnostics.to_text(), "");
  }
}

/// What is said of a mechanism that only the whole stiffness shows.
std::string mechanism_of(const test::TemporaryFolder& folder, const std::string& supports) {
  // A door of one plate: two of its corners are hinged to two bars that stand out from the box.
  const fs::path source = fs::path(BLOCKLIFT_MESH_LIFT);
  std::ifstream deck_file(source / "box.bdf");
  std::string deck{std::istreambuf_iterator<char>(deck_file), {}};
  const std::string old_text = "PLOTEL,9900,1,2\n";
  deck.replace(deck.find(old_text), old_text.size(),
               "GRID,8001,,0.,0.,0.\nGRID,8002,,500.,0.,0.\nGRID,8003,,500.,-400.,0.\n"
               "GRID,8004,,0.,-400.,0.\nCQUAD4,8000,1,8001,8002,8003,8004\n"
               "RBE2,8005,1,123,8001\nRBE2,8006,2,123,8002\n" +
                   supports);
  folder.write("box.bdf", deck);
  folder.write("block.yaml",
               "kind: block\nmesh: {file: box.bdf, units: mm-t-N, yield_stress: 355 MPa}\n"
               "lugs: {L1: {node: 9001}}\n");
  std::string complaints;
  const auto block = read_block("block.yaml", complaints);
  EXPECT_EQ(complaints, "");
  Diagnostics diagnostics;
  StructureSettings settings;
  settings.element_degree = 1;
  settings.largest_element = 1;
  const auto model = make_block_model(*block, "box", settings, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  try {
    make_unit_responses(*model, *block);
  } catch (const InputError& error) {
    return error.what();
  }
  return "it is stiff";
}

TEST(BlockMesh, AMechanismIsWrongInputAndSaysWhatHeldItInTheDeck) {
  const test::TemporaryFolder folder;
  const std::string nothing = mechanism_of(folder, "");
  EXPECT_THAT(nothing, ::testing::StartsWith("block.yaml:"));
  EXPECT_THAT(nothing, HasSubstr("the block is a mechanism: a part of it can move"));
  // The edge away from the hinges moves most; what the box stands on has nothing to do with it.
  EXPECT_THAT(nothing, HasSubstr(", -0.4, 0) m, displacement along z)"));
  EXPECT_THAT(nothing, Not(HasSubstr("own supports")));
  EXPECT_THAT(mechanism_of(folder, "SPC1,7,123,8001,8002\n"), Not(HasSubstr("own supports")));
  EXPECT_THAT(mechanism_of(folder, "SPC1,7,12,8003,8004\n"), Not(HasSubstr("own supports")));
  EXPECT_THAT(mechanism_of(folder, "SPC1,7,3,8004\n"),
              HasSubstr("the deck's own supports hold node 8004 of it (constraint set 7); a lift "
                        "leaves them out: fasten it"));
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
  EXPECT_THAT(complaints_after(mesh, "PLOTEL,", "WRONG,"), ::testing::StartsWith("box.bdf:"));
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
  const auto padeye = [&](const std::string& stand) {
    return mesh + "lugs: {L1: {node: 9001, padeye: " + stand + "}}\n" + small_padeye;
  };
  say(padeye("{design: big, axis: [1, 0, 0], up: [0, 0, 1], height: 1 m, base: [1 m, 1 m]}"), "",
      "", "lug L1 names padeye \"big\", which the block does not have");
  say(padeye("{design: small, axis: [1, 0, 1], up: [0, 0, 1], height: 1 m, base: [1 m, 1 m]}"), "",
      "", "the pin's axis stands at 45 degrees on the padeye's upward direction");
  say(padeye("{design: small, axis: [1, 0, 0], up: [0, 0, 1], height: 1 m, base: [1 cm, 1 m]}"), "",
      "", "lug L1 cannot be made as padeye small: ");
  say(padeye("{design: small, axis: [1, 0, 0], up: [0, 0, -1], height: 1 m, base: [1 m, 1 m]}"), "",
      "", "where the block has no plate");
  // A mass whose link holds another node: it is left out, and the lift goes on.
  EXPECT_EQ(complaints_after(mesh, "RBE3,9102,,9002", "RBE3,9102,,9001"), "");
}

}  // namespace
}  // namespace blocklift::pipeline
