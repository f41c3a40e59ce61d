// Mid-surfaces made solid: joints of every kind, what is refused.
#include "structure/mesh/files/thickening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"

namespace blocklift::structure {
namespace {

using Vector3 = Eigen::Vector3d;
using ::testing::HasSubstr;

/// Plates on a grid of unit cells: rectangles between grid points, nodes shared where they meet.
class Builder {
 public:
  /// Cells from `start` along `u` and `v` (unit steps of the grid).
  void add(const std::string& name, double thickness, const Vector3& start, const Vector3& u,
           int along_u, const Vector3& v, int along_v) {
    const int plate = static_cast<int>(mesh.plates.size());
    mesh.plates.push_back({name, thickness});
    for (int j = 0; j < along_v; ++j)
      for (int i = 0; i < along_u; ++i) {
        const Vector3 corner = start + i * u + j * v;
        mesh.quadrangles.push_back(
            {{node(corner), node(corner + u), node(corner + u + v), node(corner + v)}, plate});
      }
  }
  int node(const Vector3& place) {
    const std::array<long, 3> key = {std::lround(1e3 * place.x()), std::lround(1e3 * place.y()),
                                     std::lround(1e3 * place.z())};
    const auto [entry, is_new] = nodes_.try_emplace(key, static_cast<int>(mesh.nodes.size()));
    if (is_new) mesh.nodes.push_back(place);
    return entry->second;
  }

  PlateMesh mesh;

