#include "structure/mesh/plates/hole_outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"

namespace blocklift::structure {

namespace {

using Eigen::Vector2d;
using std::numbers::pi;

constexpr double same_point = 1e-6;  // m

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

double angle_between(double a, double b) { return std::remainder(a - b, 2 * pi); }

}  // namespace

HoleOutline HoleOutline::rounded(const Vector2d& lower, const Vector2d& upper, double radius) {
  const Vector2d size = upper - lower;
  if (!(radius > 0 && radius <= size.minCoeff() / 2 + same_point))
    throw ModelError(fmt::format("corners of {:g} mm radius do not fit into {:g} x {:g} mm",
                                 radius * 1e3, size.x() * 1e3, size.y() * 1e3));
  HoleOutline outline;
  outline.lower_ = lower;
  outline.upper_ = upper;
  outline.centre_ = (lower + upper) / 2;
  outline.area_ = size.prod() - (4 - pi) * radius * radius;
  // Centres of the four arcs, anticlockwise from the lower right; a side comes after each.
  const Vector2d inner_lower = lower.array() + radius, inner_upper = upper.array() - radius;
  const Vector2d centres[4] = {{inner_upper.x(), inner_lower.y()},
                               inner_upper,
                               {inner_lower.x(), inner_upper.y()},
                               inner_lower};
  for (int corner = 0; corner < 4; ++corner) {
    const double first = pi / 2 * (corner - 1), last = first + pi / 2;
    const Vector2d &centre = centres[corner], &next = centres[(corner + 1) % 4];
    outline.pieces_.push_back({centre + radius * direction(first),
                               centre + radius * direction(last), centre, radius, first, pi / 2});
    if ((next - centre).norm() > same_point)
      outline.pieces_.push_back(
          {centre + radius * direction(last), next + radius * direction(last), centre, 0, 0, 0});
  }
  return outline;
}

HoleOutline HoleOutline::polygon(std::vector<Vector2d> corners) {
  if (corners.size() < 3)
    throw ModelError(fmt::format("a polygon has three corners at least, not {}", corners.size()));
  HoleOutline outline;
  Vector2d moment = Vector2d::Zero();
  double twice = 0;
  outline.lower_ = outline.upper_ = corners.front();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((b - a).norm() < same_point)
      throw ModelError(fmt::format("two corners of a polygon lie at ({:g}, {:g}) m", a.x(), a.y()));
    twice += cross(a - corners[0], b - corners[0]);
    moment += cross(a - corners[0], b - corners[0]) * (a + b - 2 * corners[0]);
    outline.lower_ = outline.lower_.cwiseMin(a);
    outline.upper_ = outline.upper_.cwiseMax(a);
  }
  outline.centre_ = corners[0] + moment / (3 * twice);
  outline.area_ = std::abs(twice) / 2;
  if (twice < 0) std::reverse(corners.begin(), corners.end());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if (!(cross(a - outline.centre_, b - outline.centre_) > 1e-3 * (b - a).squaredNorm()))
      throw ModelError(
          "a polygon's sides cannot all be seen from its centre; divide it into several");
    outline.pieces_.push_back({a, b, a, 0, 0, 0});
  }
  return outline;
}

Vector2d HoleOutline::point(int piece, double share) const {
  const Piece& here = pieces_[piece];
  if (is_straight(piece)) return here.start + share * (here.end - here.start);
  return here.centre + here.radius * direction(here.first_angle + share * here.angle);
}

std::vector<int> match_corners(const HoleOutline& outline, const std::vector<Vector2d>& around) {
  const int corners = outline.pieces(), count = static_cast<int>(around.size());
  const auto angle_of = [&](const Vector2d& point) {
    const Vector2d arm = point - outline.centre();
    return std::atan2(arm.y(), arm.x());
  };
  std::vector<double> there, here;
  for (const Vector2d& point : around) there.push_back(angle_of(point));
  for (int c = 0; c < corners; ++c) here.push_back(angle_of(outline.point(c, 0)));
  const auto cost = [&](int corner, int point) {
    const double miss = angle_between(here[corner], there[point % count]);
    return miss * miss;
  };
  // For each point that the first corner may have: the least sum of squares of the misses of those
  // up to each corner, the last of them at each point.
  std::vector<int> best;
  double least = std::numeric_limits<double>::infinity();
  for (int first = 0; first < count; ++first) {
    constexpr double never = std::numeric_limits<double>::infinity();
    std::vector<std::vector<double>> sum(at(corners), std::vector<double>(at(count), never));
    std::vector<std::vector<int>> before(at(corners), std::vector<int>(at(count), 0));
    sum[0][0] = cost(0, first);
    for (int c = 1; c < corners; ++c) {
      int nearest = 0;
      for (int p = 1; p < count; ++p) {
        if (sum[c - 1][p - 1] < sum[c - 1][nearest]) nearest = p - 1;
        sum[c][p] = sum[c - 1][nearest] + cost(c, first + p);
        before[c][p] = nearest;
      }
    }
    const std::vector<double>& last = sum.back();
    const auto end = std::min_element(last.begin(), last.end());
    if (!(*end < least)) continue;
    least = *end;
    best.assign(corners, 0);
    int point = static_cast<int>(end - last.begin());
    for (int c = corners - 1; c >= 0; --c) {
      best[c] = (first + point) % count;
      point = before[c][point];
    }
  }
  return best;
}

}  // namespace blocklift::structure
