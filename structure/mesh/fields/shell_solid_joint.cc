#include "structure/mesh/fields/shell_solid_joint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

constexpr double inside = 1e-7;      // of a stretch: its ends may lie on a joint of two shells
constexpr double no_length = 1e-6;   // of the line: where one shell ends and the next begins
constexpr double same_place = 1e-6;  // on the unit square

/// Monomials' coefficients (columns, of 1, x, x^2) of the quadratic shape functions of [0, 1] at 0,
/// 1/2 and 1 (rows).
Eigen::Matrix3d shape_coefficients() {
  Eigen::Matrix3d shapes;
  shapes << 1, -3, 2, 0, 4, -4, 0, -1, 2;
  return shapes;
}

/// Integrals of the shape functions over [0, 1].
const Vector3 shape_integrals(1.0 / 6, 4.0 / 6, 1.0 / 6);

/// Monomials' coefficients of the functions whose products with another's shape function have the
/// integral zero, and with its own that of the shape function.
Eigen::Matrix3d dual_coefficients() {
  Eigen::Matrix3d products;
  products << 4, 2, -1, 2, 16, 2, -1, 2, 4;
  products /= 30;
  return shape_integrals.asDiagonal() * products.inverse() * shape_coefficients();
}

/// A polynomial of second degree of x = from + t (to - from), by t.
Vector3 along_stretch(const Vector3& polynomial, double from, double to) {
  const double size = to - from;
  return {polynomial[0] + polynomial[1] * from + polynomial[2] * from * from,
          (polynomial[1] + 2 * polynomial[2] * from) * size, polynomial[2] * size * size};
}

/// A stretch of one element of the edge on one shell.
struct ElementStretch {
  double from = 0, to = 0;  ///< shares of the element
  int shell = 0;
  std::array<Eigen::Vector2d, 2> ends;
};

class EdgeStander {
 public:
  EdgeStander(Mesh& mesh, const StandingEdge& edge) : mesh_(mesh), edge_(edge), plates_(mesh) {}

  void stand() {
    for (const StandingEdge::Column& column : edge_.columns)
      if (!plates_.find(column.place, edge_.through)) refuse(column.place);
    std::vector<std::vector<SurfaceStretch>> lines(edge_.columns.size());
    std::vector<double> integrals(edge_.columns.size(), 0);
    const std::size_t elements = (edge_.columns.size() - 1) / 2;
    for (std::size_t element = 0; element < elements; ++element) {
      const double length = (column(element, 2).place - column(element, 0).place).norm();
      for (std::size_t i = 0; i < 3; ++i) integrals[2 * element + i] += length * shape_integrals[i];
    }
    const Eigen::Matrix3d duals = dual_coefficients();
    for (std::size_t element = 0; element < elements; ++element) {
      const double length = (column(element, 2).place - column(element, 0).place).norm();
      for (const ElementStretch& stretch : stretches_of(element))
        for (std::size_t i = 0; i < 3; ++i) {
          const Vector3 dual = duals.row(static_cast<Eigen::Index>(i)).transpose();
          const double size = (stretch.to - stretch.from) * length / integrals[2 * element + i];
          lines[2 * element + i].push_back(
              {stretch.shell, stretch.ends, size * along_stretch(dual, stretch.from, stretch.to)});
        }
    }
    for (std::size_t c = 0; c < lines.size(); ++c)
      tie(edge_.columns[c], add_foot(std::move(lines[c])));
  }

 private:
  const StandingEdge::Column& column(std::size_t element, std::size_t i) const {
    return edge_.columns[2 * element + i];
  }
  Vector3 place_on(std::size_t element, double share) const {
    return (1 - share) * column(element, 0).place + share * column(element, 2).place;
  }

  /// The plate below, in the solids' own plane where one goes on there.
  std::optional<PlatePlace> plate_below(std::size_t element, double share) const {
    return plates_.find(place_on(element, share), edge_.through);
  }

  std::vector<ElementStretch> stretches_of(std::size_t element) const {
    std::vector<ElementStretch> stretches;
    divide(element, 0, 1, stretches);
    return stretches;
  }