 private:
  std::map<std::array<long, 3>, int> nodes_;
};

const Vector3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

/// Volume of the solids (each cut into tetrahedra about its centre), and the closedness of their
/// outside: every face of one solid alone, seen with its outward normal, sums to zero area.
struct Measured {
  double volume = 0;
  Vector3 outside = Vector3::Zero();
  int most_at_a_face = 0;
};

Measured measure(const AbaqusMesh& mesh) {
  Measured measured;
  std::map<std::vector<std::size_t>, int> uses;
  std::map<std::vector<std::size_t>, Vector3> areas;
  const auto place = [&](std::size_t tag) {
    const auto& p = mesh.nodes.at(tag);
    return Vector3(p[0], p[1], p[2]);
  };
  for (const AbaqusElement& element : mesh.elements) {
    Vector3 centre = Vector3::Zero();
    for (const std::size_t tag : element.nodes)
      centre += place(tag) / static_cast<double>(element.nodes.size());
    const auto count = static_cast<int>(abaqus_faces(element.nodes.size()).size());
    for (int face = 1; face <= count; ++face) {
      std::vector<std::size_t> nodes = face_nodes(element, face);
      Vector3 middle = Vector3::Zero(), area = Vector3::Zero();
      for (const std::size_t tag : nodes) middle += place(tag) / static_cast<double>(nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        area += (place(nodes[i]) - middle).cross(place(nodes[(i + 1) % nodes.size()]) - middle) / 2;
      if (area.dot(middle - centre) < 0) area = -area;
      measured.volume += area.dot(middle - centre) / 3;
      std::sort(nodes.begin(), nodes.end());
      measured.most_at_a_face = std::max(measured.most_at_a_face, ++uses[nodes]);
      areas[nodes] = area;
    }
  }
  for (const auto& [nodes, count] : uses)
    if (count == 1) measured.outside += areas[nodes];
  return measured;
}

void expect_volume(const PlateMesh& mesh, double volume) {
  const Measured measured = measure(thicken(mesh));
  EXPECT_NEAR(measured.volume, volume, 1e-9);
  EXPECT_LT(measured.outside.norm(), 1e-9);
  EXPECT_LE(measured.most_at_a_face, 2);
}

std::string error_of(const PlateMesh& mesh) {
  try {
    thicken(mesh);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(Thickening, PlateHasItsSides) {
  Builder builder;
  builder.add("deck", 0.1, Vector3::Zero(), x, 3, y, 2);
  builder.mesh.node_sets["edge"] = {builder.node(Vector3(0, 0, 0)), builder.node(Vector3(0, 1, 0)),
                                    builder.node(Vector3(0, 2, 0))};
  const AbaqusMesh solid = thicken(builder.mesh);
  EXPECT_EQ(solid.elements.size(), 6u);
  EXPECT_EQ(solid.element_sets.at("deck").size(), 6u);
  EXPECT_EQ(solid.node_sets.at("edge").size(), 6u);
  for (const AbaqusFace& face : solid.surfaces.at("deck +"))
    for (const std::size_t tag : face_nodes(solid.elements[face.element - 1], face.face))
      EXPECT_NEAR(solid.nodes.at(tag)[2], 0.05, 1e-12);
  expect_volume(builder.mesh, 0.6);
}

TEST(Thickening, FoldIsMitred) {
  Builder builder;
  builder.add("deck", 0.1, Vector3::Zero(), x, 2, y, 2);
  builder.add("side", 0.2, Vector3::Zero(), y, 2, -z, 2);
  // Each reaches to the outside of the other: (2 + 0.1) 0.1 + (2 - 0.05) 0.2, 2 m long.
  expect_volume(builder.mesh, 2 * (2.1 * 0.1 + 1.95 * 0.2));
  EXPECT_EQ(thicken(builder.mesh).elements.size(), 8u);
}

TEST(Thickening, TeeJointIsFilled) {
  Builder builder;
  builder.add("deck", 0.1, Vector3::Zero(), x, 2, y, 2);
  builder.add("web", 0.06, Vector3(1, 0, 0), y, 2, -z, 2);
  expect_volume(builder.mesh, 2 * (2 * 0.1 + 1.95 * 0.06));
  EXPECT_EQ(thicken(builder.mesh).elements.size(), 10u);
}

TEST(Thickening, CrossJointIsFilled) {
  Builder builder;
  builder.add("deck", 0.1, Vector3::Zero(), x, 2, y, 2);
  builder.add("below", 0.06, Vector3(1, 0, 0), y, 2, -z, 2);
  builder.add("above", 0.06, Vector3(1, 0, 0), y, 2, z, 1);
  expect_volume(builder.mesh, 2 * (2 * 0.1 + (1.95 + 0.95) * 0.06));
}

TEST(Thickening, ThreePlatesAtEqualAnglesMakeAWedge) {
  Builder builder;
  const double t = 0.1;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * M_PI * i / 3;
    builder.add("fin " + std::to_string(i), t, Vector3::Zero(),
                Vector3(std::cos(angle), std::sin(angle), 0), 1, z, 1);
  }
  // Each fin reaches to the side of the triangle between them, t / (2 sqrt 3) from the middle.
  const double triangle = std::sqrt(3) / 4 * t * t;
  expect_volume(builder.mesh, 3 * (1 - t / (2 * std::sqrt(3))) * t + triangle);
}

// A deck on two webs that cross below it: cubes at the crossings, strips through the deck.
TEST(Thickening, GrillageIsFilled) {
  Builder builder;
  builder.add("deck", 0.1, Vector3::Zero(), x, 4, y, 4);
  builder.add("frame", 0.06, Vector3(2, 0, 0), y, 4, -z, 2);
  builder.add("girder", 0.08, Vector3(0, 2, 0), x, 4, -z, 2);
  const double depth = 1.95;
  expect_volume(builder.mesh, 16 * 0.1 + depth * (4 * 0.06 + 4 * 0.08 - 0.06 * 0.08));
}

// A girder that ends at a frame, and a bracket that ends within a deck: the cuts run on.
TEST(Thickening, JointsThatEndRunOnThroughThePlate) {
  Builder builder;
  builder.add("deck", 0.1, Vector3::Zero(), x, 4, y, 4);
  builder.add("frame", 0.06, Vector3(2, 0, 0), y, 4, -z, 2);
  builder.add("girder", 0.08, Vector3(2, 2, 0), x, 2, -z, 2);
  expect_volume(builder.mesh, 16 * 0.1 + 1.95 * (4 * 0.06 + 1.97 * 0.08));
  builder.add("bracket", 0.05, Vector3(1, 1, 0), y, 2, z, 1);
  expect_volume(builder.mesh, 16 * 0.1 + 1.95 * (4 * 0.06 + 1.97 * 0.08) + 0.95 * 2 * 0.05);
}

// A cut that runs on below a second frame and down the side of the deck goes into both.
TEST(Thickening, CutsGoIntoPlatesAcrossTheirWay) {
  Builder builder;
  builder.add("deck", 0.1, Vector3::Zero(), x, 4, y, 4);
  builder.add("side", 0.1, Vector3::Zero(), y, 4, -z, 2);
  builder.add("frame", 0.06, Vector3(3, 0, 0), y, 4, -z, 2);
  builder.add("second", 0.06, Vector3(1, 0, 0), y, 4, -z, 2);
  builder.add("girder", 0.08, Vector3(3, 2, 0), x, 1, -z, 2);
  builder.add("bracket", 0.05, Vector3(2, 1, 0), y, 2, z, 1);
  const double deck = (4 * 4 + 4 * 0.05) * 0.1, below = 1.95;
  expect_volume(builder.mesh,
                deck + below * (4 * 0.1 + 2 * 4 * 0.06 + 0.97 * 0.08) + 0.95 * 2 * 0.05);
}

// A closed box with a bulkhead: mitres, tees and their corners.
TEST(Thickening, BoxWithABulkhead) {
  Builder builder;
  const double t = 0.1;
  builder.add("bottom", t, Vector3::Zero(), x, 4, y, 2);
  builder.add("top", t, Vector3(0, 0, 2), x, 4, y, 2);
  builder.add("near", t, Vector3::Zero(), x, 4, z, 2);
  builder.add("far", t, Vector3(0, 2, 0), x, 4, z, 2);
  builder.add("left", t, Vector3::Zero(), y, 2, z, 2);
  builder.add("right", t, Vector3(4, 0, 0), y, 2, z, 2);
  builder.add("bulkhead", t, Vector3(2, 0, 0), y, 2, z, 2);
  expect_volume(builder.mesh, 4.1 * 2.1 * 2.1 - 2 * 1.9 * 1.9 * 1.9);
}

TEST(Thickening, WhatCannotBeFilledIsNamedWithItsPlace) {
  Builder five;
  for (int i = 0; i < 5; ++i)
    five.add("fin " + std::to_string(i), 0.02, Vector3(7, 0, 0),
             Vector3(std::cos(2 * M_PI * i / 5), std::sin(2 * M_PI * i / 5), 0), 1, z, 1);
  EXPECT_THAT(error_of(five.mesh),
              ::testing::AllOf(HasSubstr("at (7, 0, 0.5)"), HasSubstr("5 plates meet")));
  Builder sharp;
  sharp.add("a", 0.1, Vector3::Zero(), x, 1, y, 1);
  sharp.add("b", 0.1, Vector3::Zero(), Vector3(0.995, 0, 0.1), 1, y, 1);
  EXPECT_THAT(error_of(sharp.mesh), HasSubstr("too sharp an angle"));
}

}  // namespace
}  // namespace blocklift::structure
