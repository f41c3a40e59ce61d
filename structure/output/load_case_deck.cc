#include "structure/output/load_case_deck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Dense>
#include <deal.II/base/quadrature_lib.h>

#include "algebra/decompositions.h"
#include "structure/index.h"
#include "structure/mesh/files/deck/numbering.h"
#include "structure/space/joints.h"
#include "structure/system/held_points.h"

namespace blocklift::structure {

namespace {

constexpr std::array<bool, 6> all_bound{true, true, true, true, true, true};

// Of the largest force times a shell's edge.
constexpr double small_moment = 1e-2;

/// Shape functions of a deck's shell at a point of the unit square: corners around it, then the
/// middles of its edges if it is quadratic. Triangles by their areas, the square's third corner and
/// its fourth being one.
std::vector<double> deck_shell_values(bool is_triangle, bool is_quadratic,
                                      const Eigen::Vector2d& xi) {
  if (is_triangle) {
    const double c = xi.y(), b = xi.x() * (1 - c), a = 1 - b - c;
    if (!is_quadratic) return {a, b, c};
    return {a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * a * b, 4 * b * c, 4 * c * a};
  }
  const double x = 2 * xi.x() - 1, y = 2 * xi.y() - 1;
  constexpr std::array<std::array<int, 2>, 4> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  std::vector<double> values;
  for (const auto& [i, j] : corners)
    values.push_back(0.25 * (1 + i * x) * (1 + j * y) * (is_quadratic ? i * x + j * y - 1 : 1));
  if (!is_quadratic) return values;
  for (const double value :
       {(1 - x * x) * (1 - y), (1 + x) * (1 - y * y), (1 - x * x) * (1 + y), (1 - x) * (1 - y * y)})
    values.push_back(0.5 * value);
  return values;
}

/// Vertices around a shell.
std::vector<int> corners_around(const Shell& shell) {
  std::vector<int> around{shell.vertices[0], shell.vertices[1], shell.vertices[3]};
  if (!shell.is_triangle()) around.push_back(shell.vertices[2]);
  return around;
}

class DeckMaker {
 public:
  DeckMaker(const ElasticModel& model, const UnitSystem& units, DeckElements elements)
      : model_(model), space_(model.space()) {
    deck_.units = units;
    deck_.mesh = model.mesh();
    for (Material& material : mesh_.materials) material.yield_stress = 0;
    curve_shells(elements == DeckElements::quadratic);
    spell_out_surface_points();
    divide_beams();
    place_nodes();
  }

  Deck make(const std::vector<TitledLoads>& cases) {
    hold();
    for (const TitledLoads& one : cases) {
      const auto label = static_cast<long>(deck_.load_cases.size()) + 1;
      deck_.load_cases.push_back({label, one.title, {{static_cast<int>(label) - 1, 1.0}}, {0}});
      deck_.load_sets.push_back(load_set(one, label));
    }
    return std::move(deck_);
  }

 private:
  /// Nodes of the deck that share a node's load.
  struct Shares {
    std::vector<int> vertices;
    std::vector<double> values;
  };

  void curve_shells(bool are_all) {
    const Mesh& given = model_.mesh();
    mesh_.curved_shells.clear();
    for (Shell& shell : mesh_.shells) {
      if (shell.curvature < 0 && !are_all) continue;
      Eigen::Matrix3Xd points(3, 9);
      const Shell& original = given.shells[&shell - mesh_.shells.data()];
      for (int row = 0; row < 3; ++row)
        for (int i = 0; i < 3; ++i)
          points.col(3 * row + i) = position(given, original, {0.5 * i, 0.5 * row});
      shell.curvature = static_cast<int>(mesh_.curved_shells.size());
      mesh_.curved_shells.push_back(std::move(points));
    }
    MiddleVertices middles(mesh_);
    for (const Shell& shell : mesh_.shells)
      middles_.push_back(shell.curvature >= 0 ? middles.of(shell) : std::vector<int>{});
    if (are_all) note_middles();
  }

