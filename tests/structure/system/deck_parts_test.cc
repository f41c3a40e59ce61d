// What decks have beside shells and beams along the world's axes: links and springs along axes of
// their own, vertices between a shell's corners, layered plates, lugs.
#include <cmath>
#include <random>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/formulation/shell.h"
#include "structure/mesh/laminate.h"
#include "structure/mesh/lugs/lug_on_mesh.h"
#include "structure/response/elastic_model.h"
#include "structure/space/links.h"
#include "structure/system/assembly.h"
#include "structure/system/matter.h"

namespace blocklift::structure {
namespace {

const Material steel{"steel", 206e9, 0.3, 7850, 235e6};

Eigen::Matrix3d some_axes() {
  return Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
}

/// Squares of 1 m side by side along x.
Mesh strip(int count) {
  Mesh mesh;
  for (int i = 0; i <= count; ++i)
    for (int j = 0; j < 2; ++j) mesh.vertices.emplace_back(i, j, 0);
  mesh.materials = {steel};
  mesh.shell_sections = {{.thickness = 0.01}};
  mesh.groups = {{"plates"}};
  mesh.regions = {{.name = "plates"}};
  for (int i = 0; i < count; ++i)
    mesh.shells.push_back({.vertices = {2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 3}});
  return mesh;
}

// Along the bound axes the slave moves as the rigid body does, whatever its other components do.
TEST(DeckParts, LinksAlongAxesOfTheirOwn) {
  const std::vector<Vector3> places{{0.2, 0.1, -0.4}, {1, -2, 0.7}};
  Eigen::Matrix3Xd nodes(3, 2);
  nodes << places[0], places[1];
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-1, 1);
  for (const std::array<bool, 6>& bound :
       {std::array<bool, 6>{true, false, false, false, false, true},
        {false, true, true, true, true, false},
        {true, true, true, false, true, false}}) {
    Mesh mesh;
    mesh.vertices = places;
    mesh.rigid_links = {{0, {1}, bound, some_axes(), 1}};
    Eigen::VectorXd motion = Eigen::VectorXd::NullaryExpr(12, [&] { return share(random); });
    const Eigen::VectorXd given = motion;
    int tied = 0;
    for (const FreedomTie& tie : find_link_ties(mesh, {0, 1}, nodes)) {
      double sum = 0;
      for (std::size_t i = 0; i < tie.masters.size(); ++i)
        sum += tie.weights[i] * given[tie.masters[i]];
      motion[tie.freedom] = sum;
      ++tied;
    }
    EXPECT_EQ(tied, std::count(bound.begin(), bound.end(), true));
    const Vector3 turned = motion.segment<3>(3);
    const Vector3 moved = motion.head<3>() + turned.cross(places[1] - places[0]);
    for (int c = 0; c < 3; ++c) {
      const Vector3 axis = some_axes().col(c);
      if (bound[c]) {
        EXPECT_NEAR(axis.dot(motion.segment<3>(6) - moved), 0, 1e-14);
      }
      if (bound[c + 3]) {
        EXPECT_NEAR(axis.dot(motion.segment<3>(9) - turned), 0, 1e-14);
      }
    }
  }
}

// Its energy is half its stiffness times the square of how far the points part along its axis.
TEST(DeckParts, SpringsAlongAxesOfTheirOwnWithArms) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 2, 3}};
  Spring spring;
  spring.vertices = {0, 1};
  spring.components = {1, 1};
  spring.axes = {some_axes(), some_axes()};
  spring.arms = {Vector3(0.3, 0.5, 0.7), Vector3(-0.7, -1.5, -2.3)};
  spring.stiffness = 1000;
  mesh.springs = {spring};
  const Space space(mesh, {1, {}});
  const SparseLower stiffness = assemble_stiffness(space, 1);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-1, 1);
  Eigen::VectorXd unknowns =
      Eigen::VectorXd::NullaryExpr(space.unknowns(), [&] { return share(random); });
  const Eigen::VectorXd motion = space.expand(unknowns);
  const Vector3 first = motion.head<3>() + Vector3(motion.segment<3>(3)).cross(spring.arms[0]);
  const Vector3 second = motion.segment<3>(6) + Vector3(motion.tail<3>()).cross(spring.arms[1]);
  const double stretch = some_axes().col(1).dot(first - second);
  const double energy =
      unknowns.dot(Eigen::MatrixXd(stiffness).selfadjointView<Eigen::Lower>() * unknowns);
  EXPECT_NEAR(energy, 1000 * stretch * stretch, 1e-9 * energy);
}

