// Pressures whose direction turns over the surface, as coordinates about a cylinder do.
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_loads.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/system/matter.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

constexpr double shell_radius = 2, shell_length = 3, shell_pressure = 1000;  // m, Pa
constexpr double half_angle = M_PI / 24;                                     // of a facet of 15 deg

/// Resultant on a facet across the chord of 15 deg of a pressure along the radii, N: with s = a tan
/// d along the chord, a its distance from the axis, the integral of cos(d) ds.
double radial_force_of_facet() {
  const double distance = shell_radius * std::cos(half_angle);
  return shell_pressure * shell_length * 2 * distance *
         std::log(std::tan(M_PI / 4 + half_angle / 2));
}

const std::string cylinder =
    "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\nCORD2C,5,0,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
    "MAT1,1,2.1+11,,0.3,7850.\nPSHELL,1,1,0.01,1,,1\nPSOLID,2,1\nSPC1,1,123,1\n";

/// A quarter of a cylinder of six facets, 0 to 90 deg from the x axis.
Deck quarter(const std::string& direction) {
  std::string text = cylinder;
  for (int i = 0; i <= 6; ++i)
    for (int j = 0; j < 2; ++j)
      text += fmt::format("GRID,{},5,2.,{}.,{}.\n", 1 + i + 7 * j, 15 * i, 3 * j);
  for (int i = 1; i <= 6; ++i)
    text += fmt::format("CQUAD4,{},1,{},{},{},{}\n", i, i, i + 1, i + 8, i + 7);
  return test::nastran(text + "PLOAD4,2,1,1000.,,,,THRU,6\n,5," + direction + "\nENDDATA\n");
}

/// A block behind one facet, whose middle is on the x axis; its inner face is at 1.8 m.
Deck block_behind_facet(const std::string& direction) {
  std::string text = cylinder;
  for (int j = 0; j < 2; ++j)
    text += fmt::format(
        "GRID,{},5,1.8,-7.5,{}.\nGRID,{},5,2.,-7.5,{}.\nGRID,{},5,2.,7.5,{}.\n"
        "GRID,{},5,1.8,7.5,{}.\n",
        4 * j + 1, 3 * j, 4 * j + 2, 3 * j, 4 * j + 3, 3 * j, 4 * j + 4, 3 * j);
  text += "CHEXA,1,2,1,2,3,4,5,6\n,7,8\n";
  return test::nastran(text + "PLOAD4,2,1,1000.,,,,2,7\n,5," + direction + "\nENDDATA\n");
}

Vector3 force_on(const Deck& deck) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  const ElasticModel model(std::move(mesh), {2, {}});
  return resultant(model.space(), load_of(model, deck, deck.load_cases.at(0))).force;
}

// The facets' directions from the axis sum to (1, 1) / (2 sin of half their angle); on the true
// cylinder the force would be p R L = 6,000 N along x and y.
TEST(TurningPressure, FollowsTheRadiiOfShells) {
  const double sum = radial_force_of_facet() / (2 * std::sin(half_angle));
  EXPECT_NEAR(sum, 6000, 20);
  const Deck outwards = quarter("1.,0.,0.");
  EXPECT_LT((force_on(outwards) - Vector3(sum, sum, 0)).norm(), 1e-5 * sum);
  EXPECT_LT((force_on(quarter("0.,1.,0.")) - Vector3(-sum, sum, 0)).norm(), 1e-5 * sum);
  const double area = 6 * shell_length * 2 * shell_radius * std::sin(half_angle);
  EXPECT_LT((force_on(quarter("0.,0.,2.")) - Vector3(0, 0, shell_pressure * area)).norm(), 1e-3);
  EXPECT_LT((force_on(test::nastran(to_nastran(outwards))) - Vector3(sum, sum, 0)).norm(),
            1e-5 * sum);
}

TEST(TurningPressure, FollowsTheRadiiOfSolids) {
  const double force = radial_force_of_facet();
  const Deck outwards = block_behind_facet("1.,0.,0.");
  EXPECT_LT((force_on(outwards) - Vector3(force, 0, 0)).norm(), 1e-5 * force);
  EXPECT_LT((force_on(block_behind_facet("0.,1.,0.")) - Vector3(0, force, 0)).norm(), 1e-5 * force);
  EXPECT_LT((force_on(test::nastran(to_nastran(outwards))) - Vector3(force, 0, 0)).norm(),
            1e-5 * force);
}

}  // namespace
}  // namespace blocklift::structure
