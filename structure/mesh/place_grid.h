#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Numbered places and boxes in cubes of space, found by where they are.
class PlaceGrid {
 public:
  /// @param cube length of its edges, m: about that of the boxes that are added or asked for.
  explicit PlaceGrid(double cube) : cube_(cube) {}

  void add(const Vector3& place, int number) { cubes_[cube_of(place)].push_back(number); }
  void add(const Eigen::AlignedBox3d& box, int number) {
    for_each_cube(box.min(), box.max(), [&](const Cube& cube) { cubes_[cube].push_back(number); });
  }

  /// Visits all places in the box, and more about it; boxes that it meets once for each cube.
  template <typename Visit>
  void visit(const Vector3& lower, const Vector3& upper, const Visit& visit_one) const {
    for_each_cube(lower, upper, [&](const Cube& cube) {
      const auto found = cubes_.find(cube);
      if (found == cubes_.end()) return;
      for (const int number : found->second) visit_one(number);
    });
  }
  /// Visits the boxes that hold a place once each, and others near it.
  template <typename Visit>
  void visit(const Vector3& place, const Visit& visit_one) const {
    visit(place, place, visit_one);
  }

 private:
  using Cube = std::array<long, 3>;
  struct Hash {
    std::size_t operator()(const Cube& cube) const {
      std::size_t hash = 0;
      for (const long i : cube) hash = hash * 1000003 + static_cast<std::size_t>(i);
      return hash;
    }
  };
  template <typename Take>
  void for_each_cube(const Vector3& lower, const Vector3& upper, const Take& take) const {
    const Cube first = cube_of(lower), last = cube_of(upper);
    for (long x = first[0]; x <= last[0]; ++x)
      for (long y = first[1]; y <= last[1]; ++y)
        for (long z = first[2]; z <= last[2]; ++z) take(Cube{x, y, z});
  }
  Cube cube_of(const Vector3& place) const {
    return {std::lround(std::floor(place.x() / cube_)), std::lround(std::floor(place.y() / cube_)),
            std::lround(std::floor(place.z() / cube_))};
  }

  double cube_;
  std::unordered_map<Cube, std::vector<int>, Hash> cubes_;
};

}  // namespace blocklift::structure
