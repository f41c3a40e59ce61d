#include "structure/mesh/beams/sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/beams/section_shear.h"
#include "structure/mesh/beams/thin_walls.h"

namespace blocklift::structure {

namespace {

using Vector2 = Eigen::Vector2d;

void require_positive(const char* shape,
                      std::initializer_list<std::pair<const char*, double>> list) {
  for (const auto& [what, value] : list)
    if (!(std::isfinite(value) && value > 0))
      throw ModelError(
          fmt::format("{}: the {} is {:g} m; it must be positive", shape, what, value));
}

void require(bool holds, const char* shape, const char* what) {
  if (!holds) throw ModelError(fmt::format("{}: {}", shape, what));
}

/// Area, first and second moments about the origin: of 1, x_2, x_3, x_2^2, x_3^2, x_2 x_3.
struct Moments {
  double area = 0;
  Vector2 first = Vector2::Zero();
  double second_22 = 0, second_33 = 0, second_23 = 0;

  void add(double part, const Vector2& centre, double own_22, double own_33, double own_23) {
    area += part;
    first += part * centre;
    second_22 += own_22 + part * centre[0] * centre[0];
    second_33 += own_33 + part * centre[1] * centre[1];
    second_23 += own_23 + part * centre[0] * centre[1];
  }
  /// Rectangle of a length along a direction and a thickness.
  void add_rectangle(const Vector2& centre, const Vector2& along, double length, double thickness) {
    const double part = length * thickness;
    const double lengthwise = part * length * length / 12;
    const double across = part * thickness * thickness / 12;
    const double c = along[0], s = along[1];
    add(part, centre, lengthwise * c * c + across * s * s, lengthwise * s * s + across * c * c,
        (lengthwise - across) * c * s);
  }
  /// Polygon by its corners in turn, either way round, as triangles; sign -1: a hole.
  void add_polygon(const std::vector<Vector2>& corners, double sign) {
    const auto twice = [](const Vector2& a, const Vector2& b) { return a[0] * b[1] - a[1] * b[0]; };
    double whole = 0;
    for (std::size_t i = 2; i < corners.size(); ++i)
      whole += twice(corners[i - 1] - corners[0], corners[i] - corners[0]);
    if (whole < 0) sign = -sign;
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Vector2 a = corners[i - 1] - corners[0], b = corners[i] - corners[0];
      const double part = sign * twice(a, b) / 2;
      const Vector2 centre = corners[0] + (a + b) / 3;
      const auto own = [&](int j, int k) {  // of a triangle about its centre
        const Vector2 c = -(a + b) / 3, d = a + c, e = b + c;
        return part * (c[j] * c[k] + d[j] * d[k] + e[j] * e[k]) / 12;
      };
      add(part, centre, own(0, 0), own(1, 1), own(0, 1));
    }
  }
};

Profile profile_of(std::string name, const Moments& moments) {
  Profile profile;
  profile.centroid = moments.first / moments.area;
  const Vector2& c = profile.centroid;
  profile.section.name = std::move(name);
  profile.section.area = moments.area;
  profile.section.second_moment_3 = moments.second_22 - moments.area * c[0] * c[0];
  profile.section.second_moment_2 = moments.second_33 - moments.area * c[1] * c[1];
  profile.section.product_23 = moments.second_23 - moments.area * c[0] * c[1];
  return profile;
}

void set_points(Profile& profile, const std::vector<Vector2>& outline) {
  profile.section.stress_points.clear();
  for (const Vector2& point : outline)
    profile.section.stress_points.push_back(point - profile.centroid);
}

std::vector<Vector2> corners(double bottom, double top, double left, double right) {
  return {{top, right}, {bottom, right}, {bottom, left}, {top, left}};
}

/// Roark (1989), table 20, case 4: rectangle with sides a >= b.
double torsion_of_rectangle(double height, double width) {
  const double a = std::max(height, width), b = std::min(height, width), ratio = b / a;
  return a * b * b * b * (1.0 / 3 - 0.21 * ratio * (1 - std::pow(ratio, 4) / 12));
}

/// Part of the area of a pipe that bears shear, Cowper (1966), with Poisson's ratio 0.3.
double shear_share_of_pipe(double ratio) {
  constexpr double nu = 0.3;
  const double m = ratio * ratio, square = (1 + m) * (1 + m);
  return 6 * (1 + nu) * square / ((7 + 6 * nu) * square + (20 + 12 * nu) * m);
}

}  // namespace

