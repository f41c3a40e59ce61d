// Joints that decks alone can say, in a solution: solids that go on plates, nodes tied to solids,
// equations.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/mesh/solid_shape.h"
#include "structure/system/matter.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

/// A strip along x, 0.4 m long, 0.1 m wide, 0.02 m thick: half of it of plates, then of solids,
/// whose nodes are none of the plates'.
/// @param joint keywords that join the surfaces EDGE and FACE.
Deck strip(const std::string& joint) {
  std::string text = "*NODE\n";
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j < 2; ++j)
      text += fmt::format("{}, {}, {}, 0.\n", 10 * i + j + 1, 0.05 * i, 0.1 * j);
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 2; ++j)
      for (int k = 0; k < 2; ++k)
        text += fmt::format("{}, {}, {}, {}\n", 1000 + 100 * i + 10 * j + k, 0.2 + 0.025 * i,
                            0.05 * j, k == 0 ? -0.01 : 0.01);
  text += "*ELEMENT, TYPE=S4, ELSET=PLATES\n";
  for (int i = 0; i < 4; ++i)
    text += fmt::format("{}, {}, {}, {}, {}\n", i + 1, 10 * i + 1, 10 * i + 11, 10 * i + 12,
                        10 * i + 2);
  text += "*ELEMENT, TYPE=C3D8, ELSET=SOLIDS\n";
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 2; ++j) {
      const int a = 1000 + 100 * i + 10 * j;
      text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", 100 + 2 * i + j, a, a + 100,
                          a + 110, a + 10, a + 1, a + 101, a + 111, a + 11);
    }
  // Of the solids at x = 0.2 m, whose fourth side is the sixth face.
  text += "*ELSET, ELSET=FIRST\n100, 101\n";
  text +=
      "*SHELL SECTION, ELSET=PLATES, MATERIAL=STEEL\n.02\n"
      "*SOLID SECTION, ELSET=SOLIDS, MATERIAL=STEEL\n"
      "*MATERIAL, NAME=STEEL\n*ELASTIC\n206.E9, .3\n*DENSITY\n7850.\n*PLASTIC\n235.E6, 0.\n"
      "*SURFACE, NAME=EDGE\n4, E2\n*SURFACE, NAME=FACE\nFIRST, S6\n";
  return abaqus(text + joint);
}

// A plate's edge and the face of solids under end load: as a strip of plates all along.
TEST(DeckJoints, SolidsGoOnAPlate) {
  const Deck deck = strip("*SHELL TO SOLID COUPLING, CONSTRAINT NAME=C\nEDGE, FACE\n");
  EXPECT_EQ(entry(deck, "*SHELL TO SOLID COUPLING").used, 1);
  const Space space(deck.mesh, {3, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& x) { return x.x() < 1e-9; }, {0, 1, 2, 3, 4, 5}, fixed);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  double count = 0;
  for (std::size_t v = 0; v < deck.mesh.vertices.size(); ++v)
    if (deck.mesh.vertices[v].x() > 0.4 - 1e-9) ++count;
  double deflection = 0;
  const double force = 100;
  for (std::size_t v = 0; v < deck.mesh.vertices.size(); ++v)
    if (deck.mesh.vertices[v].x() > 0.4 - 1e-9)
      load[6 * space.node_of_vertex(static_cast<int>(v)) + 2] = force / count;
  const Eigen::VectorXd motion = examples::solve(space, load, fixed);
  for (std::size_t v = 0; v < deck.mesh.vertices.size(); ++v)
    if (deck.mesh.vertices[v].x() > 0.4 - 1e-9)
      deflection += motion[6 * space.node_of_vertex(static_cast<int>(v)) + 2] / count;
  // Timoshenko's cantilever; its clamped end and the joint let the strip bend less across than a
  // bar, more than a plate: between the bar's stiffness and the plate's, 1 / (1 - nu^2).
  const double second_moment = 0.1 * 0.02 * 0.02 * 0.02 / 12;
  const double bar = force * 0.4 * 0.4 * 0.4 / (3 * 206e9 * second_moment);
  EXPECT_LT(deflection, 1.005 * bar);
  EXPECT_GT(deflection, 0.91 * bar);
}

