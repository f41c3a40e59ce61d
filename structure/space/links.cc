#include "structure/space/links.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"

namespace blocklift::structure {

namespace {

using Matrix3 = Eigen::Matrix3d;

Matrix3 cross_matrix(const Vector3& v) {
  Matrix3 matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// A freedom's dependence on others, before it is said along which axes.
struct Motion {
  std::vector<int> freedoms;
  std::vector<double> weights;
};

/// Row c of [a b]: a freedom's dependence on a master's displacement and rotation.
void append(Motion& motion, int node, const Eigen::RowVector3d& a, const Eigen::RowVector3d& b) {
  for (int i = 0; i < 3; ++i) {
    if (a[i] != 0) {
      motion.freedoms.push_back(6 * node + i);
      motion.weights.push_back(a[i]);
    }
    if (b[i] != 0) {
      motion.freedoms.push_back(6 * node + 3 + i);
      motion.weights.push_back(b[i]);
    }
  }
}

/// Ties three freedoms of a node by rows . (their motion) = wanted. Each row is solved for one
/// component, those that the rows hold best; the node's others stand beside the masters.
/// @param first freedom of the three; @param wanted motion of each row.
/// @return false if the rows do not differ.
bool tie_by_rows(const Eigen::MatrixX3d& rows, int first, const std::vector<Motion>& wanted,
                 std::vector<FreedomTie>& ties) {
  const auto count = rows.rows();
  if (count == 0) return true;
  if (count > 3) return false;
  const algebra::PivotedColumns pivots = algebra::pivoted_columns(rows);
  if (pivots.rank < count) return false;
  const Eigen::VectorXi& order = pivots.order;
  Eigen::MatrixXd of_held(count, count);
  for (Eigen::Index i = 0; i < count; ++i) of_held.col(i) = rows.col(order[i]);
  const Eigen::MatrixXd inverse = algebra::inverse_of(of_held);
  const Eigen::MatrixXd shares = inverse * rows;  // of the world's components
  for (Eigen::Index i = 0; i < count; ++i) {
    FreedomTie tie{first + static_cast<int>(order[i]), {}, {}};
    for (Eigen::Index r = 0; r < count; ++r)
      for (std::size_t k = 0; k < wanted[r].freedoms.size(); ++k) {
        const double weight = inverse(i, r) * wanted[r].weights[k];
        if (weight == 0) continue;
        tie.masters.push_back(wanted[r].freedoms[k]);
        tie.weights.push_back(weight);
      }
    for (Eigen::Index k = count; k < 3; ++k) {
      if (shares(i, order[k]) == 0) continue;
      tie.masters.push_back(first + static_cast<int>(order[k]));
      tie.weights.push_back(-shares(i, order[k]));
    }
    ties.push_back(std::move(tie));
  }
  return true;
}

/// Ties three freedoms of a node along those of `axes` that are bound.
/// @param first freedom of the three; @param wanted motion of each, along the world's axes.
void tie_along(const Matrix3& axes, const bool* bound, int first,
               const std::array<Motion, 3>& wanted, std::vector<FreedomTie>& ties) {
  const bool all = bound[0] && bound[1] && bound[2];
  if (all || axes.isIdentity(1e-12)) {
    for (int c = 0; c < 3; ++c)
      if (bound[c]) ties.push_back({first + c, wanted[c].freedoms, wanted[c].weights});
    return;
  }
  Eigen::MatrixX3d rows(0, 3);
  std::vector<Motion> along;
  for (int c = 0; c < 3; ++c) {
    if (!bound[c]) continue;
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    rows.bottomRows<1>() = axes.col(c).transpose();
    Motion& sum = along.emplace_back();
    for (int i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < wanted[i].freedoms.size(); ++k) {
        sum.freedoms.push_back(wanted[i].freedoms[k]);
        sum.weights.push_back(axes(i, c) * wanted[i].weights[k]);
      }
  }
  tie_by_rows(rows, first, along, ties);
}

/// Nodes of a rigid link's slaves, and of what lies within edges between its vertices.
std::vector<int> slave_nodes(const RigidLink& link, const std::vector<int>& node_of,
                             const std::vector<NodeWithinEdge>& within) {
  std::vector<int> slaves;
  std::set<int> vertices{link.master}, known{node_of[link.master]};
  for (const int vertex : link.slaves) {
    vertices.insert(vertex);
    if (known.insert(node_of[vertex]).second) slaves.push_back(node_of[vertex]);
  }
  for (const NodeWithinEdge& one : within)
    if (vertices.count(one.from) > 0 && vertices.count(one.to) > 0 && known.insert(one.node).second)
      slaves.push_back(one.node);
  return slaves;
}

void tie_slaves(const RigidLink& link, const std::vector<int>& node_of,
                const Eigen::Matrix3Xd& nodes, const std::vector<NodeWithinEdge>& within,
                std::vector<FreedomTie>& ties) {
  const int master = node_of[link.master];
  for (const int slave : slave_nodes(link, node_of, within)) {
    const Matrix3 arm = -cross_matrix(nodes.col(slave) - nodes.col(master));
    std::array<Motion, 3> displacement, rotation;
    for (int c = 0; c < 3; ++c) {
      append(displacement[c], master, Vector3::Unit(c).transpose(), arm.row(c));
      rotation[c] = {{6 * master + 3 + c}, {1}};
    }
    tie_along(link.axes, link.bound.data(), 6 * slave, displacement, ties);
    tie_along(link.axes, link.bound.data() + 3, 6 * slave + 3, rotation, ties);
  }
}

void tie_reference(const DistributingLink& link, const std::vector<int>& node_of,
                   const Eigen::Matrix3Xd& nodes, std::vector<FreedomTie>& ties) {
  double sum = 0;
  Vector3 centre = Vector3::Zero();
  for (std::size_t i = 0; i < link.vertices.size(); ++i) {
    sum += link.weights[i];
    centre += link.weights[i] * nodes.col(node_of[link.vertices[i]]);
  }
  centre /= sum;
  Matrix3 inertia = Matrix3::Zero();
  for (std::size_t i = 0; i < link.vertices.size(); ++i) {
    const Vector3 r = nodes.col(node_of[link.vertices[i]]) - centre;
    inertia += link.weights[i] * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
  }
  const algebra::SymmetricEigensystem<3> axes = algebra::symmetric_eigensystem(inertia);
  Vector3 inverse = Vector3::Zero();
  for (int i = 0; i < 3; ++i)
    if (axes.values[i] > 1e-10 * axes.values[2]) inverse[i] = 1 / axes.values[i];
  const Matrix3 pseudo_inverse = axes.vectors * inverse.asDiagonal() * axes.vectors.transpose();
  const Matrix3 left_open = Matrix3::Identity() - pseudo_inverse * inertia;

  const int reference = node_of[link.reference];
  const Matrix3 arm = -cross_matrix(nodes.col(reference) - centre);
  std::array<Motion, 3> displacement, rotation;
  for (std::size_t i = 0; i < link.vertices.size(); ++i) {
    const int node = node_of[link.vertices[i]];
    const double weight = link.weights[i];
    const Matrix3 rotation_of_u =
        pseudo_inverse * (weight * cross_matrix(nodes.col(node) - centre));
    Matrix3 rotation_of_theta = (weight / sum) * left_open;
    if (rotation_of_theta.cwiseAbs().maxCoeff() < 1e-9) rotation_of_theta.setZero();
    const Matrix3 u_of_u = (weight / sum) * Matrix3::Identity() + arm * rotation_of_u;
    const Matrix3 u_of_theta = arm * rotation_of_theta;
    for (int c = 0; c < 3; ++c) {
      append(displacement[c], node, u_of_u.row(c), u_of_theta.row(c));
      append(rotation[c], node, rotation_of_u.row(c), rotation_of_theta.row(c));
    }
  }
  tie_along(link.axes, link.bound.data(), 6 * reference, displacement, ties);
  tie_along(link.axes, link.bound.data() + 3, 6 * reference + 3, rotation, ties);
}

/// Equations whose first terms are displacements, or rotations, of one vertex.
struct EquationsOfVertex {
  Eigen::MatrixX3d rows = Eigen::MatrixX3d(0, 3);
  std::vector<Motion> wanted;
  long label = 0;
};

/// Each equation is solved for a displacement of its first vertex, or for a rotation if it names
/// none.
void tie_by_equations(const Mesh& mesh, const std::vector<int>& node_of,
                      std::vector<FreedomTie>& ties) {
  std::map<int, EquationsOfVertex> of_freedom;
  for (const MotionEquation& equation : mesh.equations) {
    const MotionEquation::Term& first = equation.terms.front();
    const bool is_rotation = first.of_displacement.isZero(0);
    const int node = node_of[first.vertex];
    EquationsOfVertex& own = of_freedom[6 * node + (is_rotation ? 3 : 0)];
    own.rows.conservativeResize(own.rows.rows() + 1, Eigen::NoChange);
    own.rows.bottomRows<1>() =
        (is_rotation ? first.of_rotation : first.of_displacement).transpose();
    own.label = equation.label;
    Motion& others = own.wanted.emplace_back();
    if (!is_rotation)
      append(others, node, Eigen::RowVector3d::Zero(), -first.of_rotation.transpose());
    for (std::size_t t = 1; t < equation.terms.size(); ++t)
      append(others, node_of[equation.terms[t].vertex],
             -equation.terms[t].of_displacement.transpose(),
             -equation.terms[t].of_rotation.transpose());
  }
  for (const auto& [freedom, own] : of_freedom)
    if (!tie_by_rows(own.rows, freedom, own.wanted, ties))
      throw ModelError(
          fmt::format("equation {} says of its first vertex what others say already", own.label));
}

}  // namespace

std::string describe_node(const Mesh& mesh, const std::vector<int>& node_of_vertex,
                          const Eigen::Matrix3Xd& nodes, int node) {
  std::string name = "a vertex";
  const auto vertex = std::find(node_of_vertex.begin(), node_of_vertex.end(), node);
  if (vertex != node_of_vertex.end() && !mesh.vertex_labels.empty())
    name = fmt::format("node {}", mesh.vertex_labels[vertex - node_of_vertex.begin()]);
  return fmt::format("{} at ({:.6g}, {:.6g}, {:.6g}) m", name, nodes(0, node), nodes(1, node),
                     nodes(2, node));
}

std::vector<FreedomTie> find_link_ties(const Mesh& mesh, const std::vector<int>& node_of_vertex,
                                       const Eigen::Matrix3Xd& nodes,
                                       const std::vector<NodeWithinEdge>& within) {
  std::vector<FreedomTie> ties;
  std::set<int> tied;
  const auto require_once = [&](std::size_t first, const char* what, long label) {
    for (std::size_t i = first; i < ties.size(); ++i)
      if (!tied.insert(ties[i].freedom).second)
        throw ModelError(
            fmt::format("{} {}: {} follows two links in one freedom", what, label,
                        describe_node(mesh, node_of_vertex, nodes, ties[i].freedom / 6)));
  };
  for (const RigidLink& link : mesh.rigid_links) {
    const std::size_t first = ties.size();
    tie_slaves(link, node_of_vertex, nodes, within, ties);
    require_once(first, "rigid link", link.label);
  }
  for (const DistributingLink& link : mesh.distributing_links) {
    const std::size_t first = ties.size();
    tie_reference(link, node_of_vertex, nodes, ties);
    require_once(first, "distributing link", link.label);
  }
  const std::size_t first = ties.size();
  tie_by_equations(mesh, node_of_vertex, ties);
  require_once(first, "equation", mesh.equations.empty() ? 0 : mesh.equations.front().label);
  return ties;
}

}  // namespace blocklift::structure
