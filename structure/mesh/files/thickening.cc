#include "structure/mesh/files/thickening.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"

namespace blocklift::structure {

namespace {

using Vector3 = Eigen::Vector3d;
using Edge = std::pair<int, int>;  // smaller node first

Edge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

constexpr double flat = 15 * M_PI / 180;  ///< a gap within this of 180 degrees is one of a plate

/// A quadrangle at an edge, seen along it from the smaller node to the larger.
struct Leaf {
  int quadrangle = 0;
  double angle = 0;
  Vector3 inward;  ///< unit, from the edge into the quadrangle
  int ahead = 1;   ///< the side (+1, -1) that faces increasing angles
};

/// The quadrangles at an edge by increasing angle, and which of the gaps behind each are cut open.
struct Joint {
  std::vector<Leaf> leaves;
  std::vector<char> open;          ///< of the gap between leaf i and the next
  std::map<int, double> distance;  ///< of the cut from the edge, by quadrangle

  bool is_cut() const { return std::find(open.begin(), open.end(), 1) != open.end(); }
  std::size_t next(std::size_t leaf) const { return (leaf + 1) % leaves.size(); }
};

class Thickening {
 public:
  explicit Thickening(const PlateMesh& mesh) : mesh_(mesh) {}

  AbaqusMesh make() {
    find_normals();
    find_joints();
    run_cuts_on();
    unite_sides();
    place_nodes();
    add_plates();
    add_columns();
    add_crossings();
    check_shapes();
    refuse_problems();
    add_sets();
    return std::move(solid_);
  }

 private:
  void problem(const Vector3& place, const std::string& what) {
    problems_.insert(
        fmt::format("at ({:.6g}, {:.6g}, {:.6g}): {}", place.x(), place.y(), place.z(), what));
  }

  void refuse_problems() const {
    if (problems_.empty()) return;
    constexpr int most_named = 10;
    std::string text =
        fmt::format("the plates cannot be thickened at {} places:", problems_.size());
    int named = 0;
    for (const std::string& problem : problems_)
      if (++named <= most_named) text += "\n    " + problem;
    if (named > most_named) text += "\n    ...";
    throw ModelError(text);
  }

  const PlateMesh::Quadrangle& quadrangle(int q) const { return mesh_.quadrangles[q]; }
  const Vector3& node(int n) const { return mesh_.nodes[n]; }
  double half_thickness(int q) const { return mesh_.plates[quadrangle(q).plate].thickness / 2; }
  Vector3 middle(const Edge& edge) const { return (node(edge.first) + node(edge.second)) / 2; }

  void find_normals() {
    for (const PlateMesh::Quadrangle& one : mesh_.quadrangles)
      normals_.push_back((node(one.nodes[2]) - node(one.nodes[0]))
                             .cross(node(one.nodes[3]) - node(one.nodes[1]))
                             .normalized());
  }

  void find_joints() {
    for (int q = 0; q < static_cast<int>(mesh_.quadrangles.size()); ++q)
      for (std::size_t i = 0; i < 4; ++i)
        joints_[edge_of(quadrangle(q).nodes[i], quadrangle(q).nodes[(i + 1) % 4])].leaves.push_back(
            {q, 0, Vector3::Zero(), 1});
    for (auto& [edge, joint] : joints_) {
      const Vector3 along = (node(edge.second) - node(edge.first)).normalized();
      for (Leaf& leaf : joint.leaves) {
        Vector3 centre = Vector3::Zero();
        for (const int n : quadrangle(leaf.quadrangle).nodes) centre += node(n) / 4;
        Vector3 inward = centre - middle(edge);
        inward -= along.dot(inward) * along;
        leaf.inward = inward.normalized();
        const Vector3& first = joint.leaves.front().inward;
        leaf.angle = std::atan2(along.dot(first.cross(leaf.inward)), first.dot(leaf.inward));
        leaf.ahead = normals_[leaf.quadrangle].dot(along.cross(leaf.inward)) > 0 ? 1 : -1;
      }
      std::sort(joint.leaves.begin(), joint.leaves.end(),
                [](const Leaf& a, const Leaf& b) { return a.angle < b.angle; });
      joint.open.assign(joint.leaves.size(), 0);
      if (joint.leaves.size() >= 3) open_flat_gaps(joint);
    }
  }

  static double gap(const Joint& joint, std::size_t leaf) {
    const double wide = joint.leaves[joint.next(leaf)].angle - joint.leaves[leaf].angle;
    return wide <= 0 ? wide + 2 * M_PI : wide;
  }

