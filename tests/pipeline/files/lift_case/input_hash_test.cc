#include "pipeline/files/lift_case/input_hash.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::SampleLift;
using test::TemporaryFolder;
using test::with;

std::string hash_of_case() {
  ModelLibrary library({});
  Diagnostics diagnostics;
  const auto lift_case = read_lift_case("case.yaml", library, diagnostics);
  EXPECT_TRUE(lift_case) << diagnostics.to_text();
  return lift_case ? hash_of_input(*lift_case) : "";
}

TEST(InputHash, ChangesWithEveryFileThatTheCaseNames) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.lift_case += "  series: {R2: {file: r2.csv, unit: t}}\n";
  lift.write(folder);
  folder.write("r2.csv", "0, 5\n2.5, 5.5\n");
  const std::string first = hash_of_case();
  EXPECT_EQ(hash_of_case(), first);
  folder.write("r2.csv", "0, 5\n2.5, 5.6\n");
  const std::string other_series = hash_of_case();
  EXPECT_NE(other_series, first);
  folder.write("ropes/tackle.yaml", with(lift.rope, "5 ms", "6 ms"));
  EXPECT_NE(hash_of_case(), other_series);
}

// The thickness stands in a file that the deck includes, and the mass is stated: only the bytes of
// that file tell the two apart.
TEST(InputHash, ChangesWithAFileThatADeckIncludes) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.block = R"(kind: block
mass: 10 t
centre_of_mass: [2 m, 0 m, 0 m]
mesh: {file: box.bdf, units: m-kg-N, yield_stress: 235 MPa}
lugs:
  L1: {node: 1}
  L2: {node: 2}
)";
  lift.write(folder);
  folder.write("box.bdf", R"(BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,4.,0.,0.
GRID,3,,4.,2.,0.
GRID,4,,0.,2.,0.
CQUAD4,1,1,1,2,3,4
MAT1,1,2.06+11,,.3,7850.
INCLUDE 'plate.bdf'
ENDDATA
)");
  folder.write("plate.bdf", "PSHELL,1,1,.02,1,,1\n");
  const std::string first = hash_of_case();
  folder.write("plate.bdf", "PSHELL,1,1,.02,1,,1,.9\n");
  EXPECT_NE(hash_of_case(), first);
}

}  // namespace
}  // namespace blocklift::pipeline
