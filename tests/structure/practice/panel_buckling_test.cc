// Buckling of plate panels.
#include "structure/practice/panel_buckling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "structure/mesh/fields/shell_edges.h"
#include "structure/mesh/plates/shell_generator.h"
#include "tests/structure/hull_block.h"
#include "tests/structure/motions.h"
#include "tests/structure/practice/halved_beams.h"

namespace blocklift::structure {
namespace {

const Material steel{"AH36", 206e9, 0.3, 7850, 355e6};

// Timoshenko and Gere (1961), Theory of Elastic Stability, table 9-1: k of a simply supported plate
// under uniform compression by a/b.
TEST(PanelBuckling, HasTheCoefficientsOfTimoshenkoAndGere) {
  const double table[][2] = {{0.4, 8.41}, {0.6, 5.14}, {0.8, 4.20}, {1.0, 4.00},
                             {1.2, 4.13}, {1.4, 4.47}, {1.6, 4.20}, {2.0, 4.00}};
  for (const auto& [ratio, k] : table)
    EXPECT_NEAR(compression_coefficient(ratio, 1, 1, 0), k, 0.006) << ratio;
  // Table 9-6: bending alone (psi = -1) 23.9 at a/b = 1 and 2; linear to zero (psi = 0) 7.8 at a/b
  // = 1. The rules' formulae are fits to it.
  EXPECT_NEAR(compression_coefficient(2, 1, -1, 0), 23.9, 0.02 * 23.9);
  EXPECT_NEAR(compression_coefficient(1, 1, 0, 0), 7.8, 0.03 * 7.8);
  // Section 9.7, shear: 5.34 + 4 (b/a)^2, 9.34 of a square.
  EXPECT_NEAR(shear_coefficient(1, 1, false), 9.34, 1e-12);
  EXPECT_NEAR(shear_coefficient(1, 1000, false), 5.34, 1e-5);
  // Section 9.4, one edge free: 1.44 at a/b = 1, 0.516 at 4 (table 9-4); the formula drops a term.
  EXPECT_NEAR(compression_coefficient(1, 1, 1, 1), 1.44, 0.02 * 1.44);
  EXPECT_NEAR(compression_coefficient(4, 1, 1, 1), 0.516, 0.06 * 0.516);
}

// A wide column is Euler's column of the plate's bending stiffness: sigma = pi^2 D / (L^2 t).
TEST(PanelBuckling, WideColumnIsEulers) {
  const double t = 0.01, length = 1.5;
  const double d = steel.youngs_modulus * t * t * t / 12 / (1 - 0.09);
  const double sigma = compression_coefficient(length, 3, 1, 2) * euler_stress(steel, t, 3);
  EXPECT_NEAR(sigma, std::numbers::pi * std::numbers::pi * d / (length * length * t), 1e-6 * sigma);
}

TEST(PanelBuckling, JohnsonAndOstenfeldTakeOverAtHalfTheYieldStress) {
  EXPECT_DOUBLE_EQ(johnson_ostenfeld(100e6, 355e6), 100e6);
  EXPECT_DOUBLE_EQ(johnson_ostenfeld(177.5e6, 355e6), 177.5e6);
  const double h = 1;  // Pa: the slope is that of the elastic branch there
  EXPECT_NEAR((johnson_ostenfeld(177.5e6 + h, 355e6) - 177.5e6) / h, 1, 1e-6);
  EXPECT_NEAR(johnson_ostenfeld(355e6, 355e6), 0.75 * 355e6, 1);
  EXPECT_NEAR(johnson_ostenfeld(1e15, 355e6), 355e6, 1e2);
}

TEST(PanelBuckling, UtilisationIsHomogeneousAndPassesTensionOver) {
  const PanelSize size{4, 0.8, 0.014};
  PanelStress stress{-60e6, -20e6, 30e6, 10e6, 5e6};
  const BucklingUtilisation one = buckling_utilisation(size, {}, steel, stress);
  EXPECT_GT(one.critical, one.elastic);  // thick: yielding counts
  PanelStress twice{-120e6, -40e6, 60e6, 20e6, 10e6};
  EXPECT_NEAR(buckling_utilisation(size, {}, steel, twice).critical, 2 * one.critical, 1e-12);
  EXPECT_EQ(buckling_utilisation(size, {}, steel, {50e6, 20e6, 0, 10e6, 5e6}).critical, 0);
  // Uniform compression alone: the stress over Bryan's.
  const double bryan = 4 * euler_stress(steel, 0.014, 0.8);
  EXPECT_NEAR(buckling_utilisation(size, {}, steel, {-60e6, 0, 0, 0, 0}).elastic, 60e6 / bryan,
              1e-12);
}

// Under equal compression along both sides a panel on four simple supports buckles at (1 + (b/a)^2)
// times sigma_E of its shorter side b (Timoshenko and Gere, 1961, section 9.3): one half wave each
// way. The sum of squares alone gives 0.71 for a square.
TEST(PanelBuckling, CompressionBothWaysIsCriticalWhereThePanelBuckles) {
  Material tough = steel;
  tough.yield_stress = 1e12;
  for (const double a : {1.0, 1.5, 2.0, 3.0, 5.0}) {
    const double critical = (1 + 1 / (a * a)) * euler_stress(steel, 0.01, 1);
    const BucklingUtilisation found =
        buckling_utilisation({a, 1, 0.01}, {}, tough, {-critical, -critical, 0, 0, 0});
    EXPECT_NEAR(found.elastic, 1, 1e-12) << a;
    EXPECT_NEAR(found.critical, 1, 1e-12) << a;
    const BucklingUtilisation turned =
        buckling_utilisation({1, a, 0.01}, {}, tough, {-critical, -critical, 0, 0, 0});
    EXPECT_NEAR(turned.elastic, 1, 1e-12) << a;
  }
  // With shear: c + s^2 = 1, here of shares of 3/4 and 1/2.
  const double e = euler_stress(steel, 0.01, 1);
  EXPECT_NEAR(buckling_utilisation({1, 1, 0.01}, {}, tough,
                                   {-0.75 * 2 * e, -0.75 * 2 * e, 0.5 * 9.34 * e, 0, 0})
                  .elastic,
              1, 1e-12);
  // A little of the second compression changes little.
  const double bryan = 4 * e;
  EXPECT_NEAR(buckling_utilisation({3, 1, 0.01}, {}, tough, {-0.9 * bryan, -1, 0, 0, 0}).elastic,
              0.9, 1e-6);
}

// A box of 4 x 2 x 1 m with one frame and a web that hangs free below its deck.
BlockDescription box() {
  BlockDescription block;
  block.name = "box";
  block.materials = {steel};
  const std::array<Interval, 3> all = {{{0, 4}, {0, 2}, {0, 1}}};
  block.plates = {{"bottom", Axis::z, {0}, all, 0.012, "AH36"},
                  {"deck", Axis::z, {1}, all, 0.010, "AH36"},
                  {"ends", Axis::x, {0, 2, 4}, all, 0.010, "AH36"},
                  {"sides", Axis::y, {0, 2}, all, 0.010, "AH36"},
                  {"web", Axis::y, {1}, {{{0, 4}, {0, 2}, {0.7, 1}}}, 0.010, "AH36"}};
  block.largest_element = 1;
  return block;
}

using Motion6 = Eigen::Matrix<double, 6, 1>;

BlockPanels panels_at_rest(const ElasticModel& model,
                           const std::vector<PlateStiffening>& stiffening = {}) {
  return {model, Eigen::MatrixXd::Zero(model.freedoms(), 1), stiffening};
}

TEST(BlockPanels, AreTheFieldsBetweenCrossingPlates) {
  const ElasticModel model(generate_shell_mesh(box()), {2, {}});
  const BlockPanels panels =
      panels_at_rest(model, {{"bottom", Vector3::UnitX(), 0.5}, {"deck", Vector3::UnitZ(), 0.5}});
  int decks = 0, webs = 0, bottoms = 0;
  for (const Panel& panel : panels.panels()) {
    EXPECT_NEAR((panel.e_1.cross(panel.e_2) - panel.normal).norm(), 0, 1e-12);
    if (panel.group == "deck") {
      ++decks;  // divided by the web and the middle frame
      EXPECT_NEAR(panel.size.a, 2, 1e-9);
      EXPECT_NEAR(panel.size.b, 1, 1e-9);
      EXPECT_EQ(panel.free.along_a + panel.free.along_b, 0);
      EXPECT_DOUBLE_EQ(panel.size.thickness, 0.010);
      EXPECT_NEAR(panel.centre_B.z(), 1, 1e-12);
      EXPECT_DOUBLE_EQ(panel.fields_a * panel.fields_b, 1);  // none run across a plate
    } else if (panel.group == "web") {
      ++webs;
      EXPECT_EQ(panel.free.along_a, 1);
      EXPECT_EQ(panel.free.along_b, 0);
    } else if (panel.group == "bottom") {
      ++bottoms;  // a square lies along x
      EXPECT_NEAR(panel.e_1.x(), 1, 1e-12);
      EXPECT_DOUBLE_EQ(panel.fields_b, 4);
      EXPECT_DOUBLE_EQ(panel.fields_a, 1);
    }
  }
  EXPECT_EQ(decks, 4);
  EXPECT_EQ(webs, 2);
  EXPECT_EQ(bottoms, 2);
}

// Stiffeners that are not in the mesh stand 0.75 m apart, and where is not known: a panel 2 m wide
// has a field of 0.75 m, not three of 0.67 m. One narrower than their spacing has none to count on.
TEST(BlockPanels, FieldsAreAsWideAsTheSpacing) {
  const ElasticModel model(generate_shell_mesh(box()), {2, {}});
  const std::vector<PlateStiffening> stiffening = {{"bottom", Vector3::UnitX(), 0.75},
                                                   {"deck", Vector3::UnitX(), 1.5}};
  const BlockPanels panels = panels_at_rest(model, stiffening);
  PanelStress stress;
  stress.s11 = -60e6;
  for (std::size_t p = 0; p < panels.panels().size(); ++p) {
    const Panel& panel = panels.panels()[p];
    const int number = static_cast<int>(p);
    if (panel.group == "bottom") {
      EXPECT_NEAR(panels.field_width(number, Vector3::UnitX()), 0.75, 1e-9);
      EXPECT_NEAR(panels.utilisation(number, stress).elastic,
                  buckling_utilisation({2, 0.75, 0.012}, {}, steel, stress).elastic, 1e-9);
    } else if (panel.group == "deck") {
      EXPECT_NEAR(panels.field_width(number, Vector3::UnitX()), 1, 1e-9);
    }
  }
}

// A step in thickness holds nothing: pads belong to their plate's panel. Lugs are none, and hold
// the edge that they stand on as far as they reach.
TEST(BlockPanels, PadsDivideNoPanel) {
  const ElasticModel model(generate_shell_mesh(test::small_block()), {1, {}});
  int sides = 0;
  const BlockPanels panels = panels_at_rest(model);
  for (const Panel& panel : panels.panels()) {
    EXPECT_EQ(panel.group.find('L'), std::string::npos) << panel.plate;
    if (panel.group != "sides") continue;
    ++sides;
    EXPECT_NEAR(panel.size.a, 2, 1e-9);
    EXPECT_NEAR(panel.size.b, 2, 1e-9);
    EXPECT_DOUBLE_EQ(panel.size.thickness, 0.015);
    EXPECT_EQ(panel.free.along_a, 1);  // the lug stands on 0.8 m of 2 m
    EXPECT_EQ(panel.free.along_b, 0);
  }
  EXPECT_EQ(sides, 4);
}

// Beams along edges of shells divide a plate and hold its free edge, also where each is two that
// meet in the middle of an edge, as those of quadratic elements do; a half alone does not.
TEST(BlockPanels, BeamsDivideAndHold) {
  BlockDescription plate;
  plate.materials = {steel};
  plate.plates = {{"deck", Axis::z, {0}, {{{0, 4}, {0, 2}, {}}}, 0.01, "AH36"}};
  plate.largest_element = 1;
  Mesh mesh = generate_shell_mesh(plate);
  BeamSection section;
  section.area = section.torsion = section.second_moment_2 = section.second_moment_3 = 1e-4;
  section.shear_area_2 = section.shear_area_3 = 1e-4;
  mesh.beam_sections = {section};
  const auto beam_along = [&](double y) {
    for (const Shell& shell : mesh.shells)
      for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 1}, {2, 3}}) {
        const int from = shell.vertices[i], to = shell.vertices[j];
        const Vector3& p = mesh.vertices[from];
        const bool is_there = std::any_of(mesh.beams.begin(), mesh.beams.end(), [&](const Beam& b) {
          return b.vertices == std::array<int, 2>{from, to};
        });
        if (std::abs(p.y() - y) > 1e-9 || is_there) continue;
        Beam beam;
        beam.vertices = {from, to};
        mesh.beams.push_back(beam);
      }
  };
  beam_along(1);
  beam_along(2);
  ASSERT_EQ(mesh.beams.size(), 8U);
  Mesh halved = test::with_halved_beams(mesh);
  for (const Mesh& of : {mesh, halved}) {
    const ElasticModel model(of, {2, {}});
    const BlockPanels panels = panels_at_rest(model);
    ASSERT_EQ(panels.panels().size(), 2U);
    for (const Panel& panel : panels.panels()) {
      EXPECT_NEAR(panel.size.a, 4, 1e-9);
      EXPECT_NEAR(panel.size.b, 1, 1e-9);
      EXPECT_EQ(panel.free.along_a, panel.centre_B.y() < 1 ? 1 : 0);
      EXPECT_EQ(panel.free.along_b, 2);
    }
  }
  for (auto i = static_cast<std::ptrdiff_t>(halved.beams.size()); i > 0; i -= 2)
    halved.beams.erase(halved.beams.begin() + i - 1);
  const ElasticModel model(halved, {2, {}});
  EXPECT_EQ(panels_at_rest(model).panels().size(), 1U);
}

