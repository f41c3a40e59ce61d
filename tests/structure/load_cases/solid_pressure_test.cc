// Pressures on faces of solids in a deck's own load cases.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/mesh/solid_shape.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double steel_modulus = 2e11, poisson = 0.3, pressure = 1e6;

const char* const steel_of_solids = "PSOLID,1,1\nMAT1,1,2.+11,,0.3,7850.\n";

/// A leaning box of solids of one shape; corners are numbered from 1.
struct Box {
  std::string card, type;                ///< of Nastran and Abaqus
  std::vector<std::vector<int>> solids;  ///< numbers of their corners
};

/// The box's corners by their bits (x 1, y 2, z 4), and its centre.
Vector3 place_of(int number) {
  Eigen::Matrix3d lean;
  lean << 1, 0.2, 0.3, 0, 1.5, -0.1, 0, 0, 0.8;
  if (number == 9) return lean * Vector3::Constant(0.5);
  const int bits = number - 1;
  return lean * Vector3(bits & 1, (bits >> 1) & 1, (bits >> 2) & 1);
}

const std::vector<Box>& boxes() {
  static const std::vector<Box> all{
      {"CHEXA", "C3D8", {{1, 2, 4, 3, 5, 6, 8, 7}}},
      {"CPENTA", "C3D6", {{1, 2, 4, 5, 6, 8}, {1, 4, 3, 5, 8, 7}}},
      {"CTETRA", "C3D4", {{1, 2, 3, 5}, {4, 3, 2, 8}, {6, 5, 8, 2}, {7, 8, 5, 3}, {2, 3, 5, 8}}},
      {"CPYRAM",
       "C3D5",
       {{1, 2, 4, 3, 9},
        {5, 7, 8, 6, 9},
        {1, 5, 6, 2, 9},
        {3, 4, 8, 7, 9},
        {1, 3, 7, 5, 9},
        {2, 6, 8, 4, 9}}}};
  return all;
}

std::string numbers(const std::vector<int>& list) {
  return fmt::format("{}", fmt::join(list, ","));
}

std::string box_cards(const Box& box) {
  const int count = box.card == "CPYRAM" ? 9 : 8;
  std::string text;
  for (int n = 1; n <= count; ++n) {
    const Vector3 place = place_of(n);
    text += fmt::format("GRID,{},,{:.8g},{:.8g},{:.8g}\n", n, place.x(), place.y(), place.z());
  }
  for (std::size_t s = 0; s < box.solids.size(); ++s)
    text += box.solids[s].size() == 8
                ? "CHEXA,1,1,1,2,4,3,5,6\n,8,7\n"
                : fmt::format("{},{},1,{}\n", box.card, s + 1, numbers(box.solids[s]));
  return text + steel_of_solids;
}

/// Held without strain: the first corner, a second against turning, a third in its plane.
const char* const held_box = "SPC1,1,123,1\nSPC1,1,23,2\nSPC1,1,3,3\n";

double depth_pressure(const Vector3& place) { return pressure * (2 - place.z() / 0.8); }

/// PLOAD4 of an outer face in the words of Nastran's manual; G1 is one corner or another.
std::string load_card(const Deck& deck, const SolidFace& face, int set, bool is_even) {
  const Solid& solid = deck.mesh.solids[face.solid];
  const std::size_t count = face.corners.size();
  const bool is_of_pyramid = solid.shape == SolidShape::pyramid && count == 3;
  const std::size_t first = is_of_pyramid ? face.corners[0] % 2 : (face.solid + 1) % count;
  const auto grid = [&](std::size_t i) { return solid.vertices[face.corners[i % count]] + 1; };
  std::string text = fmt::format("PLOAD4,{},{}", set, solid.label);
  for (std::size_t i = 0; i < 4; ++i) {
    const double value =
        is_even ? pressure : depth_pressure(place_of(grid(first + std::min(i, count - 1))));
    text += i < count ? fmt::format(",{:.8g}", value) : ",";
  }
  text += fmt::format(",{}", grid(first));
  if (count == 4) text += fmt::format(",{}", grid(first + 2));
  if (is_of_pyramid) text += fmt::format(",{}", grid(1 - first));
  if (solid.shape == SolidShape::tetrahedron)
    for (int i = 0; i < 4; ++i)
      if (std::find(face.corners.begin(), face.corners.end(), i) == face.corners.end())
        text += fmt::format(",{}", solid.vertices[i] + 1);
  return text + "\n";
}

