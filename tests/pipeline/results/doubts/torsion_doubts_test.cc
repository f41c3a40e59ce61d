// Bars of open section that a lift twists are told; boxes, which resist it, are not.
#include "pipeline/results/doubts/torsion_doubts.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/files/library/model_library.h"
#include "pipeline/lift/block_preparation.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

/// A beam of 4 m along x, lifted at arms of 1 m to either side at its ends, so that the ropes twist
/// it.
BlockRun twisted_beam(const std::string& section) {
  const test::TemporaryFolder folder;
  folder.write("beam.bdf",
               "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,4.,0.,0.\n"
               "GRID,11,,0.,1.,0.\nGRID,12,,4.,-1.,0.\nRBE2,21,1,123456,11\nRBE2,22,3,123456,12\n"
               "CBAR,1,5,1,2,0.,0.,1.\nCBAR,2,5,2,3,0.,0.,1.\nMAT1,7,206.+9,,.3,7850.\n" +
                   section + "ENDDATA\n");
  folder.write("block.yaml",
               "kind: block\nmesh: {file: beam.bdf, units: m-kg-N, yield_stress: 235 MPa}\n"
               "lugs: {A: {node: 11}, B: {node: 12}}\n");
  ModelLibrary library({});
  Diagnostics diagnostics;
  const auto block = library.read_block("block.yaml", diagnostics);
  BlockRun run;
  StructureSettings settings;
  settings.element_degree = 2;
  settings.largest_element = 1;
  run.model = make_block_model(*block, "beam", settings, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  run.responses = std::make_unique<structure::UnitResponses>(*run.model);
  const structure::StressRecovery recovery(*run.responses);
  const double half = 9.81 / 2 * run.model->mass_properties().mass;
  const std::vector<Vector3> forces(2, Vector3(0, 0, half));
  run.assessment = assess_load_table(*run.responses, recovery, forces, forces);
  return run;
}

// Half of the weight on an arm of 1 m is the torsion all along: T t / J of a channel with
// J = sum(b t^3) / 3 (Timoshenko and Goodier 1970, section 109), the walls' lines counted.
TEST(TorsionDoubts, AnOpenBeamThatIsTwistedIsTold) {
  const BlockRun run = twisted_beam("PBARL,5,7,,CHAN\n,.1,.2,.01,.01\n");
  const auto doubts = list_torsion_doubts(run);
  ASSERT_EQ(doubts.size(), 1U);
  const double length = 2 * 0.095 + 0.19, thickness = 0.01;
  const double weight = 9.81 * run.model->mass_properties().mass;
  const double shear = weight / 2 * thickness / (length * std::pow(thickness, 3) / 3);
  double told = 0;
  ASSERT_EQ(std::sscanf(doubts[0].c_str(), "Torsion makes %lf of", &told), 1) << doubts[0];
  EXPECT_NEAR(told, std::sqrt(3) * shear / 1e6, 0.05 * std::sqrt(3) * shear / 1e6);
  EXPECT_THAT(doubts[0], HasSubstr("in the open section of property 5"));
  EXPECT_THAT(doubts[0], HasSubstr("(dynamic loads of the table)"));
}

TEST(TorsionDoubts, ABoxIsNot) {
  EXPECT_TRUE(list_torsion_doubts(twisted_beam("PBARL,5,7,,BOX\n,.1,.2,.01,.01\n")).empty());
}

}  // namespace
}  // namespace blocklift::pipeline
