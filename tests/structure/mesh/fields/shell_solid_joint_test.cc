// Solids that stand on plating: even stress passes from the one to the other.
#include "structure/mesh/fields/shell_solid_joint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/solid_shape.h"
#include "structure/space/space.h"
#include "structure/system/assembly.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

using Motion6 = Eigen::Matrix<double, 6, 1>;
using Field = std::function<Motion6(const Vector3& place)>;

constexpr double width = 0.6, height = 0.9, above = 0.3, thickness = 0.04;
constexpr double poisson = 0.3;

/// Of a plate in the plane y = 0 that goes on as a solid above z = height.
struct JoinedPlate {
  Mesh mesh;
  std::vector<int> base;  ///< vertices of the solids' face on the plate's edge
};

/// Shells whose edges lie at places that no solid has.
void add_shells(Mesh& mesh) {
  constexpr std::array<double, 4> x{0, 0.13, 0.4, width};
  constexpr std::array<double, 3> z{0, 0.5, height};
  for (std::size_t j = 0; j < z.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i)
      // No parallelograms within.
      mesh.vertices.emplace_back(x[i] + (j == 1 && i == 1 ? 0.07 : 0), 0, z[j]);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) {
      const int first = 4 * j + i;
      mesh.shells.push_back({.vertices = {first, first + 1, first + 4, first + 5}});
    }
}

JoinedPlate joined_plate(const Eigen::Matrix3d& turn) {
  JoinedPlate plate;
  Mesh& mesh = plate.mesh;
  mesh.materials = {test::steel()};
  mesh.materials[0].poisson_ratio = poisson;
  mesh.shell_sections = {{thickness, 0}};
  mesh.groups = {{"plate", 0}, {"lug", 0}};
  mesh.regions = {{"plate", 0}, {"lug", 1, true}};
  add_shells(mesh);
  const std::array<double, 3> x{0, 0.25, width};
  const auto first = static_cast<int>(mesh.vertices.size());
  for (const double z : {height, height + above})
    for (const double y : {-thickness / 2, thickness / 2})
      for (const double at : x) mesh.vertices.emplace_back(at, y, z);
  SolidEdgeMiddles middles(mesh);
  for (const int i : {0, 1}) {
    Solid solid;
    solid.region = 1;
    const int corner = first + i;
    solid.vertices = {corner,     corner + 1, corner + 4,  corner + 3,
                      corner + 6, corner + 7, corner + 10, corner + 9};
    complete_solid(mesh, solid, middles);
    mesh.solids.push_back(solid);
  }
  StandingEdge edge;
  edge.through = turn * Vector3::UnitY();
  std::map<double, std::set<int>> columns;
  for (const Solid& solid : mesh.solids)
    for (const int vertex : solid.vertices)
      if (const Vector3& place = mesh.vertices[vertex]; place.z() < height + 1e-9)
        columns[std::round(1e6 * place.x())].insert(vertex);
  for (const auto& [at, vertices] : columns) {
    edge.columns.push_back(
        {turn * Vector3(1e-6 * at, 0, height), std::vector<int>(vertices.begin(), vertices.end())});
    plate.base.insert(plate.base.end(), vertices.begin(), vertices.end());
  }
  for (Vector3& vertex : mesh.vertices) vertex = turn * vertex;
  stand_on_plating(mesh, edge);
  return plate;
}

/// States of even stress; the shells' second, since their middle plane has no thickness.
struct State {
  const char* name;
  Field of_solids, of_shells;
};

Motion6 motion(const Vector3& displacement, const Vector3& rotation) {
  return (Motion6() << displacement, rotation).finished();
}

std::vector<State> even_states() {
  const auto pulled = [](const Vector3& p) {
    return motion({-poisson * p.x(), -poisson * p.y(), p.z()}, Vector3::Zero());
  };
  // Strain along z of y: a beam in pure bending (Saint-Venant).
  const auto bent = [](const Vector3& p) {
    const double x = p.x(), y = p.y(), z = p.z();
    return motion({-poisson * x * y, -(z * z + poisson * (y * y - x * x)) / 2, y * z},
                  Vector3::Zero());
  };
  // The plate's rotation is that of its sections; it lies where the surfaces' mean does.
  const auto bent_shell = [](const Vector3& p) {
    const double x = p.x(), z = p.z(), t = thickness;
    return motion({0, -(z * z + poisson * (t * t / 4 - x * x)) / 2, 0}, {z, 0, poisson * x});
  };
  return {{"pulled", pulled, pulled}, {"bent", bent, bent_shell}};
}

