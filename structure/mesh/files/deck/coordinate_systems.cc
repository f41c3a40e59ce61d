#include "structure/mesh/files/deck/coordinate_systems.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace blocklift::structure {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Forgets that a system is being resolved, also when it cannot be.
struct Asked {
  std::unordered_set<long>& all;
  long number;
  ~Asked() { all.erase(number); }
};

}  // namespace

Vector3 LocalSystem::place(const Vector3& given) const {
  Vector3 straight = given;
  if (kind == SystemKind::cylindrical)
    straight << given[0] * std::cos(given[1] * degree), given[0] * std::sin(given[1] * degree),
        given[2];
  if (kind == SystemKind::spherical) {
    const double across = given[0] * std::sin(given[1] * degree);
    straight << across * std::cos(given[2] * degree), across * std::sin(given[2] * degree),
        given[0] * std::cos(given[1] * degree);
  }
  return origin + axes * straight;
}

Eigen::Matrix3d LocalSystem::axes_at(const Vector3& place) const {
  if (kind == SystemKind::rectangular) return axes;
  const Vector3 local = axes.transpose() * (place - origin);
  const double across = std::hypot(local.x(), local.y());
  if (across < 1e-12 * (1 + local.norm())) return axes;
  const double c = local.x() / across, s = local.y() / across;
  Eigen::Matrix3d turned;
  if (kind == SystemKind::cylindrical) {
    turned << c, -s, 0, s, c, 0, 0, 0, 1;
  } else {
    const double radius = local.norm(), sine = across / radius, cosine = local.z() / radius;
    turned << sine * c, cosine * c, -s, sine * s, cosine * s, c, cosine, -sine, 0;
  }
  return axes * turned;
}

LocalSystem system_through(SystemKind kind, const Vector3& origin, const Vector3& on_axis_3,
                           const Vector3& in_plane_13) {
  const Vector3 axis_3 = on_axis_3 - origin;
  const Vector3 axis_2 = axis_3.cross(in_plane_13 - origin);
  if (!(axis_2.norm() > 1e-9 * axis_3.norm() * (in_plane_13 - origin).norm()))
    throw CardError{"the three points of the coordinate system lie on a line"};
  LocalSystem system;
  system.kind = kind;
  system.origin = origin;
  system.axes.col(2) = axis_3.normalized();
  system.axes.col(1) = axis_2.normalized();
  system.axes.col(0) = system.axes.col(1).cross(system.axes.col(2));
  return system;
}

void CoordinateSystems::add(long number, const Definition& definition) {
  if (!definitions_.try_emplace(number, definition).second)
    throw CardError{fmt::format("coordinate system {} is there twice", number)};
}

const LocalSystem& CoordinateSystems::get(long number) {
  if (const auto known = systems_.find(number); known != systems_.end()) return known->second;
  const auto found = definitions_.find(number);
  if (found == definitions_.end())
    throw CardError{fmt::format("coordinate system {} does not exist", number)};
  if (!asked_.insert(number).second)
    throw CardError{fmt::format("coordinate system {} rests on itself", number)};
  const Asked asked{asked_, number};
  const Definition& definition = found->second;
  std::array<Vector3, 3> points = definition.points;
  if (definition.nodes[0] != 0) {
    for (std::size_t i = 0; i < 3; ++i) points[i] = place_of_(definition.nodes[i]);
  } else {
    const LocalSystem reference = get(definition.reference);
    for (Vector3& point : points) point = reference.place(point);
  }
  const LocalSystem system = system_through(definition.kind, points[0], points[1], points[2]);
  return systems_[number] = system;
}

}  // namespace blocklift::structure
