// Nodes tied to surfaces of shells and solids.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/index.h"
#include "structure/mesh/fields/shell_tree.h"
#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// The place of a cell's surface nearest to a point.
struct Foot {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
  Vector3 place = Vector3::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

/// Gauss and Newton's steps from the middle, kept on the cell; a warped one needs a few.
/// @param place of a point (xi, eta) of the unit square.
template <typename Place>
Foot find_foot(const Place& place, const Vector3& point) {
  constexpr int most_steps = 30;
  constexpr double small = 1e-6;  // of the unit square, for slopes
  Foot foot;
  foot.xi = {0.5, 0.5};
  for (int step = 0; step < most_steps; ++step) {
    foot.place = place(foot.xi);
    Eigen::Matrix<double, 3, 2> slopes;
    for (int i = 0; i < 2; ++i) {
      const double side = foot.xi[i] > 0.5 ? -small : small;
      slopes.col(i) = (place(foot.xi + side * Eigen::Vector2d::Unit(i)) - foot.place) / side;
    }
    const Eigen::Vector2d before = foot.xi;
    foot.xi += algebra::least_squares(slopes, point - foot.place);
    foot.xi = foot.xi.cwiseMax(0).cwiseMin(1);
    if ((foot.xi - before).norm() < 1e-12) break;
  }
  foot.place = place(foot.xi);
  foot.distance = (point - foot.place).norm();
  return foot;
}

/// A solid's face as an image of the unit square; a triangle's last two corners are one.
class FaceOfSolid {
 public:
  FaceOfSolid(const Mesh& mesh, int solid, const std::vector<int>& corners)
      : solid_(&mesh.solids[solid]), places_(places_of(mesh, *solid_)) {
    const SolidTopology& topology = topology_of(solid_->shape);
    const std::array<std::size_t, 4> order = corners.size() == 3
                                                 ? std::array<std::size_t, 4>{0, 1, 2, 2}
                                                 : std::array<std::size_t, 4>{0, 1, 3, 2};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto found =
          std::find(solid_->vertices.begin(), solid_->vertices.end(), corners[order[i]]);
      local_.col(i) = topology.kind.local.col(found - solid_->vertices.begin());
    }
    for (const int corner : corners) centre_ += mesh.vertices[corner];
    centre_ /= static_cast<double>(corners.size());
    for (const int corner : corners)
      radius_ = std::max(radius_, (mesh.vertices[corner] - centre_).norm());
  }

  /// Vertices of the solid that lie on the face, and the values of their shape functions.
  std::vector<std::pair<int, double>> shares(const Eigen::Vector2d& xi) const {
    std::vector<std::pair<int, double>> shares;
    const Eigen::VectorXd values = shape_of(solid_->shape).values(local(xi));
    for (std::size_t i = 0; i < solid_->vertices.size(); ++i)
      if (const double value = values[i]; std::abs(value) > 1e-12)
        shares.emplace_back(solid_->vertices[i], value);
    return shares;
  }

  Foot foot_of(const Vector3& point) const {
    return find_foot(
        [this](const Eigen::Vector2d& xi) -> Vector3 {
          return places_ * shape_of(solid_->shape).values(local(xi));
        },
        point);
  }

  /// The nearest that a point can be, by the sphere about the corners.
  double least_distance(const Vector3& point) const {
    return (point - centre_).norm() - 1.2 * radius_;
  }
  /// As of shells: 5 % of the size.
  double reach() const { return 0.05 * std::sqrt(2.0) * radius_; }

 private:
  Vector3 local(const Eigen::Vector2d& xi) const {
    const double x = xi.x(), y = xi.y();
    return local_ * Eigen::Vector4d((1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y);
  }

  const Solid* solid_;
  Eigen::Matrix3Xd places_;
  Eigen::Matrix<double, 3, 4> local_;  ///< corners on the unit solid, lexicographic
  Vector3 centre_ = Vector3::Zero();
  double radius_ = 0;
};

/// What nodes are tied to.
struct MasterSurface {
  std::vector<int> shells;
  std::vector<FaceOfSolid> faces;
  std::set<int> vertices;  ///< on it: joined already
};

/// Distance of a node that lies on its surface, m.
constexpr double touching = 1e-9;

class Ties {
 public:
  explicit Ties(AbaqusModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    for (const AbaqusScope& scope : model_.scopes)
      for (const AbaqusBlock* block : scope.blocks) {
        if (block->name == "TIE") model_.guarded(*block, [&] { add(scope, *block); });
        if (block->name == "CONTACT PAIR") join_or_leave(scope, *block);
        if (block->name == "SHELL TO SOLID COUPLING")
          model_.guarded(*block, [&] { couple(scope, *block); });
      }
  }

