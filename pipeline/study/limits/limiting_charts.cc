#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pipeline/hydrodynamics/line_chart.h"
#include "pipeline/study/limits/limiting_sea.h"

namespace blocklift::pipeline {
namespace {

constexpr double degree = std::numbers::pi / 180;

double highest_of(const LimitingSeas& seas) {
  double highest = 0;
  for (const LimitingHeight& limit : seas.heights) highest = std::max(highest, limit.height);
  return highest;
}

/// A corner of a cell of the grid: place and limit.
struct Corner {
  double period, heading, height;  ///< s, degrees, m
};

/// Adds to a curve the pieces of a level within a triangle: linear there, hence straight.
void add_pieces(const std::array<Corner, 3>& corners, double level, Curve& curve) {
  std::vector<std::array<double, 2>> ends;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = corners[i], &b = corners[(i + 1) % 3];
    if ((a.height < level) == (b.height < level)) continue;
    const double part = (level - a.height) / (b.height - a.height);
    ends.push_back(
        {a.period + part * (b.period - a.period), a.heading + part * (b.heading - a.heading)});
  }
  if (ends.size() != 2) return;
  for (const auto& [period, heading] : ends) {
    curve.x.push_back(period);
    curve.y.push_back(heading);
  }
  curve.x.push_back(std::nan(""));  // lifts the pen
  curve.y.push_back(std::nan(""));
}

/// Headings in degrees; where they go round, the first once more after a whole turn.
std::vector<double> headings_of(const LimitingSeas& seas) {
  std::vector<double> headings;
  for (const double heading : seas.headings) headings.push_back(heading / degree);
  if (seas.go_round()) headings.push_back(headings.front() + 360);
  return headings;
}

/// At which an axis of headings is marked: parts of the turn that people think in.
std::vector<double> figures_of_headings(double lowest, double highest) {
  const double range = highest - lowest;
  if (range < 60) return {};
  const double step = range > 180 ? 90 : 45;
  std::vector<double> figures;
  for (double k = std::floor(lowest / step + 1e-9); k <= std::ceil(highest / step - 1e-9); ++k)
    figures.push_back(k * step);
  return figures;
}

/// A level over the grid, each cell as the four triangles about its middle.
Curve contour(const LimitingSeas& seas, const std::vector<double>& headings, double level) {
  Curve curve{fmt::format("{:.3g} m", level), {}, {}};
  const auto corner = [&](std::size_t p, std::size_t h) {
    return Corner{seas.periods[p], headings[h], seas.at(p, h % seas.headings.size()).height};
  };
  for (std::size_t p = 0; p + 1 < seas.periods.size(); ++p) {
    for (std::size_t h = 0; h + 1 < headings.size(); ++h) {
      const std::array<Corner, 4> round = {corner(p, h), corner(p + 1, h), corner(p + 1, h + 1),
                                           corner(p, h + 1)};
      Corner middle{0, 0, 0};
      for (const Corner& one : round) {
        middle.period += one.period / 4;
        middle.heading += one.heading / 4;
        middle.height += one.height / 4;
      }
      for (std::size_t i = 0; i < 4; ++i)
        add_pieces({round[i], round[(i + 1) % 4], middle}, level, curve);
    }
  }
  return curve;
}

constexpr double width_of_compass = 420, height_of_compass = 300, reach_of_compass = 112;
// Between the spokes, where nothing else is written.
constexpr double angle_of_ring_labels = 67.5 * degree;

/// Headings turn from right, +x, upwards, +y.
struct Compass {
  double scale;  ///< of the drawing, a metre of limiting height

  std::array<double, 2> place(double heading, double height) const {
    constexpr double middle_x = 150, middle_y = 162;
    return {middle_x + scale * height * std::cos(heading),
            middle_y - scale * height * std::sin(heading)};
  }
};

/// Rings, spokes and what stands round them.
std::string rose(const Compass& compass, const std::vector<double>& rings) {
  std::string svg;
  const auto middle = compass.place(0, 0);
  for (const double ring : rings)
    svg += fmt::format(R"(<circle class="grid" cx="{:.1f}" cy="{:.1f}" r="{:.1f}" fill="none"/>)",
                       middle[0], middle[1], ring * compass.scale);
  for (int angle = 0; angle < 360; angle += 45) {
    const auto end = compass.place(angle * degree, rings.back());
    const auto label = compass.place(angle * degree, rings.back() + 14 / compass.scale);
    svg += fmt::format(R"(<line class="grid" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)"
                       R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}°</text>)",
                       middle[0], middle[1], end[0], end[1], label[0], label[1] + 4, angle);
  }
  return svg;
}

