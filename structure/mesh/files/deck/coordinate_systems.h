#pragma once

#include <array>
#include <functional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <Eigen/Core>

#include "structure/mesh/files/deck/log.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Local system of axes: along straight lines, about a cylinder (r, theta, z) or a sphere
/// (r, theta, phi: theta from the z axis, phi about it); angles in degrees.
enum class SystemKind { rectangular, cylindrical, spherical };

struct LocalSystem {
  SystemKind kind = SystemKind::rectangular;
  Vector3 origin = Vector3::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns

  /// From coordinates of this system to those of the basic one.
  Vector3 place(const Vector3& given) const;
  /// Directions of the three coordinates at a place; on the axis of a cylinder or sphere those of
  /// its straight axes.
  Eigen::Matrix3d axes_at(const Vector3& place) const;
};

/// System through three points: its origin, one on its third axis, one in the plane of 1 and 3.
/// @throws CardError if they lie on a line.
LocalSystem system_through(SystemKind kind, const Vector3& origin, const Vector3& on_axis_3,
                           const Vector3& in_plane_13);

/// Systems that stand in one another or on nodes, resolved as they are asked for.
class CoordinateSystems {
 public:
  /// Three points in another system, or three nodes.
  struct Definition {
    SystemKind kind = SystemKind::rectangular;
    std::array<Vector3, 3> points;
    long reference = 0;
    std::array<long, 3> nodes{0, 0, 0};  ///< the first zero: points are given
    SourceLine line;
  };
  /// @throws CardError if there is one of this number.
  void add(long number, const Definition& definition);
  /// How to find a node's place.
  void set_nodes(std::function<Vector3(long)> place_of) { place_of_ = std::move(place_of); }

  /// 0 is the basic one. @throws CardError if there is none, or it rests on itself.
  const LocalSystem& get(long number);
  const std::unordered_map<long, Definition>& definitions() const { return definitions_; }

 private:
  std::unordered_map<long, Definition> definitions_;
  std::unordered_map<long, LocalSystem> systems_{{0, LocalSystem()}};
  std::unordered_set<long> asked_;  ///< that are being resolved
  std::function<Vector3(long)> place_of_;
};

}  // namespace blocklift::structure