  void note_middles() {
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      const std::vector<int> around = corners_around(mesh_.shells[s]);
      for (std::size_t i = 0; i < around.size(); ++i)
        middle_of_[std::minmax({around[i], around[(i + 1) % around.size()]})] = middles_[s][i];
    }
  }

  /// What lies on a shell, middles of its edges apart, moves as a sum of its nodes' motions: a deck
  /// says so by equations. Rigid arms that stand there, and equations in which it counts, are part
  /// of them.
  void spell_out_surface_points() {
    std::set<int> turning;  // vertices whose rotation means something
    for (const Shell& shell : mesh_.shells)
      turning.insert(shell.vertices.begin(), shell.vertices.end());
    for (const Beam& beam : mesh_.beams) turning.insert(beam.vertices.begin(), beam.vertices.end());
    std::vector<SurfacePoint> middles;
    for (const SurfacePoint& point : mesh_.surface_points) {
      const std::vector<int>& known = middles_[point.shell];
      if (std::find(known.begin(), known.end(), point.vertex) != known.end()) {
        middles.push_back(point);
        continue;
      }
      const Shares shares = shares_of(point);
      if (!point.line.empty()) insert_shares(point.vertex, shares);
      std::erase_if(mesh_.rigid_links, [&](const RigidLink& link) {
        if (link.master != point.vertex) return false;
        for (const int slave : link.slaves)
          add_equations(slave, shares, link.axes, link.bound, turning.count(slave) > 0);
        return true;
      });
      add_equations(point.vertex, shares, Eigen::Matrix3d::Identity(), all_bound,
                    turning.count(point.vertex) > 0);
    }
    mesh_.surface_points = std::move(middles);
  }

  Shares shares_of(const SurfacePoint& point) const {
    std::map<int, double> sum;
    const auto add = [&](int number, const Eigen::Vector2d& xi, double weight) {
      const Shell& shell = mesh_.shells[number];
      const std::vector<int>& known = middles_[number];
      std::vector<int> nodes = corners_around(shell);
      nodes.insert(nodes.end(), known.begin(), known.end());
      const std::vector<double> values = deck_shell_values(shell.is_triangle(), !known.empty(), xi);
      for (std::size_t i = 0; i < nodes.size(); ++i) sum[nodes[i]] += weight * values[i];
    };
    if (point.line.empty()) add(point.shell, point.xi, 1);
    // Exact for the density, of second degree, times a shell's shapes along an oblique line.
    const dealii::QGauss<1> rule(5);
    for (const SurfaceStretch& stretch : point.line)
      for (unsigned q = 0; q < rule.size(); ++q) {
        const double t = rule.point(q)[0];
        add(stretch.shell, (1 - t) * stretch.ends[0] + t * stretch.ends[1],
            rule.weight(q) * stretch.density.dot(Vector3(1, t, t * t)));
      }
    Shares shares;
    for (const auto& [vertex, share] : sum) {
      if (std::abs(share) < 1e-15) continue;  // what rounding leaves of none
      shares.vertices.push_back(vertex);
      shares.values.push_back(share);
    }
    return shares;
  }

  /// Puts a vertex's motion as a sum into the equations in which it counts.
  void insert_shares(int vertex, const Shares& shares) {
    for (MotionEquation& equation : mesh_.equations) {
      const auto found =
          std::find_if(equation.terms.begin(), equation.terms.end(),
                       [&](const MotionEquation::Term& term) { return term.vertex == vertex; });
      if (found == equation.terms.end()) continue;
      const MotionEquation::Term replaced = *found;
      equation.terms.erase(found);
      const Vector3 arm = mesh_.vertices[vertex] - mean_place(shares);
      for (std::size_t i = 0; i < shares.vertices.size(); ++i) {
        const double value = shares.values[i];
        equation.terms.push_back(
            {shares.vertices[i], value * replaced.of_displacement,
             value * (replaced.of_rotation + arm.cross(replaced.of_displacement))});
      }
    }
  }

  Vector3 mean_place(const Shares& shares) const {
    Vector3 place = Vector3::Zero();
    for (std::size_t i = 0; i < shares.vertices.size(); ++i)
      place += shares.values[i] * mesh_.vertices[shares.vertices[i]];
    return place;
  }

