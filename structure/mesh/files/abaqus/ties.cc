// Nodes tied to surfaces of shells.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/shell_tree.h"

namespace blocklift::structure {

namespace {

/// The place of a shell nearest to a point.
struct Foot {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
  Vector3 place = Vector3::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

/// Gauss and Newton's steps from the middle, kept on the shell; a warped shell needs a few.
Foot find_foot(const Mesh& mesh, const Shell& shell, const Vector3& point) {
  constexpr int most_steps = 30;
  constexpr double small = 1e-6;  // of the unit square, for slopes
  Foot foot;
  foot.xi = {0.5, 0.5};
  for (int step = 0; step < most_steps; ++step) {
    foot.place = position(mesh, shell, foot.xi);
    Eigen::Matrix<double, 3, 2> slopes;
    for (int i = 0; i < 2; ++i) {
      const double side = foot.xi[i] > 0.5 ? -small : small;
      slopes.col(i) =
          (position(mesh, shell, foot.xi + side * Eigen::Vector2d::Unit(i)) - foot.place) / side;
    }
    const Eigen::Vector2d before = foot.xi;
    foot.xi += slopes.colPivHouseholderQr().solve(point - foot.place);
    foot.xi = foot.xi.cwiseMax(0).cwiseMin(1);
    if ((foot.xi - before).norm() < 1e-12) break;
  }
  foot.place = position(mesh, shell, foot.xi);
  foot.distance = (point - foot.place).norm();
  return foot;
}

class Ties {
 public:
  explicit Ties(AbaqusModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    for (const AbaqusScope& scope : model_.scopes)
      for (const AbaqusBlock* block : scope.blocks)
        if (block->name == "TIE") model_.guarded(*block, [&] { add(scope, *block); });
  }

 private:
  // *TIE, NAME = , POSITION TOLERANCE = , NO ROTATION / slave, master
  void add(const AbaqusScope& scope, const AbaqusBlock& block) {
    for (const char* unknown : {"CYCLIC SYMMETRY", "MULTIPHYSICS", "CONSTRAINT RATIO"})
      if (block.has(unknown)) throw CardError{fmt::format("{} is not known", unknown)};
    std::optional<double> tolerance;
    if (block.has("POSITION TOLERANCE")) {
      tolerance = to_real(block.value("POSITION TOLERANCE"));
      if (!tolerance || *tolerance < 0)
        throw CardError{fmt::format("POSITION TOLERANCE = {} is no distance",
                                    block.value("POSITION TOLERANCE"))};
      *tolerance *= model_.units.length;
    }
    has_rotations_ = !block.has("NO ROTATION");
    if (block.data.empty()) throw CardError{"the two surfaces are missing"};
    for (const AbaqusLine& line : block.data) {
      const auto fields = line.fields();
      if (fields.size() < 2) throw CardError{"two surfaces are due: slave and master"};
      fasten(slaves_of(scope, fields[0]), masters_of(fields[1]), tolerance, block.line);
    }
    model_.log.leave_out("*TIE", "moving tied nodes onto the surface: short rigid arms reach it");
  }

  const AbaqusSurface* find_surface(std::string_view name) const {
    const auto found = model_.surfaces.find(upper(name));
    return found == model_.surfaces.end() ? nullptr : &found->second;
  }

  std::set<int> slaves_of(const AbaqusScope& scope, std::string_view name) const {
    std::set<int> slaves;
    const AbaqusSurface* surface = find_surface(name);
    if (surface == nullptr) {
      const std::vector<int> nodes = model_.nodes_of(scope, name);
      slaves.insert(nodes.begin(), nodes.end());
      return slaves;
    }
    for (const auto& [node, area] : surface->nodes) slaves.insert(node);
    for (const auto& [element, face] : surface->faces) {
      const AbaqusDeckElement& one = model_.elements[at(element)];
      if (one.solid >= 0) {
        for (const int corner : corners_of_face(one, face)) slaves.insert(corner);
        continue;
      }
      const std::size_t corners = one.shell >= 0 && mesh_.shells[at(one.shell)].is_triangle() ? 3
                                  : one.shell >= 0                                            ? 4
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

  std::vector<int> masters_of(std::string_view name) const {
    const AbaqusSurface* surface = find_surface(name);
    if (surface == nullptr) throw CardError{fmt::format("surface {} does not exist", name)};
    if (surface->is_of_nodes)
      throw CardError{
          fmt::format("the master {} is a surface of nodes; one of shells is due", name)};
    std::set<int> shells;
    for (const auto& [element, face] : surface->faces) {
      const AbaqusDeckElement& one = model_.elements[at(element)];
      if (one.shell < 0) throw CardError{fmt::format("element {} is no shell", one.label)};
      shells.insert(one.shell);
    }
    return {shells.begin(), shells.end()};
  }

  /// Without a tolerance of its own a node is tied within 5 % of the shell's size, beyond half the
  /// thickness of either.
  double reach_of(int s) const {
    const Shell& shell = mesh_.shells[at(s)];
    const double size =
        (mesh_.vertices[at(shell.vertices[3])] - mesh_.vertices[at(shell.vertices[0])]).norm() /
        std::sqrt(2.0);
    return 0.05 * size + (shell.section >= 0 ? mesh_.section_of(shell).thickness : 0);
  }

  void fasten(const std::set<int>& slaves, const std::vector<int>& masters,
              std::optional<double> tolerance, SourceLine line) {
    const ShellTree tree(mesh_, masters);
    std::set<int> corners;
    double farthest = tolerance.value_or(0);
    for (const int s : masters) {
      corners.insert(mesh_.shells[at(s)].vertices.begin(), mesh_.shells[at(s)].vertices.end());
      if (!tolerance) farthest = std::max(farthest, reach_of(s));
    }
    int loose = 0;
    for (const int slave : slaves) {
      if (corners.count(slave) > 0) continue;  // joined already
      Foot nearest;
      int shell = -1;
      tree.for_each_near(model_.place(slave), farthest, [&](int s) {
        const Foot foot = find_foot(mesh_, mesh_.shells[at(s)], model_.place(slave));
        if (foot.distance > tolerance.value_or(reach_of(s)) || foot.distance >= nearest.distance)
          return;
        nearest = foot;
        shell = s;
      });
      if (shell < 0)
        ++loose;
      else
        tie(slave, shell, nearest);
    }
    if (loose > 0)
      model_.log.remark(line, fmt::format("*TIE: {} of {} nodes are too far from the surface to be "
                                          "tied, and stay free",
                                          loose, slaves.size()));
  }

  void tie(int slave, int shell, const Foot& foot) {
    if (has_rotations_ && foot.distance < 1e-9) {
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
  long greatest_ = 0;
};

}  // namespace

void read_abaqus_ties(AbaqusModel& model) { Ties(model).read(); }

}  // namespace blocklift::structure
