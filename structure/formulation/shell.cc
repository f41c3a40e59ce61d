#include "structure/formulation/shell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <Eigen/Dense>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include "algebra/products.h"
#include "structure/formulation/gauss_line.h"
#include "structure/formulation/shell_law.h"
#include "structure/formulation/triangle_sides.h"
#include "structure/index.h"
#include "structure/space/space_implementation.h"

namespace blocklift::structure {

namespace {

using Rows = Eigen::Matrix<double, shell_strains, Eigen::Dynamic, Eigen::RowMajor>;

dealii::Quadrature<2> quadrature_of(const Eigen::Matrix2Xd& points) {
  std::vector<dealii::Point<2>> list;
  for (Eigen::Index q = 0; q < points.cols(); ++q) list.emplace_back(points(0, q), points(1, q));
  return dealii::Quadrature<2>(list);
}

/// Geometry of a shell's surface at a point, by the unit coordinates.
struct Surface {
  Vector3 g_1, g_2, n;
  Vector3 dn_1 = Vector3::Zero(), dn_2 = Vector3::Zero();  ///< derivatives of the normal
  double area = 0;                                         ///< |g_1 x g_2|
};

Vector3 to_vector(const dealii::Tensor<1, 3>& t) { return {t[0], t[1], t[2]}; }

Surface tangents_at(const dealii::FEValues<2, 3>& values, unsigned q) {
  const auto& jacobian = values.jacobian(q);
  const auto tangent = [&](unsigned a) {
    return Vector3(jacobian[0][a], jacobian[1][a], jacobian[2][a]);
  };
  Surface surface;
  surface.g_1 = tangent(0);
  surface.g_2 = tangent(1);
  const Vector3 across = surface.g_1.cross(surface.g_2);
  surface.area = across.norm();
  // Only the edge of a triangle that is a point has none; strains tied there carry no weight.
  if (!(surface.area > 0)) surface.area = 1e-300;
  surface.n = across / surface.area;
  return surface;
}

Surface surface_at(const dealii::FEValues<2, 3>& values, unsigned q) {
  Surface surface = tangents_at(values, q);
  const auto& second = values.jacobian_grad(q);
  const auto curve = [&](unsigned a, unsigned b) {
    return Vector3(second[0][a][b], second[1][a][b], second[2][a][b]);
  };
  const auto turn = [&](unsigned b) -> Vector3 {
    const Vector3 change =
        (curve(0, b).cross(surface.g_2) + surface.g_1.cross(curve(1, b))) / surface.area;
    return change - surface.n * surface.n.dot(change);
  };
  surface.dn_1 = turn(0);
  surface.dn_2 = turn(1);
  return surface;
}

std::vector<Shapes> tabulate(const Space::Implementation& own, const Eigen::Matrix2Xd& points) {
  const auto nodes = static_cast<Eigen::Index>(own.shell_order.size());
  std::vector<Shapes> shapes;
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    const dealii::Point<2> xi(points(0, q), points(1, q));
    Shapes at_point{Eigen::RowVectorXd(nodes), Eigen::RowVectorXd(nodes),
                    Eigen::RowVectorXd(nodes)};
    for (Eigen::Index i = 0; i < nodes; ++i) {
      const unsigned node = own.shell_order[i];
      const auto gradient = own.shell_element.shape_grad(node, xi);
      at_point.value[i] = own.shell_element.shape_value(node, xi);
      at_point.d_1[i] = gradient[0];
      at_point.d_2[i] = gradient[1];
    }
    shapes.push_back(std::move(at_point));
  }
  return shapes;
}

/// Adds to a row, for each node i, a . u_i and b . theta_i times factors of the node.
template <typename Row>
void add(Row&& row, const Eigen::RowVectorXd& factors, const Vector3& a, int offset) {
  for (int c = 0; c < 3; ++c)
    if (a[c] != 0)
      for (Eigen::Index i = 0; i < factors.size(); ++i)
        row[6 * i + offset + c] += factors[i] * a[c];
}

constexpr int u = 0, theta = 3;  // where a node's displacement and rotation begin

/// Adds a height times a curvature by the unit coordinates; g . (theta x n) = theta . (n x g).
template <typename Row>
void add_curvature(const Surface& s, const Shapes& shape, ShellStrain strain, double height,
                   Row&& row) {
  const auto curvature = [&](const Vector3& g, const Vector3& dn_of_g, const Vector3& dn_along,
                             const Eigen::RowVectorXd& along) {
    add(row, along, height * s.n.cross(g), theta);
    add(row, shape.value, height * dn_along.cross(g), theta);
    add(row, along, height * dn_of_g, u);
  };
  switch (strain) {
    case curvature_11:
      curvature(s.g_1, s.dn_1, s.dn_1, shape.d_1);
      break;
    case curvature_22:
      curvature(s.g_2, s.dn_2, s.dn_2, shape.d_2);
      break;
    default:
      curvature(s.g_1, s.dn_1, s.dn_2, shape.d_2);
      curvature(s.g_2, s.dn_2, s.dn_1, shape.d_1);
  }
}

/// Adds to the drilling what a height makes of it: to its first power the turn of u + height theta
/// x n along the surface there, which is n_1 x g_2 + g_1 x n_2 larger.
template <typename Row>
void add_drilling_of_height(const Surface& s, const Shapes& shape, double height, Row&& row) {
  const double share = height / (2 * s.area);
  const Vector3 change = s.dn_1.cross(s.g_2) + s.g_1.cross(s.dn_2);
  add(row, shape.value, share * (2 * s.n.dot(change) * s.n - change), theta);
  add(row, shape.d_1, -share * s.n.cross(s.g_2), theta);
  add(row, shape.d_2, share * s.n.cross(s.g_1), theta);
  add(row, shape.d_1, -share * s.dn_2, u);
  add(row, shape.d_2, share * s.dn_1, u);
}

/// A strain by the unit coordinates (a covariant component) of the mid-surface, which lies at an
/// offset from the nodes' surface.
template <typename Row>
void covariant_strain(const Surface& s, const Shapes& shape, ShellStrain strain, double offset,
                      Row&& row) {
  row.setZero();
  switch (strain) {
    case membrane_11:
      add(row, shape.d_1, s.g_1, u);
      break;
    case membrane_22:
      add(row, shape.d_2, s.g_2, u);
      break;
    case membrane_12:
      add(row, shape.d_2, s.g_1, u);
      add(row, shape.d_1, s.g_2, u);
      break;
    case curvature_11:
    case curvature_22:
    case curvature_12:
      add_curvature(s, shape, strain, 1, row);
      break;
    case shear_1:
      add(row, shape.d_1, s.n, u);
      add(row, shape.value, s.n.cross(s.g_1), theta);
      break;
    case shear_2:
      add(row, shape.d_2, s.n, u);
      add(row, shape.value, s.n.cross(s.g_2), theta);
      break;
    default:
      add(row, shape.value, s.n, theta);
      add(row, shape.d_1, -s.g_2 / (2 * s.area), u);
      add(row, shape.d_2, s.g_1 / (2 * s.area), u);
      if (offset != 0) add_drilling_of_height(s, shape, offset, row);
  }
  if (offset != 0 && strain <= membrane_12)
    add_curvature(s, shape, static_cast<ShellStrain>(strain + curvature_11 - membrane_11), offset,
                  row);
}

/// Unit tangents at right angles, the first as near to a direction as it gets.
std::pair<Vector3, Vector3> unit_tangents(const Surface& s, const Vector3& along) {
  const Vector3 e_1 = (along - s.n * s.n.dot(along)).normalized();
  return {e_1, s.n.cross(e_1)};
}

/// Takes covariant components to those along unit tangents.
struct Turn {
  Eigen::Matrix2d vectors;
  Eigen::Matrix3d strains;  ///< (11, 22, 2 x 12)
};

Turn turn_to(const Surface& s, const Vector3& e_1, const Vector3& e_2) {
  // p(a, b) = e_a . g^b, g^b being the contravariant tangents.
  const Vector3 contra_1 = s.g_2.cross(s.n) / s.area, contra_2 = s.n.cross(s.g_1) / s.area;
  Turn turn;
  Eigen::Matrix2d& p = turn.vectors;
  p << e_1.dot(contra_1), e_1.dot(contra_2), e_2.dot(contra_1), e_2.dot(contra_2);
  turn.strains << p(0, 0) * p(0, 0), p(0, 1) * p(0, 1), p(0, 0) * p(0, 1),  //
      p(1, 0) * p(1, 0), p(1, 1) * p(1, 1), p(1, 0) * p(1, 1),              //
      2 * p(0, 0) * p(1, 0), 2 * p(0, 1) * p(1, 1), p(0, 0) * p(1, 1) + p(0, 1) * p(1, 0);
  return turn;
}

const auto tangents_flags = dealii::update_jacobians;
const auto curved_flags = dealii::update_jacobians | dealii::update_jacobian_grads;
const auto surface_flags = curved_flags | dealii::update_quadrature_points;

/// What the geometry at points of tied or mean strains has to tell: with offsets the curvature,
/// too.
dealii::UpdateFlags flags_of_strains(const Mesh& mesh) {
  const auto has_offset = [](const ShellSection& section) { return section.offset != 0; };
  return std::any_of(mesh.shell_sections.begin(), mesh.shell_sections.end(), has_offset)
             ? curved_flags
             : tangents_flags;
}

/// The surface as a mid-surface at an offset needs it.
Surface surface_for(double offset, const dealii::FEValues<2, 3>& values, unsigned q) {
  return offset != 0 ? surface_at(values, q) : tangents_at(values, q);
}

}  // namespace