namespace {

/// @param point from the profile's origin.
void add_shear_point(SectionPoint point, Profile& profile) {
  point.place -= profile.centroid;
  profile.section.shear_points.push_back(point);
}

/// What follows from the walls' middle lines.
void set_wall_figures(const ThinWalls& lines, Profile& profile) {
  profile.section.torsion = lines.torsion();
  profile.section.shear_area_2 = lines.shear_area(0);
  profile.section.shear_area_3 = lines.shear_area(1);
  profile.section.shear_centre = lines.shear_centre() - profile.centroid;
  profile.section.shear_points.clear();
  for (const SectionPoint& point : lines.points()) add_shear_point(point, profile);
}

/// Shear of a bulb flat as its equivalent angle has it: at the outline's points that of the angle's
/// nearest ones, and the angle's own points within the web.
void set_points_of_angle(const Profile& angle, double web, Profile& profile) {
  std::vector<SectionPoint> known = angle.section.shear_points;
  for (SectionPoint& point : known) point.place += angle.centroid;
  for (const Vector2& outer : profile.section.stress_points) {
    const Vector2 place = outer + profile.centroid;
    SectionPoint point = *std::min_element(known.begin(), known.end(), [&](auto& a, auto& b) {
      return (a.place - place).norm() < (b.place - place).norm();
    });
    point.place = place;
    add_shear_point(point, profile);
  }
  for (const SectionPoint& point : known)
    if (std::abs(point.place[1]) < 0.51 * web) add_shear_point(point, profile);
}

}  // namespace

Profile walled_profile(const std::string& name, const std::vector<Vector2>& nodes,
                       const std::vector<Wall>& walls) {
  Moments moments;
  std::vector<Vector2> outline;
  for (const Wall& wall : walls) {
    const Vector2 &from = nodes[wall.from], &to = nodes[wall.to];
    const double length = (to - from).norm();
    if (!(length > 0) || !(wall.thickness > 0))
      throw ModelError(name + ": a wall has no length or no thickness");
    const Vector2 along = (to - from) / length, across(-along[1], along[0]);
    const Vector2 first = from - wall.longer_at_from * along, last = to + wall.longer_at_to * along;
    const double solid = length + wall.longer_at_from + wall.longer_at_to;
    if (!(solid > 0)) throw ModelError(name + ": a wall is shorter than its neighbours are thick");
    moments.add_rectangle((first + last) / 2, along, solid, wall.thickness);
    for (const double side : {-0.5, 0.5}) {
      outline.emplace_back(first + side * wall.thickness * across);
      outline.emplace_back(last + side * wall.thickness * across);
    }
  }
  Profile profile = profile_of(name, moments);
  set_wall_figures(ThinWalls(nodes, walls), profile);
  set_points(profile, outline);
  return profile;
}

Profile outlined_profile(const std::string& name, const std::vector<Outline>& outlines,
                         const std::vector<Vector2>& nodes, const std::vector<Wall>& walls) {
  Moments moments;
  std::vector<Vector2> points;
  for (const Outline& outline : outlines) {
    moments.add_polygon(outline.corners, outline.is_hole ? -1 : 1);
    if (!outline.is_hole)
      points.insert(points.end(), outline.corners.begin(), outline.corners.end());
  }
  Profile profile = profile_of(name, moments);
  const ThinWalls lines(nodes, walls);
  set_wall_figures(lines, profile);
  // Walls are drawn to their nodes: the outline goes beyond them.
  for (const Vector2& point : points) add_shear_point(lines.point_at(point), profile);
  set_points(profile, points);
  return profile;
}

Profile solid_polygon(const std::string& name, const std::vector<Vector2>& corners) {
  Moments moments;
  moments.add_polygon(corners, 1);
  Profile profile = profile_of(name, moments);
  BeamSection& section = profile.section;
  section.torsion =
      std::pow(section.area, 4) / (40 * (section.second_moment_2 + section.second_moment_3));
  section.shear_area_2 = section.shear_area_3 = 5.0 / 6 * section.area;
  set_points(profile, corners);
  section.shear_points =
      shear_points_of_polygon(section.stress_points, section.area, section.torsion);
  return profile;
}

