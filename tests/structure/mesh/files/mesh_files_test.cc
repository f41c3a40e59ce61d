// Meshes of other programs: Abaqus' input, STEP, Nastran.
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/files/gmsh_session.h"
#include "structure/mesh/files/part_reader.h"
#include "structure/output/part_files.h"
#include "structure/part/part_solution.h"

namespace blocklift::structure {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

const Material steel{"steel", 200e9, 0, 8000, 235e6};

class MeshFiles : public ::testing::Test {
 protected:
  MeshFiles()
      : folder_(fs::temp_directory_path() / ("blocklift-meshes-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~MeshFiles() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static PartModel model_of(PartMesh mesh) {
    PartModel model;
    model.mesh = std::move(mesh);
    model.materials = {steel};
    model.material_of_solid.assign(model.mesh.solids.size(), 0);
    return model;
  }

  static void expect_group(const PartMesh& mesh, const std::string& name, int dimension,
                           std::size_t elements) {
    const PartGroup* group = mesh.find_group(name);
    ASSERT_NE(group, nullptr) << name;
    EXPECT_EQ(group->dimension, dimension) << name;
    EXPECT_EQ(group->elements.size(), elements) << name;
  }

  static std::string error_of(const std::string& path) {
    try {
      read_part_mesh(path, {});
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  }

 private:
  fs::path folder_;
};

// Two hexahedra, 2 x 1 x 1 m, with sets of each kind, an include and a step that is passed over.
const char* const two_bricks = R"(*HEADING
 two bricks
** a comment
*NODE, NSET=All
1, 0., 0., 0.
2, 1., 0.0D0, 0.
3, 2., 0., 0.
4, 0., 1., 0.
5, 1., 1., 0.
6, 2., 1., 0.
*INCLUDE, INPUT=upper.inc
*Element, type=C3D8R, elset=Bricks
1, 1, 2, 5, 4, 7, 8, 11,
10
2, 2, 3, 6, 5, 8, 9, 12, 11
*NSET, NSET=root, GENERATE
1, 10, 3
*NSET, NSET=corner
3
*NSET, NSET=both
ROOT, corner
*ELSET, ELSET=second
2,
*NSET, NSET=of_second, ELSET=SECOND
*SURFACE, NAME=end, TYPE=ELEMENT
second, S4
*SURFACE, NAME=bottom
bricks, S1
*MATERIAL, NAME=steel
*ELASTIC
2e11, 0.3
*STEP
*STATIC
*END STEP
)";
const char* const upper_nodes = "*NODE\n7,0,0,1\n8,1,0,1\n9,2,0,1\n10,0,1,1\n11,1,1,1\n12,2,1,1\n";

TEST_F(MeshFiles, AbaqusIncludesNothingFromOutsideItsFolder) {
  write("upper.inc", upper_nodes);
  std::string deck = two_bricks;
  deck.replace(
      deck.find("upper.inc"), 9,
      "../" + fs::path(write("bricks.inp", deck)).parent_path().filename().string() + "/upper.inc");
  EXPECT_EQ(error_of(write("bricks.inp", deck)), "");  // out and in again
  deck.replace(deck.find("../"), 3, "../../");
  EXPECT_THAT(error_of(write("bricks.inp", deck)),
              ::testing::AllOf(::testing::HasSubstr("bricks.inp:11: *INCLUDE: \"../../"),
                               ::testing::HasSubstr("lies outside the folder of this mesh")));
  fs::create_symlink("/etc/hostname", fs::path(write("unused", "")).parent_path() / "link.inc");
  deck = two_bricks;
  deck.replace(deck.find("upper.inc"), 9, "link.inc");
  EXPECT_THAT(error_of(write("bricks.inp", deck)), ::testing::HasSubstr("lies outside"));
}

// The lines of data of a keyword alone, below it or named by it.
TEST_F(MeshFiles, AbaqusReadsLinesOfDataFromFilesOfTheirOwn) {
  write("upper.inc", std::string(upper_nodes).substr(6));
  for (const char* how : {"*NODE\n*INCLUDE, INPUT=upper.inc", "*NODE, NSET=All, INPUT=upper.inc"}) {
    std::string deck = two_bricks;
    deck.replace(deck.find("*INCLUDE"), 25, how);
    EXPECT_EQ(error_of(write("bricks.inp", deck)), "") << how;
  }
  std::string deck = two_bricks;
  deck.replace(deck.find("*INCLUDE"), 25, "*NODE, INPUT=../../upper.inc");
  EXPECT_THAT(error_of(write("bricks.inp", deck)),
              ::testing::HasSubstr("bricks.inp:11: *NODE: \"../../upper.inc\" lies outside"));
}

TEST_F(MeshFiles, AbaqusSetsStayInBounds) {
  write("upper.inc", upper_nodes);
  const auto with_set = [&](const std::string& lines) {
    return error_of(write("bricks.inp", std::string(two_bricks) + lines));
  };
  EXPECT_THAT(with_set("*NSET, NSET=much, GENERATE\n1, 999999999999999999\n"),
              HasSubstr("bricks.inp:36: the set has more than 20000000 members"));
  std::string doubled = "*NSET, NSET=much\n1, 2\n";
  for (int i = 0; i < 40; ++i) doubled += "much, much\n";
  EXPECT_THAT(with_set(doubled), HasSubstr("more than 20000000 members"));
}

TEST_F(MeshFiles, ScriptsOfGmshReachNothingElse) {
  const std::string box = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n";
  const std::string aside = write("aside.geo", "");
  for (const std::string statement :
       {"SystemCall \"touch made\";", "Include \"aside.geo\";", "Merge \"aside.geo\";",
        "Printf(\"> %g\", 1) > \"made\";", "Save \"made.msh\";", "Parse [ \"x = 1;\" ];",
        "Field[1] = Structured;\nField[1].FileName = \"aside.geo\";"})
    for (const std::string ending : {".geo", ".shape", ".msh"})
      EXPECT_THAT(error_of(write("box" + ending, box + statement)),
                  ::testing::ContainsRegex("line [34]: [A-Za-z]+ may reach other files"))
          << statement << ending;
  EXPECT_EQ(error_of(write("box.geo", box + "// Include \"aside.geo\";\n/* Merge */ Printf(\"> "
                                            "Save; %g\", 1);\nMesh.MeshSizeMax = 1;\n")),
            "");
  // Allowed, it does what it says.
  ::setenv("BLOCKLIFT_ALLOW_OUTSIDE", "1", 1);
  EXPECT_EQ(error_of(write("box.geo", box + "Include \"aside.geo\";\n")), "");
  ::unsetenv("BLOCKLIFT_ALLOW_OUTSIDE");
}

TEST_F(MeshFiles, AbaqusSetsBecomeGroups) {
  write("upper.inc", upper_nodes);
  const PartMesh mesh = read_part_mesh(write("bricks.inp", two_bricks), {});
  EXPECT_EQ(mesh.solids.size(), 2u);
  EXPECT_EQ(mesh.kind(mesh.solids[0]).nodes, 20);  // raised
  expect_group(mesh, "Bricks", 3, 2);
  expect_group(mesh, "second", 3, 1);
  expect_group(mesh, "root", 2, 1);    // its nodes are those of a face
  expect_group(mesh, "corner", 0, 1);  // these are not
  expect_group(mesh, "both", 0, 5);
  expect_group(mesh, "of_second", 2, 5);  // its sixth face lies inside
  expect_group(mesh, "All", 2, 2);        // those of the first *NODE
  expect_group(mesh, "end", 2, 1);
  expect_group(mesh, "bottom", 2, 2);
}

// Raising the order and halving give the nodes other numbers: a set of one node stays at its place.
TEST_F(MeshFiles, SetsStayAtTheirPlacesWhenNodesAreRenumbered) {
  write("upper.inc", upper_nodes);
  const std::string file = write("bricks.inp", two_bricks);
  for (const int order : {1, 2})
    for (const int refinements : {0, 1, 2}) {
      PartReading reading;
      reading.element_order = order;
      reading.refinements = refinements;
      const PartMesh mesh = read_part_mesh(file, reading);
      const PartGroup* corner = mesh.find_group("corner");
      ASSERT_NE(corner, nullptr);
      ASSERT_EQ(corner->elements.size(), 1u);
      EXPECT_EQ(mesh.nodes.col(mesh.node(corner->elements[0], 0)), Vector3(2, 0, 0))
          << "order " << order << ", halved " << refinements << " times";
      expect_group(mesh, "both", 0, 5);
    }
}

// Gmsh itself would end the program here.
TEST_F(MeshFiles, ElementsWithoutTheirNodesAreNamed) {
  const std::string mesh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
      "$EndNodes\n$Elements\n1\n17 4 2 1 1 1 2 3 ";
  EXPECT_EQ(error_of(write("whole.msh", mesh + "4\n$EndElements\n")), "");
  EXPECT_THAT(error_of(write("torn.msh", mesh + "9\n$EndElements\n")),
              HasSubstr("element 17 names node 9, which does not exist"));
}

// Gmsh counts its errors beyond the end of a session, and raises no elements while there are any.
TEST_F(MeshFiles, ErrorsOfOneFileDoNotTouchTheNext) {
  write("wrong.msh", "$MeshFormat\n4.1 0 8\n$Nonsense\n");
  EXPECT_NE(error_of(path("wrong.msh")), "");
  write("upper.inc", upper_nodes);
  const PartMesh mesh = read_part_mesh(write("bricks.inp", two_bricks), {});
  EXPECT_EQ(mesh.kind(mesh.solids[0]).nodes, 20);
}

TEST_F(MeshFiles, AbaqusPartIsSolved) {
  write("upper.inc", upper_nodes);
  PartReading reading;
  reading.length_unit = 1e-3;
  PartModel model = model_of(read_part_mesh(write("bricks.inp", two_bricks), reading));
  model.supports = {{"root", "root", {true, true, true}, Vector3::Zero()}};
  model.surface_loads = {{"pull", "end", SurfaceLoad::Kind::force, 0, Vector3(100, 0, 0)}};
  const PartSolution solution = solve_part(model);
  EXPECT_NEAR(solution.all.von_mises, 100e6, 1);  // 100 N on 1 mm^2
  EXPECT_NEAR(solution.all.displacement, 2e-3 * 100e6 / 200e9, 1e-14);
}

TEST_F(MeshFiles, AbaqusMessagesNameFileAndLine) {
  write("upper.inc", upper_nodes);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = two_bricks;
    text.replace(text.find(from), from.size(), to);
    return error_of(write("wrong.inp", text));
  };
  EXPECT_THAT(changed("C3D8R", "B31"),
              AllOf(HasSubstr("wrong.inp:12: "), HasSubstr("B31"), HasSubstr("C3D20")));
  EXPECT_THAT(changed("3, 2., 0., 0.", "3, 2.x, 0., 0."),
              AllOf(HasSubstr("wrong.inp:7: "), HasSubstr("\"2.x\" is no coordinate")));
  EXPECT_THAT(changed("3, 2., 0., 0.", "2, 2., 0., 0."),
              AllOf(HasSubstr("wrong.inp:7: "), HasSubstr("node 2 is there twice")));
  EXPECT_THAT(changed("8, 9, 12, 11", "8, 9, 12, 13"),
              AllOf(HasSubstr("wrong.inp:15: "), HasSubstr("node 13, which does not exist")));
  EXPECT_THAT(changed("8, 9, 12, 11", "8, 9"),
              AllOf(HasSubstr("wrong.inp:16: "), HasSubstr("element 2 ends after 6 of 8 nodes")));
  EXPECT_THAT(changed("second, S4", "third, S4"),
              AllOf(HasSubstr("wrong.inp:26: "), HasSubstr("no element set \"third\"")));
  EXPECT_THAT(changed("second, S4", "second, S7"), HasSubstr("no face S7"));
  EXPECT_THAT(changed("upper.inc", "lower.inc"),
              AllOf(HasSubstr("wrong.inp:11: "), HasSubstr("lower.inc")));
  EXPECT_THAT(changed("ROOT, corner", "roots"), HasSubstr("no set \"roots\""));
}

// Gmsh writes the faces of a solid as plane elements, and its curves as trusses, beside it.
TEST_F(MeshFiles, AbaqusFacesBesideSolidsAreGroups) {
  const std::string solid = R"(*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
*ELEMENT, type=T3D2, ELSET=Line1
1, 1, 2
*ELEMENT, type=CPS3, ELSET=Surface1
2, 1, 3, 2
3, 1, 2, 4
*ELEMENT, type=C3D4, ELSET=Volume1
5, 1, 2, 3, 4
*ELSET, ELSET=edge
1
*ELSET, ELSET=floor
2
*NSET, NSET=corner
4
)";
  PartReading reading;
  reading.element_order = 1;
  const PartMesh mesh = read_part_mesh(write("solid.inp", solid), reading);
  EXPECT_EQ(mesh.solids.size(), 1U);
  expect_group(mesh, "floor", 2, 1);
  expect_group(mesh, "Surface1", 2, 2);
  expect_group(mesh, "Volume1", 3, 1);
  expect_group(mesh, "corner", 0, 1);
  EXPECT_EQ(mesh.find_group("edge"), nullptr);
}