// A quarter disc in a corner of a tank, its arc held by bent plating or free, with a hole: the arc
// faces two sides of the rectangle about it, the hole none.
TEST(BlockPanels, AnArcHoldsTheSidesThatItFaces) {
  constexpr int rays = 8, rings = 4;
  constexpr double radius = 1.6;
  for (const bool has_plating : {false, true}) {
    Mesh mesh;
    mesh.materials = {steel};
    mesh.groups = {{"floor"}};
    mesh.regions = {{.name = "floor", .group = 0}};
    mesh.shell_sections = {{.thickness = 0.012}};
    const auto vertex = [&](int ring, int ray, double z) {
      const double angle = std::numbers::pi / 2 * ray / rays, r = radius * (ring + 1) / (rings + 1);
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      return static_cast<int>(mesh.vertices.size()) - 1;
    };
    std::array<std::array<int, rays + 1>, rings + 1> at{};
    for (int ring = 0; ring <= rings; ++ring)
      for (int ray = 0; ray <= rays; ++ray) at[ring][ray] = vertex(ring, ray, 0);
    for (std::size_t ring = 0; ring < rings; ++ring)
      for (std::size_t ray = 0; ray < rays; ++ray) {
        if (ring == 1 && ray == 3) continue;  // a hole
        mesh.shells.push_back({.vertices = {at[ring][ray], at[ring + 1][ray], at[ring][ray + 1],
                                            at[ring + 1][ray + 1]}});
      }
    if (has_plating)
      for (std::size_t ray = 0; ray < rays; ++ray) {
        const int one = at[rings][ray], other = at[rings][ray + 1];
        const int above = vertex(rings, static_cast<int>(ray), 1);
        const int above_other = vertex(rings, static_cast<int>(ray) + 1, 1);
        mesh.shells.push_back({.vertices = {one, other, above, above_other}});
      }
    const ElasticModel model(std::move(mesh), {1, {}});
    const BlockPanels panels = panels_at_rest(model);
    const auto disc =
        std::find_if(panels.panels().begin(), panels.panels().end(),
                     [](const Panel& panel) { return std::abs(panel.normal.z()) > 0.9; });
    ASSERT_NE(disc, panels.panels().end());
    // The straight edges lie free, and so does the arc without plating.
    EXPECT_EQ(disc->free.along_a + disc->free.along_b, has_plating ? 2 : 4);
  }
}

