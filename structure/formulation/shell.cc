#include "structure/formulation/shell.h"

#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

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
  Vector3 dn_1, dn_2;  ///< derivatives of the normal
  double area = 0;     ///< |g_1 x g_2|
};

Vector3 to_vector(const dealii::Tensor<1, 3>& t) { return {t[0], t[1], t[2]}; }

Surface surface_at(const dealii::FEValues<2, 3>& values, unsigned q) {
  const auto& jacobian = values.jacobian(q);
  const auto& second = values.jacobian_grad(q);
  const auto tangent = [&](unsigned a) {
    return Vector3(jacobian[0][a], jacobian[1][a], jacobian[2][a]);
  };
  const auto curve = [&](unsigned a, unsigned b) {
    return Vector3(second[0][a][b], second[1][a][b], second[2][a][b]);
  };
  Surface surface;
  surface.g_1 = tangent(0);
  surface.g_2 = tangent(1);
  const Vector3 across = surface.g_1.cross(surface.g_2);
  surface.area = across.norm();
  // Only the edge of a triangle that is a point has none; strains tied there carry no weight.
  if (!(surface.area > 0)) surface.area = 1e-300;
  surface.n = across / surface.area;
  const auto turn = [&](unsigned b) -> Vector3 {
    const Vector3 change =
        (curve(0, b).cross(surface.g_2) + surface.g_1.cross(curve(1, b))) / surface.area;
    return change - surface.n * surface.n.dot(change);
  };
  surface.dn_1 = turn(0);
  surface.dn_2 = turn(1);
  return surface;
}

/// Shape functions at a point and their derivatives by the unit coordinates.
struct Shapes {
  Eigen::RowVectorXd value, d_1, d_2;
};

