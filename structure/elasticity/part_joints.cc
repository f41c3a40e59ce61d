#include "structure/elasticity/part_joints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/index.h"
#include "structure/mesh/element_shape.h"
#include "structure/mesh/element_tables.h"
#include "structure/mesh/place_grid.h"

namespace blocklift::structure {

namespace {

constexpr double touching = 0.05;  // of a solid's edges

/// An outer face of a solid.
struct OuterFace {
  int solid = 0;  ///< element
  std::vector<int> nodes;
  Vector3 middle = Vector3::Zero();   ///< of its corners, m
  Vector3 outward = Vector3::Zero();  ///< unit
  double edge = 0;                    ///< mean length, m
};

OuterFace outer_face(const PartMesh& mesh, int solid, const ElementFace& of_kind) {
  OuterFace face;
  face.solid = solid;
  for (const int local : of_kind.nodes) face.nodes.push_back(mesh.node(solid, local));
  const int corners = of_kind.corners;
  const auto corner = [&](int i) -> Vector3 { return mesh.nodes.col(face.nodes[at(i % corners)]); };
  Vector3 area = Vector3::Zero();
  for (int i = 0; i < corners; ++i) {
    face.middle += corner(i) / corners;
    face.edge += (corner(i + 1) - corner(i)).norm() / corners;
    area += (corner(i) - corner(0)).cross(corner(i + 1) - corner(0));
  }
  face.outward = area.normalized();
  if (face.outward.dot(face.middle - mesh.centre(solid)) < 0) face.outward = -face.outward;
  return face;
}

/// The faces that one solid alone has.
std::vector<OuterFace> find_outer_faces(const PartMesh& mesh) {
  std::map<int, std::vector<ElementFace>> faces_of_kind;
  std::map<std::vector<int>, std::pair<int, const ElementFace*>> once;  // by corners
  for (const int solid : mesh.solids) {
    auto& faces = faces_of_kind[mesh.elements[solid].kind];
    if (faces.empty()) faces = element_faces(mesh.kind(solid));
    for (const ElementFace& face : faces) {
      std::vector<int> corners;
      for (int i = 0; i < face.corners; ++i) corners.push_back(mesh.node(solid, face.nodes[at(i)]));
      std::sort(corners.begin(), corners.end());
      const auto [entry, is_new] = once.try_emplace(std::move(corners), solid, &face);
      if (!is_new) once.erase(entry);
    }
  }
  std::vector<OuterFace> outer;
  for (const auto& [corners, face] : once)
    outer.push_back(outer_face(mesh, face.first, *face.second));
  return outer;
}

using SolidBox = std::pair<int, Eigen::AlignedBox3d>;  // of an element

/// Cubes as large as the mean of the boxes, and so large that none is in too many.
double cube_for(const std::vector<SolidBox>& boxes) {
  constexpr double most_cubes = 8;  // that a box may take along an axis
  double largest = 0, sum = 0;
  for (const auto& [solid, box] : boxes) {
    largest = std::max(largest, box.sizes().maxCoeff());
    sum += box.sizes().maxCoeff();
  }
  return std::max(largest / most_cubes, sum / static_cast<double>(boxes.size()));
}

/// The nearest place of another body.
struct Foot {
  double gap = std::numeric_limits<double>::infinity();  ///< m
  int solid = -1;                                        ///< element
  Vector3 xi = Vector3::Zero();
};

using Feet = std::map<int, Foot>;  // by body

class JointFinder {
 public:
  JointFinder(const PartMesh& mesh, const std::optional<double>& within)
      : mesh_(mesh), within_(within), body_of_node_(connected_bodies(mesh)) {}

  PartJoints find(const std::vector<FixedUnknown>& held) {
    int bodies = 0;
    for (const int body : body_of_node_) bodies = std::max(bodies, body + 1);
    if (bodies < 2) return {};
    faces_ = find_outer_faces(mesh_);
    fill_grid();
    find_feet(bodies);
    PartJoints joints;
    if (within_) tie(held, joints);
    for (auto& [pair, meeting] : meetings_) {
      meeting.bodies = {name_of(pair.first), name_of(pair.second)};
      joints.meetings.push_back(std::move(meeting));
    }
    return joints;
  }

 private:
  int body_of(int solid) const { return body_of_node_[mesh_.node(solid, 0)]; }
  double reach_of(int solid) const {
    return std::max(within_.value_or(0), touching * edge_of_solid_.at(solid));
  }

