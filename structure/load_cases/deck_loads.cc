#include "structure/load_cases/deck_loads.h"

#include <vector>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/formulation/beam.h"
#include "structure/formulation/shell.h"
#include "structure/space/joints.h"

namespace blocklift::structure {

namespace {

Eigen::Index row_of(int node) { return 6 * static_cast<Eigen::Index>(node); }

/// Adds loads to a load vector of a space.
class LoadAdder {
 public:
  LoadAdder(const Space& space, Eigen::VectorXd& load) : space_(space), load_(load) {}

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

  /// A load per length of the line between a beam's vertices.
  void add(const BeamLoad& along, double factor) {
    // Exact for the beams' degrees: a square's rule seen along one side, whose weights sum to one.
    const Eigen::Matrix3Xd rule = square_rule(space_.degree() + 2);
    const auto& vertices = space_.mesh().vertices;
    for (const BeamCell& cell : space_.beams()) {
      if (cell.beam != along.beam) continue;
      const Beam& beam = space_.mesh().beams[cell.beam];
      const double length =
          cell.size * (vertices[beam.vertices[1]] - vertices[beam.vertices[0]]).norm();
      for (Eigen::Index q = 0; q < rule.cols(); ++q) {
        const std::vector<double> values = lagrange_values(cell.degree, rule(0, q));
        for (std::size_t i = 0; i < values.size(); ++i)
          load_.segment<3>(row_of(cell.nodes[i])) +=
              factor * rule(2, q) * length * values[i] * along.force_per_length;
      }
    }
  }

 private:
  void add_pressure(const PlateLoad& plate, int cell, const Vector3& point_of_rule,
                    const ShellPoint& point, double factor) {
    const ShellCell& located = space_.shells()[cell];
    const Eigen::Vector2d xi = located.origin + located.size * point_of_rule.head<2>();
    const double pressure = (1 - xi.x()) * (1 - xi.y()) * plate.pressure[0] +
                            xi.x() * (1 - xi.y()) * plate.pressure[1] +
                            (1 - xi.x()) * xi.y() * plate.pressure[2] +
                            xi.x() * xi.y() * plate.pressure[3];
    const Vector3 direction = plate.direction.isZero(0) ? point.normal : plate.direction;
    const Vector3 force = factor * pressure * point_of_rule.z() * point.area * direction;
    const Eigen::VectorXd values = space_.shell_values(point_of_rule.head<2>());
    for (Eigen::Index i = 0; i < values.size(); ++i)
      load_.segment<3>(row_of(space_.shell_nodes(cell)[i])) += values[i] * force;
  }

  const Space& space_;
  Eigen::VectorXd& load_;
};

}  // namespace

Eigen::VectorXd load_of(const ElasticModel& model, const Deck& deck,
                        const DeckLoadCase& load_case) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model.freedoms());
  LoadAdder adder(model.space(), load);
  for (const auto& [place, factor] : load_case.loads) {
    const LoadSet& set = deck.load_sets[place];
    for (const PointLoad& point : set.point_loads) adder.add(point, factor);
    adder.add_plates(set, factor);
    for (const BeamLoad& along : set.beam_loads) adder.add(along, factor);
    if (!set.gravity.isZero(0))
      load -= factor * (model.inertia_loads().leftCols<3>() * set.gravity);
  }
  return load;
}

}  // namespace blocklift::structure