/// u = (c x + d x y, -d x^2 / 2, 0): e_11 = c + d y and no other strain in planes z = const.
Motion6 bent_in_plane(const Vector3& x) {
  const double c = 1e-4, d = 3e-5;
  Motion6 motion;
  motion << c * x.x() + d * x.x() * x.y(), -d * x.x() * x.x() / 2, 0, 0, 0, 0;
  return motion;
}

/// A flat web of squares, with triangles for what a slope cuts off, held where upright plates stand
/// along its outline.
class WebMesh {
 public:
  explicit WebMesh(double element) : element_(element) {
    mesh_.materials = {steel};
    mesh_.groups = {{"web"}, {"wall"}};
    mesh_.regions = {{.name = "web", .group = 0}, {.name = "wall", .group = 1}};
    mesh_.shell_sections = {{.thickness = 0.012}};
  }
  void add_square(int i, int j) { add({at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)}); }
  void add_triangle(int i, int j) {
    const int last = at(i, j + 1);
    add({at(i, j), at(i + 1, j), last, last});
  }
  /// Walls along the edges that only one shell has and that are to be held.
  template <typename IsHeld>
  BlockPanels panels(const IsHeld& is_held) {
    std::map<int, int> above;
    const auto upper = [&](int vertex) {
      const auto [found, is_new] = above.try_emplace(vertex, 0);
      if (is_new) {
        mesh_.vertices.push_back(mesh_.vertices[vertex] + Vector3(0, 0, 0.3));
        found->second = static_cast<int>(mesh_.vertices.size()) - 1;
      }
      return found->second;
    };
    for (const auto& [key, shells] : collect_edges(mesh_)) {
      const Vector3 middle = (mesh_.vertices[key.first] + mesh_.vertices[key.second]) / 2;
      if (shells.size() != 1 || !is_held(middle)) continue;
      const int one = upper(key.first), other = upper(key.second);
      mesh_.shells.push_back({.vertices = {key.first, key.second, one, other}, .region = 1});
    }
    return panels_at_rest(ElasticModel(mesh_, {1, {}}));
  }

 private:
  int at(int i, int j) {
    const auto [found, is_new] =
        vertices_.try_emplace({i, j}, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.emplace_back(element_ * i, element_ * j, 0);
    return found->second;
  }
  void add(const std::array<int, 4>& vertices) { mesh_.shells.push_back({.vertices = vertices}); }

  double element_;
  Mesh mesh_;
  std::map<std::pair<int, int>, int> vertices_;
};