// Mid-surfaces alone need the thickness of their plates.
TEST_F(MeshFiles, AbaqusSurfacesAreThickened) {
  const std::string file = write("plates.inp", R"(*NODE
1, 0, 0, 0
2, 2, 0, 0
3, 2, 1, 0
4, 0, 1, 0
*ELEMENT, type=CPS4, ELSET=Surface1
1, 1, 2, 3, 4
*ELSET, ELSET=deck
1
)");
  EXPECT_THAT(error_of(file), HasSubstr("of mid-surfaces say how thick they are: mesh: {plates:"));
  PartReading reading;
  reading.plates = {{"deck", 0.1}};
  PartModel model = model_of(read_part_mesh(file, reading));
  EXPECT_NEAR(find_part_mass(model).volume, 0.2, 1e-12);
}

/// A box of 20 x 3 x 2 in Gmsh's current model, meshed with tetrahedra and written.
void write_box(const std::string& path, bool meshed) {
  const GmshSession session;
  gmsh::model::occ::addBox(0, 0, 0, 20, 3, 2);
  gmsh::model::occ::synchronize();
  if (meshed) {
    gmsh::option::setNumber("Mesh.MeshSizeMax", 2);
    gmsh::option::setNumber("Mesh.SaveAll", 1);
    gmsh::model::mesh::generate(3);
  }
  gmsh::write(path);
}

