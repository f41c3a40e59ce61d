#include "structure/elasticity/load.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"

namespace blocklift::structure {

namespace {

Eigen::Matrix3d cross_matrix(const Vector3& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Calls visit(cell, quadrature point, place, volume weight) for all Gauss points.
void for_each_point(const HexMesh& mesh, int cells, const Eigen::Matrix4Xd& rule,
                    const std::function<void(int, Eigen::Index, const Vector3&, double)>& visit) {
  for (int cell = 0; cell < cells; ++cell)
    for (Eigen::Index q = 0; q < rule.cols(); ++q) {
      const Vector3 xi = rule.col(q).head<3>();
      visit(cell, q, position(mesh, cell, xi), rule(3, q) * jacobian(mesh, cell, xi).determinant());
    }
}

Eigen::Matrix4Xd cube_rule(int points) {
  const auto line = gauss_points(points);
  return tensor_rule(line, line, line);
}

}  // namespace

namespace {

MassMoments integrate_mass(const HexMesh& mesh, int cells,
                           const std::function<double(const Vector3&)>& factor) {
  MassMoments moments;
  for_each_point(mesh, cells, cube_rule(4),
                 [&](int cell, Eigen::Index, const Vector3& x, double volume) {
                   const double mass = volume * mesh.material_of_cell(cell).density * factor(x);
                   moments.add(mass, x);
                 });
  return moments;
}

}  // namespace

MassProperties find_mass_properties(const HexMesh& mesh, const Discretisation& space,
                                    const double* stated_mass, const Vector3* stated_centre) {
  const int cells = space.cell_count();
  const MassMoments steel = integrate_mass(mesh, cells, [](const Vector3&) { return 1.0; });
  if (!(steel.mass > 0)) throw ModelError("the block has no mass; give its materials a density");
  MassProperties result;
  result.steel_mass = steel.mass;
  result.steel_centre_B = steel.first / steel.mass;
  const double mass = stated_mass ? *stated_mass : steel.mass;
  const Vector3 centre = stated_centre ? *stated_centre : result.steel_centre_B;
  if (!(std::isfinite(mass) && mass > 0))
    throw ModelError(
        fmt::format("the block's mass is stated as {:g} kg; it must be positive", mass));
  const Eigen::Matrix3d spread =
      steel.second - steel.mass * result.steel_centre_B * result.steel_centre_B.transpose();
  result.factor_alpha = mass / steel.mass;
  result.factor_beta = spread.ldlt().solve(mass * (centre - result.steel_centre_B));
  result.smallest_density_factor = std::numeric_limits<double>::infinity();
  result.largest_density_factor = -std::numeric_limits<double>::infinity();
  Vector3 worst = Vector3::Zero();
  for (const Vector3& x : mesh.vertices) {
    const double factor = result.density_factor(x);
    if (factor < result.smallest_density_factor) worst = x;
    result.smallest_density_factor = std::min(result.smallest_density_factor, factor);
    result.largest_density_factor = std::max(result.largest_density_factor, factor);
  }
  if (result.smallest_density_factor < 0)
    throw ModelError(fmt::format(
        "no spread of outfitting makes the stated mass {:.1f} t and centre of mass ({:.3f}, "
        "{:.3f}, "
        "{:.3f}) m out of the plates' {:.1f} t at ({:.3f}, {:.3f}, {:.3f}) m: the density would be "
        "negative at ({:.2f}, {:.2f}, {:.2f}) m; move the stated centre towards the plates', or "
        "state more mass",
        mass / 1e3, centre.x(), centre.y(), centre.z(), steel.mass / 1e3, result.steel_centre_B.x(),
        result.steel_centre_B.y(), result.steel_centre_B.z(), worst.x(), worst.y(), worst.z()));
  const MassMoments all =
      integrate_mass(mesh, cells, [&](const Vector3& x) { return result.density_factor(x); });
  result.mass = all.mass;
  result.centre_of_mass_B = all.first / all.mass;
  result.outfitting_mass = result.mass - result.steel_mass;
  const Eigen::Matrix3d second =
      all.second - all.mass * result.centre_of_mass_B * result.centre_of_mass_B.transpose();
  result.inertia_BBcm_B = second.trace() * Eigen::Matrix3d::Identity() - second;
  return result;
}

NodalMoments nodal_moments(const HexMesh& mesh, const Discretisation& space,
                           const std::function<double(int, const Vector3&)>& density) {
  std::vector<int> cells(static_cast<std::size_t>(space.cell_count()));
  std::iota(cells.begin(), cells.end(), 0);
  return nodal_moments(mesh, space, cells, density);
}

NodalMoments nodal_moments(const HexMesh& mesh, const Discretisation& space,
                           const std::vector<int>& cells,
                           const std::function<double(int, const Vector3&)>& density) {
  NodalMoments moments = NodalMoments::Zero(space.node_count(), 4);
  // Exact for a density linear in x: shape p, place 1, density 1 and Jacobian determinant 2 make
  // degree p + 4 along an axis, which n points integrate up to 2n - 1.
  const auto rule = cube_rule((space.element.degree() + 6) / 2);
  const Eigen::MatrixXd shapes = space.element.values(rule.topRows<3>());
  Eigen::Matrix<double, Eigen::Dynamic, 4> weights(rule.cols(), 4);
  for (const int cell : cells) {
    for (Eigen::Index q = 0; q < rule.cols(); ++q) {
      const Vector3 xi = rule.col(q).head<3>(), x = position(mesh, cell, xi);
      const double rho = density(cell, x);
      const double weight =
          rho == 0 ? 0 : rho * rule(3, q) * jacobian(mesh, cell, xi).determinant();
      weights.row(q) << weight, weight * x.transpose();
    }
    if (weights.isZero(0)) continue;
    const Eigen::MatrixXd local = shapes.transpose() * weights;
    for (int i = 0; i < space.nodes_per_cell; ++i) moments.row(space.node(cell, i)) += local.row(i);
  }
  return moments;
}

Eigen::MatrixXd inertia_loads(const NodalMoments& m) {
  const Eigen::Index nodes = m.rows();
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(3 * nodes, 12);
  // Products w_ij as matrices W: the field is W r - tr(W) r.
  const int first[6] = {0, 1, 2, 0, 1, 2}, second[6] = {0, 1, 2, 1, 2, 0};
  for (Eigen::Index n = 0; n < nodes; ++n) {
    const Vector3 moment = m.row(n).tail<3>();
    for (int a = 0; a < 3; ++a) {
      loads(3 * n + a, a) = -m(n, 0);
      loads.block<3, 1>(3 * n, 3 + a) = -Vector3::Unit(a).cross(moment);
    }
    for (int p = 0; p < 6; ++p) {
      Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
      product(first[p], second[p]) = product(second[p], first[p]) = 1;
      loads.block<3, 1>(3 * n, 6 + p) = -(product * moment - product.trace() * moment);
    }
  }
  return loads;
}

void add_spread_wrenches(const NodalMoments& moments, const Eigen::Matrix3Xd& nodes,
                         const Vector3& point, const Eigen::MatrixXd& wrenches,
                         Eigen::Ref<Eigen::MatrixXd> loads) {
  const double volume = moments.col(0).sum();
  if (!(volume > 0)) throw ModelError("a force has no volume to be spread over");
  // Nodal force of c and d: w c + d x s with s = int N (x - point) dV.
  Eigen::Matrix<double, 6, 6> balance = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<Eigen::Index> loaded;
  for (Eigen::Index n = 0; n < moments.rows(); ++n) {
    if (moments.row(n).isZero(0)) continue;
    loaded.push_back(n);
    const double w = moments(n, 0);
    const Eigen::Matrix3d s = cross_matrix(moments.row(n).tail<3>().transpose() - w * point);
    const Eigen::Matrix3d arm = cross_matrix(nodes.col(n) - point);
    balance.topLeftCorner<3, 3>() += w * Eigen::Matrix3d::Identity();
    balance.topRightCorner<3, 3>() -= s;
    balance.bottomLeftCorner<3, 3>() += w * arm;
    balance.bottomRightCorner<3, 3>() -= arm * s;
  }
  const Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> solver(balance);
  Eigen::MatrixXd cd = solver.solve(wrenches);
  cd += solver.solve(wrenches - balance * cd);
  for (const Eigen::Index n : loaded) {
    const double w = moments(n, 0);
    const Vector3 s = moments.row(n).tail<3>().transpose() - w * point;
    loads.middleRows<3>(3 * n) += w * cd.topRows<3>() - cross_matrix(s) * cd.bottomRows<3>();
  }
}

Eigen::MatrixXd pin_loads(const NodalMoments& moments, const Eigen::Matrix3Xd& nodes,
                          const Vector3& pin) {
  if (!(moments.col(0).sum() > 0))
    throw ModelError("a lug has no volume to spread its rope's force over");
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(3 * moments.rows(), 3);
  const Eigen::Matrix<double, 6, 3> forces = Eigen::Matrix<double, 6, 3>::Identity();
  add_spread_wrenches(moments, nodes, pin, forces, loads);
  return loads;
}

Eigen::VectorXd body_load(const HexMesh& mesh, const Discretisation& space,
                          const std::function<Vector3(const Vector3&)>& force_density, int extra) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.unknowns());
  const auto rule = cube_rule(space.element.degree() + 1 + extra);
  const Eigen::MatrixXd shapes = space.element.values(rule.topRows<3>());
  for_each_point(mesh, space.cell_count(), rule,
                 [&](int cell, Eigen::Index q, const Vector3& x, double volume) {
                   const Vector3 force = volume * force_density(x);
                   for (int i = 0; i < space.nodes_per_cell; ++i)
                     load.segment<3>(3 * space.node(cell, i)) += shapes(q, i) * force;
                 });
  return load;
}