Deck pressed_box(const Box& box) {
  const std::string cards = box_cards(box);
  const Deck bare = test::nastran(cards);
  std::string loads;
  for (const SolidFace& face : outer_faces(bare.mesh))
    loads += load_card(bare, face, 2, true) + load_card(bare, face, 3, false);
  return test::nastran(
      "SOL 101\nCEND\nSPC = 1\nSUBCASE 1\n LOAD = 2\nSUBCASE 2\n LOAD = 3\nBEGIN BULK\n" + cards +
      held_box + loads + "ENDDATA\n");
}

ElasticModel quadratic_model(const Deck& deck) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  return {std::move(mesh), {2, {}}};
}

DeckSolution solve(const Deck& deck) { return solve_deck(quadratic_model(deck), deck, 1); }

/// Under even pressure p all around every length shrinks by p (1 - 2 nu) / E.
void expect_even_compression(const Deck& deck, const DeckCaseSolution& solution,
                             const std::string& what) {
  const double strain = -pressure * (1 - 2 * poisson) / steel_modulus;
  const ElasticModel model = quadratic_model(deck);
  for (int v = 0; v < static_cast<int>(deck.mesh.vertices.size()); ++v) {
    const Vector3 moved = solution.motion.segment<3>(6L * model.space().node_of_vertex(v));
    // The box leans by the seven digits of its deck; nothing turns it but rounding of these.
    const Vector3 expected = strain * deck.mesh.vertices[v];
    EXPECT_LT((moved - expected).norm(), 1e-6 * std::abs(strain)) << what << ", vertex " << v;
  }
  for (const SupportReaction& reaction : solution.reactions)
    EXPECT_LT(reaction.force.norm(), 1e-6 * pressure) << what;
}

TEST(SolidPressure, EvenAllAroundCompressesEverySolidEvenly) {
  for (const Box& box : boxes()) {
    const Deck deck = pressed_box(box);
    expect_even_compression(deck, solve(deck).cases.at(0), box.card);
  }
}

// Archimedes: a pressure that falls with height as rho g z does carries the box with the weight of
// the water in its place, through the middle of its volume.
TEST(SolidPressure, LinearPressureCarriesLikeWater) {
  for (const Box& box : boxes()) {
    const DeckSolution solution = solve(pressed_box(box));
    const Wrench& applied = solution.cases.at(1).applied;
    const Vector3 lift(0, 0, pressure / 0.8 * 1.5 * 0.8);
    EXPECT_LT((applied.force - lift).norm(), 1e-6 * lift.norm()) << box.card;
    EXPECT_LT((applied.moment - place_of(9).cross(lift)).norm(), 1e-6 * lift.norm()) << box.card;
  }
}

/// The corners of faces 1, 2, ... as Abaqus' manual lists them.
std::vector<std::string> abaqus_face_table(const std::string& type) {
  if (type == "C3D4") return {"1 2 3", "1 4 2", "2 4 3", "3 4 1"};
  if (type == "C3D5") return {"1 2 3 4", "1 5 2", "2 5 3", "3 5 4", "4 5 1"};
  if (type == "C3D6") return {"1 2 3", "4 6 5", "1 2 5 4", "2 3 6 5", "3 1 4 6"};
  return {"1 2 3 4", "5 8 7 6", "1 5 6 2", "2 6 7 3", "3 7 8 4", "4 8 5 1"};
}

/// Outer faces as pairs of an element's number and a face's, by the table.
std::vector<std::pair<int, int>> outer_faces_of(const Box& box) {
  const std::vector<std::string> table = abaqus_face_table(box.type);
  std::map<std::vector<int>, std::vector<std::pair<int, int>>> of_corners;
  for (std::size_t s = 0; s < box.solids.size(); ++s)
    for (std::size_t f = 0; f < table.size(); ++f) {
      std::vector<int> corners;
      for (const char digit : table[f])
        if (digit != ' ') corners.push_back(box.solids[s][digit - '1']);
      std::sort(corners.begin(), corners.end());
      of_corners[corners].emplace_back(s + 1, f + 1);
    }
  std::vector<std::pair<int, int>> outer;
  for (const auto& [corners, faces] : of_corners)
    if (faces.size() == 1) outer.push_back(faces[0]);
  return outer;
}