  // A plate that runs on past others: its far side is cut where their corners are on the near side.
  void open_flat_gaps(Joint& joint) const {
    const std::size_t count = joint.leaves.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (std::abs(gap(joint, i) - M_PI) > flat) continue;
      joint.open[i] = 1;
      const std::size_t next = joint.next(i), before = (i + count - 1) % count;
      joint.distance[joint.leaves[i].quadrangle] =
          corner_distance(joint.leaves[i], joint.leaves[before], gap(joint, before));
      joint.distance[joint.leaves[next].quadrangle] =
          corner_distance(joint.leaves[next], joint.leaves[joint.next(next)], gap(joint, next));
    }
  }

  // How far from the edge, along a plate, its face meets that of the other at this angle.
  double corner_distance(const Leaf& plate, const Leaf& other, double angle) const {
    return (half_thickness(other.quadrangle) + half_thickness(plate.quadrangle) * std::cos(angle)) /
           std::sin(angle);
  }

  // Cuts go on straight through the plates' mesh, to the plate's edge or to another cut, and into
  // the plates that stand across their way.
  void run_cuts_on() {
    std::map<int, std::vector<Edge>> edges_of;
    std::vector<Edge> waiting;
    for (const auto& [edge, joint] : joints_) {
      edges_of[edge.first].push_back(edge);
      edges_of[edge.second].push_back(edge);
      if (joint.is_cut()) waiting.push_back(edge);
    }
    while (!waiting.empty()) {
      const Edge edge = waiting.back();
      waiting.pop_back();
      const Joint joint = joints_.at(edge);
      for (const int end : {edge.first, edge.second})
        for (std::size_t i = 0; i < joint.leaves.size(); ++i)
          if (joint.open[i])
            for (const Edge& further : run_on(edge, joint, i, end, edges_of[end]))
              waiting.push_back(further);
    }
  }

  // The edges behind `end`, in the plate of an open gap and in those that stand on it, newly cut.
  std::vector<Edge> run_on(const Edge& edge, const Joint& joint, std::size_t leaf, int end,
                           const std::vector<Edge>& around) {
    const Leaf& left = joint.leaves[leaf];
    const Vector3 onward =
        (node(end) - node(edge.first == end ? edge.second : edge.first)).normalized();
    const Vector3 normal = left.ahead * normals_[left.quadrangle];
    std::vector<Edge> further;
    int in_plate = 0;
    bool runs_on = false;
    for (const Edge& other : around) {
      const Vector3 away =
          (node(other.first == end ? other.second : other.first) - node(end)).normalized();
      if (away.dot(normal) > std::cos(2 * flat) && cut(other, onward, joint, leaf))
        further.push_back(other);
      if (std::abs(away.dot(normal)) > std::sin(flat)) continue;
      ++in_plate;
      if (other == edge || away.dot(onward) < std::cos(2 * flat)) continue;
      runs_on = true;
      if (cut(other, normal, joint, leaf)) further.push_back(other);
    }
    constexpr int edges_at_a_border = 3;
    if (!runs_on && in_plate > edges_at_a_border)
      problem(node(end), "a joint ends within a plate whose mesh does not run on straight");
    return further;
  }

  // Cuts a plate of this normal open at an edge, on both sides, as wide as an open gap of a joint.
  bool cut(const Edge& edge, const Vector3& normal, const Joint& joint, std::size_t leaf) {
    const Leaf &left = joint.leaves[leaf], &right = joint.leaves[joint.next(leaf)];
    Joint& further = joints_.at(edge);
    if (further.leaves.size() != 2 || further.is_cut()) return false;  // a joint is cut as it needs
    if (std::abs(gap(further, 0) - M_PI) > flat) return false;
    for (const Leaf& one : further.leaves)
      if (std::abs(normals_[one.quadrangle].dot(normal)) < std::cos(2 * flat)) return false;
    further.open.assign(2, 1);
    for (const Leaf& one : further.leaves)
      further.distance[one.quadrangle] =
          joint.distance.at(one.inward.dot(left.inward) > 0 ? left.quadrangle : right.quadrangle);
    return true;
  }

  // Corners of sides: a number for each (quadrangle, corner, side), united with others.
  int side(int q, int n, int which) const {
    const auto& nodes = quadrangle(q).nodes;
    const auto corner = std::find(nodes.begin(), nodes.end(), n) - nodes.begin();
    return 8 * q + 2 * static_cast<int>(corner) + (which > 0 ? 1 : 0);
  }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite_sides() {
    parent_.resize(8 * mesh_.quadrangles.size());
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const auto& [edge, joint] : joints_) {
      if (joint.leaves.size() < 2) continue;
      for (std::size_t i = 0; i < joint.leaves.size(); ++i) {
        if (joint.open[i]) continue;
        const Leaf &a = joint.leaves[i], &b = joint.leaves[joint.next(i)];
        for (const int n : {edge.first, edge.second})
          parent_[root(side(a.quadrangle, n, a.ahead))] = root(side(b.quadrangle, n, -b.ahead));
      }
    }
  }