/// Shape functions and geometry at points of a cell.
struct ShellOperator::Tabulation {
  Tabulation(const Space::Implementation& own, const Eigen::Matrix2Xd& points,
             dealii::UpdateFlags flags)
      : shapes(tabulate(own, points)),
        values(*own.shell_mapping, own.shell_element, quadrature_of(points), flags) {}
  std::vector<Shapes> shapes;
  dealii::FEValues<2, 3> values;
};

/// Strains that are taken at points of their own and interpolated.
struct ShellOperator::TiedStrains {
  TiedStrains(const Space& space, const std::vector<double>& x, const std::vector<double>& y,
              std::vector<ShellStrain> of, const Eigen::Matrix2Xd& wanted,
              const Eigen::Matrix2Xd& rule)
      : table(std::make_unique<Tabulation>(space.implementation(), grid(x, y),
                                           flags_of_strains(space.mesh()))),
        strains(std::move(of)),
        interpolation(weights(x, y, wanted)),
        to_rule(weights(x, y, rule)) {}
  static Eigen::Matrix2Xd grid(const std::vector<double>& x, const std::vector<double>& y) {
    Eigen::Matrix2Xd points(2, static_cast<Eigen::Index>(x.size() * y.size()));
    for (std::size_t j = 0; j < y.size(); ++j)
      for (std::size_t i = 0; i < x.size(); ++i) points.col(j * x.size() + i) << x[i], y[j];
    return points;
  }
  static Eigen::MatrixXd weights(const std::vector<double>& x, const std::vector<double>& y,
                                 const Eigen::Matrix2Xd& wanted) {
    Eigen::MatrixXd result(wanted.cols(), static_cast<Eigen::Index>(x.size() * y.size()));
    for (Eigen::Index q = 0; q < wanted.cols(); ++q) {
      const auto along_x = lagrange_at(x, wanted(0, q)), along_y = lagrange_at(y, wanted(1, q));
      for (std::size_t j = 0; j < y.size(); ++j)
        for (std::size_t i = 0; i < x.size(); ++i)
          result(q, static_cast<Eigen::Index>(j * x.size() + i)) = along_x[i] * along_y[j];
    }
    return result;
  }

