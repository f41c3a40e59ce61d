// The blocks of models/ as shells.
#include <algorithm>

#include <gtest/gtest.h>

#include "pipeline/build/describe_block.h"
#include "pipeline/files/library/model_library.h"
#include "structure/mesh/plates/shell_generator.h"
#include "tests/structure/formulation/gravity.h"
#include "tests/structure/mesh/plates/mesh_measures.h"

namespace blocklift::pipeline {
namespace {

structure::Mesh shells_of(const std::string& name, double largest_element) {
  Diagnostics diagnostics;
  ModelLibrary library = ModelLibrary::of_installation();
  const auto model = library.load_block({"blocks/" + name, {}}, {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.to_text();
  return structure::generate_shell_mesh(describe_block(*model, name, largest_element));
}

TEST(BlockShells, HullOf860Tonnes) {
  const structure::Mesh mesh = shells_of("hull-860t", 2);
  structure::check_mesh(mesh);
  structure::test::expect_conforming(mesh);
  const std::vector<int> part = structure::connected_parts(mesh);
  EXPECT_EQ(*std::max_element(part.begin(), part.end()), 0);
  EXPECT_EQ(mesh.lifting_points.size(), 6U);

  // The plates of block.yaml one by one, m^3: area times thickness.
  const double decks = 32 * 20 * (0.022 + 0.018 + 0.020);
  const double sides = 32 * 8 * (0.022 + 0.014) + 32 * 6 * 0.020;
  const double frames = 9 * (20 * 2 * 0.014 + (20 * 6 - 2 * 4 * 2.5) * 0.016);
  const double girders = 32 * 2 * (4 * 0.014 + 5 * 0.010) + 32 * 0.8 * (3 * 0.020 + 5 * 0.012);
  const double stringer = 32 * 1 * 0.012;
  const double pads = 2 * 2 * (4 * (0.050 - 0.014) + 2 * (0.050 - 0.016));
  const double lugs = (4 * 0.85 * 1.2 + 2 * 1.0 * 0.9) * 0.100;
  const double volume = decks + sides + frames + girders + stringer + pads + lugs;
  const auto steel = structure::test::measure(mesh);
  EXPECT_NEAR(steel.mass, 7850 * volume, 1e-6 * steel.mass);

  // As solids of full thickness the plates weigh 645.6 t (rounded to 0.1 t). What crossings count
  // twice is the difference, but for the ends of the joints, where three plates meet, and the lugs'
  // feet, which stand on mid-planes here: six times up to 0.85 x 0.011 x 0.1 m of steel and what is
  // inside of thick pads.
  const double overlap = 7850 * structure::test::joint_overlap(mesh);
  EXPECT_NEAR(steel.mass - overlap, 645.6e3, 0.3e3);
  EXPECT_GT(overlap, 2e3);

  double longest = 0;
  for (const structure::Shell& shell : mesh.shells)
    longest = std::max(longest, structure::longest_edge(mesh, shell));
  EXPECT_LE(longest, 2 * (1 + 1e-9));
  RecordProperty("shells", static_cast<int>(mesh.shells.size()));
  EXPECT_LT(mesh.shells.size(), 3000U);

  const double weight = 9.81 * steel.mass;
  const auto reactions = structure::test::weigh(mesh, 2, {{{0, 0, 0}, {32, 0, 0}, {0, 20, 0}}});
  EXPECT_NEAR(reactions[1], weight * steel.centre.x() / 32, 1e-5 * weight);
  EXPECT_NEAR(reactions[2], weight * steel.centre.y() / 20, 1e-5 * weight);
  EXPECT_NEAR(reactions[0] + reactions[1] + reactions[2], weight, 1e-5 * weight);
}

TEST(BlockShells, ShipOf3800Tonnes) {
  const structure::Mesh mesh = shells_of("ship-3800t", 3);
  structure::check_mesh(mesh);
  structure::test::expect_conforming(mesh);
  EXPECT_EQ(mesh.lifting_points.size(), 8U);
  const std::vector<int> part = structure::connected_parts(mesh);
  EXPECT_EQ(*std::max_element(part.begin(), part.end()), 0);
}

}  // namespace
}  // namespace blocklift::pipeline