/// Headings at which a curve round the compass is drawn from one that was run to the next: so near
/// to each other that a line between them is the arc.
std::vector<double> headings_on_the_way(double from, double to) {
  constexpr double finest = 3 * degree;
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / finest - 1e-9)));
  std::vector<double> headings;
  for (int k = 1; k < steps; ++k) headings.push_back(from + (to - from) * k / steps);
  return headings;
}

/// The limits of a period: a curve from heading to heading, closed where they go round, and a dot
/// at each; an open one where the limit is at least that. Between headings it is what counts there:
/// linear over the heading (an arc of equal limits is one of a circle, where a chord would cut into
/// what is allowed), and zero beside a limit that is unknown.
std::string limits_of_period(const LimitingSeas& seas, std::size_t period, const Compass& compass) {
  constexpr std::array<const char*, 6> colours = {"#1f5fa8", "#c8501e", "#2d8a4e",
                                                  "#8b3fa0", "#b8860b", "#2a8c94"};
  const char* const colour = colours[period % colours.size()];
  std::string path, dots;
  const auto go_to = [&](double heading, double height) {
    const auto at = compass.place(heading, height);
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", at[0], at[1]);
    return at;
  };
  const std::size_t count = seas.headings.size();
  for (std::size_t h = 0; h < count; ++h) {
    const LimitingHeight& limit = seas.at(period, h);
    const auto at = go_to(seas.headings[h], limit.height);
    const bool is_known = limit.kind == LimitKind::found || limit.kind == LimitKind::below_grid;
    dots += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="2.5" stroke="{}" fill="{}"/>)", at[0],
                        at[1], colour, is_known ? colour : "#fff");
    if (h + 1 == count && !seas.go_round()) break;
    const double next = h + 1 < count ? seas.headings[h + 1] : seas.headings.front() + 360 * degree;
    for (const double heading : headings_on_the_way(seas.headings[h], next))
      go_to(heading, seas.height_at(seas.periods[period], heading));
  }
  if (seas.go_round()) path += "Z";
  return fmt::format(
      R"(<path d="{0}" stroke="{1}"/>{2})"
      R"(<text class="legend" x="{3}" y="{4}" text-anchor="end" fill="{1}">Tp {5:.4g} s</text>)",
      path, colour, dots, width_of_compass - 16, 44 + 12 * period, seas.periods[period]);
}

}  // namespace

std::string limiting_contours(const LimitingSeas& seas) {
  if (seas.periods.size() < 2) return "";  // a point a curve, which no line shows
  if (seas.headings.size() < 2) {
    LineChart chart{"Limiting significant height", "peak period, s", "m", {}};
    Curve curve{"", seas.periods, {}};
    for (std::size_t p = 0; p < seas.periods.size(); ++p) curve.y.push_back(seas.at(p, 0).height);
    chart.curves.push_back(std::move(curve));
    return to_svg(chart);
  }
  const std::vector<double> headings = headings_of(seas);
  LineChart chart{"Limiting significant height", "peak period, s", "heading, deg", {}};
  chart.y_figures = figures_of_headings(headings.front(), headings.back());
  chart.legend_outside = true;
  for (const double level : round_figures(0, highest_of(seas), 7)) {
    Curve curve = contour(seas, headings, level);
    if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
  }
  // The frame stands even where no level runs through it.
  chart.curves.push_back({"",
                          {seas.periods.front(), std::nan(""), seas.periods.back()},
                          {headings.front(), std::nan(""), headings.back()}});
  return to_svg(chart);
}

std::string limiting_polar(const LimitingSeas& seas) {
  if (seas.headings.size() < 2) return "";
  std::vector<double> rings = round_figures(0, highest_of(seas), 4);
  std::erase_if(rings, [](double ring) { return !(ring > 0); });
  const Compass compass{reach_of_compass / rings.back()};
  std::string svg = fmt::format(
      R"(<svg viewBox="0 0 {} {}" role="img">)"
      R"(<text class="title" x="8" y="14">Limiting significant height, m, by heading</text>)",
      width_of_compass, height_of_compass);
  svg += rose(compass, rings);
  for (std::size_t p = 0; p < seas.periods.size(); ++p) svg += limits_of_period(seas, p, compass);
  // Above the curves, or they would cross them out.
  for (const double ring : rings) {
    const auto at = compass.place(angle_of_ring_labels, ring);
    svg += fmt::format(R"(<text x="{:.1f}" y="{:.1f}">{:.3g}</text>)", at[0] + 2, at[1] + 3, ring);
  }
  return svg + "</svg>\n";
}

}  // namespace blocklift::pipeline