/// Places in panels() of those of the web.
std::vector<int> webs_of(const BlockPanels& panels) {
  std::vector<int> result;
  for (std::size_t p = 0; p < panels.panels().size(); ++p)
    if (panels.panels()[p].group == "web") result.push_back(static_cast<int>(p));
  return result;
}

// A web 0.6 m deep along a side and a floor of 4 m, its inner edges free: two strips. The one that
// has the corner is 0.6 m wide and a little more for the 0.6 m of its 4 m that no plate holds and
// that are not free; the other one ends at the cut and counts as long as the whole web.
TEST(BlockPanels, AWebRoundACornerIsTwoStrips) {
  WebMesh web(0.2);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      if (i < 3 || j < 3) web.add_square(i, j);
  const BlockPanels panels =
      web.panels([](const Vector3& middle) { return middle.x() < 1e-9 || middle.y() < 1e-9; });
  const std::vector<int> strips = webs_of(panels);
  ASSERT_EQ(strips.size(), 2U);
  double narrower = 1, wider = 0;
  for (const int strip : strips) {
    const Panel& panel = panels.panels()[static_cast<std::size_t>(strip)];
    EXPECT_NEAR(panel.size.a, 4, 1e-9);
    EXPECT_EQ(panel.free.along_a, 1);
    narrower = std::min(narrower, panel.size.b);
    wider = std::max(wider, panel.size.b);
  }
  EXPECT_NEAR(narrower, 0.6, 1e-9);
  EXPECT_NEAR(wider, 0.6 + 0.5 * 0.6 * 0.6 / 4, 1e-9);
}

