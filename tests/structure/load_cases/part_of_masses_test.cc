// Gravity and rotation on a part of a deck's masses.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_loads.h"
#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/system/matter.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

/// A cube of 1 m, a plate of 1 x 1 x 0.01 m with its middle 20 mm off its nodes along its side, a
/// bar of 1 m x 0.1 x 0.05 m on that, and a mass of 1000 kg at the bar's end.
std::string deck_of_all_kinds(const std::string& loads) {
  return "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n"
         "6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n9, 2., 0., 1.\n10, 2., 1., 1.\n"
         "11, 3., 1., 1.\n"
         "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
         "*ELEMENT, TYPE=S4, ELSET=PLATE\n2, 6, 9, 10, 7\n"
         "*ELEMENT, TYPE=B31, ELSET=BAR\n3, 10, 11\n*ELEMENT, TYPE=MASS, ELSET=POINT\n4, 11\n"
         "*MASS, ELSET=POINT\n1000.\n*ELSET, ELSET=NO_POINT\nCUBE, PLATE, BAR\n"
         "*MATERIAL, NAME=M\n*ELASTIC\n2.e11, 0.3\n*DENSITY\n7850.\n"
         "*SOLID SECTION, ELSET=CUBE, MATERIAL=M\n"
         "*SHELL SECTION, ELSET=PLATE, MATERIAL=M, OFFSET=2.\n0.01\n"
         "*BEAM SECTION, ELSET=BAR, MATERIAL=M, SECTION=RECT\n0.1, 0.05\n0., 0., 1.\n"
         "*BOUNDARY\nCUBE_FOOT, 1, 3\n6, 1, 6\n7, 1, 6\n*NSET, NSET=CUBE_FOOT\n1, 2, 3, 4\n"
         "*STEP\n*STATIC\n*DLOAD\n" +
         loads + "*END STEP\n";
}

Eigen::VectorXd load_in(const std::string& loads) {
  const Deck deck = test::abaqus(deck_of_all_kinds(loads));
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  const ElasticModel model(std::move(mesh), {2, {}});
  return load_of(model, deck, deck.load_cases.at(0));
}

Wrench sum_of(const std::string& loads) {
  const Deck deck = test::abaqus(deck_of_all_kinds(loads));
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  const ElasticModel model(std::move(mesh), {2, {}});
  return resultant(model.space(), load_of(model, deck, deck.load_cases.at(0)));
}

// What is pulled part by part is pulled as a whole.
TEST(PartOfMasses, PartsMakeTheWhole) {
  const std::string pull = ", GRAV, 9., 0.6, 0., -0.8\n";
  const std::string turn = ", CENTRIF, 100., 3., 1., 0.5, 0., 0.6, 0.8\n";
  for (const std::string& load : {pull, turn}) {
    const Eigen::VectorXd whole = load_in(load);
    const Eigen::VectorXd parts =
        load_in("CUBE" + load + "PLATE" + load + "BAR" + load + "POINT" + load);
    EXPECT_LT((whole - parts).norm(), 1e-12 * whole.norm());
    EXPECT_LT((load_in("NO_POINT" + load + "POINT" + load) - whole).norm(), 1e-12 * whole.norm());
  }
}

// Weights by hand: masses that are not in the set are not pulled. CalculiX 2.20 does so, too: a
// cube with a mass of 1000 kg on it, pulled by 10 m/s^2, presses by 10,000 N more if the mass is in
// the set.
TEST(PartOfMasses, MassesOutsideTheSetAreNotPulled) {
  const double density = 7850, pull = 10;
  const auto down = [](const std::string& set) {
    return sum_of(set + ", GRAV, 10., 0., 0., -1.\n").force.z();
  };
  EXPECT_NEAR(down("CUBE"), -pull * density, 1e-9 * pull * density);
  EXPECT_NEAR(down("PLATE"), -pull * density * 0.01, 1e-9 * pull * density);
  EXPECT_NEAR(down("BAR"), -pull * density * 0.005, 1e-9 * pull * density);
  EXPECT_NEAR(down("POINT"), -pull * 1000, 1e-9 * pull * density);
  EXPECT_NEAR(down("NO_POINT"), -pull * density * 1.015, 1e-9 * pull * density);
  // The plate's middle lies 20 mm below its nodes: pulled along x at (1.5, 0.5, 0.98) m.
  const Wrench aside = sum_of("PLATE, GRAV, 10., 1., 0., 0.\n");
  EXPECT_NEAR(aside.moment.y(), aside.force.x() * 0.98, 1e-6 * aside.force.x());
}

// A later step that pulls the same set again takes the place of the one before.
TEST(PartOfMasses, LaterStepsChangeThem) {
  const Deck deck = test::abaqus(deck_of_all_kinds("CUBE, GRAV, 10., 0., 0., -1.\n") +
                                 "*STEP\n*STATIC\n*DLOAD\ncube, GRAV, 3., 0., 1., 0.\n*END STEP\n");
  ASSERT_EQ(deck.load_sets.size(), 2U);
  ASSERT_EQ(deck.load_sets[1].pulls.size(), 1U);
  EXPECT_LT((deck.load_sets[1].pulls[0].acceleration - Vector3(0, 3, 0)).norm(), 1e-12);
  EXPECT_TRUE(deck.load_sets[1].is_on_masses());
  EXPECT_THROW(to_nastran(deck), ModelError);
  EXPECT_THROW(to_abaqus(deck), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
