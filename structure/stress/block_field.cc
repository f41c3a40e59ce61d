#include "structure/stress/block_field.h"

#include <optional>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/stress/shell_stress.h"

namespace blocklift::structure {

SteelFinder::SteelFinder(const Space& space) : plates_(space.mesh()), cells_(space) {}

SteelPlace SteelFinder::find(const Vector3& place, const Vector3& normal) const {
  SteelPlace found;
  const std::optional<PlatePlace> plate = plates_.find(place, normal);
  if (!plate) return found;
  static_cast<CellPlace&>(found) = cells_.find(*plate);
  found.height = plate->height;
  return found;
}

SteelPlace find_cell(const Space& space, const Vector3& place) {
  return SteelFinder(space).find(place);
}

Eigen::MatrixXd displacements_at(const ElasticModel& model,
                                 const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                 const Eigen::Matrix3Xd& places, const Vector3& normal) {
  return displacements_of_arms(model, motions, places, places, normal);
}

Eigen::MatrixXd displacements_of_arms(const ElasticModel& model,
                                      const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                      const Eigen::Matrix3Xd& feet, const Eigen::Matrix3Xd& points,
                                      const Vector3& normal) {
  const Space& space = model.space();
  const SteelFinder finder(space);
  Eigen::MatrixXd result(3 * feet.cols(), motions.cols());
  for (Eigen::Index p = 0; p < feet.cols(); ++p) {
    const SteelPlace place = finder.find(feet.col(p), normal);
    if (place.cell < 0)
      throw ModelError(
          fmt::format("there is no material of the block at ({:.6g}, {:.6g}, {:.6g}) m", feet(0, p),
                      feet(1, p), feet(2, p)));
    const Eigen::VectorXd values = space.shell_values(place.xi);
    const int* nodes = space.shell_nodes(place.cell);
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(6, motions.cols());
    for (int i = 0; i < space.nodes_per_shell(); ++i)
      moved += values[i] * motions.middleRows<6>(6 * static_cast<Eigen::Index>(nodes[i]));
    const Vector3 arm = points.col(p) - space.place(place.cell, place.xi);
    for (Eigen::Index k = 0; k < motions.cols(); ++k)
      result.block<3, 1>(3 * p, k) =
          moved.col(k).head<3>() + Vector3(moved.col(k).tail<3>()).cross(arm);
  }
  return result;
}

Eigen::MatrixXd stresses_at(const ElasticModel& model,
                            const Eigen::Ref<const Eigen::MatrixXd>& motions,
                            const SteelPlace& place) {
  const Space& space = model.space();
  ShellStress stress(space, place.xi);
  const Eigen::MatrixXd rows = stress.of_all(place.cell, motions);
  const ShellPoint& point = stress.points().front();
  const double share = 2 * place.height / point.thickness;
  Eigen::Matrix3d axes;
  axes << point.e_1, point.e_2, point.normal;
  Eigen::MatrixXd result(6, motions.cols());
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    const Eigen::Vector3d in_plane = rows.col(k).segment<3>(membrane_stress_11) +
                                     share * rows.col(k).segment<3>(bending_stress_11);
    const Eigen::Vector2d across =
        1.5 * (1 - share * share) * rows.col(k).segment<2>(shear_stress_13);
    Eigen::Matrix3d local;
    local << in_plane[0], in_plane[2], across[0],  //
        in_plane[2], in_plane[1], across[1],       //
        across[0], across[1], 0;
    const Eigen::Matrix3d s = axes * local * axes.transpose();
    result.col(k) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0);
  }
  return result;
}

}  // namespace blocklift::structure
