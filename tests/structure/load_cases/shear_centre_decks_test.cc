// What decks say of shear centres: a cantilever, a channel of 200 x 80 mm and 1 m with its web
// upright, under a force of 1 kN at its node.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/beams/sections.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/stress/open_sections.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

const Profile upright_channel = channel(0.2, 0.008, 0.08, 0.012);

/// Of the loaded node about the beam, rad.
double turn_of_end(const Deck& deck) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  const ElasticModel model(std::move(mesh), {3, {}});
  const DeckSolution solution = solve_deck(model, deck, 1);
  return solution.cases.at(0).motion[6L * model.space().node_of_vertex(1) + 3];
}

Deck nastran_channel(const std::string& cards) {
  return test::nastran(
      "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n"
      "MAT1,7,2.1+11,,.3,7850.\nSPC1,1,123456,1\nFORCE,2,2,0,1000.,0.,1.,0.\n" +
      cards + "ENDDATA\n");
}

Deck abaqus_channel(const std::string& section) {
  return test::abaqus(
      "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n*ELEMENT, TYPE=B31, ELSET=B\n1, 1, 2\n"
      "*MATERIAL, NAME=M\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850.,\n" +
      section + "*BOUNDARY\n1, 1, 6\n*STEP\n*STATIC\n*CLOAD\n2, 2, 1000.\n*END STEP\n");
}

/// Where a deck's force goes through, from the shear centre along axis 3, m.
struct ChannelDeck {
  const char* name;
  Deck deck;
  double arm;
};

std::vector<ChannelDeck> channel_decks() {
  const BeamSection& s = upright_channel.section;
  const double c = s.shear_centre[1];
  const std::string shape = ",CHAN\n,.08,.2,.008,.012\n", beam = "CBEAM,1,5,1,2,0.,1.,0.\n";
  // Offsets of a CBEAM lead to the shear centre: these lay its centroid on the nodes.
  const std::string beside = beam + fmt::format(",,,0.,0.,{0:.9f},0.,0.,{0:.9f}\n", c);
  const std::string figures = fmt::format(
      "PBEAM,5,7,{:.9g},{:.9g},{:.9g},0.,{:.9g}\n,.1,.04,-.1,.04\n,.4,.4\n,,,,,0.,"
      "{:.9f},0.,{:.9f}\n",
      s.area, s.second_moment_3, s.second_moment_2, s.torsion, -c, -c);
  const std::string general = fmt::format(
      "*BEAM GENERAL SECTION, ELSET=B, SECTION=GENERAL, DENSITY=7850.\n{}, {}, 0., {}, "
      "{}\n0., 1., 0.\n2.1e11, 8.076923076923077e10\n*CENTROID\n0., 0.\n",
      s.area, s.second_moment_2, s.second_moment_3, s.torsion);
  // A channel's shear centre lies b^2 h^2 t / (4 I) behind its web: Timoshenko and Goodier (1970),
  // section 125, measures of the middle lines.
  const double b = 0.076, h = 0.188, t = 0.012;
  const double second = b * t * h * h / 2 + 0.008 * std::pow(h, 3) / 12;
  const double behind = b * b * h * h * t / (4 * second);
  return {{"PBEAML", nastran_channel(beam + "PBEAML,5,7," + shape), 0},
          {"PBEAML beside", nastran_channel(beside + "PBEAML,5,7," + shape), -c},
          {"PBEAM", nastran_channel(beam + figures), 0},
          {"PBEAM beside", nastran_channel(beside + figures), -c},
          {"PBARL", nastran_channel("CBAR,1,5,1,2,0.,1.,0.\nPBARL,5,7," + shape), 0},
          {"SHEAR CENTER", abaqus_channel(general + fmt::format("*SHEAR CENTER\n0., {}\n", c)), -c},
          {"no SHEAR CENTER", abaqus_channel(general), 0},
          {"ARBITRARY",
           abaqus_channel("*BEAM SECTION, ELSET=B, SECTION=ARBITRARY, MATERIAL=M\n"
                          "3, -.094, .076, -.094, 0., .012\n.094, 0., .008\n.094, .076, .012\n"
                          "0., 1., 0.\n"),
           behind}};
}

// A force that goes beside the shear centre by an arm a turns the end by F a l / G J about it.
TEST(ShearCentreOfDecks, TurnsByTheForcesArm) {
  const double torsion = upright_channel.section.torsion;
  const double most = 1000 * 0.0506 / (2.1e11 / 2.6 * torsion);
  for (const ChannelDeck& one : channel_decks()) {
    const double expected = -1000 * one.arm / (2.1e11 / 2.6 * torsion);
    EXPECT_NEAR(turn_of_end(one.deck), expected, 1e-6 * most) << one.name;
    // A deck that is written twists about the same point.
    EXPECT_NEAR(turn_of_end(test::nastran(to_nastran(one.deck))), expected, 1e-6 * most)
        << one.name;
    EXPECT_NEAR(turn_of_end(test::abaqus(to_abaqus(one.deck))), expected, 1e-6 * most) << one.name;
  }
}

// The channel under a force beside its shear centre is told, for it resists warping; through its
// shear centre it does not twist. T t / J of the flanges: Timoshenko and Goodier (1970), section
// 109.
TEST(ShearCentreOfDecks, TorsionThatGovernsAnOpenSectionIsFound) {
  const auto twisted_of = [](const Deck& deck) {
    Mesh mesh = deck.mesh;
    for (Material& material : mesh.materials) material.yield_stress = 235e6;
    const ElasticModel model(std::move(mesh), {3, {}});
    return find_twisted_open_bars(model.space(), solve_deck(model, deck, 1).cases.at(0).motion);
  };
  const std::vector<ChannelDeck> decks = channel_decks();
  EXPECT_TRUE(twisted_of(decks[0].deck).empty());
  const std::vector<TwistedBars> twisted = twisted_of(decks[1].deck);
  ASSERT_EQ(twisted.size(), 1U);
  const double arm = std::abs(upright_channel.section.shear_centre[1]);
  const double shear = 1000 * arm * 0.012 / upright_channel.section.torsion;
  EXPECT_NEAR(twisted[0].torsion, std::sqrt(3) * shear, 1e-3 * shear);
  EXPECT_GT(twisted[0].torsion, 0.5 * twisted[0].von_mises);
  EXPECT_LT(twisted[0].torsion, twisted[0].von_mises * (1 + 1e-9));
}

TEST(OpenSections, AreToldByTheirFigures) {
  EXPECT_TRUE(is_open_section(upright_channel.section));
  EXPECT_TRUE(is_open_section(angle_bar(0.15, 0.01, 0.09, 0.012).section));
  EXPECT_FALSE(is_open_section(flat_bar(0.15, 0.01).section));
}

}  // namespace
}  // namespace blocklift::structure
