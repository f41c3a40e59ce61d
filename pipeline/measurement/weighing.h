#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace blocklift::pipeline {

/// The load at one instant at rest: what each rope pulls with, and where.
struct WeighingInstant {
  double time = 0;                        ///< s
  Eigen::Matrix3d R_WB;                   ///< attitude of the load
  std::vector<Eigen::Vector3d> force_W;   ///< of each rope on the load, as its cell reads it, N
  std::vector<Eigen::Vector3d> moment_W;  ///< about the origin of the load's frame, N m
};

/// Mass and centre of mass that hold the balance of measured forces best.
struct Weighing {
  double mass = 0;                                              ///< kg
  double mass_deviation = 0;                                    ///< standard deviation, kg
  Eigen::Vector3d centre_of_mass_B = Eigen::Vector3d::Zero();   ///< m
  Eigen::Vector3d centre_deviation = Eigen::Vector3d::Zero();   ///< standard deviations, m
  Eigen::Matrix3d centre_covariance = Eigen::Matrix3d::Zero();  ///< m^2
  /// A load that keeps its attitude leaves open how high the centre of mass is: it lies on a line
  /// in this direction (of unit length) through the point above. As weigh() gives it, that is the
  /// line's point nearest to the origin of the load's frame, and deviations are across the line.
  std::optional<Eigen::Vector3d> open_direction_B;
  /// Coordinate of the centre of mass (0, 1, 2) that is most along that line; none without a line.
  std::optional<Eigen::Index> open_coordinate() const;
  bool leaves_open(Eigen::Index coordinate) const { return open_coordinate() == coordinate; }
  /// The same with the point of the line whose open coordinate is this one, m, and the deviations
  /// of the other two there: what may be held against a centre of mass that is known otherwise.
  /// It is itself where nothing is open.
  Weighing with_open_coordinate(double value) const;
  double force_residual = 0;  ///< rms of what the vertical balance leaves, N
};

/// Solves m g = sum of vertical forces and R_WB (m c) x (0, 0, g) = the horizontal moments, in the
/// sense of least squares, for the mass m and its first moments m c. It is linear in these four.
///
/// Deviations come from the scatter, by ten stretches of the instants taken as independent
/// (sandwich estimate, so that correlation within a stretch does no harm), and from the cells: each
/// errs by a share of its own, one over all instants.
/// @param cell_accuracy standard deviation of a cell's scale, a share
/// @returns none for less than 20 instants.
std::optional<Weighing> weigh(const std::vector<WeighingInstant>& instants, double gravity,
                              double cell_accuracy);

}  // namespace blocklift::pipeline