// Faces of the box are known by their places: the ends at x = 0 and x = 20 mm.
void pull(PartMesh mesh) {
  std::string root, end;
  for (const PartGroup& group : mesh.groups) {
    if (group.dimension != 2) continue;
    double low = 1e9, high = -1e9;
    for (const int face : group.elements) {
      low = std::min(low, mesh.places(face).row(0).minCoeff());
      high = std::max(high, mesh.places(face).row(0).maxCoeff());
    }
    if (high < 1e-9) root = group.name;
    if (low > 20e-3 - 1e-9) end = group.name;
  }
  ASSERT_NE(root, "");
  ASSERT_NE(end, "");
  PartModel model;
  model.mesh = std::move(mesh);
  model.materials = {steel};
  model.material_of_solid.assign(model.mesh.solids.size(), 0);
  EXPECT_NEAR(find_part_mass(model).volume, 120e-9, 1e-15);
  model.supports = {{"root", root, {true, true, true}, Vector3::Zero()}};
  model.surface_loads = {{"pull", end, SurfaceLoad::Kind::force, 0, Vector3(600, 0, 0)}};
  EXPECT_NEAR(solve_part(model).all.von_mises, 100e6, 100);
}

TEST_F(MeshFiles, StepIsMeshedWithQuadraticTetrahedra) {
  write_box(path("box.step"), false);
  PartReading reading;
  reading.length_unit = 1e-3;
  reading.element_size = 2e-3;
  const PartMesh mesh = read_part_mesh(path("box.step"), reading);
  EXPECT_EQ(mesh.kind(mesh.solids[0]).name, "Tetrahedron 10");
  EXPECT_GT(mesh.solids.size(), 30u);
  reading.element_size = 1e-3;
  EXPECT_GT(read_part_mesh(path("box.step"), reading).solids.size(), 3 * mesh.solids.size());
  pull(mesh);
  // Refused before it is made: 120 mm^3 in tetrahedra of 1 micrometre.
  reading.element_size = 1e-6;
  reading.memory = 8e9;
  EXPECT_THROW(read_part_mesh(path("box.step"), reading), ModelError);
  reading.element_size = 2e-3;
  reading.refinements = 6;
  EXPECT_THROW(read_part_mesh(path("box.step"), reading), ModelError);
}

