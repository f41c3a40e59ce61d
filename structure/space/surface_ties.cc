#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/affine_constraints.h>

#include "structure/mesh/fields/fields.h"
#include "structure/space/edge_nodes.h"
#include "structure/space/space.h"

namespace blocklift::structure {

namespace {

constexpr double beside = 1e-9;  // of a cell's size

/// Adds the motion of places on shells, weighted, to a sum over the space's nodes.
class SurfaceSum {
 public:
  SurfaceSum(const Space& space, const std::vector<std::vector<int>>& cells)
      : space_(space), cells_(cells) {}

  void add_place(int shell, const Eigen::Vector2d& xi, double weight) {
    for (const int cell : cells_[shell]) {
      const ShellCell& located = space_.shells()[cell];
      const Eigen::Vector2d own = (xi - located.origin) / located.size;
      if (own.minCoeff() < -beside || own.maxCoeff() > 1 + beside) continue;
      const Eigen::VectorXd values = space_.shell_values(own);
      for (Eigen::Index i = 0; i < values.size(); ++i)
        if (std::abs(values[i]) > 1e-12) shares_[space_.shell_nodes(cell)[i]] += weight * values[i];
      return;
    }
  }

  /// The integral along a stretch, exact for the cells' polynomials.
  void add_stretch(const SurfaceStretch& stretch) {
    const Eigen::Vector2d way = stretch.ends[1] - stretch.ends[0];
    const dealii::QGauss<1> rule(static_cast<unsigned>(space_.degree()) + 2);
    const std::vector<double> cuts = cuts_of(stretch);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      for (unsigned q = 0; q < rule.size(); ++q) {
        const double size = cuts[i + 1] - cuts[i], t = cuts[i] + size * rule.point(q)[0];
        add_place(stretch.shell, stretch.ends[0] + t * way,
                  rule.weight(q) * size * stretch.density.dot(Vector3(1, t, t * t)));
      }
  }

  const std::map<int, double>& shares() const { return shares_; }

 private:
  /// Where a stretch passes from cell to cell, its ends first and last.
  std::vector<double> cuts_of(const SurfaceStretch& stretch) const {
    std::vector<double> cuts{0, 1};
    const Eigen::Vector2d way = stretch.ends[1] - stretch.ends[0];
    for (const int cell : cells_[stretch.shell]) {
      const ShellCell& located = space_.shells()[cell];
      for (int axis = 0; axis < 2; ++axis)
        for (const double side : {0.0, located.size}) {
          const double t = (located.origin[axis] + side - stretch.ends[0][axis]) / way[axis];
          if (std::abs(way[axis]) > beside && t > beside && t < 1 - beside) cuts.push_back(t);
        }
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(
        std::unique(cuts.begin(), cuts.end(), [](double a, double b) { return b - a < beside; }),
        cuts.end());
    cuts.back() = 1;
    return cuts;
  }

  const Space& space_;
  const std::vector<std::vector<int>>& cells_;
  std::map<int, double> shares_;
};

}  // namespace

// Nodes of vertices that lie on a shell between its corners follow the shape of its cell there, or
// the mean of the cells' along a line. So do nodes within an edge between two such vertices:
// between its vertices a seam would gape.
void Space::add_surface_ties(dealii::AffineConstraints<double>& ties) const {
  if (mesh_->surface_points.empty()) return;
  std::vector<std::vector<int>> cells(mesh_->shells.size());
  for (std::size_t cell = 0; cell < shells_.size(); ++cell)
    cells[shells_[cell].shell].push_back(static_cast<int>(cell));
  const auto tie = [&](int number, const auto& add_to) {
    const auto node = static_cast<dealii::types::global_dof_index>(number);
    if (ties.is_constrained(node)) return;
    SurfaceSum sum(*this, cells);
    add_to(sum);
    ties.add_line(node);
    for (const auto& [master, share] : sum.shares())
      ties.add_entry(node, static_cast<dealii::types::global_dof_index>(master), share);
  };
  std::map<int, ShellPlace> places;
  for (const SurfacePoint& point : mesh_->surface_points) {
    if (point.line.empty()) places[point.vertex] = {point.shell, point.xi};
    tie(node_of_vertex(point.vertex), [&](SurfaceSum& sum) {
      if (point.line.empty()) sum.add_place(point.shell, point.xi, 1);
      for (const SurfaceStretch& stretch : point.line) sum.add_stretch(stretch);
    });
  }
  if (places.empty()) return;
  const PlateFields fields = find_fields(*mesh_);
  const FieldWalker walker(*mesh_, fields);
  for_each_node_within_edges(*this, [&](int node, int from, int to, double) {
    const auto at_from = places.find(from), at_to = places.find(to);
    if (at_from == places.end() || at_to == places.end()) return;
    auto place = walker.find(nodes_.col(node), at_from->second);
    if (!place) place = walker.find(nodes_.col(node), at_to->second);
    if (place) tie(node, [&](SurfaceSum& sum) { sum.add_place(place->shell, place->xi, 1); });
  });
}

}  // namespace blocklift::structure
