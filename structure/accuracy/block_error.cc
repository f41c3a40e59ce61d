#include "structure/accuracy/block_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "parallel/threads.h"
#include "structure/formulation/shell.h"
#include "structure/index.h"
#include "structure/mesh/fields.h"
#include "structure/mesh/solid_shape.h"
#include "structure/space/joints.h"
#include "structure/stress/solid_error.h"

namespace blocklift::structure {

namespace {

using Resultants = Eigen::Matrix<double, 6, Eigen::Dynamic>;  // membrane forces, moments
using Law = Eigen::Matrix<double, 6, 6>;

/// Turns (11, 22, 12) of forces and moments from axes at an angle `a` to the field's into the
/// field's; of a cell whose normal is against the field's moments change their sign.
Law turn_to_field(double a, bool is_flipped) {
  const double c = std::cos(a), s = std::sin(a);
  Eigen::Matrix3d turn;
  turn << c * c, s * s, -2 * c * s, s * s, c * c, 2 * c * s, c * s, -c * s, c * c - s * s;
  if (is_flipped) turn.col(2) *= -1;  // the cell's second axis points the other way
  Law law = Law::Zero();
  law.topLeftCorner<3, 3>() = turn;
  law.bottomRightCorner<3, 3>() = (is_flipped ? -1 : 1) * turn;
  return law;
}

/// One direction for each field, and on which side its cells' normals lie.
struct Orientation {
  explicit Orientation(const ElasticModel& model)
      : fields(find_fields(model.mesh())), is_flipped(model.mesh().shells.size(), false) {
    for (const PlateField& field : fields.fields) {
      const Shell& first = model.mesh().shells[field.shells.front()];
      along.push_back(
          (position(model.mesh(), first, {1, 0.5}) - position(model.mesh(), first, {0, 0.5}))
              .normalized());
      for (std::size_t i = 0; i < field.shells.size(); ++i)
        is_flipped[field.shells[i]] = field.is_flipped[i];
    }
  }
  Law turn(const ShellPoint& point, int shell) const {
    const int field = fields.field_of_shell[shell];
    const Vector3 normal = (is_flipped[shell] ? -1 : 1) * point.normal;
    const Vector3 e_2 = normal.cross(point.e_1);
    // The angle of the cell's first axis against the field's direction, in the tangent plane.
    const Vector3& direction = along[field];
    return turn_to_field(std::atan2(-direction.dot(e_2), direction.dot(point.e_1)),
                         is_flipped[shell]);
  }

  PlateFields fields;
  std::vector<Vector3> along;
  std::vector<bool> is_flipped;
};

/// Points of recovered resultants: one for each node and field that meet.
class Points {
 public:
  Points(const Space& space, const PlateFields& fields) : space_(space) {
    std::unordered_map<std::int64_t, int> known;
    const auto count = static_cast<std::int64_t>(fields.fields.size());
    for (std::size_t cell = 0; cell < space.shells().size(); ++cell)
      for (int i = 0; i < space.nodes_per_shell(); ++i) {
        const int node = space.shell_nodes(static_cast<int>(cell))[i];
        const Space::Term *begin = space.begin_of(6 * node), *end = space.end_of(6 * node);
        // Tied nodes share an unknown; what follows a polynomial stands for itself.
        const std::int64_t place =
            end - begin == 1 ? begin->unknown : space.unknowns() + static_cast<std::int64_t>(node);
        const std::int64_t key = count * place + fields.field_of_shell[space.shells()[cell].shell];
        const auto [found, is_new] = known.try_emplace(key, static_cast<int>(shares_.size()));
        if (is_new) shares_.push_back(0);
        ++shares_[found->second];
        of_cell_.push_back(found->second);
      }
  }
  int of(int cell, int local) const {
    return of_cell_[at(cell) * at(space_.nodes_per_shell()) + at(local)];
  }
  int count() const { return static_cast<int>(shares_.size()); }
  int share(int point) const { return shares_[point]; }