  /// u = sum N_i (u_i + theta_i x arm), and theta = sum N_i theta_i if it turns along, as far as
  /// these are bound along axes.
  void add_equations(int vertex, const Shares& shares, const Eigen::Matrix3d& axes,
                     const std::array<bool, 6>& bound, bool turns) {
    // What is a node of the shell itself needs no equation.
    if (std::count(shares.vertices.begin(), shares.vertices.end(), vertex) > 0) return;
    const Vector3 arm = mesh_.vertices[vertex] - mean_place(shares);
    for (int component = 0; component < (turns ? 6 : 3); ++component) {
      if (!bound[component]) continue;
      const Vector3 axis = axes.col(component % 3);
      const bool is_rotation = component >= 3;
      MotionEquation equation;
      equation.label = static_cast<long>(mesh_.equations.size()) + 1;
      equation.terms.push_back({vertex, is_rotation ? Vector3(Vector3::Zero()) : axis,
                                is_rotation ? axis : Vector3(Vector3::Zero())});
      for (std::size_t i = 0; i < shares.vertices.size(); ++i) {
        const double value = shares.values[i];
        equation.terms.push_back(
            {shares.vertices[i], is_rotation ? Vector3(Vector3::Zero()) : Vector3(-value * axis),
             is_rotation ? Vector3(-value * axis) : Vector3(-value * arm.cross(axis))});
      }
      mesh_.equations.push_back(std::move(equation));
    }
  }

  /// Middle of a beam between two vertices where it lies on a quadratic shell's edge; -1: nowhere.
  int middle_of(const Beam& beam) const {
    const auto found = middle_of_.find(std::minmax({beam.vertices[0], beam.vertices[1]}));
    return found == middle_of_.end() ? -1 : found->second;
  }

  void divide_beams() {
    if (middle_of_.empty()) return;
    std::vector<Beam> beams;
    for (const Beam& beam : mesh_.beams) {
      const int middle = middle_of(beam);
      beams.push_back(beam);
      if (middle < 0) continue;
      beams.push_back(beam);
      Beam &first = beams[beams.size() - 2], &second = beams.back();
      first.vertices[1] = second.vertices[0] = middle;
      first.offset[1] = second.offset[0] = 0.5 * (beam.offset[0] + beam.offset[1]);
      first.release[1] = second.release[0] = {};
    }
    mesh_.beams = std::move(beams);
  }

  void place_nodes() {
    shares_.resize(space_.node_count());
    const auto vertices = static_cast<int>(model_.mesh().vertices.size());
    for (int vertex = 0; vertex < vertices; ++vertex)
      if (const int node = space_.node_of_vertex(vertex); node >= 0)
        shares_[node] = {{vertex}, {1.0}};
    place_shell_nodes();
    place_beam_nodes();
  }

  void place_shell_nodes() {
    const int p = space_.degree();
    const std::vector<double> places = lagrange_places(p);
    for (std::size_t cell = 0; cell < space_.shells().size(); ++cell) {
      const ShellCell& located = space_.shells()[cell];
      const Shell& shell = mesh_.shells[located.shell];
      const std::vector<int>& middles = middles_[located.shell];
      std::vector<int> around = corners_around(shell);
      around.insert(around.end(), middles.begin(), middles.end());
      const int* nodes = space_.shell_nodes(static_cast<int>(cell));
      for (int i = 0; i < space_.nodes_per_shell(); ++i) {
        Shares& shares = shares_[nodes[i]];
        if (!shares.vertices.empty()) continue;
        const Eigen::Vector2d own(places[i % (p + 1)], places[i / (p + 1)]);
        shares = {around, deck_shell_values(shell.is_triangle(), !middles.empty(),
                                            located.origin + located.size * own)};
      }
    }
  }