Eigen::VectorXd traction_load(
    const HexMesh& mesh, const Discretisation& space,
    const std::function<bool(const Vector3&, const Vector3&)>& selects,
    const std::function<Vector3(const Vector3&, const Vector3&)>& traction) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.unknowns());
  const auto line = gauss_points(space.element.degree() + 2);
  std::array<Eigen::Matrix4Xd, 6> rules;
  std::array<Eigen::MatrixXd, 6> shapes;
  for (std::size_t face = 0; face < 6; ++face) {
    Eigen::Matrix2Xd end(2, 1);
    end << static_cast<double>(face % 2), 1;
    rules[face] = tensor_rule(face / 2 == 0 ? end : line, face / 2 == 1 ? end : line,
                              face / 2 == 2 ? end : line);
    shapes[face] = space.element.values(rules[face].topRows<3>());
  }
  for (const auto& [cell, face_number] : boundary_faces(mesh)) {
    const std::size_t face = at(face_number);
    const auto normal_at = [&, c = cell](const Vector3& xi) -> Vector3 {  // times area
      const Eigen::Matrix3d edges = jacobian(mesh, c, xi);
      const int a = static_cast<int>(face / 2);
      return (face % 2 ? 1.0 : -1.0) * edges.col((a + 1) % 3).cross(edges.col((a + 2) % 3));
    };
    Vector3 middle = Vector3::Constant(0.5);
    middle[static_cast<int>(face / 2)] = static_cast<double>(face % 2);
    if (!selects(position(mesh, cell, middle), normal_at(middle).normalized())) continue;
    for (Eigen::Index q = 0; q < rules[face].cols(); ++q) {
      const Vector3 xi = rules[face].col(q).head<3>(), normal = normal_at(xi);
      const Vector3 force = rules[face](3, q) * normal.norm() *
                            traction(position(mesh, cell, xi), normal.normalized());
      for (int i = 0; i < space.nodes_per_cell; ++i)
        load.segment<3>(3 * space.node(cell, i)) += shapes[face](q, i) * force;
    }
  }
  return load;
}

Wrench resultant(const Eigen::Matrix3Xd& nodes, const Eigen::Ref<const Eigen::VectorXd>& load) {
  Wrench sum;
  for (Eigen::Index n = 0; n < nodes.cols(); ++n) {
    const Vector3 force = load.segment<3>(3 * n);
    sum.force += force;
    sum.moment += nodes.col(n).cross(force);
  }
  return sum;
}

}  // namespace blocklift::structure
