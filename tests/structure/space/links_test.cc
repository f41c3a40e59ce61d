#include "structure/space/links.h"

#include <cmath>
#include <set>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/error.h"
#include "structure/system/matter.h"

namespace blocklift::structure {
namespace {

using Motion6 = Eigen::Matrix<double, 6, 1>;

// Vertices with nodes of the same numbers.
struct Nodes {
  Mesh mesh;
  std::vector<int> node_of_vertex;
  Eigen::Matrix3Xd places;

  explicit Nodes(const std::vector<Vector3>& vertices) {
    mesh.vertices = vertices;
    places.resize(3, vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      node_of_vertex.push_back(static_cast<int>(v));
      places.col(v) = vertices[v];
    }
  }
  // Rows: the freedoms of a node in terms of all others'.
  Eigen::MatrixXd rows_of(int node) const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6, 6 * places.cols());
    for (const FreedomTie& tie : find_link_ties(mesh, node_of_vertex, places))
      if (tie.freedom / 6 == node)
        for (std::size_t i = 0; i < tie.masters.size(); ++i)
          rows(tie.freedom % 6, tie.masters[i]) += tie.weights[i];
    return rows;
  }
};

Eigen::Matrix3d cross(const Vector3& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

DistributingLink spread(const std::vector<double>& weights) {
  DistributingLink link{
      0, {}, weights, {true, true, true, true, true, true}, Eigen::Matrix3d::Identity(), 7};
  for (std::size_t i = 0; i < weights.size(); ++i) link.vertices.push_back(static_cast<int>(i) + 1);
  return link;
}

// Lagrange by hand: the rigid motion (u, theta) of the reference that makes sum w |u + theta x r -
// u_i|^2 least solves A' W A (u; theta) = A' W u_i.
TEST(Links, DistributingLinkIsTheLeastSquaresMotion) {
  Nodes nodes({{0.3, -0.2, 1}, {1, 0, 0.1}, {-0.5, 1, 0}, {-1, -1, 0.4}, {0.2, 0.3, -0.6}});
  const std::vector<double> weights{1, 2, 0.5, 1.5};
  nodes.mesh.distributing_links = {spread(weights)};
  Eigen::MatrixXd a(12, 6), w = Eigen::MatrixXd::Zero(12, 12);
  for (int i = 0; i < 4; ++i) {
    a.middleRows<3>(3 * i) << Eigen::Matrix3d::Identity(),
        -cross(nodes.places.col(i + 1) - nodes.places.col(0));
    w.block<3, 3>(3 * i, 3 * i) = weights[i] * Eigen::Matrix3d::Identity();
  }
  const Eigen::MatrixXd expected = (a.transpose() * w * a).inverse() * a.transpose() * w;
  const Eigen::MatrixXd rows = nodes.rows_of(0);
  for (int i = 0; i < 4; ++i) {
    EXPECT_LT((rows.middleCols<3>(6 * (i + 1)) - expected.middleCols<3>(3 * i)).norm(), 1e-13);
    EXPECT_EQ(rows.middleCols<3>(6 * (i + 1) + 3).norm(), 0);
  }
}

// A force and a moment on the reference keep their resultant, wherever the vertices lie: in space,
// in a plane, on a line (where rotations about it are the mean of the vertices') and at one point.
TEST(Links, SpreadForcesKeepTheirResultant) {
  const std::vector<std::vector<Vector3>> places{
      {{0.3, -0.2, 1}, {1, 0, 0.1}, {-0.5, 1, 0}, {-1, -1, 0.4}, {0.2, 0.3, -0.6}},
      {{0.3, -0.2, 1}, {1, 0, 0}, {-0.5, 1, 0}, {-1, -1, 0}},
      {{0.3, -0.2, 1}, {1, 1, 1}, {2, 2, 2}, {4, 4, 4}},
      {{0.3, -0.2, 1}, {1, 1, 1}}};
  for (const auto& vertices : places) {
    Nodes nodes(vertices);
    nodes.mesh.distributing_links = {spread(std::vector<double>(vertices.size() - 1, 2.0))};
    const Eigen::MatrixXd rows = nodes.rows_of(0);
    Motion6 load;
    load << 1, -2, 3, 0.5, 0.7, -0.2;
    const Eigen::VectorXd spread_load = rows.transpose() * load;
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    for (Eigen::Index n = 0; n < nodes.places.cols(); ++n) {
      force += spread_load.segment<3>(6 * n);
      moment += nodes.places.col(n).cross(Vector3(spread_load.segment<3>(6 * n))) +
                spread_load.segment<3>(6 * n + 3);
    }
    EXPECT_LT((force - load.head<3>()).norm(), 1e-12);
    EXPECT_LT((moment - load.tail<3>() - vertices[0].cross(Vector3(load.head<3>()))).norm(), 1e-12);
  }
}

TEST(Links, RigidSlavesMoveWithTheirMaster) {
  Nodes nodes({{0.3, -0.2, 1}, {1, 0, 0.1}});
  nodes.mesh.rigid_links = {
      {0, {1}, {true, true, true, true, true, true}, Eigen::Matrix3d::Identity(), 3}};
  const Eigen::MatrixXd rows = nodes.rows_of(1);
  Motion6 expected, master;
  master << 1, 2, 3, 0.1, -0.2, 0.3;
  const Vector3 arm = nodes.places.col(1) - nodes.places.col(0);
  expected << master.head<3>() + Vector3(master.tail<3>()).cross(arm), master.tail<3>();
  EXPECT_LT((rows.leftCols<6>() * master - expected).norm(), 1e-14);
  nodes.mesh.rigid_links[0].bound = {false, false, true, false, true, false};
  const auto ties = find_link_ties(nodes.mesh, nodes.node_of_vertex, nodes.places);
  ASSERT_EQ(ties.size(), 2U);
  EXPECT_EQ(std::set({ties[0].freedom, ties[1].freedom}), std::set({8, 10}));
}

TEST(Links, TwoLinksOfOneFreedomAreRefused) {
  Nodes nodes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  nodes.mesh.rigid_links = {
      {0, {1}, {true, true, true, true, true, true}, Eigen::Matrix3d::Identity(), 3},
      {2, {1}, {true, true, true, true, true, true}, Eigen::Matrix3d::Identity(), 4}};
  EXPECT_THROW(find_link_ties(nodes.mesh, nodes.node_of_vertex, nodes.places), ModelError);
}

// Three equations of one vertex along axes of their own hold it where they say; one of a rotation
// takes the displacements of two others.
TEST(Links, EquationsAlongAnyAxes) {
  Nodes nodes({{0.3, -0.2, 1}, {1, 0, 0.1}, {-0.5, 1, 0}});
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  // The first vertex on the line between the others, as far as the axes are seen: not balanced, but
  // that is the reader's business.
  for (int c = 0; c < 3; ++c)
    nodes.mesh.equations.push_back({{{0, 2 * axes.col(c)},
                                     {1, -0.5 * axes.col(c)},
                                     {2, -1.5 * axes.col(c), Vector3(0.1, 0.2, 0.3)}},
                                    c + 1});
  nodes.mesh.equations.push_back(
      {{{0, Vector3::Zero(), {0, 0, 2}}, {1, {0, 1, 0}}, {2, {0, -1, 0}}}, 4});
  const Eigen::MatrixXd rows = nodes.rows_of(0);
  Eigen::VectorXd motion = Eigen::VectorXd::LinSpaced(18, -1, 2).array().square();
  const Motion6 own = rows * motion;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(axes.col(c).dot(2 * own.head<3>() - 0.5 * motion.segment<3>(6) -
                                1.5 * motion.segment<3>(12)) +
                    Vector3(0.1, 0.2, 0.3).dot(motion.segment<3>(15)),
                0, 1e-13);
  EXPECT_NEAR(2 * own[5] + motion[7] - motion[13], 0, 1e-13);
  nodes.mesh.equations.push_back(nodes.mesh.equations[1]);
  EXPECT_THROW(nodes.rows_of(0), ModelError);
}

// Factors with four digits are mended; what holds the whole against the ground is not.
TEST(Links, EquationsAreInBalance) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  MotionEquation mean{{{1, {0, 0, 1}}, {0, {0, 0, -0.6667}}, {2, {0, 0, -0.3333}}}, 1};
  EXPECT_NEAR(balance(mesh, mean), 1e-4 / 3, 1e-10);
  EXPECT_NEAR(mean.terms[1].of_displacement.z(), -2.0 / 3, 1e-14);
  MotionEquation exact = mean;
  EXPECT_LT(balance(mesh, exact), 1e-14);
  // Equal displacements across the line resist its turning: no change of one factor mends that.
  MotionEquation tie{{{1, {0, 0, 1}}, {0, {0, 0, -1}}}, 2};
  EXPECT_TRUE(std::isinf(balance(mesh, tie)));
  MotionEquation arm{{{1, {0, 0, 1}}, {0, {0, 0, -1}, {0, 0.99, 0}}}, 3};
  EXPECT_NEAR(balance(mesh, arm), 0.01, 1e-12);
  EXPECT_NEAR(arm.terms[1].of_rotation.y(), 1, 1e-14);
}