 private:
  const Space& space_;
  std::vector<int> of_cell_, shares_;
};

Eigen::VectorXd motion_of_cell(const Space& space, int cell, const Eigen::VectorXd& motion) {
  Eigen::VectorXd local(6 * space.nodes_per_shell());
  for (int i = 0; i < space.nodes_per_shell(); ++i)
    local.segment<6>(6 * i) = motion.segment<6>(6 * space.shell_nodes(cell)[i]);
  return local;
}

Law law_of(const ElasticModel& model, int cell, double thickness) {
  const Shell& shell = model.mesh().shells[model.space().shells()[cell].shell];
  return shell_stiffness_law(model.mesh().material_of(shell), thickness).topLeftCorner<6, 6>();
}

/// Resultants of a cell at an operator's points, in its field's axes.
Resultants resultants_of(const ElasticModel& model, const Orientation& orientation,
                         ShellOperator& shell_operator, int cell, const Eigen::VectorXd& motion) {
  shell_operator.reinit(cell);
  const Eigen::VectorXd local = motion_of_cell(model.space(), cell, motion);
  Resultants resultants(6, static_cast<Eigen::Index>(shell_operator.points().size()));
  for (std::size_t q = 0; q < shell_operator.points().size(); ++q) {
    const ShellPoint& point = shell_operator.points()[q];
    resultants.col(q) =
        orientation.turn(point, model.space().shells()[cell].shell) *
        (law_of(model, cell, point.thickness) * (point.strain.topRows<6>() * local));
  }
  return resultants;
}

/// From the p x p Gauss points to the nodes: Gauss points x nodes.
Eigen::MatrixXd to_nodes(int degree) {
  const Eigen::Matrix3Xd rule = square_rule(degree);
  const std::vector<double> line = lagrange_places(degree);
  Eigen::VectorXd places(degree);
  for (int i = 0; i < degree; ++i) places[i] = rule(0, i);
  const auto value = [&](int i, double x) {
    double product = 1;
    for (int j = 0; j < degree; ++j)
      if (j != i) product *= (x - places[j]) / (places[i] - places[j]);
    return product;
  };
  const int n = degree + 1;
  Eigen::MatrixXd result(degree * degree, n * n);
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a)
      for (int j = 0; j < degree; ++j)
        for (int i = 0; i < degree; ++i)
          result(j * degree + i, b * n + a) = value(i, line[a]) * value(j, line[b]);
  return result;
}

/// |e|^2 and |s_h|^2 of cells or solids, J.
struct SquaredNorms {
  explicit SquaredNorms(Eigen::Index count)
      : error(Eigen::VectorXd::Zero(count)), norm(Eigen::VectorXd::Zero(count)) {}
  Eigen::VectorXd error, norm;
};

SquaredNorms norms_of_solids(const Space& space, const Eigen::VectorXd& motion, int threads) {
  const SolidSet solids = solids_of(space);
  SquaredNorms norms(solids.count());
  if (solids.count() == 0) return norms;
  const Eigen::VectorXd displacement =
      motion.reshaped(6, space.node_count()).topRows<3>().reshaped();
  SolidError error = estimate_solid_error(solids, find_nodal_points(solids), displacement, threads);
  norms.error = std::move(error.squared_error);
  norms.norm = std::move(error.squared_norm);
  return norms;
}

double relative_error(double error, double norm) {
  return error + norm > 0 ? std::sqrt(error / (error + norm)) : 0;
}

SquaredNorms norms_of_cells(const ElasticModel& model, const Eigen::VectorXd& motion, int threads) {
  const Space& space = model.space();
  const int cells = static_cast<int>(space.shells().size()), p = space.degree();
  SquaredNorms norms(cells);
  if (cells == 0) return norms;
  const Orientation orientation(model);
  const Points points(space, orientation.fields);

  const int batch = std::max(32, cells / 64), per_cell = space.nodes_per_shell();
  Resultants recovered = Resultants::Zero(6, points.count());
  Resultants at_nodes(6, static_cast<Eigen::Index>(per_cell) * cells);
  const Eigen::MatrixXd carry = to_nodes(p);
  parallel::in_batches(cells, batch, threads, [&](int first, int count) {
    ShellOperator accurate(space, square_rule(p).topRows<2>());
    for (int cell = first; cell < first + count; ++cell)
      at_nodes.middleCols(static_cast<Eigen::Index>(per_cell) * cell, per_cell) =
          resultants_of(model, orientation, accurate, cell, motion) * carry;
  });
  for (int cell = 0; cell < cells; ++cell)
    for (int i = 0; i < per_cell; ++i)
      recovered.col(points.of(cell, i)) +=
          at_nodes.col(static_cast<Eigen::Index>(per_cell) * cell + i) /
          points.share(points.of(cell, i));

  const Eigen::Matrix3Xd rule = square_rule(p + 1);
  Eigen::MatrixXd values(space.nodes_per_shell(), rule.cols());
  for (Eigen::Index q = 0; q < rule.cols(); ++q)
    values.col(q) = space.shell_values(rule.col(q).head<2>());
  parallel::in_batches(cells, batch, threads, [&](int first, int count) {
    ShellOperator own(space, rule.topRows<2>());
    Resultants smooth(6, space.nodes_per_shell());
    for (int cell = first; cell < first + count; ++cell) {
      const Resultants s_h = resultants_of(model, orientation, own, cell, motion);
      for (int i = 0; i < space.nodes_per_shell(); ++i)
        smooth.col(i) = recovered.col(points.of(cell, i));
      const Resultants difference = smooth * values - s_h;
      Law compliance = Law::Zero();
      double thickness = 0;  // that it is of
      for (Eigen::Index q = 0; q < rule.cols(); ++q) {
        if (own.points()[q].thickness != thickness) {
          thickness = own.points()[q].thickness;
          compliance = algebra::inverse_of<6>(law_of(model, cell, thickness));
        }
        const double area = rule(2, q) * own.points()[q].area;
        norms.error[cell] += area * difference.col(q).dot(compliance * difference.col(q));
        norms.norm[cell] += area * s_h.col(q).dot(compliance * s_h.col(q));
      }
    }
  });
  return norms;
}

/// The mean of a solid's corners, m.
Vector3 centre_of(const Mesh& mesh, const Solid& solid) {
  return places_of(mesh, solid).leftCols(topology_of(solid.shape).corners).rowwise().mean();
}

}  // namespace