double foot_of(const Profile& profile) {
  double foot = std::numeric_limits<double>::infinity();
  for (const Vector2& point : profile.section.stress_points) foot = std::min(foot, point[0]);
  return profile.centroid[0] + foot;
}

Profile seen(const Profile& profile, bool exchanged, bool reversed_2, bool reversed_3) {
  Profile other = profile;
  BeamSection& section = other.section;
  const double sign_2 = reversed_2 ? -1 : 1, sign_3 = reversed_3 ? -1 : 1;
  const auto as_seen = [&](const Vector2& point) {
    const Vector2 kept = exchanged ? Vector2(point[1], point[0]) : point;
    return Vector2(sign_2 * kept[0], sign_3 * kept[1]);
  };
  if (exchanged) {
    std::swap(section.second_moment_2, section.second_moment_3);
    std::swap(section.shear_area_2, section.shear_area_3);
  }
  section.product_23 *= sign_2 * sign_3;
  section.shear_centre = as_seen(section.shear_centre);
  for (Vector2& point : section.stress_points) point = as_seen(point);
  // In a mirror torsion turns the other way.
  const double turn = sign_2 * sign_3 * (exchanged ? -1 : 1);
  for (SectionPoint& point : section.shear_points)
    point = {as_seen(point.place), turn * point.of_torsion, as_seen(point.of_force)};
  other.centroid = as_seen(other.centroid);
  if (exchanged || reversed_2) other.plates.reset();
  if (reversed_3 && other.plates) {
    auto& [from, to] = other.plates->flange_reach;
    from = -std::exchange(to, -from);
  }
  return other;
}

Profile profile_of_figures(const SectionFigures& f) {
  const char* const shape = "section by figures";
  require_positive(shape, {{"height", f.height}, {"width", f.width}});
  for (const double figure :
       {f.area, f.second_moment_3, f.second_moment_2, f.torsion, f.shear_area_2, f.shear_area_3})
    require(figure > 0, shape, "each of its figures must be positive");
  constexpr double rounding = 1 + 1e-6;
  require(f.area <= rounding * f.height * f.width, shape, "its area is more than height x width");
  // All of the area in the outermost fibres.
  require(f.second_moment_3 <= rounding * f.area * f.height * f.height / 4 &&
              f.second_moment_2 <= rounding * f.area * f.width * f.width / 4,
          shape, "its second moments are more than its area has within height and width");
  // Saint-Venant: no section is stiffer in torsion than its polar second moment.
  require(f.torsion <= rounding * (f.second_moment_2 + f.second_moment_3), shape,
          "its torsion constant is more than both second moments together");
  for (const double shear : {f.shear_area_2, f.shear_area_3})
    require(std::isinf(shear) || shear <= rounding * f.area, shape,
            "a shear area is more than its area");
  Profile profile;
  profile.section.name = shape;
  profile.section.area = f.area;
  profile.section.second_moment_2 = f.second_moment_2;
  profile.section.second_moment_3 = f.second_moment_3;
  profile.section.torsion = f.torsion;
  profile.section.shear_area_2 = f.shear_area_2;
  profile.section.shear_area_3 = f.shear_area_3;
  profile.section.stress_points = {{-f.height / 2, -f.width / 2},
                                   {f.height / 2, -f.width / 2},
                                   {f.height / 2, f.width / 2},
                                   {-f.height / 2, f.width / 2}};
  return profile;
}

Profile solid_rectangle(double height, double width) {
  require_positive("rectangle", {{"height", height}, {"width", width}});
  Moments moments;
  moments.add_rectangle(Vector2::Zero(), Vector2::UnitX(), height, width);
  Profile profile = profile_of("rectangle", moments);
  profile.section.torsion = torsion_of_rectangle(height, width);
  profile.section.shear_area_2 = profile.section.shear_area_3 = 5.0 / 6 * moments.area;
  set_points(profile, corners(-height / 2, height / 2, -width / 2, width / 2));
  profile.section.shear_points = shear_points_of_rectangle(height, width, profile.section.torsion);
  return profile;
}

Profile flat_bar(double height, double thickness) {
  require_positive("flat bar", {{"height", height}, {"thickness", thickness}});
  Profile profile = solid_rectangle(height, thickness);
  profile.section.name = "flat bar";
  profile.centroid[0] += height / 2;
  profile.plates = {height, thickness};
  return profile;
}

