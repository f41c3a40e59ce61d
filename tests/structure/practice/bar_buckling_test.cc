// Bars of a block as columns: which pieces of them stand free, and what compresses and bends them.
#include "structure/practice/bar_buckling.h"

#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/mesh/beams/sections.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/practice/tripping.h"
#include "structure/response/unit_responses.h"
#include "tests/structure/motions.h"
#include "tests/structure/practice/halved_beams.h"

namespace blocklift::structure {
namespace {

constexpr double free_fall = 9.81;
const Material column_steel{"S355", 210e9, 0.3, 7850, 355e6};

/// A bar along x in four pieces, hung at its ends, where thin rods stand out to either side: a
/// block has an extent in two directions.
Mesh bar_between_lugs(const Profile& profile, double length) {
  Mesh mesh;
  mesh.materials = {column_steel};
  mesh.groups = {{"spreader"}, {"rods"}};
  mesh.regions = {{.name = "spreader", .group = 0}, {.name = "rods", .group = 1}};
  mesh.beam_sections = {profile.section, solid_circle(0.002).section};
  for (int i = 0; i <= 4; ++i) mesh.vertices.emplace_back(length * i / 4, 0, 0);
  for (int i = 0; i < 4; ++i) {
    Beam beam;
    beam.vertices = {i, i + 1};
    if (i == 2) std::swap(beam.vertices[0], beam.vertices[1]);  // whichever way they are drawn
    mesh.beams.push_back(beam);
  }
  for (const int end : {0, 4})
    for (const double side : {-0.1, 0.1}) {
      Beam rod;
      rod.vertices = {end, static_cast<int>(mesh.vertices.size())};
      rod.section = rod.region = 1;
      mesh.vertices.emplace_back(length * end / 4, side, 0);
      mesh.beams.push_back(rod);
    }
  for (const int vertex : {0, 4})
    mesh.lifting_points.push_back({.name = "L" + std::to_string(vertex),
                                   .p_BPin = mesh.vertices[vertex],
                                   .radius = 0.1,
                                   .vertex = vertex});
  return mesh;
}

BlockBars bars_of(const ElasticModel& model, const Eigen::MatrixXd& motions) {
  return {model, motions, BlockPanels(model, motions, {})};
}

// Slings at 45 degrees press a bar of weight G by G / 2 while it bends by G L / 8: the worst place
// is its middle, and both figures double under twice gravity.
TEST(BarBuckling, ABarUnderSlingsIsASpreader) {
  constexpr double length = 12;
  const Profile tube = pipe(0.08, 0.075);
  const ElasticModel model(bar_between_lugs(tube, length), {.degree = 2, .largest_edge = {}});
  const UnitResponses responses(model);
  const BlockBars bars = bars_of(model, responses.displacements());
  ASSERT_EQ(bars.spans().size(), 5U);
  const BarSpan& span = bars.spans().front();
  EXPECT_EQ(span.bar, "spreader");
  EXPECT_DOUBLE_EQ(span.column.length, length);
  EXPECT_DOUBLE_EQ(span.column.second_moments[0], tube.section.second_moment_2);
  EXPECT_NEAR(span.column.section_moduli[1], tube.section.second_moment_3 / 0.08, 1e-12);

  const double weight = column_steel.density * tube.section.area * length * free_fall;
  const double upwards = model.mass_properties().mass * free_fall / 2;
  LoadCase hanging{"at rest", {}, {}};
  hanging.field.acceleration_less_gravity = Vector3(0, 0, free_fall);
  hanging.lug_forces_B = {Vector3(weight / 2, 0, upwards), Vector3(-weight / 2, 0, upwards)};
  Eigen::MatrixXd factors(responses.count(), 2);
  factors.col(0) = responses.coefficients(hanging);
  factors.col(1) = 2 * factors.col(0);
  const BlockBars::Worst worst = bars.find_worst(factors, 1.5).front().column;
  EXPECT_EQ(worst.instant, 1);
  EXPECT_NEAR(worst.share, 0.5, 1e-12);
  EXPECT_NEAR(worst.forces.compression, weight, 1e-6 * weight);
  const double moment = std::hypot(worst.forces.moments[0], worst.forces.moments[1]);
  EXPECT_NEAR(moment, weight * length / 4, 1e-6 * moment);
  EXPECT_DOUBLE_EQ(worst.utilisation, column_utilisation(span.column, worst.forces, 1.5));
  EXPECT_GT(worst.utilisation, bars.find_worst(factors, 1).front().column.utilisation);
}

// The moments about an angle's principal axes are those of the force, and its weaker axis is the
// smaller of the principal second moments.
TEST(BarBuckling, AnAngleBendsAboutItsPrincipalAxes) {
  const Profile angle = angle_bar(0.1, 0.01, 0.1, 0.01);
  const ElasticModel model(bar_between_lugs(angle, 4), {.degree = 2, .largest_edge = {}});
  const UnitResponses responses(model);
  const BlockBars bars = bars_of(model, responses.displacements());
  const BarSpan& span = bars.spans().front();
  const double mean = (angle.section.second_moment_2 + angle.section.second_moment_3) / 2;
  const double apart =
      std::hypot((angle.section.second_moment_2 - angle.section.second_moment_3) / 2,
                 angle.section.product_23);
  EXPECT_NEAR(span.column.second_moments[0], mean - apart, 1e-12);
  EXPECT_NEAR(span.column.second_moments[1], mean + apart, 1e-12);
  const double weight = column_steel.density * angle.section.area * 4 * free_fall;
  LoadCase hanging{"at rest", {}, {}};
  hanging.field.acceleration_less_gravity = Vector3(0, 0, free_fall);
  hanging.lug_forces_B.assign(2, {0, 0, model.mass_properties().mass * free_fall / 2});
  const Eigen::MatrixXd factors = responses.coefficients(hanging);
  const BlockBars::Worst worst = bars.find_worst(factors, 1).front().column;
  const double moment = weight * 4 / 8;
  // An equal angle's principal axes lie at 45 degrees to its legs.
  for (const double part : worst.forces.moments)
    EXPECT_NEAR(std::abs(part), moment * std::sqrt(0.5), 1e-4 * moment);
}

// What tapers is one column of its weakest section with what goes on from it; the vectors that
// orient its pieces may lean along them and be of any length.
TEST(BarBuckling, TaperedPiecesAreOneColumn) {
  const Profile thick = pipe(0.08, 0.07), thin = pipe(0.06, 0.055);
  Mesh mesh = bar_between_lugs(thick, 12);
  mesh.beam_sections.push_back(thin.section);
  for (const std::size_t beside_middle : {1U, 2U}) mesh.beams[beside_middle].end_section = 2;
  for (std::size_t i = 0; i < 4; ++i)
    mesh.beams[i].axis_2 = Vector3(2.0 * static_cast<double>(i) - 3, 0, i % 2 == 0 ? 0.01 : 5.01);
  const ElasticModel model(std::move(mesh), {.degree = 2, .largest_edge = {}});
  const UnitResponses responses(model);
  const BlockBars bars = bars_of(model, responses.displacements());
  ASSERT_EQ(bars.spans().size(), 5U);
  const Column& column = bars.spans().front().column;
  EXPECT_DOUBLE_EQ(column.length, 12);
  EXPECT_DOUBLE_EQ(column.area, thin.section.area);
  EXPECT_NEAR(column.second_moments[0], thin.section.second_moment_2, 1e-15);
  EXPECT_NEAR(column.section_moduli[1], thin.section.second_moment_3 / 0.06, 1e-9);
}

/// A deck of 4 x 3 m with bulkheads below at x = 0, 2, 4 and flat bars beneath it at y = 1 and 2.
Mesh stiffened_deck() {
  BlockDescription block;
  block.name = "deck";
  block.materials = {column_steel};
  block.largest_element = 0.5;
  block.plates = {{"deck", Axis::z, {3}, {{{0, 4}, {0, 3}, {0, 0}}}, 0.01, "S355"},
                  {"bulkheads", Axis::x, {0, 2, 4}, {{{0, 0}, {0, 3}, {2, 3}}}, 0.01, "S355"}};
  for (const double y : {1.0, 2.0})
    block.bars.push_back({"joists at y = " + std::to_string(static_cast<int>(y)) + " m",
                          {{0, y, 3}, {4, y, 3}},
                          flat_bar(0.2, 0.012),
                          Vector3(0, 0, 1),
                          "S355"});
  Mesh mesh = generate_shell_mesh(block);
  for (Beam& beam : mesh.beams) beam.offset.fill(Vector3(0, 0, -0.105));
  return mesh;
}

/// Factors that strain a deck along x by `stretch`, without stress across, and bend it by
/// `curvature` about its mid-surface.
test::MotionField deck_motion(double stretch, double curvature) {
  return [=](const Vector3& x) {
    const double below = x.z() - 3;
    Eigen::Matrix<double, 6, 1> motion;
    motion << stretch * x.x() - curvature * x.x() * below, -0.3 * stretch * x.y(),
        curvature * x.x() * x.x() / 2, 0, -curvature * x.x(), 0;
    return motion;
  };
}

// A stiffener bears with half of either panel, from bulkhead to bulkhead: an even strain gives the
// force of both areas, a curvature the force of the stiffener alone and the moment of both.
void expect_bearing_with_plates(Mesh mesh) {
  const ElasticModel model(std::move(mesh), {.degree = 2, .largest_edge = {}});
  Eigen::MatrixXd motions(model.freedoms(), 2);
  motions << test::motion_of(model.space(), deck_motion(-1e-3, 0)),
      test::motion_of(model.space(), deck_motion(0, 1e-3));
  const BlockBars bars = bars_of(model, motions);
  ASSERT_EQ(bars.spans().size(), 4U);
  const double plate = 1.0 * 0.01, web = 0.2 * 0.012, area = plate + web;
  const double centroid = web * 0.105 / area;
  const double second_moment = 0.012 * std::pow(0.2, 3) / 12 + web * std::pow(0.105 - centroid, 2) +
                               std::pow(0.01, 3) / 12 + plate * centroid * centroid;
  for (const BarSpan& span : bars.spans()) {
    EXPECT_EQ(span.bar.substr(0, 6), "joists");
    EXPECT_NEAR(span.column.length, 2, 1e-12);
    EXPECT_NEAR(span.plate_width, 1, 1e-12);
    EXPECT_NEAR(span.column.area, area, 1e-12);
    EXPECT_NEAR(span.column.second_moments[0], second_moment, 1e-9 * second_moment);
  }
  const double modulus = column_steel.youngs_modulus;
  const auto pressed = bars.find_worst(Eigen::Vector2d(1, 0), 1);
  for (const auto& [worst, tripping] : pressed) {
    EXPECT_NEAR(worst.forces.compression, 1e-3 * modulus * area, 1e-6 * modulus * area * 1e-3);
    EXPECT_NEAR(worst.forces.moments[0], 0, 1e-6 * modulus * second_moment);
  }
  const auto bent = bars.find_worst(Eigen::Vector2d(0, -1), 1);
  for (const auto& [worst, tripping] : bent) {
    EXPECT_NEAR(worst.forces.compression, 1e-3 * modulus * web * 0.105,
                1e-3 * modulus * web * 1e-6);
    EXPECT_NEAR(std::abs(worst.forces.moments[0]), 1e-3 * modulus * second_moment,
                1e-9 * modulus * second_moment);
  }
}

TEST(BarBuckling, StiffenersBearWithTheirPlates) { expect_bearing_with_plates(stiffened_deck()); }

// Of quadratic elements a stiffener has vertices in the middles of edges, too.
TEST(BarBuckling, StiffenersOfQuadraticElementsBearAlike) {
  expect_bearing_with_plates(test::with_halved_beams(stiffened_deck()));
}

// A stiffener trips by the compression of its centroid, and bent by that of its outer fibre, whose
// bending grows with the column's compression; pulled it does not.
TEST(BarBuckling, StiffenersTrip) {
  const ElasticModel model(stiffened_deck(), {.degree = 2, .largest_edge = {}});
  Eigen::MatrixXd motions(model.freedoms(), 2);
  motions << test::motion_of(model.space(), deck_motion(-1e-3, 0)),
      test::motion_of(model.space(), deck_motion(0, 1e-3));
  const BlockBars bars = bars_of(model, motions);
  const double modulus = column_steel.youngs_modulus, shear = column_steel.shear_modulus();
  const double elastic =
      tripping_stress(column_steel,
                      {flat_bar(0.2, 0.012).section.torsion,
                       0.012 * std::pow(0.2, 3) / 3 + 0.2 * std::pow(0.012, 3) / 12, 0.1,
                       0.2 * std::pow(0.012, 3) / 12},
                      2);
  EXPECT_GT(elastic, shear * std::pow(0.012 / 0.2, 2) * 0.95);
  const double strength = tripping_strength(elastic, column_steel.yield_stress);
  const auto pressed = bars.find_worst(Eigen::Vector2d(0.5, 0), 1.5);
  const auto bent = bars.find_worst(Eigen::Vector2d(0, -0.5), 1.5);
  const auto pulled = bars.find_worst(Eigen::Vector2d(-1, 0), 1.5);
  for (std::size_t s = 0; s < bars.spans().size(); ++s) {
    EXPECT_NEAR(bars.spans()[s].tripping_stress, elastic, 1e-9 * elastic);
    EXPECT_NEAR(bars.spans()[s].tripping_strength, strength, 1e-9 * strength);
    const double even = 0.75e-3 * modulus;
    EXPECT_NEAR(pressed[s].tripping.compression, even, 1e-6 * even);
    EXPECT_NEAR(pressed[s].tripping.utilisation, even / strength, 1e-6 * even / strength);
    const double force = 0.75e-3 * modulus * 0.2 * 0.012 * 0.105;
    const double left = 1 - force / euler_load(bars.spans()[s].column, 0);
    const double outer = 0.75e-3 * modulus * (0.105 + 0.1 / left);
    EXPECT_NEAR(bent[s].tripping.compression, outer, 1e-5 * outer);
    EXPECT_EQ(pulled[s].tripping.utilisation, 0);
  }
}

// Tripping brackets shorten the length over which a stiffener turns, and nothing of it as a column.
// By hand, of a flat bar of 200 x 12 mm, G = 80.769 GPa, with brackets every 0.5 m:
//   I_t = h t^3 / 3 (1 - 0.63 t / h) = 1.1084544e-7 m^4,
//   I_po = h^3 t / 3 + h t^3 / 12 = 3.20288e-5 m^4,  I_z = h t^3 / 12 = 2.88e-8 m^4,  h_s = 0.1 m,
//   f_ET = G I_t / I_po + pi^2 E h_s^2 I_z / (I_po l_T^2) = 279.53 + 74.55 MPa;
// over the whole 2 m the second part is a sixteenth. Brackets that are farther apart than the
// supports do nothing.
TEST(BarBuckling, TrippingBracketsShortenTheLength) {
  const auto spans_with = [](double spacing) {
    Mesh mesh = stiffened_deck();
    for (Group& group : mesh.groups) group.tripping_brackets = spacing;
    const ElasticModel model(std::move(mesh), {.degree = 1, .largest_edge = {}});
    return bars_of(model, Eigen::MatrixXd::Zero(model.freedoms(), 1)).spans();
  };
  const auto without = spans_with(0), close = spans_with(0.5), far = spans_with(3);
  ASSERT_EQ(without.size(), 4U);
  constexpr double of_torsion = 279.53e6, of_warping = 74.55e6;
  for (std::size_t s = 0; s < without.size(); ++s) {
    EXPECT_EQ(without[s].tripping_length, without[s].column.length);
    EXPECT_EQ(close[s].tripping_length, 0.5);
    EXPECT_TRUE(close[s].has_tripping_brackets());
    EXPECT_NEAR(without[s].tripping_stress, of_torsion + of_warping / 16, 0.02e6);
    EXPECT_NEAR(close[s].tripping_stress, of_torsion + of_warping, 0.02e6);
    EXPECT_GT(close[s].tripping_strength, without[s].tripping_strength);
    EXPECT_EQ(close[s].column.length, without[s].column.length);
    EXPECT_FALSE(far[s].has_tripping_brackets());
    EXPECT_EQ(far[s].tripping_stress, without[s].tripping_stress);
  }
}

// A deep beam across holds the stiffeners, one of their own size does not.
TEST(BarBuckling, DeepBeamsHoldStiffeners) {
  for (const double depth : {0.2, 0.5}) {
    Mesh mesh = stiffened_deck();
    const Profile across = flat_bar(depth, 0.012);
    mesh.beam_sections.push_back(across.section);
    std::set<std::array<int, 2>> edges;  // of the deck at x = 1 m, along y
    for (const Shell& shell : mesh.shells)
      for (const int from : shell.vertices)
        for (const int to : shell.vertices) {
          const Vector3 &a = mesh.vertices[from], &b = mesh.vertices[to];
          if (std::abs(a.x() - 1) < 1e-9 && std::abs(b.x() - 1) < 1e-9 && a.y() < b.y() - 1e-9)
            edges.insert({from, to});
        }
    for (const std::array<int, 2>& edge : edges) {
      Beam beam;
      beam.vertices = edge;
      beam.section = static_cast<int>(mesh.beam_sections.size()) - 1;
      beam.region = mesh.beams.front().region;
      beam.offset.fill(Vector3(0, 0, -0.005 - depth / 2));
      beam.axis_2 = mesh.beams.front().axis_2;
      mesh.beams.push_back(beam);
    }
    const ElasticModel model(std::move(mesh), {.degree = 1, .largest_edge = {}});
    const BlockBars bars = bars_of(model, Eigen::MatrixXd::Zero(model.freedoms(), 1));
    std::multiset<long> lengths;  // mm, of those along x
    for (const BarSpan& span : bars.spans())
      if (std::abs(span.p_BFrom.x() - span.p_BTo.x()) > 0.1)
        lengths.insert(std::lround(1000 * span.column.length));
    const std::multiset<long> expected =
        depth > 0.3 ? std::multiset<long>{1000, 1000, 1000, 1000, 2000, 2000}
                    : std::multiset<long>{2000, 2000, 2000, 2000};
    EXPECT_EQ(lengths, expected) << depth;
  }
}

// Of a block of plates: a pillar through a deck has a span on either side of it, two braces that
// cross hold each other, and a stiffener on a plate does not stand free.
TEST(BarBuckling, SpansEndAtWhatHoldsThem) {
  BlockDescription block;
  block.name = "decks";
  block.materials = {column_steel};
  block.largest_element = 0.5;
  block.plates = {{"deck", Axis::z, {0, 1, 3}, {{{0, 4}, {0, 3}, {0, 0}}}, 0.01, "S355"},
                  {"bulkhead", Axis::x, {4}, {{{0, 0}, {0, 3}, {0, 3}}}, 0.01, "S355"}};
  const Profile tube = pipe(0.05, 0.045);
  block.bars = {{"pillar", {{1, 1, 0}, {1, 1, 3}}, tube, {}, "S355"},
                {"cross", {{2, 1, 1}, {3, 1, 3}}, tube, {}, "S355"},
                {"other", {{2, 1, 3}, {3, 1, 1}}, tube, {}, "S355"},
                {"joist", {{0, 2, 3}, {4, 2, 3}}, flat_bar(0.1, 0.01), Vector3(0, 0, 1), "S355"},
                {"post", {{1, 2, 3}, {1, 2, 4.5}}, tube, {}, "S355"}};
  Mesh mesh = generate_shell_mesh(block);
  for (const Vector3& place : {Vector3(0, 0, 3), Vector3(4, 0, 3), Vector3(0, 3, 3)})
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      if ((mesh.vertices[v] - place).norm() < 1e-6)
        mesh.lifting_points.push_back({.name = "L" + std::to_string(v),
                                       .p_BPin = place,
                                       .radius = 0.1,
                                       .vertex = static_cast<int>(v)});
  const ElasticModel model(std::move(mesh), {.degree = 1, .largest_edge = {}});
  const BlockBars bars = bars_of(model, Eigen::MatrixXd::Zero(model.freedoms(), 1));
  std::multiset<std::pair<std::string, long>> found;  // and length in mm
  for (const BarSpan& span : bars.spans())
    if (span.plate_width == 0) found.emplace(span.bar, std::lround(1000 * span.column.length));
  const long half = std::lround(1000 * std::sqrt(5) / 2);
  const std::multiset<std::pair<std::string, long>> expected{
      {"pillar", 1000}, {"pillar", 2000}, {"cross", half}, {"cross", half},
      {"other", half},  {"other", half},  {"post", 3000}};  // its top is free: twice its length
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace blocklift::structure