// Without the coupling of rotations the plate would fold: the word for it.
TEST(DeckJoints, PlatesTiedToSolidsAreHinged) {
  const Deck deck = strip("*TIE, NAME=T\nEDGE, FACE\n");
  bool is_said = false;
  for (const DeckRemark& remark : deck.remarks)
    is_said |= remark.text.find("2 nodes of plates or beams follow solids") != std::string::npos;
  EXPECT_TRUE(is_said);
  // Three displacements of each.
  EXPECT_EQ(deck.mesh.equations.size(), 6U);
}

// A seesaw: a bar between two springs whose middle has the mean of its ends' motion by an equation
// instead of a stiffness. Half of a force on it goes to either end.
TEST(DeckJoints, ForcesOnWhatFollowsByAnEquation) {
  Deck deck = abaqus(R"(*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 3., 0., 0.
*ELEMENT, TYPE=SPRING1, ELSET=A
1, 1
*ELEMENT, TYPE=SPRING1, ELSET=B
2, 3
*SPRING, ELSET=A
3
1000.
*SPRING, ELSET=B
3
500.
*EQUATION
3
2, 3, 1., 1, 3, -.666667, 3, 3, -.333333
)");
  deck.mesh.groups = {{"none", 0}};
  const Space space(deck.mesh, {1, {}});
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  load[6 * space.node_of_vertex(1) + 2] = 90;
  const Eigen::VectorXd motion = examples::solve(space, load, {});
  EXPECT_NEAR(motion[6 * space.node_of_vertex(0) + 2], 0.06, 1e-12);
  EXPECT_NEAR(motion[6 * space.node_of_vertex(2) + 2], 0.06, 1e-12);
  EXPECT_NEAR(motion[6 * space.node_of_vertex(1) + 2], 0.06, 1e-12);
}

// A bay of a spar: a web that bears shear between two flanges and two posts, held at one post and
// pressed down at the other. q = P / b in the web; by its corners' forces the flanges have q a / 2
// all along: P delta = q^2 a b / (G t) + 2 (q a / 2)^2 a / (E A).
TEST(DeckJoints, AShearPanelInItsFrame) {
  Deck deck = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,.5,0.\nGRID,4,,0.,.5,0.\n"
      "CSHEAR,1,5,1,2,3,4\nPSHEAR,5,7,.003\nPROD,6,7,.0005\nMAT1,7,70.+9,,.3,2700.,,,\n,275.+6\n"
      "CROD,2,6,1,2\nCROD,3,6,2,3\nCROD,4,6,3,4\n");
  const Space space(deck.mesh, {1, {}});
  std::vector<FixedUnknown> fixed;
  const auto is_corner = [](const Vector3& x) { return std::abs(x.x() - 1) > 0.5; };
  examples::hold(space, is_corner, {2, 3, 4, 5}, fixed);
  examples::hold(
      space, [](const Vector3& x) { return x.x() < 0.5; }, {0, 1}, fixed);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  const double force = 1000;
  for (const int v : {1, 2}) load[6 * space.node_of_vertex(v) + 1] = -force / 2;
  const Eigen::VectorXd motion = examples::solve(space, load, fixed);
  const double a = 2, b = 0.5, modulus = 70e9, shear = modulus / 2.6;
  const double deflection =
      force * a / (shear * 0.003 * b) + force * a * a * a / (2 * b * b * modulus * 0.0005);
  for (const int v : {1, 2})
    EXPECT_NEAR(motion[6 * space.node_of_vertex(v) + 1], -deflection, 1e-9 * deflection);
}

}  // namespace
}  // namespace blocklift::structure::test