  std::unique_ptr<Tabulation> table;
  std::vector<ShellStrain> strains;
  Eigen::MatrixXd interpolation;  ///< wanted points x points of the table
  Eigen::MatrixXd to_rule;        ///< points of the cell's rule x points of the table
};

/// Strains of a triangle along its sides.
struct ShellOperator::TriangleTies {
  TriangleTies(const Space& space, const Eigen::Matrix2Xd& wanted)
      : table(space.implementation(), places_on_triangle(), flags_of_strains(space.mesh())) {
    for (Eigen::Index q = 0; q < wanted.cols(); ++q) {
      to_stretches.push_back(shares_of_stretches(wanted(0, q), wanted(1, q)));
      to_shears.push_back(shares_of_shears(wanted(0, q), wanted(1, q)));
    }
  }

  /// The surface by r and s.
  static Surface on_triangle(Surface surface, double xi, double eta) {
    surface.g_1 /= 1 - eta;
    surface.dn_1 /= 1 - eta;
    surface.area /= 1 - eta;
    surface.g_2 += xi * surface.g_1;
    surface.dn_2 += xi * surface.dn_1;
    return surface;
  }

  /// A flat triangle cannot lock, and its own strains are exact about curved openings, too.
  bool is_flat() const {
    const Vector3 normal = tangents_at(table.values, 0).n;
    for (unsigned k = 1; k < table.values.n_quadrature_points; ++k)
      if ((tangents_at(table.values, k).n - normal).squaredNorm() > 1e-12) return false;
    return true;
  }