// Of a web along a side of 3 m and a floor of 4 m either strip may have the corner, with rectangles
// of one size: it is the longer one, to port as to starboard, whose mesh is finer.
TEST(BlockPanels, AMirrorImageIsCutAlike) {
  for (const bool is_mirrored : {false, true}) {
    const int finer = is_mirrored ? 2 : 1;
    WebMesh web(0.2 / finer);
    for (int i = 0; i < 20 * finer; ++i)
      for (int j = 0; j < 15 * finer; ++j)
        if ((is_mirrored ? 20 * finer - 1 - i : i) < 3 * finer || j < 3 * finer)
          web.add_square(i, j);
    const BlockPanels panels = web.panels([&](const Vector3& middle) {
      return middle.y() < 1e-9 || (is_mirrored ? 4 - middle.x() : middle.x()) < 1e-9;
    });
    const std::vector<int> strips = webs_of(panels);
    ASSERT_EQ(strips.size(), 2U);
    int with_corner = 0;
    for (const int strip : strips) {
      const Panel& panel = panels.panels()[static_cast<std::size_t>(strip)];
      EXPECT_NEAR(panel.size.a, 4, 1e-9);  // that of the side ends at the cut
      if (std::abs(panel.e_1.x()) < 0.5) continue;
      ++with_corner;
      EXPECT_NEAR(panel.size.b, 0.6 + 0.5 * 0.6 * 0.6 / 4, 1e-9);
    }
    EXPECT_EQ(with_corner, 1);
  }
}