std::vector<Shapes> tabulate(const Space::Implementation& own, const Eigen::Matrix2Xd& points) {
  const auto nodes = static_cast<Eigen::Index>(own.shell_order.size());
  std::vector<Shapes> shapes;
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    const dealii::Point<2> xi(points(0, q), points(1, q));
    Shapes at_point{Eigen::RowVectorXd(nodes), Eigen::RowVectorXd(nodes),
                    Eigen::RowVectorXd(nodes)};
    for (Eigen::Index i = 0; i < nodes; ++i) {
      const unsigned node = own.shell_order[at(i)];
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

/// Strains by the unit coordinates (covariant components), one row each of ShellStrain.
void covariant_strains(const Surface& s, const Shapes& shape, Rows& rows) {
  rows.setZero(shell_strains, 6 * shape.value.size());
  add(rows.row(membrane_11), shape.d_1, s.g_1, u);
  add(rows.row(membrane_22), shape.d_2, s.g_2, u);
  add(rows.row(membrane_12), shape.d_2, s.g_1, u);
  add(rows.row(membrane_12), shape.d_1, s.g_2, u);
  // g . (theta x n) = theta . (n x g)
  const Vector3 a_1 = s.n.cross(s.g_1), a_2 = s.n.cross(s.g_2);
  const auto curvature = [&](ShellStrain row, const Vector3& g, const Vector3& a,
                             const Vector3& dn_of_g, const Vector3& dn_along,
                             const Eigen::RowVectorXd& along) {
    add(rows.row(row), along, a, theta);
    add(rows.row(row), shape.value, dn_along.cross(g), theta);
    add(rows.row(row), along, dn_of_g, u);
  };
  curvature(curvature_11, s.g_1, a_1, s.dn_1, s.dn_1, shape.d_1);
  curvature(curvature_22, s.g_2, a_2, s.dn_2, s.dn_2, shape.d_2);
  curvature(curvature_12, s.g_1, a_1, s.dn_1, s.dn_2, shape.d_2);
  curvature(curvature_12, s.g_2, a_2, s.dn_2, s.dn_1, shape.d_1);
  add(rows.row(shear_1), shape.d_1, s.n, u);
  add(rows.row(shear_1), shape.value, a_1, theta);
  add(rows.row(shear_2), shape.d_2, s.n, u);
  add(rows.row(shear_2), shape.value, a_2, theta);
  add(rows.row(drilling), shape.value, s.n, theta);
  add(rows.row(drilling), shape.d_1, -s.g_2 / (2 * s.area), u);
  add(rows.row(drilling), shape.d_2, s.g_1 / (2 * s.area), u);
}

/// Turns covariant strains into those along the point's unit tangents.
void to_tangents(const Surface& s, ShellPoint& point) {
  // p(a, b) = e_a . g^b, g^b being the contravariant tangents.
  const Vector3 contra_1 = s.g_2.cross(s.n) / s.area, contra_2 = s.n.cross(s.g_1) / s.area;
  Eigen::Matrix2d p;
  p << point.e_1.dot(contra_1), point.e_1.dot(contra_2), point.e_2.dot(contra_1),
      point.e_2.dot(contra_2);
  Eigen::Matrix3d turn;                                             // of (11, 22, 2 x 12)
  turn << p(0, 0) * p(0, 0), p(0, 1) * p(0, 1), p(0, 0) * p(0, 1),  //
      p(1, 0) * p(1, 0), p(1, 1) * p(1, 1), p(1, 0) * p(1, 1),      //
      2 * p(0, 0) * p(1, 0), 2 * p(0, 1) * p(1, 1), p(0, 0) * p(1, 1) + p(0, 1) * p(1, 0);
  point.strain.middleRows<3>(membrane_11) = (turn * point.strain.middleRows<3>(membrane_11)).eval();
  point.strain.middleRows<3>(curvature_11) =
      (turn * point.strain.middleRows<3>(curvature_11)).eval();
  point.strain.middleRows<2>(shear_1) = (p * point.strain.middleRows<2>(shear_1)).eval();
}

std::vector<double> gauss_places(int count) {
  const dealii::QGauss<1> rule(static_cast<unsigned>(count));
  std::vector<double> places;
  for (const auto& point : rule.get_points()) places.push_back(point[0]);
  return places;
}

std::vector<double> lagrange_at(const std::vector<double>& places, double x) {
  std::vector<double> values(places.size(), 1);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places.size(); ++j)
      if (j != i) values[i] *= (x - places[j]) / (places[i] - places[j]);
  return values;
}

const auto geometry_flags =
    dealii::update_jacobians | dealii::update_jacobian_grads | dealii::update_quadrature_points;

}  // namespace

/// Shape functions and geometry at points of a cell.
struct ShellOperator::Tabulation {
  Tabulation(const Space::Implementation& own, const Eigen::Matrix2Xd& points)
      : shapes(tabulate(own, points)),
        values(*own.shell_mapping, own.shell_element, quadrature_of(points), geometry_flags) {}
  std::vector<Shapes> shapes;
  dealii::FEValues<2, 3> values;
};

/// Strains that are taken at points of their own and interpolated.
struct ShellOperator::TiedStrains {
  TiedStrains(const Space::Implementation& own, const std::vector<double>& x,
              const std::vector<double>& y, std::vector<ShellStrain> of,
              const Eigen::Matrix2Xd& wanted)
      : table(std::make_unique<Tabulation>(own, grid(x, y))), strains(std::move(of)) {
    interpolation.resize(wanted.cols(), static_cast<Eigen::Index>(x.size() * y.size()));
    for (Eigen::Index q = 0; q < wanted.cols(); ++q) {
      const auto along_x = lagrange_at(x, wanted(0, q)), along_y = lagrange_at(y, wanted(1, q));
      for (std::size_t j = 0; j < y.size(); ++j)
        for (std::size_t i = 0; i < x.size(); ++i)
          interpolation(q, static_cast<Eigen::Index>(j * x.size() + i)) = along_x[i] * along_y[j];
    }
  }
  static Eigen::Matrix2Xd grid(const std::vector<double>& x, const std::vector<double>& y) {
    Eigen::Matrix2Xd points(2, static_cast<Eigen::Index>(x.size() * y.size()));
    for (std::size_t j = 0; j < y.size(); ++j)
      for (std::size_t i = 0; i < x.size(); ++i)
        points.col(static_cast<Eigen::Index>(j * x.size() + i)) << x[i], y[j];
    return points;
  }