  Tabulation table;
  std::vector<Eigen::Matrix<double, 3, 9>> to_stretches;  ///< at the wanted points
  std::vector<Eigen::Matrix<double, 2, 8>> to_shears;
};

/// The cell's Gauss points, for means over it.
struct ShellOperator::Mean {
  explicit Mean(const Space& space)
      : rule(square_rule(space.degree() + 1)),
        table(space.implementation(), rule.topRows<2>(), flags_of_strains(space.mesh())) {}

  void reinit(const Vector3& along, double offset) {
    area = 0;
    to_mean.clear();
    surfaces.clear();
    for (Eigen::Index q = 0; q < rule.cols(); ++q) {
      surfaces.push_back(surface_for(offset, table.values, static_cast<unsigned>(q)));
      const auto [e_1, e_2] = unit_tangents(surfaces.back(), along);
      const double part = rule(2, q) * surfaces.back().area;
      to_mean.push_back(part * turn_to(surfaces.back(), e_1, e_2).strains);
      area += part;
    }
    for (Eigen::Matrix3d& matrix : to_mean) matrix /= area;
  }
  /// Is the cell a parallelogram?
  bool is_even() const {
    const Surface& first = surfaces.front();
    const double close = 1e-10 * (first.g_1.norm() + first.g_2.norm());
    return std::all_of(surfaces.begin(), surfaces.end(), [&](const Surface& s) {
      return (s.g_1 - first.g_1).norm() < close && (s.g_2 - first.g_2).norm() < close;
    });
  }

  Eigen::Matrix3Xd rule;
  Tabulation table;
  std::vector<Surface> surfaces;
  std::vector<Eigen::Matrix3d> to_mean;  ///< membrane strains' shares in their mean along e_1, e_2
  double area = 0;
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> strains;
  std::unique_ptr<TriangleTies> triangle;  ///< in place of means, of degree 2
};

ShellOperator::~ShellOperator() = default;