  void place_beam_nodes() {
    for (const BeamCell& cell : space_.beams()) {
      const Beam& beam = model_.mesh().beams[cell.beam];
      const int middle = middle_of(beam);
      const std::vector<double> places = lagrange_places(cell.degree);
      for (std::size_t i = 0; i < cell.nodes.size(); ++i) {
        Shares& shares = shares_[cell.nodes[i]];
        if (!shares.vertices.empty()) continue;
        const double along = cell.origin + cell.size * places[i];
        if (middle < 0) {
          shares = {{beam.vertices[0], beam.vertices[1]}, {1 - along, along}};
        } else if (along < 0.5) {
          shares = {{beam.vertices[0], middle}, {1 - 2 * along, 2 * along}};
        } else {
          shares = {{middle, beam.vertices[1]}, {2 - 2 * along, 2 * along - 1}};
        }
      }
    }
  }

  LoadSet load_set(const TitledLoads& one, long label) const {
    Eigen::Matrix3Xd forces(3, static_cast<Eigen::Index>(mesh_.vertices.size()));
    forces.setZero();
    Eigen::Matrix3Xd moments = forces;
    for (int node = 0; node < space_.node_count(); ++node) {
      const Vector3 force = one.loads.segment<3>(6 * static_cast<Eigen::Index>(node));
      Vector3 moment = one.loads.segment<3>(6 * static_cast<Eigen::Index>(node) + 3);
      const Shares& shares = shares_[node];
      Vector3 place = Vector3::Zero();
      for (std::size_t i = 0; i < shares.vertices.size(); ++i) {
        forces.col(shares.vertices[i]) += shares.values[i] * force;
        place += shares.values[i] * mesh_.vertices[shares.vertices[i]];
      }
      if (shares.vertices.empty()) continue;
      moment += (space_.nodes().col(node) - place).cross(force);
      for (std::size_t i = 0; i < shares.vertices.size(); ++i)
        moments.col(shares.vertices[i]) += shares.values[i] * moment;
    }
    turn_small_moments(forces, moments);
    LoadSet set;
    set.label = label;
    set.name = one.title;
    for (Eigen::Index v = 0; v < forces.cols(); ++v)
      if (!forces.col(v).isZero(0) || !moments.col(v).isZero(0))
        set.point_loads.push_back({static_cast<int>(v), forces.col(v), moments.col(v)});
    return set;
  }

  void turn_small_moments(Eigen::Matrix3Xd& forces, Eigen::Matrix3Xd& moments) const {
    const double largest = forces.colwise().norm().maxCoeff();
    std::vector<char> is_done(mesh_.vertices.size(), 0);
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      const Shell& shell = mesh_.shells[s];
      const std::vector<int> corners = corners_around(shell);
      std::vector<int> all = corners;
      all.insert(all.end(), middles_[s].begin(), middles_[s].end());
      Vector3 sum = Vector3::Zero();
      const double least = small_moment * largest * longest_edge(mesh_, shell);
      for (const int vertex : all) {
        if (is_done[vertex] != 0 || moments.col(vertex).norm() > least) continue;
        is_done[vertex] = 1;
        sum += moments.col(vertex);
        moments.col(vertex).setZero();
      }
      if (!sum.isZero(0)) add_as_forces(sum, corners, forces);
    }
  }

  /// Forces c x (x_i - centre) whose moment is the given one.
  void add_as_forces(const Vector3& moment, const std::vector<int>& corners,
                     Eigen::Matrix3Xd& forces) const {
    Vector3 centre = Vector3::Zero();
    for (const int corner : corners) centre += mesh_.vertices[corner];
    centre /= static_cast<double>(corners.size());
    Eigen::Matrix3d arms = Eigen::Matrix3d::Zero();
    for (const int corner : corners) {
      const Vector3 arm = mesh_.vertices[corner] - centre;
      arms += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
    }
    const Vector3 factor = algebra::solve_symmetric(arms, moment);
    for (const int corner : corners)
      forces.col(corner) += factor.cross(mesh_.vertices[corner] - centre);
  }