// A cantilever plate, a rigid arm from its end to a free vertex, a distributing link over that end
// and the arm's slave: links follow one another.
TEST(Links, LinksFollowOneAnother) {
  Mesh mesh = examples::sheet_mesh([](double x, double y) { return Vector3(x, 0.2 * y, 0); }, 4, 2,
                                   0.01, examples::plain_steel());
  const int reference = examples::vertex_at(mesh, {1, 0.1, 0});  // a vertex of the end itself
  const int hub = examples::vertex_at(mesh, {1.2, 0.1, 0.1}),
            tip = examples::vertex_at(mesh, {2, 0, 0});
  mesh.distributing_links = {
      {hub,
       {examples::vertex_at(mesh, {1, 0, 0}), reference, examples::vertex_at(mesh, {1, 0.2, 0})},
       {1, 1, 1},
       {true, true, true, true, true, true},
       Eigen::Matrix3d::Identity(),
       1}};
  mesh.rigid_links = {
      {hub, {tip}, {true, true, true, true, true, true}, Eigen::Matrix3d::Identity(), 2}};
  const Space space(mesh, {2, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& x) { return x.x() < 1e-9; }, {0, 1, 2, 3, 4, 5}, fixed);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  load.segment<3>(6 * space.node_of_vertex(tip)) << 10, 20, 30;
  const Eigen::VectorXd motion = examples::solve(space, load, fixed);
  const auto of = [&](int vertex) -> Motion6 {
    return motion.segment<6>(6 * space.node_of_vertex(vertex));
  };
  const Vector3 arm = mesh.vertices[tip] - mesh.vertices[hub];
  EXPECT_LT((of(tip).head<3>() - of(hub).head<3>() - Vector3(of(hub).tail<3>()).cross(arm)).norm(),
            1e-12 * motion.norm());
  EXPECT_GT(of(tip).head<3>().norm(), 0);
  // The load does the work of the forces that the links make of it.
  const Eigen::VectorXd reduced = space.reduce(load);
  const Eigen::VectorXd expanded = space.expand(reduced);
  EXPECT_NEAR(expanded.dot(load), reduced.squaredNorm(), 1e-9 * reduced.squaredNorm());
}

