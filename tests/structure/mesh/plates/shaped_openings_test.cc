// Openings that are circles, slots, rounded rectangles or polygons.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/system/assembly.h"
#include "tests/structure/formulation/gravity.h"
#include "tests/structure/hull_block.h"
#include "tests/structure/mesh/plates/mesh_measures.h"

namespace blocklift::structure {
namespace {

using std::numbers::pi;
using test::expect_conforming;
using test::measure;
using ::testing::HasSubstr;

BlockDescription plate_of(double length, double breadth, Axis normal = Axis::z) {
  BlockDescription block;
  block.name = "plate";
  block.materials = {test::steel()};
  std::array<Interval, 3> extent;
  const auto u = at((static_cast<int>(normal) + 1) % 3), v = at((static_cast<int>(normal) + 2) % 3);
  extent[u] = {0, length};
  extent[v] = {0, breadth};
  block.plates = {{"floor", normal, {0}, extent, 0.012, "AH36"}};
  block.largest_element = 1;
  return block;
}

Opening opening(Interval x, Interval y, double corner_radius) {
  Opening hole;
  hole.name = "hole";
  hole.plate = "floor";
  hole.extent = {x, y, {}};
  hole.corner_radius = corner_radius;
  return hole;
}

// Share of a disc's area that cubics through four points of arcs leave out: the error of the 3/8
// rule, with h a third of the arc, makes the mean radius h^4 / 80 smaller (3 h^5 / 80 of the
// integral over 3 h). A tenth more is for the next order.
double area_error(double arc) { return 1.1 * std::pow(arc / 3, 4) / 40; }

// Arcs are followed by polynomials of third degree over an eighth of a circle: the area is off by
// less than 1e-5 of the hole's.
TEST(ShapedOpenings, LeaveTheAreaThatIsNotCut) {
  struct Sample {
    Interval x, y;
    double radius, area, arc;
  };
  const Sample samples[] = {{{1, 1.6}, {0.7, 1.3}, 0.3, pi * 0.09, pi / 4},
                            {{1, 1.8}, {0.7, 1.3}, 0.3, 0.2 * 0.6 + pi * 0.09, pi / 4},
                            {{1, 1.6}, {0.5, 1.3}, 0.1, 0.6 * 0.8 - (4 - pi) * 0.01, pi / 2}};
  for (const Sample& sample : samples)
    for (const double largest : {1.0, 0.3, 0.07}) {
      BlockDescription block = plate_of(4, 2);
      block.largest_element = largest;
      block.openings = {opening(sample.x, sample.y, sample.radius)};
      const Mesh mesh = generate_shell_mesh(block);
      expect_conforming(mesh);
      check_mesh(mesh);
      const auto steel = measure(mesh);
      EXPECT_NEAR(steel.area, 8 - sample.area,
                  area_error(sample.arc) * pi * sample.radius * sample.radius);
      double longest = 0;
      for (const Shell& shell : mesh.shells) longest = std::max(longest, longest_edge(mesh, shell));
      EXPECT_LE(longest, largest * (1 + 1e-9));
      const double x = (sample.x.lower + sample.x.upper) / 2;
      EXPECT_NEAR(steel.centre.x(), (8 * 2 - sample.area * x) / (8 - sample.area), 1e-5);
    }
}

TEST(ShapedOpenings, MayBePolygonsInPlatesOfAnyAxis) {
  for (const Axis normal : {Axis::x, Axis::y, Axis::z}) {
    BlockDescription block = plate_of(4, 2, normal);
    const auto u = (static_cast<int>(normal) + 1) % 3, v = (static_cast<int>(normal) + 2) % 3;
    Opening hole;
    hole.name = "hole";
    hole.plate = "floor";
    for (const auto& [a, b] : {std::pair{1.0, 0.5}, {1.2, 1.5}, {2.0, 1.2}, {1.8, 0.6}}) {
      Vector3 corner = Vector3::Zero();
      corner[u] = a;
      corner[v] = b;
      hole.corners.push_back(corner);
    }
    block.openings = {hole};
    const Mesh mesh = generate_shell_mesh(block);
    expect_conforming(mesh);
    // Shoelace formula.
    const double area = 0.5 * std::abs((1.0 * 1.5 - 1.2 * 0.5) + (1.2 * 1.2 - 2.0 * 1.5) +
                                       (2.0 * 0.6 - 1.8 * 1.2) + (1.8 * 0.5 - 1.0 * 0.6));
    EXPECT_NEAR(measure(mesh).area, 8 - area, 1e-9);
    std::reverse(block.openings[0].corners.begin(), block.openings[0].corners.end());
    EXPECT_NEAR(measure(generate_shell_mesh(block)).area, 8 - area, 1e-9);
  }
}

TEST(ShapedOpenings, LieBetweenPlatesAndStiffeners) {
  // Manholes in the frames of a box, close to its bottom, beside a web and one another.
  BlockDescription block = test::small_block();
  block.plates.push_back({"web", Axis::y, {1.5}, {{{0, 4}, {}, {0, 0.5}}}, 0.01, "AH36"});
  for (const auto& [name, y] : {std::pair{"a", 0.5}, {"b", 1.1}, {"c", 2.2}}) {
    Opening hole;
    hole.name = name;
    hole.plate = "frames";
    hole.extent = {{{}, {y - 0.25, y + 0.25}, {0.1, 0.9}}};
    hole.corner_radius = 0.25;
    block.openings.push_back(hole);
  }
  Stiffeners row;
  row.name = "bars";
  row.plate = "frames";
  row.along = Axis::z;
  row.spacing = 1;
  row.first = 2.2;
  row.section.area = 0.001;
  row.section.second_moment_2 = row.section.second_moment_3 = row.section.torsion = 1e-7;
  row.section.shear_area_2 = row.section.shear_area_3 = 0.0008;
  block.stiffeners = {row};
  const Mesh mesh = generate_shell_mesh(block);
  expect_conforming(mesh);
  const auto steel = measure(mesh);
  const double hole = 0.5 * 0.3 + pi * 0.0625;
  EXPECT_NEAR(steel.area_of_group.at("frames"), 3 * (6 - 3 * hole),
              9 * area_error(pi / 2) * pi * 0.0625);
  double lowest = 2;  // of the stiffener over the third hole
  for (const Beam& beam : mesh.beams)
    if (std::abs(mesh.vertices[beam.vertices[0]].y() - 2.2) < 1e-9)
      lowest = std::min(lowest, mesh.vertices[beam.vertices[0]].z());
  EXPECT_GE(lowest, 0.9);
  EXPECT_LE(lowest, 0.9 + 0.5);
  const auto reactions = test::weigh(mesh, 3, {{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}});
  const double weight = 9.81 * steel.mass;
  EXPECT_NEAR(reactions[0] + reactions[1] + reactions[2], weight, 1e-6 * weight);
}

// Kirsch (1898): a hole of radius r adds 3 pi r^2 s^2 t / (2 E) to the strain energy of a wide
// plate under the tension s, so the work of the forces at its ends rises by twice that.
TEST(ShapedOpenings, SoftenAPlateAsKirschSays) {
  const double length = 8, breadth = 8, radius = 0.2, t = 0.012, stress = 100e6;
  double stretch[2];
  for (const bool has_hole : {false, true}) {
    BlockDescription block = plate_of(length, breadth);
    block.largest_element = 0.5;
    if (has_hole) block.openings = {opening({3.8, 4.2}, {3.8, 4.2}, radius)};
    const Mesh mesh = generate_shell_mesh(block);
    const Space space(mesh, {4, {}});
    std::vector<FixedUnknown> fixed;
    const auto at_place = [](const Vector3& place) {
      return [place](const Vector3& p) { return (p - place).norm() < 1e-9; };
    };
    examples::hold(space, at_place({0, 0, 0}), {0, 1, 2}, fixed);
    examples::hold(space, at_place({0, breadth, 0}), {0, 2}, fixed);
    examples::hold(space, at_place({length, 0, 0}), {2}, fixed);
    // Tension as the work-equivalent forces of a linear field: the internal forces of uniform
    // stress in the plate without its hole are those on its ends alone.
    Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
    for (std::size_t cell = 0; cell < space.shells().size(); ++cell)
      for (const double end : {0.0, length})
        for (const int edge : {0, 1, 2, 3}) {
          const bool is_xi = edge < 2;  // runs along eta
          const auto point = [&](double s) {
            return is_xi ? Eigen::Vector2d(edge, s) : Eigen::Vector2d(s, edge - 2);
          };
          const Vector3 a = space.place(static_cast<int>(cell), point(0));
          const Vector3 b = space.place(static_cast<int>(cell), point(1));
          if (std::abs(a.x() - end) > 1e-9 || std::abs(b.x() - end) > 1e-9) continue;
          const double gauss[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
          const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
          for (int q = 0; q < 3; ++q) {
            const Eigen::VectorXd values = space.shell_values(point(gauss[q]));
            for (int i = 0; i < space.nodes_per_shell(); ++i)
              load[6 * space.shell_nodes(static_cast<int>(cell))[i]] +=
                  (end > 0 ? 1 : -1) * stress * t * (b - a).norm() * weight[q] * values[i];
          }
        }
    const Eigen::VectorXd motion = examples::solve(space, load, fixed);
    stretch[has_hole ? 1 : 0] = load.dot(motion);
  }
  const double youngs = 206e9;
  EXPECT_NEAR(stretch[0], stress * stress * t * length * breadth / youngs, 1e-6 * stretch[0]);
  // 2 % are for the finite plate: its edges add a share of the order of (diameter / breadth)^2,
  // measured as 2.9 % where it is ten diameters wide.
  const double softening = 3 * pi * radius * radius * stress * stress * t / youngs;
  EXPECT_NEAR(stretch[1] - stretch[0], softening, 0.02 * softening);
}

std::string refusal_of_opening(const BlockDescription& block) {
  try {
    generate_shell_mesh(block);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ShapedOpeningsErrors, SayWhatIsWrong) {
  BlockDescription block = plate_of(4, 2);
  block.openings = {opening({1, 1.6}, {0.7, 1.3}, 0.4)};
  EXPECT_THAT(refusal_of_opening(block),
              HasSubstr("opening \"hole\": corners of 400 mm radius do not fit "
                        "into 600 x 600 mm"));
  block.openings = {opening({1, 1.6}, {0.7, 1.3}, 0.3)};
  block.plates.push_back({"web", Axis::x, {1.2}, {{{}, {0, 2}, {0, 1}}}, 0.01, "AH36"});
  EXPECT_THAT(refusal_of_opening(block),
              HasSubstr("opening \"hole\" of floor at z = 0 m meets another plate"));
  block = plate_of(4, 2);
  block.openings = {opening({3.5, 4.1}, {0.7, 1.3}, 0.3)};
  EXPECT_THAT(refusal_of_opening(block),
              HasSubstr("opening \"hole\" of floor at z = 0 m meets another plate"));
  block.openings = {opening({1, 1.6}, {0.7, 1.3}, 0.3), opening({1.3, 1.9}, {0.7, 1.3}, 0.3)};
  EXPECT_THAT(refusal_of_opening(block),
              HasSubstr("opening \"hole\" of floor at z = 0 m meets another plate"));
  block.openings = {opening({1, 1.6}, {0.7, 1.3}, 0.3)};
  block.pads = {{"pad", "floor", Axis::z, 0, {{{0.5, 3}, {0, 2}, {}}}, 0.03, ""}};
  EXPECT_THAT(refusal_of_opening(block), HasSubstr("lies in a pad, a lug or another opening"));
  block = plate_of(4, 2);
  Opening polygon;
  polygon.name = "hole";
  polygon.plate = "floor";
  polygon.corners = {{1, 1, 0}, {1.5, 1, 0}};
  block.openings = {polygon};
  EXPECT_THAT(refusal_of_opening(block), HasSubstr("a polygon has three corners at least, not 2"));
  block.openings[0].corners = {{1, 0.5, 0}, {2, 0.5, 0}, {2, 1.5, 0}, {1.9, 0.6, 0}};
  EXPECT_THAT(refusal_of_opening(block),
              HasSubstr("a polygon's sides cannot all be seen from its centre"));
  block.openings[0].corner_radius = 0.1;
  EXPECT_THAT(refusal_of_opening(block), HasSubstr("a polygon's corners are not rounded"));
}

}  // namespace
}  // namespace blocklift::structure