  /// Halves a stretch until one shell is below all of it.
  void divide(std::size_t element, double from, double to,
              std::vector<ElementStretch>& stretches) const {
    const double size = to - from, middle = from + size / 2;
    const auto centre = plate_below(element, middle);
    if (!centre) refuse(place_on(element, middle));
    if (size < no_length) {
      stretches.push_back({from, to, centre->shell, {centre->xi, centre->xi}});
      return;
    }
    const auto first = plate_below(element, from + inside * size),
               last = plate_below(element, to - inside * size);
    if (!first || !last) refuse(place_on(element, first ? to : from));
    const bool is_one = first->shell == centre->shell && last->shell == centre->shell &&
                        (0.5 * (first->xi + last->xi) - centre->xi).norm() < same_place;
    if (!is_one) {
      divide(element, from, middle, stretches);
      divide(element, middle, to, stretches);
      return;
    }
    const Eigen::Vector2d beyond = inside * (last->xi - first->xi);
    const auto within = [](const Eigen::Vector2d& xi) -> Eigen::Vector2d {
      return xi.cwiseMax(0.0).cwiseMin(1.0);
    };
    stretches.push_back(
        {from, to, centre->shell, {within(first->xi - beyond), within(last->xi + beyond)}});
  }

  [[noreturn]] static void refuse(const Vector3& place) {
    throw ModelError(fmt::format("no plate lies below its base at ({:.6g}, {:.6g}, {:.6g}) m",
                                 place.x(), place.y(), place.z()));
  }

  /// A vertex that moves as the mean along a line, where its weights balance.
  int add_foot(std::vector<SurfaceStretch> line) {
    Vector3 place = Vector3::Zero();
    // Simpson's rule twice: places are linear, or nearly so, along a stretch.
    for (const SurfaceStretch& stretch : line)
      for (int i = 0; i < 5; ++i) {
        constexpr std::array<double, 5> weights{1 / 12.0, 4 / 12.0, 2 / 12.0, 4 / 12.0, 1 / 12.0};
        const double t = i / 4.0, density = stretch.density.dot(Vector3(1, t, t * t));
        place += weights[i] * density *
                 position(mesh_, mesh_.shells[stretch.shell],
                          (1 - t) * stretch.ends[0] + t * stretch.ends[1]);
      }
    const auto longest =
        std::max_element(line.begin(), line.end(), [](const auto& a, const auto& b) {
          return (a.ends[1] - a.ends[0]).norm() < (b.ends[1] - b.ends[0]).norm();
        });
    SurfacePoint foot{static_cast<int>(mesh_.vertices.size()),
                      longest->shell,
                      0.5 * (longest->ends[0] + longest->ends[1]),
                      {}};
    foot.line = std::move(line);
    mesh_.vertices.push_back(place);
    if (!mesh_.vertex_labels.empty())
      mesh_.vertex_labels.push_back(
          *std::max_element(mesh_.vertex_labels.begin(), mesh_.vertex_labels.end()) + 1);
    mesh_.surface_points.push_back(std::move(foot));
    return mesh_.surface_points.back().vertex;
  }

  void tie(const StandingEdge::Column& nodes, int foot) {
    const auto height = [&](int vertex) { return edge_.through.dot(mesh_.vertices[vertex]); };
    const auto [low, high] =
        std::minmax_element(nodes.vertices.begin(), nodes.vertices.end(),
                            [&](int a, int b) { return height(a) < height(b); });
    RigidLink arm;
    arm.master = foot;
    for (const int vertex : nodes.vertices)
      if (vertex != *high) arm.slaves.push_back(vertex);
    const Vector3 along = (edge_.columns.back().place - edge_.columns.front().place).normalized();
    arm.axes << along.cross(edge_.through), along, edge_.through;
    arm.bound = {true, true, false, false, false, false};
    for (const int axis : {0, 1}) add_equation(foot, {{*high, 1.0}}, arm.axes.col(axis));
    add_equation(foot, {{*high, 0.5}, {*low, 0.5}}, arm.axes.col(2));
    mesh_.rigid_links.push_back(std::move(arm));
  }

  /// The weighted mean of vertices' motions along an axis is that of a rigid arm from the foot.
  void add_equation(int foot, const std::vector<std::pair<int, double>>& shares,
                    const Vector3& axis) {
    MotionEquation equation;
    equation.label = static_cast<long>(mesh_.equations.size()) + 1;
    Vector3 place = Vector3::Zero();
    for (const auto& [vertex, share] : shares) {
      equation.terms.push_back({vertex, share * axis, Vector3::Zero()});
      place += share * mesh_.vertices[vertex];
    }
    const Vector3 arm = place - mesh_.vertices[foot];
    equation.terms.push_back({foot, -axis, -arm.cross(axis)});
    mesh_.equations.push_back(std::move(equation));
  }

  Mesh& mesh_;
  const StandingEdge& edge_;
  const PlateFinder plates_;
};

}  // namespace

void stand_on_plating(Mesh& mesh, const StandingEdge& edge) { EdgeStander(mesh, edge).stand(); }

}  // namespace blocklift::structure
