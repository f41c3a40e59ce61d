#include "structure/load_cases/deck_loads.h"

#include <algorithm>
#include <array>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/formulation/beam.h"
#include "structure/formulation/shell.h"
#include "structure/formulation/solid.h"
#include "structure/mesh/beams/beam_axes.h"
#include "structure/mesh/files/deck/coordinate_systems.h"
#include "structure/mesh/files/deck/line_loads.h"
#include "structure/mesh/solid_shape.h"
#include "structure/response/cell_finder.h"
#include "structure/space/joints.h"
#include "structure/system/matter.h"

namespace blocklift::structure {

namespace {

Eigen::Index row_of(int node) { return 6 * static_cast<Eigen::Index>(node); }

/// Direction of a pressure at a place where it is not along the normal.
template <typename Pressure>
Vector3 direction_at(const Pressure& load, const Vector3& place) {
  return load.system ? Vector3(load.system->axes_at(place) * load.direction) : load.direction;
}

/// Shares of a face's corners at a point of the unit square, and their slopes (columns) along it.
struct FacePoint {
  Eigen::Vector4d shares = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, 2> slopes = Eigen::Matrix<double, 4, 2>::Zero();
};

/// @param corners 4, or 3: the square's side xi = 0 is drawn together into the first of them.
FacePoint face_point(std::size_t corners, const Eigen::Vector2d& xi) {
  const double x = xi.x(), y = xi.y();
  FacePoint point;
  if (corners == 3) {
    point.shares << 1 - x, x * (1 - y), x * y, 0;
    point.slopes << -1, 0, 1 - y, -x, y, x, 0, 0;
  } else {
    point.shares << (1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y;
    point.slopes << y - 1, x - 1, 1 - y, -x, y, x, -y, 1 - x;
  }
  return point;
}

/// Adds loads to a load vector of a space.
class LoadAdder {
 public:
  LoadAdder(const Space& space, Eigen::VectorXd& load)
      : space_(space),
        cells_of_shells_(space),
        cells_of_beams_(space.mesh().beams.size()),
        load_(load) {
    for (std::size_t cell = 0; cell < space.beams().size(); ++cell)
      cells_of_beams_[space.beams()[cell].beam].push_back(cell);
  }

  void add(const PointLoad& point, double factor) {
    const int node = space_.node_of_vertex(point.vertex);
    if (node < 0) {
      const auto& labels = space_.mesh().vertex_labels;
      throw ModelError(fmt::format("a force acts at node {}, which nothing is joined to",
                                   labels.empty() ? point.vertex + 1L : labels[point.vertex]));
    }
    load_.segment<3>(row_of(node)) += factor * point.force;
    load_.segment<3>(row_of(node) + 3) += factor * point.moment;
  }

  void add_plates(const LoadSet& set, double factor) {
    if (set.plate_loads.empty()) return;
    std::vector<std::vector<int>> of_shell(space_.mesh().shells.size());
    for (std::size_t i = 0; i < set.plate_loads.size(); ++i)
      of_shell[set.plate_loads[i].shell].push_back(static_cast<int>(i));
    const Eigen::Matrix3Xd rule = square_rule(space_.degree() + 1);
    ShellOperator shells(space_, rule.topRows<2>());
    for (int cell = 0; cell < static_cast<int>(space_.shells().size()); ++cell) {
      const auto& loads = of_shell[space_.shells()[cell].shell];
      if (loads.empty()) continue;
      shells.reinit(cell);
      for (Eigen::Index q = 0; q < rule.cols(); ++q)
        for (const int i : loads)
          add_pressure(set.plate_loads[i], cell, rule.col(q), shells.points()[q], factor);
    }
  }

  void add(const SolidLoad& on_face, double factor) {
    const Mesh& mesh = space_.mesh();
    const Solid& solid = mesh.solids[on_face.solid];
    const SolidTopology& topology = topology_of(solid.shape);
    const std::vector<int>& face = topology.faces[on_face.face];
    const Eigen::Matrix3Xd places = places_of(mesh, solid);
    // Shape functions of second degree, a pressure and an area of that degree along either side.
    const Eigen::Matrix3Xd rule = square_rule(4);
    for (Eigen::Index q = 0; q < rule.cols(); ++q) {
      const FacePoint point = face_point(face.size(), rule.col(q).head<2>());
      Vector3 local = Vector3::Zero();
      Eigen::Matrix<double, 3, 2> along = Eigen::Matrix<double, 3, 2>::Zero();
      double pressure = 0;
      for (std::size_t i = 0; i < face.size(); ++i) {
        const auto corner = static_cast<Eigen::Index>(i);
        const Vector3 place = topology.kind.local.col(face[i]);
        local += point.shares[corner] * place;
        along += place * point.slopes.row(corner);
        pressure += point.shares[corner] * on_face.pressure[i];
      }
      const Eigen::Matrix<double, 3, 2> tangents =
          places * (shape_of(solid.shape).gradients(local) * along);
      const Eigen::VectorXd values = shape_of(solid.shape).values(local);
      const Vector3 outward = tangents.col(0).cross(tangents.col(1));
      const Vector3 area = on_face.direction.isZero(0)
                               ? Vector3(-outward)
                               : Vector3(outward.norm() * direction_at(on_face, places * values));
      for (Eigen::Index i = 0; i < values.size(); ++i)
        load_.segment<3>(row_of(space_.solid_nodes(on_face.solid)[i])) +=
            factor * rule(2, q) * pressure * values[i] * area;
    }
  }

  void add(const BeamLoad& along, double factor) {
    if (along.is_at_a_place()) {
      add_at_a_place(along, factor);
      return;
    }
    // Exact for the beams' degrees, a force and an arm that are linear in place: a square's rule
    // seen along one side, whose weights sum to one.
    const Eigen::Matrix3Xd rule = square_rule(space_.degree() + 2);
    const double length =
        line_beside(space_.mesh(), space_.mesh().beams[along.beam], along.arm).norm();
    for (const std::size_t place : cells_of_beams_[along.beam]) {
      const BeamCell& cell = space_.beams()[place];
      const double from = std::max(cell.origin, along.span[0]),
                   to = std::min(cell.origin + cell.size, along.span[1]);
      if (!(to > from)) continue;
      for (Eigen::Index q = 0; q < rule.cols(); ++q)
        add_in_cell(cell, along, from + (to - from) * rule(0, q),
                    factor * rule(2, q) * (to - from) * length);
    }
  }

  void add(const EdgeLoad& along, double factor) {
    const Shell& shell = space_.mesh().shells[along.shell];
    // Sides of the unit square in turn; of a triangle the third one is a point.
    const int side = shell.is_triangle() && along.edge == 2 ? 3 : along.edge;
    const Eigen::Matrix3Xd rule = square_rule(space_.degree() + 2);
    for (const int cell : cells_of_shells_.cells_of(along.shell)) {
      if (!is_on_side(space_.shells()[cell], side)) continue;
      for (Eigen::Index q = 0; q < rule.cols(); ++q)
        add_on_side(along, cell, side, rule(0, q), factor * rule(2, q));
    }
  }

  void add(const VolumeLoad& in_solid, double factor) {
    const Mesh& mesh = space_.mesh();
    for (const SolidPoint& point : solid_points(mesh, mesh.solids[in_solid.solid]))
      for (Eigen::Index i = 0; i < point.values.size(); ++i)
        load_.segment<3>(row_of(space_.solid_nodes(in_solid.solid)[i])) +=
            factor * point.weight * point.values[i] * in_solid.force;
  }

 private:
  static bool is_on_side(const ShellCell& cell, int side) {
    constexpr double rounding = 1e-9;
    const Eigen::Vector2d last = cell.origin + Eigen::Vector2d::Constant(cell.size);
    const std::array<double, 4> gap{cell.origin.y(), 1 - last.x(), 1 - last.y(), cell.origin.x()};
    return gap[side] < rounding;
  }

  /// A point of a side of the unit square, a distance away from the side, as corners turn.
  static Eigen::Vector2d beside(int side, double t, double away) {
    if (side == 0) return {t, away};
    if (side == 1) return {1 - away, t};
    if (side == 2) return {1 - t, 1 - away};
    return {away, 1 - t};
  }

  /// An edge load at a point of a cell's side. Cells are quadratic at most: their slopes are those
  /// of parabolas through three points.
  void add_on_side(const EdgeLoad& along, int cell, int side, double t, double weight) {
    const auto place = [&](double at, double away) -> Vector3 {
      return space_.place(cell, beside(side, at, away));
    };
    const double h = std::min(t, 1 - t);
    constexpr double in = 0.5;
    const Vector3 edge = (place(t + h, 0) - place(t - h, 0)) / (2 * h);
    const Vector3 away = 4 * place(t, in) - 3 * place(t, 0) - place(t, 2 * in);
    const Vector3 tangent = edge.normalized(), normal = edge.cross(away).normalized();
    const Vector3 force = along.force + along.own[0] * tangent +
                          along.own[1] * normal.cross(tangent) + along.own[2] * normal;
    const Eigen::VectorXd values = space_.shell_values(beside(side, t, 0));
    for (Eigen::Index i = 0; i < values.size(); ++i)
      load_.segment<3>(row_of(space_.shell_nodes(cell)[i])) +=
          weight * edge.norm() * values[i] * force;
  }

  /// Cells that meet at the place have a node there: either takes all of it.
  void add_at_a_place(const BeamLoad& load, double factor) {
    constexpr double rounding = 1e-9;
    for (const std::size_t place : cells_of_beams_[load.beam]) {
      const BeamCell& cell = space_.beams()[place];
      if (load.span[0] < cell.origin - rounding ||
          load.span[0] > cell.origin + cell.size + rounding)
        continue;
      add_in_cell(cell, load, load.span[0], factor);
      return;
    }
  }

  /// What a beam's load is at a share of its length, times a weight: a point at an arm a from the
  /// nodes' line moves by u + theta x a.
  void add_in_cell(const BeamCell& cell, const BeamLoad& along, double share, double weight) {
    const double t =
        along.is_at_a_place() ? 0 : (share - along.span[0]) / (along.span[1] - along.span[0]);
    const LoadAtPlace here = load_at(along, along.arm, t);
    const std::vector<double> values =
        lagrange_values(cell.degree, (share - cell.origin) / cell.size);
    for (std::size_t i = 0; i < values.size(); ++i) {
      load_.segment<3>(row_of(cell.nodes[i])) += weight * values[i] * here.force;
      load_.segment<3>(row_of(cell.nodes[i]) + 3) += weight * values[i] * here.moment;
    }
  }

  void add_pressure(const PlateLoad& plate, int cell, const Vector3& point_of_rule,
                    const ShellPoint& point, double factor) {
    const ShellCell& located = space_.shells()[cell];
    const Eigen::Vector2d xi = located.origin + located.size * point_of_rule.head<2>();
    const double pressure = (1 - xi.x()) * (1 - xi.y()) * plate.pressure[0] +
                            xi.x() * (1 - xi.y()) * plate.pressure[1] +
                            (1 - xi.x()) * xi.y() * plate.pressure[2] +
                            xi.x() * xi.y() * plate.pressure[3];
    const Vector3 direction =
        plate.direction.isZero(0)
            ? point.normal
            : direction_at(plate, space_.place(cell, point_of_rule.head<2>()));
    const Vector3 force = factor * pressure * point_of_rule.z() * point.area * direction;
    const Eigen::VectorXd values = space_.shell_values(point_of_rule.head<2>());
    for (Eigen::Index i = 0; i < values.size(); ++i)
      load_.segment<3>(row_of(space_.shell_nodes(cell)[i])) += values[i] * force;
  }

  const Space& space_;
  // A deck has a load for each piece of a bar or edge: none of them looks at all cells.
  CellFinder cells_of_shells_;
  std::vector<std::vector<std::size_t>> cells_of_beams_;
  Eigen::VectorXd& load_;
};

/// What a spin is of the twelve inertia fields (InertiaField), which turn about the origin: with
/// the axis elsewhere there is the acceleration of its place besides.
Eigen::Matrix<double, 12, 1> field_of(const Spin& spin) {
  const Vector3& w = spin.velocity;
  const Vector3 of_place = w.cross(w.cross(spin.place)) - spin.acceleration.cross(spin.place);
  Eigen::Matrix<double, 12, 1> field;
  field << -of_place, -spin.acceleration, w.cwiseAbs2(), w.x() * w.y(), w.y() * w.z(),
      w.z() * w.x();
  return field;
}

Eigen::MatrixXd loads_of_part(const ElasticModel& model, const MeshPart& part) {
  return inertia_loads(model.space(), model.mass_properties(), part);
}

}  // namespace

Eigen::VectorXd load_of(const ElasticModel& model, const Deck& deck,
                        const DeckLoadCase& load_case) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model.freedoms());
  LoadAdder adder(model.space(), load);
  for (const auto& [place, factor] : load_case.loads) {
    const LoadSet& set = deck.load_sets[place];
    for (const PointLoad& point : set.point_loads) adder.add(point, factor);
    adder.add_plates(set, factor);
    for (const SolidLoad& on_face : set.solid_loads) adder.add(on_face, factor);
    for (const BeamLoad& along : set.beam_loads) adder.add(along, factor);
    for (const EdgeLoad& along : set.edge_loads) adder.add(along, factor);
    for (const VolumeLoad& in_solid : set.volume_loads) adder.add(in_solid, factor);
    if (!set.gravity.isZero(0))
      load -= factor * (model.inertia_loads().leftCols<3>() * set.gravity);
    for (const PartPull& pull : set.pulls)
      load -= factor * (loads_of_part(model, *pull.part).leftCols<3>() * pull.acceleration);
    for (const Spin& spin : set.spins)
      load += factor * ((spin.part ? loads_of_part(model, *spin.part) : model.inertia_loads()) *
                        field_of(spin));
  }
  return load;
}

}  // namespace blocklift::structure