TEST(SolidPressure, LoadsAndSurfacesOfAbaqus) {
  for (const Box& box : boxes())
    for (const bool by_surface : {false, true}) {
      std::string text = "*NODE\n", surface = "*SURFACE, NAME=SKIN\n", loads = "*DLOAD\n";
      for (int n = 1; n <= (box.card == "CPYRAM" ? 9 : 8); ++n) {
        const Vector3 place = place_of(n);
        text += fmt::format("{}, {:.8g}, {:.8g}, {:.8g}\n", n, place.x(), place.y(), place.z());
      }
      text += "*ELEMENT, ELSET=ALL, TYPE=" + box.type + "\n";
      for (std::size_t s = 0; s < box.solids.size(); ++s)
        text += fmt::format("{},{}\n", s + 1, numbers(box.solids[s]));
      for (const auto& [element, face] : outer_faces_of(box)) {
        surface += fmt::format("{}, S{}\n", element, face);
        loads += fmt::format("{}, P{}, 1.E6\n", element, face);
      }
      if (by_surface) text += surface;
      text +=
          "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n*MATERIAL, NAME=STEEL\n*ELASTIC\n2.E11, "
          "0.3\n*DENSITY\n7850.\n*STEP\n*STATIC\n*BOUNDARY\n1, 1, 3\n2, 2, 3\n3, 3, 3\n" +
          (by_surface ? "*DSLOAD\nSKIN, P, 1.E6\n" : loads) + "*END STEP\n";
      const Deck deck = test::abaqus(text);
      expect_even_compression(deck, solve(deck).cases.at(0), box.type);
    }
}

/// A quarter of a ring, of radii 1 and 2 m and 0.5 m high, of curved solids of twenty nodes, held
/// along its planes of symmetry and at its flat faces.
std::string ring_cards(int radial, int around, const std::string& loads_of_inner) {
  const auto number = [&](int i, int j, int k) {
    return 1 + i + (2 * radial + 1) * (j + (2 * around + 1) * k);
  };
  std::string text;
  for (int k = 0; k <= 2; ++k)
    for (int j = 0; j <= 2 * around; ++j)
      for (int i = 0; i <= 2 * radial; ++i) {
        if (i % 2 + j % 2 + k % 2 > 1) continue;
        const double angle = std::numbers::pi / 2 * j / (2 * around), r = 1 + i / (2.0 * radial);
        const int n = number(i, j, k);
        text += fmt::format("GRID,{},,{:.12g},{:.12g},{:.12g}\nSPC1,1,3,{}\n", n,
                            r * std::cos(angle), r * std::sin(angle), 0.25 * k, n);
        if (j == 0) text += fmt::format("SPC1,1,2,{}\n", n);
        if (j == 2 * around) text += fmt::format("SPC1,1,1,{}\n", n);
      }
  int label = 0;
  for (int b = 0; b < around; ++b)
    for (int a = 0; a < radial; ++a) {
      const int i = 2 * a, j = 2 * b;
      std::vector<int> nodes;
      for (const int k : {0, 2})
        nodes.insert(nodes.end(), {number(i, j, k), number(i + 2, j, k), number(i + 2, j + 2, k),
                                   number(i, j + 2, k)});
      const auto middles = [&](int k) {
        nodes.insert(nodes.end(), {number(i + 1, j, k), number(i + 2, j + 1, k),
                                   number(i + 1, j + 2, k), number(i, j + 1, k)});
      };
      middles(0);
      nodes.insert(nodes.end(), {number(i, j, 1), number(i + 2, j, 1), number(i + 2, j + 2, 1),
                                 number(i, j + 2, 1)});
      middles(2);
      text += fmt::format("CHEXA,{},1", ++label);
      for (std::size_t n = 0; n < nodes.size(); ++n)
        text += fmt::format("{}{}", n == 6 || n == 14 ? "\n," : ",", nodes[n]);
      text += "\n";
      if (a == 0)
        text +=
            fmt::format("PLOAD4,2,{},1.+6,,,,{},{}\n", label, number(i, j, 0),
                        number(i, j + 2, 2)) +
            fmt::format(fmt::runtime(loads_of_inner), label, number(i, j, 0), number(i, j + 2, 2));
    }
  return text + steel_of_solids;
}