Profile angle_bar(double height, double web, double width, double flange) {
  require_positive("angle",
                   {{"height", height}, {"web", web}, {"width", width}, {"flange", flange}});
  require(height > flange && width > web, "angle", "its plates are thicker than it is long");
  const double level = height - flange / 2;
  Profile profile = walled_profile("angle", {{0, 0}, {level, 0}, {level, width - web / 2}},
                                   {{0, 1, web, 0, -flange / 2}, {1, 2, flange, web / 2, 0}});
  profile.plates = {level, web, flange, {0, width - web / 2}};
  return profile;
}

Profile tee_bar(double height, double web, double width, double flange) {
  require_positive("tee", {{"height", height}, {"web", web}, {"width", width}, {"flange", flange}});
  require(height > flange && width > web, "tee", "its plates are thicker than it is long");
  const double level = height - flange / 2;
  Profile profile =
      walled_profile("tee", {{level, -width / 2}, {level, 0}, {level, width / 2}, {0, 0}},
                     {{0, 1, flange}, {2, 1, flange}, {3, 1, web, 0, -flange / 2}});
  profile.plates = {level, web, flange, {-width / 2, width / 2}};
  return profile;
}

Profile bulb_flat(double height, double thickness, double bulb, double radius) {
  require_positive(
      "bulb flat",
      {{"height", height}, {"thickness", thickness}, {"bulb", bulb}, {"radius", radius}});
  const double slope = 1 / std::sqrt(3.0), face = radius * (1 + slope);
  require(radius < bulb && face + bulb * slope < height, "bulb flat",
          "the bulb is larger than the profile");
  Moments moments;
  moments.add_rectangle({height / 2, 0}, Vector2::UnitX(), height, thickness);
  // The bulb: a rectangle and a triangle beside the web, less what its two corners are rounded by.
  std::vector<Vector2> outline;
  const double inner = thickness / 2, outer = inner + bulb;
  outline.emplace_back(height, inner);
  const auto arc = [&](const Vector2& centre, double from, double to) {
    constexpr int steps = 1000;  // chords: seven digits of what the arc bounds
    for (int i = 0; i <= steps; ++i) {
      const double angle = from + (to - from) * i / steps;
      outline.emplace_back(centre + radius * Vector2(std::sin(angle), std::cos(angle)));
    }
  };
  const Vector2 upper(height - radius, outer - radius);
  arc(upper, std::numbers::pi / 2, 0);
  // The lower round ends where the slope of 30 degrees begins.
  arc(upper, 0, -std::numbers::pi / 3);
  outline.emplace_back(height - face - bulb * slope, inner);
  moments.add_polygon(outline, 1);
  Profile profile = profile_of("bulb flat", moments);
  constexpr double mm = 1e-3;
  const double factor = height > 0.12 ? 1.0 : 1.1 + std::pow(0.12 - height, 2) / (3000 * mm * mm);
  const double web_height = height - height / 9.2 + 2 * mm, flange = height / 9.2 - 2 * mm;
  const double width = factor * (thickness + height / 6.7 - 2 * mm);
  require(flange > 0 && width > thickness, "bulb flat", "it is lower than bulb flats are rolled");
  const Profile angle = angle_bar(web_height + flange, thickness, width, flange);
  profile.section.torsion = angle.section.torsion;
  profile.section.shear_area_2 = angle.section.shear_area_2;
  profile.section.shear_area_3 = angle.section.shear_area_3;
  profile.section.shear_centre = angle.section.shear_centre + angle.centroid - profile.centroid;
  profile.plates = angle.plates;
  set_points(profile, {{0, -inner},
                       {0, inner},
                       {height, -inner},
                       {height, outer - radius},
                       {height - radius, outer}});
  set_points_of_angle(angle, thickness, profile);
  return profile;
}

Profile bulb_flat(double height, double thickness) {
  struct Size {
    double height, bulb, radius;  // mm
  };
  constexpr std::array<Size, 15> sizes{{{120, 17, 5},
                                        {140, 19, 5.5},
                                        {160, 22, 6},
                                        {180, 25, 7},
                                        {200, 28, 8},
                                        {220, 31, 9},
                                        {240, 34, 10},
                                        {260, 37, 11},
                                        {280, 40, 12},
                                        {300, 43, 13},
                                        {320, 46, 14},
                                        {340, 49, 15},
                                        {370, 53.5, 16.5},
                                        {400, 58, 18},
                                        {430, 62.5, 19.5}}};
  std::string heights;
  for (const Size& size : sizes) {
    if (std::abs(size.height - 1000 * height) < 0.5)
      return bulb_flat(height, thickness, size.bulb / 1000, size.radius / 1000);
    heights += fmt::format("{}{:g}", heights.empty() ? "" : ", ", size.height);
  }
  throw ModelError(
      fmt::format("no bulb flat is {:g} mm high; EN 10067 has {} mm", 1000 * height, heights));
}

