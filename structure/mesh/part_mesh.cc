#include "structure/mesh/part_mesh.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/quarter_points.h"

namespace blocklift::structure {

Eigen::Matrix3Xd PartMesh::places(int element) const {
  Eigen::Matrix3Xd result(3, kind(element).nodes);
  for (int i = 0; i < result.cols(); ++i) result.col(i) = nodes.col(node(element, i));
  return result;
}

Vector3 PartMesh::centre(int element) const {
  return places(element).leftCols(kind(element).corners).rowwise().mean();
}

const PartGroup* PartMesh::find_group(const std::string& name) const {
  for (const PartGroup& group : groups)
    if (group.name == name) return &group;
  return nullptr;
}

std::vector<std::string> PartMesh::group_names() const {
  std::vector<std::string> names;
  for (const PartGroup& group : groups) names.push_back(group.name);
  return names;
}

std::string PartMesh::describe(int element) const {
  const Vector3 place = centre(element);
  return fmt::format("element {} ({}) at ({:.4g}, {:.4g}, {:.4g}) m", elements[element].tag,
                     kind(element).name, place.x(), place.y(), place.z());
}

std::vector<int> connected_bodies(const PartMesh& mesh) {
  std::vector<int> parent(at(static_cast<int>(mesh.nodes.cols())));
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<char> used(parent.size(), 0);
  const auto root = [&](int node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const int element : mesh.solids)
    for (int i = 0; i < mesh.kind(element).nodes; ++i) {
      used[mesh.node(element, i)] = 1;
      parent[root(mesh.node(element, i))] = root(mesh.node(element, 0));
    }
  std::vector<int> number(parent.size(), -1), body(parent.size(), -1);
  int bodies = 0;
  for (std::size_t node = 0; node < parent.size(); ++node) {
    if (!used[node]) continue;
    int& of_root = number[root(static_cast<int>(node))];
    if (of_root < 0) of_root = bodies++;
    body[node] = of_root;
  }
  return body;
}

namespace {

/// Is an element folded at a corner, for the middle of an edge lies beyond the quarter of it?
/// Points of the rule within may be too far from the corner to see it. The limit is what
/// coordinates of four digits are rounded by.
bool is_folded_at(const PartMesh& mesh, const QuarterMiddleOfElement& found) {
  constexpr double rounding = 1e-3;
  if (!found.middle.is_beyond()) return false;
  const ElementKind& kind = mesh.kind(found.element);
  const Eigen::Matrix3Xd places = mesh.places(found.element);
  const auto jacobian = [&](const Eigen::MatrixXd& gradients, Eigen::Index point) {
    return (places * gradients.middleRows<3>(3 * point).transpose()).determinant();
  };
  double largest = 0;
  for (Eigen::Index q = 0; q < kind.rule.cols(); ++q)
    largest = std::max(largest, jacobian(kind.gradients, q));
  return jacobian(kind.gradients_at_nodes, found.corner) < -rounding * largest;
}

/// Those that Gmsh made here are let pass: nobody could mend them.
void refuse_folded_at_middles(const PartMesh& mesh) {
  if (mesh.meshed_here) return;
  constexpr int most_named = 10;
  std::string named;
  int wrong = 0;
  for (const QuarterMiddleOfElement& found : find_quarter_middles(mesh)) {
    if (!is_folded_at(mesh, found) || ++wrong > most_named) continue;
    const Vector3& place = found.middle.place;
    named += fmt::format("\n    {}: the middle at ({:.4g}, {:.4g}, {:.4g}) m, {:.3g} of the edge",
                         mesh.describe(found.element), place.x(), place.y(), place.z(),
                         found.middle.share);
  }
  if (wrong == 0) return;
  throw ModelError(fmt::format(
      "{} of {} solid elements are folded at a corner, for the middle of an edge lies less than a "
      "quarter of the edge from it:{}{}",
      wrong, mesh.solids.size(), named, wrong > most_named ? "\n    ..." : ""));
}

}  // namespace

void check_part_mesh(const PartMesh& mesh) {
  constexpr int most_named = 10;
  std::string named;
  int wrong = 0;
  for (const int element : mesh.solids) {
    const ElementKind& kind = mesh.kind(element);
    const Eigen::Matrix3Xd places = mesh.places(element);
    double smallest = 1e300;
    for (Eigen::Index q = 0; q < kind.rule.cols(); ++q)
      smallest = std::min(smallest,
                          (places * kind.gradients.middleRows<3>(3 * q).transpose()).determinant());
    if (smallest > 0) continue;
    if (++wrong <= most_named) named += "\n    " + mesh.describe(element);
  }
  if (wrong == 0) return refuse_folded_at_middles(mesh);
  throw ModelError(fmt::format(
      "{} of {} solid elements are inverted or folded (their Jacobian is not positive):{}{}", wrong,
      mesh.solids.size(), named, wrong > most_named ? "\n    ..." : ""));
}

}  // namespace blocklift::structure