/// A state as unknowns of a space, after a turn of all.
Eigen::VectorXd unknowns_of(const Space& space, const State& state, const Eigen::Matrix3d& turn) {
  std::set<int> of_solids;
  for (std::size_t s = 0; s < space.mesh().solids.size(); ++s)
    for (std::size_t i = 0; i < space.mesh().solids[s].vertices.size(); ++i)
      of_solids.insert(space.solid_nodes(static_cast<int>(s))[i]);
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(space.unknowns());
  for (int node = 0; node < space.node_count(); ++node) {
    const Vector3 place = turn.transpose() * space.nodes().col(node);
    const Motion6 own = of_solids.count(node) > 0 ? state.of_solids(place) : state.of_shells(place);
    const Motion6 moved = motion(turn * own.head<3>(), turn * own.tail<3>());
    for (int c = 0; c < 6; ++c) {
      const int f = 6 * node + c;
      if (space.end_of(f) - space.begin_of(f) == 1 && space.begin_of(f)->weight == 1)
        unknowns[space.begin_of(f)->unknown] = moved[c];
    }
  }
  return unknowns;
}

/// Unknowns at the foot of the plate and on the solids' upper face, where the stress acts.
std::set<int> loaded_unknowns(const Space& space, const Eigen::Matrix3d& turn) {
  std::set<int> loaded;
  for (int node = 0; node < space.node_count(); ++node) {
    const double z = (turn.transpose() * space.nodes().col(node)).z();
    if (z > 1e-9 && z < height + above - 1e-9) continue;
    for (int f = 6 * node; f < 6 * node + 6; ++f)
      for (const Space::Term* term = space.begin_of(f); term != space.end_of(f); ++term)
        loaded.insert(term->unknown);
  }
  return loaded;
}

// Forces of even stress are in balance but where it acts, whatever the sizes of the shells' cells
// beside those of the solids, along any axes.
TEST(ShellSolidJoint, EvenTensionAndBendingPass) {
  for (const Eigen::Matrix3d& turn :
       {Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
        Eigen::AngleAxisd(0.7, Vector3(1, 2, -0.5).normalized()).toRotationMatrix()}) {
    const JoinedPlate plate = joined_plate(turn);
    for (const int degree : {2, 3})
      for (const bool is_divided : {false, true}) {
        Resolution resolution{degree, {}};
        const Vector3 corner = turn * Vector3(0, 0, height);
        if (is_divided)
          resolution.largest_edge = [corner](const Vector3& place) {
            return std::max(0.03, 0.7 * (place - corner).norm());
          };
        const Space space(plate.mesh, resolution);
        const SparseLower lower = assemble_stiffness(space, 1);
        const Eigen::SparseMatrix<double, Eigen::ColMajor, long> stiffness =
            lower.selfadjointView<Eigen::Lower>();
        const std::set<int> loaded = loaded_unknowns(space, turn);
        for (const State& state : even_states()) {
          const Eigen::VectorXd forces = stiffness * unknowns_of(space, state, turn);
          double acting = 0, rest = 0;
          for (Eigen::Index u = 0; u < forces.size(); ++u)
            (loaded.count(static_cast<int>(u)) > 0 ? acting : rest) = std::max(
                loaded.count(static_cast<int>(u)) > 0 ? acting : rest, std::abs(forces[u]));
          // Of the largest force of a node at the foot; rounding of a stiffness that is 1e4 of it.
          EXPECT_LT(rest, 1e-7 * acting) << state.name << ", degree " << degree;
        }
      }
  }
}

// What follows the plate's edge moves as it does, in motions that its elements can follow.
TEST(ShellSolidJoint, QuadraticMotionsOfTheEdgeAreFollowed) {
  const Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  const JoinedPlate plate = joined_plate(turn);
  const Space space(plate.mesh, {3, {}});
  const auto field = [](const Vector3& p) {
    const double x = p.x();
    return motion({x * x - x, 3 * x * x + 1, 2 - x * x}, {x * x, 1 - 2 * x * x, 0});
  };
  const State state{"quadratic", field, field};
  const Eigen::VectorXd moved = space.expand(unknowns_of(space, state, turn));
  for (const int vertex : plate.base) {
    const Eigen::Index row = 6 * static_cast<Eigen::Index>(space.node_of_vertex(vertex));
    const Vector3& place = plate.mesh.vertices[vertex];
    const Motion6 foot = field(place);
    const Vector3 arm(0, place.y(), 0);
    const Vector3 expected = foot.head<3>() + Vector3(foot.tail<3>()).cross(arm);
    EXPECT_LT((moved.segment<3>(row) - expected).norm(), 1e-9) << place.transpose();
  }
}

TEST(ShellSolidJoint, ALineBesideThePlateIsRefused) {
  JoinedPlate plate = joined_plate(Eigen::Matrix3d::Identity());
  StandingEdge edge;
  edge.through = Vector3::UnitY();
  for (const double x : {0.3, 0.5, 0.7}) edge.columns.push_back({{x, 0, height}, plate.base});
  try {
    stand_on_plating(plate.mesh, edge);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_STREQ(error.what(), "no plate lies below its base at (0.7, 0, 0.9) m");
  }
}

}  // namespace
}  // namespace blocklift::structure
