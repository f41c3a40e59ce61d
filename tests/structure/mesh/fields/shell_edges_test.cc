#include "structure/mesh/fields/shell_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"

namespace blocklift::structure {
namespace {

using std::numbers::pi;

// A pipe of so many flat facets round it and two along it; every second one is turned over.
Mesh faceted_pipe(int facets) {
  Mesh mesh = examples::sheet_mesh(
      [=](double x, double y) {
        const double angle = 2 * pi * std::round(x * facets) / facets;
        return Vector3(std::cos(angle), std::sin(angle), 2 * y);
      },
      facets, 2, 0.01, examples::plain_steel());
  for (std::size_t i = 0; i < mesh.shells.size(); i += 2) {
    std::swap(mesh.shells[i].vertices[0], mesh.shells[i].vertices[1]);
    std::swap(mesh.shells[i].vertices[2], mesh.shells[i].vertices[3]);
  }
  return mesh;
}

long facets_of(const Mesh& mesh) {
  const std::vector<bool> is_facet = find_facets(mesh);
  return std::count(is_facet.begin(), is_facet.end(), true);
}

TEST(ShellEdges, KinkIsTheTurnOfThePlatingWhateverTheNormals) {
  for (const int facets : {3, 4, 5, 8, 24}) {
    const Mesh mesh = faceted_pipe(facets);
    int kinks = 0;
    for (const auto& [key, sides] : collect_edges(mesh)) {
      if (sides.size() != 2) continue;
      const bool is_round =
          std::abs(mesh.vertices[key.first].z() - mesh.vertices[key.second].z()) < 1e-9;
      kinks += is_round ? 0 : 1;
      EXPECT_NEAR(kink_between(mesh, sides[0], sides[1]), is_round ? 0 : 2 * pi / facets, 1e-9);
    }
    EXPECT_EQ(kinks, 2 * facets);
  }
}

TEST(ShellEdges, CornersOfTheStructureAreNoFacets) {
  EXPECT_EQ(facets_of(faceted_pipe(4)), 0);  // a box
  EXPECT_EQ(facets_of(faceted_pipe(6)), 0);
  EXPECT_EQ(facets_of(faceted_pipe(8)), 16);
  EXPECT_EQ(facets_of(faceted_pipe(48)), 96);
}

TEST(ShellEdges, PlanePlatesAndCurvedShellsAreNoFacets) {
  EXPECT_EQ(facets_of(examples::sheet_mesh([](double x, double y) { return Vector3(x, y, 0); }, 4,
                                           4, 0.01, examples::plain_steel())),
            0);
  const auto roof = [](double x, double y) { return Vector3(std::cos(x), std::sin(x), y); };
  EXPECT_EQ(facets_of(examples::sheet_mesh(roof, 4, 4, 0.01, examples::plain_steel(), 3)), 0);
  EXPECT_EQ(facets_of(examples::sheet_mesh(roof, 4, 4, 0.01, examples::plain_steel(), 1)), 16);
}

// A plate on a round shell does not make the shell less round, and is no facet itself.
TEST(ShellEdges, ShellBelowAPlateIsStillRound) {
  Mesh mesh = faceted_pipe(16);
  examples::add_sheet(
      mesh, [](double x, double y) { return Vector3(1 + x, 0, 2 * y); }, 1, 2);
  const std::vector<bool> is_facet = find_facets(mesh);
  EXPECT_EQ(std::count(is_facet.begin(), is_facet.end(), true), 32);
  EXPECT_FALSE(is_facet.back());
}

}  // namespace
}  // namespace blocklift::structure
