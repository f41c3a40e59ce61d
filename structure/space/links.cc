#include "structure/space/links.h"

#include <set>

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

/// Row c of [a b]: a freedom's dependence on a master's displacement and rotation.
void append(FreedomTie& tie, int node, const Eigen::RowVector3d& a, const Eigen::RowVector3d& b) {
  for (int i = 0; i < 3; ++i) {
    if (a[i] != 0) {
      tie.masters.push_back(6 * node + i);
      tie.weights.push_back(a[i]);
    }
    if (b[i] != 0) {
      tie.masters.push_back(6 * node + 3 + i);
      tie.weights.push_back(b[i]);
    }
  }
}

void tie_slaves(const RigidLink& link, const std::vector<int>& node_of,
                const Eigen::Matrix3Xd& nodes, std::vector<FreedomTie>& ties) {
  const int master = node_of[at(link.master)];
  for (const int vertex : link.slaves) {
    const int slave = node_of[at(vertex)];
    if (slave == master) continue;
    const Matrix3 arm = -cross_matrix(nodes.col(slave) - nodes.col(master));
    for (int c = 0; c < 3; ++c) {
      if (link.bound[at(c)]) {
        ties.push_back({6 * slave + c, {}, {}});
        append(ties.back(), master, Vector3::Unit(c).transpose(), arm.row(c));
      }
      if (link.bound[at(3 + c)]) ties.push_back({6 * slave + 3 + c, {6 * master + 3 + c}, {1}});
    }
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
  std::vector<FreedomTie> own(6);
  for (int c = 0; c < 6; ++c) own[at(c)].freedom = 6 * reference + c;
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
      append(own[at(c)], node, u_of_u.row(c), u_of_theta.row(c));
      append(own[at(3 + c)], node, rotation_of_u.row(c), rotation_of_theta.row(c));
    }
  }
  for (int c = 0; c < 6; ++c)
    if (link.bound[at(c)]) ties.push_back(std::move(own[at(c)]));
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