// Simply supported along all its edges under the same compression every way, a polygon buckles at
// D lambda / t, lambda being that of its membrane: 9.63972 / a^2 for an L of three squares (Fox,
// Henrici and Moler, 1967, Approximations and bounds for eigenvalues of elliptic operators). The
// pieces must not claim more: a support along the cut would have 12.34.
TEST(BlockPanels, ACutHoldsNothing) {
  WebMesh plate(0.25);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      if (i < 4 || j < 4) plate.add_square(i, j);
  const BlockPanels panels = plate.panels([](const Vector3&) { return true; });
  const double membrane = 9.63972 / (std::numbers::pi * std::numbers::pi);
  const double critical = membrane * euler_stress(steel, 0.012, 1);
  const std::vector<int> pieces = webs_of(panels);
  ASSERT_EQ(pieces.size(), 2U);
  double largest = 0;
  for (const int piece : pieces)
    largest = std::max(largest, panels.utilisation(piece, {-critical, -critical, 0, 0, 0}).elastic);
  // The longer piece is 2 m by 1.25 m.
  EXPECT_NEAR(largest, membrane / (1 / 4.0 + 1 / 1.5625), 1e-6);
  EXPECT_GT(largest, 1);
}

// Neither an opening nor a slope makes a plate go round a corner.
TEST(BlockPanels, OpeningsAndBracketsAreNotCut) {
  WebMesh floor(0.25);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 4; ++j)
      if (!(i >= 2 && i < 5 && j >= 1 && j < 3)) floor.add_square(i, j);
  const BlockPanels floors = floor.panels([](const Vector3& middle) {
    return middle.x() < 1e-9 || middle.x() > 2 - 1e-9 || middle.y() < 1e-9 || middle.y() > 1 - 1e-9;
  });
  ASSERT_EQ(webs_of(floors).size(), 1U);
  const Panel& whole = floors.panels()[static_cast<std::size_t>(webs_of(floors).front())];
  EXPECT_NEAR(whole.size.a, 2, 1e-9);
  EXPECT_NEAR(whole.size.b, 1, 1e-9);
  EXPECT_EQ(whole.free.along_a + whole.free.along_b, 0);
  WebMesh bracket(0.125);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; i + j < 3; ++j) bracket.add_square(i, j);
    bracket.add_triangle(i, 3 - i);
  }
  const BlockPanels brackets =
      bracket.panels([](const Vector3& middle) { return middle.x() < 1e-9 || middle.y() < 1e-9; });
  ASSERT_EQ(webs_of(brackets).size(), 1U);
  const Panel& triangle = brackets.panels()[static_cast<std::size_t>(webs_of(brackets).front())];
  EXPECT_NEAR(triangle.size.a, 0.5 * std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(triangle.size.b, 0.25 * std::numbers::sqrt2, 1e-9);
  EXPECT_EQ(triangle.free.along_a, 1);
}