// OpenCASCADE turns what a STEP file declares into millimetres: a box of 20 x 3 x 2 units is as
// large as its file says, and whoever says another unit is told.
TEST_F(MeshFiles, StepHasTheUnitThatItDeclares) {
  write_box(path("box.step"), false);
  std::ifstream stream(path("box.step"));
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string millimetre = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );";
  ASSERT_NE(text.find(millimetre), std::string::npos);
  const std::string metre = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) );",
                    inch =
                        "( CONVERSION_BASED_UNIT('INCH',#9001) LENGTH_UNIT() NAMED_UNIT(#9003) "
                        ");\n#9001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#9002);\n"
                        "#9002 = " +
                        millimetre + "\n#9003 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);";
  for (const auto& [declaration, unit] :
       {std::pair{millimetre, 1e-3}, {metre, 1.0}, {inch, 0.0254}}) {
    std::string declared = text;
    const std::string file = write(
        "units.step", declared.replace(text.find(millimetre), millimetre.size(), declaration));
    PartReading reading;
    reading.element_size = 2 * unit;
    for (const double said : {0.0, unit}) {
      reading.length_unit = said;
      const PartMesh mesh = read_part_mesh(file, reading);
      EXPECT_LT(mesh.solids.size(), 500u) << unit;
      EXPECT_NEAR(find_part_mass(model_of(mesh)).volume, 120 * std::pow(unit, 3),
                  1e-9 * std::pow(unit, 3))
          << unit;
    }
    reading.length_unit = 0.01;
    try {
      read_part_mesh(file, reading);
      ADD_FAILURE() << unit;
    } catch (const ModelError& error) {
      EXPECT_THAT(error.what(), HasSubstr(fmt::format(
                                    "its lengths are in units of {:.4g} m, and length_unit that "
                                    "they are in units of 0.01 m",
                                    unit)));
    }
  }
}