  std::unique_ptr<Tabulation> table;
  std::vector<ShellStrain> strains;
  Eigen::MatrixXd interpolation;  ///< wanted points x points of the table
};

ShellOperator::~ShellOperator() = default;

ShellOperator::ShellOperator(const Space& space, const Eigen::Matrix2Xd& points)
    : space_(space),
      points_(at(points.cols())),
      table_(std::make_unique<Tabulation>(space.implementation(), points)) {
  const Space::Implementation& own = space.implementation();
  if (space.degree() == 1) {
    ties_.emplace_back(own, std::vector{0.5}, std::vector{0.0, 1.0}, std::vector{shear_1}, points);
    ties_.emplace_back(own, std::vector{0.0, 1.0}, std::vector{0.5}, std::vector{shear_2}, points);
    ties_.emplace_back(own, gauss_places(2), gauss_places(2), std::vector<ShellStrain>{}, points);
  } else if (space.degree() == 2) {
    const auto two = gauss_places(2), three = gauss_places(3);
    ties_.emplace_back(own, two, three, std::vector{membrane_11, shear_1}, points);
    ties_.emplace_back(own, three, two, std::vector{membrane_22, shear_2}, points);
    ties_.emplace_back(own, two, two, std::vector{membrane_12}, points);
  }
}

void ShellOperator::reinit(int cell) {
  const Space::Implementation& own = space_.implementation();
  const auto& iterator = own.shell_cells[at(cell)];
  table_->values.reinit(iterator);
  for (TiedStrains& tie : ties_) tie.table->values.reinit(iterator);

  const Shell& shell = space_.mesh().shells[at(space_.shells()[at(cell)].shell)];
  const double offset = space_.mesh().section_of(shell).offset;
  // One direction for the whole cell, so that components can be compared and averaged in it.
  const Vector3 along = space_.place(cell, {1, 0.5}) - space_.place(cell, {0, 0.5});

  static thread_local std::vector<Surface> surfaces;
  surfaces.clear();
  for (std::size_t q = 0; q < points_.size(); ++q) {
    surfaces.push_back(surface_at(table_->values, static_cast<unsigned>(q)));
    const Surface& surface = surfaces.back();
    covariant_strains(surface, table_->shapes[q], points_[q].strain);
    ShellPoint& point = points_[q];
    point.place = to_vector(table_->values.quadrature_point(static_cast<unsigned>(q)));
    point.normal = surface.n;
    point.e_1 = (along - surface.n * surface.n.dot(along)).normalized();
    point.e_2 = surface.n.cross(point.e_1);
    point.area = surface.area;
  }
  tie_strains();
  for (std::size_t q = 0; q < points_.size(); ++q) to_tangents(surfaces[q], points_[q]);
  if (space_.degree() == 1) average_membrane_shear();
  if (offset != 0)
    for (ShellPoint& point : points_)
      point.strain.middleRows<3>(membrane_11) += offset * point.strain.middleRows<3>(curvature_11);
}

void ShellOperator::tie_strains() {
  static thread_local Rows rows;
  for (const TiedStrains& tie : ties_) {
    if (tie.strains.empty()) continue;
    for (ShellPoint& point : points_)
      for (const ShellStrain strain : tie.strains) point.strain.row(strain).setZero();
    for (std::size_t k = 0; k < tie.table->shapes.size(); ++k) {
      covariant_strains(surface_at(tie.table->values, static_cast<unsigned>(k)),
                        tie.table->shapes[k], rows);
      for (std::size_t q = 0; q < points_.size(); ++q)
        for (const ShellStrain strain : tie.strains)
          points_[q].strain.row(strain) +=
              tie.interpolation(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(k)) *
              rows.row(strain);
    }
  }
}