/// Pipe along x, 2 m long, of 72 flat facets that turn by 5 degrees each.
Mesh pipe_that_bends(double radius) {
  constexpr int facets = 72, rings = 2;
  Mesh mesh;
  mesh.materials = {steel};
  mesh.groups = {{"pipe"}};
  mesh.regions = {{.name = "pipe", .group = 0}};
  mesh.shell_sections = {{.thickness = 0.010}};
  for (int ring = 0; ring <= rings; ++ring)
    for (int facet = 0; facet < facets; ++facet) {
      const double angle = 2 * std::numbers::pi * facet / facets;
      mesh.vertices.emplace_back(ring, radius * std::cos(angle), radius * std::sin(angle));
    }
  for (int ring = 0; ring < rings; ++ring)
    for (int facet = 0; facet < facets; ++facet) {
      const int next = (facet + 1) % facets, here = facets * ring, beyond = here + facets;
      mesh.shells.push_back(
          {.vertices = {here + facet, beyond + facet, here + next, beyond + next}});
    }
  return mesh;
}

/// u = (c x z, 0, -c x^2 / 2): e_11 = c z and no other strain in planes along x.
Motion6 bent_upwards(const Vector3& x) {
  const double c = 1e-4;
  Motion6 motion;
  motion << c * x.x() * x.z(), 0, -c * x.x() * x.x() / 2, 0, 0, 0;
  return motion;
}

// A pipe that bends is compressed on one side: the mean over a sector of 30 degrees about its
// lowest line is sin(15 degrees) / (pi / 12) = 0.989 of the stress there, over one that ends at
// that line sin(75 degrees) times as much, 0.955; facets take 0.001 off. Round it a long pipe bears
// 3 D / (R^2 t) (Timoshenko and Gere, 1961, chapter 7), however narrow its sectors.
TEST(BlockPanels, APipeIsCutIntoSectors) {
  const double radius = 0.5;
  const ElasticModel model(pipe_that_bends(radius), {2, {}});
  const BlockPanels panels(model, test::motion_of(model.space(), bent_upwards), {});
  ASSERT_EQ(panels.panels().size(), 12U);
  double least = 0;
  for (const PanelStress& stress : panels.stresses(Eigen::VectorXd::Ones(1)))
    least = std::min(least, stress.s11);
  const double lowest = -steel.youngs_modulus / (1 - 0.09) * 1e-4 * radius;
  EXPECT_GT(least / lowest, 0.953);
  EXPECT_LT(least / lowest, 0.990);
  const double round_it =
      3 * euler_stress(steel, 0.010, 1) / (std::numbers::pi * std::numbers::pi * radius * radius);
  for (std::size_t p = 0; p < 12; ++p) {
    const Panel& panel = panels.panels()[p];
    EXPECT_NEAR(std::abs(panel.e_1.x()), 1, 1e-9);
    EXPECT_NEAR(panel.size.a, 2, 1e-9);
    EXPECT_NEAR(panel.size.b, 2 * radius * std::sin(std::numbers::pi / 12), 1e-9);
    // 72 facets are shorter than the circle by 3e-4.
    EXPECT_NEAR(panels.utilisation(static_cast<int>(p), {0, -round_it, 0, 0, 0}).elastic, 1, 2e-3);
  }
}