  void fill_grid() {
    for (const OuterFace& face : faces_) {
      const auto [edge, is_new] = edge_of_solid_.try_emplace(face.solid, face.edge);
      edge->second = std::min(edge->second, face.edge);
    }
    for (const auto& [solid, edge] : edge_of_solid_) {
      const Eigen::Matrix3Xd places = mesh_.places(solid);
      Eigen::AlignedBox3d box(places.rowwise().minCoeff(), places.rowwise().maxCoeff());
      const double more = reach_of(solid) + touching * edge;  // curved sides stand out of the nodes
      box.min().array() -= more;
      box.max().array() += more;
      boxes_.emplace_back(solid, box);
      const int kind = mesh_.elements[solid].kind;
      auto& shape = shapes_[kind];
      if (!shape) shape = std::make_unique<ElementShape>(mesh_.kind(solid));
    }
    if (boxes_.empty()) return;
    grid_ = PlaceGrid(cube_for(boxes_));
    for (int b = 0; b < static_cast<int>(boxes_.size()); ++b) grid_.add(boxes_[at(b)].second, b);
  }

  /// The nearest places of other bodies to which one of some directions points.
  Feet feet_of(const Vector3& place, int body, const std::vector<Vector3>& outward) const {
    constexpr double facing = 0.5, rounding = 1e-6;
    Feet feet;
    grid_.visit(place, [&](int b) {
      const auto& [solid, box] = boxes_[at(b)];
      if (!box.contains(place) || body_of(solid) == body) return;
      Foot foot;
      foot.solid = solid;
      const Eigen::Matrix3Xd places = mesh_.places(solid);
      const ElementShape& shape = *shapes_.at(mesh_.elements[solid].kind);
      foot.gap = shape.nearest(places, place, foot.xi);
      if (!(foot.gap <= reach_of(solid))) return;
      const Vector3 across = places * shape.values(foot.xi) - place;
      const bool faces = foot.gap <= rounding * edge_of_solid_.at(solid) ||
                         std::any_of(outward.begin(), outward.end(), [&](const Vector3& normal) {
                           return normal.dot(across) >= facing * foot.gap;
                         });
      Foot& known = feet[body_of(solid)];
      if (faces && foot.gap < known.gap) known = foot;
    });
    std::erase_if(feet, [](const auto& entry) { return entry.second.solid < 0; });
    return feet;
  }

  void note(int body, const Vector3& place, const Feet& feet) {
    for (const auto& [other, foot] : feet) {
      const std::pair<int, int> pair = std::minmax({body, other});
      const auto [entry, is_new] = meetings_.try_emplace(pair);
      if (!is_new && foot.gap >= entry->second.gap) continue;
      entry->second.gap = foot.gap;
      entry->second.place = place;
    }
  }

  void find_feet(int bodies) {
    struct OfNode {
      std::vector<Vector3> outward;
      double edges = 0;
    };
    std::map<int, OfNode> of_nodes;
    for (const OuterFace& face : faces_) {
      note(body_of(face.solid), face.middle,
           feet_of(face.middle, body_of(face.solid), {face.outward}));
      for (const int node : face.nodes) {
        of_nodes[node].outward.push_back(face.outward);
        of_nodes[node].edges += face.edge;
      }
    }
    edges_.assign(at(bodies), 0);
    std::vector<double> counts(at(bodies), 0);
    for (const auto& [node, of_node] : of_nodes) {
      const int body = body_of_node_[at(node)];
      Feet feet = feet_of(mesh_.nodes.col(node), body, of_node.outward);
      if (feet.empty()) continue;
      note(body, mesh_.nodes.col(node), feet);
      edges_[at(body)] += of_node.edges;
      counts[at(body)] += static_cast<double>(of_node.outward.size());
      feet_.emplace_back(node, std::move(feet));
    }
    // A body whose faces are so large that none of their nodes is there is followed by others.
    constexpr double large = 1e300;
    for (std::size_t body = 0; body < counts.size(); ++body)
      edges_[body] = counts[body] > 0 ? edges_[body] / counts[body] : large;
  }

  /// Does the first body follow the second? Where faces are alike the later one follows.
  bool follows(int body, int other) const {
    // Rounded logarithms, so that the order does not hang on the last digits of lengths.
    const auto size = [&](int of) { return std::llround(1e5 * std::log(edges_[at(of)])); };
    const auto own = size(body), its = size(other);
    return own != its ? own < its : body > other;
  }

