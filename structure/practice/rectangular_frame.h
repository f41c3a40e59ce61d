#pragma once

#include <array>
#include <vector>

#include <Eigen/Dense>

#include "algebra/factors.h"
#include "structure/practice/column.h"

namespace blocklift::structure {

/// One side of a frame: a straight bar of closed section, which also twists.
struct FrameMember {
  Column column;                ///< its axis y level, z upright; as long as between the corners
  double torsion_constant = 0;  ///< J, m^4
  double torsion_modulus = 0;  ///< torsion moment over the largest shear stress that it causes, m^3
};

/// The largest of what is within one side of a frame, each by itself. Of a side that is pressed
/// nowhere the compression is its largest pull, negative.
struct MemberForces {
  ColumnForces column;
  double torsion = 0;  ///< N m
};

/// A force at a point, both in the frame's axes.
struct PointForce {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d f = Eigen::Vector3d::Zero();  ///< N
};

/// What a side bears over what it may bear, all forces having been multiplied by a factor: u of
/// column_utilisation, and torsion by its largest shear stress tau as EN 1993-1-1, 6.2.1(5) and
/// 6.2.7(4) have it, sqrt(u^2 + 3 (tau / f_y)^2).
double member_utilisation(const FrameMember& member, const MemberForces& forces, double factor);

/// Level rectangular frame of four bars that are rigidly joined at their corners, free in space.
///
/// Its axes stand in its middle, x along the sides of `length`, y along those of `width`, z up. The
/// corners 1 to 4 run anticlockwise from (-x, -y), seen from above; side i leads from corner i to
/// the next. A closed ring is six times statically indeterminate: the forces within follow from the
/// stiffness of its sides in tension, bending (Euler and Bernoulli) and torsion, G = E / 2.6
/// (Przemieniecki 1968, section 5.6), exactly for loads at points and loads linear along a side.
///
/// As columns the sides are pinned at their corners. That is no less than the frame as a whole
/// bears under slings that run to one point over its middle: it may also buckle in its plane into
/// a parallelogram, which its corners' stiffness holds. With k = E I / l of sides 1 and 2, N_1 the
/// compression of side 1, and corners F (L, W) / D, D^2 = L^2 + W^2, pulled to the middle, the pull
/// does the work N_1 L W^2 / D^2 psi^2 in a shear psi and the sides store
/// 12 psi^2 / (1 / k_1 + 1 / k_2), so that N_1 = 12 / (1 / k_1 + 1 / k_2) D^2 / (L W^2). Of the two
/// Euler loads pi^2 k_1 / L and pi^2 k_2 L / W^2, told as N_1, this is at least the smaller times
/// 12 / pi^2 (pi^2 with what compression takes from the sides' stiffness, where both are equal).
class RectangularFrame {
 public:
  /// @param along the sides 1 and 3, across the sides 2 and 4, whose columns' lengths are the
  ///   frame's. @param points where forces may act; each acts on the place of the frame's axes next
  ///   to it, with the moment that it has there.
  /// @throws std::invalid_argument for lengths, areas or moments that are not positive.
  RectangularFrame(const FrameMember& along, const FrameMember& across,
                   const std::vector<Eigen::Vector3d>& points);

  /// The largest forces within the sides 1 to 4 under those forces, one for each of the points.
  /// Weight and inertia are those of sides that are as heavy as their section is large: a load
  /// along them that balances forces and moments exactly, as of a body that accelerates, so that no
  /// acceleration is asked for. What turning fast does (centrifugal forces) is left out.
  std::array<MemberForces, 4> largest_forces(const std::vector<PointForce>& forces) const;

  /// How its points move under forces at them, 3 rows and columns a point, m/N, against the mean
  /// rigid motion of its corners, on which loads alike at all four keep forces in balance that are
  /// not.
  ///
  /// Corners pressed up and down by turns, +P, -P, +P, -P, move by w, sides bent antisymmetrically
  /// and twisted: P / w = (4 / L^2) / (L / (6 E I_1) + W / (2 G J_2)) + (4 / W^2) / (W / (6 E I_2)
  /// + L / (2 G J_1)), I about the level axis, by slope and deflection (Timoshenko, Strength of
  /// materials I, 1955), each corner's bending moment of one side being the other's torque.
  /// @param points those that it was made with, in their order; each moves with its place of the
  ///   frame as if by a rigid arm.
  /// @throws std::invalid_argument for another number of points.
  Eigen::MatrixXd flexibility(const std::vector<Eigen::Vector3d>& points) const;

  const FrameMember& member(std::size_t side) const { return side % 2 == 0 ? along_ : across_; }

  /// The corners in the order of their numbers, z = 0.
  static std::array<Eigen::Vector3d, 4> corners(double length, double width);

 private:
  using Matrix12 = Eigen::Matrix<double, 12, 12>;
  using Vector12 = Eigen::Matrix<double, 12, 1>;

  /// A stretch of a side between two nodes.
  struct Stretch {
    std::size_t side = 0;
    std::size_t first = 0, last = 0;  ///< nodes
    double length = 0;
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< its columns: along, level across, up
    Matrix12 stiffness = Matrix12::Zero();            ///< in its own axes
  };

  /// Load along a stretch in its own axes, linear from its start on, N/m and N/m^2.
  struct LineLoad {
    Eigen::Vector3d even = Eigen::Vector3d::Zero();
    Eigen::Vector3d rising = Eigen::Vector3d::Zero();
  };

  /// Acceleration of a rigid frame in which loads along it balance the forces, times its mass.
  struct Balance {
    Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  };

  void add_nodes(const std::vector<Eigen::Vector3d>& points);
  void add_stretches();
  Balance balance(const std::vector<PointForce>& forces) const;
  Eigen::MatrixXd at_corners_alike(const Eigen::MatrixXd& loads) const;
  LineLoad line_load(const Stretch& stretch, const Balance& balance) const;
  Vector12 displacements(const Stretch& stretch, const Eigen::VectorXd& all) const;
  void take_largest(const Stretch& stretch, const LineLoad& load, const Vector12& ends,
                    MemberForces& largest) const;

  FrameMember along_, across_;
  std::vector<Eigen::Vector3d> nodes_;  ///< around the frame, the first a corner
  std::vector<std::size_t> side_of_;    ///< the side on which a node stands or that begins there
  std::vector<std::size_t> node_of_;    ///< of each point
  std::vector<Stretch> stretches_;
  algebra::SymmetricFactors held_;  ///< of all nodes but the first, which is held
};

}  // namespace blocklift::structure