// Hooke's law in the plane: s_11 = E / (1 - nu^2) (c + d y), s_22 = nu s_11.
TEST(BlockPanels, MeanAndGradientOfALinearStressAreExact) {
  const ElasticModel model(generate_shell_mesh(box()), {2, {}});
  const BlockPanels panels(model, test::motion_of(model.space(), bent_in_plane), {});
  const auto found = panels.stresses(Eigen::VectorXd::Ones(1));
  const double c = 1e-4, d = 3e-5, modulus = steel.youngs_modulus / (1 - 0.09);
  int seen = 0;
  for (std::size_t p = 0; p < found.size(); ++p) {
    const Panel& panel = panels.panels()[p];
    if (panel.group != "deck") continue;
    ++seen;
    const double s11 = modulus * (c + d * panel.centre_B.y());
    EXPECT_NEAR(found[p].s11, s11, 1);
    EXPECT_NEAR(found[p].s22, 0.3 * s11, 1);
    EXPECT_NEAR(std::abs(found[p].s11_gradient), modulus * d * panel.size.b / 2, 1);
    EXPECT_NEAR(found[p].s12, 0, 1);
    EXPECT_NEAR(found[p].s22_gradient, 0, 1);
  }
  EXPECT_EQ(seen, 4);
}

// However the block lies, and whichever way its shells look, its panels and their stresses are the
// same.
TEST(BlockPanels, DoNotDependOnTheBlocksDirection) {
  const Mesh mesh = generate_shell_mesh(box());
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.rotate(Eigen::AngleAxisd(0.4, Vector3(0.2, -1, 0.5).normalized()));
  X.pretranslate(Vector3(5, 2, -3));
  Mesh turned = test::moved(mesh, X);
  for (std::size_t s = 0; s < turned.shells.size(); s += 2) {
    std::swap(turned.shells[s].vertices[0], turned.shells[s].vertices[1]);
    std::swap(turned.shells[s].vertices[2], turned.shells[s].vertices[3]);
  }
  const ElasticModel straight(mesh, {2, {}}), tilted(turned, {2, {}});
  const BlockPanels of_straight(straight, test::motion_of(straight.space(), bent_in_plane), {});
  const BlockPanels of_tilted(tilted,
                              test::motion_of(tilted.space(),
                                              [&](const Vector3& place) -> Motion6 {
                                                Motion6 motion = bent_in_plane(X.inverse() * place);
                                                motion.head<3>() =
                                                    (X.linear() * motion.head<3>()).eval();
                                                return motion;
                                              }),
                              {});
  ASSERT_EQ(of_straight.panels().size(), of_tilted.panels().size());
  const auto stresses = of_straight.stresses(Eigen::VectorXd::Ones(1)),
             stresses_tilted = of_tilted.stresses(Eigen::VectorXd::Ones(1));
  for (std::size_t p = 0; p < stresses.size(); ++p) {
    const Panel &a = of_straight.panels()[p], &b = of_tilted.panels()[p];
    EXPECT_LT((X * a.centre_B - b.centre_B).norm(), 1e-9);
    EXPECT_NEAR(of_straight.utilisation(static_cast<int>(p), stresses[p]).critical,
                of_tilted.utilisation(static_cast<int>(p), stresses_tilted[p]).critical, 1e-7)
        << a.plate;
    // Squares may lie either way.
    const bool is_same_way = std::abs(b.e_1.dot(X.linear() * a.e_1)) > 0.5;
    const PanelStress &s = stresses[p], &t = stresses_tilted[p];
    EXPECT_NEAR(s.s11, is_same_way ? t.s11 : t.s22, 10);
    EXPECT_NEAR(std::abs(s.s12), std::abs(t.s12), 10);
    EXPECT_NEAR(std::abs(s.s11_gradient), std::abs(is_same_way ? t.s11_gradient : t.s22_gradient),
                10);
  }
}

}  // namespace
}  // namespace blocklift::structure