// The mean over the cell of the membrane shear along its direction: a bilinear cell that bends in its plane
// has shear that no beam has, whose mean is nothing.
void ShellOperator::average_membrane_shear() {
  const Tabulation& table = *ties_.back().table;
  ShellPoint mean = points_.front();
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(mean.strain.cols());
  double area = 0;
  for (std::size_t k = 0; k < table.shapes.size(); ++k) {
    const Surface surface = surface_at(table.values, static_cast<unsigned>(k));
    ShellPoint point;
    covariant_strains(surface, table.shapes[k], point.strain);
    point.e_1 = (mean.e_1 - surface.n * surface.n.dot(mean.e_1)).normalized();
    point.e_2 = surface.n.cross(point.e_1);
    to_tangents(surface, point);
    sum += surface.area * point.strain.row(membrane_12);
    area += surface.area;
  }
  for (ShellPoint& point : points_) point.strain.row(membrane_12) = sum / area;
}

Eigen::Matrix<double, shell_strains, shell_strains> shell_stiffness_law(const Material& material,
                                                                        double thickness) {
  const double e = material.youngs_modulus, nu = material.poisson_ratio, t = thickness,
               g = material.shear_modulus();
  Eigen::Matrix3d plane;
  plane << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  plane *= e / (1 - nu * nu);
  Eigen::Matrix<double, shell_strains, shell_strains> law;
  law.setZero();
  law.block<3, 3>(membrane_11, membrane_11) = t * plane;
  law.block<3, 3>(curvature_11, curvature_11) = t * t * t / 12 * plane;
  law(shear_1, shear_1) = law(shear_2, shear_2) = 5.0 / 6 * g * t;
  law(drilling, drilling) = g * t;
  return law;
}

ShellStiffness::ShellStiffness(const Space& space)
    : space_(space),
      weights_(square_rule(space.degree() + 1).row(2)),
      operator_(space, square_rule(space.degree() + 1).topRows<2>()) {}

const Eigen::MatrixXd& ShellStiffness::operator()(int cell) {
  const Shell& shell = space_.mesh().shells[at(space_.shells()[at(cell)].shell)];
  const Eigen::Matrix<double, shell_strains, shell_strains> root =
      shell_stiffness_law(space_.mesh().material_of(shell),
                          space_.mesh().section_of(shell).thickness)
          .llt()
          .matrixU();
  operator_.reinit(cell);
  const std::vector<ShellPoint>& points = operator_.points();
  const Eigen::Index columns = points.front().strain.cols();
  // K = sum (root B)' (root B): half of the work of B' D B, and symmetric to the last digit.
  rooted_.resize(shell_strains * static_cast<Eigen::Index>(points.size()), columns);
  for (std::size_t q = 0; q < points.size(); ++q)
    rooted_.middleRows<shell_strains>(shell_strains * static_cast<Eigen::Index>(q)).noalias() =
        std::sqrt(weights_[static_cast<Eigen::Index>(q)] * points[q].area) *
        (root * points[q].strain);
  stiffness_.setZero(columns, columns);
  stiffness_.selfadjointView<Eigen::Lower>().rankUpdate(rooted_.transpose());
  stiffness_.triangularView<Eigen::StrictlyUpper>() = stiffness_.transpose();
  return stiffness_;
}

Eigen::Matrix3Xd square_rule(int count) {
  const dealii::QGauss<2> rule(static_cast<unsigned>(count));
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(rule.size()));
  for (unsigned q = 0; q < rule.size(); ++q)
    points.col(static_cast<Eigen::Index>(q)) << rule.point(q)[0], rule.point(q)[1], rule.weight(q);
  return points;
}

}  // namespace blocklift::structure
