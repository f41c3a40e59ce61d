#include "structure/mesh/files/deck/numbering.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "structure/mesh/files/deck/link_frames.h"

namespace blocklift::structure {

std::vector<long> element_labels(const Mesh& mesh) {
  std::vector<long> labels;
  for (const Shell& shell : mesh.shells) labels.push_back(shell.label);
  for (const Beam& beam : mesh.beams) labels.push_back(beam.label);
  for (const PointMass& mass : mesh.masses) labels.push_back(mass.label);
  for (const RigidLink& link : mesh.rigid_links) labels.push_back(link.label);
  for (const DistributingLink& link : mesh.distributing_links) labels.push_back(link.label);
  for (const Spring& spring : mesh.springs) labels.push_back(spring.label);
  return labels;
}

std::vector<Eigen::Matrix3d> vertex_axes(const Deck& deck) {
  const Mesh& mesh = deck.mesh;
  std::vector<Eigen::Matrix3d> axes(mesh.vertices.size(), Eigen::Matrix3d::Identity());
  std::vector<char> is_set(mesh.vertices.size(), 0);
  const auto set = [&](int vertex, const Eigen::Matrix3d& wanted, const std::array<bool, 6>& used) {
    if (vertex < 0 || is_free_of_axes(used)) return;
    if (is_set[vertex] != 0 && (axes[vertex] - wanted).norm() > 1e-9)
      throw ModelError(fmt::format(
          "vertex {} has supports, links or springs along different axes; a deck has one system at "
          "a node",
          mesh.vertex_labels.empty() ? vertex + 1 : mesh.vertex_labels[vertex]));
    axes[vertex] = wanted;
    is_set[vertex] = 1;
  };
  for (const SupportSet& list : deck.support_sets)
    for (const Support& support : list.supports) {
      std::array<bool, 6> used = support.held;
      // A displacement that is given has a direction, too.
      for (std::size_t i = 0; i < 6; ++i)
        if (support.value[i] != 0) used = {true, false};
      set(support.vertex, support.axes, used);
    }
  for (const RigidLink& link : mesh.rigid_links)
    for (const int slave : link.slaves) set(slave, link.axes, link.bound);
  for (const DistributingLink& link : mesh.distributing_links)
    set(link.reference, link.axes, link.bound);
  for (const Spring& spring : mesh.springs)
    for (std::size_t end = 0; end < 2; ++end)
      if (spring.arms[0].isZero() && spring.arms[1].isZero())
        set(spring.vertices[end], spring.axes[end], {true, false});
  return axes;
}

MiddleVertices::MiddleVertices(Mesh& mesh) : mesh_(mesh) {
  if (mesh.curved_shells.empty()) return;
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vector3& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  step_ = 1e-9 * (high - low).norm();
  // What moves as the mean along a line, or is linked with that, is no node of a shell, wherever it
  // lies.
  std::vector<char> is_mean(mesh.vertices.size(), 0), is_apart(mesh.vertices.size(), 0);
  for (const SurfacePoint& point : mesh.surface_points)
    if (!point.line.empty()) is_mean[point.vertex] = 1;
  for_each_link(mesh, [&](const std::vector<int>& all, long) {
    if (std::any_of(all.begin(), all.end(), [&](int vertex) { return is_mean[vertex] != 0; }))
      for (const int vertex : all) is_apart[vertex] = 1;
  });
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (is_apart[v] == 0 && is_mean[v] == 0)
      cells_.emplace(std::lround(mesh.vertices[v].sum() / step_), static_cast<int>(v));
}

int MiddleVertices::at_place(const Vector3& place) {
  const long cell = std::lround(place.sum() / step_);
  for (long near = cell - 2; near <= cell + 2; ++near) {
    const auto [first, last] = cells_.equal_range(near);
    for (auto entry = first; entry != last; ++entry)
      if ((mesh_.vertices[entry->second] - place).norm() < step_) return entry->second;
  }
  const auto vertex = static_cast<int>(mesh_.vertices.size());
  mesh_.vertices.push_back(place);
  if (!mesh_.vertex_labels.empty())
    mesh_.vertex_labels.push_back(
        *std::max_element(mesh_.vertex_labels.begin(), mesh_.vertex_labels.end()) + 1);
  cells_.emplace(cell, vertex);
  return vertex;
}

std::vector<int> MiddleVertices::of(const Shell& shell) {
  const Eigen::Matrix3Xd& points = mesh_.curved_shells[shell.curvature];
  if (points.cols() != 9)
    throw ModelError("a shell is curved by more than a quadratic; decks have none such");
  // Around the shell: lower side, right, upper, left of the square of three by three points.
  const std::vector<Eigen::Index> places = shell.is_triangle()
                                               ? std::vector<Eigen::Index>{1, 5, 3}
                                               : std::vector<Eigen::Index>{1, 5, 7, 3};
  std::vector<int> middles;
  for (const Eigen::Index i : places) middles.push_back(at_place(points.col(i)));
  return middles;
}

}  // namespace blocklift::structure
