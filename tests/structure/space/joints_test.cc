#include "structure/space/joints.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/index.h"

namespace blocklift::structure {
namespace {

// Traces of some pieces of an edge, with nodes of their own; places are kept by node.
struct Edge {
  std::vector<EdgeTrace> traces;
  std::vector<double> places;

  void add(double begin, double end, int degree, bool reversed = false, int from = 0, int to = 1) {
    EdgeTrace trace{from, to, begin, end, {}};
    for (const double x : lagrange_places(degree)) {
      trace.nodes.push_back(static_cast<int>(places.size()));
      places.push_back(begin + x * (end - begin));
    }
    if (reversed) std::reverse(trace.nodes.begin(), trace.nodes.end());
    if (reversed)
      for (std::size_t i = 0; i < trace.nodes.size(); ++i)
        places[trace.nodes[i]] = begin + lagrange_places(degree)[i] * (end - begin);
    traces.push_back(trace);
  }
  std::vector<NodeTie> ties() {
    std::vector<int> vertex_node{-1, -1};
    return find_joint_ties(static_cast<int>(places.size()), traces, vertex_node);
  }
};

double power(double x, int degree) { return std::pow(x - 0.3, degree); }

// Masters are free; what is tied takes the value of any polynomial of the lowest degree from its
// masters.
void expect_conforming(Edge& edge, int degree) {
  const std::vector<NodeTie> ties = edge.ties();
  std::set<int> tied;
  for (const NodeTie& tie : ties) EXPECT_TRUE(tied.insert(tie.node).second) << "tied twice";
  for (const NodeTie& tie : ties) {
    double value = 0;
    for (std::size_t i = 0; i < tie.masters.size(); ++i) {
      EXPECT_EQ(tied.count(tie.masters[i]), 0U) << "a master is tied";
      value += tie.weights[i] * power(edge.places[tie.masters[i]], degree);
    }
    EXPECT_NEAR(value, power(edge.places[tie.node], degree), 1e-13);
  }
}

TEST(Joints, NodesOfOnePlaceAreOne) {
  Edge edge;
  for (int plate = 0; plate < 3; ++plate) edge.add(0, 1, 3, plate == 1);
  expect_conforming(edge, 3);
  EXPECT_EQ(edge.ties().size(), 8U);
}

TEST(Joints, FinerSidesFollowTheCoarsestWhereverItLies) {
  for (int degree = 1; degree <= 4; ++degree) {
    // Fine on the left of one plate, on the right of another; a third is finer everywhere.
    Edge edge;
    for (const auto& [a, b] : {std::pair{0.0, 0.25}, {0.25, 0.5}, {0.5, 1.0}})
      edge.add(a, b, degree);
    for (const auto& [a, b] : {std::pair{0.0, 0.5}, {0.5, 0.75}, {0.75, 1.0}})
      edge.add(a, b, degree);
    for (int i = 0; i < 8; ++i) edge.add(i / 8.0, (i + 1) / 8.0, degree);
    expect_conforming(edge, degree);
    // Two coarse pieces remain: 2 p + 1 free nodes.
    std::set<int> tied;
    for (const NodeTie& tie : edge.ties()) tied.insert(tie.node);
    EXPECT_EQ(edge.places.size() - tied.size(), at(2 * degree + 1));
  }
}

TEST(Joints, BeamOfAnotherDegreeFollowsThePlate) {
  Edge edge;
  edge.add(0, 1, 3);
  edge.add(0, 0.5, 2);
  edge.add(0.5, 1, 2);
  expect_conforming(edge, 2);
}

TEST(Joints, VerticesJoinEdges) {
  Edge edge;
  edge.add(0, 1, 2);
  edge.add(0, 1, 2, false, 1, 2);  // from the first edge's end
  std::vector<int> vertex_node{-1, -1, -1};
  const auto ties = find_joint_ties(6, edge.traces, vertex_node);
  ASSERT_EQ(ties.size(), 1U);
  EXPECT_EQ(ties[0].node, 3);
  EXPECT_EQ(ties[0].masters, std::vector<int>{2});
  EXPECT_EQ(vertex_node[1], 2);
}

TEST(Joints, AnEdgeThatIsAPointHasOneNode) {
  Edge edge;
  edge.add(0, 1, 3, false, 0, 0);
  EXPECT_EQ(edge.ties().size(), 3U);
}

// Saint-Venant's bending of a T-section: u = k (-x z, nu y z, (x^2 + nu (z^2 - y^2)) / 2) with
// theta = curl u / 2 is exact for flange, web and bulkhead-free joint alike, with no force or
// moment passed between them; it lies in the space of degree 2 and above. The flange, the web and a
// second web are divided differently along their joint.
TEST(Joints, BendingOfASectionIsExactAcrossPlatesOfDifferentSizes) {
  constexpr double length = 2, nu = 0.3;
  const auto motion = [](const Vector3& p) -> Eigen::Matrix<double, 6, 1> {
    const double x = p.x(), y = p.y(), z = p.z();
    return (Eigen::Matrix<double, 6, 1>() << -x * z, nu * y * z, (x * x + nu * (z * z - y * y)) / 2,
            -nu * y, -x, 0)
        .finished();
  };
  for (int degree = 2; degree <= 4; ++degree) {
    Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.02);
    const auto sheet = [&](const Vector3& a, const Vector3& b) {
      examples::add_sheet(
          mesh,
          [&](double s, double t) -> Vector3 {
            return {length * s, a.y() + t * b.y(), a.z() + t * b.z()};
          },
          2, 1);
    };
    sheet({0, -0.5, 0.2}, {0, 0.5, 0});
    sheet({0, 0, 0.2}, {0, 0.5, 0});
    sheet({0, 0, -0.3}, {0, 0, 0.5});
    sheet({0, 0, 0.2}, {0, 0, 0.4});
    const Space space(mesh, {degree, [](const Vector3& x) {
                               const bool left = x.x() < length / 2;
                               if (x.z() > 0.21) return 0.3;               // fine above
                               if (x.z() < 0.19) return left ? 0.3 : 1.0;  // fine on the left below
                               return x.y() > 0 && !left ? 0.5 : 1.0;
                             }});
    std::vector<FixedUnknown> fixed;
    examples::hold_at(
        space, [](const Vector3& x) { return x.x() < 1e-9 || x.x() > length - 1e-9; }, motion,
        {0, 1, 2, 3, 4, 5}, fixed);
    const Eigen::VectorXd found =
        examples::solve(space, Eigen::VectorXd::Zero(space.freedoms()), fixed);
    double worst = 0;
    for (int n = 0; n < space.node_count(); ++n)
      worst = std::max(
          worst, (found.segment<6>(6 * n) - motion(space.nodes().col(n))).cwiseAbs().maxCoeff());
    // Condition of plates of 0.02 by 0.3 m: some 1e6.
    EXPECT_LT(worst, 1e-8) << "degree " << degree;
  }
}

}  // namespace
}  // namespace blocklift::structure
