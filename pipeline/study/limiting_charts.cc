#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pipeline/hydrodynamics/line_chart.h"
#include "pipeline/study/limiting_sea.h"

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

/// A level over the grid, each cell as the four triangles about its middle.
Curve contour(const LimitingSeas& seas, double level) {
  Curve curve{fmt::format("{:.3g} m", level), {}, {}};
  const auto corner = [&](std::size_t p, std::size_t h) {
    return Corner{seas.periods[p], seas.headings[h] / degree, seas.at(p, h).height};
  };
  for (std::size_t p = 0; p + 1 < seas.periods.size(); ++p) {
    for (std::size_t h = 0; h + 1 < seas.headings.size(); ++h) {
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

}  // namespace

std::string limiting_contours(const LimitingSeas& seas) {
  if (seas.headings.size() < 2 || seas.periods.size() < 2) {
    LineChart chart{"Limiting significant height", "peak period, s", "m", {}};
    for (std::size_t h = 0; h < seas.headings.size(); ++h) {
      Curve curve{
          seas.headings.size() > 1 ? fmt::format("{:.4g} deg", seas.headings[h] / degree) : "",
          seas.periods,
          {}};
      for (std::size_t p = 0; p < seas.periods.size(); ++p) curve.y.push_back(seas.at(p, h).height);
      chart.curves.push_back(std::move(curve));
    }
    return to_svg(chart);
  }
  LineChart chart{"Limiting significant height", "peak period, s", "heading, deg", {}};
  for (const double level : round_figures(0, highest_of(seas), 7)) {
    Curve curve = contour(seas, level);
    if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
  }
  // The frame stands even where no level runs through it.
  chart.curves.push_back(
      {"",
       {seas.periods.front(), std::nan(""), seas.periods.back()},
       {seas.headings.front() / degree, std::nan(""), seas.headings.back() / degree}});
  return to_svg(chart);
}

std::string limiting_polar(const LimitingSeas& seas) {
  if (seas.headings.size() < 2) return "";
  constexpr double size = 300, middle = size / 2, reach = 110;
  constexpr std::array<const char*, 6> colours = {"#1f5fa8", "#c8501e", "#2d8a4e",
                                                  "#8b3fa0", "#b8860b", "#2a8c94"};
  const std::vector<double> rings = round_figures(0, highest_of(seas), 4);
  const double scale = reach / rings.back();
  std::string svg = fmt::format(
      R"(<svg viewBox="0 0 {0} {0}" role="img"><text class="title" x="8" y="14">Limiting height by heading, m</text>)",
      size);
  for (const double ring : rings)
    svg += fmt::format(
        R"(<circle class="grid" cx="{0}" cy="{0}" r="{1:.1f}" fill="none"/><text x="{2:.1f}" y="{3:.1f}">{4:.3g}</text>)",
        middle, ring * scale, middle + 2, middle - ring * scale - 1, ring);
  const auto place = [&](double heading, double height) {
    return std::array<double, 2>{middle + scale * height * std::cos(heading),
                                 middle - scale * height * std::sin(heading)};
  };
  for (std::size_t p = 0; p < seas.periods.size(); ++p) {
    const char* const colour = colours[p % colours.size()];
    std::string path;
    for (std::size_t h = 0; h < seas.headings.size(); ++h) {
      const auto at = place(seas.headings[h], seas.at(p, h).height);
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", at[0], at[1]);
    }
    svg += fmt::format(
        R"(<path d="{0}" stroke="{1}"/><text x="{2}" y="{3}" text-anchor="end" fill="{1}">Tp {4:.3g} s</text>)",
        path, colour, size - 4, 30 + 12 * p, seas.periods[p]);
  }
  return svg + "</svg>\n";
}

}  // namespace blocklift::pipeline
