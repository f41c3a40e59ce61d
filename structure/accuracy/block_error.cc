#include "structure/accuracy/block_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "parallel/threads.h"
#include "structure/formulation/shell.h"
#include "structure/formulation/shell_law.h"
#include "structure/index.h"
#include "structure/mesh/fields/fields.h"
#include "structure/mesh/fields/shell_edges.h"
#include "structure/mesh/solid_shape.h"
#include "structure/space/joints.h"
#include "structure/stress/shell_stress.h"
#include "structure/stress/solid_error.h"
#include "structure/stress/square_outline.h"

namespace blocklift::structure {

namespace {

/// Membrane forces, moments, shear forces and drilling: a column for each point, shell_strains rows
/// for each motion.
using Resultants = Eigen::MatrixXd;
using Law = Eigen::Matrix<double, shell_strains, shell_strains>;
using AllStrains = Eigen::Matrix<double, shell_strains, 1>;
using Motions = Eigen::Ref<const Eigen::MatrixXd>;

/// Turns (11, 22, 12) of forces and moments and (1, 2) of shear forces from a cell's axes at an
/// angle `a` to others into these; of a cell whose normal is against theirs moments and shear
/// forces change their sign. Drilling is nothing in a smooth motion, whatever it is in the cells.
Law turn_by_angle(double a, bool is_flipped) {
  const double c = std::cos(a), s = std::sin(a);
  Eigen::Matrix3d turn;
  turn << c * c, s * s, -2 * c * s, s * s, c * c, 2 * c * s, c * s, -c * s, c * c - s * s;
  Eigen::Matrix2d turn_of_shear;
  turn_of_shear << c, -s, s, c;
  if (is_flipped) {  // the cell's second axis points the other way
    turn.col(2) *= -1;
    turn_of_shear.col(1) *= -1;
  }
  const double sign = is_flipped ? -1 : 1;
  Law law = Law::Zero();
  law.block<3, 3>(membrane_11, membrane_11) = turn;
  law.block<3, 3>(curvature_11, curvature_11) = sign * turn;
  law.block<2, 2>(shear_1, shear_1) = sign * turn_of_shear;
  return law;
}

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
    ends_.resize(shares_.size());
    std::exclusive_scan(shares_.begin(), shares_.end(), ends_.begin(), 0);
    places_.resize(of_cell_.size());
    for (std::size_t place = 0; place < of_cell_.size(); ++place)
      places_[at(ends_[of_cell_[place]]++)] = static_cast<int>(place);
  }
  int of(int cell, int local) const {
    return of_cell_[at(cell) * at(space_.nodes_per_shell()) + at(local)];
  }
  int count() const { return static_cast<int>(shares_.size()); }
  int share(int point) const { return shares_[point]; }
  /// The nodes of cells that have a point, in their order: nodes a cell * cell + local.
  std::span<const int> places(int point) const {
    return std::span(places_).subspan(at(ends_[point] - shares_[point]), at(shares_[point]));
  }

 private:
  const Space& space_;
  std::vector<int> of_cell_, shares_;
  std::vector<int> places_, ends_;  ///< of all points one behind the other, and where each ends
};

