#include "structure/practice/curved_sectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Dense>

#include "structure/mesh/fields/shell_edges.h"
#include "structure/practice/buckling_fields.h"

namespace blocklift::structure {

namespace {

constexpr double sector_turn = std::numbers::pi / 6;
constexpr double least_turn = std::numbers::pi / 4;

/// Normals of a shell near its corners, on the field's side. There they turn by 0.9 of what they
/// do from corner to corner.
constexpr double near_corners = 0.9;
std::array<Vector3, 4> corner_normals(const Mesh& mesh, int shell, bool is_flipped) {
  constexpr double low = (1 - near_corners) / 2, high = 1 - low;
  const auto normal = [&](double x, double y) -> Vector3 {
    const Eigen::Matrix<double, 3, 2> g = tangents(mesh, shell, {x, y});
    return (is_flipped ? -1.0 : 1.0) * Vector3(g.col(0)).cross(Vector3(g.col(1))).normalized();
  };
  return {normal(low, low), normal(high, low), normal(low, high), normal(high, high)};
}

/// What most of the normals turn about: across their mean and the direction in which they spread
/// most. Where they spread along that too (a pipe, a cone), the direction in which they spread
/// least.
Vector3 turning_axis(const std::vector<ShellShare>& shares) {
  double area = 0;
  Vector3 mean = Vector3::Zero();
  for (const ShellShare& share : shares) {
    area += share.area;
    mean += share.area * share.normal;
  }
  mean /= area;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const ShellShare& share : shares) {
    const Vector3 off = share.normal - mean;
    spread += share.area / area * off * off.transpose();
  }
  constexpr double little = 0.02;  // 8 degrees squared
  if (mean.norm() > 0.1) {
    const Vector3 m = mean.normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - m * m.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(across * spread * across);
    Vector3 axis = m.cross(Vector3(solver.eigenvectors().col(2))).normalized();
    if (axis.dot(spread * axis) < little) return axis;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
}

/// Angles about an axis, from the first normal that is not along it.
class AnglesAbout {
 public:
  AnglesAbout(const Vector3& axis, const std::vector<ShellShare>& shares) {
    const auto has_angle = [&](const ShellShare& share) {
      return std::abs(share.normal.dot(axis)) < 0.9;
    };
    const auto first = std::find_if(shares.begin(), shares.end(), has_angle);
    const Vector3 normal = first == shares.end() ? axis.unitOrthogonal() : first->normal;
    e_1_ = (normal - axis * axis.dot(normal)).normalized();
    e_2_ = axis.cross(e_1_);
  }
  double of(const Vector3& normal) const { return std::atan2(normal.dot(e_2_), normal.dot(e_1_)); }

 private:
  Vector3 e_1_, e_2_;
};

/// An angle brought to less than a turn beyond another one, which a rounding may miss.
double turned_beyond(double angle, double start) {
  constexpr double rounding = 1e-6;
  const double turn = 2 * std::numbers::pi;
  const double over = angle - start + rounding;
  return over - turn * std::floor(over / turn) - rounding;
}

struct AngleSpan {
  double begin = 0, angle = 0;  ///< rad
};

/// What intervals of angles (begin, length) cover: all round, or but for the largest gap.
AngleSpan covered_arc(std::vector<AngleSpan> parts) {
  constexpr double least_gap = 0.18;  // wider than a kink between facets of one field
  const double start = parts.front().begin;
  for (AngleSpan& part : parts) part.begin = turned_beyond(part.begin, start);
  std::sort(parts.begin(), parts.end(),
            [](const AngleSpan& one, const AngleSpan& other) { return one.begin < other.begin; });
  double reached = 0, largest = 0, after = 0;
  for (const AngleSpan& part : parts) {
    if (part.begin - reached > largest) {
      largest = part.begin - reached;
      after = part.begin;
    }
    reached = std::max(reached, part.begin + part.angle);
  }
  const double last = 2 * std::numbers::pi - reached;
  if (last > largest) {
    largest = last;
    after = 0;
  }
  if (largest < least_gap) return {start, 2 * std::numbers::pi};
  return {start + after, 2 * std::numbers::pi - largest};
}

/// Does a field turn far enough that it is worth looking closer?
bool is_bent(const std::vector<ShellShare>& shares, const std::vector<Vector3>& normals) {
  Vector3 mean = Vector3::Zero();
  double area = 0;
  for (const ShellShare& share : shares) {
    mean += share.area * share.normal;
    area += share.area;
  }
  if (mean.norm() < 0.1 * area) return true;
  mean.normalize();
  const double least = std::cos(near_corners * least_turn / 2);
  return std::any_of(normals.begin(), normals.end(),
                     [&](const Vector3& normal) { return normal.dot(mean) < least; });
}

double developed_length(const Mesh& mesh, const PlateField& field,
                        const std::vector<ShellShare>& shares, const Vector3& axis) {
  double lowest = 1e300, highest = -1e300, area = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    area += shares[i].area;
    for (const int vertex : mesh.shells[field.shells[i]].vertices) {
      lowest = std::min(lowest, axis.dot(mesh.vertices[vertex]));
      highest = std::max(highest, axis.dot(mesh.vertices[vertex]));
    }
  }
  return area / (highest - lowest);
}

}  // namespace

std::optional<CurvedSectors> find_curved_sectors(const Mesh& mesh, const PlateField& field) {
  std::vector<ShellShare> shares;
  std::vector<Vector3> normals;  // four a shell
  for (std::size_t i = 0; i < field.shells.size(); ++i) {
    shares.push_back(share_of_shell(mesh, field.shells[i], field.is_flipped[i]));
    const auto corners = corner_normals(mesh, field.shells[i], field.is_flipped[i]);
    normals.insert(normals.end(), corners.begin(), corners.end());
  }
  if (!is_bent(shares, normals)) return std::nullopt;
  CurvedSectors result;
  PlateTurn& turn = result.turn;
  turn.axis = turning_axis(shares);
  const AnglesAbout angles(turn.axis, shares);
  std::vector<double> middles;
  std::vector<AngleSpan> parts;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    middles.push_back(angles.of(shares[i].normal));
    double before = 0, after = 0;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const double off =
          turned_beyond(angles.of(normals[4 * i + corner]), middles.back() - std::numbers::pi) -
          std::numbers::pi;
      before = std::min(before, off / near_corners);
      after = std::max(after, off / near_corners);
    }
    parts.push_back({middles.back() + before, after - before});
  }
  const AngleSpan all = covered_arc(parts);
  turn.angle = all.angle;
  result.count = static_cast<int>(std::lround(all.angle / sector_turn));
  if (all.angle < least_turn * (1 - 1e-3) || result.count < 2) return std::nullopt;
  const double length = developed_length(mesh, field, shares, turn.axis);
  turn.arc = std::min(length, std::numbers::pi / std::numbers::sqrt3 * length / turn.angle);
  for (const double middle : middles) {
    const double share = turned_beyond(middle, all.begin) / all.angle * result.count;
    result.of_shell.push_back(
        std::clamp(static_cast<int>(std::floor(share + 1e-6)), 0, result.count - 1));
  }
  const auto [least, most] = std::minmax_element(result.of_shell.begin(), result.of_shell.end());
  if (*least == *most) return std::nullopt;
  return result;
}

}  // namespace blocklift::structure