// A vertex between corners moves as the plate does there: a field of the element's degree exactly.
TEST(DeckParts, VerticesBetweenCornersFollowTheirShell) {
  for (const int degree : {1, 2, 3}) {
    Mesh mesh = strip(2);
    mesh.vertices.emplace_back(0.5, 0, 0);
    mesh.vertices.emplace_back(1.3, 0.8, 0);
    mesh.surface_points = {{6, 0, {0.5, 0}}, {7, 1, {0.3, 0.8}}};
    const Space space(mesh, {degree, [](const Vector3&) { return 0.6; }});
    const auto field = [&](const Vector3& x) {
      return degree == 1 ? 1 + 2 * x.x() - x.y() : 1 + x.x() * x.x() - 3 * x.x() * x.y();
    };
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(space.unknowns());
    for (int node = 0; node < space.node_count(); ++node) {
      const Space::Term* term = space.begin_of(6 * node + 2);
      if (space.end_of(6 * node + 2) - term == 1)
        unknowns[term->unknown] = field(space.nodes().col(node));
    }
    const Eigen::VectorXd motion = space.expand(unknowns);
    for (const int vertex : {6, 7})
      EXPECT_NEAR(motion[6 * space.node_of_vertex(vertex) + 2], field(mesh.vertices[vertex]), 1e-12)
          << "degree " << degree;
  }
}

TEST(DeckParts, LayeredPlatesHaveTheirOwnLaw) {
  Mesh mesh = strip(1);
  const PlyMaterial wood = orthotropic_ply(12e9, 0.6e9, 0.3, 0.7e9, 0.7e9, 0.1e9, 500);
  mesh.laminates = {homogeneous(steel, 0.01), stack({{wood, 0.01, 0}})};
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY();
  const auto plain = shell_stiffness_law(steel, 0.01);
  Shell shell = mesh.shells[0];
  shell.laminate_axis = Vector3(1, 2, 5);
  mesh.shell_sections[0].laminate = 0;
  EXPECT_LT((shell_stiffness_law(mesh, shell, x, y, 0.01) - plain).norm(), 1e-9 * plain.norm());
  // Grain along y: stiff along e_2. At 30 degrees as the transformation of stiffnesses has it.
  mesh.shell_sections[0].laminate = 1;
  shell.laminate_axis = Vector3::UnitY();
  const auto across = shell_stiffness_law(mesh, shell, x, y, 0.01);
  EXPECT_NEAR(across(membrane_22, membrane_22), mesh.laminates[1].membrane(0, 0), 1);
  EXPECT_NEAR(across(curvature_11, curvature_11), mesh.laminates[1].bending(1, 1), 1e-6);
  EXPECT_NEAR(across(shear_2, shear_2), mesh.laminates[1].shear(0, 0), 1e-3);
  const double angle = 0.5235987755982988;
  shell.laminate_axis = Vector3(std::cos(angle), std::sin(angle), 0);
  const auto turned_law = shell_stiffness_law(mesh, shell, x, y, 0.01);
  const Eigen::Matrix3d expected = 0.01 * turned(wood.in_plane, angle);
  EXPECT_LT((turned_law.block<3, 3>(0, 0) - expected).norm(), 1e-9 * expected.norm());
}

TEST(DeckParts, LugsAreCarriedByWhatIsThere) {
  Mesh mesh = strip(3);
  mesh.vertices.emplace_back(3, 0.5, 0.4);  // 8: holds the right edge
  mesh.rigid_links = {{8, {6, 7}}};
  add_lug(mesh, {.name = "node", .vertex = 2});
  add_lug(mesh, {.name = "near", .pin = Vector3(0, 0, 0.2)});
  add_lug(mesh, {.name = "ball", .pin = Vector3(1.5, 0.5, 0), .radius = 0.8});
  add_lug(mesh, {.name = "link", .vertex = 8});
  add_lug(mesh, {.name = "nodes", .pin = Vector3(1, 0.5, 1), .vertices = {2, 3}});
  const auto& points = mesh.lifting_points;
  EXPECT_EQ(points[0].shells, (std::vector<int>{0, 1}));
  EXPECT_EQ(points[1].shells, (std::vector<int>{0}));
  EXPECT_EQ(points[2].shells, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(points[3].vertex, 8);
  EXPECT_NEAR(points[3].radius, std::sqrt(1 + 0.25 + 0.16), 1e-12);
  EXPECT_EQ(points[4].vertex, 9);
  EXPECT_EQ(mesh.distributing_links.at(0).vertices, (std::vector<int>{2, 3}));
  // Whatever carries it, the resultant is the unit force at the pin.
  const ElasticModel model(mesh, {2, {}});
  for (int lug = 0; lug < 5; ++lug)
    for (int axis = 0; axis < 3; ++axis) {
      const Wrench sum = resultant(model.space(), model.lug_loads().col(3 * lug + axis));
      const Vector3 force = Vector3::Unit(axis);
      EXPECT_LT((sum.force - force).norm(), 1e-9);
      EXPECT_LT((sum.moment - points[lug].p_BPin.cross(force)).norm(), 1e-9) << points[lug].name;
    }
  EXPECT_THROW(add_lug(mesh, {.name = "far", .pin = Vector3(0, 0, 5)}), ModelError);
  EXPECT_THROW(add_lug(mesh, {.name = "far", .pin = Vector3(0, 0, 5), .radius = 2}), ModelError);
}

// Without plates nothing is near a pin: the node that carries it must be named.
TEST(DeckParts, PinsNeedPlates) {
  Mesh mesh = strip(1);
  mesh.shells.clear();
  try {
    add_lug(mesh, {.name = "L1", .pin = Vector3(0, 0, 0.2), .radius = 0.5});
    FAIL() << "a lug without plates";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("lug L1: the mesh has no plates"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace blocklift::structure
