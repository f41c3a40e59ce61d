#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace blocklift::pipeline {

/// The place of a triangle that is nearest to a point.
struct NearestPlace {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t triangle = 0;         ///< in the order in which they were given
  std::array<double, 3> weights{};  ///< of the corners, each at least 0, sum 1

  bool is_found() const { return distance < std::numeric_limits<double>::infinity(); }
};

/// The place of one triangle that is nearest to a point. The triangle may be a line or a point.
NearestPlace nearest_on_triangle(const Eigen::Vector3d& point,
                                 const std::array<Eigen::Vector3d, 3>& corners);

/// Triangles in a tree of boxes, which finds the nearest of them.
class TriangleTree {
 public:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;
    int plate = 0;
  };

  explicit TriangleTree(std::vector<Triangle> triangles);

  /// The nearest place on any plate, none if there is no triangle.
  NearestPlace find_nearest(const Eigen::Vector3d& point) const;
  /// The nearest place on one plate within `farthest`, none if there is none.
  NearestPlace find_nearest(const Eigen::Vector3d& point, int plate, double farthest) const;

  const Triangle& triangle(std::size_t number) const { return triangles_[number]; }

 private:
  struct Box {
    Eigen::Vector3d low, high;
    std::size_t begin = 0, end = 0;  ///< in order_
    std::size_t children = 0;        ///< the first of two; zero: none
  };
  void divide(std::size_t box);
  void search(std::size_t box, const Eigen::Vector3d& point, int plate, NearestPlace& best) const;

  std::vector<Triangle> triangles_;
  std::vector<std::size_t> order_;
  std::vector<Box> boxes_;
};

}  // namespace blocklift::pipeline