ShellOperator::ShellOperator(const Space& space, const Eigen::Matrix2Xd& points, Source source)
    : space_(space),
      has_ties_(source == Source::ties || space.degree() == 1),
      places_(points),
      points_(at(points.cols())),
      table_(std::make_unique<Tabulation>(space.implementation(), points, surface_flags)),
      mean_(std::make_unique<Mean>(space)) {
  const auto tie = [&](const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<ShellStrain>& strains) {
    ties_.emplace_back(space, x, y, strains, points, mean_->rule.topRows<2>());
    for (const ShellStrain strain : strains) is_tied_[strain] = true;
  };
  if (space.degree() == 1) {
    tie({0.5}, {0.0, 1.0}, {shear_1});
    tie({0.0, 1.0}, {0.5}, {shear_2});
  } else if (has_ties_) {
    const auto few = gauss_places(space.degree()), many = gauss_places(space.degree() + 1);
    tie(few, many, {membrane_11, shear_1});
    tie(many, few, {membrane_22, shear_2});
    tie(few, few, {membrane_12});
    if (space.degree() == 2) mean_->triangle = std::make_unique<TriangleTies>(space, points);
  }
}

void ShellOperator::reinit(int cell) {
  const auto& iterator = space_.implementation().shell_cells[cell];
  const ShellCell& located = space_.shells()[cell];
  const Shell& shell = space_.mesh().shells[located.shell];
  ties_membrane_ = space_.degree() == 1 || !shell.is_triangle();
  table_->values.reinit(iterator);
  for (TiedStrains& tie : ties_)
    if (is_used(tie)) tie.table->values.reinit(iterator);

  const double offset = space_.mesh().section_of(shell).offset;
  // One direction for the whole cell, so that components can be compared and averaged in it.
  const Vector3 along = space_.place(cell, {1, 0.5}) - space_.place(cell, {0, 0.5});
  // Triangles of degree 2 and above, and strains of the displacements, have no mean to give back.
  const bool has_mean = has_ties_ && ties_membrane_;
  if (has_mean) {
    mean_->table.values.reinit(iterator);
    mean_->reinit(along, offset);
  }

  static thread_local std::vector<Turn> turns;
  turns.clear();
  for (std::size_t q = 0; q < points_.size(); ++q) {
    const Surface surface = surface_at(table_->values, static_cast<unsigned>(q));
    ShellPoint& point = points_[q];
    point.strain.resize(shell_strains, 6 * space_.nodes_per_shell());
    for (int strain = 0; strain < shell_strains; ++strain)
      if (!is_tied(strain))
        covariant_strain(surface, table_->shapes[q], static_cast<ShellStrain>(strain), offset,
                         point.strain.row(strain));
    point.place = to_vector(table_->values.quadrature_point(static_cast<unsigned>(q)));
    point.normal = surface.n;
    std::tie(point.e_1, point.e_2) = unit_tangents(surface, along);
    point.area = surface.area;
    point.thickness =
        thickness_at(space_.mesh(), shell,
                     located.origin + located.size * places_.col(static_cast<Eigen::Index>(q)));
    turns.push_back(turn_to(surface, point.e_1, point.e_2));
  }
  const bool is_balanced = !has_mean || (space_.degree() > 1 && mean_->is_even());
  mean_->strains.resize(3, 0);
  if (!is_balanced) find_mean_strains(offset);
  tie_strains(offset);
  // Where a triangle is divided, cells away from the point are no triangles.
  if (mean_->triangle && !ties_membrane_ && located.origin.y() + located.size > 1 - 1e-9) {
    mean_->triangle->table.values.reinit(iterator);
    tie_sides_of_triangle(offset);
  }
  for (std::size_t q = 0; q < points_.size(); ++q) {
    Rows& strain = points_[q].strain;
    strain.middleRows<3>(membrane_11) =
        (turns[q].strains * strain.middleRows<3>(membrane_11)).eval();
    strain.middleRows<3>(curvature_11) =
        (turns[q].strains * strain.middleRows<3>(curvature_11)).eval();
    strain.middleRows<2>(shear_1) = (turns[q].vectors * strain.middleRows<2>(shear_1)).eval();
    // A bilinear cell that bends in its plane has shear that no beam has, whose mean is nothing.
    if (space_.degree() == 1)
      strain.row(membrane_12) = mean_->strains.row(2);
    else if (!is_balanced)
      strain.middleRows<3>(membrane_11) += mean_->strains;
  }
}