TEST_F(MeshFiles, NastranIsRead) {
  write_box(path("box.bdf"), true);
  PartReading reading;
  reading.length_unit = 1e-3;
  PartMesh mesh = read_part_mesh(path("box.bdf"), reading);
  EXPECT_EQ(mesh.kind(mesh.solids[0]).name, "Tetrahedron 10");
  pull(std::move(mesh));
}

// A hexahedron and a wedge beside it, of all three kinds of fields, with middles, a coat, loads and
// constraints.
const char* const bulk = R"(SOL 101
CEND
BEGIN BULK
$ lower, upper, between
GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,2.,2.,0.
GRID,4,,0.,2.,0.
GRID    5               0.      0.      2.
GRID    6               2.      0.      2.0+0
GRID    7               2.      2.      2.
GRID    8               0.      2.      2.D0
GRID*   9                               4.              0.              *
*       0.
GRID*   10                              4.              0.              *
*       2.
CHEXA   7       3       1       2       3       4       5       6       +
+       7       8
CPENTA,8,4,2,9,3,6,10,7
CQUAD4,20,11,1,4,8,5
SPC1,5,123,1,4,5,8
SPC,6,9,3,0.
PLOAD4,9,8,1.,,,,2,10
PLOAD4,10,8,1.,,,,6
ENDDATA
)";

TEST_F(MeshFiles, NastranSetsBecomeGroups) {
  const PartMesh mesh = read_part_mesh(write("bulk.bdf", bulk), {});
  EXPECT_EQ(mesh.solids.size(), 2u);
  EXPECT_NEAR(find_part_mass(model_of(mesh)).volume, 12, 1e-12);
  expect_group(mesh, "property 3", 3, 1);
  expect_group(mesh, "property 4", 3, 1);
  expect_group(mesh, "property 11", 2, 1);
  expect_group(mesh, "constraint 5", 2, 1);
  expect_group(mesh, "constraint 6", 0, 1);
  expect_group(mesh, "load 9", 2, 1);
  expect_group(mesh, "load 10", 2, 1);
}