  // The planes on which a solid node lies, relative to the node of the mid-surface.
  struct Planes {
    int origin = 0;
    std::vector<Vector3> normals;
    std::vector<double> distances;
    void add(const Vector3& normal, double distance) {
      normals.push_back(normal);
      distances.push_back(distance);
    }
  };

  void place_nodes() {
    std::map<int, Planes> planes;
    for (int q = 0; q < static_cast<int>(mesh_.quadrangles.size()); ++q)
      for (const int n : quadrangle(q).nodes)
        for (const int which : {-1, 1}) {
          Planes& own = planes[root(side(q, n, which))];
          own.origin = n;
          own.add(which * normals_[q], half_thickness(q));
        }
    for (const auto& [edge, joint] : joints_)
      for (std::size_t i = 0; i < joint.leaves.size(); ++i) {
        if (!joint.open[i]) continue;
        const Leaf &a = joint.leaves[i], &b = joint.leaves[joint.next(i)];
        for (const int n : {edge.first, edge.second}) {
          planes[root(side(a.quadrangle, n, a.ahead))].add(a.inward,
                                                           joint.distance.at(a.quadrangle));
          planes[root(side(b.quadrangle, n, -b.ahead))].add(b.inward,
                                                            joint.distance.at(b.quadrangle));
        }
      }
    for (const auto& [number, own] : planes) {
      Eigen::MatrixX3d rows(own.normals.size(), 3);
      Eigen::VectorXd distances(own.normals.size());
      for (std::size_t i = 0; i < own.normals.size(); ++i) {
        rows.row(i) = own.normals[i].transpose();
        distances[i] = own.distances[i];
      }
      constexpr double parallel = 0.1;  // faces that nearly are meet at no corner: their mean
      const Vector3 place = node(own.origin) + algebra::least_squares(rows, distances, parallel);
      const std::size_t tag = solid_.nodes.size() + 1;
      solid_.nodes[tag] = {place.x(), place.y(), place.z()};
      tag_of_[number] = tag;
      tags_of_node_[own.origin].push_back(tag);
    }
  }

  std::size_t tag(int q, int n, int which) { return tag_of_.at(root(side(q, n, which))); }

  void add_element(std::vector<std::size_t> nodes, int plate, const Vector3& place) {
    if (std::set<std::size_t>(nodes.begin(), nodes.end()).size() < nodes.size()) {
      problem(place, "a joint ends within a plate, so that an element closes to an edge");
      return;
    }
    const std::size_t number = solid_.elements.size() + 1;
    solid_.element_sets[mesh_.plates[plate].name].push_back(number);
    solid_.elements.push_back({number, std::move(nodes)});
  }

  void add_plates() {
    for (int q = 0; q < static_cast<int>(mesh_.quadrangles.size()); ++q) {
      std::vector<std::size_t> nodes;
      for (const int which : {-1, 1})
        for (const int n : quadrangle(q).nodes) nodes.push_back(tag(q, n, which));
      const std::string& name = mesh_.plates[quadrangle(q).plate].name;
      const std::size_t before = solid_.elements.size();
      add_element(nodes, quadrangle(q).plate, node(quadrangle(q).nodes[0]));
      if (solid_.elements.size() == before) continue;
      solid_.surfaces[name + " -"].push_back({before + 1, 1});
      solid_.surfaces[name + " +"].push_back({before + 1, 2});
    }
  }

