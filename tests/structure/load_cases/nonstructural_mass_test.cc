// Weight of what decks hang on plates and bars beyond their own mass, of each kind of element.
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "structure/load_cases/deck_loads.h"
#include "structure/mesh/mass_properties.h"
#include "structure/system/matter.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

struct HeavyDeck {
  std::string name;
  Deck deck;
  double mass = 0;  ///< kg
};

/// Bars are 2 m long from grid 1 to grid 2, plates 2 m2; gravity is 10 m/s2 along x.
Deck nastran_of(const std::string& cards, const std::string& control = "") {
  return test::nastran("SOL 101\nCEND\n" + control +
                       "SPC = 1\nLOAD = 3\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\n"
                       "GRID,3,,2.,1.,0.\nGRID,4,,0.,1.,0.\nMAT1,1,2.1+11,,0.3,7850.\n"
                       "MAT8,8,2.1+11,2.+10,0.3,5.+9,5.+9,5.+9,1500.\nSPC1,1,123456,1\n"
                       "GRAV,3,0,10.,1.,0.,0.\n" +
                       cards + "ENDDATA\n");
}

const std::string abaqus_plate =
    "*NODE\n1,0,0,0\n2,2,0,0\n3,2,1,0\n4,0,1,0\n*ELEMENT,TYPE=S4,ELSET=P\n1,1,2,3,4\n"
    "*MATERIAL,NAME=S\n*ELASTIC\n210e9,.3\n*DENSITY\n7850.,\n*SHELL SECTION,ELSET=P,MATERIAL=S\n"
    ".01\n*NONSTRUCTURAL MASS,ELSET=P,UNITS=TOTAL MASS\n20.\n*BOUNDARY\n1,1,6\n*STEP\n*STATIC\n"
    "*DLOAD\nP,GRAV,10.,1.,0.,0.\n*END STEP\n";

std::vector<HeavyDeck> heavy_decks() {
  const std::string beam = "CBEAM,1,1,1,2,0.,0.,1.\n", bar = "CBAR,1,1,1,2,0.,0.,1.\n",
                    plate = "CQUAD4,1,1,1,2,3,4\n", steel_plate = "PSHELL,1,1,0.01,1,,1\n" + plate;
  // 0.001 m2 of 7,850 kg/m3 and 10 kg/m: 17.85 kg/m.
  constexpr double even = 2 * 17.85;
  return {
      {"PBEAM", nastran_of("PBEAM,1,1,.001,2.-6,1.-6,0.,3.-6,10.\n" + beam), even},
      {"PBEAM, tapered",
       nastran_of("PBEAM,1,1,.001,2.-6,1.-6,0.,3.-6,10.\n,0.,0.,0.,0.,0.,0.,0.,0.\n"
                  ",YES,1.,.001,2.-6,1.-6,0.,3.-6,20.\n" +
                  beam),
       2 * 22.85},
      {"PBAR", nastran_of("PBAR,1,1,.001,2.-6,1.-6,3.-6,10.\n" + bar), even},
      {"PBARL", nastran_of("PBARL,1,1,,BAR\n,0.05,0.02,10.\n" + bar), even},
      {"PBEAML", nastran_of("PBEAML,1,1,,BAR\n,0.05,0.02,10.\n" + beam), even},
      {"PROD", nastran_of("PROD,1,1,.001,3.-6,0.,10.\nCROD,1,1,1,2\n"), even},
      {"CONROD", nastran_of("CONROD,1,1,2,1,.001,3.-6,0.,10.\n"), even},
      {"PTUBE", nastran_of("PTUBE,1,1,0.1,0.005,10.\nCTUBE,1,1,1,2\n"),
       2 * (7850 * M_PI * 0.25 * (0.01 - 0.0081) + 10)},
      {"PSHELL", nastran_of("PSHELL,1,1,0.01,1,,1,,10.\n" + plate), 2 * 88.5},
      {"PCOMP", nastran_of("PCOMP,1,,5.\n,8,0.01,0.,YES,8,0.01,90.,YES\n" + plate), 2 * 35.},
      {"NSM1", nastran_of("NSM1,7,PSHELL,10.,1\n" + steel_plate, "NSM = 7\n"), 2 * 88.5},
      {"*NONSTRUCTURAL MASS", test::abaqus(abaqus_plate), 2 * 88.5},
  };
}

/// A model of the deck; a yield stress comes with the block that names it.
ElasticModel heavy_model(const Deck& deck, std::optional<double> stated_mass = {}) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  return ElasticModel(std::move(mesh), {2, {}}, stated_mass);
}

TEST(NonstructuralMass, WeighsInEachKindOfElement) {
  for (const auto& [name, deck, mass] : heavy_decks()) {
    SCOPED_TRACE(name);
    EXPECT_NEAR(mass_properties(deck.mesh).mass, mass, 1e-9 * mass);
    const ElasticModel model = heavy_model(deck);
    EXPECT_NEAR(model.mass_properties().mass, mass, 1e-9 * mass);
    ASSERT_EQ(deck.load_cases.size(), 1U);
    const Wrench weight = resultant(model.space(), load_of(model, deck, deck.load_cases[0]));
    EXPECT_LT((weight.force - Vector3(10 * mass, 0, 0)).norm(), 1e-9 * mass);
  }
}

// A block's stated mass spreads what both lack of it over plates and their paint alike.
TEST(NonstructuralMass, CountsInAStatedMass) {
  const Deck deck = nastran_of("PSHELL,1,1,0.01,1,,1,,10.\nCQUAD4,1,1,1,2,3,4\n");
  const ElasticModel model = heavy_model(deck, 4 * 88.5);
  EXPECT_NEAR(model.mass_properties().steel_mass, 2 * 88.5, 1e-9);
  EXPECT_NEAR(model.mass_properties().factor_alpha, 2, 1e-12);
  EXPECT_NEAR(model.mass_properties().mass, 4 * 88.5, 1e-9);
}

}  // namespace
}  // namespace blocklift::structure