  void hold() {
    std::vector<char> is_free(at(space_.node_count()), 0);
    for (const int node : free_nodes(space_)) is_free[node] = 1;
    // A deck has one system of axes at a vertex: springs' and links' may be turned.
    std::vector<char> is_corner(mesh_.vertices.size(), 0);
    for (const Shell& shell : mesh_.shells)
      for (const int vertex : shell.vertices) is_corner[vertex] = 1;
    for (const Solid& solid : mesh_.solids)
      for (const int vertex : solid.vertices) is_corner[vertex] = 1;
    if (mesh_.shells.empty() && mesh_.solids.empty())
      for (const Beam& beam : mesh_.beams)
        for (const int vertex : beam.vertices) is_corner[vertex] = 1;
    for (const Spring& spring : mesh_.springs)
      for (const int vertex : spring.vertices)
        if (vertex >= 0) is_corner[vertex] = 0;
    std::vector<int> candidates;
    for (std::size_t vertex = 0; vertex < model_.mesh().vertices.size(); ++vertex) {
      const int node = space_.node_of_vertex(static_cast<int>(vertex));
      if (node >= 0 && is_free[node] != 0 && is_corner[vertex] != 0)
        candidates.push_back(static_cast<int>(vertex));
    }
    Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(candidates.size()));
    for (std::size_t i = 0; i < candidates.size(); ++i)
      places.col(i) = mesh_.vertices[candidates[i]];
    SupportSet set;
    set.label = 1;
    set.name = "3-2-1";
    std::map<int, std::size_t> known;
    for (const HeldComponent& held : hold_points(places)) {
      const auto [found, is_new] = known.try_emplace(held.point, set.supports.size());
      if (is_new) set.supports.emplace_back().vertex = candidates[held.point];
      set.supports[found->second].held[held.axis] = true;
    }
    deck_.support_sets = {std::move(set)};
  }

  const ElasticModel& model_;
  const Space& space_;
  Deck deck_;
  Mesh& mesh_ = deck_.mesh;
  std::vector<std::vector<int>> middles_;         ///< of shells, in the order around them
  std::map<std::pair<int, int>, int> middle_of_;  ///< by the ends of edges; empty: not needed
  std::vector<Shares> shares_;                    ///< of the model's nodes
};

}  // namespace

Deck load_case_deck(const ElasticModel& model, const std::vector<TitledLoads>& cases,
                    const UnitSystem& units, DeckElements elements) {
  return DeckMaker(model, units, elements).make(cases);
}

Eigen::Matrix3Xd displacement_against(const std::vector<Support>& supports,
                                      const ElasticModel& model, const Eigen::VectorXd& motion) {
  const Space& space = model.space();
  const std::vector<Vector3>& vertices = model.mesh().vertices;
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const int node = space.node_of_vertex(static_cast<int>(v));
    const auto column = static_cast<Eigen::Index>(v);
    if (node < 0)
      result.col(column).setConstant(std::numeric_limits<double>::quiet_NaN());
    else
      result.col(column) = motion.segment<3>(6 * static_cast<Eigen::Index>(node));
  }
  // The rigid motion, translation and rotation, that the six held components have.
  const Vector3 centre = vertices[supports.front().vertex];
  Eigen::Matrix<double, 6, 6> rows;
  Eigen::Matrix<double, 6, 1> held;
  Eigen::Index count = 0;
  for (const Support& support : supports)
    for (int axis = 0; axis < 3; ++axis) {
      if (!support.held[axis]) continue;
      const Vector3 arm = vertices[support.vertex] - centre;
      rows.row(count) << Vector3::Unit(axis).transpose(),
          arm.cross(Vector3::Unit(axis)).transpose();
      held[count++] = result(axis, support.vertex);
    }
  const Eigen::Matrix<double, 6, 1> rigid = algebra::solve_by_full_pivoting(rows, held);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    result.col(v) -= rigid.head<3>() + rigid.tail<3>().cross(vertices[v] - centre);
  return result;
}

Wrench resultant_of_points(const Mesh& mesh, const LoadSet& loads) {
  Wrench sum;
  for (const PointLoad& load : loads.point_loads) {
    sum.force += load.force;
    sum.moment += mesh.vertices[load.vertex].cross(load.force) + load.moment;
  }
  return sum;
}

}  // namespace blocklift::structure
