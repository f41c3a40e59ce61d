#include "structure/mesh/beams/section_shear.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Dense>

namespace blocklift::structure {

namespace {

using Vector2 = Eigen::Vector2d;
constexpr double pi = std::numbers::pi;

/// Torsion's stress in the middle of a rectangle's sides over G times the twist and the short side.
struct SideStress {
  double on_long = 0, on_short = 0;
};
/// @param ratio of the long side to the short one.
SideStress torsion_on_sides(double ratio) {
  constexpr double catalan = 0.915965594177219;
  double even = 0, alternating = catalan;
  for (int n = 1; n < 20; n += 2) {
    const double angle = n * pi * ratio / 2;
    even += 1 / (n * n * std::cosh(angle));
    alternating += (n % 4 == 1 ? 1 : -1) * (std::tanh(angle) - 1) / (n * n);
  }
  constexpr double share = 8 / (pi * pi);
  return {1 - share * even, share * alternating};
}

/// Diameter of the largest circle within a convex polygon: it touches three of its sides.
double largest_circle(const std::vector<Vector2>& corners) {
  const std::size_t count = corners.size();
  std::vector<Eigen::Vector3d> sides;  // outward normal, distance from the origin
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2 along = (corners[(i + 1) % count] - corners[i]).normalized();
    Vector2 normal(along[1], -along[0]);
    if (normal.dot(corners[i]) < 0) normal = -normal;
    sides.emplace_back(normal[0], normal[1], normal.dot(corners[i]));
  }
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k) {
        Eigen::Matrix3d touching;
        Eigen::Vector3d distances;
        Eigen::Index row = 0;
        for (const std::size_t s : {i, j, k}) {
          touching.row(row) << sides[s][0], sides[s][1], 1;
          distances[row++] = sides[s][2];
        }
        const Eigen::FullPivLU<Eigen::Matrix3d> solver(touching);
        if (!solver.isInvertible()) continue;
        const Eigen::Vector3d circle = solver.solve(distances);
        const bool is_within = std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
          return side.template head<2>().dot(circle.head<2>()) + circle[2] <= side[2] * (1 + 1e-9);
        });
        if (is_within) largest = std::max(largest, circle[2]);
      }
  return 2 * largest;
}

/// Radius of the pipe or round bar with a section's area and torsion constant, m.
double round_radius(const BeamSection& section) {
  return std::sqrt(section.torsion / section.area + section.area / (2 * pi));
}

bool has_second_moments(const BeamSection& section) {
  return section.second_moment_2 > 0 || section.second_moment_3 > 0;
}

/// Of T / J, 1/m^3.
double estimated_torsion(const BeamSection& section, const std::vector<Vector2>& places) {
  if (!(section.torsion > 0)) return 0;
  double reach = 0;
  for (const Vector2& place : places) reach = std::max(reach, place.norm());
  if (!(section.area > 0)) return reach / section.torsion;
  const double round = round_radius(section);
  const double round_bar = section.area * section.area / (2 * pi);
  if (has_second_moments(section))
    reach = std::max(reach, round);
  else
    reach = std::abs(section.torsion - round_bar) < 0.02 * round_bar ? round : 1.3 * round;
  return std::min(std::sqrt(6 * section.torsion / section.area), reach) / section.torsion;
}

/// How far a section's stress points reach along an axis from its centroid, m; 0 if they do not.
/// Points on one side alone stand for both.
struct Reach {
  double up = 0, down = 0;
  double both() const { return up + down; }
};
Reach reach_along(const BeamSection& section, int axis) {
  Reach reach;
  for (const Vector2& place : section.stress_points) {
    reach.up = std::max(reach.up, place[axis]);
    reach.down = std::max(reach.down, -place[axis]);
  }
  const double farther = std::max(reach.up, reach.down);
  if (std::min(reach.up, reach.down) < 0.05 * farther) reach = {farther, farther};
  return reach;
}

/// What fillets of rolled sections and sloping flanges give the web in the figures that is not in
/// it: 5.2 % at most in IPE, HEA, HEB, HEM and UPN.
constexpr double of_fillets = 1.06;

