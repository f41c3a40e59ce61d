#include "structure/stress/shell_stress.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "algebra/products.h"
#include "parallel/threads.h"
#include "structure/formulation/shell_law.h"

namespace blocklift::structure {

namespace {

constexpr double farthest_in_triangle = 0.99;  // eta; at 1 lies the edge that is a point

Eigen::Matrix2Xd pulled_in(Eigen::Matrix2Xd points) {
  points.row(1) = points.row(1).cwiseMin(farthest_in_triangle);
  return points;
}

bool has_triangles(const Mesh& mesh) {
  return std::any_of(mesh.shells.begin(), mesh.shells.end(),
                     [](const Shell& shell) { return shell.is_triangle(); });
}

}  // namespace

ShellStress::ShellStress(const Space& space, const Eigen::Matrix2Xd& points)
    : space_(space),
      of_squares_at_(points),
      of_triangles_at_(pulled_in(points)),
      of_squares_(space, points) {
  if (points.cols() == 0 || !has_triangles(space.mesh())) return;
  // Ties along xi mean nothing near the edge that is a point, but those along the sides do.
  const auto source =
      space.degree() == 2 ? ShellOperator::Source::ties : ShellOperator::Source::displacements;
  of_triangles_ = std::make_unique<ShellOperator>(space, of_triangles_at_, source);
}

Eigen::MatrixXd ShellStress::of_all(int cell, const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                    const CellHeat* heat) {
  const Mesh& mesh = space_.mesh();
  const Shell& shell = mesh.shells[space_.shells()[cell].shell];
  current_ = of_triangles_ && shell.is_triangle() ? of_triangles_.get() : &of_squares_;
  const Eigen::Matrix2Xd& places =
      current_ == of_triangles_.get() ? of_triangles_at_ : of_squares_at_;
  current_->reinit(cell);
  const Eigen::MatrixXd local = motions_of_cell(space_, cell, motions);
  const auto count = static_cast<Eigen::Index>(points().size());
  Eigen::MatrixXd of_motions(shell_strains * count, local.rows());
  for (std::size_t q = 0; q < points().size(); ++q)
    of_motions.middleRows<shell_strains>(shell_strains * static_cast<Eigen::Index>(q)) =
        points()[q].strain;
  Eigen::MatrixXd strains(of_motions.rows(), motions.cols());
  algebra::multiply(of_motions, local, strains);
  Eigen::MatrixXd rows(shell_stress_rows * count, motions.cols());
  for (std::size_t q = 0; q < points().size(); ++q) {
    const auto strain =
        strains.middleRows<shell_strains>(shell_strains * static_cast<Eigen::Index>(q));
    auto here =
        rows.middleRows<shell_stress_rows>(shell_stress_rows * static_cast<Eigen::Index>(q));
    const double thickness = points()[q].thickness;
    // Forces and moments as an even plate of the thickness bears them; of layers, their mean.
    Eigen::Matrix<double, shell_strains, Eigen::Dynamic> forces =
        law_of_cell(space_, cell, points()[q].e_1, points()[q].e_2, thickness) * strain;
    if (heat != nullptr)
      forces.topRows<6>() -= heat->shell_forces(cell, places.col(static_cast<Eigen::Index>(q)),
                                                points()[q].e_1, points()[q].e_2, thickness);
    here.middleRows<3>(membrane_stress_11) = forces.middleRows<3>(membrane_11) / thickness;
    here.middleRows<3>(bending_stress_11) =
        forces.middleRows<3>(curvature_11) * (6 / (thickness * thickness));
    here.middleRows<2>(shear_stress_13) = forces.middleRows<2>(shear_1) / thickness;
  }
  return rows;
}

Eigen::MatrixXd motions_of_cell(const Space& space, int cell,
                                const Eigen::Ref<const Eigen::MatrixXd>& motions) {
  const int count = space.nodes_per_shell();
  const int* nodes = space.shell_nodes(cell);
  Eigen::MatrixXd local(6 * count, motions.cols());
  for (int i = 0; i < count; ++i)
    local.middleRows<6>(6 * i) = motions.middleRows<6>(6 * static_cast<Eigen::Index>(nodes[i]));
  return local;
}

Eigen::MatrixXd stresses_of_cells(const Space& space, const Eigen::Matrix2Xd& points, int first,
                                  int count, const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                  const CellHeat* heat) {
  const Eigen::Index per_cell = shell_stress_rows * points.cols();
  Eigen::MatrixXd rows(per_cell * count, motions.cols());
  parallel::in_batches(count, 64, 0, [&](int begin, int taken) {
    ShellStress recovery(space, points);
    for (int i = begin; i < begin + taken; ++i)
      rows.middleRows(per_cell * i, per_cell) = recovery.of_all(first + i, motions, heat);
  });
  return rows;
}

Eigen::MatrixXd stresses_at_side(const Eigen::MatrixXd& rows, double side) {
  const Eigen::Index points = rows.rows() / shell_stress_rows;
  Eigen::MatrixXd stresses = Eigen::MatrixXd::Zero(6 * points, rows.cols());
  for (Eigen::Index q = 0; q < points; ++q) {
    const auto here = rows.middleRows<shell_stress_rows>(shell_stress_rows * q);
    const auto along = [&](int c) {
      return here.row(membrane_stress_11 + c) + side * here.row(bending_stress_11 + c);
    };
    stresses.row(6 * q) = along(0);
    stresses.row(6 * q + 1) = along(1);
    stresses.row(6 * q + 3) = along(2);
  }
  return stresses;
}

double plane_von_mises(double s11, double s22, double s12) {
  return std::sqrt(s11 * s11 - s11 * s22 + s22 * s22 + 3 * s12 * s12);
}

PlateVonMises plate_von_mises(const Eigen::Ref<const Eigen::VectorXd>& rows) {
  const Eigen::Vector3d membrane = rows.segment<3>(membrane_stress_11),
                        top = membrane + rows.segment<3>(bending_stress_11),
                        bottom = membrane - rows.segment<3>(bending_stress_11);
  return {plane_von_mises(membrane[0], membrane[1], membrane[2]),
          plane_von_mises(top[0], top[1], top[2]),
          plane_von_mises(bottom[0], bottom[1], bottom[2])};
}

}  // namespace blocklift::structure
