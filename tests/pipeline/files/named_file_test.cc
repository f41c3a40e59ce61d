#include "pipeline/files/named_file.h"

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/mechanism/mechanism_file.h"
#include "pipeline/files/structure/part_file.h"
#include "structure/outside_files.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::SampleLift;
using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

/// While it lives files outside are allowed.
struct Allowed {
  Allowed() { structure::allow_files_outside(); }
  ~Allowed() { ::unsetenv(structure::allow_outside_variable); }
  Allowed(const Allowed&) = delete;
  Allowed& operator=(const Allowed&) = delete;
};

/// What is said of a name in the file `inside/case.yaml`.
std::string said_of(const std::string& name) {
  Diagnostics diagnostics;
  const Located<std::string> located{
      name, {std::make_shared<const std::string>("inside/case.yaml"), 3, 7}};
  const auto path = path_of_named_file(located, "inside", diagnostics);
  EXPECT_EQ(path.has_value(), !diagnostics.has_errors());
  return diagnostics.to_text();
}

TEST(NamedFile, LeadsIntoItsFolderOrIsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  folder.write("inside/deep/a.csv", "");
  folder.write("inside-out/a.csv", "");
  folder.write("outside.csv", "");
  fs::create_symlink("../outside.csv", folder.path() / "inside/link.csv");
  fs::create_symlink("..", folder.path() / "inside/up");
  fs::create_symlink("deep", folder.path() / "inside/down");
  for (const std::string name : {"deep/a.csv", "down/a.csv", "deep/../deep/a.csv", "not-there.csv"})
    EXPECT_EQ(said_of(name), "") << name;
  EXPECT_EQ(said_of(folder.path() / "inside/deep/a.csv"), "");
  for (const std::string name : {"../outside.csv", "../not-there.csv", "link.csv", "up/outside.csv",
                                 "deep/../../outside.csv", "../inside-out/a.csv", "/etc/hostname",
                                 "/", "..", "up/not-there.csv"})
    EXPECT_THAT(
        said_of(name),
        ::testing::AllOf(HasSubstr("inside/case.yaml:3:7: error: \"" + name + "\" leads outside"),
                         HasSubstr("--allow-outside"), HasSubstr("BLOCKLIFT_ALLOW_OUTSIDE=1")));
  const Allowed allowed;
  EXPECT_EQ(said_of("../outside.csv"), "");
  EXPECT_EQ(said_of("/etc/hostname"), "");
}

TEST(NamedFile, MayLieAmongTheModelsWhoseLinksAreTrusted) {
  const TemporaryFolder folder;
  folder.write("models/ropes/a.yaml", "");
  folder.write("store/b.yaml", "");
  fs::create_symlink("../../store/b.yaml", folder.path() / "models/ropes/b.yaml");
  const std::vector<fs::path> homes{"inside"}, models{"models"};
  EXPECT_TRUE(is_within("../models/ropes/a.yaml", "inside", homes, models));
  EXPECT_TRUE(is_within("ropes/b.yaml", "models", homes, models));
  // The links of a case are not those of the installation.
  EXPECT_FALSE(is_within("../models/ropes/b.yaml", "inside", homes, models));
  EXPECT_FALSE(is_within("ropes/../../store/b.yaml", "models", homes, models));
}

/// What is said about the case in the folder `yard`, beside which the folder `elsewhere` has the
/// models and the measured series.
std::string said_of_case(const SampleLift& lift) {
  const TemporaryFolder folder;
  folder.write("yard/case.yaml", lift.lift_case);
  for (const std::string place : {"yard", "elsewhere"}) {
    folder.write(place + "/gantry.yaml", lift.crane);
    folder.write(place + "/plate.yaml", lift.block);
    folder.write(place + "/ropes/tackle.yaml", lift.rope);
  }
  Diagnostics diagnostics;
  ModelLibrary library({});
  read_lift_case("yard/case.yaml", library, diagnostics);
  return diagnostics.to_text();
}

TEST(NamedFile, HoldsForModelsAndSeriesOfACase) {
  SampleLift lift;
  lift.lift_case = with(lift.lift_case, "model: gantry", "model: ../elsewhere/gantry");
  EXPECT_THAT(said_of_case(lift),
              HasSubstr("yard/case.yaml:6:12: error: \"../elsewhere/gantry\" leads outside"));
  SampleLift measured;
  measured.lift_case += "  series: {R1: {file: ../elsewhere/gantry.yaml, unit: kN}}\n";
  EXPECT_THAT(said_of_case(measured), HasSubstr("\"../elsewhere/gantry.yaml\" leads outside"));
  const Allowed allowed;
  EXPECT_EQ(said_of_case(lift), "");
}

TEST(NamedFile, HoldsForTheDescriptionOfARobotAndTheMeshOfAPart) {
  const TemporaryFolder folder;
  folder.write("arm.urdf", "<robot/>");
  folder.write("inside/mechanism.yaml", "mechanism: arm\nurdf: ../arm.urdf\n");
  folder.write("inside/part.yaml",
               "part: bracket\nmesh: {file: ../bracket.inp, length_unit: m}\n"
               "materials: {steel: {young_modulus: 210 GPa, poisson_ratio: 0.3}}\n");
  Diagnostics of_mechanism, of_part;
  ModelLibrary library({});
  read_mechanism_file("inside/mechanism.yaml", library, of_mechanism);
  read_part_file("inside/part.yaml", of_part);
  EXPECT_THAT(of_mechanism.to_text(),
              HasSubstr("inside/mechanism.yaml:2:7: error: \"../arm.urdf\" leads outside"));
  EXPECT_THAT(of_part.to_text(),
              HasSubstr("inside/part.yaml:2:14: error: \"../bracket.inp\" leads outside"));
}

}  // namespace
}  // namespace blocklift::pipeline
