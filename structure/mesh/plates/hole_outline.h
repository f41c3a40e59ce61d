#pragma once

#include <vector>

#include <Eigen/Core>

namespace blocklift::structure {

/// Closed curve of straight pieces and arcs in a plane, anticlockwise, m.
class HoleOutline {
 public:
  /// Rectangle whose corners are rounded by a radius: a circle or a slot where the radius is half
  /// of the sides or of the shorter one.
  /// @throws ModelError if the radius does not fit into the rectangle.
  static HoleOutline rounded(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper,
                             double radius);
  /// @param corners in order, either way round.
  /// @throws ModelError if there are fewer than three, two are one, or not all sides can be seen
  ///   from the polygon's centre.
  static HoleOutline polygon(std::vector<Eigen::Vector2d> corners);

  int pieces() const { return static_cast<int>(pieces_.size()); }
  /// Point at a share (0 to 1) of a piece's length.
  Eigen::Vector2d point(int piece, double share) const;
  bool is_straight(int piece) const { return !(pieces_[piece].radius > 0); }
  const Eigen::Vector2d& lower() const { return lower_; }
  const Eigen::Vector2d& upper() const { return upper_; }
  /// Of the rectangle or of the polygon's area: all points can be seen from here.
  const Eigen::Vector2d& centre() const { return centre_; }
  double area() const { return area_; }

 private:
  /// A line from start to end, or an arc about its centre.
  struct Piece {
    Eigen::Vector2d start, end, centre;
    double radius = 0;
    double first_angle = 0, angle = 0;  ///< rad
  };

  std::vector<Piece> pieces_;
  Eigen::Vector2d lower_, upper_, centre_;
  double area_ = 0;
};

/// Which of the points around a hole the start of each of its pieces belongs to: as near as
/// possible by the directions from its centre, ascending round the hole, no two the same.
/// @param around anticlockwise, at least as many as the outline has pieces.
std::vector<int> match_corners(const HoleOutline& outline,
                               const std::vector<Eigen::Vector2d>& around);

}  // namespace blocklift::structure