BlockError estimate_block_error(const ElasticModel& model, const Eigen::VectorXd& motion,
                                int threads) {
  const Space& space = model.space();
  const Mesh& mesh = model.mesh();
  SquaredNorms cells = norms_of_cells(model, motion, threads);
  const SquaredNorms solids = norms_of_solids(space, motion, threads);

  std::vector<double> e(mesh.groups.size(), 0), s(mesh.groups.size(), 0);
  const auto add = [&](const SquaredNorms& norms, const auto& region_of) {
    for (int i = 0; i < norms.error.size(); ++i) {
      const std::size_t group = at(mesh.regions[region_of(i)].group);
      e[group] += norms.error[i];
      s[group] += norms.norm[i];
    }
  };
  const auto region_of_cell = [&](int cell) {
    return mesh.shells[space.shells()[cell].shell].region;
  };
  add(cells, region_of_cell);
  add(solids, [&](int solid) { return mesh.solids[solid].region; });

  BlockError result;
  result.relative =
      relative_error(cells.error.sum() + solids.error.sum(), cells.norm.sum() + solids.norm.sum());
  for (std::size_t g = 0; g < e.size(); ++g) result.of_groups.push_back(relative_error(e[g], s[g]));
  Eigen::Index worst = 0;
  double largest = 0;
  if (cells.error.size() > 0) {
    largest = cells.error.maxCoeff(&worst);
    result.worst_part = mesh.regions[region_of_cell(static_cast<int>(worst))].name;
    result.worst_point = space.place(static_cast<int>(worst), {0.5, 0.5});
  }
  if (solids.error.size() > 0 && solids.error.maxCoeff(&worst) > largest) {
    const Solid& solid = mesh.solids[worst];
    result.worst_part = mesh.regions[solid.region].name;
    result.worst_point = centre_of(mesh, solid);
  }
  result.of_cells = std::move(cells.error);
  return result;
}

}  // namespace blocklift::structure