/// Largest S / (I t) of a web between flanges that are as wide as the section, 1/m^2; none if none
/// has these figures. What the section lacks of its rectangle is one of even width, and has an
/// area, a centroid and a second moment.
std::optional<double> by_flanges(double area, double moment, const Reach& reach, double width) {
  const double up = reach.up, down = reach.down;
  const double lack = width * reach.both() - area;
  if (!(lack > 1e-6 * area)) return std::nullopt;
  const double middle = width * (up * up - down * down) / 2 / lack;
  const double lacking_moment = width * (std::pow(up, 3) + std::pow(down, 3)) / 3 - moment;
  const double square = 12 * (lacking_moment / lack - middle * middle);
  if (!(square > 0)) return std::nullopt;
  const double web_height = std::sqrt(square), web = width - lack / web_height;
  const double above = middle + web_height / 2, below = web_height / 2 - middle;
  constexpr double slack = 1.02;
  if (!(web > 0) || above > slack * up || below > slack * down) return std::nullopt;
  const auto flow = [&](double end, double reached) {
    const double inner = std::min(end, reached);
    return (width * (reached * reached - inner * inner) + web * inner * inner) / 2;
  };
  // Flanges of two widths: 0.63 of what there is was the least in a few hundred such beams. A tee
  // lacks one of them, and is exact.
  const bool is_even = std::abs(up - down) < 0.02 * reach.both();
  const bool is_tee = above > up / slack || below > down / slack;
  const double of_two_widths = is_even || is_tee ? 1 : 1.6;
  return of_fillets * of_two_widths * std::max(flow(above, up), flow(below, down)) / (moment * web);
}

/// Share of the web in the area of an I, by how much torsion its flanges need to have this torsion
/// constant; none if no flanges do. Solid bars and even closed walls have J of 1.5 to 4 times the
/// lesser second moment, rolled beams and channels up to 0.17 times.
std::optional<double> web_by_torsion(double area, double upright, double level, double torsion) {
  if (torsion > 0.5 * level) return std::nullopt;
  // Every station of a beam asks: the thousand trials below are products, without powers.
  const double cube = area * area * area / 12;
  const double of_flanges = cube * area / (12 * level), of_web = cube * area / upright;
  // J of flanges that have `share` of the area and all of the level moment, and of a web.
  const auto torsion_of = [&](double share) {
    const double web = 1 - share, square = share * share;
    return of_flanges * square * square + of_web * web * web * web * (1 - 2 * web / 3);
  };
  if (!(torsion_of(1) >= torsion)) return std::nullopt;
  // From above: of several the one with the least web.
  double share = 1;
  while (share > 0 && torsion_of(share) > torsion) share -= 1e-3;
  if (!(share > 0)) return std::nullopt;
  return std::max(1 - share, 0.15);
}

/// Of a force along an axis of a section whose reach is not known.
std::optional<double> by_torsion(const BeamSection& section, int axis) {
  const bool is_upright = section.second_moment_3 > section.second_moment_2;
  const double upright = std::max(section.second_moment_2, section.second_moment_3),
               level = std::min(section.second_moment_2, section.second_moment_3);
  if (!(level > 0 && section.torsion > 0)) return std::nullopt;
  const auto web = web_by_torsion(section.area, upright, level, section.torsion);
  if (!web) return std::nullopt;
  if ((axis == 0) != is_upright) return 1.5 / ((1 - *web) * section.area);
  return (1 - *web / 2) / (1 - 2 * *web / 3) / (*web * section.area);
}

/// Of a force along an axis, 1/m^2.
double estimated_force(const BeamSection& section, int axis) {
  const double area = section.area;
  if (!(area > 0)) return 0;
  const double shear_area = axis == 0 ? section.shear_area_2 : section.shear_area_3;
  if (std::isfinite(shear_area) && shear_area > 0 && shear_area < 0.999 * area)
    return 1.25 / shear_area;
  const double least = 2 / area;
  const double moment = axis == 0 ? section.second_moment_3 : section.second_moment_2,
               other = axis == 0 ? section.second_moment_2 : section.second_moment_3;
  if (!(moment > 0)) return least;
  const Reach reach = reach_along(section, axis);
  const double width = reach_along(section, 1 - axis).both();
  if (!(reach.both() > 0 && width > 0))
    return std::max(least, by_torsion(section, axis).value_or(0));
  const double product = section.product_23;
  const double own = other > 0 ? moment - product * product / other : moment;
  const double farthest = std::max(reach.up, reach.down);
  double of_force = std::max(least, own > 0 ? farthest * farthest / (2 * own) : 0);
  if (own > 0.99 * moment)
    of_force = std::max(of_force, by_flanges(area, moment, reach, width).value_or(0));
  return std::min(of_force, 10 / area);
}

}  // namespace