Profile solid_circle(double radius) {
  require_positive("circle", {{"radius", radius}});
  Profile profile = pipe(radius, 0);
  profile.section.name = "circle";
  return profile;
}

Profile pipe(double outer_radius, double inner_radius) {
  require_positive("pipe", {{"outer radius", outer_radius}});
  require(inner_radius >= 0 && inner_radius < outer_radius, "pipe",
          "the inner radius must be less than the outer one");
  constexpr double pi = std::numbers::pi;
  const double own = pi / 4 * (std::pow(outer_radius, 4) - std::pow(inner_radius, 4));
  Moments moments;
  moments.add(pi * (std::pow(outer_radius, 2) - std::pow(inner_radius, 2)), Vector2::Zero(), own,
              own, 0);
  Profile profile = profile_of("pipe", moments);
  profile.section.torsion = 2 * own;
  profile.section.shear_area_2 = profile.section.shear_area_3 =
      shear_share_of_pipe(inner_radius / outer_radius) * moments.area;
  profile.is_round = true;
  const double r = outer_radius;
  set_points(profile, {{r, 0}, {0, r}, {-r, 0}, {0, -r}});
  profile.section.shear_points = shear_points_of_pipe(outer_radius, inner_radius);
  return profile;
}

Profile box(double height, double width, double top, double bottom, double left, double right) {
  require_positive("box", {{"height", height},
                           {"width", width},
                           {"top", top},
                           {"bottom", bottom},
                           {"left wall", left},
                           {"right wall", right}});
  require(height > top + bottom && width > left + right, "box", "its walls leave nothing inside");
  const double low = -height / 2 + bottom / 2, high = height / 2 - top / 2;
  const double near = -width / 2 + left / 2, far = width / 2 - right / 2;
  // Top and bottom go over the full width.
  return walled_profile("box", {{low, near}, {low, far}, {high, far}, {high, near}},
                        {{0, 1, bottom, left / 2, right / 2},
                         {1, 2, right, -bottom / 2, -top / 2},
                         {2, 3, top, right / 2, left / 2},
                         {3, 0, left, -top / 2, -bottom / 2}});
}

Profile box(double height, double width, double thickness) {
  return box(height, width, thickness, thickness, thickness, thickness);
}

Profile i_beam(double height, double web, double width_bottom, double flange_bottom,
               double width_top, double flange_top) {
  require_positive("I-beam", {{"height", height},
                              {"web", web},
                              {"width at the bottom", width_bottom},
                              {"flange at the bottom", flange_bottom},
                              {"width at the top", width_top},
                              {"flange at the top", flange_top}});
  require(height > flange_bottom + flange_top, "I-beam", "its flanges leave no web");
  const double low = (flange_bottom - height) / 2, high = (height - flange_top) / 2;
  return walled_profile("I-beam",
                        {{low, -width_bottom / 2},
                         {low, 0},
                         {low, width_bottom / 2},
                         {high, 0},
                         {high, -width_top / 2},
                         {high, width_top / 2}},
                        {{0, 1, flange_bottom},
                         {2, 1, flange_bottom},
                         {4, 3, flange_top},
                         {5, 3, flange_top},
                         {1, 3, web, -flange_bottom / 2, -flange_top / 2}});
}

Profile channel(double height, double web, double width, double flange) {
  require_positive("channel",
                   {{"height", height}, {"web", web}, {"width", width}, {"flange", flange}});
  require(height > 2 * flange && width > web, "channel", "its plates leave nothing between them");
  const double level = (height - flange) / 2, near = (web - width) / 2, tip = width / 2;
  return walled_profile("channel", {{-level, tip}, {-level, near}, {level, near}, {level, tip}},
                        {{0, 1, flange, 0, web / 2},
                         {1, 2, web, -flange / 2, -flange / 2},
                         {2, 3, flange, web / 2, 0}});
}

}  // namespace blocklift::structure