/// The axes in which resultants are averaged: at each point those of the first cell that has it,
/// which follow the plating's kinks. No direction serves a whole field: plating may turn all the
/// way round.
class Axes {
 public:
  Axes(const Space& space, const PlateFields& fields, const Points& points)
      : per_cell_(space.nodes_per_shell()), is_flipped_(space.shells().size(), false) {
    std::vector<bool> is_flipped(space.mesh().shells.size(), false);
    for (const PlateField& field : fields.fields)
      for (std::size_t i = 0; i < field.shells.size(); ++i)
        is_flipped[field.shells[i]] = field.is_flipped[i];
    const std::vector<double> line = lagrange_places(space.degree());
    std::vector<Frame> frames(at(points.count()));
    for (std::size_t c = 0; c < space.shells().size(); ++c) {
      const int cell = static_cast<int>(c);
      const ShellCell& located = space.shells()[c];
      is_flipped_[c] = is_flipped[located.shell];
      // The direction of the axes that ShellOperator has in the cell.
      const Vector3 along = space.place(cell, {1, 0.5}) - space.place(cell, {0, 0.5});
      for (int i = 0; i < per_cell_; ++i) {
        const Eigen::Vector2d xi(line[at(i) % line.size()], line[at(i) / line.size()]);
        const Vector3 normal =
            (is_flipped_[c] ? -1 : 1) *
            square_outline::normal_of(space.mesh(),
                                      {located.shell, located.origin + located.size * xi});
        const Vector3 e_1 = (along - normal * normal.dot(along)).normalized();
        Frame& frame = frames[at(points.of(cell, i))];
        if (frame.normal.isZero()) frame = {e_1, normal};
        const Vector3 direction =
            Eigen::Quaterniond::FromTwoVectors(frame.normal, normal) * frame.e_1;
        angles_.push_back(std::atan2(-direction.dot(normal.cross(e_1)), direction.dot(e_1)));
      }
    }
  }
  /// Resultants along a point's axes from those along the axes of a cell that has it as its node.
  Law to_point(int cell, int local) const {
    return turn_by_angle(angles_[place(cell, local)], is_flipped_[at(cell)]);
  }
  /// The other way round. To turn and mirror is its own inverse.
  Law to_cell(int cell, int local) const {
    const double angle = angles_[place(cell, local)];
    const bool is_flipped = is_flipped_[at(cell)];
    return turn_by_angle(is_flipped ? angle : -angle, is_flipped);
  }

 private:
  struct Frame {
    Vector3 e_1 = Vector3::Zero(), normal = Vector3::Zero();
  };
  std::size_t place(int cell, int local) const { return at(cell) * at(per_cell_) + at(local); }

  int per_cell_;
  std::vector<bool> is_flipped_;
  std::vector<double> angles_;  ///< of each cell's axes against those of its nodes' points
};

/// Resultants at one point, a column for each motion.
using AtPoint = Eigen::Matrix<double, shell_strains, Eigen::Dynamic>;

/// Turns resultants at one point, shell_strains rows for each motion, into other axes.
void turn_into(const Law& turn, const Eigen::Ref<const Eigen::VectorXd>& resultants,
               AtPoint& turned) {
  turned.noalias() = turn * resultants.reshaped(shell_strains, resultants.size() / shell_strains);
}

/// Membrane and bending may be coupled by layers; shear and drilling stand for themselves. Shear
/// counts in triangles alone: quadrangles are right in it but where a load makes it jump, which a
/// mean over the jump would tell as their error.
Law compliance_of(const Law& law, bool is_triangle) {
  Law compliance = Law::Zero();
  compliance.topLeftCorner<6, 6>() = algebra::inverse_of<6>(law.topLeftCorner<6, 6>());
  if (is_triangle)
    compliance.block<2, 2>(shear_1, shear_1) = law.block<2, 2>(shear_1, shear_1).inverse();
  compliance(drilling, drilling) = 1 / law(drilling, drilling);
  return compliance;
}

