#include "structure/mesh/lugs/lug_on_mesh.h"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

std::string text_of(const Vector3& place) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", place.x(), place.y(), place.z());
}

class LugMaker {
 public:
  LugMaker(Mesh& mesh, const LugOnMesh& lug) : mesh_(mesh), lug_(lug) {}

  LiftingPoint make() {
    point_.name = lug_.name;
    if (!lug_.shells.empty()) {
      point_.shells = lug_.shells;
      point_.p_BPin = lug_.pin.value_or(middle_of(vertices_of(lug_.shells)));
    } else if (!lug_.beams.empty() || !lug_.vertices.empty()) {
      hang_on_vertices();
    } else {
      find_by_place();
    }
    for (const int shell : point_.shells) point_.region = mesh_.shells[shell].region;
    point_.radius = reach();
    return point_;
  }

 private:
  std::set<int> vertices_of(const std::vector<int>& shells) const {
    std::set<int> vertices;
    for (const int shell : shells)
      vertices.insert(mesh_.shells[shell].vertices.begin(), mesh_.shells[shell].vertices.end());
    return vertices;
  }

  Vector3 middle_of(const std::set<int>& vertices) const {
    Vector3 sum = Vector3::Zero();
    for (const int vertex : vertices) sum += mesh_.vertices[vertex];
    return sum / static_cast<double>(vertices.size());
  }

  void hang_on_vertices() {
    std::set<int> carriers(lug_.vertices.begin(), lug_.vertices.end());
    for (const int beam : lug_.beams)
      carriers.insert(mesh_.beams[beam].vertices.begin(), mesh_.beams[beam].vertices.end());
    require_used(carriers);
    point_.p_BPin = lug_.pin.value_or(middle_of(carriers));
    held_ = carriers;
    if (carriers.size() == 1) {
      point_.vertex = *carriers.begin();
      return;
    }
    DistributingLink link;
    link.reference = point_.vertex = static_cast<int>(mesh_.vertices.size());
    link.vertices.assign(carriers.begin(), carriers.end());
    link.weights.assign(carriers.size(), 1);
    mesh_.vertices.push_back(point_.p_BPin);
    if (!mesh_.vertex_labels.empty())
      mesh_.vertex_labels.push_back(
          *std::max_element(mesh_.vertex_labels.begin(), mesh_.vertex_labels.end()) + 1);
    mesh_.distributing_links.push_back(std::move(link));
  }

  void require_used(const std::set<int>& vertices) const {
    const std::vector<int> parts = connected_parts(mesh_);
    for (const int vertex : vertices)
      if (parts[vertex] < 0)
        throw ModelError(fmt::format("lug {} stands at {}, where the mesh has nothing", lug_.name,
                                     text_of(mesh_.vertices[vertex])));
  }

  void find_by_place() {
    int vertex = lug_.vertex;
    point_.p_BPin = lug_.pin ? *lug_.pin : mesh_.vertices[vertex];
    if (mesh_.shells.empty() && (vertex < 0 || lug_.radius > 0))
      throw ModelError(
          fmt::format("lug {}: the mesh has no plates that a pin at {} could hang on; name the "
                      "node that carries it, or the set of bars",
                      lug_.name, text_of(point_.p_BPin)));
    if (lug_.radius > 0) {
      take_shells([&](int corner) {
        return (mesh_.vertices[corner] - point_.p_BPin).norm() <= lug_.radius;
      });
      if (point_.shells.empty())
        throw ModelError(
            fmt::format("lug {}: no plate has a corner within {:.4g} m of its pin at {}; the "
                        "nearest is {:.4g} m away",
                        lug_.name, lug_.radius, text_of(point_.p_BPin), nearest().second));
      return;
    }
    if (vertex < 0) {
      const auto [found, distance] = nearest();
      if (distance > lug_.farthest)
        throw ModelError(
            fmt::format("lug {}: the plate nearest to its pin at {} is {:.4g} m away; give a "
                        "radius within which plates carry it, or the nodes that do",
                        lug_.name, text_of(point_.p_BPin), distance));
      vertex = found;
    }
    take_shells([&](int corner) { return corner == vertex; });
    if (!point_.shells.empty()) return;
    require_used({vertex});
    point_.vertex = vertex;
    held_ = {vertex};
  }

  template <typename Carries>
  void take_shells(const Carries& carries) {
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      const auto& corners = mesh_.shells[s].vertices;
      if (std::any_of(corners.begin(), corners.end(), carries))
        point_.shells.push_back(static_cast<int>(s));
    }
  }

  /// The shells' corner nearest to the pin, and how far it is.
  std::pair<int, double> nearest() const {
    std::pair<int, double> found{-1, std::numeric_limits<double>::infinity()};
    for (const Shell& shell : mesh_.shells)
      for (const int corner : shell.vertices) {
        const double distance = (mesh_.vertices[corner] - point_.p_BPin).norm();
        if (distance < found.second) found = {corner, distance};
      }
    return found;
  }

  /// Distance from the pin within which the neighbourhood of the lug lies: what carries it, and of
  /// a vertex the plates that its links reach.
  double reach() const {
    std::set<int> vertices = vertices_of(point_.shells);
    if (point_.shells.empty()) {
      std::set<int> held = held_;
      for_each_link(mesh_, [&](const std::vector<int>& linked, long) {
        if (held_.count(linked.front()) > 0) held.insert(linked.begin(), linked.end());
      });
      vertices = held;
      for (const Shell& shell : mesh_.shells)
        if (std::any_of(shell.vertices.begin(), shell.vertices.end(),
                        [&](int corner) { return held.count(corner) > 0; }))
          vertices.insert(shell.vertices.begin(), shell.vertices.end());
    }
    double farthest_of_all = 0;
    for (const int vertex : vertices)
      farthest_of_all = std::max(farthest_of_all, (mesh_.vertices[vertex] - point_.p_BPin).norm());
    return farthest_of_all;
  }

  Mesh& mesh_;
  const LugOnMesh& lug_;
  LiftingPoint point_;
  std::set<int> held_;  ///< vertices that take the force
};

}  // namespace

void add_lug(Mesh& mesh, const LugOnMesh& lug) {
  mesh.lifting_points.push_back(LugMaker(mesh, lug).make());
}

}  // namespace blocklift::structure