std::vector<SectionPoint> shear_points_of_pipe(double outer_radius, double inner_radius) {
  const double square = outer_radius * outer_radius, hole = inner_radius * inner_radius;
  const double torsion_constant = pi / 2 * (square * square - hole * hole);
  // S / (I b) of half the ring, b twice the wall.
  const double of_force = 4 / (3 * pi * (square - hole)) *
                          (square + outer_radius * inner_radius + hole) / (square + hole);
  std::vector<SectionPoint> points;
  for (const int twelfth : {0, 3, 6, 9, 1, 2, 4, 5, 7, 8, 10, 11}) {
    const double angle = twelfth * pi / 6;
    const Vector2 outwards(std::cos(angle), std::sin(angle)), along(-outwards[1], outwards[0]);
    points.push_back({outer_radius * outwards, outer_radius / torsion_constant, of_force * along});
  }
  return points;
}

std::vector<SectionPoint> shear_points_of_rectangle(double height, double width,
                                                    double torsion_constant) {
  const double longer = std::max(height, width), shorter = std::min(height, width);
  const SideStress torsion = torsion_on_sides(longer / shorter);
  const double unit = shorter / torsion_constant, of_force = 1.5 / (height * width);
  const double upright = unit * (height >= width ? torsion.on_long : torsion.on_short),
               level = unit * (height >= width ? torsion.on_short : torsion.on_long);
  std::vector<SectionPoint> points;
  for (const auto& [side_2, side_3] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}})
    points.push_back(
        {{side_2 * height / 2, side_3 * width / 2}, unit * torsion.on_long, Vector2::Zero()});
  // Along the edge, from axis 2 towards axis 3.
  points.push_back({{0, width / 2}, upright, {-of_force, 0}});
  points.push_back({{0, -width / 2}, upright, {of_force, 0}});
  points.push_back({{height / 2, 0}, level, {0, of_force}});
  points.push_back({{-height / 2, 0}, level, {0, -of_force}});
  return points;
}

std::vector<SectionPoint> shear_points_of_polygon(const std::vector<Vector2>& corners, double area,
                                                  double torsion_constant) {
  const double diameter = largest_circle(corners);
  const double k = pi * pi * std::pow(diameter, 4) / (16 * area * area);
  const double of_torsion = 1.1 * diameter / (1 + k) * (1 + 0.15 * k) / torsion_constant;
  std::vector<SectionPoint> points;
  for (const Vector2& corner : corners) points.push_back({corner, of_torsion, Vector2::Zero()});
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2 &from = corners[i], &to = corners[(i + 1) % corners.size()];
    Vector2 along = (to - from).normalized();
    // As torsion runs: from axis 2 towards axis 3.
    if (from[0] * to[1] - from[1] * to[0] < 0) along = -along;
    Vector2 of_force = Vector2::Zero();
    for (int axis = 0; axis < 2; ++axis)
      of_force[axis] = 1.5 / area * along[axis] / std::max(along[axis] * along[axis], 0.5);
    points.push_back({(from + to) / 2, of_torsion, of_force});
  }
  return points;
}

std::vector<Vector2> stress_points(const BeamSection& section) {
  if (!section.stress_points.empty()) return section.stress_points;
  if (!(section.area > 0)) return {Vector2::Zero()};
  const double x = std::sqrt(3 * section.second_moment_3 / section.area),
               y = std::sqrt(3 * section.second_moment_2 / section.area);
  return {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
}

std::vector<SectionPoint> checked_points(const BeamSection& section) {
  if (!section.shear_points.empty()) return section.shear_points;
  std::vector<Vector2> places = stress_points(section);
  const double of_torsion = estimated_torsion(section, places);
  if (!has_second_moments(section)) return {{Vector2::Zero(), of_torsion, Vector2::Zero()}};
  const Vector2 of_force(estimated_force(section, 0), estimated_force(section, 1));
  constexpr double inner = 0.8;
  std::vector<SectionPoint> points;
  for (const Vector2& place : places) points.push_back({place, of_torsion, Vector2::Zero()});
  for (const Vector2& place : places)
    for (const Vector2& signs : {Vector2(1, 1), Vector2(1, -1), Vector2(-1, 1), Vector2(-1, -1)})
      if (of_torsion > 0 || signs[0] > 0)  // without torsion the other signs say the same
        points.push_back({inner * place, of_torsion, signs.cwiseProduct(of_force)});
  return points;
}

bool is_shear_estimated(const BeamSection& section) {
  return section.shear_points.empty() && (section.torsion > 0 || has_second_moments(section));
}

}  // namespace blocklift::structure
