#include "structure/space/links.h"

#include <array>
#include <set>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"

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

/// Ties three freedoms of a node along those of `axes` that are bound. One bound along no axis of
/// the world's is solved for the component that it holds best; the node's others stand beside the
/// masters.
/// @param first freedom of the three; @param wanted motion of each, along the world's axes.
void tie_along(const Matrix3& axes, const bool* bound, int first,
               const std::array<Motion, 3>& wanted, std::vector<FreedomTie>& ties) {
  const bool all = bound[0] && bound[1] && bound[2];
  if (all || axes.isIdentity(1e-12)) {
    for (int c = 0; c < 3; ++c)
      if (bound[c]) ties.push_back({first + c, wanted[at(c)].freedoms, wanted[at(c)].weights});
    return;
  }
  Eigen::MatrixXd rows(0, 3);
  for (int c = 0; c < 3; ++c) {
    if (!bound[c]) continue;
    rows.conservativeResize(rows.rows() + 1, 3);
    rows.bottomRows<1>() = axes.col(c).transpose();
  }
  if (rows.rows() == 0) return;
  // Two directions leave one component free: the one with the largest share of what is not bound.
  std::vector<int> held{0, 1, 2}, open;
  if (rows.rows() == 1) {
    int best = 0;
    rows.row(0).cwiseAbs().maxCoeff(&best);
    held = {best};
    open = {(best + 1) % 3, (best + 2) % 3};
  } else {
    int least = 0;
    Vector3(rows.row(0)).cross(Vector3(rows.row(1))).cwiseAbs().maxCoeff(&least);
    held = {(least + 1) % 3, (least + 2) % 3};
    open = {least};
  }
  const auto count = rows.rows();
  Eigen::MatrixXd of_held(count, count);
  for (Eigen::Index i = 0; i < count; ++i) of_held.col(i) = rows.col(held[at(i)]);
  const Eigen::MatrixXd solved = of_held.inverse() * rows;  // shares of the world's components
  for (Eigen::Index i = 0; i < count; ++i) {
    FreedomTie tie{first + held[at(i)], {}, {}};
    for (int c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < wanted[at(c)].freedoms.size(); ++k) {
        const double weight = solved(i, c) * wanted[at(c)].weights[k];
        if (weight == 0) continue;
        tie.masters.push_back(wanted[at(c)].freedoms[k]);
        tie.weights.push_back(weight);
      }
    for (const int c : open) {
      if (solved(i, c) == 0) continue;
      tie.masters.push_back(first + c);
      tie.weights.push_back(-solved(i, c));
    }
    ties.push_back(std::move(tie));
  }
}

void tie_slaves(const RigidLink& link, const std::vector<int>& node_of,
                const Eigen::Matrix3Xd& nodes, std::vector<FreedomTie>& ties) {
  const int master = node_of[at(link.master)];
  for (const int vertex : link.slaves) {
    const int slave = node_of[at(vertex)];
    if (slave == master) continue;
    const Matrix3 arm = -cross_matrix(nodes.col(slave) - nodes.col(master));
    std::array<Motion, 3> displacement, rotation;
    for (int c = 0; c < 3; ++c) {
      append(displacement[at(c)], master, Vector3::Unit(c).transpose(), arm.row(c));
      rotation[at(c)] = {{6 * master + 3 + c}, {1}};
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
    centre += link.weights[i] * nodes.col(node_of[at(link.vertices[i])]);
  }
  centre /= sum;
  Matrix3 inertia = Matrix3::Zero();
  for (std::size_t i = 0; i < link.vertices.size(); ++i) {
    const Vector3 r = nodes.col(node_of[at(link.vertices[i])]) - centre;
    inertia += link.weights[i] * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(inertia);
  Vector3 inverse = Vector3::Zero();
  for (int i = 0; i < 3; ++i)
    if (axes.eigenvalues()[i] > 1e-10 * axes.eigenvalues()[2])
      inverse[i] = 1 / axes.eigenvalues()[i];
  const Matrix3 pseudo_inverse =
      axes.eigenvectors() * inverse.asDiagonal() * axes.eigenvectors().transpose();
  const Matrix3 left_open = Matrix3::Identity() - pseudo_inverse * inertia;

  const int reference = node_of[at(link.reference)];
  const Matrix3 arm = -cross_matrix(nodes.col(reference) - centre);
  std::array<Motion, 3> displacement, rotation;
  for (std::size_t i = 0; i < link.vertices.size(); ++i) {
    const int node = node_of[at(link.vertices[i])];
    const double weight = link.weights[i];
    const Matrix3 rotation_of_u =
        pseudo_inverse * (weight * cross_matrix(nodes.col(node) - centre));
    Matrix3 rotation_of_theta = (weight / sum) * left_open;
    if (rotation_of_theta.cwiseAbs().maxCoeff() < 1e-9) rotation_of_theta.setZero();
    const Matrix3 u_of_u = (weight / sum) * Matrix3::Identity() + arm * rotation_of_u;
    const Matrix3 u_of_theta = arm * rotation_of_theta;
    for (int c = 0; c < 3; ++c) {
      append(displacement[at(c)], node, u_of_u.row(c), u_of_theta.row(c));
      append(rotation[at(c)], node, rotation_of_u.row(c), rotation_of_theta.row(c));
    }
  }
  tie_along(link.axes, link.bound.data(), 6 * reference, displacement, ties);
  tie_along(link.axes, link.bound.data() + 3, 6 * reference + 3, rotation, ties);
}

}  // namespace

std::vector<FreedomTie> find_link_ties(const Mesh& mesh, const std::vector<int>& node_of_vertex,
                                       const Eigen::Matrix3Xd& nodes) {
  std::vector<FreedomTie> ties;
  std::set<int> tied;
  const auto require_once = [&](std::size_t first, const char* what, long label) {
    for (std::size_t i = first; i < ties.size(); ++i)
      if (!tied.insert(ties[i].freedom).second)
        throw ModelError(fmt::format(
            "{} {}: a vertex at ({:.6g}, {:.6g}, {:.6g}) m follows two links in one freedom", what,
            label, nodes(0, ties[i].freedom / 6), nodes(1, ties[i].freedom / 6),
            nodes(2, ties[i].freedom / 6)));
  };
  for (const RigidLink& link : mesh.rigid_links) {
    const std::size_t first = ties.size();
    tie_slaves(link, node_of_vertex, nodes, ties);
    require_once(first, "rigid link", link.label);
  }
  for (const DistributingLink& link : mesh.distributing_links) {
    const std::size_t first = ties.size();
    tie_reference(link, node_of_vertex, nodes, ties);
    require_once(first, "distributing link", link.label);
  }
  return ties;
}

}  // namespace blocklift::structure