  void tie(const std::vector<FixedUnknown>& held, PartJoints& joints) {
    std::vector<char> is_held(at(3 * mesh_.nodes.cols()), 0);
    for (const FixedUnknown& unknown : held) is_held[at(unknown.unknown)] = 1;
    // Those that others follow come first, so that what they follow themselves is known.
    std::stable_sort(feet_.begin(), feet_.end(), [&](const auto& a, const auto& b) {
      return follows(body_of_node_[at(b.first)], body_of_node_[at(a.first)]);
    });
    for (const auto& [node, feet] : feet_) {
      const int body = body_of_node_[at(node)];
      const Foot* nearest = nullptr;
      for (const auto& [other, foot] : feet)
        if (follows(body, other) && foot.gap <= *within_ && (!nearest || foot.gap < nearest->gap))
          nearest = &foot;
      if (!nearest) continue;
      const std::pair<int, int> pair = std::minmax({body, body_of(nearest->solid)});
      PartMeeting& meeting = meetings_.at(pair);
      ++meeting.tied_nodes;
      meeting.largest_gap = std::max(meeting.largest_gap, nearest->gap);
      for (int axis = 0; axis < 3; ++axis)
        if (!is_held[at(3 * node + axis)]) add_tie(node, axis, *nearest, joints.ties);
    }
  }

  void add_tie(int node, int axis, const Foot& foot, std::vector<PartTie>& ties) {
    constexpr double rounding = 1e-13;
    const ElementShape& shape = *shapes_.at(mesh_.elements[foot.solid].kind);
    const Eigen::Matrix3Xd places = mesh_.places(foot.solid);
    const Eigen::MatrixX3d gradients = shape.gradients(foot.xi);
    const Eigen::VectorXd values = shape.values(foot.xi);
    const Vector3 miss = mesh_.nodes.col(node) - places * values;
    const Eigen::Matrix3d jacobian = places * gradients;
    const Eigen::VectorXd shares = values + gradients * algebra::solve_square(jacobian, miss);
    std::map<int, double> sum;
    for (Eigen::Index i = 0; i < shares.size(); ++i) {
      if (std::abs(shares[i]) < rounding) continue;
      const int followed = 3 * mesh_.node(foot.solid, static_cast<int>(i)) + axis;
      const auto known = tie_of_.find(followed);
      if (known == tie_of_.end()) {
        sum[followed] += shares[i];
        continue;
      }
      const PartTie& further = ties[known->second];
      for (std::size_t j = 0; j < further.followed.size(); ++j)
        sum[further.followed[j]] += shares[i] * further.shares[j];
    }
    PartTie tie{3 * node + axis, {}, {}};
    for (const auto& [followed, share] : sum) {
      tie.followed.push_back(followed);
      tie.shares.push_back(share);
    }
    tie_of_[tie.freedom] = ties.size();
    ties.push_back(std::move(tie));
  }

  /// The first group of solids that is the body, and the body's middle.
  std::string name_of(int body) const {
    std::vector<char> is_own(mesh_.elements.size(), 0);
    int count = 0;
    Vector3 sum = Vector3::Zero();
    for (const int solid : mesh_.solids)
      if (body_of(solid) == body) {
        is_own[at(solid)] = 1;
        ++count;
        sum += mesh_.centre(solid);
      }
    const Vector3 middle = sum / count;
    std::string where =
        fmt::format("about ({:.4g}, {:.4g}, {:.4g}) m", middle.x(), middle.y(), middle.z());
    for (const PartGroup& group : mesh_.groups)
      if (group.dimension == 3 && static_cast<int>(group.elements.size()) == count &&
          std::all_of(group.elements.begin(), group.elements.end(),
                      [&](int element) { return is_own[at(element)] != 0; }))
        return fmt::format("\"{}\" {}", group.name, where);
    return where;
  }

  const PartMesh& mesh_;
  std::optional<double> within_;
  std::vector<int> body_of_node_;
  std::vector<OuterFace> faces_;
  std::map<int, double> edge_of_solid_;  // the shortest of its outer faces, by element
  std::vector<SolidBox> boxes_;          // of solids with outer faces, and their reach
  PlaceGrid grid_{1};                    // of these
  std::map<int, std::unique_ptr<ElementShape>> shapes_;  // by kind
  std::vector<std::pair<int, Feet>> feet_;               // of nodes that have any
  std::vector<double> edges_;                            // mean of a body's faces there, m
  std::map<std::pair<int, int>, PartMeeting> meetings_;  // by bodies
  std::map<int, std::size_t> tie_of_;                    // by freedom
};

}  // namespace

PartJoints find_part_joints(const PartMesh& mesh, const std::vector<FixedUnknown>& held,
                            const std::optional<double>& within) {
  return JointFinder(mesh, within).find(held);
}

}  // namespace blocklift::structure