 private:
  // *TIE, NAME = , POSITION TOLERANCE = , NO ROTATION / slave, master
  void add(const AbaqusScope& scope, const AbaqusBlock& block) {
    for (const char* unknown : {"CYCLIC SYMMETRY", "MULTIPHYSICS", "CONSTRAINT RATIO"})
      if (block.has(unknown)) throw CardError{fmt::format("{} is not known", unknown)};
    const std::optional<double> tolerance = distance(block, "POSITION TOLERANCE");
    has_rotations_ = !block.has("NO ROTATION");
    if (block.data.empty()) throw CardError{"the two surfaces are missing"};
    for (const AbaqusLine& line : block.data) {
      const auto fields = line.fields();
      if (fields.size() < 2) throw CardError{"two surfaces are due: slave and master"};
      fasten(slaves_of(scope, fields[0]), masters_of(scope, fields[1]), tolerance, block.line);
    }
  }

  // *CONTACT PAIR, INTERACTION = , TIED, ADJUST = / slave, master. Contact that is tied, by itself
  // or by its interaction (CalculiX), joins; any other is left open.
  void join_or_leave(const AbaqusScope& scope, const AbaqusBlock& block) {
    if (!block.has("TIED") && !has_tied_interaction(block)) {
      model_.log.leave_out("*CONTACT PAIR",
                           "surfaces that touch are not joined; *TIE, or contact that is tied, "
                           "joins them");
      return;
    }
    model_.guarded(block, [&] {
      // A set in place of a distance names the nodes that are moved.
      const bool has_distance = to_real(block.value("ADJUST")).has_value();
      const auto tolerance = has_distance ? distance(block, "ADJUST") : std::nullopt;
      has_rotations_ = true;
      for (const AbaqusLine& line : block.data) {
        const auto fields = line.fields();
        if (fields.size() < 2) throw CardError{"two surfaces are due: slave and master"};
        fasten(slaves_of(scope, fields[0]), masters_of(scope, fields[1]), tolerance, block.line);
      }
    });
  }

  /// *SURFACE INTERACTION, NAME = with *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE = TIED below it.
  bool has_tied_interaction(const AbaqusBlock& pair) const {
    const std::string name = pair.value("INTERACTION");
    for (const AbaqusScope& scope : model_.scopes) {
      bool is_meant = false;
      for (const AbaqusBlock* block : scope.blocks) {
        if (block->name == "SURFACE INTERACTION") is_meant = block->value("NAME") == name;
        if (block->name == "SURFACE BEHAVIOR" && is_meant &&
            block->value("PRESSURE-OVERCLOSURE") == "TIED")
          return true;
      }
    }
    return false;
  }

  std::optional<double> distance(const AbaqusBlock& block, const char* parameter) const {
    if (!block.has(parameter)) return std::nullopt;
    const auto value = to_real(block.value(parameter));
    if (!value || *value < 0)
      throw CardError{fmt::format("{} = {} is no distance", parameter, block.value(parameter))};
    return *value * model_.units.length;
  }

  // *SHELL TO SOLID COUPLING, CONSTRAINT NAME = , INFLUENCE DISTANCE = / shells' edge, solids'
  // faces The solids' nodes follow the plate's edge as points of its thickness.
  void couple(const AbaqusScope& scope, const AbaqusBlock& block) {
    has_rotations_ = true;
    for (const AbaqusLine& line : block.data) {
      const auto fields = line.fields();
      if (fields.size() < 2) throw CardError{"two surfaces are due: of shells, then of solids"};
      const MasterSurface edge = masters_of(scope, fields[0]);
      if (edge.shells.empty() || !edge.faces.empty())
        throw CardError{fmt::format("the surface {} is none of shells' edges", fields[0])};
      fasten(slaves_of(scope, fields[1]), edge, distance(block, "INFLUENCE DISTANCE"), block.line);
    }
    model_.log.remark(block.line,
                      "*SHELL TO SOLID COUPLING: cross-sections stay plane there, which stiffens "
                      "the solids within a thickness of the edge");
  }