TEST(Links, SpringsInSeries) {
  Mesh mesh = examples::sheet_mesh([](double x, double y) { return Vector3(x, y, 0); }, 1, 1, 0.01,
                                   examples::plain_steel());
  const int a = examples::vertex_at(mesh, {3, 0, 0}), b = examples::vertex_at(mesh, {4, 0, 0});
  const auto add = [&](std::array<int, 2> ends, std::array<int, 2> components, double stiffness) {
    Spring spring;
    spring.vertices = ends;
    spring.components = components;
    spring.stiffness = stiffness;
    mesh.springs.push_back(spring);
  };
  add({a, -1}, {2, 0}, 100);
  add({a, b}, {2, 2}, 300);
  add({b, -1}, {4, 0}, 50);
  const Space space(mesh, {1, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& x) { return x.x() < 2; }, {0, 1, 2, 3, 4, 5}, fixed);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  load[6 * space.node_of_vertex(b) + 2] = 60;
  load[6 * space.node_of_vertex(b) + 4] = 5;
  const Eigen::VectorXd motion = examples::solve(space, load, fixed);
  EXPECT_NEAR(motion[6 * space.node_of_vertex(a) + 2], 0.6, 1e-12);
  EXPECT_NEAR(motion[6 * space.node_of_vertex(b) + 2], 0.8, 1e-12);
  EXPECT_NEAR(motion[6 * space.node_of_vertex(b) + 4], 0.1, 1e-12);
}

}  // namespace
}  // namespace blocklift::structure