/// Resultants of a cell at an operator's points, along its own axes.
/// @param places of the operator's points, 2 x m.
Resultants resultants_of(const ElasticModel& model, ShellOperator& shell_operator,
                         const Eigen::Matrix2Xd& places, int cell, const Motions& motions,
                         const CellHeat* heat) {
  shell_operator.reinit(cell);
  const Eigen::MatrixXd local = motions_of_cell(model.space(), cell, motions);
  Resultants resultants(shell_strains * motions.cols(),
                        static_cast<Eigen::Index>(shell_operator.points().size()));
  for (std::size_t q = 0; q < shell_operator.points().size(); ++q) {
    const ShellPoint& point = shell_operator.points()[q];
    auto here = resultants.col(q).reshaped(shell_strains, motions.cols());
    here = law_of_cell(model.space(), cell, point.e_1, point.e_2, point.thickness) *
           (point.strain * local);
    if (heat != nullptr)
      here.topRows<6>() -= heat->shell_forces(cell, places.col(static_cast<Eigen::Index>(q)),
                                              point.e_1, point.e_2, point.thickness);
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

/// |e|^2, |s_h|^2 and |s|^2 of cells or solids in motions, J. That of the smooth field s is
/// |s_h|^2 + |e|^2 wherever elements are no triangles: what a quadrangle's own field has beyond the
/// smooth one, such as the bending of a cell in its plane, it mostly has rightly.
struct SquaredNorms {
  SquaredNorms(Eigen::Index count, Eigen::Index motions)
      : error(Eigen::MatrixXd::Zero(count, motions)), own(error), smooth(error) {}
  Eigen::MatrixXd error, own, smooth;
};

SquaredNorms norms_of_solids(const Space& space, const Motions& motions, int threads,
                             const CellHeat* heat) {
  const SolidSet solids = solids_of(space);
  SquaredNorms norms(solids.count(), motions.cols());
  if (solids.count() == 0) return norms;
  const NodalPoints points = find_nodal_points(solids);
  for (Eigen::Index m = 0; m < motions.cols(); ++m) {
    const Eigen::VectorXd displacement =
        motions.col(m).reshaped(6, space.node_count()).topRows<3>().reshaped();
    HeldSolidStress held;
    if (heat != nullptr)
      held = [&, m](int solid, const Eigen::MatrixXd& values) -> StressColumns {
        return heat->solid_stresses(solid, values).col(m).reshaped(6, values.rows());
      };
    const SolidError error = estimate_solid_error(solids, points, displacement, threads, held);
    norms.error.col(m) = error.squared_error;
    norms.own.col(m) = error.squared_norm;
  }
  norms.smooth = norms.own + norms.error;
  return norms;
}

/// Cells that one thread computes at a time.
int batch_of(int cells) { return std::max(32, cells / 64); }

double relative_error(double error, double own, double smooth) {
  const double larger = std::max(own, smooth);
  return larger > 0 ? std::min(1.0, std::sqrt(error / larger)) : 0;
}

/// The recovered resultants at the points where nodes and fields meet.
Resultants recover(const ElasticModel& model, const Axes& axes, const Points& points,
                   const Motions& motions, int threads, const CellHeat* heat) {
  const Space& space = model.space();
  const int cells = static_cast<int>(space.shells().size()), per_cell = space.nodes_per_shell();
  Resultants at_nodes(shell_strains * motions.cols(), static_cast<Eigen::Index>(per_cell) * cells);
  const Eigen::MatrixXd carry = to_nodes(space.degree());
  const Eigen::Matrix2Xd places = square_rule(space.degree()).topRows<2>();
  parallel::in_batches(cells, batch_of(cells), threads, [&](int first, int count) {
    ShellOperator accurate(space, places);
    for (int cell = first; cell < first + count; ++cell)
      at_nodes.middleCols(static_cast<Eigen::Index>(per_cell) * cell, per_cell) =
          resultants_of(model, accurate, places, cell, motions, heat) * carry;
  });
  Resultants recovered = Resultants::Zero(shell_strains * motions.cols(), points.count());
  // Each point by one thread, its cells in their order: sums do not depend on the threads.
  parallel::in_batches(points.count(), batch_of(points.count()), threads,
                       [&](int first, int count) {
                         AtPoint turned(shell_strains, motions.cols());
                         for (int point = first; point < first + count; ++point)
                           for (const int place : points.places(point)) {
                             turn_into(axes.to_point(place / per_cell, place % per_cell),
                                       at_nodes.col(place), turned);
                             recovered.col(point) += turned.reshaped() / points.share(point);
                           }
                       });
  return recovered;
}

/// Shear forces that are in balance with the moments at a cell's nodes, q_a = d_b m_ab, in place of
/// smooth ones. Triangles that lock are held by shear which is as smooth as it is wrong.
void balance_shear(const ShellPoint& point, const Resultants& at_nodes,
                   Eigen::Ref<Eigen::VectorXd> smooth) {
  const Eigen::Index nodes = at_nodes.cols();
  Eigen::VectorXd d_1(nodes), d_2(nodes);  // of the nodes' shape functions
  for (Eigen::Index i = 0; i < nodes; ++i) {
    d_1[i] = point.strain.block<1, 3>(curvature_11, 6 * i + 3).dot(point.e_2);
    d_2[i] = -point.strain.block<1, 3>(curvature_22, 6 * i + 3).dot(point.e_1);
  }
  const Eigen::VectorXd by_1 = at_nodes * d_1, by_2 = at_nodes * d_2;
  for (Eigen::Index first = 0; first < smooth.size(); first += shell_strains) {
    smooth[first + shear_1] = by_1[first + curvature_11] + by_2[first + curvature_12];
    smooth[first + shear_2] = by_1[first + curvature_12] + by_2[first + curvature_22];
  }
}

/// Adds what a point of a cell has to the norms of the motions.
void add_point(const Law& compliance, double area, const Eigen::Ref<const Eigen::VectorXd>& smooth,
               const Eigen::Ref<const Eigen::VectorXd>& s_h, int cell, SquaredNorms& norms) {
  for (Eigen::Index m = 0; m < norms.error.cols(); ++m) {
    const AllStrains own = s_h.segment<shell_strains>(shell_strains * m),
                     mean = smooth.segment<shell_strains>(shell_strains * m),
                     difference = mean - own;
    norms.error(cell, m) += area * difference.dot(compliance * difference);
    norms.own(cell, m) += area * own.dot(compliance * own);
    norms.smooth(cell, m) += area * mean.dot(compliance * mean);
  }
}

SquaredNorms norms_of_cells(const ElasticModel& model, const Axes& axes, const Points& points,
                            const Motions& motions, int threads, const CellHeat* heat) {
  const Space& space = model.space();
  const int cells = static_cast<int>(space.shells().size()), p = space.degree();
  SquaredNorms norms(cells, motions.cols());
  const Resultants recovered = recover(model, axes, points, motions, threads, heat);
  const Eigen::Matrix3Xd rule = square_rule(p + 1);
  Eigen::MatrixXd values(space.nodes_per_shell(), rule.cols());
  for (Eigen::Index q = 0; q < rule.cols(); ++q)
    values.col(q) = space.shell_values(rule.col(q).head<2>());
  parallel::in_batches(cells, batch_of(cells), threads, [&](int first, int count) {
    ShellOperator own(space, rule.topRows<2>());
    Resultants at_nodes(shell_strains * motions.cols(), space.nodes_per_shell());
    AtPoint turned(shell_strains, motions.cols());
    for (int cell = first; cell < first + count; ++cell) {
      const Resultants s_h = resultants_of(model, own, rule.topRows<2>(), cell, motions, heat);
      for (int i = 0; i < space.nodes_per_shell(); ++i) {
        turn_into(axes.to_cell(cell, i), recovered.col(points.of(cell, i)), turned);
        at_nodes.col(i) = turned.reshaped();
      }
      const Shell& shell = model.mesh().shells[space.shells()[cell].shell];
      Resultants smooth = at_nodes * values;
      const bool is_layered = model.mesh().section_of(shell).laminate >= 0;
      Law compliance = Law::Zero();
      double thickness = 0;  // that it is of
      for (Eigen::Index q = 0; q < rule.cols(); ++q) {
        const ShellPoint& point = own.points()[q];
        // One material is the same seen along any axes.
        if (is_layered || point.thickness != thickness) {
          thickness = point.thickness;
          compliance = compliance_of(
              law_of_cell(space, cell, point.e_1, point.e_2, point.thickness), shell.is_triangle());
        }
        if (shell.is_triangle()) balance_shear(point, at_nodes, smooth.col(q));
        add_point(compliance, rule(2, q) * point.area, smooth.col(q), s_h.col(q), cell, norms);
      }
      if (!shell.is_triangle())
        norms.smooth.row(cell) = norms.own.row(cell) + norms.error.row(cell);
    }
  });
  return norms;
}

/// The same of any number of motions: the operators of the cells are made once for some of them.
SquaredNorms norms_of_cells(const ElasticModel& model, const Motions& motions, int threads,
                            const CellHeat* heat) {
  constexpr Eigen::Index together = 8;  // what is held of each at all nodes of all cells is large
  const Space& space = model.space();
  SquaredNorms norms(static_cast<Eigen::Index>(space.shells().size()), motions.cols());
  if (space.shells().empty()) return norms;
  // Facets of curved plating are compared with one another.
  const PlateFields fields = find_fields(model.mesh(), corner_kink);
  const Points points(space, fields);
  const Axes axes(space, fields, points);
  for (Eigen::Index first = 0; first < motions.cols(); first += together) {
    const Eigen::Index count = std::min(together, motions.cols() - first);
    std::optional<CellHeat> of_these;
    if (heat != nullptr) of_these = heat->part(first, count);
    const SquaredNorms some = norms_of_cells(model, axes, points, motions.middleCols(first, count),
                                             threads, of_these ? &*of_these : nullptr);
    norms.error.middleCols(first, count) = some.error;
    norms.own.middleCols(first, count) = some.own;
    norms.smooth.middleCols(first, count) = some.smooth;
  }
  return norms;
}

/// The mean of a solid's corners, m.
Vector3 centre_of(const Mesh& mesh, const Solid& solid) {
  return places_of(mesh, solid).leftCols(topology_of(solid.shape).corners).rowwise().mean();
}

/// What the norms say of a motion.
BlockError sum_up(const ElasticModel& model, const SquaredNorms& cells, const SquaredNorms& solids,
                  Eigen::Index motion) {
  const Space& space = model.space();
  const Mesh& mesh = model.mesh();
  std::vector<double> e(mesh.groups.size(), 0), own(e), smooth(e);
  const auto add = [&](const SquaredNorms& norms, const auto& region_of) {
    for (int i = 0; i < norms.error.rows(); ++i) {
      const std::size_t group = at(mesh.regions[region_of(i)].group);
      e[group] += norms.error(i, motion);
      own[group] += norms.own(i, motion);
      smooth[group] += norms.smooth(i, motion);
    }
  };
  const auto region_of_cell = [&](int cell) {
    return mesh.shells[space.shells()[cell].shell].region;
  };
  add(cells, region_of_cell);
  add(solids, [&](int solid) { return mesh.solids[solid].region; });

  const auto cell_errors = cells.error.col(motion), solid_errors = solids.error.col(motion);
  const double error = cell_errors.sum() + solid_errors.sum(),
               norm = cells.own.col(motion).sum() + solids.own.col(motion).sum();
  BlockError result;
  result.relative =
      relative_error(error, norm, cells.smooth.col(motion).sum() + solids.smooth.col(motion).sum());
  result.squared_norm = norm + error;
  for (std::size_t g = 0; g < e.size(); ++g)
    result.of_groups.push_back(relative_error(e[g], own[g], smooth[g]));
  Eigen::Index worst = 0;
  double largest = 0;
  if (cell_errors.size() > 0) {
    largest = cell_errors.maxCoeff(&worst);
    result.worst_part = mesh.regions[region_of_cell(static_cast<int>(worst))].name;
    result.worst_point = space.place(static_cast<int>(worst), {0.5, 0.5});
  }
  if (solid_errors.size() > 0 && solid_errors.maxCoeff(&worst) > largest) {
    const Solid& solid = mesh.solids[worst];
    result.worst_part = mesh.regions[solid.region].name;
    result.worst_point = centre_of(mesh, solid);
  }
  result.of_cells = cell_errors;
  return result;
}

}  // namespace

std::vector<BlockError> estimate_block_errors(const ElasticModel& model, const Motions& motions,
                                              int threads, const CellHeat* heat) {
  const SquaredNorms cells = norms_of_cells(model, motions, threads, heat);
  const SquaredNorms solids = norms_of_solids(model.space(), motions, threads, heat);
  std::vector<BlockError> errors;
  for (Eigen::Index m = 0; m < motions.cols(); ++m)
    errors.push_back(sum_up(model, cells, solids, m));
  return errors;
}

BlockError estimate_block_error(const ElasticModel& model, const Eigen::VectorXd& motion,
                                int threads) {
  return std::move(estimate_block_errors(model, motion, threads).front());
}

}  // namespace blocklift::structure