  std::set<int> slaves_of(const AbaqusScope& scope, std::string_view name) const {
    std::set<int> slaves;
    const NamedAbaqusSurface* named = model_.find_surface(scope, name);
    if (named == nullptr) {
      const std::vector<int> nodes = model_.nodes_of(scope, name);
      slaves.insert(nodes.begin(), nodes.end());
      return slaves;
    }
    const AbaqusSurface& surface = named->second;
    for (const auto& [node, area] : surface.nodes) slaves.insert(node);
    for (const auto& [element, face] : surface.faces) {
      const AbaqusDeckElement& one = model_.elements[element];
      if (one.solid >= 0) {
        add_face(one, face, slaves);
        continue;
      }
      const std::size_t corners = one.shell >= 0 && mesh_.shells[one.shell].is_triangle() ? 3
                                  : one.shell >= 0                                        ? 4
                                                   : one.nodes.size();
      const bool is_edge = face.size() == 2 && face[0] == 'E' && face[1] >= '1' &&
                           face[1] < static_cast<char>('1' + corners);
      if (is_edge) {
        const auto side = static_cast<std::size_t>(face[1] - '1');
        slaves.insert(one.nodes[side]);
        slaves.insert(one.nodes[(side + 1) % corners]);
      } else {
        slaves.insert(one.nodes.begin(), one.nodes.begin() + static_cast<std::ptrdiff_t>(corners));
      }
    }
    return slaves;
  }

  /// The corners of a solid's face and the middles of its edges.
  void add_face(const AbaqusDeckElement& element, const std::string& face,
                std::set<int>& vertices) const {
    const std::vector<int> corners = corners_of_face(element, face);
    const auto is_corner = [&](int vertex) {
      return std::find(corners.begin(), corners.end(), vertex) != corners.end();
    };
    const Solid& solid = mesh_.solids[element.solid];
    const SolidTopology& topology = topology_of(solid.shape);
    vertices.insert(corners.begin(), corners.end());
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      if (is_corner(solid.vertices[topology.edges[e][0]]) &&
          is_corner(solid.vertices[topology.edges[e][1]]))
        vertices.insert(solid.vertices[at(topology.corners) + e]);
  }

  MasterSurface masters_of(const AbaqusScope& scope, std::string_view name) const {
    const AbaqusSurface& surface = model_.surface(scope, name).second;
    if (surface.is_of_nodes)
      throw CardError{
          fmt::format("the master {} is a surface of nodes; one of shells or solids is due", name)};
    MasterSurface master;
    std::set<int> shells;
    for (const auto& [element, face] : surface.faces) {
      const AbaqusDeckElement& one = model_.elements[element];
      if (one.solid >= 0) {
        master.faces.emplace_back(mesh_, one.solid, corners_of_face(one, face));
        add_face(one, face, master.vertices);
      } else if (one.shell >= 0) {
        shells.insert(one.shell);
        const auto& corners = mesh_.shells[one.shell].vertices;
        master.vertices.insert(corners.begin(), corners.end());
      } else {
        throw CardError{fmt::format("element {} is no shell and no solid", one.label)};
      }
    }
    master.shells.assign(shells.begin(), shells.end());
    return master;
  }

  /// Without a tolerance of its own a node is tied within 5 % of the shell's size, beyond half the
  /// thickness of either.
  double reach_of(int s) const {
    const Shell& shell = mesh_.shells[s];
    const double size =
        (mesh_.vertices[shell.vertices[3]] - mesh_.vertices[shell.vertices[0]]).norm() /
        std::sqrt(2.0);
    return 0.05 * size + (shell.section >= 0 ? mesh_.section_of(shell).thickness : 0);
  }