// Lame's ring in plane strain: u(r) = (1 + nu) / E p a^2 / (b^2 - a^2) ((1 - 2 nu) r + b^2 / r).
TEST(SolidPressure, LamesRing) {
  constexpr int radial = 4, around = 4;
  const Deck deck = test::nastran(
      "SOL 101\nCEND\nSPC = 1\nSUBCASE 1\n LOAD = 2\nSUBCASE 2\n LOAD = 3\nBEGIN BULK\n" +
      ring_cards(radial, around, "PLOAD4,3,{},1.+6,,,,{},{}\n,,0.,2.,0.\n") + "ENDDATA\n");
  const DeckSolution solution = solve(deck);
  const ElasticModel model = quadratic_model(deck);
  const auto sought = [](double r) {
    return (1 + poisson) / steel_modulus * pressure / 3 * ((1 - 2 * poisson) * r + 4 / r);
  };
  for (std::size_t v = 0; v < deck.mesh.vertices.size(); ++v) {
    const Vector3 place = deck.mesh.vertices[v];
    const double r = place.head<2>().norm();
    const Vector3 moved = solution.cases.at(0).motion.segment<3>(
        6L * model.space().node_of_vertex(static_cast<int>(v)));
    const Vector3 expected = sought(r) * Vector3(place.x(), place.y(), 0) / r;
    EXPECT_LT((moved - expected).norm(), 1e-3 * sought(1)) << place.transpose();
  }
  // Along a given direction: pressure times the area of the curved face.
  const Vector3 pushed(0, pressure * 0.5 * std::numbers::pi / 2, 0);
  EXPECT_LT((solution.cases.at(1).applied.force - pushed).norm(), 1e-4 * pushed.norm());
}

TEST(SolidPressure, WrittenAndReadAgainItIsTheSame) {
  for (const Box& box : boxes()) {
    const Deck deck = pressed_box(box);
    const Deck again = test::nastran(to_nastran(deck));
    const DeckSolution before = solve(deck), after = solve(again);
    for (std::size_t c = 0; c < 2; ++c)
      EXPECT_LT((before.cases.at(c).motion - after.cases.at(c).motion).norm(),
                1e-6 * before.cases[c].motion.norm())
          << box.card;
    if (box.card == "CPYRAM") continue;  // not written for Abaqus
    Deck even = deck;
    even.load_cases.resize(1);
    const DeckSolution steps = solve(test::abaqus(to_abaqus(even)));
    EXPECT_LT((before.cases[0].motion - steps.cases.at(0).motion).norm(),
              1e-6 * before.cases[0].motion.norm())
        << box.card;
  }
}

TEST(SolidPressure, SaysWhatIsWrong) {
  const std::string cards = box_cards(boxes()[0]);
  EXPECT_THAT(test::complaints_of_nastran(cards + "PLOAD4,2,1,1.+6\n"),
              AllOf(HasSubstr("PLOAD4: element 1 is a solid"), HasSubstr("G1 and G3 or G4")));
  EXPECT_THAT(test::complaints_of_nastran(cards + "PLOAD4,2,1,1.+6,,,,1,2\n"),
              HasSubstr("the grids 1 and 2 name no face of element 1"));
  EXPECT_THAT(test::complaints_of_nastran(cards + "PLOAD4,2,1,1.+6,,,,1\n"),
              HasSubstr("the grids 1 and none name no face of element 1"));
  EXPECT_THAT(test::complaints_of_nastran(cards + "PLOAD4,2,1,1.+6,,,,1,99\n"), HasSubstr("99"));
}

}  // namespace
}  // namespace blocklift::structure