  // The corners between the plates at an end of an edge, by increasing angle.
  std::vector<std::size_t> polygon(const Joint& joint, int end) {
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < joint.leaves.size(); ++i) {
      const Leaf &a = joint.leaves[i], &b = joint.leaves[joint.next(i)];
      corners.push_back(tag(a.quadrangle, end, a.ahead));
      if (joint.open[i]) corners.push_back(tag(b.quadrangle, end, -b.ahead));
    }
    return corners;
  }

  int thickest(const Joint& joint) const {
    int best = joint.leaves.front().quadrangle;
    for (const Leaf& leaf : joint.leaves)
      if (half_thickness(leaf.quadrangle) > half_thickness(best)) best = leaf.quadrangle;
    return quadrangle(best).plate;
  }

  void add_columns() {
    for (const auto& [edge, joint] : joints_) {
      if (joint.leaves.size() < 3 && !joint.is_cut()) continue;
      std::vector<std::size_t> nodes = polygon(joint, edge.first);
      const std::vector<std::size_t> top = polygon(joint, edge.second);
      if (nodes.size() != 3 && nodes.size() != 4) {
        problem(middle(edge), fmt::format("{} plates meet with {} corners between them; three or "
                                          "four can be filled",
                                          joint.leaves.size(), nodes.size()));
        continue;
      }
      for (const int end : {edge.first, edge.second})
        ends_[end].push_back({end == edge.first ? nodes : top, thickest(joint)});
      nodes.insert(nodes.end(), top.begin(), top.end());
      add_element(nodes, thickest(joint), middle(edge));
    }
  }

  struct ColumnEnd {
    std::vector<std::size_t> corners;  ///< in turn
    int plate = 0;
  };

  // Where columns of several directions end at one node, what lies between their ends is filled.
  void add_crossings() {
    for (const auto& [n, ends] : ends_) {
      std::map<std::set<std::size_t>, const ColumnEnd*> faces;
      std::set<std::size_t> all;
      for (const ColumnEnd& end : ends) {
        faces[{end.corners.begin(), end.corners.end()}] = &end;
        all.insert(end.corners.begin(), end.corners.end());
      }
      if (faces.size() < 2) continue;
      if (!fill(faces, all, n))
        problem(node(n), fmt::format("columns of {} joints end with {} corners between them, which "
                                     "no hexahedron or wedge fills",
                                     faces.size(), all.size()));
    }
  }

  bool fill(const std::map<std::set<std::size_t>, const ColumnEnd*>& faces,
            const std::set<std::size_t>& all, int n) {
    for (const auto& [base, end] : faces) {
      if (2 * base.size() != all.size()) continue;
      std::map<std::size_t, std::size_t> across;
      for (const auto& [corners, other] : faces) {
        const std::vector<std::size_t>& ring = other->corners;
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const std::size_t a = ring[i], b = ring[(i + 1) % ring.size()];
          if (base.count(a) > 0 && base.count(b) == 0) across[a] = b;
          if (base.count(b) > 0 && base.count(a) == 0) across[b] = a;
        }
      }
      if (across.size() != base.size()) continue;
      std::vector<std::size_t> nodes = end->corners;
      for (std::size_t i = 0; i < end->corners.size(); ++i)
        nodes.push_back(across.at(end->corners[i]));
      if (smallest_corner(nodes) < 0) {
        std::reverse(nodes.begin(), nodes.begin() + static_cast<long>(base.size()));
        std::reverse(nodes.begin() + static_cast<long>(base.size()), nodes.end());
      }
      add_element(nodes, end->plate, node(n));
      return true;
    }
    return false;
  }

  Vector3 place(std::size_t tag) const {
    const auto& p = solid_.nodes.at(tag);
    return {p[0], p[1], p[2]};
  }

  // Smallest of the volumes that the edges span at the corners, over the longest edge's cube.
  double smallest_corner(const std::vector<std::size_t>& nodes) const {
    const std::size_t ring = nodes.size() / 2;
    double smallest = 1e300, longest = 0;
    for (std::size_t layer = 0; layer < 2; ++layer)
      for (std::size_t i = 0; i < ring; ++i) {
        const Vector3 corner = place(nodes[layer * ring + i]);
        const Vector3 next = place(nodes[layer * ring + (i + 1) % ring]) - corner;
        const Vector3 last = place(nodes[layer * ring + (i + ring - 1) % ring]) - corner;
        const Vector3 up = (place(nodes[ring + i]) - place(nodes[i]));
        smallest = std::min(smallest, next.cross(last).dot(up));
        longest = std::max({longest, next.norm(), last.norm(), up.norm()});
      }
    return smallest / std::pow(longest, 3);
  }

  void check_shapes() {
    for (const AbaqusElement& element : solid_.elements)
      if (!(smallest_corner(element.nodes) > 1e-9))
        problem(place(element.nodes[0]),
                "plates meet at too sharp an angle, or elements are smaller than the thickness");
  }

  void add_sets() {
    for (const auto& [name, nodes] : mesh_.node_sets)
      for (const int n : nodes) {
        const std::vector<std::size_t>& tags = tags_of_node_[n];
        auto& set = solid_.node_sets[name];
        set.insert(set.end(), tags.begin(), tags.end());
      }
  }

  const PlateMesh& mesh_;
  AbaqusMesh solid_;
  std::vector<Vector3> normals_;  ///< of quadrangles
  std::map<Edge, Joint> joints_;
  std::vector<int> parent_;
  std::map<int, std::size_t> tag_of_;
  std::map<int, std::vector<std::size_t>> tags_of_node_;
  std::map<int, std::vector<ColumnEnd>> ends_;
  std::set<std::string> problems_;
};

}  // namespace

AbaqusMesh thicken(const PlateMesh& mesh) { return Thickening(mesh).make(); }

}  // namespace blocklift::structure