  void fasten(const std::set<int>& slaves, const MasterSurface& master,
              std::optional<double> tolerance, SourceLine line) {
    const ShellTree tree(mesh_, master.shells);
    double farthest = tolerance.value_or(0);
    if (!tolerance)
      for (const int s : master.shells) farthest = std::max(farthest, reach_of(s));
    int loose = 0, hinged = 0;
    double moved = 0;
    for (const int slave : slaves) {
      if (master.vertices.count(slave) > 0) continue;  // joined already
      const Vector3 point = model_.place(slave);
      Foot nearest;
      int shell = -1;
      const FaceOfSolid* face = nullptr;
      tree.for_each_near(point, farthest, [&](int s) {
        const Foot foot = find_foot(
            [&](const Eigen::Vector2d& xi) { return position(mesh_, mesh_.shells[s], xi); }, point);
        if (foot.distance > tolerance.value_or(reach_of(s)) || foot.distance >= nearest.distance)
          return;
        nearest = foot;
        shell = s;
      });
      for (const FaceOfSolid& one : master.faces) {
        const double reach = tolerance.value_or(one.reach());
        if (one.least_distance(point) > std::min(reach, nearest.distance)) continue;
        const Foot foot = one.foot_of(point);
        if (foot.distance > reach || foot.distance >= nearest.distance) continue;
        nearest = foot;
        face = &one;
      }
      if (face != nullptr) {
        tie(slave, *face, nearest);
        moved = std::max(moved, nearest.distance);
        if (turns(slave)) ++hinged;
      } else if (shell >= 0) {
        tie(slave, shell, nearest);
        if (nearest.distance >= touching)
          model_.log.leave_out("*TIE",
                               "moving tied nodes onto shells: short rigid arms reach them");
      } else {
        ++loose;
      }
    }
    if (loose > 0)
      model_.log.remark(line, fmt::format("*TIE: {} of {} nodes are too far from the surface to be "
                                          "tied, and stay free",
                                          loose, slaves.size()));
    if (hinged > 0)
      model_.log.remark(line,
                        fmt::format("*TIE: {} nodes of plates or beams follow solids by their "
                                    "displacements and may turn; *SHELL TO SOLID COUPLING "
                                    "ties plates' rotations",
                                    hinged));
    if (moved >= 1e-6)
      model_.log.remark(line, fmt::format("*TIE: nodes tied to solids are moved onto their "
                                          "surface, by up to {:.3g} mm",
                                          1000 * moved));
  }

  bool turns(int vertex) {
    if (turning_.empty()) {
      turning_.assign(mesh_.vertices.size(), 0);
      for (const Shell& shell : mesh_.shells)
        for (const int corner : shell.vertices) turning_[corner] = 1;
      for (const Beam& beam : mesh_.beams)
        for (const int end : beam.vertices) turning_[end] = 1;
    }
    return at(vertex) < turning_.size() && turning_[vertex] != 0;
  }

  /// A solid's surface has displacements alone: what is tied to it moves with the place of its
  /// foot, and may turn.
  void tie(int slave, const FaceOfSolid& face, const Foot& foot) {
    mesh_.vertices[slave] = foot.place;
    const auto shares = face.shares(foot.xi);
    for (int c = 0; c < 3; ++c) {
      MotionEquation equation;
      equation.label = static_cast<long>(mesh_.equations.size()) + 1;
      equation.terms.push_back({slave, Vector3::Unit(c)});
      for (const auto& [vertex, share] : shares)
        equation.terms.push_back({vertex, -share * Vector3::Unit(c)});
      mesh_.equations.push_back(std::move(equation));
    }
  }

  void tie(int slave, int shell, const Foot& foot) {
    if (has_rotations_ && foot.distance < touching) {
      mesh_.surface_points.push_back({slave, shell, foot.xi});
      return;
    }
    const auto vertex = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.push_back(foot.place);
    mesh_.vertex_labels.push_back(next_label());
    mesh_.surface_points.push_back({vertex, shell, foot.xi});
    RigidLink arm;
    arm.master = vertex;
    arm.slaves = {slave};
    for (std::size_t i = 3; i < 6; ++i) arm.bound[i] = has_rotations_;
    mesh_.rigid_links.push_back(arm);
  }

  long next_label() {
    if (greatest_ == 0)
      greatest_ = *std::max_element(mesh_.vertex_labels.begin(), mesh_.vertex_labels.end());
    return ++greatest_;
  }

  AbaqusModel& model_;
  Mesh& mesh_;
  bool has_rotations_ = true;
  std::vector<char> turning_;  ///< vertices of shells and beams
  long greatest_ = 0;
};

}  // namespace

void read_abaqus_ties(AbaqusModel& model) { Ties(model).read(); }

}  // namespace blocklift::structure