// The mean of the membrane strains as the displacements have them.
void ShellOperator::find_mean_strains(double offset) {
  static thread_local Eigen::RowVectorXd row;
  row.resize(6 * space_.nodes_per_shell());
  mean_->strains.setZero(3, row.size());
  for (std::size_t q = 0; q < mean_->surfaces.size(); ++q)
    for (const ShellStrain strain : {membrane_11, membrane_22, membrane_12}) {
      covariant_strain(mean_->surfaces[q], mean_->table.shapes[q], strain, offset, row);
      for (int i = 0; i < 3; ++i) mean_->strains.row(i) += mean_->to_mean[q](i, strain) * row;
    }
}

// Interpolates the tied strains, and takes their mean away from that of the displacements.
void ShellOperator::tie_strains(double offset) {
  static thread_local Eigen::RowVectorXd row;
  row.resize(6 * space_.nodes_per_shell());
  for (ShellPoint& point : points_)
    for (int strain = 0; strain < shell_strains; ++strain)
      if (is_tied(strain)) point.strain.row(strain).setZero();
  for (const TiedStrains& tie : ties_) {
    if (!is_used(tie)) continue;
    for (std::size_t k = 0; k < tie.table->shapes.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const Surface surface = surface_for(offset, tie.table->values, static_cast<unsigned>(k));
      for (const ShellStrain strain : tie.strains) {
        if (!is_tied(strain)) continue;
        covariant_strain(surface, tie.table->shapes[k], strain, offset, row);
        // Where both are Gauss points of one line most shares are nothing.
        for (std::size_t q = 0; q < points_.size(); ++q)
          if (const double share = tie.interpolation(static_cast<Eigen::Index>(q), column);
              share != 0)
            points_[q].strain.row(strain) += share * row;
        if (strain > membrane_12 || mean_->strains.cols() == 0) continue;
        Vector3 shares = Vector3::Zero();
        for (std::size_t q = 0; q < mean_->to_mean.size(); ++q)
          shares +=
              tie.to_rule(static_cast<Eigen::Index>(q), column) * mean_->to_mean[q].col(strain);
        for (int i = 0; i < 3; ++i) mean_->strains.row(i) -= shares[i] * row;
      }
    }
  }
}

