#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/beams/sections.h"

namespace blocklift::structure {

/// Torsion and shear of an open or closed profile of thin walls, with any number of cells, by the
/// middle lines of its walls.
///
/// A flow q runs along the walls, as much into each node as out of it. Under a force of one it
/// grows along a wall by the first moment that the force needs; of all flows that there can be it
/// is the one of least energy, int q^2 / t ds, by which no cell twists. Under a torque it is even
/// along each wall.
/// Source: Timoshenko and Goodier (1970), sections 107, 115, 125; Pilkey (2002), chapters 5 and 7.
class ThinWalls {
 public:
  /// @throws ModelError if the walls hang together by no node.
  ThinWalls(std::vector<Eigen::Vector2d> nodes, const std::vector<Wall>& walls);

  /// J, m^4: T^2 / int q^2 / t ds of the flow in cells (Bredt), and l t^3 / 3 of walls that bound
  /// none.
  double torsion() const;
  /// 1 / int q^2 / t ds for a force of one along an axis, so that both strain energies agree, m^2;
  /// 0 if no wall carries it.
  double shear_area(int axis) const;
  /// From the origin in which the nodes were given, m.
  Eigen::Vector2d shear_centre() const;

  /// Where the stress of the walls is looked at, from the origin of the nodes, m: both ends of each
  /// wall, as far as its solid goes, and where a force's flow is largest between them, if that is
  /// not within a fiftieth of an end. Shear is q / t of the flows; torsion also has what runs
  /// opposite ways on the two faces of a wall that bounds no cell, 2 n T / J, so that either face
  /// has a point. A wall of a cell has one on its outer face, torsion's stress there being the mean
  /// through the wall.
  std::vector<SectionPoint> points() const;
  /// The same at the foot of a place on the nearest wall, on the face that it lies towards.
  SectionPoint point_at(const Eigen::Vector2d& place) const;

 private:
  /// At the start, in the middle and at the end of a wall: what runs along it is a quadratic.
  using Flow = std::array<double, 3>;

  /// What points need of all walls.
  struct Flows {
    Eigen::VectorXd torsion;  ///< flow along each wall for a twist of 1 / G, m
    std::array<std::vector<Flow>, 2> force;
    double torsion_constant = 0;  ///< m^4
  };

  Eigen::Vector2d start(const Wall& wall) const;
  Eigen::Vector2d end(const Wall& wall) const;
  double length(const Wall& wall) const;
  /// Twice the area that a wall sweeps from the centroid, m^2: the moment of a flow of one.
  double sweep(const Wall& wall) const;
  bool carries(int axis) const;
  double growth(int axis, const Eigen::Vector2d& point) const;
  /// Flows at the walls' starts: of least energy when `work` a flow of one does against each, and
  /// `given` runs into each node beside them.
  Eigen::VectorXd find_flows(const Eigen::VectorXd& work, const Eigen::VectorXd& given) const;
  std::vector<Flow> calc_flows(int axis) const;
  double moment(int axis) const;
  Eigen::VectorXd calc_torsion_flows() const;
  bool is_open(const Eigen::VectorXd& torsion_flows, std::size_t wall) const;
  double torsion_of(const Eigen::VectorXd& torsion_flows) const;
  Flows calc_all_flows() const;
  std::vector<double> places_on(const Wall& wall) const;
  /// @param share along the wall. @param side 1: on its left face, -1: on its right one.
  SectionPoint point_on(const Flows& flows, std::size_t wall, double share, int side) const;
  void require_one_piece() const;

  std::vector<Eigen::Vector2d> nodes_;  ///< from the centroid of the lines
  std::vector<Wall> walls_;
  Eigen::Vector2d centroid_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d tensor_ = Eigen::Matrix2d::Zero();  ///< second moments of the lines
};

}  // namespace blocklift::structure