TEST_F(MeshFiles, NastranMessagesNameFileAndLine) {
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = bulk;
    text.replace(text.find(from), from.size(), to);
    return error_of(write("wrong.bdf", text));
  };
  EXPECT_THAT(changed("GRID,2,,2.", "GRID,2,7,2."),
              AllOf(HasSubstr("wrong.bdf:6: "), HasSubstr("coordinate system 7")));
  EXPECT_THAT(changed("GRID,2,,2.", "GRID,2,,2.x"), HasSubstr("\"2.x\" is no coordinate"));
  EXPECT_THAT(changed("GRID,2,", "GRID,1,"), HasSubstr("GRID 1 is there twice"));
  EXPECT_THAT(changed("2,9,3,6,10,7", "2,9,3,6,10,12"),
              AllOf(HasSubstr("wrong.bdf:19: "), HasSubstr("grid 12, which does not exist")));
  EXPECT_THAT(changed("6,10,7\n", "6,10,7\n,1\n"), HasSubstr("1 of its 9 grids between corners"));
  EXPECT_THAT(changed("1,4,8,5", "1,4,7,5"), HasSubstr("lies on no solid"));
  EXPECT_THAT(changed("1.,,,,2,10", "1.,,,,1,10"), HasSubstr("name no face of element 8"));
}

TEST_F(MeshFiles, CoordinatesAreFiniteNumbers) {
  write("upper.inc", upper_nodes);
  for (const char* number : {"nan", "-nan", "inf", "-inf", "1e999"}) {
    std::string text = two_bricks;
    text.replace(text.find("3, 2., 0., 0."), 13, std::string("3, ") + number + ", 0., 0.");
    EXPECT_THAT(error_of(write("wrong.inp", text)), HasSubstr("is no coordinate")) << number;
    text = bulk;
    text.replace(text.find("GRID,2,,2."), 10, std::string("GRID,2,,") + number);
    EXPECT_THAT(error_of(write("wrong.bdf", text)), HasSubstr("is no coordinate")) << number;
  }
}

// Gmsh and OpenCASCADE may do with damaged files what they like, but not in this process.
TEST_F(MeshFiles, DamagedGeometryIsReadOrRefused) {
  write_box(path("box.step"), false);
  std::ifstream stream(path("box.step"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  ASSERT_GT(lines.size(), 50u);
  PartReading reading;
  reading.length_unit = 1e-3;
  reading.element_size = 4e-3;
  reading.seconds_to_open = 2;
  for (std::size_t lost = 20; lost < lines.size(); lost += lines.size() / 8) {
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (i != lost) text += lines[i] + "\n";
    write("damaged.step", text);
    try {
      EXPECT_FALSE(read_part_mesh(path("damaged.step"), reading).solids.empty());
    } catch (const ModelError& error) {
      EXPECT_THAT(error.what(), HasSubstr("damaged.step"));
    }
  }
}

// Every kind comes back from our own file for CalculiX node by node; the file holds 12 digits, so
// that a coordinate of 1 to 2 m is off by 5e-12 m at most and the 60 of an element by 4e-11 m.
TEST_F(MeshFiles, CalculixInputIsReadBack) {
  for (const char* kind : {"", "Recombine Surface{1};"})
    for (const char* layer : {"", "Recombine;"})
      for (const int order : {1, 2}) {
        if (*kind != '\0' && *layer == '\0') continue;
        const std::string geometry =
            std::string("Point(1)={0,0,0};Point(2)={2,0,0};Point(3)={2,1,0};Point(4)={0,1,0};") +
            "Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};Curve Loop(1)={1,2,3,4};"
            "Plane Surface(1)={1};Transfinite Surface{1};Mesh.MeshSizeMax=1;" +
            kind + "Extrude{0,0,1}{Surface{1};Layers{1};" + layer + "}\n";
        PartReading reading;
        reading.element_order = order;
        const PartModel model = model_of(read_part_mesh(write("box.geo", geometry), reading));
        write_calculix(path("box.inp"), model);
        const PartMesh again = read_part_mesh(path("box.inp"), reading);
        ASSERT_EQ(again.solids.size(), model.mesh.solids.size());
        for (std::size_t s = 0; s < again.solids.size(); ++s)
          EXPECT_LT(
              (again.places(again.solids[s]) - model.mesh.places(model.mesh.solids[s])).norm(),
              4e-11)
              << again.describe(again.solids[s]);
      }
}

}  // namespace
}  // namespace blocklift::structure