// What the six nodes of a triangle strain, by shears and stretches of its sides, and what the ninth
// node adds.
void ShellOperator::tie_sides_of_triangle(double offset) {
  static thread_local Rows rows;
  static thread_local Eigen::Matrix<double, 9, Eigen::Dynamic, Eigen::RowMajor> stretches;
  static thread_local Eigen::Matrix<double, 8, Eigen::Dynamic, Eigen::RowMajor> shears;
  const Eigen::Index columns = points_.front().strain.cols();
  rows.resize(shell_strains, columns);
  stretches.resize(9, columns);
  shears.resize(8, columns);
  const TriangleTies& ties = *mean_->triangle;
  const bool is_flat = ties.is_flat();
  const auto find_strains = [&](const Surface& surface, const Shapes& shapes) {
    for (const ShellStrain strain : {membrane_11, membrane_22, membrane_12, shear_1, shear_2})
      if (!is_flat || strain >= shear_1)
        covariant_strain(surface, shapes, strain, offset, rows.row(strain));
  };
  constexpr std::array<double, 3> of_r{1, 0, -1}, of_s{0, 1, 1};  // along r, s and s - r
  const Eigen::Matrix2Xd& places = places_on_triangle();
  for (Eigen::Index k = 0; k < places.cols(); ++k) {
    const double xi = places(0, k), eta = places(1, k);
    find_strains(TriangleTies::on_triangle(
                     surface_for(offset, ties.table.values, static_cast<unsigned>(k)), xi, eta),
                 functions_of_triangle(xi * (1 - eta), eta));
    const Eigen::Index side = k / 3, on_side = k % 3;  // of the three sides, and the centroid
    if (side == 3)
      shears.bottomRows<2>() = rows.middleRows<2>(shear_1);
    else if (on_side < 2)
      shears.row(2 * side + on_side) =
          of_r[at(side)] * rows.row(shear_1) + of_s[at(side)] * rows.row(shear_2);
    if (is_flat || side == 3) continue;
    if (side < 2)
      stretches.row(k) = rows.row(side == 0 ? membrane_11 : membrane_22);
    else
      stretches.row(k) =
          (rows.row(membrane_11) + rows.row(membrane_22) - rows.row(membrane_12)) / 2;
  }
  for (std::size_t q = 0; q < points_.size(); ++q) {
    const Eigen::Vector2d place = places_.col(static_cast<Eigen::Index>(q));
    find_strains(surface_for(offset, table_->values, static_cast<unsigned>(q)),
                 beyond_triangle(table_->shapes[q], place.x(), place.y()));
    Rows& strain = points_[q].strain;
    strain.middleRows<2>(shear_1) = ties.to_shears[q] * shears + rows.middleRows<2>(shear_1);
    if (!is_flat)
      strain.middleRows<3>(membrane_11) =
          ties.to_stretches[q] * stretches + rows.middleRows<3>(membrane_11);
  }
}

bool ShellOperator::is_used(const TiedStrains& tie) const {
  return std::any_of(tie.strains.begin(), tie.strains.end(),
                     [&](ShellStrain strain) { return is_tied(strain); });
}

ShellStiffness::ShellStiffness(const Space& space)
    : space_(space),
      weights_(square_rule(space.degree() + 1).row(2)),
      operator_(space, square_rule(space.degree() + 1).topRows<2>()) {}

const Eigen::MatrixXd& ShellStiffness::operator()(int cell) {
  const Shell& shell = space_.mesh().shells[space_.shells()[cell].shell];
  operator_.reinit(cell);
  const std::vector<ShellPoint>& points = operator_.points();
  const bool is_uneven = shell.taper >= 0 || space_.mesh().section_of(shell).laminate >= 0;
  Eigen::Matrix<double, shell_strains, shell_strains> root;
  const Eigen::Index columns = points.front().strain.cols();
  // K = sum (root B)' (root B): half of the work of B' D B, and symmetric to the last digit.
  rooted_.resize(shell_strains * static_cast<Eigen::Index>(points.size()), columns);
  for (std::size_t q = 0; q < points.size(); ++q) {
    // An even plate of one material has one law, whatever its axes.
    if (q == 0 || is_uneven) {
      root = law_of_cell(space_, cell, points[q].e_1, points[q].e_2, points[q].thickness);
      root = root.llt().matrixU().toDenseMatrix();
    }
    rooted_.middleRows<shell_strains>(shell_strains * static_cast<Eigen::Index>(q)).noalias() =
        std::sqrt(weights_[q] * points[q].area) * (root * points[q].strain);
  }
  algebra::find_column_products(rooted_, stiffness_);
  return stiffness_;
}

Eigen::Matrix3Xd square_rule(int count) {
  const dealii::QGauss<2> rule(static_cast<unsigned>(count));
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(rule.size()));
  for (unsigned q = 0; q < rule.size(); ++q)
    points.col(q) << rule.point(q)[0], rule.point(q)[1], rule.weight(q);
  return points;
}

}  // namespace blocklift::structure
